"""Strategies for the address maps: rows, values, plans.

Laws: values are within the range of their row: `i7000.modbus.RegisterMap.write` accepts them if the row is writable,
and `decode` returns them.
"""

from collections.abc import Callable, Mapping
from typing import Any

from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import Firmware, LineSettings, Model, Profile, Reading, TypeCode
from i7000.modbus import Access, Kind, LogRecord, Plan, Register, RegisterMap
from i7000.strategies.modbus.messages import profiles
from i7000.strategies.vocabulary import firmwares, line_settings, supported_types, word_readings

__all__ = ["plans", "register_items", "register_maps", "register_values", "registers"]

_HIGHEST = {Kind.UINT32: 0xFFFFFFFF, Kind.INT16: 0x7FFF}


def register_maps() -> SearchStrategy[RegisterMap]:
    """Make address maps of modules with known types."""
    return profiles(known_types=True).map(RegisterMap)


def registers(
    profile: Profile | None = None, *, readable: bool = False, writable: bool = False
) -> SearchStrategy[Register]:
    """Make rows of the map of a module, or of any: all, `readable` or `writable` ones.

    Special: empty if there are no such rows: old firmware has no writable rows, an I-7000 module has no map.
    """
    if profile is None:
        return profiles().flatmap(lambda found: registers(found, readable=readable, writable=writable))
    refused = {Access.WRITE: readable, Access.READ: writable, Access.READ_WRITE: False}
    rows = [row for row in _rows(RegisterMap(profile)) if not refused[row.access]]
    return st.sampled_from(rows) if rows else st.nothing()


def _rows(found: RegisterMap) -> list[Register]:
    """Return the rows, ``analog_input`` first."""
    return sorted(found, key=lambda row: row.address)


@st.composite
def plans(draw: st.DrawFn) -> Plan:
    """Make plans to read some rows of a map, each by its name or by its first number."""
    found = draw(register_maps())
    wanted = draw(st.lists(registers(found.profile, readable=True), unique_by=lambda row: row.name, min_size=1))
    keys = [draw(st.sampled_from((row.name, row.number))) for row in wanted]
    return found.plan(draw(st.integers(1, 247)), keys)


def register_items(row: Register, profile: Profile) -> SearchStrategy[tuple[int, ...]]:
    """Make items of a row as a module may send them: any bits or words; bytes for rows with a zero high byte."""
    count = _items(row, profile)
    most = 0xFF if row.kind is Kind.INT8 else 0xFFFF
    return st.tuples(*[st.booleans() if row.area.bits else st.integers(0, most)] * count)


def register_values(row: Register, profile: Profile) -> SearchStrategy[Any]:
    """Make values of a row of the map of a module with known types: one, or one for each channel.

    Special: for rows that can only be cleared, the value that clears them.
    """
    count = _items(row, profile)
    if row.kind is Kind.READING:
        return st.tuples(*[word_readings(code, profile.modbus_data_format) for code in profile.type_codes[:count]])
    if row.kind is Kind.RECORD:
        readings = st.tuples(*[word_readings(code, profile.modbus_data_format) for code in profile.type_codes])
        return st.tuples(*[st.builds(LogRecord, readings, st.integers(0, 0xFFFFFFFF))] * (count // Kind.RECORD.width))
    single = _single(row, profile)
    return single if row.count == 1 or row.kind is Kind.UINT32 else st.tuples(*[single] * count)


def _items(row: Register, profile: Profile) -> int:
    """Return how many items are read at once: for channels, those of the connecting mode."""
    by_channel = row.count > 1 and row.kind not in (Kind.UINT32, Kind.RECORD)
    return min(row.count, profile.channels) if by_channel else row.count


def _single(row: Register, profile: Profile) -> SearchStrategy[Any]:
    if row.cleared_by is not None:
        return st.just(bool(row.cleared_by) if row.kind is Kind.BOOL else row.cleared_by)
    if row.values is TypeCode:
        return st.sampled_from(supported_types(profile))
    if row.values:
        return _TYPED[row.values](profile) if row.values in _TYPED else st.sampled_from(row.values)
    if row.kind is Kind.BOOL:
        return st.just(True) if row.minimum else st.booleans()
    signed = row.kind is Kind.INT16
    low = (-0x8000 if signed else 0) if row.minimum is None else row.minimum
    high = _HIGHEST.get(row.kind, 0xFFFF) if row.maximum is None else row.maximum
    counts = st.integers(low, high)
    return counts if row.scale in (None, 1) else counts.map(lambda count: count / round(1 / (row.scale or 1)))


_TYPED: Mapping[Any, Callable[[Profile], SearchStrategy[Any]]] = {
    LineSettings: line_settings,
    Firmware: lambda _: firmwares(),
    str: lambda _: st.sampled_from(sorted({model.series for model in Model})),
}
"""The strategies of types of values that are not enumerations."""


def _records() -> SearchStrategy[LogRecord]:
    return st.builds(LogRecord, st.tuples(*[st.from_type(Reading)] * 16), st.integers(0, 0xFFFFFFFF))


BY_KIND: Mapping[type, Callable[[], SearchStrategy[Any]]] = {
    LogRecord: _records,
    Plan: plans,
    Register: registers,
    RegisterMap: register_maps,
}
"""The strategies of the public classes that are not messages."""
