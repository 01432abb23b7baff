"""The index of ``spec/``: it follows the files, and it is a true and whole account of them."""

from __future__ import annotations

import json
import re
import shutil
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import pytest
from jsonschema import Draft202012Validator

from i7000 import spec
from tests.spec import index, lint

if TYPE_CHECKING:
    from pathlib import Path

INDEX: dict[str, Any] = json.loads((lint.SPEC / lint.INDEX).read_text(encoding="utf-8"))
SECTIONS = {entry["section"]: entry for entry in INDEX["sections"]}


def test_the_index_follows_the_files() -> None:
    assert index.faults() == []


def test_the_index_fits_its_schema() -> None:
    schema = lint.load(lint.SPEC / "schema" / lint.INDEX)

    assert [error.message for error in Draft202012Validator(schema).iter_errors(INDEX)] == []
    assert set(INDEX["notes"]) == set(INDEX) - {"title", "source", "notes"}


def test_a_change_of_a_file_is_a_drift_that_names_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    copy = shutil.copytree(lint.SPEC, tmp_path / "spec")
    monkeypatch.setattr(lint, "SPEC", copy)
    monkeypatch.setattr(index, "INDEX", copy / lint.INDEX)
    assert index.faults() == []

    license_of_the_copy = copy / "LICENSE"
    license_of_the_copy.write_text(license_of_the_copy.read_text() + "\n")

    assert index.faults() == [f"index.json: does not follow the other files: run {index.COMMAND}"]
    assert [index.fix(), index.fix(), index.faults()] == [True, False, []]


def test_every_file_is_listed_with_its_digest() -> None:
    found = {path: (lint.SPEC / path).read_bytes() for path in (entry["name"] for entry in INDEX["files"])}
    on_disk = {lint.name(path) for path in lint.SPEC.rglob("*") if path.is_file()}

    assert on_disk - found.keys() == {lint.INDEX}
    assert [(len(data), sha256(data).hexdigest()) for data in found.values()] == [
        (entry["bytes"], entry["sha256"]) for entry in INDEX["files"]
    ]


def test_the_files_that_the_package_knows_are_those_of_the_index() -> None:
    names = {name for name, _ in spec.data_files(spec.files())}

    assert names == {entry["name"] for entry in INDEX["files"]} | {lint.INDEX}


def test_the_totals_are_the_records_of_the_files() -> None:
    def records(folder: str) -> int:
        return sum(entry["records"] or 0 for entry in INDEX["files"] if entry["name"].startswith(folder))

    assert INDEX["totals"] == {
        **{folder: records(f"{folder}/") for folder in ("tables", "vectors", "stories", "checks")},
        "errata": records("errata.json"),
    }
    assert INDEX["totals"]["vectors"] == len([*lint.vectors()])


def test_all_about_one_command_is_in_one_place() -> None:
    entry = SECTIONS["2.10"]

    assert entry["requests"] == [{"name": "ReadConfiguration", "syntax": "$AA2"}]
    assert entry["rows"] == [{"file": "tables/dcon_commands.json", "key": "ReadConfiguration"}]
    assert [it["file"] for it in entry["vectors"]] == ["vectors/dcon/2.10-read-configuration.json"]
    assert "story-configuration-read-configuration" in entry["stories"]
    assert entry["errata"] == [row["id"] for row in lint.rows("errata") if "2.10" in row["sections"]]
    assert {"TYPE_CODE_MIXED", "BAUD_9600", "E81", "HEX", "REJECT_50_HZ"} <= set(entry["settings"])
    assert "dcon/2.10/reply" in entry["checks"]


@pytest.mark.parametrize("kind", ["stories", "checks", "errata"])
def test_every_record_with_sections_is_under_each_of_them(kind: str) -> None:
    records = {
        "stories": [*lint.stories()],
        "checks": [row for path in lint.check_files() for row in lint.records(lint.load(path))],
        "errata": lint.rows("errata"),
    }[kind]
    expected = {(section, record["id"]) for record in records for section in record["sections"]}

    assert {(section, it) for section, entry in SECTIONS.items() for it in entry[kind]} == expected


def test_every_row_of_a_table_is_under_a_section() -> None:
    listed = [(row["file"], row["key"]) for entry in INDEX["sections"] for row in entry["rows"]]
    expected = {
        (lint.name(path), index.key_of(row))
        for path in lint.table_files()
        if path.stem not in ("full_scale", "models")
        for row in lint.load(path)["rows"]
    }

    assert set(listed) == expected


def test_the_settings_of_a_field_are_under_the_section_of_its_message() -> None:
    rates = {"BAUD_1200", "BAUD_115200", "O81"}
    having = [section for section, entry in SECTIONS.items() if rates <= set(entry["settings"])]

    assert having == ["1.11", "2.1", "2.10", "3.3.3", "3.3.4", *(f"3.4.{number}" for number in range(1, 10))]
    assert SECTIONS["3.3.10"]["settings"] == ["MODE_NORMAL", "MODE_FAST", "REJECT_60_HZ", "REJECT_50_HZ"]
    assert "HOST_WATCHDOG_STATUS_ENABLED" in SECTIONS["2.36"]["settings"]


# Version, changes, licence


def test_the_version_is_semantic_and_the_first_of_the_changelog() -> None:
    version = index.version()
    changelog = (lint.SPEC / "CHANGELOG.md").read_text(encoding="utf-8")

    assert re.fullmatch(r"[0-9]+\.[0-9]+\.[0-9]+", version)
    assert version == INDEX["version"] == spec.version()
    assert re.findall(r"^## (\S+)", changelog, re.MULTILINE)[0] == version


def test_the_licence_of_the_data_is_that_of_the_project() -> None:
    assert (lint.SPEC / "LICENSE").read_bytes() == (lint.SPEC.parent / "LICENSE").read_bytes()
