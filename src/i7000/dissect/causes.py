"""The likely causes of frames that cannot be decoded: a sentence for each classic mistake.

Laws: a cause is tried before it is named: a codec has decoded the frame without the mistake.
"""

from collections.abc import Iterator
from contextlib import suppress
from typing import Any

from attrs import evolve

from i7000 import dcon, describe, modbus
from i7000.dissect.dcon import LEADS, DconReader, is_command
from i7000.dissect.dcon import reader as reader_of
from i7000.dissect.known import Knowledge, Known, Module
from i7000.dissect.meaning import Meaning
from i7000.dissect.modbus import ModbusReader
from i7000.dissect.shapes import is_shaped
from i7000.dissect.words import models_words
from i7000.errors import DecodeError
from i7000.settings import DataFormat

__all__ = ["address_notes", "dcon_causes", "modbus_causes", "register_notes"]

_BLANK_FIELD = " " * 7
_MOST_STRIPPED = 20
"""The most channels whose blanks a log may have stripped."""


def dcon_causes(wire: bytes, module: Module, asked: bytes | None) -> Iterator[str]:
    """Yield the likely causes why a DCON frame of a module cannot be decoded."""
    known, reader = module.known, reader_of(module.known)
    body = wire.rstrip(b"\r\n")
    with suppress(DecodeError):
        modbus.unseal(wire)
        name = _meant(ModbusReader(Known()), wire[:-2])
        yield f"the CRC is right: a Modbus RTU frame{f', {name}' if name else ''}"
        return
    if body and wire.endswith(b"\n"):
        yield "a line feed (0A) at its end: DCON frames end with a carriage return (0D)"
    elif wire[:1] in LEADS and not wire.endswith(b"\r"):
        yield "no carriage return (0D) at its end"
    if _is_noise(wire):
        yield "noise: another baud rate or parity?"
        return
    yield from _checksum_causes(body, module, asked)
    upper = body.upper()
    if upper != body and _name(reader, upper, asked):
        yield f"lower case: in upper case it is {_name(reader, upper, asked)}"
    elif upper != body and known.checksum and (name := _name(reader_of(evolve(known, checksum=False)), upper, asked)):
        yield f"lower case and no checksum: it would be {name}, with the checksum {dcon.checksum(upper):02X}"
    if asked is not None and body[:1] == b">":
        yield from _format_causes(body, known, asked)
        yield from _model_causes(body, known, asked)
        whole = len(body) % len(_BLANK_FIELD) == 1
        for count in range(1, _MOST_STRIPPED if whole else 0):
            if _name(reader, body + _BLANK_FIELD.encode() * count, asked):
                channels = "the last channel is" if count == 1 else f"the last {count} channels are"
                yield f"{count * len(_BLANK_FIELD)} blanks short: {channels} disabled, and the log has lost the blanks?"
                break


def _format_causes(body: bytes, known: Known, asked: bytes) -> Iterator[str]:
    for other in DataFormat if known.data_format is not None else ():
        if _name(reader_of(evolve(known, data_format=other)), body, asked):
            yield f"it can be read in data format {other.name.lower()}"


def _model_causes(body: bytes, known: Known, asked: bytes) -> Iterator[str]:
    if known.model is not None:
        with suppress(DecodeError):
            (meaning, *_) = reader_of(Known(checksum=known.checksum)).meanings(body + b"\r", asked)
            if known.model not in meaning.models:
                name = type(meaning.message).__name__
                models = models_words(meaning.models, meaning.section)
                yield f"it is {name} of other models than an {known.model.value}: {models}"


def _checksum_causes(body: bytes, module: Module, asked: bytes | None) -> Iterator[str]:
    plain = reader_of(evolve(module.known, checksum=False))
    learned = next((fact for fact in module.learned if fact.name == "checksum"), None)
    asked_with = asked is not None and _name(plain, asked.rstrip(b"\r"), None) is None
    name = _name(plain, body, asked) if module.known.checksum or asked_with else None
    if name:
        had = f", but {learned.where} had one" if learned else "" if module.known.checksum else _ASKED_WITH
        yield f"without a checksum it is {name}{had}; the checksum would be {dcon.checksum(body):02X}"
        return
    for count in _SUMS if body and (asked or is_command(body)) else ():
        shorter, last = body[:-count], body[-count:].decode("ascii", "replace")
        name = None if last.strip("0123456789abcdefABCDEF") else _name(plain, shorter, asked)
        if name:
            right = f"{dcon.checksum(shorter):02X}"
            if count > _SUMS[0]:
                if int(last, 16) == sum(shorter):
                    yield f"{last} is the whole sum: the checksum of {name} is its last two digits, {right}"
            elif last.upper() == right:
                had = f"but {learned.where} had none" if learned else "no checksum was expected"
                yield f"{last} is the checksum of {name}{',' if learned else ';'} {had}"
            else:
                yield f"{last} in place of a checksum? that of {name} would be {right}"


_ASKED_WITH = ", but the command had one"
_SUMS = (2, 3, 4)
"""Digits of a checksum, and of the sums that it is the last byte of."""


def _name(reader: DconReader, body: bytes, asked: bytes | None) -> str | None:
    """Return the name of the message that a body is, if it is one."""
    if not body:
        return None
    try:
        (meaning, *_) = reader.meanings(body + b"\r", asked)
    except DecodeError:
        return None
    return None if meaning.misfit else type(meaning.message).__name__


_TEXT = frozenset(b"\t\r\n") | frozenset(range(0x20, 0x7F))


def _is_noise(wire: bytes) -> bool:
    """Return whether most of the bytes cannot occur in DCON."""
    return sum(byte not in _TEXT for byte in wire) * 2 > len(wire)


# --- Modbus -----------------------------------------------------------------------------------------------------------


def modbus_causes(wire: bytes, reader: ModbusReader) -> Iterator[str]:
    """Yield the likely causes why a Modbus RTU frame cannot be decoded."""
    with suppress(UnicodeDecodeError):
        if is_shaped(wire.rstrip(b"\r\n").decode("ascii")):
            name = _name(reader_of(Known()), wire.rstrip(b"\r\n"), None)
            yield f"the shape of a DCON frame{f': {name}' if name else ''}"
            return
    with suppress(DecodeError):
        modbus.unseal(wire)
        return  # The CRC is right: the error says what is wrong.
    header = _tcp_header(wire)
    if header is not None:
        name = _meant(reader, wire[6:])
        what = f"; the rest is {name}" if name else ""
        yield f"a Modbus TCP header (transaction {header}, {len(wire) - 6} bytes follow): these modules speak RTU{what}"
        return
    if len(wire) < modbus.SHORTEST_FRAME:
        yield f"noise: {len(wire)} byte{'s' if len(wire) > 1 else ''} beside the frames"
        return
    whole, cut = _meant(reader, wire), _meant(reader, wire[:-2])
    ended = wire.rstrip(b"\r\n")
    if whole:
        yield f"no CRC? {whole} without it, which would be {_crc(wire)}"
    elif ended != wire and (name := _meant(reader, ended)):
        yield f"no CRC? {name} with the end of a line in its place; the CRC would be {_crc(ended)}"
    elif cut and modbus.seal(wire[:-2])[-2:] == wire[:-3:-1]:
        yield f"the bytes of the CRC are in the wrong order: the low byte comes first, {_crc(wire[:-2])}"
    elif cut:
        yield f"damaged? {cut} would have the CRC {_crc(wire[:-2])}"
    elif cut_name := next(filter(None, (_cut(reader, wire[start:]) for start in (0, 1))), None):
        yield cut_name
    elif sum(byte in _LIKE_NOISE for byte in wire) * 2 > len(wire):
        yield "noise: another baud rate or parity?"


_LIKE_NOISE = frozenset((0x00, *range(0x80, 0x100)))
"""Bytes that most of noise is made of: a wrong rate makes long runs of equal bits."""


def _tcp_header(wire: bytes) -> int | None:
    """Return the transaction of a Modbus TCP header, if a frame begins with one."""
    if len(wire) >= len("ttppllaf") and wire[2:4] == b"\0\0" and int.from_bytes(wire[4:6], "big") == len(wire) - 6:
        return int.from_bytes(wire[:2], "big")
    return None


def _meant(reader: ModbusReader, body: bytes) -> str | None:
    """Return the name of the request or response that a body is, if it is one."""
    if len(body) < len("af") or len(body) > modbus.LONGEST_FRAME - 2:
        return None
    frame = modbus.seal(body)
    meaning = reader.request(frame).meaning or reader.alone(frame).meaning
    return None if meaning is None else type(meaning.message).__name__


def _cut(reader: ModbusReader, wire: bytes) -> str | None:
    """Return a note that a frame is a message without its last byte, if it is one."""
    low, high = modbus.seal(wire[:-1])[-2:]
    name = _meant(reader, wire[:-1]) if low == wire[-1] else None
    return name and f"cut: {name} without its last byte, {high:02X}"


def _crc(body: bytes) -> str:
    return modbus.seal(body)[-2:].hex(" ").upper()


_NUMBERS_OF_AREA = 10_000
"""The numbers of the manual that begin with the digit of an area."""


def address_notes(address: int | None, knowledge: Knowledge) -> Iterator[str]:
    """Yield that an address that no known module has is likely to be one in decimal, written as hex."""
    others = knowledge.others.given
    given = [other for other, module in knowledge.modules.items() if module.given is not others]
    if address is None or address in given:
        return
    for other in given:
        if int(str(other), 16) == address:
            known = describe.address(other)
            yield f"no module at {describe.address(address)} is known, but one at {known}: in decimal?"


def register_notes(meaning: Meaning) -> Iterator[str]:
    """Yield a note if an address looks like a number of the manual."""
    message: Any = meaning.message  # a request
    first = message.area.value * _NUMBERS_OF_AREA if message.area else 0
    start = message.first_item
    if first and first < start < first + _NUMBERS_OF_AREA:
        mistaken = meaning.items[0].number
        yield (
            f"{start:05} is a number of the manual: in a frame it is address {start - first - 1} (3.2); "
            f"address {start} would be number {mistaken}"
        )
