"""The other door of `tests.device.oracle`: the same settings by Modbus RTU (manual 3), said as simply.

Laws: nothing of `i7000` is imported; which registers there are, and their limits, stands in ``spec/``.
"""

import re
from collections.abc import Callable, Sequence
from typing import Any

from tests.crc import crc
from tests.device.oracle import TYPES, Oracle, bits
from tests.spec.lint import Record, load, rows, table_files

__all__ = ["UnsaidError", "hear", "places", "sealed"]

FUNCTIONS = {int(row["function"], 16): row for row in rows("modbus_functions")}
SUB_FUNCTIONS = {int(row["sub_function"], 16): row["models"] for row in rows("module_settings")}
MAPS = [load(path) for path in table_files("modbus_registers")]
UNSAID = re.compile("log_.*|rtc_.*|temperature|big_endian")
"""What nothing is said of here: logger, clock, whole degrees."""


class UnsaidError(Exception):
    """A row that nothing is said of here."""


class ExceptionError(Exception):
    """An exception, with its code."""


def refuse(code: int, *, when: bool = True) -> None:
    """Answer an exception."""
    if when:
        raise ExceptionError(code)


def sealed(data: bytes) -> bytes:
    """Write an RTU frame."""
    return data + crc(data)


def hear(it: Oracle, frame: bytes) -> bytes | None:
    """Hear a frame; tell the answer, or None for silence."""
    if not 4 <= len(frame) <= 256 or crc(frame[:-2]) != frame[-2:] or frame[0] not in (0, it.address):
        return None
    address, function, body = frame[0], frame[1], frame[2:-2]
    if not address and function not in (0x05, 0x06, 0x0F, 0x10):
        return None
    try:
        row = FUNCTIONS.get(function)
        refuse(1, when=row is None or not it.has(row["models"]))
        answer = bytes((function,)) + ANSWERS[function](it, body)
        it.fed_at = it.now
    except ExceptionError as error:
        answer = bytes((function | 0x80, error.args[0]))
        if not function & 0x7F:
            return None
    return sealed(frame[:1] + answer) if address else None


# --- coils, inputs, registers -----------------------------------------------------------------------------------------

COILS, DISCRETE, INPUTS, HOLDING = "coil", "discrete_input", "input_register", "holding_register"


def places(it: Oracle, area: str, access: str) -> dict[int, tuple[Record, int]]:
    """Return the row of each address, and the place of its item."""
    own = [
        row
        for chart in MAPS
        for row in chart["rows"]
        if it.model in chart["models"]
        and row["area"] == area
        and access in row["access"]
        and it.model in (row["models"] or [it.model])
    ]
    return {row["address"] + at: (row, at) for row in own if it.since(row["firmware"]) for at in range(row["count"])}


def wanted(it: Oracle, area: str, access: str, start: int, count: int) -> list[tuple[Record, int]]:
    """Find what is asked for: 02 if the first is not there, 03 if another is not (3.1, 3.2; E94, E99)."""
    there = places(it, area, access)
    found = [there.get(address) for address in range(start, start + count)]
    refuse(3 if found[0] else 2, when=None in found)
    if any(place and UNSAID.fullmatch(place[0]["name"]) for place in found):
        raise UnsaidError
    return [place for place in found if place]


def number(data: bytes) -> int:
    return int.from_bytes(data, "big")


def read(area: str) -> Callable[[Oracle, bytes], bytes]:
    """Return how an area is read."""
    single = area in (COILS, DISCRETE)

    def answer(it: Oracle, body: bytes) -> bytes:
        start, count = number(body[:2]), number(body[2:])
        refuse(3, when=len(body) != 4 or not 1 <= count <= (2000 if single else 125) or start + count > 0x10000)
        items = [told(it, row)[at] & 0xFFFF for row, at in wanted(it, area, "R", start, count)]
        if any(address == 272 for address in range(start, start + count)) and area == COILS:
            it.reset_told = True
        if single:
            data = bits([bool(item) for item in items]).to_bytes((count + 7) // 8, "little")
        else:
            data = b"".join(item.to_bytes(2, "big") for item in items)
        return bytes((len(data),)) + data

    return answer


def reading(it: Oracle, channel: int) -> int:
    """A reading in the Modbus data format (3.5); 0 of a channel that is off."""
    kind = TYPES[it.types[channel]]
    value = it.value(channel, it.signals[channel], it.ambient)
    if not it.mask >> channel & 1:
        value = max(0.0, kind["minimum"])
    if not it.engineering:
        return it.word(channel, value)
    return int(round(min(max(value * kind["modbus_counts_per_unit"], -32768), 32767)) & 0xFFFF)


def told(it: Oracle, row: Record) -> Sequence[int]:
    """What a row holds; of what is not said here, nothing is to be read."""
    known: dict[str, Callable[[], Sequence[int] | int]] = {
        "range_status": lambda: it.faults(it.row["channels"]),
        "analog_input": lambda: [reading(it, channel) for channel in range(it.inputs)],
        "cjc_temperature": lambda: round(it.cold_junction() * 100),
        "type_code": lambda: it.types,
        "temperature_offset": lambda: it.tenths,
        "cjc_offset": lambda: it.hundredths if it.series == "7019" else [value & 0xFF for value in it.tenths],
        "firmware_version": lambda: (int(it.firmware[1]) << 8 | int(it.firmware[3:]), int(it.firmware[0], 36)),
        "module_name": lambda: (int(it.series[2:] + "00", 16), int(it.series[:2], 16)),
        "module_address": lambda: it.stored_address,
        "line_settings": lambda: it.line,
        "module_type_code": lambda: it.module_type,
        "response_delay": lambda: it.delay,
        "host_watchdog_timeout": lambda: it.timeout,
        "channel_mask": lambda: it.enabled & 0xFFFF,
        "channel_mask_high": lambda: it.enabled >> 16,
        "module_cjc_offset": lambda: it.cjc_offset,
        "host_watchdog_timeout_count": lambda: it.timeouts,
        "cjc_update": lambda: it.update,
        "protocol": lambda: it.stored_protocol == "modbus",
        "filter": lambda: it.filter_50_hz,
        "host_watchdog_mode": lambda: it.watchdog_mode,
        "host_watchdog_enabled": lambda: it.watchdog,
        "cjc_enabled": lambda: it.cjc_enabled,
        "modbus_data_format": lambda: it.engineering,
        "host_watchdog_timed_out": lambda: it.timed_out,
        "fast_mode": lambda: it.fast,
        "reset_status": lambda: not it.reset_told,
        "sampling_rate": lambda: it.sampling_8_hz,
        "open_wire_detection": lambda: it.open_wire,
        "single_ended": lambda: it.single_ended,
    }
    value = known[row["name"]]()
    return [value] if isinstance(value, int) else value


def write(it: Oracle, area: str, start: int, items: Sequence[int]) -> None:
    """Write all items, or none: 03 for what a row cannot hold."""
    found = wanted(it, area, "W", start, len(items))
    values = [limited(it, row, item) for (row, _), item in zip(found, items, strict=True)]
    for (row, at), value in zip(found, values, strict=True):
        store(it, row["name"], at, value)


def limited(it: Oracle, row: Record, item: int) -> int:
    """Return the number of an item, if it is within the limits of its row."""
    name, value, low, high = row["name"], item, row["minimum"] or 0, row["maximum"]
    if row["type"] == "int8":
        refuse(3, when=item > 0xFF)
        value = item - (item & 0x80) * 2
    elif row["type"] == "int16":
        value = item - (item & 0x8000) * 2
    high = 0 if name == "host_watchdog_timeout_count" else 0xFFFF if high is None else high
    low = 1 if name == "host_watchdog_timed_out" else low
    typed, there = name in ("type_code", "module_type_code"), it.channels
    refuse(3, when=not low <= value <= high or (typed and not it.supports(value)))
    refuse(3, when=name == "line_settings" and not it.line_allowed(value))
    refuse(3, when=name == "channel_mask" and value >> min(there, 16) > 0)
    refuse(3, when=name == "channel_mask_high" and value << 16 >> there > 0)
    return value


PLAIN = {
    "module_cjc_offset": "cjc_offset", "response_delay": "delay", "host_watchdog_timeout_count": "timeouts",
    "filter": "filter_50_hz", "host_watchdog_mode": "watchdog_mode", "cjc_enabled": "cjc_enabled",
    "modbus_data_format": "engineering", "fast_mode": "fast", "sampling_rate": "sampling_8_hz",
    "open_wire_detection": "open_wire", "single_ended": "single_ended", "line_settings": "line",
}  # fmt: skip
"""Rows that are one setting, and its name in the oracle."""


def store(it: Oracle, name: str, at: int, value: int) -> None:  # noqa: C901 - a table
    """Write one item."""
    if name in PLAIN:
        setattr(it, PLAIN[name], type(getattr(it, PLAIN[name]))(value))
    elif name == "type_code":
        it.types[at] = value
    elif name == "module_type_code":
        it.set_types(value)
    elif name in ("temperature_offset", "cjc_offset"):
        (it.hundredths if (name, it.series) == ("cjc_offset", "7019") else it.tenths)[at] = value
    elif name == "module_address":
        it.set_address(value)
    elif name in ("host_watchdog_timeout", "host_watchdog_enabled"):
        ours = name == "host_watchdog_timeout"
        it.set_watchdog(value if ours else it.timeout, enabled=it.watchdog if ours else bool(value))
    elif name == "channel_mask":
        it.set_mask(it.enabled >> 16 << 16 | value)
    elif name == "channel_mask_high":
        it.set_mask(it.enabled & 0xFFFF | value << 16)
    elif name == "cjc_update":
        it.set_update(value)
    elif name == "protocol":
        it.stored_protocol = "modbus" if value else "dcon"
    elif name == "host_watchdog_timed_out":
        it.timed_out = False
    else:
        assert name == "load_factory_calibration", name


def write_coil(it: Oracle, body: bytes) -> bytes:
    refuse(3, when=len(body) != 4 or body[2:] not in (b"\xff\x00", b"\x00\x00"))
    write(it, COILS, number(body[:2]), [body[2] & 1])
    return body


def write_register(it: Oracle, body: bytes) -> bytes:
    refuse(3, when=len(body) != 4)
    write(it, HOLDING, number(body[:2]), [number(body[2:])])
    return body


def write_several(area: str) -> Callable[[Oracle, bytes], bytes]:
    """Return how several coils or registers are written."""

    def answer(it: Oracle, body: bytes) -> bytes:
        start, count, data = number(body[:2]), number(body[2:4]), body[5:]
        size = (count + 7) // 8 if area == COILS else 2 * count
        (chart,) = (chart for chart in MAPS if it.model in chart["models"])
        most = 1968 if area == COILS else 123
        refuse(3, when=len(body) < 5 or not 1 <= count <= most or body[4] != size or len(data) != size)
        refuse(3, when=start + count > 0x10000 or (area == COILS and number(data[::-1]) >> count > 0))
        refuse(3, when=area == HOLDING and count > (chart["maximum_write_count"] or most))
        if area == COILS:
            items = [number(data[::-1]) >> at & 1 for at in range(count)]
        else:
            items = [number(data[2 * at : 2 * at + 2]) for at in range(count)]
        write(it, area, start, items)
        return body[:4]

    return answer


# --- function 46h -----------------------------------------------------------------------------------------------------


FORMS = {
    0x00: "", 0x04: "v000", 0x05: "0", 0x06: "0v000v00", 0x07: "0v", 0x08: "0vv", 0x20: "", 0x25: "", 0x26: "m",
    0x29: "", 0x2A: "v", 0x2B: "v", 0x2C: "vvv", 0x2D: "0", 0x2E: "0v", 0x2F: "", 0x30: "v",
}  # fmt: skip
"""What follows each sub-function: ``v`` a value, ``0`` a reserved byte, ``m`` a mask."""


def module_setting(it: Oracle, body: bytes) -> bytes:  # noqa: C901, PLR0911, PLR0912 - a table
    """Read or write a setting of the module (3.3)."""
    sub, data = body[0] if body else -1, body[1:]
    refuse(2 if body else 3, when=sub not in SUB_FUNCTIONS or not it.has(SUB_FUNCTIONS[sub]))
    width = it.mask_digits // 2
    form = FORMS[sub].replace("m", "v" * width)
    refuse(3, when=len(data) != len(form) or any(byte for byte, mark in zip(data, form, strict=True) if mark == "0"))
    values: list[Any] = [byte for byte, mark in zip(data, form, strict=True) if mark == "v"]
    head, done = bytes((sub,)), bytes((sub, 0))
    match sub:
        case 0x00:
            return head + bytes.fromhex(f"00{it.series}00")
        case 0x04:
            refuse(3, when=not 1 <= values[0] <= 247)
            it.set_address(values[0])
            return done + bytes(3)
        case 0x05:
            return head + bytes((0, it.line, 0, 0, 0, it.stored_protocol == "modbus", 0, 0))
        case 0x06:
            refuse(3, when=not it.line_allowed(values[0]) or values[1] > 1)
            it.line, it.stored_protocol = values[0], ("dcon", "modbus")[values[1]]
            return head + bytes(8)
        case 0x07 | 0x08:
            refuse(3, when=values[0] >= (it.channels if it.individual else 1))
            if sub == 0x07:
                return head + bytes((it.types[values[0]],))
            refuse(3, when=not it.supports(values[1]))
            it.set_types(values[1], values[0])
        case 0x20:
            return head + bytes((int(it.firmware[0], 36), int(it.firmware[1]), int(it.firmware[3:])))
        case 0x25:
            return head + it.enabled.to_bytes(width, "big")
        case 0x26:
            refuse(3, when=number(data) >> it.channels > 0)
            it.set_mask(number(data))
        case 0x29:
            return head + bytes((it.report & 0xA0,))
        case 0x2A:
            refuse(3, when=bool(values[0] & 0x5F) or not it.report_allowed(values[0]))
            it.filter_50_hz, it.fast = bool(values[0] & 0x80), bool(values[0] & 0x20)
        case 0x2B | 0x2C:
            channel = values[0] - 0x80
            refuse(3, when=values[0] > 0 and not 0 <= channel < it.channels)
            if sub == 0x2B:
                return head + ((it.tenths[channel] & 0xFF if values[0] else it.cjc_offset) & 0xFFFF).to_bytes(2, "big")
            offset = int.from_bytes(data[1:], "big", signed=True)
            refuse(3, when=not 0 <= offset <= 0xFF if values[0] else abs(offset) > 0x1000)
            if values[0]:
                it.tenths[channel] = offset - (offset & 0x80) * 2
            else:
                it.cjc_offset = offset
        case 0x2D:
            return head + bytes((it.cjc_enabled,))
        case 0x2E:
            refuse(3, when=values[0] > 1)
            it.cjc_enabled = bool(values[0])
        case 0x2F:
            return head + bytes((it.update,))
        case 0x30:
            refuse(3, when=values[0] > 2)
            it.set_update(values[0])
    return done


ANSWERS: dict[int, Callable[[Oracle, bytes], bytes]] = {
    0x01: read(COILS),
    0x02: read(DISCRETE),
    0x03: read(HOLDING),
    0x04: read(INPUTS),
    0x05: write_coil,
    0x06: write_register,
    0x0F: write_several(COILS),
    0x10: write_several(HOLDING),
    0x46: module_setting,
}
"""What comes of each function."""
