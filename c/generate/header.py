"""``i7000.h`` as text: enumerations, declarations and tables in their template."""

from collections.abc import Iterator
from pathlib import Path

from c.generate.spec import STATUSES, Spec, constants
from c.generate.tables import UNITS, Table
from c.generate.values import Value, enum, lines, numbered, text, upper

__all__ = ["definition", "filled", "header", "name_tables"]

_TEMPLATES = Path(__file__).with_name("templates")


def filled(template: str, **parts: Iterator[str]) -> str:
    """Return a template with lines in place of each ``/* @part */``."""
    written = (_TEMPLATES / template).read_text("utf-8")
    for name, found in parts.items():
        written = written.replace(f"/* @{name} */", "\n".join(found))
    return written


def header(spec: Spec, found: list[Table]) -> str:
    """Return ``i7000.h`` with some tables."""
    return filled("i7000.h", enums=_enums(spec, found), externs=_externs(spec, found), tables=_definitions(spec, found))


def name_tables(spec: Spec) -> dict[str, list[Value]]:
    """Return the arrays of names, by the names of the arrays."""
    kinds = {"fault": spec.faults, "field": spec.fields, "dcon": spec.dcon, "modbus": spec.modbus, "status": STATUSES}
    names = {f"i7000_{kind}_names": [text(name) for name in values] for kind, values in kinds.items()}
    return names | {"i7000_unit_names": [text(unit) for unit in UNITS]}


def definition(kind: str, name: str, values: list[Value]) -> Iterator[str]:
    """Yield the definition of an array."""
    yield f"{kind} {name}[{len(values)}] = {{"
    for value in values:
        yield from lines(value.source, 4, ",")
    yield "};"


def _enums(spec: Spec, found: list[Table]) -> Iterator[str]:
    settings = {it["key"]: it["code"] for it in spec.rows("settings") if it["code"] is not None}
    sizes = {table.name: table.rows for table in found} | name_tables(spec)
    for title, prefix, values in (
        ("Type codes.", "TYPE_", spec.type_keys),
        ("Models: places in i7000_models, and bits of masks.", "MODEL_", numbered(spec.model_keys)),
        ("Codes of settings, within their bits; limits and defaults.", "SETTING_", settings),
        ("Messages of DCON; first the commands, which have the numbers of their rows.", "DCON_", constants(spec.dcon)),
        ("Messages of Modbus; first the functions, then the sub-functions.", "MODBUS_", constants(spec.modbus)),
        ("Fields of messages.", "FIELD_", constants(spec.fields)),
        ("Why bytes are rejected; spec/dcon.md and spec/modbus.md say when.", "FAULT_", constants(spec.faults)),
        ("Sizes of the arrays.", "", {upper(f"{name[6:]}_size"): len(rows) for name, rows in sizes.items()}),
    ):
        yield from enum(title, f"I7000_{prefix}", values)


def _externs(spec: Spec, found: list[Table]) -> Iterator[str]:
    yield from (f"extern const {it.kind} {it.name}[{len(it.rows)}];" for it in found)
    for name, values in name_tables(spec).items():
        yield f"extern const char *const {name}[{len(values)}];"


def _definitions(spec: Spec, found: list[Table]) -> Iterator[str]:
    for table in found:
        yield from definition(f"const {table.kind}", table.name, table.rows)
    for name, values in name_tables(spec).items():
        yield from definition("const char *const", name, values)
