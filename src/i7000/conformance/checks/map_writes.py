"""The rows of the address maps that can be written: changed, read back and restored; values beyond their limits (3.4).

Laws: neighbours are changed by one request, because the EEPROM wears out. What is read back is compared with what was
written, not only with the twin. Counters and states that a write would clear are not cleared: what was counted could
not be restored. A value that is refused changes nothing. Which exception a map refuses with is an assumption (E94).
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from datetime import datetime, timedelta
from functools import partial
from typing import Any

from i7000 import modbus
from i7000.conformance.checks.modbus_steps import (
    ADDRESS_OR_VALUE,
    address_changed,
    changed_and_restored,
    items,
    read_row,
    refused,
    row_of,
    row_with,
    write_of,
)
from i7000.conformance.checks.steps import Steps
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Reason, Skipped, SkipReason, Unclear
from i7000.host.procedures import Procedure
from i7000.modbus import Area, Kind, Register
from i7000.models import Model
from i7000.type_codes import TypeCode

__all__ = ["STEPS", "WRITTEN", "other_value", "put_and_read"]

Other = Callable[[Subject, int], int]
"""Returns another value for an item, by the one that it has: as a bit or a word."""


# --- other values -----------------------------------------------------------------------------------------------------


def _flipped(_: Subject, value: int) -> int:
    return 1 - value


def _one_of(*values: int) -> Other:
    """Return the first of some values that the item does not have."""
    return lambda _, value: next(it & 0xFFFF for it in values if it & 0xFFFF != value)


def _other_type(module: Subject, value: int) -> int:
    """Return another type.

    Errors: `Skipped` if the module has only one.
    """
    types = [code for code in TypeCode if module.profile.supports(code) and code != value]
    if not types:
        raise Skipped(SkipReason.NOT_APPLICABLE, f"{module.profile.name} has one type only")
    return int(module.chance.choice(types))


def _other_mask(first: int) -> Other:
    """Return a mask with one channel switched, of the 16 from `first` on.

    Errors: `Skipped` if the connecting mode has none of these channels.
    """

    def other(module: Subject, value: int) -> int:
        most = 8 if module.model is Model.M_7018_16 else 16  # E12
        channels = module.channels[first : first + most]
        if not channels:
            raise Skipped(SkipReason.NOT_APPLICABLE, f"{module.profile.name} has no channel {first} in this mode")
        return value ^ 1 << module.chance.choice(channels) - first

    return other


_OTHERS: Mapping[str, Other] = {
    "type_code": _other_type,
    "module_type_code": _other_type,
    "temperature_offset": _one_of(-5, 6),
    "cjc_offset": lambda module, value: _one_of(*((0xFB, 6) if module.model.series == "7018" else (-300, 301)))(
        module, value
    ),
    "module_cjc_offset": _one_of(-300, 301),
    "channel_mask": _other_mask(0),
    "channel_mask_high": _other_mask(16),
    "cjc_update": _one_of(0, 1),
    "log_command": _one_of(2),
    "log_period_hour": _one_of(7, 8),
    "log_period_minute": _one_of(9, 10),
    "log_period_second": _one_of(11, 12),
    **{f"log_{end}_year": _one_of(year, year + 1) for end, year in (("start", 2150), ("end", 2155))},
    **{f"log_{end}_{part}": _one_of(2, 3) for end in ("start", "end") for part in ("month", "date", "hour")},
    **{f"log_{end}_{part}": _one_of(4, 5) for end in ("start", "end") for part in ("minute", "second")},
    "line_settings": lambda _, value: value ^ 0x01 if 0x04 <= value & 0x3F <= 0x09 else value & 0xC0 | 0x06,
    "response_delay": _one_of(10, 12),
    "host_watchdog_timeout": _one_of(250, 240),
}
"""Other values of the rows whose items are more than a switch. Periods of the log that begin after the year 2149 make
no records.
"""


def other_value(module: Subject, row: Register, value: int) -> int:
    """Return another value for an item of a row than the one that it has.

    Errors: `Skipped` if the module has no other.
    """
    return _OTHERS.get(row.name, _flipped)(module, value)


# --- written, read back and restored ----------------------------------------------------------------------------------


def _one_written(area: Area, name: str, module: Subject) -> Procedure[None]:
    """Write one item of a row: one channel, whose neighbours must stay as they are."""
    row = row_of(module, area, name)
    before = yield from read_row(module, row)
    channels = min(row.count, len(module.channels))
    at = module.chance.randrange(channels)
    new = (*before[:at], other_value(module, row, before[at]), *before[at + 1 :])
    put = partial(put_and_read, module, row, at)
    yield from changed_and_restored(module, put(new), partial(put, before))


def put_and_read(module: Subject, row: Register, at: int, values: Sequence[int]) -> Procedure[None]:
    """Write the item at a place of a row, and read all items of it, which must be `values`."""
    request = write_of(row, at, values[at : at + 1])(module.address)
    yield from module.expect(request)
    _compare(module, row.kind, (yield from read_row(module, row)), values)


def _compare(module: Subject, kind: Kind, found: Sequence[int], values: Sequence[int]) -> None:
    """Compare what the module answered last with the values of items.

    Errors: `Difference`.
    """
    mask = 0xFF if kind is Kind.INT8 else 0xFFFF  # the high byte is open (E62)
    if [it & mask for it in found] != [it & mask for it in values]:
        text = f"reads back as {' '.join(f'{it:X}' for it in found)}"
        raise module.wrong(text, *module.exchange(), " ".join(f"{it:X}" for it in values))


def _block_written(area: Area, names: Sequence[str], module: Subject) -> Procedure[None]:
    """Write neighbours with one request: those of some rows that the module has."""
    found = (row_with(module, area, name) for name in names)
    rows = [row for row in found if row is not None]
    before = yield from items(module, area, rows[0].address, len(rows))
    if rows[0].name == "log_command":
        _check_stopped(before[0])
    new = tuple(other_value(module, row, value) for row, value in zip(rows, before, strict=True))
    put = partial(_put_all, module, rows)
    yield from changed_and_restored(module, put(new), partial(put, before))


def _check_stopped(command: int) -> None:
    """Raise `Unclear` if the data logger runs."""
    if command:
        raise Unclear("the data logger runs, and a change of its clock or settings would disturb it")


def _put_all(module: Subject, rows: Sequence[Register], values: Sequence[int]) -> Procedure[None]:
    """Write and read items of several rows."""
    area, start = rows[0].area, rows[0].address
    request: Any
    if area is Area.COIL:
        request = modbus.WriteMultipleCoils(module.address, start, tuple(map(bool, values)))
    else:
        request = modbus.WriteMultipleRegisters(module.address, start, tuple(values))
    yield from module.expect(request)
    _compare(module, rows[0].kind, (yield from items(module, area, start, len(rows))), values)


def _cleared(area: Area, name: str, module: Subject) -> Procedure[None]:
    """Clear a counter or a state that is clear: any other would be lost."""
    row = row_of(module, area, name)
    (before,) = yield from read_row(module, row)
    if before:
        raise Unclear(f"{name} is {before}; clearing it would lose that")
    request = write_of(row, 0, (row.cleared_by or 0,))(module.address)
    yield from module.expect(request)
    _compare(module, row.kind, (yield from read_row(module, row)), (0,))


def _pair_written(area: Area, name: str, module: Subject) -> Procedure[None]:
    """Write both registers of a 32-bit number; the order of its words is open (E75)."""
    row = row_of(module, area, name)
    before = yield from read_row(module, row)
    put = partial(_put_and_read_pair, module, row)
    yield from changed_and_restored(module, put((before[0] ^ 1, before[1])), partial(put, before))


def _put_and_read_pair(module: Subject, row: Register, values: Sequence[int]) -> Procedure[None]:
    request = modbus.WriteMultipleRegisters(module.address, row.address, tuple(values))
    yield from module.expect(request)
    _compare(module, row.kind, (yield from read_row(module, row)), values)


# --- the clock of the data logger -------------------------------------------------------------------------------------

_DATE = ("year", "month", "date", "hour", "minute", "second")
_SOME_DAY = datetime(2040, 2, 28, 23, 59, 30)  # noqa: DTZ001 - the clock has no time zone
_EPOCH = datetime(1970, 1, 1)  # noqa: DTZ001
_SLOW = 5
"""The seconds by which a clock may be off when it is read."""


def _clock_written(module: Subject) -> Procedure[None]:
    """Set the clock by the parts of a date."""
    yield from _clock_set_by(module, _set_parts)


def _epoch_written(module: Subject) -> Procedure[None]:
    """Set the clock by its seconds, and read the date."""
    yield from _clock_set_by(module, _set_epoch)


def _clock_set_by(module: Subject, by: Callable[[Subject, datetime], Procedure[None]]) -> Procedure[None]:
    holding = Area.HOLDING_REGISTER
    _check_stopped(*(yield from read_row(module, row_of(module, holding, "log_command"))))
    began = yield from _clock(module)
    read_at = module.now

    def restore() -> Procedure[None]:
        yield from _set_parts(module, began + timedelta(seconds=round(module.now - read_at)))

    yield from changed_and_restored(module, by(module, _SOME_DAY), restore)


def _clock(module: Subject) -> Procedure[datetime]:
    start = row_of(module, Area.HOLDING_REGISTER, "rtc_year").address
    year, month, date, hour, minute, second = yield from items(module, Area.HOLDING_REGISTER, start, len(_DATE))
    try:
        return datetime(year, month, date, hour, minute, second)  # noqa: DTZ001
    except ValueError:
        raise Unclear(f"the clock has no such date: {year}-{month}-{date} {hour}:{minute}:{second}") from None


def _set_parts(module: Subject, date: datetime) -> Procedure[None]:
    start = row_of(module, Area.HOLDING_REGISTER, "rtc_year").address
    parts = date.timetuple()[: len(_DATE)]
    yield from _set_clock(module, modbus.WriteMultipleRegisters(module.address, start, parts), date)


def _set_epoch(module: Subject, date: datetime) -> Procedure[None]:
    seconds = int((date - _EPOCH).total_seconds())
    big_endian = module.twin.state.eeprom.big_endian
    request = modbus.RegisterMap(module.profile).write(module.address, "rtc_epoch", seconds, big_endian=big_endian)
    yield from _set_clock(module, request, date)


def _set_clock(module: Subject, request: modbus.Request[Any], date: datetime) -> Procedure[None]:
    yield from module.expect(request)
    found = yield from _clock(module)
    if abs((found - date).total_seconds()) > _SLOW:
        raise module.wrong(f"the clock is {found}", *module.exchange(), f"{date}")


# --- what can lose the module -----------------------------------------------------------------------------------------


def _watchdog_written(module: Subject) -> Procedure[None]:
    """Set the timeout of the host watchdog, and switch it on or off; it cannot time out meanwhile."""
    timeout = row_of(module, Area.HOLDING_REGISTER, "host_watchdog_timeout")
    switch = row_of(module, Area.COIL, "host_watchdog_enabled")
    (seconds,) = yield from read_row(module, timeout)
    (on,) = yield from read_row(module, switch)

    def change() -> Procedure[None]:
        yield from put_and_read(module, timeout, 0, (other_value(module, timeout, seconds),))
        yield from put_and_read(module, switch, 0, (1 - on,))

    def restore() -> Procedure[None]:
        yield from put_and_read(module, switch, 0, (on,))
        yield from put_and_read(module, timeout, 0, (seconds,))

    yield from changed_and_restored(module, change(), restore, 2)


def _address_written(module: Subject) -> Procedure[None]:
    row = row_of(module, Area.HOLDING_REGISTER, "module_address")
    yield from address_changed(module, lambda address, new: write_of(row, 0, (new,))(address))


_CALIBRATION_PAUSE = 3.0


def _calibration_loaded(module: Subject) -> Procedure[None]:
    row = row_of(module, Area.COIL, "load_factory_calibration")
    request = write_of(row, 0, (1,))(module.address)
    yield from module.expect(request)
    yield from module.wait(_CALIBRATION_PAUSE)
    yield from module.alive(module.wire(request))


# --- what is refused --------------------------------------------------------------------------------------------------


def _not_written(area: Area, names: Sequence[str], module: Subject) -> Procedure[None]:
    """Write values beyond the limits of rows: each is refused, and changes nothing.

    Shape: ``NAME`` is the value above the largest, ``NAME-`` the one below the smallest.
    """
    wrong = []
    for name in names:
        row = row_with(module, area, name.rstrip("-"))
        value = None if row is None else _beyond(module, row, below=name.endswith("-"))
        if row is not None and value is not None:
            wrong.append((row, value))
    if not wrong:
        raise Skipped(SkipReason.NOT_APPLICABLE, f"{module.profile.name} has all values of {', '.join(names)}")
    for row, value in wrong:
        yield from _not_accepted(module, row, value)


_UNDEFINED_TYPE = 0x7F


def _beyond(module: Subject, row: Register, *, below: bool) -> int | None:
    """Return a value that a row cannot have; None if it can have all 16 bits."""
    if row.values is TypeCode:
        return next((int(code) for code in TypeCode if not module.profile.supports(code)), _UNDEFINED_TYPE)
    if row.kind is Kind.INT8:
        return 0x100
    if below:
        return (row.minimum or 0) - 1
    return None if row.maximum in (None, 0xFFFF) else row.maximum + 1


def _not_accepted(module: Subject, row: Register, value: int) -> Procedure[None]:
    """Write a value that a row cannot have; if it is taken, restore the one before."""
    before = yield from read_row(module, row)
    request = write_of(row, 0, (value,))(module.address)
    try:
        yield from refused(module, module.wire(request)[1:-2], ADDRESS_OR_VALUE)
        _compare(module, row.kind, (yield from read_row(module, row)), before)
    except Reason:
        with suppress(Reason):
            yield from put_and_read(module, row, 0, before)
        raise


def _read_only(area: Area, name: str, module: Subject) -> Procedure[None]:
    """Write to a row that can only be read."""
    request = write_of(row_of(module, area, name), 0, (1,))(module.address)
    yield from refused(module, module.wire(request)[1:-2], ADDRESS_OR_VALUE)


# --- the checks -------------------------------------------------------------------------------------------------------

_COIL, _HOLDING = Area.COIL, Area.HOLDING_REGISTER
_LOG = (
    "log_command",
    "log_overwrite",
    *(f"log_period_{part}" for part in _DATE[3:]),
    *(f"log_{end}_{part}" for end in ("start", "end") for part in _DATE),
)
_CLOCK = tuple(f"rtc_{part}" for part in _DATE)

_ALONE: Mapping[str, Area] = {
    **dict.fromkeys(
        (
            "type_code", "module_type_code", "temperature_offset", "cjc_offset", "cjc_update", "channel_mask_high",
            "line_settings", "response_delay",
        ),
        _HOLDING,
    ),
    **dict.fromkeys(
        (
            "filter", "host_watchdog_mode", "cjc_enabled", "modbus_data_format", "fast_mode", "sampling_rate",
            "open_wire_detection", "single_ended", "big_endian", "protocol",
        ),
        _COIL,
    ),
}  # fmt: skip
"""The rows that are written alone."""
_TOGETHER: Mapping[str, tuple[Area, tuple[str, ...]]] = {
    "channels": (_HOLDING, ("channel_mask", "module_cjc_offset")),
    "coils": (_COIL, ("filter", "host_watchdog_mode")),
    "log": (_HOLDING, _LOG),
}
"""The rows that are written with one request: neighbours, of which a module may not have the first or the last."""
_OTHERWISE: Mapping[str, tuple[tuple[tuple[Area, str], ...], Steps]] = {
    "host_watchdog_timeout_count": (
        ((_HOLDING, "host_watchdog_timeout_count"),),
        partial(_cleared, _HOLDING, "host_watchdog_timeout_count"),
    ),
    "host_watchdog_timed_out": (
        ((_COIL, "host_watchdog_timed_out"),),
        partial(_cleared, _COIL, "host_watchdog_timed_out"),
    ),
    "log_read_index": (((_HOLDING, "log_read_index"),), partial(_pair_written, _HOLDING, "log_read_index")),
    "clock": (tuple((_HOLDING, name) for name in _CLOCK), _clock_written),
    "rtc_epoch": (((_HOLDING, "rtc_epoch"),), _epoch_written),
    "host_watchdog": (((_HOLDING, "host_watchdog_timeout"), (_COIL, "host_watchdog_enabled")), _watchdog_written),
    "module_address": (((_HOLDING, "module_address"),), _address_written),
    "load_factory_calibration": (((_COIL, "load_factory_calibration"),), _calibration_loaded),
}
"""The rows that are written in a way of their own."""
_BEYOND: Mapping[str, tuple[str, ...]] = {
    **{name: (name,) for name in ("type_code", "module_type_code", "temperature_offset", "cjc_offset", "cjc_update")},
    **{name: (name,) for name in ("channel_mask_high", "line_settings", "response_delay")},
    "channels": ("channel_mask", "module_cjc_offset"),
    "log": (
        "log_command", "log_overwrite", "log_period_minute", "log_start_month-", "log_start_hour", "log_end_date",
        "log_end_second", "log_end_year",
    ),
    "clock": ("rtc_month", "rtc_date-", "rtc_second"),
    "host_watchdog": ("host_watchdog_timeout",),
    "module_address": ("module_address-", "module_address"),
}  # fmt: skip
"""The values that are refused, by the check whose negative half it is; all are holding registers."""
_READ_ONLY: tuple[tuple[Area, str], ...] = (
    (_COIL, "range_status"),
    (_COIL, "reset_status"),
    *((_HOLDING, name) for name in ("analog_input", "temperature", "cjc_temperature", "firmware_version")),
    *((_HOLDING, name) for name in ("module_name", "log_last_index", "log_status", "log_records")),
)

WRITTEN: Mapping[str, tuple[tuple[Area, str], ...]] = {
    **{f"map/write/{name}": ((area, name),) for name, area in _ALONE.items()},
    **{f"map/write/{name}": tuple((area, row) for row in names) for name, (area, names) in _TOGETHER.items()},
    **{f"map/write/{name}": rows for name, (rows, _) in _OTHERWISE.items()},
}
"""The rows that each check writes."""

STEPS: dict[str, Steps] = {
    **{f"map/write/{name}": partial(_one_written, area, name) for name, area in _ALONE.items()},
    **{f"map/write/{name}": partial(_block_written, area, names) for name, (area, names) in _TOGETHER.items()},
    **{f"map/write/{name}": steps for name, (_, steps) in _OTHERWISE.items()},
    **{f"map/write/{name}-n1": partial(_not_written, _HOLDING, names) for name, names in _BEYOND.items()},
    **{f"map/read-only/{area.name.lower()}/{name}": partial(_read_only, area, name) for area, name in _READ_ONLY},
}
