"""``i7000.h``: the tables of ``spec/tables/`` as rows of values."""

from collections.abc import Iterator
from typing import NamedTuple

from c.generate.spec import FORMATS, STATUSES, Record, Spec, field_of, firmware
from c.generate.values import Value, enumerator, items, number, numbered, optional_text, row, text

__all__ = ["KINDS", "NEVER", "TOKENS", "WIDTHS", "Table", "tables"]

NEVER = 0xFFFFFFFF
"""The firmware from which on a model has what no model has; as a last firmware, the newest."""
_ALL_TYPES = (1 << 29) - 1
_UNLIMITED = {"minimum": None, "maximum": None}
_NO_LIMIT = {"minimum": -(1 << 31), "maximum": (1 << 31) - 1}

# The numbers of the enumerations in the template of the header, which the self-test holds against them.
KINDS = numbered(
    ("literal", "hex", "bool", "code", "signed_hex", "decimal", "name", "version", "reading", "readings")
)  # fmt: skip
WIDTHS = numbered(("fixed", "mask_digits", "channel_digits", "reading_digits", "length"))
TOKENS = numbered(
    ("literal", "unsigned", "signed", "bool", "code", "coil", "digits", "mask", "bytes", "bits", "words", "function")
)  # fmt: skip
AREAS = numbered(("coil", "discrete_input", "input_register", "holding_register"))
ACCESS = {"R": 1, "W": 2, "R/W": 3}
REGISTER_TYPES = numbered(("bool", "reading", "uint16", "int16", "int8", "uint32", "code", "bits", "record"))
UNITS = ("mV", "V", "mA", "degC")
UNIT_NUMBERS = numbered(unit.upper() for unit in UNITS)


class Table(NamedTuple):
    """An array of structures."""

    name: str
    kind: str
    rows: list[Value]


def tables(spec: Spec) -> list[Table]:
    """Return the tables of ``i7000.h``."""
    return [
        Table("i7000_types", "i7000_type", [_type(it) for it in spec.rows("type_codes")]),
        Table(
            "i7000_sentinels",
            "i7000_sentinel",
            [_sentinel(it) for it in spec.rows("settings") if it["setting"] == "sentinel"],
        ),
        Table("i7000_models", "i7000_model", [_model(it) for it in spec.rows("models")]),
        Table("i7000_dcon_commands", "i7000_dcon_command", [_command(it, spec) for it in spec.rows("dcon_commands")]),
        Table(
            "i7000_modbus_functions",
            "i7000_modbus_request",
            [_request(it, spec) for it in spec.rows("modbus_functions") if it["name"]],
        ),
        Table(
            "i7000_module_settings", "i7000_modbus_request", [_request(it, spec) for it in spec.rows("module_settings")]
        ),
        Table("i7000_maps", "i7000_map", [_map(it, spec) for it in spec.maps]),
    ]


def _firmware(version: str | None, *, none: int = 0) -> Value:
    """Return a version; `none` is what None means."""
    if version is None:
        return number(none, "I7000_NEVER" if none else "I7000_ANY")
    return firmware(version)


def _bits(mask: int) -> Value:
    return number(mask, f"0x{mask:08X}u")


def _gates(models: dict[str, str | None] | str, spec: Spec, everyone: list[str]) -> Value:
    """Return which models have something, and from which firmware on: one gate a firmware."""
    by_firmware: dict[str | None, list[str]] = {}
    for name, first in (dict.fromkeys(everyone) if isinstance(models, str) else models).items():
        by_firmware.setdefault(first, []).append(name)
    gates = [row(_bits(spec.mask(names)), _firmware(first)) for first, names in by_firmware.items()]
    return items(gates, "i7000_gate")


def _type(it: Record) -> Value:
    decimals = it["engineering_decimals"]
    counts = (number(round(it[end] * 10**decimals)) for end in ("minimum", "maximum", "max"))
    words = (number(int(it[end], 16), f"0x{it[end]}") for end in ("hex_min", "hex_max"))
    return row(
        text(it["name"]), enumerator("UNIT", UNIT_NUMBERS, it["unit"].upper()), number(decimals),
        number(it["hex_signed"]), number(it["thermocouple"] is not None), *counts, *words,
        number(it["modbus_min"]), number(it["modbus_max"]), number(it["modbus_counts_per_unit"]),
        text(it["percent_min"]), text(it["percent_max"]),
    )  # fmt: skip


def _sentinel(it: Record) -> Value:
    is_word = isinstance(it["value"], int)
    types = _ALL_TYPES if it["types"] is None else sum(1 << int(code, 16) for code in it["types"])
    return row(
        enumerator("STATUS", STATUSES, it["name"]), enumerator("FORMAT", FORMATS, it["format"]),
        number(it["until"] is not None), _bits(types),
        optional_text(None if is_word else it["value"]), number(it["value"] & 0xFFFF if is_word else 0),
    )  # fmt: skip


def _model(it: Record) -> Value:
    later = {first for first in it["types"].values() if first}
    (types_from,) = later or {None}  # two firmwares would need a gate for each type
    codes = {code: 1 << int(code, 16) for code in it["types"]}
    return row(
        text(it["name"]), number(int(it["series"])), number("modbus" in it["protocols"]), number(it["channels"]),
        number(it["single_ended_channels"] or it["channels"]), number(it["single_ended_by_command"]),
        number(it["mask_digits"]), number(it["mask_digits_single_ended"] or it["mask_digits"]),
        _default_type(it["default_type"]), number(it["uses_tt"]), number(it["cjc"]),
        number(it["open_wire_detection"]), number(it["fast_mode"]),
        _bits(sum(codes.values())), _bits(sum(bit for code, bit in codes.items() if it["types"][code])),
        _firmware(types_from), _from(it["individually_configurable"]), _from(it["filter"]),
        _firmware(it["character_formats_from"]),
    )  # fmt: skip


def _default_type(code: str | None) -> Value:
    return number(0xFF, "I7000_NO_TYPE") if code is None else number(int(code, 16), f"0x{code}")


def _from(value: str | bool | None) -> Value:  # noqa: FBT001 - as the column has it
    """Return the firmware from which on a model has something: ``always`` or true, a version, or null for never."""
    return _firmware(None) if value in ("always", True) else _firmware(str(value) if value else None, none=NEVER)


def _limits(it: Record) -> Iterator[Value]:
    for end, none in _NO_LIMIT.items():
        yield number(none, f"I7000_NO_{end.upper()}") if it[end] is None else number(it[end])


# --- DCON -------------------------------------------------------------------------------------------------------------


def _command(it: Record, spec: Spec) -> Value:
    pause = it["pause"] or {"seconds": 0, "what": "", "firmware_from": None, "firmware_to": None}
    response = it["response"]
    return row(
        text(it["name"]), text(it["section"]), text(it["syntax"]), optional_text(it["response_syntax"]),
        _message("DCON", response, spec.dcon), _parts(it["parts"], it["fields"], spec),
        _parts(it["response_parts"], it["response_fields"], spec), _gates(it["models"], spec, [*spec.models]),
        number(round(pause["seconds"] * 1000)), number(pause["what"] == "until done"),
        _firmware(pause["firmware_from"]), _firmware(pause["firmware_to"], none=NEVER),
    )  # fmt: skip


def _message(protocol: str, name: str | None, names: dict[str, int]) -> Value:
    return number(0xFF, "I7000_NO_MESSAGE") if name is None else enumerator(protocol, names, name)


def _parts(parts: list[Record], fields: list[Record], spec: Spec) -> Value:
    by_name = {it["name"]: it for it in fields}
    return items([_part(it, by_name.get(it["field"]), spec) for it in parts], "i7000_part")


def _part(it: Record, field: Record | None, spec: Spec) -> Value:
    """Return a part of a body; `field` is its field, None for literal characters."""
    field = field or {"notation": it["literal"], "digits": it["width"], "digits_by": None} | _UNLIMITED
    digits = field["digits"] if isinstance(field["digits"], list) else [field["digits"]]
    name, width = it["field"] or "none", field["digits_by"] or "fixed"
    return row(
        text(field["notation"]), enumerator("FIELD", spec.fields, name), enumerator("KIND", KINDS, it["kind"]),
        enumerator("WIDTH", WIDTHS, width), number(min(digits)), number(max(digits)), *_limits(field),
    )  # fmt: skip


# --- Modbus -----------------------------------------------------------------------------------------------------------


def _request(it: Record, spec: Spec) -> Value:
    function = it.get("function", "46")
    sub_function = it.get("sub_function")
    return row(
        text(it["name"]), text(it["section"]), number(int(function, 16), f"0x{function}"),
        number(int(sub_function, 16), f"0x{sub_function}") if sub_function else number(0xFF, "I7000_NO_SUB_FUNCTION"),
        number(it.get("broadcast", False)), number(it.get("minimum_count") or 0),
        number(it.get("maximum_count") or 0),
        _message("MODBUS", it["response_name"], spec.modbus), text(it["request"]), text(it["response"]),
        _tokens(it["request"], it["fields"], spec), _tokens(it["response"], it["response_fields"], spec),
        _gates(it["models"], spec, spec.modbus_models),
    )  # fmt: skip


def _tokens(pdu: str, fields: list[Record], spec: Spec) -> Value:
    by_name = {it["name"]: it for it in fields}
    return items([_token(token, by_name, spec) for token in pdu.split()], "i7000_token")


def _token(token: str, fields: dict[str, Record], spec: Spec) -> Value:
    name = field_of(token)
    size = token.partition(":")[2]
    counted = {"kind": "unsigned", "bytes": int(size) if size.isdigit() else 1, "bytes_by": None} | _UNLIMITED
    field = fields.get(name or "", counted)  # the count of a write is the number of its values, and no field
    if name is None:
        kind = "bytes" if token == "bytes" else "literal"  # noqa: S105 - of a PDU
    elif token.endswith("+80"):
        kind = "function"
    else:
        kind = "mask" if field["bytes_by"] else field["kind"]
    width = field["bytes"] if isinstance(field["bytes"], int) else 0
    return row(
        enumerator("TOKEN", TOKENS, kind), number(width), number(int(token, 16) if kind == "literal" else 0),
        enumerator("FIELD", spec.fields, name or "none"), *_limits(field),
    )  # fmt: skip


def _map(it: Record, spec: Spec) -> Value:
    rows = [_register(register, it["models"], spec) for register in it["rows"]]
    return row(
        text(it["section"]), _bits(spec.mask(it["models"])), _firmware(it["firmware"]),
        number(it["maximum_write_count"] or 0), items(rows, "i7000_register"),
    )  # fmt: skip


def _register(it: Record, models: list[str], spec: Spec) -> Value:
    values = [row(number(int(code)), text(label)) for code, label in (it["values"] or {}).items()]
    scale = number(0 if it["scale"] is None else round(1 / it["scale"]))
    return row(
        text(it["name"]), optional_text(it["unit"]), scale, number(int(it["first"])), number(it["address"]),
        number(it["count"]), enumerator("AREA", AREAS, it["area"]), number(ACCESS[it["access"]], _access(it)),
        enumerator("REGISTER", REGISTER_TYPES, it["type"]), *_limits(it), items(values, "i7000_value"),
        _bits(spec.mask(it["models"] or models)), _firmware(it["firmware"]),
    )  # fmt: skip


def _access(it: Record) -> str:
    return "I7000_" + {"R": "READ", "W": "WRITE", "R/W": "READ | I7000_WRITE"}[it["access"]]
