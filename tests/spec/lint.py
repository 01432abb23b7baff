"""The canonical text of the files under ``spec/``, and the walks over them that their tests share.

``python -m tests.spec.lint`` prints what is wrong with the files, a line each: JSON that cannot be read, a record that
does not fit its schema, text that is not canonical, an index of other files than these. With ``--fix`` it makes the
text canonical first, and the index anew.

Laws: a data file is one JSON object with a top-level key a line and a record a line, and of a story a step a line, but
no line is longer than `LONGEST`; keys stand in the order of the schema; a schema is indented by two. Nothing here knows
what a field means.
"""

from __future__ import annotations

import json
import marshal
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from jsonschema import Draft202012Validator

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

Json: TypeAlias = Any
Record: TypeAlias = dict[str, Any]

SPEC = Path(__file__).parents[2] / "spec"

SCHEMAS = {
    "tables/modbus_registers": "modbus_registers",
    "vectors/dcon": "dcon_vectors",
    "vectors/modbus": "modbus_vectors",
    "vectors/readings": "reading_vectors",
    "vectors/readings/legacy.json": "legacy_vectors",
    "vectors/readings/rejected.json": "reading_reject_vectors",
    "vectors/readings/channels.json": "channel_vectors",
    "vectors/registers": "register_vectors",
    "vectors/frames/checksums.json": "checksum_vectors",
    "vectors/frames/split.json": "split_vectors",
    "vectors/frames/rtu_split.json": "rtu_split_vectors",
    "vectors/frames/crc.json": "crc_vectors",
    "stories": "stories",
    "checks": "checks",
}
"""Which schema a file, or else every file of a folder, has; any other file has the schema of its own name."""
INDEX = "index.json"
"""The one file that is generated, by `tests.spec.index`."""


def data_files() -> list[Path]:
    """Every table, the errata, every vector file and every story file: all that is written by hand."""
    return sorted(path for path in SPEC.rglob("*.json") if path.parent != SPEC / "schema" and name(path) != INDEX)


def schema_files() -> list[Path]:
    """Every schema."""
    return sorted((SPEC / "schema").glob("*.json"))


def table_files(folder: str = "") -> list[Path]:
    """Every file under ``spec/tables/`` and the folder named."""
    return sorted((SPEC / "tables" / folder).rglob("*.json"))


def vector_files(folder: str = "") -> list[Path]:
    """Every file under ``spec/vectors/`` and the folder or file named."""
    root = SPEC / "vectors" / folder
    return [root] if root.is_file() else sorted(root.rglob("*.json"))


def story_files() -> list[Path]:
    """Every file of stories."""
    return sorted((SPEC / "stories").glob("*.json"))


def check_files() -> list[Path]:
    """Every file of checks."""
    return sorted((SPEC / "checks").glob("*.json"))


def name(path: Path) -> str:
    """The path under ``spec/``, with slashes."""
    return path.relative_to(SPEC).as_posix() if path.is_relative_to(SPEC) else path.name


def load(path: Path) -> Record:
    """Read one file, refusing an object that names a key twice."""
    data: Record = marshal.loads(_read(path.read_text(encoding="utf-8")))  # noqa: S302 - what `_read` has made
    return data


@cache
def _read(text: str) -> bytes:
    """Parse a file once; what is made of these bytes is a copy of its own for each caller, in a tenth of the time."""
    try:
        data: Record = json.loads(text, object_pairs_hook=_unique)
    except json.JSONDecodeError as error:
        before = " ".join(text[: error.pos].split())[-_SHOWN:]
        after = " ".join(text[error.pos :].split())[:_SHOWN]
        reason = error.msg[0].lower() + error.msg[1:]
        raise ValueError(f"line {error.lineno}: {reason} between {before!r} and {after!r}") from None
    return marshal.dumps(data)


_SHOWN = 30
"""Characters of the text on each side of a slip that a message shows."""


def _unique(pairs: list[tuple[str, Json]]) -> Record:
    record = dict(pairs)
    if len(record) < len(pairs):
        keys = [key for key, _ in pairs]
        raise ValueError(f"a key twice in {keys}")
    return record


def rows(table: str) -> list[Record]:
    """The rows of one table, by its name under ``tables/`` without ending; ``errata`` too.

    Where the models of a row are ``all``, they are listed.
    """
    path = SPEC / f"{table}.json" if table == "errata" else SPEC / "tables" / f"{table}.json"
    found: list[Record] = load(path)["rows"]
    for row in found:
        if row.get("models") == "all":
            row["models"] = all_models("dcon" if table == "dcon_commands" else "modbus")
    return found


def all_models(protocol: str) -> dict[str, None]:
    """The models that speak a protocol, as a table lists them where none has a limit of firmware."""
    return {row["name"]: None for row in rows("models") if protocol in row["protocols"]}


def vectors(folder: str = "") -> Iterator[tuple[Path, Record]]:
    """Every vector under the folder, or in the file, with the file it stands in."""
    for path in vector_files(folder):
        for vector in load(path)["vectors"]:
            yield path, vector


def stories() -> Iterator[Record]:
    """Every story of every file."""
    for path in story_files():
        yield from load(path)["stories"]


def records(data: Mapping[str, Json]) -> list[Record]:
    """The rows, vectors or stories of one file."""
    found: list[Record] = next(data[key] for key in ("vectors", "stories", "rows") if key in data)
    return found


def schema_path(path: Path) -> Path:
    """The file with the schema of a data file."""
    own = name(path)
    stem = SCHEMAS.get(own) or SCHEMAS.get(name(path.parent)) or path.stem
    return SPEC / "schema" / f"{stem}.json"


def canonical(data: Mapping[str, Json]) -> str:
    """The one way to write a file: schemas indented, everything else a record a line, and the steps of a story too.

    An object or list that makes a line longer than `LONGEST` has a line for each of its items.
    """
    if "$schema" in data:
        return json.dumps(data, ensure_ascii=False, indent=2) + "\n"
    entries = [f"  {_line(key)}: {_value(value, len(key) + 4)}" for key, value in data.items()]
    return "{\n" + ",\n".join(entries) + "\n}\n"


LONGEST = 1000
"""The most characters of a line, if no text is longer by itself."""


def _line(value: Json) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(", ", ": "))


def _value(value: Json, before: int) -> str:
    if isinstance(value, list) and value and all(isinstance(item, dict) for item in value):
        return _lines("[]", (_record(item) for item in value), 2)
    return _fitting(value, 2, before)


def _record(record: Record) -> str:
    if "steps" not in record:
        return _fitting(record, 4)
    head = _line({key: value for key, value in record.items() if key != "steps"})
    return f'{head[:-1]}, "steps": {_lines("[]", (_fitting(step, 6) for step in record["steps"]), 4)}}}'


def _fitting(value: Json, indent: int, before: int = 0) -> str:
    """A value on one line if it has room there, behind as many blanks and characters and before a comma."""
    text = _line(value)
    if indent + before + len(text) < LONGEST or not isinstance(value, dict | list):
        return text
    if isinstance(value, list):
        return _lines("[]", (_fitting(item, indent + 2) for item in value), indent)
    keys = {_line(key): item for key, item in value.items()}
    return _lines("{}", (f"{key}: {_fitting(item, indent + 2, len(key) + 2)}" for key, item in keys.items()), indent)


def _lines(brackets: str, items: Iterable[str], indent: int) -> str:
    """The items of a list or object, one a line, between its brackets."""
    inner = ",\n".join(f"{' ' * (indent + 2)}{item}" for item in items)
    return f"{brackets[0]}\n{inner}\n{' ' * indent}{brackets[1]}"


def ordered(value: Json, schema: Mapping[str, Json], root: Mapping[str, Json] | None = None) -> Json:
    """The same value with the keys of every object in the order of its schema; a key that it lacks comes last."""
    root = schema if root is None else root
    if isinstance(value, list):
        items = _resolve(value, schema, root).get("items", {})
        return [ordered(item, items, root) for item in value]
    if isinstance(value, dict):
        properties = _resolve(value, schema, root).get("properties", {})
        keys = [key for key in properties if key in value] + [key for key in value if key not in properties]
        return {key: ordered(value[key], properties.get(key, {}), root) for key in keys}
    return value


def _resolve(value: Json, schema: Mapping[str, Json], root: Mapping[str, Json]) -> Mapping[str, Json]:
    """The schema that states the properties or items of this value, behind references and alternatives."""
    if "$ref" in schema:
        return _resolve(value, root["$defs"][schema["$ref"].rpartition("/")[2]], root)
    for branch in schema.get("anyOf", []) + schema.get("oneOf", []):
        found = _resolve(value, branch, root)
        if _fits(value, found):
            return found
    return schema


def _fits(value: Json, schema: Mapping[str, Json]) -> bool:
    if isinstance(value, list):
        return "items" in schema
    properties = schema.get("properties", {})
    return set(value) == set(properties) and all(
        properties[key].get("const", item) == item for key, item in value.items()
    )


def canonical_file(path: Path) -> str:
    """What the file should say, byte for byte."""
    data = load(path)
    if path.parent != SPEC / "schema":
        data = ordered(data, load(schema_path(path)))
    return canonical(data)


def misfits(path: Path) -> Iterator[str]:
    """What does not fit the schema of a file: the record by its name, the place in it, and the reason."""
    data = load(path)
    for error in Draft202012Validator(load(schema_path(path))).iter_errors(data):
        key, *rest = error.absolute_path or ("",)
        place = [str(part) for part in rest]
        if place and isinstance(data[key], list):
            record = data[key][int(place[0])]
            names = (record.get(column) for column in ("id", "name", "section", "code", "type_code"))
            place[0] = str(next((known for known in names if known is not None), f"number {int(place[0]) + 1}"))
        where = ": ".join(part for part in (str(key), *place) if part)
        yield f"{where}: {error.message[:300]}"


def faults(path: Path) -> list[str]:
    """What is wrong with one file."""
    try:
        found = [] if path.parent == SPEC / "schema" else list(misfits(path))
        if not found and path.read_bytes() != canonical_file(path).encode():
            found = ["not canonical: run python -m tests.spec.lint --fix"]
    except ValueError as error:
        found = [str(error)]
    return [f"{name(path)}: {fault}" for fault in found]


def fix(path: Path) -> bool:
    """Rewrite one file canonically; return whether it was not."""
    text = canonical_file(path)
    if path.read_bytes() == text.encode():
        return False
    path.write_bytes(text.encode())
    return True


def main(arguments: Sequence[str]) -> int:
    """Check every file, after rewriting it with ``--fix``; the exit status is 1 if something is wrong."""
    from tests.spec import index  # noqa: PLC0415 - that stands on this module

    paths = data_files() + schema_files()
    if "--fix" in arguments:
        for path in paths:
            with suppress(ValueError):
                if fix(path):
                    sys.stdout.write(f"{name(path)} rewritten\n")
    wrong = [fault for path in paths for fault in faults(path)]
    if "--fix" in arguments and not wrong and index.fix():
        sys.stdout.write(f"{INDEX} rewritten\n")
    wrong = wrong or index.faults()
    for fault in wrong:
        sys.stdout.write(f"{fault}\n")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
