"""The generated index of ``spec/``: its version, what every file holds, and all that is about each section.

``python -m tests.spec.lint --fix`` writes it, after it has made the other files canonical.

Laws: everything in it follows from the other files, so nothing is written by hand; it is JSON with one value a line.
"""

from __future__ import annotations

import json
from collections import defaultdict
from hashlib import sha256
from typing import TYPE_CHECKING

from tests.spec import lint

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from tests.spec.lint import Record

INDEX = lint.SPEC / "index.json"
COMMAND = "python -m tests.spec.lint --fix"
"""What makes the index follow a change of another file."""
LICENCE = ("VERSION", "LICENSE")
"""The files without an ending that belong to the data."""
CODES: dict[str, Callable[[Record], bool]] = {
    "line_settings": lambda row: row["where"].startswith("CC"),
    "report_settings": lambda row: row["where"].startswith("FF"),
    "settings": lambda row: row["setting"] in ("filter", "mode"),
    "status": lambda row: row["where"].startswith("SS"),
    "type_code": lambda row: row["where"].startswith("TT"),
}
"""The fields and registers whose codes are rows of ``settings.json``, and which they are."""
NOTES = {
    "version": "That of the data, see README.md; it is in VERSION too.",
    "totals": "How many records there are: rows of tables, vectors, stories, checks and errata.",
    "files": "Every other file of the data: its size in bytes, its SHA-256, and its records (null where it has none).",
    "sections": "What is about a section of the manual: requests, the commands and requests with syntax or PDU; rows, "
    "the rows of tables by file and key; vectors, how many are in a file that is about the section; stories, errata "
    "and checks by their ids; settings, the rows of settings.json whose codes stand in its fields, by key.",
}


def released_files() -> list[Path]:
    """Every file of the data except the index, in the order of the names."""
    found = (path for path in lint.SPEC.rglob("*") if path.is_file() and path != INDEX)
    return sorted((path for path in found if path.suffix in (".json", ".md") or path.name in LICENCE), key=lint.name)


def version() -> str:
    """The version of the data."""
    return (lint.SPEC / "VERSION").read_text(encoding="utf-8").strip()


def key_of(row: Record) -> str:
    """The identifier of a row of a table."""
    key: str = row.get("key") or row["name"]
    return key


def build() -> Record:
    """The index of the files as they are."""
    loaded = {path: lint.load(path) for path in lint.data_files()}
    return {
        "title": "Index: the files, and what is about each section of the manual",
        "source": "the other files",
        "notes": NOTES,
        "version": version(),
        "totals": _totals(loaded),
        "files": [_file(path, loaded.get(path)) for path in released_files()],
        "sections": [*_sections(loaded)],
    }


def text() -> str:
    """The index as it stands in its file."""
    return json.dumps(build(), ensure_ascii=False, indent=1) + "\n"


def faults() -> list[str]:
    """What is wrong with the index in the file."""
    told = INDEX.read_text(encoding="utf-8") if INDEX.exists() else ""
    return [] if told == text() else [f"index.json: does not follow the other files: run {COMMAND}"]


def fix() -> bool:
    """Write the index; return whether it was another one."""
    if not faults():
        return False
    INDEX.write_text(text(), encoding="utf-8")
    return True


def _totals(loaded: dict[Path, Record]) -> Record:
    counts: dict[str, int] = dict.fromkeys(("tables", "vectors", "stories", "checks", "errata"), 0)
    for path, data in loaded.items():
        counts[lint.name(path).partition("/")[0].removesuffix(".json")] += len(lint.records(data))
    return counts


def _file(path: Path, data: Record | None) -> Record:
    content = path.read_bytes()
    return {
        "name": lint.name(path),
        "bytes": len(content),
        "sha256": sha256(content).hexdigest(),
        "records": None if data is None else len(lint.records(data)),
    }


def _sections(loaded: dict[Path, Record]) -> Iterator[Record]:
    found: dict[str, Record] = defaultdict(_empty)
    for path, data in loaded.items():
        file = lint.name(path)
        kind = file.partition("/")[0]
        for record in lint.records(data):
            for section in _sections_of(record, data):
                _add(found[section], kind, file, record)
    codes = _codes_of_fields(loaded)
    order = [row["key"] for row in loaded[lint.SPEC / "tables" / "settings.json"]["rows"]]
    for section in sorted(found, key=place):
        settings = [*found[section]["settings"], *codes.get(section, ())]
        yield {"section": section, **found[section], "settings": sorted(set(settings), key=order.index)}


def _empty() -> Record:
    return {name: [] for name in ("requests", "rows", "vectors", "stories", "errata", "settings", "checks")}


def _sections_of(record: Record, data: Record) -> list[str]:
    """The sections that a record, or else its file, is about."""
    if "sections" in record:
        return [str(section) for section in record["sections"]]
    section = record.get("section") or data.get("section")
    return [] if section is None else [section]


def _add(entry: Record, kind: str, file: str, record: Record) -> None:
    if kind == "tables":
        entry["rows"].append({"file": file, "key": key_of(record)})
        if file.endswith("/settings.json"):
            entry["settings"].append(key_of(record))
        syntax = record.get("syntax") or record.get("request")
        if syntax:
            entry["requests"].append({"name": record["name"], "syntax": syntax})
    elif kind == "vectors":
        same = next((it for it in entry["vectors"] if it["file"] == file), None)
        if same is None:
            same = {"file": file, "count": 0}
            entry["vectors"].append(same)
        same["count"] += 1
    else:
        entry[kind.removesuffix(".json")].append(record["id"])


def _codes_of_fields(loaded: dict[Path, Record]) -> dict[str, list[str]]:
    """The keys of the settings whose codes stand in the fields and registers of each section."""
    rows = loaded[lint.SPEC / "tables" / "settings.json"]["rows"]
    codes = [row for row in rows if row["where"] and row["setting"] not in ("default", "init_mode", "limit")]
    found: dict[str, list[str]] = defaultdict(list)
    for path, data in loaded.items():
        for record in lint.records(data) if path.is_relative_to(lint.SPEC / "tables") else ():
            parts = [record, *record.get("fields", ()), *record.get("response_fields", ())]
            for name in CODES.keys() & {part.get("name") for part in parts}:
                found[record.get("section") or data["section"]] += [row["key"] for row in codes if CODES[name](row)]
    return found


def place(section: str) -> list[tuple[bool, int, str]]:
    """Where a section stands in the manual: chapters by number, then appendices by letter."""
    return [(not part.isdigit(), int(part) if part.isdigit() else 0, part) for part in section.split(".")]
