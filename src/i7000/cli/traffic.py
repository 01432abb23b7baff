"""What was on the line, decoded, in lines for people.

Laws: nothing raises, whatever the bytes; all that came from the line is escaped, so that no line moves a terminal's
cursor; what cannot be decoded is shown as bytes, with what is wrong.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from itertools import groupby, islice
from typing import Any

from attrs import evolve
from rich.text import Text

from i7000 import DecodeError, Model, Noise, Profile, Protocol, Reading, Status, dcon, modbus
from i7000.cli import records, rtu_records
from i7000.cli.records import message_fields
from i7000.cli.registers import Cell, cells
from i7000.cli.text import escaped
from i7000.simulator.observed import Observed

__all__ = ["INDENT", "lines", "readings_text"]

INDENT = 12
"""Columns of the time, which answers leave blank."""
_SHOWN_BYTES = 80
_SHOWN_REGISTERS = 32
_SHOWN_NAMES = 6
_ANY = Profile(Model.M_7019R)
"""What frames that are for all modules are read with: these have the same form everywhere."""
_TOLD = ("address", "value", "values")
"""Fields that are not told by name: what the frame begins with, and what readings and registers tell."""


def lines(observed: Observed) -> Iterator[Text]:
    """Tell what was on the line: what was heard in one line, what came back in another, if it did.

    Special: silence is told where a module was asked; faults stand at the end.
    """
    speech = _modbus if observed.protocol is Protocol.MODBUS_RTU else _dcon
    heard, answer = speech(observed)
    line = Text(f"{observed.at:10.3f}  ").append(f"{escaped(observed.client)}  ", "dim").append_text(heard)
    if answer is not None:
        yield line
        line = Text(" " * INDENT).append_text(answer)
    elif observed.profile is not None:
        line.append("  silence", "dim")
    elif observed.deaf is not None:
        line.append(f"  {_deaf_words(observed.protocol, observed.deaf)}", "yellow")
    if observed.faults:
        line.append(f"  [{escaped(', '.join(observed.faults))}]", "magenta")
    yield line


def _deaf_words(protocol: Protocol, deaf: Profile) -> str:
    """Explain why a module does not understand a frame, and what to do about it."""
    model = deaf.model
    heard, spoken, setting = (
        ("DCON", "Modbus RTU", "dcon") if protocol is Protocol.DCON else ("Modbus RTU", "DCON", "rtu")
    )
    hint = f": give --model {model.value},protocol={setting}" if protocol in model.protocols else " only"
    return f"a {heard} frame; the {model.value} speaks {spoken}{hint}"


_STATUS = {Status.OVER_RANGE: ("OVER_RANGE", "yellow"), Status.UNDER_RANGE: ("UNDER_RANGE", "yellow")}


def readings_text(readings: Sequence[Reading], write: Callable[[int, float], str]) -> Text:
    """Tell readings: numbers as `write` makes them of channel and value; the unit once for neighbours that share it."""
    text = Text()
    for channel, (value, unit, status) in enumerate(readings):
        text.append(", " if channel else "")
        if value is None:
            text.append(*_STATUS.get(status, ("disabled", "dim")))
            continue
        later = next((it.unit for it in readings[channel + 1 :] if it.value is not None), None)
        text.append(write(channel, value) + (f" {unit}" if unit is not later else ""), "green")
    return text


# --- pieces -----------------------------------------------------------------------------------------------------------

_Pieces = tuple[Text, Text | None]


def _meant(text: str, name: str, *details: Text) -> Text:
    """A frame, what it is, and what it says."""
    meaning = Text("; ").join(detail for detail in details if detail)
    return Text("  ").join((Text(text, "bold"), *filter(None, (Text(name, "cyan"), meaning))))


def _not_meant(text: str, reason: str) -> Text:
    return Text().append(text, "bold").append(f"  {escaped(reason)}", "red")


def _fault(error: DecodeError) -> str:
    allowed = f"; allowed: {error.allowed}" if error.allowed else ""
    return f"not understood: {error.fault.value} at byte {error.offset}{allowed}"


def _noise(text: str, noise: Noise) -> Text:
    return _not_meant(text, f"no frame: {noise.fault.value}")


def _for_nobody(observed: Observed) -> list[Text]:
    return [Text("for no module here")] if observed.deaf is None else []


def _words(message: Any, explain: Callable[[str, Any], str]) -> list[Text]:  # noqa: ANN401 - of either protocol
    """Tell the fields of a message by name."""
    told = {name: getattr(message, name) for name in message_fields(type(message)) if name not in _TOLD}
    return [Text(f"{name} {explain(name, value)}") for name, value in told.items()]


def _as_sent(_: int, value: float) -> str:
    return f"{value:.7g}"


# --- DCON -------------------------------------------------------------------------------------------------------------


def _dcon(observed: Observed) -> _Pieces:
    heard, profile = observed.heard, observed.profile
    answer = None if observed.answer is None else Text(_dcon_text(observed.answer), "bold")
    if isinstance(heard, Noise):
        return _noise(_dcon_text(heard.wire), heard), answer
    text = _dcon_text(heard)
    if profile is None:
        broadcast = _broadcast(heard)
        if broadcast:
            return _meant(text, type(broadcast).__name__, Text("to all modules")), answer
        return _meant(text, "", *_for_nobody(observed)), answer
    try:
        command = dcon.decode_command(heard, profile)
    except DecodeError as error:
        return _not_meant(text, _fault(error)), answer
    asked = _meant(text, type(command).__name__, *_words(command, partial(records.explain, command)))
    if observed.answer is not None and isinstance(command, dcon.Command):
        answer = _dcon_answer(observed.answer, command, profile)
    return asked, answer


def _broadcast(frame: bytes) -> dcon.Broadcast | None:
    """Read a command to all modules, which has a checksum or not."""
    for known in (_ANY, evolve(_ANY, checksum=True)):
        with suppress(DecodeError):
            command = dcon.decode_command(frame, known)
            if isinstance(command, dcon.Broadcast):
                return command
    return None


def _dcon_text(wire: bytes) -> str:
    shown = escaped(wire.removesuffix(b"\r")[:_SHOWN_BYTES].decode("ascii", "backslashreplace"))
    return shown if len(wire) <= _SHOWN_BYTES else f"{shown}... ({len(wire)} bytes)"


def _dcon_answer(wire: bytes, command: dcon.Command[Any], profile: Profile) -> Text:
    """Read an answer with the profile of before; the command may have changed whether there is a checksum."""
    text = _dcon_text(wire)
    faults = []
    for known in (profile, evolve(profile, checksum=not profile.checksum)):
        try:
            response = dcon.decode_response(wire, command, known)
            values = _dcon_readings(response, command, known)
        except DecodeError as error:
            faults.append(error)
            continue
        words = _words(response, partial(records.explain, response))
        return _meant(text, type(response).__name__, readings_text(values, _as_sent), *words)
    return _not_meant(text, _fault(faults[0]))


def _dcon_readings(response: dcon.Message, command: Any, profile: Profile) -> tuple[Reading, ...]:  # noqa: ANN401
    if isinstance(response, dcon.AnalogInputs | dcon.AnalogInputsHex | dcon.SynchronizedData):
        return dcon.readings(response, profile)
    if isinstance(response, dcon.AnalogInput):
        return (dcon.reading(response, command.channel, profile),)
    return ()


# --- Modbus -----------------------------------------------------------------------------------------------------------


def _modbus(observed: Observed) -> _Pieces:
    heard, profile = observed.heard, observed.profile
    answer = None if observed.answer is None else Text(_modbus_text(observed.answer), "bold")
    if isinstance(heard, Noise):
        return _noise(_modbus_text(heard.wire), heard), answer
    text = _modbus_text(heard)
    try:
        request = modbus.decode_request(heard, profile or _ANY)
    except DecodeError as error:
        return _not_meant(text, _fault(error)), answer
    details = _modbus_words(request, None, profile)
    if not modbus.is_answered(request):
        details.append(Text("to all modules"))
    elif profile is None:
        details += _for_nobody(observed)
    if observed.answer is not None:
        answer = _modbus_answer(observed.answer, request, profile or _ANY)
    return _meant(text, type(request).__name__, *details), answer


def _modbus_text(wire: bytes) -> str:
    shown = wire[:_SHOWN_BYTES].hex(" ").upper()
    return shown if len(wire) <= _SHOWN_BYTES else f"{shown}... ({len(wire)} bytes)"


def _modbus_answer(wire: bytes, request: modbus.Request[Any], profile: Profile) -> Text:
    text = _modbus_text(wire)
    try:
        response = modbus.decode_response(wire, request, profile)
    except DecodeError as error:
        return _not_meant(text, _fault(error))
    return _meant(text, type(response).__name__, *_modbus_words(response, request, profile))


def _modbus_words(message: Any, request: Any, profile: Profile | None) -> list[Text]:  # noqa: ANN401 - messages
    """Tell the registers that a message touches, by name, or else its fields; of many, the first."""
    touched = list(islice(cells(message, request, profile), _SHOWN_REGISTERS + 1))
    if not touched:
        return _words(message, partial(rtu_records.explain, message, request))
    groups = [list(group) for _, group in groupby(touched[:_SHOWN_REGISTERS], lambda cell: cell.name)]
    told = [_cells_text(group, mapped=profile is not None) for group in groups[:_SHOWN_NAMES]]
    return told if sum(map(len, groups[:_SHOWN_NAMES])) == len(touched) else [*told, Text("...")]


def _cells_text(group: list[Cell], *, mapped: bool) -> Text:
    """Tell neighbours of one name: their numbers, the name, their values."""
    first, last = group[0], group[-1]
    name = first.name or ("not in the map" if mapped else "")
    text = Text(" ").join(Text(it) for it in (_numbers(first, last), name) if it)
    readings = [cell.reading for cell in group if cell.reading is not None]
    if len(readings) == len(group):
        return text.append(" ").append_text(readings_text(readings, _as_sent))
    values = [cell.text or "" for cell in group if cell.value is not None]
    if first.name is None:
        values = [value.partition(",")[0] for value in values]
    return text.append(f" {', '.join(values)}") if values else text


def _numbers(first: Cell, last: Cell) -> str:
    return first.number if first is last else f"{first.number}..{last.number}"
