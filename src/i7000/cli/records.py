"""Meanings as records: what ``--json`` writes and `text` prints.

Laws: `fields` are those of the class, numbers as numbers, bytes of settings as one number, as in the vectors of
``spec``; `explained` says the same in words.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from enum import Enum
from typing import Any

from attrs import asdict, fields

from i7000 import DecodeError, Fault, LineSettings, ReportSettings, dcon
from i7000.cli.dcon import ChannelReading, Known, Meaning, errata, gates, is_command, meanings
from i7000.cli.log import Line
from i7000.cli.words import line_settings_words, mask_words, report_settings_words, type_code_words
from i7000.message import Message

__all__ = ["Record", "command_record", "empty_record", "explain", "line_records", "meaning_record", "message_fields"]

Record = dict[str, Any]


def message_fields(kind: type[Message]) -> dict[str, Any]:
    """List the fields of a message class, and the part of the syntax that each fills."""
    return {field.name: field for field in fields(kind)}  # type: ignore[arg-type] # all of them are attrs classes


def empty_record() -> Record:
    """A meaning that is not known: all the keys, and nothing else."""
    return {
        "name": None, "title": None, "section": None, "syntax": None, "command": None, "fields": {}, "explained": {},
        "readings": [], "registers": [], "errata": [], "pause": 0.0, "models": [], "checksum": None, "data_formats": [],
        "assumed": [], "note": None,
    }  # fmt: skip


def meaning_record(meaning: Meaning) -> Record:
    """A meaning with all that is told about it."""
    message, command = meaning.message, meaning.command
    values = {name: getattr(message, name) for name in message_fields(type(message))}
    return empty_record() | {
        "name": type(message).__name__,
        "title": message.title,
        "section": command.section if command else message.section,
        "syntax": message.syntax,
        "command": type(command).__name__ if command else None,
        "fields": {name: _plain(value) for name, value in values.items()},
        "explained": {name: explain(message, name, value) for name, value in values.items() if name not in _READ},
        "readings": [_reading(reading) for reading in meaning.readings],
        "errata": list(errata(message)),
        "pause": meaning.pause,
        "models": [model.value for model in meaning.models],
        "checksum": meaning.checksum,
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
    record = asdict(reading)
    return record | {
        "status": reading.status and reading.status.value,
        "type_code": None if reading.type_code is None else reading.type_code.value,
    }


def line_records(lines: Iterable[Line], known: Known) -> Iterator[Record]:
    """Tell what the frames of a log mean, responses together with the commands before them."""
    asked = None
    for line in lines:
        record = _line_record(line)
        if line.frame is None:
            yield record | {"error": "no frame in this line", "fault": Fault.LEADING.value}
            continue
        command = is_command(line.frame)
        try:
            found = meanings(line.frame, asked.frame if asked and not command else None, known)
        except DecodeError as error:
            yield record | {
                "error": str(error),
                "fault": error.fault.value,
                "candidates": [meaning_record(meaning) for meaning in _alone(line.frame, known)],
            }
            asked = None if command else asked
            continue
        if asked and any(meaning.command for meaning in found):
            record["answers"] = asked.number
        asked = line if command else None
        misfit = found[0].misfit  # of all or of none
        if misfit:
            record |= {"error": str(misfit), "fault": misfit.fault.value}
        candidates = [meaning_record(meaning) for meaning in found]
        yield record | (candidates[0] if len(candidates) == 1 else {"candidates": candidates})


def _line_record(line: Line) -> Record:
    frame = line.frame
    record = {"line": line.number, "direction": None, "text": line.text, "frame": None, "wire": None, "answers": None}
    if frame:
        record |= {
            "direction": "command" if is_command(frame) else "response",
            "frame": frame[:-1].decode("ascii", "backslashreplace"),
            "wire": frame.hex(),
        }
    return record | empty_record() | {"candidates": [], "error": None, "fault": None}


def _alone(frame: bytes, known: Known) -> tuple[Meaning, ...]:
    """What a frame could be that does not answer the command before it."""
    try:
        return meanings(frame, None, known)
    except DecodeError:
        return ()


# --- fields in words --------------------------------------------------------------------------------------------------


def explain(message: dcon.Message, name: str, value: Any) -> str:  # noqa: ANN401
    """Say the value of a field in words."""
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
