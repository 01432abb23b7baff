"""Modbus meanings as records, with the keys of `records`.

Laws: `fields` are those of the class, as in the vectors of ``spec``; `explained` says in words what no register says.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from enum import Enum
from functools import lru_cache
from typing import Any

from i7000 import Fault, LineSettings, modbus
from i7000.cli.dcon import Known, errata, gates
from i7000.cli.log import Line
from i7000.cli.records import NO_FRAME, Record, empty_record, line_record, message_fields, told_record
from i7000.cli.registers import Cell, cells
from i7000.cli.rtu import Listener, Meaning, profiles
from i7000.cli.words import line_settings_words, mask_words, module_name_words, type_code_words
from i7000.modbus.cold_junction import offset_in_celsius

__all__ = ["explain", "line_records", "meaning_record", "request_record"]


_REMEMBERED = 64
_SHORT = 64
"""Bytes of a frame up to which its record is remembered: those of a frame full of coils are large."""


def line_records(lines: Iterable[Line], known: Known) -> Iterator[Record]:
    """Tell what the frames of a log mean, responses together with the requests before them."""
    listener = Listener(profiles(known))

    def told(meaning: Meaning) -> Record:
        return told_record(meaning_record(meaning, known))

    remembered = lru_cache(maxsize=_REMEMBERED)(told)
    for number, text, frame in lines:
        if frame is None:
            yield line_record(number, text, NO_FRAME | {"fault": Fault.LENGTH.value})
            continue
        heard = listener.hear(number, frame)
        if heard.error:
            candidates = [meaning_record(meaning, known) for meaning in heard.candidates]
            error, fault = str(heard.error), heard.error.fault.value
            record = told_record(empty_record(), candidates=candidates, error=error, fault=fault)
        if heard.meaning:
            record = (remembered if len(frame) <= _SHORT else told)(heard.meaning)
            if heard.note:
                record = record | {"note": "; ".join(filter(None, (heard.note, record["note"])))}
        yield line_record(
            number,
            text,
            record,
            direction=heard.direction,
            frame=frame.hex(" ").upper(),
            wire=frame.hex(),
            answers=heard.answers,
        )


def meaning_record(meaning: Meaning, known: Known) -> Record:
    """A meaning with all that is told about it."""
    message, request = meaning.message, meaning.request
    kind = type(message)
    profile = meaning.profiles[0] if known.model else None
    touched = tuple(cells(message, request, profile))
    values = {name: getattr(message, name) for name in message_fields(kind)}
    section = request.section if request else message.section
    models = dict.fromkeys(it.model for it in meaning.profiles if (request or message).availability not in it.refused)
    readings = [_reading(cell) for cell in touched if cell.reading]
    return empty_record() | {
        "name": kind.__name__,
        "title": message.title,
        "section": section,
        "syntax": message.pdu,
        "command": type(request).__name__ if request else None,
        "fields": {name: _plain(value) for name, value in values.items()},
        "explained": {
            name: explain(message, request, name, value)
            for name, value in values.items()
            if not (touched and name in _READ)
        },
        "readings": readings,
        "registers": [_register(cell) for cell in touched],
        "errata": list(errata(kind)),
        "models": [model.value for model in models],
        "data_formats": [meaning.profiles[0].modbus_data_format.name.lower()] if readings else [],
        "assumed": ["type"] if readings and known.types is None and meaning.profiles[0].type_codes else [],
        "note": _note(meaning, known, analog=bool(readings)),
    }


def request_record(request: type[modbus.Request[Any]], models: list[str]) -> Record:
    """A request as ``i7000 commands`` lists it."""
    since = {model.value: firmware and str(firmware) for model, firmware in gates(request.section).items()}
    return {
        "section": request.section,
        "name": request.__name__,
        "title": request.title,
        "syntax": request.pdu,
        "fields": {name: field.type.__metadata__[0].allowed for name, field in message_fields(request).items()},
        "response": request.response.__name__,
        "response_syntax": request.response.pdu,
        "models": {model: since[model] for model in models},
        "errata": list(errata(request)),
    }


def _reading(cell: Cell) -> Record:
    return {
        "channel": cell.channel,
        "text": cell.text,
        "status": cell.reading and cell.reading.status.value,
        "type_code": cell.type_code,
        "value": cell.value,
        "unit": cell.unit,
    }


def _register(cell: Cell) -> Record:
    return {
        "number": cell.number,
        "name": cell.name,
        "channel": cell.channel,
        "value": cell.value,
        "unit": cell.unit,
        "status": cell.reading and cell.reading.status.value,
        "text": cell.text,
    }


def _note(meaning: Meaning, known: Known, *, analog: bool) -> str | None:
    """What a reader has to know about a meaning."""
    profile = meaning.profiles[0]
    availability = (meaning.request or meaning.message).availability
    if known.model and availability in profile.refused:
        return f"{profile.name} has no {meaning.message.title} by Modbus: {availability.scope}"
    if analog and known.modbus_data_format is None:
        return "the Modbus data format is not known, read as hex: --modbus-format tells"
    return None


def _plain(value: Any) -> Any:  # noqa: ANN401 - of any field
    if isinstance(value, LineSettings):
        return value.byte
    if isinstance(value, bytes):
        return value.hex()
    if isinstance(value, tuple):
        return list(value)
    return value.value if isinstance(value, Enum) else value


# --- fields in words --------------------------------------------------------------------------------------------------

_READ = ("value", "values")
"""Told as registers."""


def explain(message: modbus.Message, request: modbus.Request[Any] | None, name: str, value: Any) -> str:  # noqa: ANN401
    """Say the value of a field in words; `request` is the one that a response answers."""
    if name == "offset":
        return _offset(getattr(request or message, "channel", None), value)
    if name == "channel" and message.pdu.startswith(("46 2B", "46 2C")):
        return _channel(value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, Enum) and name not in _WORDS:
        return value.name.lower()
    return _WORDS.get(name, str)(value)


def _channel(channel: int) -> str:
    """Tell what a CJC offset is that of."""
    if not channel:
        return "00, the module"
    return f"{channel:02X}, " + (f"channel {channel - 0x80}" if channel >= 0x80 else "not defined")


def _offset(channel: int | None, offset: int) -> str:
    """Tell a CJC offset: that of the module has other counts than that of a channel."""
    if channel is None:
        return f"{offset}, {offset / 100:+.2f} degC if it is the module's"
    return f"{offset_in_celsius(channel, offset):+.{1 if channel else 2}f} degC"


def _exception(code: int) -> str:
    known = {it.value: it.name.lower().replace("_", " ") for it in modbus.ExceptionCode}
    return f"{code:02X}, {known.get(code, 'not defined')}"


def _result(result: int) -> str:
    return f"{result:02X}, {'not ' if result else ''}done"


def _settings(settings: int) -> str:
    words = [f"{settings:02X}", f"{50 if settings & 0x80 else 60} Hz rejected"]
    words.append("fast mode" if settings & 0x20 else "normal mode")
    if settings & 0x5F:
        words.append(f"reserved bits {settings & 0x5F:02X}")
    return ", ".join(words)


def _values(values: tuple[int, ...]) -> str:
    if isinstance(values[0], bool):
        return " ".join(f"{value:d}" for value in values)
    return " ".join(f"{value:04X}" for value in values)


_WORDS: Mapping[str, Callable[[Any], str]] = {
    "address": "{:02X}".format,
    "new_address": "{:02X}".format,
    "function": "{:02X}".format,
    "exception_code": _exception,
    "result": _result,
    "line_result": _result,
    "protocol_result": _result,
    "settings": _settings,
    "mask": mask_words,
    "type_code": type_code_words,
    "line_settings": line_settings_words,
    "name": module_name_words,
    "values": _values,
}
