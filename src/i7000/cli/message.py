"""``NAME field=value ...`` -> a message, and the frame of it.

Notation: numbers are decimal, or hex as 0x3A; types and bytes of settings are hex, with or without 0x; a mask can also
be given as its channels, and the bytes CC and FF by their parts.
"""

from collections.abc import Callable, Sequence
from enum import Enum
from typing import Any, get_args

from attrs import evolve

from i7000 import CharacterFormat, DataFormat, EncodeError, Filter, LineSettings, Profile, ReportSettings, dcon, modbus
from i7000.cli.records import parts_of
from i7000.cli.words import UsageError, baud_rate, hex_byte, integer, member, near, truth, type_code
from i7000.dissect import Known
from i7000.dissect.words import models_words
from i7000.message import Message

__all__ = ["DCON", "MODBUS", "encode", "frame_text", "make"]

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


def encode(message: Message, known: Known, *, force: bool) -> bytes:
    """Write a message, for the model that is known or for all of them, if it is the same for all that have it.

    Errors: `EncodeError` if no module takes it, `UsageError` if the frame depends on the model.
    """
    known = evolve(known, checksum=bool(known.checksum), single_ended=bool(known.single_ended))
    by_dcon = (known.default,) if known.default else known.all
    profiles = known.modbus if isinstance(message, modbus.Message) else by_dcon
    frames: dict[bytes, list[Profile]] = {}
    refusals: list[EncodeError] = []
    for profile in profiles:
        try:
            frames.setdefault(_encoded(message, profile, force=force), []).append(profile)
        except EncodeError as refusal:
            refusals.append(refusal)
    if not frames:
        raise refusals[0]
    first, *others = frames
    if others:
        ways = "; ".join(
            f"{frame_text(message, frame)} for {models_words((profile.model for profile in found), '')}"
            for frame, found in frames.items()
        )
        raise UsageError(f"the frame depends on the model, give --model: {ways}")
    return first


def _encoded(message: Message, profile: Profile, *, force: bool) -> bytes:
    if isinstance(message, modbus.Message):
        return modbus.encode(message, profile, force=force)
    return dcon.encode(message, profile, force=force)  # type: ignore[arg-type] # it is one of the two


def frame_text(message: Message, frame: bytes) -> str:
    """A frame as people write it: DCON as text, Modbus in hex."""
    return frame.hex(" ").upper() if isinstance(message, modbus.Message) else frame[:-1].decode()


def make(name: str, assignments: tuple[str, ...], kinds: Sequence[type[Message]] = DCON) -> Message:
    """Make a message.

    Errors: `UsageError` for what cannot be understood, `EncodeError` for a value that no such message has.

    >>> make("set-channel-mask", ("address=1", "channels=1,3,4,5"))
    SetChannelMask(address=0x01, mask=0x3A)
    """
    kind = _find(name, kinds)
    given: dict[str, str] = {}
    for assignment in assignments:
        field, equals, value = assignment.partition("=")
        if not equals:
            raise UsageError(f"{assignment!r} is not field=value")
        if field in given:
            raise UsageError(f"{field} is given twice")
        given[field] = value
    values = {}
    missing = []
    for field, attribute in parts_of(kind).items():
        part = _PARTS.get(field)
        if part and not given.keys().isdisjoint((field, *part)):
            values[field] = _assemble(field, part, given)
        elif field in given:
            values[field] = _named(field, given.pop(field), _reader(attribute.type))
        else:
            missing.append(f"{field}=... ({attribute.type.__metadata__[0].allowed})")
    if given:
        known = [one for field in parts_of(kind) for one in (field, *_PARTS.get(field, ()))]
        unknown = next(iter(given))
        raise UsageError(f"{kind.__name__} has no {unknown}: {', '.join(known)}{near(unknown, known)}")
    if missing:
        raise UsageError(f"{kind.__name__} needs {', '.join(missing)}")
    return kind(**values)


def _find(name: str, kinds: Sequence[type[Message]]) -> type[Message]:
    plain = {kind.__name__.lower(): kind for kind in kinds}
    wanted = name.lower().replace("-", "").replace("_", "")
    if wanted not in plain:
        other, protocol = (MODBUS, "rtu") if kinds is DCON else (DCON, "dcon")
        if any(kind.__name__.lower() == wanted for kind in other):
            raise UsageError(f"{name} is of the other protocol: --protocol {protocol}")
        close = [plain[word].__name__ for word in plain if wanted and wanted in word]
        hint = f"; did you mean {' or '.join(close)}?" if close else near(name, [kind.__name__ for kind in kinds])
        raise UsageError(f"there is no {name!r}{hint}")
    return plain[wanted]


def _named(field: str, text: str, read: Callable[[str], Any]) -> Any:  # noqa: ANN401 - of any field
    try:
        return read(text)
    except UsageError as error:
        raise UsageError(f"{field}: {error}") from None


def _reader(annotation: Any) -> Callable[[str], Any]:  # noqa: ANN401 - the type of a field
    """Choose how to read the text of a field."""
    kind = get_args(annotation)[0]
    if isinstance(kind, type) and issubclass(kind, Enum):
        return lambda text: member(text, kind)
    return _READERS.get(kind, type_code)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise UsageError(f"{text!r} is no number") from None


def _hex(text: str) -> bytes:
    try:
        return bytes.fromhex(text)
    except ValueError:
        raise UsageError(f"{text!r} is no bytes in hex") from None


_READERS: dict[Any, Callable[[str], Any]] = {
    bool: truth,
    int: integer,
    float: _number,
    str: str,
    bytes: _hex,
    tuple[str, ...]: lambda text: tuple(text.split(",")),
    tuple[int, ...]: lambda text: tuple(map(integer, text.split(","))),
    tuple[bool, ...]: lambda text: tuple(map(truth, text.split(","))),
}

# --- values that are made of parts ------------------------------------------------------------------------------------


def _channels(text: str) -> int:
    return dcon.mask_of(integer(channel) for channel in text.split(",") if channel.strip())


def _choice(kind: type[Enum]) -> Callable[[str], Any]:
    return lambda text: member(text, kind)


_PARTS: dict[str, dict[str, Callable[[str], Any]]] = {
    "mask": {"channels": _channels},
    "line_settings": {"baud_rate": baud_rate, "character_format": _choice(CharacterFormat)},
    "report_settings": {
        "data_format": _choice(DataFormat),
        "checksum": truth,
        "fast_mode": truth,
        "filter": _choice(Filter),
        "reserved": integer,
    },
}
_BYTES: dict[str, type[LineSettings | ReportSettings]] = {
    "line_settings": LineSettings,
    "report_settings": ReportSettings,
}


def _assemble(field: str, part: dict[str, Callable[[str], Any]], given: dict[str, str]) -> Any:  # noqa: ANN401
    """Take what belongs to `field` out of `given`: the whole, its parts, or the whole with parts changed."""
    whole = given.pop(field, None)
    parts = {name: _named(name, given.pop(name), read) for name, read in part.items() if name in given}
    if field == "mask":
        if whole is None:
            return parts["channels"]
        if parts:
            raise UsageError("mask and channels are the same: give one")
        return _named(field, whole, integer)
    kind = _BYTES[field]
    return evolve(kind() if whole is None else kind.from_byte(_named(field, whole, hex_byte)), **parts)
