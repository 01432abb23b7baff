"""Traffic, decoded, in lines for people.

Laws: nothing raises, whatever the bytes; all that came from the line is escaped, so that no line moves a terminal's
cursor; what cannot be decoded is shown as bytes, with what is wrong.
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import groupby

from rich.text import Text

from i7000 import Noise, Profile, Protocol, Reading, Status, TypeCode, dcon, modbus
from i7000.cli.records import VALUES, wrong_words
from i7000.cli.text import escaped
from i7000.dissect import ChannelReading, Heard, Item, Knowledge, Known, Line, Meaning, hear_frame
from i7000.dissect.stream import looks_like
from i7000.simulator.observed import Change, Observed

__all__ = ["INDENT", "change_line", "lines", "reading_text", "readings_text"]

INDENT = 12
"""Columns of the time, which answers leave blank."""
_SHOWN_BYTES = 80
_SHOWN_REGISTERS = 32
_SHOWN_NAMES = 6
_ELSEWHERE = {"address", *VALUES}
"""Fields that are not shown by name: what the frame begins with, and what readings and registers show."""


def lines(observed: Observed) -> Iterator[Text]:
    """Return the lines of an exchange: one for the command, and one for the response if there is one.

    Special: if a module does not answer, the command says so; faults stand at the end.
    """
    speech = _modbus if observed.protocol is Protocol.MODBUS_RTU else _dcon
    heard, answer = speech(observed)
    line = _at(observed.at).append(f"{escaped(observed.client)}  ", "dim").append("-> ", "blue").append_text(heard)
    if answer is not None:
        yield line
        line = Text(" " * INDENT).append("<- ", "green").append_text(answer)
    elif observed.profile is not None:
        line.append("  silence", "dim")
    elif observed.deaf is not None:
        line.append(f"  {_deaf_words(observed.protocol, observed.deaf)}", "yellow")
    if observed.faults:
        line.append(f"  [{escaped(', '.join(observed.faults))}]", "magenta")
    yield line


def change_line(change: Change) -> Text:
    """Return the line of a change of a module."""
    module = f"{change.address:02X} {change.model.value}  "
    what = ("EEPROM: " if change.stored else "") + ", ".join(change.what)
    return _at(change.at).append(module, "bold").append(escaped(what), "yellow")


def _at(seconds: float) -> Text:
    return Text(f"{seconds:10.3f}  ")


def _deaf_words(protocol: Protocol, deaf: Profile) -> str:
    """Explain why a module does not understand a frame, and what to do about it."""
    model = deaf.model
    heard, spoken, setting = (
        ("DCON", "Modbus RTU", "dcon") if protocol is Protocol.DCON else ("Modbus RTU", "DCON", "rtu")
    )
    hint = f": give --model {model.value},protocol={setting}" if protocol in model.protocols else " only"
    return f"a {heard} frame; the {model.value} speaks {spoken}{hint}"


_STATUS: dict[Status | None, tuple[str, str]] = {
    Status.DISABLED: ("disabled", "dim"),
    Status.OVER_RANGE: ("OVER_RANGE", "yellow"),
    Status.UNDER_RANGE: ("UNDER_RANGE", "yellow"),
}


def readings_text(readings: Sequence[Reading | ChannelReading], types: Sequence[TypeCode | None] = ()) -> Text:
    """Return readings as text, with the digits of known types; neighbours with one unit share it."""
    text = Text()
    for channel, reading in enumerate(readings):
        text.append(", " if channel else "")
        text.append(*reading_text(reading, types[channel] if channel < len(types) else None))
        later = next((it.unit for it in readings[channel + 1 :] if it.value is not None), None)
        if reading.value is not None and reading.unit and reading.unit is not later:
            text.append(f" {reading.unit}", "green")
    return text


def reading_text(reading: Reading | ChannelReading, type_code: TypeCode | None) -> tuple[str, str]:
    """Return a reading without its unit, with the digits that a module writes for the type, and its style."""
    if reading.value is None:
        unknown = reading.text if isinstance(reading, ChannelReading) else ""
        return _STATUS.get(reading.status, (unknown, ""))
    known = type_code or (reading.type_code if isinstance(reading, ChannelReading) else None)
    return (f"{reading.value:.7g}" if known is None else f"{reading.value:.{known.decimals}f}"), "green"


# --- pieces -----------------------------------------------------------------------------------------------------------

_Pieces = tuple[Text, Text | None]


def _meant(text: str, name: str, *details: Text) -> Text:
    """Return a frame, its name and its details in a line."""
    meaning = Text("; ").join(detail for detail in details if detail)
    return Text("  ").join((Text(text, "bold"), *filter(None, (Text(name, "cyan"), meaning))))


def _not_meant(text: str, reason: str, heard: Heard) -> Text:
    """Return a frame or noise in a line, with the reason and the likely causes."""
    reasons = escaped("; ".join((reason, *heard.notes)))
    return Text().append(text, "bold").append(f"  {reasons}", "red")


def _not_understood(text: str, heard: Heard) -> Text:
    return _not_meant(text, f"not understood: {wrong_words(heard)}", heard)


def _noise(text: str, noise: Noise) -> Text:
    _, heard = hear_frame(Line(), noise.wire, looks_like(noise.wire))
    return _not_meant(text, f"no frame: {noise.fault.value}", heard)


def _notes(heard: Heard) -> list[Text]:
    return [Text(escaped(note), "yellow") for note in (*heard.notes, *heard.contradictions)]


def _for_nobody(observed: Observed) -> list[Text]:
    return [Text("for no module here")] if observed.deaf is None else []


def _words(meaning: Meaning) -> list[Text]:
    """Return the fields of a message, by name."""
    return [Text(f"{field.name} {field.text}") for field in meaning.fields if field.name not in _ELSEWHERE]


@lru_cache(maxsize=32)
def _line(profile: Profile | None, protocol: Protocol) -> Line:
    """Return a line on which nothing was heard yet, with a module of which everything is known."""
    return Line(Knowledge.given(Known() if profile is None else Known.of(profile)), protocol)


# --- DCON -------------------------------------------------------------------------------------------------------------


def _dcon(observed: Observed) -> _Pieces:
    heard, profile = observed.heard, observed.profile
    answer = None if observed.answer is None else Text(_dcon_text(observed.answer), "bold")
    if isinstance(heard, Noise):
        return _noise(_dcon_text(heard.wire), heard), answer
    text = _dcon_text(heard)
    line, asked = hear_frame(_line(profile, Protocol.DCON), heard, Protocol.DCON, sent=True)
    if profile is None:
        for meaning in asked.meanings:
            if isinstance(meaning.message, dcon.Broadcast):
                return _meant(text, type(meaning.message).__name__, Text("to all modules")), answer
        return _meant(text, "", *_for_nobody(observed)), answer
    if asked.error is not None:
        return _not_understood(text, asked), answer
    (meaning,) = asked.meanings
    if observed.answer is not None and isinstance(meaning.message, dcon.Command):
        answer = _dcon_answer(observed.answer, line)
    return _meant(text, type(meaning.message).__name__, *_words(meaning), *_notes(asked)), answer


def _dcon_text(wire: bytes) -> str:
    shown = escaped(wire.removesuffix(b"\r")[:_SHOWN_BYTES].decode("ascii", "backslashreplace"))
    return shown if len(wire) <= _SHOWN_BYTES else f"{shown}... ({len(wire)} bytes)"


def _dcon_answer(wire: bytes, line: Line) -> Text:
    text = _dcon_text(wire)
    _, heard = hear_frame(line, wire, Protocol.DCON, sent=False)
    if heard.error is not None:
        return _not_understood(text, heard)
    (meaning,) = heard.meanings
    details = [readings_text(meaning.readings), *_words(meaning), *_notes(heard)]
    return _meant(text, type(meaning.message).__name__, *details)


# --- Modbus -----------------------------------------------------------------------------------------------------------


def _modbus(observed: Observed) -> _Pieces:
    heard, profile = observed.heard, observed.profile
    answer = None if observed.answer is None else Text(_modbus_text(observed.answer), "bold")
    if isinstance(heard, Noise):
        return _noise(_modbus_text(heard.wire), heard), answer
    text = _modbus_text(heard)
    line, asked = hear_frame(_line(profile, Protocol.MODBUS_RTU), heard, Protocol.MODBUS_RTU, sent=True)
    if asked.error is not None:
        return _not_understood(text, asked), answer
    (meaning,) = asked.meanings
    details = _modbus_words(meaning, mapped=profile is not None)
    if asked.address == modbus.BROADCAST:
        details.append(Text("to all modules"))
    else:
        details += _notes(asked) if profile is not None else [*_notes(asked), *_for_nobody(observed)]
    if observed.answer is not None:
        answer = _modbus_answer(observed.answer, line, mapped=profile is not None)
    return _meant(text, type(meaning.message).__name__, *details), answer


def _modbus_text(wire: bytes) -> str:
    shown = wire[:_SHOWN_BYTES].hex(" ").upper()
    return shown if len(wire) <= _SHOWN_BYTES else f"{shown}... ({len(wire)} bytes)"


def _modbus_answer(wire: bytes, line: Line, *, mapped: bool) -> Text:
    text = _modbus_text(wire)
    _, heard = hear_frame(line, wire, Protocol.MODBUS_RTU, sent=False)
    if heard.error is not None:
        return _not_understood(text, heard)
    (meaning,) = heard.meanings
    return _meant(text, type(meaning.message).__name__, *_modbus_words(meaning, mapped=mapped), *_notes(heard))


def _modbus_words(meaning: Meaning, *, mapped: bool) -> list[Text]:
    """Return the registers that a message touches, by name, or else its fields; of many, the first."""
    touched = meaning.items
    if not touched:
        return _words(meaning)
    groups = [list(group) for _, group in groupby(touched[:_SHOWN_REGISTERS], lambda item: item.name)]
    shown = [_items_text(group, mapped=mapped) for group in groups[:_SHOWN_NAMES]]
    return shown if sum(map(len, groups[:_SHOWN_NAMES])) == len(touched) else [*shown, Text("...")]


def _items_text(group: list[Item], *, mapped: bool) -> Text:
    """Return neighbours of one name: their numbers, the name, their values."""
    first, last = group[0], group[-1]
    name = first.name or ("not in the map" if mapped else "")
    text = Text(" ").join(Text(it) for it in (_numbers(first, last), name) if it)
    readings = [item.reading for item in group if item.reading is not None]
    types = [item.type_code for item in group]
    if len(readings) == len(group):
        return text.append(" ").append_text(readings_text(readings, types))
    values = [item.text or "" for item in group if item.value is not None]
    if first.name is None:
        values = [value.partition(",")[0] for value in values]
    return text.append(f" {', '.join(values)}") if values else text


def _numbers(first: Item, last: Item) -> str:
    return first.number if first is last else f"{first.number}..{last.number}"
