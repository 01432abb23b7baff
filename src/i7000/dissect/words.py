"""Values of fields in words, for people.

Laws: a value that the manual does not define is shown as the number it is.
"""

from collections.abc import Callable, Iterable, Mapping
from enum import Enum
from typing import Any

from i7000 import MIXED, BaudRate, DataFormat, Filter, LineSettings, Model, ReportSettings, TypeCode, dcon, modbus
from i7000.message import Message
from i7000.modbus.cold_junction import offset_in_celsius
from i7000.models import AVAILABILITY

__all__ = [
    "field_words",
    "line_settings_words",
    "mask_words",
    "models_words",
    "module_name_words",
    "report_settings_words",
    "type_code_words",
]


def models_words(models: Iterable[Model], section: str) -> str:
    """Name models in few words; of all that have the command of a section, in the manual's words.

    >>> models_words(Model, "2.3"), models_words([Model.I_7017Z], "2.4")
    ('all models', 'I-7017Z')
    """
    models = set(models)
    if models == set(Model):
        return "all models"
    if section in AVAILABILITY and models == set(AVAILABILITY[section].gates):
        return AVAILABILITY[section].scope
    others = set(Model) - models
    few = min(models, others, key=len)
    names = ", ".join(model.value for model in Model if model in few)
    return f"all but {names}" if few is others else names


# --- values -----------------------------------------------------------------------------------------------------------


def type_code_words(code: int) -> str:
    """Return a type code in words.

    >>> type_code_words(0x0F), type_code_words(0x05), type_code_words(0x20)
    ('0F, thermocouple K, -270..1372 degC', '05, -2.5..2.5 V', '20, not defined')
    """
    known = TypeCode.of(code)
    if not isinstance(known, TypeCode):
        return f"{code:02X}, {'the channels have different types' if code == MIXED else 'not defined'}"
    kind = f"thermocouple {known.thermocouple}, " if known.thermocouple else ""
    return f"{code:02X}, {kind}{known.minimum:g}..{known.maximum:g} {known.unit}"


def line_settings_words(line: LineSettings) -> str:
    """Return the byte CC in words.

    >>> line_settings_words(LineSettings.from_byte(0x86))
    '86, 9600 baud, E81'
    """
    rate = line.baud_rate
    baud = f"{rate.bits_per_second} baud" if isinstance(rate, BaudRate) else f"baud rate code {rate:02X} not defined"
    return f"{line.byte:02X}, {baud}, {line.character_format.name}"


def mask_words(mask: int) -> str:
    """Return a channel mask in words.

    >>> mask_words(0x0A), mask_words(0)
    ('0A, channels 1, 3', '00, no channel')
    """
    channels = sorted(dcon.channels_of(mask))
    word = "no channel" if not channels else "channel" if len(channels) == 1 else "channels"
    return f"{mask:02X}, {word} {', '.join(map(str, channels))}".rstrip()


def module_name_words(name: bytes) -> str:
    """Return the name that a module has by Modbus in words.

    >>> module_name_words(bytes.fromhex("00701900")), module_name_words(bytes(4))
    ('00701900, M-7019 series', '00000000')
    """
    digits = name.hex()
    known = digits[:2] == digits[6:] == "00" and digits[2:6] in {model.series for model in Model}
    return f"{digits}, M-{digits[2:6]} series" if known else digits


def report_settings_words(report: ReportSettings) -> str:
    """Return the byte FF in words.

    >>> report_settings_words(ReportSettings.from_byte(0x42))
    '42, hex, checksum, normal mode, 60 Hz rejected'
    """
    form = report.data_format
    words = [
        f"{report.byte:02X}",
        form.name.lower() if isinstance(form, DataFormat) else f"data format {form} not defined",
        "checksum" if report.checksum else "no checksum",
        "fast mode" if report.fast_mode else "normal mode",
        "50 Hz rejected" if report.filter is Filter.REJECT_50_HZ else "60 Hz rejected",
    ]
    if report.reserved:
        words.append(f"reserved bits {report.reserved:03b}")
    return ", ".join(words)


# --- fields -----------------------------------------------------------------------------------------------------------


def field_words(message: Message, command: Message | None, name: str, value: Any) -> str:  # noqa: ANN401 - of any field
    """Return the value of a field in words; `command` is the one that a response answers."""
    if isinstance(message, dcon.Message):
        special = _SPECIAL.get((type(message), name))
        if special is not None:
            return special(value)
        words = _DCON
    else:
        if name == "offset":
            return _offset(getattr(command or message, "channel", None), value)
        if name == "channel" and isinstance(message, modbus.ReadCjcOffset | modbus.SetCjcOffset):
            return _channel(value)
        words = _MODBUS
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, Enum) and name not in words:
        return value.name.lower()
    return words.get(name, str)(value)


def _watchdog(status: int) -> str:
    message = dcon.HostWatchdogStatus(0, status)
    enabled = "enabled" if message.enabled else "disabled"
    return f"{status:02X}, {enabled}, {'timed out' if message.timed_out else 'not timed out'}"


_DCON: Mapping[str, Callable[[Any], str]] = {
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
_SPECIAL: Mapping[tuple[type[Message], str], Callable[[Any], str]] = {
    (dcon.SetSoftInitTimeout, "timeout"): "{} s".format,
}


def _channel(channel: int) -> str:
    if not channel:
        return "00, the module"
    return f"{channel:02X}, " + (f"channel {channel - 0x80}" if channel >= 0x80 else "not defined")


def _offset(channel: int | None, offset: int) -> str:
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


_MODBUS: Mapping[str, Callable[[Any], str]] = {
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
