"""``NAME field=value ...`` -> a message, and the frame of it.

Notation: numbers are decimal, or hex as 0x3A or 3Ah; what has a unit is in that unit, or in counts where it is hex. A
mask can also be given as its channels, and the bytes CC and FF by their parts. What stands for coils and registers is
read in `by_register` if the model is known.
"""

import re
from collections.abc import Callable, Sequence
from enum import Enum
from functools import partial
from typing import Any, get_args

from attrs import evolve

from i7000 import (
    CharacterFormat,
    DataFormat,
    Filter,
    InvalidValueError,
    Model,
    Profile,
    dcon,
    describe,
    modbus,
)
from i7000.cli.by_register import is_of_registers, take_fields
from i7000.cli.choices import chosen
from i7000.cli.numbers import baud_rate, hex_byte, integer, is_hex
from i7000.cli.records import parts_of
from i7000.cli.refusals import as_written
from i7000.cli.units import counts, scale_of
from i7000.cli.words import UsageError, near, plain, truth, type_code
from i7000.dissect import Known
from i7000.dissect.words import models_words
from i7000.message import Message

__all__ = ["DCON", "MODBUS", "encode", "find", "frame_text", "make", "refusal_words", "registers"]

DCON: tuple[type[Message], ...] = (
    *dcon.COMMANDS,
    *(command.response for command in dcon.COMMANDS if issubclass(command, dcon.Command)),
    dcon.Refused,
)
MODBUS: tuple[type[Message], ...] = (
    *modbus.REQUESTS,
    *(request.response for request in modbus.REQUESTS),
    modbus.ExceptionResponse,
)
"""The messages of each protocol; some names are in both."""


def registers(known: Known) -> modbus.RegisterMap | None:
    """Return the map of the model that is known, if it is.

    Errors: `UsageError` if it does not speak Modbus.
    """
    return modbus.RegisterMap(_decided(known).modbus[0]) if known.model else None


def _decided(known: Known) -> Known:
    """Return what is known, with the factory defaults that frames depend on."""
    return evolve(known, checksum=bool(known.checksum), single_ended=bool(known.single_ended))


def encode(message: Message, known: Known, *, force: bool) -> bytes:
    """Encode a message for the known model, or for all models if its frame is the same for all that have it.

    Errors: `InvalidValueError` if no module takes it, `UsageError` if the frame depends on the model.
    """
    known = _decided(known)
    by_dcon = (known.default,) if known.default else known.all
    profiles = known.modbus if isinstance(message, modbus.Message) else by_dcon
    frames: dict[bytes, list[Profile]] = {}
    refusals: list[tuple[Profile, InvalidValueError]] = []
    for profile in profiles:
        try:
            frames.setdefault(_encoded(message, profile, force=force), []).append(profile)
        except InvalidValueError as refusal:
            refusals.append((profile, refusal))
    if not frames:
        having = [(profile, refusal) for profile, refusal in refusals if message.availability not in profile.refused]
        raise _refusal(having or refusals[:1])
    first, *others = frames
    if others:
        ways = "; ".join(
            f"{frame_text(message, frame)} for {models_words((profile.model for profile in found), '')}"
            for frame, found in frames.items()
        )
        raise UsageError(f"the frame depends on the model, give --model: {ways}")
    return first


def _refusal(refusals: Sequence[tuple[Profile, InvalidValueError]]) -> InvalidValueError:
    """Return one refusal for all models: with what each of them allows, where that depends on the model."""
    models: dict[str, list[Model]] = {}
    for profile, refusal in refusals:
        allowed = refusal.allowed.removesuffix(f" on {profile.model.value}")
        models.setdefault(allowed, []).append(profile.model)
    (profile, first), *_ = refusals
    words = "; ".join(f"{allowed} on {models_words(having, '')}" for allowed, having in models.items())
    if not first.allowed.endswith(f" on {profile.model.value}") or len(words) > _LONGEST_ALLOWED:
        return first
    return InvalidValueError(first.field, first.value, words, first.section, first.reason)


_LONGEST_ALLOWED = 400
"""The characters of what all models allow; if there are more, that of the first model stands for it."""


def _encoded(message: Message, profile: Profile, *, force: bool) -> bytes:
    if isinstance(message, modbus.Message):
        return modbus.encode(message, profile, force=force)
    return dcon.encode(message, profile, force=force)  # type: ignore[arg-type] # it is one of the two


def refusal_words(refusal: InvalidValueError, kind: type[Message], assignments: Sequence[str]) -> str:
    """Return why a message is refused, with the value as it was written.

    >>> refusal = InvalidValueError("timeout", 300, "00..FF", "2.39")
    >>> refusal_words(refusal, dcon.SetHostWatchdogTimeout, ["address=1", "timeout=30s"])
    'timeout cannot be 30s: 0..25.5 s in steps of 0.1, manual 2.39'
    """
    written = dict(assignment.split("=", 1) for assignment in assignments)
    field = refusal.field
    if field not in written:
        return str(refusal)
    scale = scale_of(kind, field, channel=written.get("channel", "0") != "0") if field in parts_of(kind) else None
    allowed = _readable(refusal.allowed)
    limits = _LIMITS.fullmatch(refusal.allowed)
    if scale and limits and not is_hex(written[field]):
        base = 16 if limits["hex"] or refusal.allowed == _BYTE else 10
        low, high = (int(limits[end], base) / scale.per_unit for end in ("low", "high"))
        allowed = f"{low:g}..{high:g} {scale.unit} in steps of {1 / scale.per_unit:g}"
    elif scale and scale.unit not in allowed:
        allowed += f", counts of {1 / scale.per_unit:g} {scale.unit}"
    return str(as_written(refusal, field, written[field], allowed))


_BYTE = "00..FF"
_LIMITS = re.compile(r"(?P<low>[+-]?[0-9A-F]+)\.\.(?P<high>[+-]?[0-9A-F]+)(?:(?P<hex> in hex)| counts of .*)?")
"""Limits of a count."""


def _readable(allowed: str) -> str:
    """Return what is allowed, with bytes as they are written at the terminal."""
    return allowed.replace(_BYTE, "0..255 or 00h..FFh")


def frame_text(message: Message, frame: bytes) -> str:
    """Return a frame as people write it: DCON as text, Modbus in hex."""
    return frame.hex(" ").upper() if isinstance(message, modbus.Message) else frame[:-1].decode()


def make(
    kind: type[Message],
    assignments: Sequence[str],
    registers: modbus.RegisterMap | None = None,
    *,
    force: bool = False,
) -> Message:
    """Make a message; with `registers`, what it reads and writes is that of this map, unless `force`.

    Errors: `UsageError` for what cannot be understood, `InvalidValueError` for a value that no such message has.

    >>> make(dcon.SetChannelMask, ("address=1", "channels=1,3,4,5"))
    SetChannelMask(address=0x01, mask=0x3A)
    """
    given = _given(kind, assignments)
    values = take_fields(kind, given, registers, force=force) if is_of_registers(kind) else {}
    missing = []
    for field, attribute in parts_of(kind).items():
        parts = _parts(kind, field)
        if parts and not given.keys().isdisjoint((field, *parts)):
            values[field] = _assemble(field, get_args(attribute.type)[0], parts, given)
        elif field in given:
            scale = scale_of(kind, field, channel=bool(values.get("channel")))
            read = _reader(get_args(attribute.type)[0]) if scale is None else partial(counts, scale=scale)
            values[field] = _named(field, given[field], read)
        elif field not in values:
            missing.append(f"{field}=... ({_writing(kind, field)})")
    if missing:
        raise UsageError(f"{kind.__name__} needs {', '.join(missing)}")
    return kind(**values)


def _writing(kind: type[Message], field: str) -> str:
    """Return how the values of a field are written."""
    values, part = get_args(parts_of(kind)[field].type)
    scale = scale_of(kind, field, channel=False)
    how: str = "with commas between" if values in _LISTS else _readable(part.allowed)
    parts = _parts(kind, field)
    if parts:
        how = f"a number, or {' '.join(f'{name}=...' for name in parts)}"
    elif scale:
        how = f"a number, in {scale.unit}"
    elif values is bool:
        how = "true or false"
    elif isinstance(values, type) and issubclass(values, Enum):
        how = ", ".join(one.name.lower() for one in values)
    elif _reader(values) is type_code:
        how = "two hex digits or a name such as K"
    return how


def _given(kind: type[Message], assignments: Sequence[str]) -> dict[str, str]:
    """Read ``field=value``: what is given for each field, or part of a field."""
    known = [one for field in parts_of(kind) for one in (field, *_parts(kind, field))]
    given: dict[str, str] = {}
    for assignment in assignments:
        field, equals, value = assignment.partition("=")
        if not equals:
            raise UsageError(f"{assignment!r} is not field=value; the fields of {kind.__name__} are {', '.join(known)}")
        if field not in known:
            raise UsageError(
                f"{kind.__name__} has no field {field!r}; its fields are {', '.join(known)}{near(field, known)}"
            )
        if field in given:
            raise UsageError(f"{field} is given twice")
        given[field] = value
    return given


def find(name: str, kinds: Sequence[type[Message]]) -> type[Message]:
    """Find a message by its name, in any spelling.

    Errors: `UsageError`.
    """
    named = {kind.__name__.lower(): kind for kind in reversed(kinds)}  # the first of two with one name
    wanted = plain(name)
    if wanted not in named:
        other, protocol = (MODBUS, "rtu") if kinds is DCON else (DCON, "dcon")
        if any(kind.__name__.lower() == wanted for kind in other):
            raise UsageError(f"{name} is a message of the other protocol: add --protocol {protocol}")
        hint = near(name, [kind.__name__ for kind in kinds])
        if name[:1] in ("$", "#", "%", "~", "@", "!", ">", "?"):
            hint = "; that is a frame, and i7000 decode reads it"
        raise UsageError(f"there is no command or response {name!r}{hint or ': i7000 commands lists them'}")
    return named[wanted]


def _named(field: str, text: str, read: Callable[[str], Any]) -> Any:  # noqa: ANN401 - of any field
    try:
        return read(text)
    except UsageError as error:
        raise UsageError(f"{field}: {error}") from None


def _reader(kind: Any) -> Callable[[str], Any]:  # noqa: ANN401 - a type
    """Choose how to read the text of a field with values of this type."""
    if isinstance(kind, type) and issubclass(kind, Enum):
        return lambda text: chosen(text, kind)
    return _LISTS.get(kind) or _READERS.get(kind, type_code)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise UsageError(f"{text!r} is not a number") from None


def _hex(text: str) -> bytes:
    try:
        return bytes.fromhex(text)
    except ValueError:
        raise UsageError(f"{text!r} is not bytes in hex, two digits each") from None


_READERS: dict[Any, Callable[[str], Any]] = {
    bool: truth,
    int: integer,
    float: _number,
    str: str,
    bytes: _hex,
}
_LISTS: dict[Any, Callable[[str], Any]] = {
    tuple[str, ...]: lambda text: tuple(text.split(",")),
    tuple[int, ...]: lambda text: tuple(map(integer, text.split(","))),
    tuple[bool, ...]: lambda text: tuple(map(truth, text.split(","))),
}

# --- values that are made of parts ------------------------------------------------------------------------------------


def _channels(text: str) -> int:
    """Read channels and ranges of channels as a mask."""
    found: set[int] = set()
    for part in filter(None, map(str.strip, text.split(","))):
        first, dash, last = part.partition("-")
        ends = (integer(first), integer(last if dash else first))
        dcon.mask_of(ends)  # which refuses what no module has, however large
        if ends[0] > ends[1]:
            raise UsageError(f"{part} has no channel: write {last}-{first}")
        found.update(range(ends[0], ends[1] + 1))
    return dcon.mask_of(found)


_Readers = dict[str, Callable[[str], Any]]
_PARTS: dict[Callable[..., str], _Readers] = {
    describe.mask: {"channels": _channels},
    describe.line_settings: {"baud_rate": baud_rate, "character_format": _reader(CharacterFormat)},
    describe.report_settings: {
        "data_format": _reader(DataFormat),
        "checksum": truth,
        "fast_mode": truth,
        "filter": _reader(Filter),
        "reserved": integer,
    },
}
"""The parts of a value that can be given by themselves, by what describes the field that has it."""


def _parts(kind: type[Message], field: str) -> _Readers:
    """Return the parts of a field, with how each is read; empty if it has none."""
    return _PARTS.get(get_args(parts_of(kind)[field].type)[1].describe, {})


def _assemble(field: str, kind: Any, readers: _Readers, given: dict[str, str]) -> Any:  # noqa: ANN401 - a type
    """Take what belongs to `field` out of `given`: the whole, its parts, or the whole with parts changed."""
    whole = given.pop(field, None)
    parts = {name: _named(name, given.pop(name), read) for name, read in readers.items() if name in given}
    if kind is int:
        if whole is None:
            return parts["channels"]
        if parts:
            raise UsageError(f"{field} and channels mean the same: give one of them")
        return _named(field, whole, integer)
    return evolve(kind() if whole is None else kind.from_byte(_named(field, whole, hex_byte)), **parts)
