"""The records of what was read: JSON that is put together, against the JSON of the record as a whole."""

import json

import pytest

from i7000.cli import records
from i7000.cli.readers import of_lines
from i7000.cli.records import json_of, meaning_record
from i7000.dissect import Knowledge, Known
from tests.spec.lint import Record
from tests.vectors import dcon_vectors, modbus_vectors, profile_of

EXCHANGES = [
    ([vector[f"{asked}_wire"], vector["response_wire"]], vector["profile"])
    for asked, cases in (
        ("command", dcon_vectors("response", "refused", "silence", "reject")),
        ("request", modbus_vectors("response", "exception", "silence", "reject")),
    )
    for case in cases
    for vector in case.values
][::3]


def differing(wires: list[str], profile: Record) -> list[str]:
    """The frames whose meaning is another one in their JSON."""
    knowledge = Knowledge.given(Known.of(profile_of(profile)))
    found = []
    for read in of_lines(enumerate(filter(None, wires), 1), knowledge, None):
        record = json.loads(json_of(read))
        meanings = () if read.heard is None else read.heard.meanings
        if len(meanings) == 1 and not json.loads(json.dumps(meaning_record(meanings[0]))).items() <= record.items():
            found.append(record["text"])
    return found


def test_the_json_of_a_meaning_is_that_of_its_record() -> None:
    assert [text for wires, profile in EXCHANGES for text in differing(wires, profile)] == []


def test_the_json_is_the_same_if_nothing_is_remembered(monkeypatch: pytest.MonkeyPatch) -> None:
    lines = list(enumerate(("$012", "!010F0600", "#01", ">+0025.1+9999.9       ", "$022", "!020F0600"), 1))

    def all_json() -> list[str]:
        return [json_of(read) for read in of_lines(lines, Knowledge.given(Known(checksum=False)), None)]

    remembered = all_json()
    for name in ("_around", "_reading_form", "_item_form", "_remembered_json"):
        monkeypatch.setattr(records, name, getattr(records, name).__wrapped__)

    assert all_json() == remembered
