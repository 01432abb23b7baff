"""What the dissector takes from ``spec/``: its tables, cut down to the columns that it needs."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from c.generate.spec import Spec

__all__ = ["data"]

Record = dict[Any, Any]
"""An object of JSON, or a table of Lua: its keys may be numbers too, and what is None is left out."""

_SETTINGS_OF_FIELDS = {
    "protocol": "protocol",
    "update": "cjc_update",
    "single_ended": "connecting_mode",
    "modbus_supported": "protocols_supported",
    "first_reading": "synchronized_data",
}
"""The fields whose codes have names in ``settings.json``, and the settings that they are."""


def data(folder: Path) -> Record:
    """Return the tables of the dissector by their names, from the files of ``spec/`` in a folder."""
    spec = Spec(folder)
    settings = spec.rows("settings")
    sentinels = [it for it in settings if it["setting"] == "sentinel"]
    bits = [it for it in settings if it["low_bit"] is not None and it["setting"] not in ("default", "init_mode")]
    commands = [_command(it) for it in spec.rows("dcon_commands")]
    functions = spec.rows("modbus_functions")
    models = spec.rows("models")
    (legacy,) = {last for it in sentinels for last in (it["until"] or {}).values()}
    (exception,) = (it for it in functions if it["function"] == "+80")
    address, values = (
        _part_of(commands, "ReadConfiguration", "address"),
        _part_of(commands, "ReadAnalogInputs", "values"),
    )
    return {
        "MODELS": [_model(it, {row["needs"] for row in bits if row["needs"]}) for it in models],
        "SERIES": dict.fromkeys((it["series"] for it in models), True),
        "TYPES": {int(it["code"], 16): _type(it) for it in spec.rows("type_codes")},
        "LEGACY_UNTIL": legacy,
        "SENTINELS": [_sentinel(it) for it in sentinels],
        "BIT_SETTINGS": [_bit_setting(it) for it in bits],
        "BIT_GROUPS": {letters: _groups(bits, letters) for letters in ("CC", "FF")},
        "CODE_NAMES": {field: _codes(settings, name, field) for field, name in _SETTINGS_OF_FIELDS.items()},
        "DCON_COMMANDS": commands,
        "REFUSED_PARTS": [{"literal": "?", "width": 1}, address],
        "READINGS_PART": values,
        "FUNCTIONS": {int(it["function"], 16): _request(it) for it in functions if it["name"]},
        "MODULE_SETTINGS": {int(it["sub_function"], 16): _request(it) for it in spec.rows("module_settings")},
        "EXCEPTION_FIELDS": _fields(exception["response_fields"]),
        "MAPS": [_map(it) for it in spec.maps],
        "ERRATA": {it["id"]: _some(it, "what", "reading") for it in spec.file("errata.json")["rows"]},
    }


def _some(it: Record, *names: str) -> Record:
    return {name: it[name] for name in names}


def _set(items: Iterable[Any]) -> Record:
    return dict.fromkeys(items, True)


def _gates(it: Record | str | None) -> Record | None:
    """Return the first firmware of each model, false where that is any; None for all models."""
    return {name: first or False for name, first in it.items()} if isinstance(it, dict) else None


def _model(it: Record, needs: set[str]) -> Record:
    columns = (
        "name", "series", "channels", "single_ended_channels", "single_ended_by_command", "individually_configurable",
        "mixed_types", "mask_digits", "mask_digits_single_ended", *sorted(needs),
    )  # fmt: skip
    return _some(it, *columns) | {
        "default_type": None if it["default_type"] is None else int(it["default_type"], 16),
        "types": {int(code, 16): first or False for code, first in it["types"].items()},
    }


def _type(it: Record) -> Record:
    columns = (
        "key", "name", "unit", "minimum", "maximum", "max", "engineering_decimals", "hex_signed",
        "modbus_counts_per_unit",
    )  # fmt: skip
    return {"code": int(it["code"], 16)} | _some(it, *columns)


def _sentinel(it: Record) -> Record:
    return {
        "status": it["name"],
        "format": it["format"],
        "value": it["value"],
        "types": it["types"] and _set(int(code, 16) for code in it["types"]),
        "legacy": True if it["until"] else None,
        "not_legacy": True if it["firmware"] else None,
    }


def _bit_setting(it: Record) -> Record:
    columns = _some(it, "low_bit", "bits", "code", "name", "needs")
    return {"letters": it["where"][:2]} | columns | {"firmware": _gates(it["firmware"])}


def _groups(bits: list[Record], letters: str) -> int:
    return len({it["low_bit"] for it in bits if it["where"].startswith(letters) and it["code"] is not None})


def _codes(settings: list[Record], name: str, field: str) -> Record:
    """Return the names of codes; the codes of the fields that are truth values are truth values too."""
    is_bool = field not in ("protocol", "update")
    codes = {it["code"]: it["name"] for it in settings if it["setting"] == name}
    return {bool(code): text for code, text in codes.items()} if is_bool else codes


def _field(it: Record) -> Record:
    """Return a field with unit and scale apart: ``0.1 s`` is 0.1 and ``s``."""
    unit, scale = it["unit"], it.get("scale")
    if unit and " " in unit:
        count, unit = unit.split(" ")
        scale = float(count)
    legal = it["legal"]
    return _some(it, "name", "kind", "minimum", "maximum", "meaning") | {
        "legal": _set(legal) if isinstance(legal, list) else legal,
        "unit": unit,
        "scale": scale if scale is None or isinstance(scale, list) else [scale],
    }


def _fields(fields: list[Record]) -> Record:
    return {it["name"]: _field(it) for it in fields}


def _part(it: Record, fields: dict[str, Record]) -> Record:
    """Return a part of a syntax: its characters, or its field. A width that varies has digits in its place."""
    width = it["width"] if isinstance(it["width"], int) else None
    if it["literal"] is not None:
        return {"literal": it["literal"], "width": width}
    field = fields[it["field"]]
    digits = field["digits"]
    return _field(field) | {
        "width": width,
        "offset": it["offset"] if width is None else None,
        "digits": digits if isinstance(digits, list) else None,
        "digits_by": field["digits_by"],
    }


def _parts(it: Record, side: str) -> list[Record]:
    fields = {field["name"]: field for field in it[f"{side}fields"]}
    return [_part(part, fields) for part in it[f"{side}parts"]]


def _command(it: Record) -> Record:
    columns = ("name", "section", "syntax", "description", "response", "response_syntax", "errata")
    parts = {"parts": _parts(it, ""), "response_parts": _parts(it, "response_")}
    return _some(it, *columns) | parts | {"models": _gates(it["models"])}


def _part_of(commands: list[Record], command: str, field: str) -> Record:
    (row,) = (it for it in commands if it["name"] == command)
    found: Record
    (found,) = (it for it in row["response_parts"] if it.get("name") == field)
    return found


def _request(it: Record) -> Record:
    columns = ("name", "section", "request", "response_name", "response", "description", "errata")
    limits = {name: it.get(name) for name in ("minimum_count", "maximum_count", "broadcast")}
    limits["models"] = _gates(it["models"])
    return (
        _some(it, *columns)
        | limits
        | {
            "request_fields": _fields(it["fields"]),
            "response_fields": _fields(it["response_fields"]),
            "exceptions": {refusal["code"]: "; ".join(refusal["when"]) for refusal in it["exceptions"]},
        }
    )


def _map(it: Record) -> Record:
    return {"models": _set(it["models"]), "rows": [_register(row) for row in it["rows"]]}


def _register(it: Record) -> Record:
    columns = (
        "name", "area", "address", "count", "access", "type", "unit", "scale", "minimum", "maximum", "meaning",
        "firmware",
    )  # fmt: skip
    legal = it["legal"]
    return _some(it, *columns) | {
        "legal": _set(legal) if isinstance(legal, list) else legal,
        "values": it["values"] and {int(code): text for code, text in it["values"].items()},
        "models": it["models"] and _set(it["models"]),
    }
