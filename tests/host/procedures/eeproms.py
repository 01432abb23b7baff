"""The memory of a module as its smallest parts, and other values of settings."""

from typing import Any

from attrs import evolve, fields
from hypothesis import strategies as st

from i7000 import LineSettings, Model, Protocol, ReportSettings
from i7000.device import Eeprom, Log
from i7000.strategies.device import eeproms

NOT_SET = {
    "model": "no command sets it",
    "firmware": "no command sets it",
    "host_watchdog_timed_out": "a state of the module",
    "host_watchdog_timeouts": "a counter",
    "report_settings.reserved": "always 0",
    "log.clock_offset": "the clock",
    "log.next_at": "follows from the settings of the logger",
    "log.read_index": "a place in the log",
    "log.last_index": "a counter",
    "log.records": "what was logged",
}
"""The parts of the memory that are no settings, and why."""
_PARTS = (LineSettings, ReportSettings, Log)


def parts(eeprom: Eeprom) -> dict[str, Any]:
    """The values of the smallest parts by their names: ``line_settings.baud_rate``, ``type_codes.3``."""
    found: dict[str, Any] = {}
    for it in fields(Eeprom):
        value = getattr(eeprom, it.name)
        if isinstance(value, _PARTS):
            found |= {f"{it.name}.{part.name}": getattr(value, part.name) for part in fields(type(value))}
        elif isinstance(value, tuple):
            found |= {f"{it.name}.{channel}": one for channel, one in enumerate(value)}
        else:
            found[it.name] = value
    return found


def differences(one: Eeprom, other: Eeprom) -> set[str]:
    """The names of the smallest parts that differ."""
    before, after = parts(one), parts(other)
    return {name for name in before if before[name] != after[name]}


def calm(eeprom: Eeprom) -> Eeprom:
    """The same memory with a watchdog and a logger that do nothing by themselves while a test runs."""
    log = evolve(Log(), period=eeprom.log.period, start=eeprom.log.start, end=eeprom.log.end)
    slow = 0xFF if eeprom.host_watchdog_timeout else 0
    return evolve(eeprom, log=evolve(log, overwrite=eeprom.log.overwrite), host_watchdog_timeout=slow)


@st.composite
def two_modules(draw: st.DrawFn, *models: Model, protocol: Protocol | None = None) -> tuple[Eeprom, Eeprom]:
    """Make two memories of one model with one firmware, in one protocol."""
    model = draw(st.sampled_from(models or tuple(Model)))
    spoken = draw(st.sampled_from(sorted(model.protocols))) if protocol is None else protocol
    one = calm(draw(eeproms(model, protocol=spoken)))
    other = calm(draw(eeproms(model, protocol=spoken)))
    try:
        return one, evolve(other, firmware=one.firmware)
    except ValueError:  # settings that this firmware does not have
        return one, one
