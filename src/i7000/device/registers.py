"""The coils, inputs and registers of a module's map, read and written (manual 3.4).

Laws: `i7000.modbus` defines the rows and their values; this module connects them to the state that DCON commands use
too. A write is made completely or not at all.
"""

from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache
from typing import Any

from attrs import evolve

from i7000.device.call import Call
from i7000.device.changes import (
    enable_channels,
    set_address,
    set_cjc_update,
    set_host_watchdog,
    set_line,
    set_types,
    type_code,
)
from i7000.device.logger import DATE_PARTS, changed, date_of
from i7000.device.measurement import cold_junction, faults, temperatures, words
from i7000.device.state import State
from i7000.errors import DecodeError, EncodeError
from i7000.modbus import Access, Area, ExceptionCode, Kind, Register
from i7000.modbus.register_values import counts_of, values_of
from i7000.modbus.registers import rows
from i7000.models import Firmware, Model
from i7000.profile import Profile

__all__ = ["RequestError", "read", "write"]


class RequestError(Exception):
    """Raised for a request that is answered with an exception; the code is the only argument."""

    @property
    def code(self) -> ExceptionCode:
        """The code of the exception."""
        code: ExceptionCode = self.args[0]
        return code


@lru_cache(maxsize=256)
def _map_of(model: Model, firmware: str) -> dict[Area, dict[int, tuple[Register, int]]]:
    """Return the row of an address, and the place of its item in the row."""
    found: dict[Area, dict[int, tuple[Register, int]]] = {area: {} for area in Area}
    for row in rows(Profile(model, firmware=Firmware(firmware), type_codes=())):
        found[row.area] |= {row.address + at: (row, at) for at in range(row.count)}
    return found


def _spans(
    model: Model, firmware: str, area: Area, asked: range, forbidden: Access
) -> tuple[tuple[Register, int], ...]:
    """Return the rows of a range of addresses, with the first item of each.

    Errors: `RequestError` 02 if the first address does not allow this access; 03 if another one does not.
    Manual: 3.1, 3.2; E94, E99.
    """
    places = _map_of(model, firmware)[area]
    spans: dict[str, tuple[Register, int]] = {}
    for address in asked:
        place = places.get(address)
        if place is None or place[0].access is forbidden:
            raise RequestError(ExceptionCode.ILLEGAL_DATA_VALUE if spans else ExceptionCode.ILLEGAL_DATA_ADDRESS)
        spans.setdefault(place[0].name, place)
    return tuple(spans.values())


# --- reading ----------------------------------------------------------------------------------------------------------


def read(call: Call, area: Area, asked: range) -> tuple[State, tuple[int, ...]]:
    """Return the state after a read of coils, inputs or registers, and their values.

    Special: reading the reset status ends it. Log records are read whole.
    Errors: `RequestError`, see `_spans`; 03 for a part of a log record.
    """
    state, eeprom = call.state, call.eeprom
    found: tuple[int, ...] = ()
    for row, at in _spans(eeprom.model, eeprom.firmware.text, area, asked, Access.WRITE):
        if row.kind is Kind.RECORD and (at % Kind.RECORD.width or len(asked) % Kind.RECORD.width):
            raise RequestError(ExceptionCode.ILLEGAL_DATA_VALUE)
        found += _words_of(row, call)[at : at + len(asked) - len(found)]
        if row.ends_when_read:
            state = state.keep(reset_status_read=True)
    return state, found


def _words_of(row: Register, call: Call) -> tuple[int, ...]:
    """Return the values of all items of a row, as bits or words."""
    values = _READ[row.name](call)
    items: tuple[int, ...] = (values,) if isinstance(values, int) else tuple(values)
    if row.kind is Kind.UINT32:
        return counts_of(row, items[0], call.state.profile, big_endian=call.eeprom.big_endian)
    mask = 0xFF if row.kind is Kind.INT8 else 0xFFFF
    return tuple([item & mask for item in items])


def _records(call: Call) -> list[int]:
    """Return the records from the read index on; zeros for a missing record (E109)."""
    words: list[int] = []
    for record in call.eeprom.log.window():
        if record is None:
            words += (0,) * Kind.RECORD.width
        else:
            time = (record.time & 0xFFFF, record.time >> 16)
            words += record.words + (time[::-1] if call.eeprom.big_endian else time)
    return words


def _clock(at: int) -> Callable[[Call], int]:
    return lambda it: date_of(it.eeprom.log.clock(it.now))[at]


def _log_date(name: str, at: int) -> Callable[[Call], int]:
    return lambda it: getattr(it.eeprom.log, name)[at]


def _period(at: int) -> Callable[[Call], int]:
    return lambda it: it.eeprom.log.period[at]


_PERIOD_PARTS = ("hour", "minute", "second")

_READ: dict[str, Callable[[Call], int | Iterable[int]]] = {
    "analog_input": lambda it: words(it.state, it.signals),
    "range_status": lambda it: faults(it.state, it.signals, it.eeprom.model.channels),
    "temperature": lambda it: temperatures(it.state, it.signals),
    "cjc_temperature": lambda it: round(cold_junction(it.state, it.signals) * 100),
    "log_records": _records,
    "type_code": lambda it: it.eeprom.type_codes,
    "temperature_offset": lambda it: it.eeprom.channel_offsets,
    "cjc_offset": lambda it: (
        it.eeprom.channel_cjc_offsets if it.eeprom.model.series == "7019" else it.eeprom.channel_offsets
    ),
    "firmware_version": lambda it: int.from_bytes(bytes(it.eeprom.firmware), "big"),
    "module_name": lambda it: int.from_bytes(it.eeprom.model.modbus_name, "big"),
    "module_address": lambda it: it.eeprom.address,
    "line_settings": lambda it: it.eeprom.line_settings.byte,
    "module_type_code": lambda it: type_code(it.state),
    "response_delay": lambda it: it.eeprom.response_delay,
    "host_watchdog_timeout": lambda it: it.eeprom.host_watchdog_timeout,
    "channel_mask": lambda it: it.state.enabled,
    "channel_mask_high": lambda it: it.state.enabled >> 16,
    "module_cjc_offset": lambda it: it.eeprom.cjc_offset,
    "host_watchdog_timeout_count": lambda it: it.eeprom.host_watchdog_timeouts,
    "cjc_update": lambda it: it.state.ram.cjc_update,
    "protocol": lambda it: it.eeprom.protocol,
    "filter": lambda it: it.eeprom.report_settings.filter.value,
    "host_watchdog_mode": lambda it: it.eeprom.host_watchdog_mode,
    "host_watchdog_enabled": lambda it: it.eeprom.host_watchdog_enabled,
    "cjc_enabled": lambda it: it.eeprom.cjc_enabled,
    "modbus_data_format": lambda it: it.eeprom.modbus_data_format,
    "host_watchdog_timed_out": lambda it: it.eeprom.host_watchdog_timed_out,
    "fast_mode": lambda it: it.eeprom.report_settings.fast_mode,
    "reset_status": lambda it: not it.state.ram.reset_status_read,
    "sampling_rate": lambda it: it.eeprom.sampling_rate_8_hz,
    "open_wire_detection": lambda it: it.eeprom.open_wire_detection,
    "single_ended": lambda it: it.eeprom.single_ended,
    "big_endian": lambda it: it.eeprom.big_endian,
    "rtc_epoch": lambda it: int(it.eeprom.log.clock(it.now) // 1) & 0xFFFFFFFF,
    "log_last_index": lambda it: it.eeprom.log.last_index,
    "log_read_index": lambda it: it.eeprom.log.read_index,
    "log_status": lambda it: it.eeprom.log.running(it.now),
    "log_command": lambda it: it.eeprom.log.command,
    "log_overwrite": lambda it: it.eeprom.log.overwrite,
    **{f"log_period_{part}": _period(at) for at, part in enumerate(_PERIOD_PARTS)},
    **{f"rtc_{part}": _clock(at) for at, part in enumerate(DATE_PARTS)},
    **{f"log_{name}_{part}": _log_date(name, at) for name in ("start", "end") for at, part in enumerate(DATE_PARTS)},
}
"""The values of each row: a number for each of its items, negative ones in two's complement; see E75, E77."""

# --- writing ----------------------------------------------------------------------------------------------------------


def write(call: Call, area: Area, start: int, items: Sequence[int]) -> State:
    """Write coils or registers.

    Special: a write to one register of a 32-bit number leaves the other unchanged.
    Errors: `RequestError`, see `_spans`; 03 for values that a row cannot contain (E94, E136).
    """
    state, now = call.state, call.now
    asked, eeprom = range(start, start + len(items)), call.eeprom
    values: dict[str, tuple[Any, ...]] = {}
    clock: dict[str, int] = {}
    done = 0
    for row, at in _spans(eeprom.model, eeprom.firmware.text, area, asked, Access.READ):
        new = items[done : done + row.count - at]
        done += len(new)
        of_row = _values(row, at, new, call)
        if row.name in _CLOCK_PARTS:
            clock[_CLOCK_PARTS[row.name]] = of_row[0]
        else:
            values[row.name] = of_row
    for name, of_row in values.items():
        state = _WRITE[name](Call(state, call.message, call.signals, now, of_row))
    return state.store(log=state.eeprom.log.set_clock(clock, now)) if clock else state


_CLOCK_PARTS = {f"rtc_{part}": part for part in DATE_PARTS}
"""The parts of a date; together they must be an existing day."""


def _values(row: Register, at: int, new: Sequence[int], call: Call) -> tuple[Any, ...]:
    """Return the values of all items of a row after a write from its item `at` on; raise if they are invalid."""
    words: list[int] = list(new)
    if len(new) != row.count:
        words = list(_words_of(row, call))
        words[at : at + len(new)] = new
    profile, big_endian = call.state.profile, call.eeprom.big_endian
    try:
        values = values_of(row, tuple(words), 0, row.count // row.kind.width, profile, big_endian=big_endian)
        for value in values:
            counts_of(row, value, profile, big_endian=big_endian)
    except (DecodeError, EncodeError):
        raise RequestError(ExceptionCode.ILLEGAL_DATA_VALUE) from None
    return values


def _counts(row_scale: int, values: Iterable[float]) -> tuple[int, ...]:
    return tuple([round(value * row_scale) for value in values])


def _set_cjc_offsets(call: Call) -> State:
    if call.eeprom.model.series == "7019":
        return call.state.store(channel_cjc_offsets=_counts(100, call.values))
    return call.state.store(channel_offsets=_counts(10, call.values))


def _set_mask(call: Call, mask: int, among: int) -> State:
    """Switch channels; those that the connecting mode does not have cannot be switched on (2.13)."""
    channels = (1 << call.state.profile.channels) - 1
    if mask & ~channels:
        raise RequestError(ExceptionCode.ILLEGAL_DATA_VALUE)
    return enable_channels(call.state, mask, among & channels)


def _set_type_codes(call: Call) -> State:
    return call.state.store(type_codes=call.values)


def _report(call: Call, **changes: Any) -> State:  # noqa: ANN401 - fields of `ReportSettings`
    return call.state.store(report_settings=evolve(call.eeprom.report_settings, **changes))


def _log(call: Call, **changes: Any) -> State:  # noqa: ANN401 - fields of `Log`
    return call.state.store(log=evolve(call.eeprom.log, **changes).planned(call.now))


def _set_log_date(name: str, part: str) -> Callable[[Call], State]:
    def write_part(call: Call) -> State:
        return _log(call, **{name: changed(getattr(call.eeprom.log, name), {part: call.value})})

    return write_part


def _set_period(at: int) -> Callable[[Call], State]:
    def write_part(call: Call) -> State:
        period = call.eeprom.log.period
        return _log(call, period=(*period[:at], call.value, *period[at + 1 :]))

    return write_part


_WRITE: dict[str, Callable[[Call], State]] = {
    "type_code": _set_type_codes,
    "temperature_offset": lambda it: it.state.store(channel_offsets=_counts(10, it.values)),
    "cjc_offset": _set_cjc_offsets,
    "module_address": lambda it: set_address(it.state, it.value),
    "line_settings": lambda it: set_line(it.state, it.value, it.eeprom.protocol),
    "module_type_code": lambda it: set_types(it.state, it.value),
    "response_delay": lambda it: it.state.store(response_delay=it.value),
    "host_watchdog_timeout": lambda it: set_host_watchdog(
        it.state, it.now, enabled=it.eeprom.host_watchdog_enabled, timeout=round(it.value * 10)
    ),
    "channel_mask": lambda it: _set_mask(it, it.value, 0xFFFF),
    "channel_mask_high": lambda it: _set_mask(it, it.value << 16, 0xF0000),
    "module_cjc_offset": lambda it: it.state.store(cjc_offset=round(it.value * 100)),
    "host_watchdog_timeout_count": lambda it: it.state.store(host_watchdog_timeouts=it.value),
    "cjc_update": lambda it: set_cjc_update(it.state, it.value, it.signals),
    "protocol": lambda it: set_line(it.state, it.eeprom.line_settings, it.value),
    "filter": lambda it: _report(it, filter=it.value),
    "host_watchdog_mode": lambda it: it.state.store(host_watchdog_mode=it.value),
    "host_watchdog_enabled": lambda it: set_host_watchdog(
        it.state, it.now, enabled=it.value, timeout=it.eeprom.host_watchdog_timeout
    ),
    "cjc_enabled": lambda it: it.state.store(cjc_enabled=it.value),
    "modbus_data_format": lambda it: it.state.store(modbus_data_format=it.value),
    "host_watchdog_timed_out": lambda it: it.state.store(
        host_watchdog_timed_out=it.eeprom.host_watchdog_timed_out and not it.value
    ),
    "fast_mode": lambda it: _report(it, fast_mode=it.value),
    "load_factory_calibration": lambda it: it.state,
    "sampling_rate": lambda it: it.state.store(sampling_rate_8_hz=it.value),
    "open_wire_detection": lambda it: it.state.store(open_wire_detection=it.value),
    "single_ended": lambda it: it.state.store(single_ended=it.value),
    "big_endian": lambda it: it.state.store(big_endian=it.value),
    "rtc_epoch": lambda it: it.state.store(log=it.eeprom.log.set_epoch(it.value, it.now)),
    "log_read_index": lambda it: it.state.store(log=evolve(it.eeprom.log, read_index=it.value)),
    "log_command": lambda it: _log(it, command=it.value),
    "log_overwrite": lambda it: it.state.store(log=evolve(it.eeprom.log, overwrite=bool(it.value))),
    **{f"log_period_{part}": _set_period(at) for at, part in enumerate(_PERIOD_PARTS)},
    **{f"log_{name}_{part}": _set_log_date(name, part) for name in ("start", "end") for part in DATE_PARTS},
}
"""The effect of a write to each row."""
