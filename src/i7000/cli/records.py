"""Meanings as records: what ``--json`` writes and `text` prints.

Laws: `fields` are those of the class, numbers as numbers, bytes of settings as one number, as in the vectors of
``spec``; `explained` says the same in words.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from enum import Enum
from functools import lru_cache
from typing import Any, NamedTuple

from attrs import fields

from i7000 import DecodeError, Fault, LineSettings, ReportSettings, dcon
from i7000.cli.dcon import ChannelReading, Known, Meaning, errata, gates, is_command
from i7000.cli.log import Line
from i7000.cli.reader import Reader
from i7000.cli.words import line_settings_words, mask_words, report_settings_words, type_code_words
from i7000.message import Message

__all__ = ["Record", "command_record", "empty_record", "explain", "line_records", "meaning_record", "message_fields"]

Record = dict[str, Any]


class _Fields(dict[type[Message], dict[str, Any]]):
    """The fields of message classes, listed when first needed."""

    def __missing__(self, kind: type[Message]) -> dict[str, Any]:
        listed = {field.name: field for field in fields(kind)}  # type: ignore[arg-type] # all of them are attrs classes
        return self.setdefault(kind, listed)


_FIELDS = _Fields()


def message_fields(kind: type[Message]) -> Mapping[str, Any]:
    """List the fields of a message class, and the part of the syntax that each fills."""
    return _FIELDS[kind]


def empty_record() -> Record:
    """A meaning that is not known: all the keys, and nothing else."""
    return {
        "name": None, "title": None, "section": None, "syntax": None, "command": None, "fields": {}, "explained": {},
        "readings": [], "registers": [], "errata": [], "pause": 0.0, "models": [], "checksum": None, "data_formats": [],
        "assumed": [], "note": None,
    }  # fmt: skip


def meaning_record(meaning: Meaning) -> Record:
    """A meaning with all that is told about it."""
    message, command, fit = meaning.message, meaning.command, meaning.fit
    kind = type(message)
    values = {name: getattr(message, name) for name in message_fields(kind)}
    return empty_record() | {
        "name": kind.__name__,
        "title": message.title,
        "section": command.section if command else message.section,
        "syntax": message.syntax,
        "command": type(command).__name__ if command else None,
        "fields": {name: _plain(value) for name, value in values.items()},
        "explained": {name: explain(message, name, value) for name, value in values.items() if name not in _READ},
        "readings": [_reading(reading) for reading in meaning.readings],
        "errata": list(errata(kind)),
        "pause": meaning.pause,
        "models": [model.value for model in fit.models],
        "checksum": fit.checksum,
        "data_formats": [data_format.name.lower() for data_format in meaning.data_formats],
        "assumed": list(meaning.assumed),
    }


def command_record(command: type[dcon.AnyCommand], models: list[str]) -> Record:
    """A command as ``i7000 commands`` lists it."""
    response = command.response if issubclass(command, dcon.Command) else None
    since = {model.value: firmware and str(firmware) for model, firmware in gates(command.section).items()}
    return {
        "section": command.section,
        "name": command.__name__,
        "title": command.title,
        "syntax": command.syntax,
        "fields": {name: field.type.__metadata__[0].allowed for name, field in message_fields(command).items()},
        "response": response and response.__name__,
        "response_syntax": response and response.syntax,
        "models": {model: since[model] for model in models},
        "errata": list(errata(command)),
    }


def _plain(value: Any) -> Any:  # noqa: ANN401 - of any field
    if isinstance(value, LineSettings | ReportSettings):
        return value.byte
    if isinstance(value, tuple):
        return list(value)
    return value.value if isinstance(value, Enum) else value


def _reading(reading: ChannelReading) -> Record:
    channel, text, status, type_code, value, unit = reading
    return {
        "channel": channel,
        "text": text,
        "status": status and status.value,
        "type_code": None if type_code is None else int(type_code),
        "value": value,
        "unit": unit,
    }


_REMEMBERED = 256
"""Exchanges that are not decoded again when they come again."""


class _Told(NamedTuple):
    """What is said of a frame wherever in a log it stands."""

    record: Record
    answers: bool = False
    """Whether it answers the command before it."""


def line_records(lines: Iterable[Line], known: Known) -> Iterator[Record]:
    """Yield a record for each frame of a log; a response is decoded with the command before it."""
    reader = Reader(known)

    @lru_cache(maxsize=_REMEMBERED)
    def told(frame: bytes, asked: bytes | None) -> _Told:
        return _told(frame, asked, reader)

    asked: Line | None = None
    for line in lines:
        number, text, frame = line
        if frame is None:
            yield line_record(number, text, NO_FRAME | {"fault": Fault.LEADING.value})
            continue
        command = is_command(frame)
        record, answers = told(frame, asked.frame if asked and not command else None)
        yield line_record(
            number,
            text,
            record,
            direction="command" if command else "response",
            frame=frame[:-1].decode("ascii", "backslashreplace"),
            wire=frame.hex(),
            answers=asked.number if asked and answers else None,
        )
        if command:
            asked = None if record["error"] else line
        elif answers or not record["error"]:
            asked = None


def line_record(  # noqa: PLR0913 - the keys of a record
    number: int,
    text: str,
    told: Record,
    *,
    direction: str | None = None,
    frame: str | None = None,
    wire: str | None = None,
    answers: int | None = None,
) -> Record:
    """A record of a line, and of what is told of the frame in it."""
    return {
        "line": number, "direction": direction, "text": text, "frame": frame, "wire": wire, "answers": answers, **told,
    }  # fmt: skip


def told_record(meaning: Record, **told: Any) -> Record:  # noqa: ANN401 - of any key
    """What is told of a frame: a meaning, and the keys that only a frame has."""
    return meaning | {"candidates": [], "error": None, "fault": None} | told


NO_FRAME: Record = told_record(empty_record(), error="no frame in this line")


def _told(frame: bytes, asked: bytes | None, reader: Reader) -> _Told:
    try:
        found = reader.meanings(frame, asked)
    except DecodeError as error:
        candidates = [] if asked is None else [meaning_record(meaning) for meaning in _alone(frame, reader)]
        record = told_record(empty_record(), candidates=candidates, error=str(error), fault=error.fault.value)
        return _Told(record)
    records = [meaning_record(meaning) for meaning in found]
    record = told_record(records[0]) if len(records) == 1 else told_record(empty_record(), candidates=records)
    misfit = found[0].misfit  # of all or of none
    if misfit:
        record |= {"error": str(misfit), "fault": misfit.fault.value}
    return _Told(record, any(meaning.command for meaning in found))


def _alone(frame: bytes, reader: Reader) -> tuple[Meaning, ...]:
    """What a frame could be that does not answer the command before it."""
    try:
        return reader.meanings(frame)
    except DecodeError:
        return ()


# --- fields in words --------------------------------------------------------------------------------------------------


def explain(message: dcon.Message, name: str, value: Any) -> str:  # noqa: ANN401
    """Return the value of a field in words."""
    special = _SPECIAL.get((type(message), name))
    if special is not None:
        return special(value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, Enum) and name not in _WORDS:
        return value.name.lower()
    return _WORDS.get(name, str)(value)


def _watchdog(status: int) -> str:
    message = dcon.HostWatchdogStatus(0, status)
    enabled = "enabled" if message.enabled else "disabled"
    return f"{status:02X}, {enabled}, {'timed out' if message.timed_out else 'not timed out'}"


_WORDS: Mapping[str, Callable[[Any], str]] = {
    "address": "{:02X}".format,
    "new_address": "{:02X}".format,
    "mask": mask_words,
    "type_code": type_code_words,
    "line_settings": line_settings_words,
    "report_settings": report_settings_words,
    "offset": lambda offset: f"{offset / 100:+.2f} degC",
    "temperature": "{:+.1f} degC".format,
    "status": _watchdog,
    "timeout": lambda tenths: f"{tenths / 10} s",
    "version": repr,
    "name": repr,
}
_READ = ("value", "values")
"""Told as readings."""
_SPECIAL: Mapping[tuple[type[dcon.Message], str], Callable[[Any], str]] = {
    (dcon.SetSoftInitTimeout, "timeout"): "{} s".format,
}
