"""The executable model of a module, pure: a state, a frame, signals and the time give the next state and an answer.

`factory` and `power_on` make a module, `step` lets it hear a frame, `advance` lets time pass; a `Bus` is several, which
hear what hosts send in whatever pieces. A power cycle is ``power_on(state.eeprom, now=now)``. Where the manual is
silent the docstrings say what is assumed, with the id of ``spec/errata.json`` where there is one.
Parts: `state` is what a module remembers, `signals` what is on its inputs, `measurement` what it makes of them,
`logger` its data logger and clock; `module` says whom a frame is for, `dcon` and `modbus` are the two doors,
`registers` the address map behind the second, `call` what comes in, `changes` what both do; `bus` and `uart` are the
line.
"""

from i7000.device.bus import Bus, Ear, Heard
from i7000.device.logger import CAPACITY, Log, LogCommand, Record
from i7000.device.module import advance, step
from i7000.device.ram import Ram
from i7000.device.signals import OPEN_WIRE, Signal, Signals
from i7000.device.state import Eeprom, State, factory, power_on
from i7000.device.uart import Uart

__all__ = [
    "CAPACITY",
    "OPEN_WIRE",
    "Bus",
    "Ear",
    "Eeprom",
    "Heard",
    "Log",
    "LogCommand",
    "Ram",
    "Record",
    "Signal",
    "Signals",
    "State",
    "Uart",
    "advance",
    "factory",
    "power_on",
    "step",
]
