"""The executable model of a module, pure: a state, a frame, signals and the time give the next state and a response.

`factory` and `power_on` make a module. `step` gives it a frame; `advance` moves its time on. A `Bus` has several
modules, which receive what hosts send, in any pieces. A power cycle is ``power_on(state.eeprom, now=now)``. Docstrings
mark every assumption that fills a gap of the manual, with its id in ``spec/errata.json``.
Parts: `state` is the memory of a module, `signals` its inputs, `measurement` its readings, `logger` its data logger and
clock. `module` passes frames to the protocols `dcon` and `modbus`; `registers` is the address map of Modbus. `call` has
the arguments of both protocols, `changes` their common actions. `bus` and `uart` are the line.
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
