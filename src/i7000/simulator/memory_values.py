"""The EEPROMs of modules as plain JSON values, and back: the values of each field, and the place of an error.

Laws: invalid values are never converted, and no value is left out; the error has the place of the first fault.
"""

import json
import re
import struct
from collections.abc import Callable, Iterable
from enum import Enum
from reprlib import Repr
from typing import Any, get_args, get_origin

from attrs import fields, frozen, has
from cattrs import AttributeValidationNote, BaseValidationError, Converter, IterableValidationNote
from cattrs.gen import make_dict_structure_fn, make_dict_unstructure_fn, override

from i7000 import (
    BaudRate,
    CharacterFormat,
    DataFormat,
    Filter,
    Firmware,
    InvalidValueError,
    LineSettings,
    ModbusDataFormat,
    Model,
    Protocol,
    ReportSettings,
    TypeCode,
)
from i7000.device import Eeprom, Log, LogCommand, Record

__all__ = ["FAULTS", "Odd", "WrongError", "check_names", "error_words", "short", "structured", "unstructured"]

_LAST_MOMENT = 10**12
"""The maximum difference of a clock from 1970, in seconds."""


# --- errors -----------------------------------------------------------------------------------------------------------


class WrongError(ValueError):
    """An error without its place; the hooks around it add the place."""

    def __init__(self, reason: str, allowed: str, place: str = "") -> None:
        super().__init__(reason)
        self.reason, self.allowed, self.place = reason, allowed, place


@frozen(repr=False)
class Odd:
    """A JSON value that is never valid in a file; it is refused at its place."""

    words: str

    def __repr__(self) -> str:
        return self.words


FAULTS = (WrongError, InvalidValueError, BaseValidationError)
"""The errors that `structured` raises."""


def error_words(error: Exception) -> tuple[str, str, str]:
    """Return the place of the first fault, the fault, and what is allowed there."""
    place = ""
    while True:
        for note in reversed(getattr(error, "__notes__", [])):
            place += f".{note.name}" if isinstance(note, AttributeValidationNote) else f"[{note.index}]"
        if not isinstance(error, BaseValidationError):
            break
        error = error.exceptions[0]
    if isinstance(error, InvalidValueError):
        place += f".{error.field}"
        words = error.reason or f"cannot be {short(error.value)}", f"{error.allowed} (manual {error.section})"
    else:
        assert isinstance(error, WrongError)  # noqa: S101 - no hook raises another
        place += f".{error.place}" if error.place else ""
        words = error.reason, error.allowed
    return place.removeprefix(".") or "the document", *words


def check_names(value: dict[str, Any], names: Iterable[str], optional: Iterable[str] = ()) -> None:
    """Raise `WrongError` for an object with missing or other names."""
    for name in names:
        if name not in value:
            raise WrongError(f"has no {name!r}", f"an object with {', '.join(names)}")
    for name in value:
        if name not in (*names, *optional):
            raise WrongError(f"has {short(name)}", f"an object with {', '.join(names)} and nothing else")


_REPR = Repr()
_REPR.maxstring = _REPR.maxother = 60


def short(value: object) -> str:
    """Return a value as text, shortened if it is long."""
    return _REPR.repr(value)


def _no(value: object, allowed: str) -> WrongError:
    return WrongError(f"cannot be {short(value)}", allowed)


# --- values -----------------------------------------------------------------------------------------------------------


def structured(modules: Any) -> tuple[Eeprom, ...]:  # noqa: ANN401 - any JSON
    """Return the EEPROMs of a list.

    Errors: `FAULTS`; `error_words` describes them in words.
    """
    try:
        found: tuple[Eeprom, ...] = _CONVERTER.structure(modules, tuple[Eeprom, ...])
    except FAULTS as error:
        error.add_note(AttributeValidationNote("", "modules", list))
        raise
    return found


def unstructured(eeproms: Iterable[Eeprom]) -> list[Any]:
    """Return EEPROMs as plain values: the inverse of `structured`."""
    return [_CONVERTER.unstructure(eeprom) for eeprom in eeproms]


_Hook = Callable[[Any, Any], Any]


def _exactly(kind: type, words: str) -> _Hook:
    def structure(value: Any, _: object) -> Any:  # noqa: ANN401
        if type(value) is not kind:
            raise _no(value, words)
        return value

    return structure


def _moment(value: Any, _: object) -> float:  # noqa: ANN401
    if type(value) not in (int, float) or not abs(value) <= _LAST_MOMENT:
        raise _no(value, f"a number of seconds, -{_LAST_MOMENT}..{_LAST_MOMENT}")
    return float(value)


def _firmware(value: Any, _: object) -> Firmware:  # noqa: ANN401
    try:
        return Firmware(value)
    except InvalidValueError as error:
        raise _no(value, error.allowed) from None


def _hex(pattern: str, words: str) -> _Hook:
    allowed = re.compile(pattern)

    def structure(value: Any, _: object) -> int:  # noqa: ANN401
        if not isinstance(value, str) or not allowed.fullmatch(value):
            raise _no(value, words)
        return int(value, 16)

    return structure


_WORDS = re.compile(r"[0-9A-F]{4}(?: [0-9A-F]{4}){15}")


def _words(value: Any, _: object) -> tuple[int, ...]:  # noqa: ANN401
    if not isinstance(value, str) or not _WORDS.fullmatch(value):
        raise _no(value, "16 words of 4 hex digits, one blank between")
    return struct.unpack(">16H", bytes.fromhex(value))


def _label(member: Enum) -> str | int:
    """Return the readable form of a coded value."""
    if isinstance(member, TypeCode):
        return f"{member:02X}"
    if isinstance(member, BaudRate):
        return member.bits_per_second
    if isinstance(member, CharacterFormat):
        return member.name
    return str(member.value) if isinstance(member, Model) else member.name.lower()


def _labelled(kind: type[Enum]) -> _Hook:
    members = {_label(member): member for member in kind}

    def structure(value: Any, _: object) -> Enum:  # noqa: ANN401
        if type(value) not in (str, int) or value not in members:
            raise _no(value, ", ".join(map(json.dumps, members)))
        return members[value]

    return structure


def _listed(kind: Any, converter: Converter) -> _Hook:  # noqa: ANN401 - a tuple of something
    """Return a tuple of items of one type: of any length, or of a fixed one."""
    item, *others = get_args(kind)
    length = None if others == [...] else 1 + len(others)
    structure_item = converter.get_structure_hook(item)

    def structure(value: Any, _: object) -> tuple[Any, ...]:  # noqa: ANN401
        if not isinstance(value, list | tuple) or length not in (None, len(value)):
            raise _no(value, "a list" if length is None else f"a list of {length}")
        found = []
        for at, one in enumerate(value):
            try:
                found.append(structure_item(one, item))
            except FAULTS as error:
                error.add_note(IterableValidationNote("", at, item))
                raise
        return tuple(found)

    return structure


def _with_all_names(kind: type[Any], converter: Converter) -> _Hook:
    """Return an object that must have all fields of a class and no others."""
    overrides: Any = _OVERRIDES.get(kind, {})
    names = [it.name for it in fields(kind) if not (it.name in overrides and overrides[it.name].omit)]
    structure_fields: Any = make_dict_structure_fn(kind, converter, **overrides)

    def structure(value: Any, _: object) -> Any:  # noqa: ANN401
        if not isinstance(value, dict):
            raise _no(value, f"an object with {', '.join(names)}")
        check_names(value, names)
        return structure_fields(value, kind)

    return structure


def _without_omitted(kind: type[Any], converter: Converter) -> Callable[[Any], Any]:
    overrides: Any = _OVERRIDES.get(kind, {})
    return make_dict_unstructure_fn(kind, converter, **overrides)


def _is_tuple(kind: Any) -> bool:  # noqa: ANN401 - any type
    return get_origin(kind) is tuple


def _log(value: Any, _: object) -> Log:  # noqa: ANN401
    if value is None:
        return Log()
    log: Log = _CONVERTER.structure(value, Log)
    return log


_OVERRIDES = {
    Eeprom: {
        "address": override(struct_hook=_hex("[0-9A-F]{2}", "two hex digits"), unstruct_hook="{:02X}".format),
        "channel_mask": override(
            struct_hook=_hex("[0-9A-F]{6}", "six hex digits, channel 0 the lowest bit"), unstruct_hook="{:06X}".format
        ),
        "log": override(
            struct_hook=_log, unstruct_hook=lambda log: None if log == Log() else _CONVERTER.unstructure(log)
        ),
    },
    LineSettings: {"baud_rate": override(struct_hook=_labelled(BaudRate))},
    ReportSettings: {"data_format": override(struct_hook=_labelled(DataFormat)), "reserved": override(omit=True)},
    Record: {
        "words": override(
            struct_hook=_words, unstruct_hook=lambda words: struct.pack(f">{len(words)}H", *words).hex(" ", 2).upper()
        )
    },
}


_HOOKS: dict[Any, _Hook] = {
    int: _exactly(int, "a whole number"),
    bool: _exactly(bool, "true or false"),
    str: _exactly(str, "text"),
    float: _moment,
    Firmware: _firmware,
}


_ENUMS: tuple[type[Enum], ...] = (
    BaudRate, CharacterFormat, DataFormat, Filter, LogCommand, Model, ModbusDataFormat, Protocol, TypeCode,
)  # fmt: skip


def _make_converter() -> Converter:
    converter = Converter(detailed_validation=True)
    converter.register_structure_hook_factory(has, _with_all_names)
    converter.register_unstructure_hook_factory(has, _without_omitted)
    converter.register_structure_hook_factory(_is_tuple, _listed)
    for kind, structure in _HOOKS.items():
        converter.register_structure_hook(kind, structure)
    for enum in _ENUMS:
        converter.register_structure_hook(enum, _labelled(enum))
        converter.register_unstructure_hook(enum, _label)
    converter.register_unstructure_hook(Firmware, lambda firmware: firmware.text)
    return converter


_CONVERTER: Converter = _make_converter()
