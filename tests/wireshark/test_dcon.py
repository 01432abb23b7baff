"""tshark gives the DCON vectors the names, values and faults that they have in ``spec/``."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.spec.lint import SPEC
from tests.wireshark import DCON, Dissected, Lines, Seen, as_written, close, vectors_seen

KNOWN = ("dcon.message", "dcon.fault", "dcon.reading", "dcon.response_to", "_ws.expert.message")
COMMANDS = json.loads((SPEC / "tables/dcon_commands.json").read_text("utf-8"))["rows"]
FIELDS = sorted(
    {
        field["name"]
        for row in COMMANDS
        for field in row["fields"] + row["response_fields"]
        if field["kind"] not in ("reading", "readings")
    }
)
OUT_OF_RANGE = "is out of range"
TWO_FRAMES = "dcon-2.10-two-frames"
"""Two commands in one packet, which the dissector takes apart."""


@pytest.fixture(scope="module")
def seen(tmp_path_factory: pytest.TempPathFactory) -> list[Dissected]:
    fields = [*KNOWN, *(f"dcon.{name}" for name in FIELDS)]
    return vectors_seen(tmp_path_factory.mktemp("dcon"), DCON, "dcon", "command", fields)


def said(message: dict[str, Any], seen: Seen) -> dict[str, Any]:
    """Return what tshark says of a message, in the form of the vectors."""
    fields: dict[str, Any] = {}
    for name, value in message["fields"].items():
        if name in ("value", "values"):
            fields[name] = seen["dcon.reading"] if isinstance(value, list) else "".join(seen["dcon.reading"])
        else:
            fields[name] = as_written(value, seen[f"dcon.{name}"])
    return {"type": "".join(seen["dcon.message"]), "fields": fields}


def test_every_message_has_the_name_and_values_of_its_vector(seen: list[Dissected]) -> None:
    checked = 0
    for it in seen:
        if it.vector["outcome"] == "reject":
            continue
        for side, found in (("command", it.sent), ("response", it.received)):
            message = it.vector[side]
            if message and found:
                checked += 1
                assert (it.vector["id"], [], message) == (it.vector["id"], found["dcon.fault"], said(message, found))
    assert checked > 850


def test_every_rejected_frame_has_the_fault_of_its_vector(seen: list[Dissected]) -> None:
    checked = 0
    for it in seen:
        found = it.received or it.sent
        if it.vector["outcome"] == "reject" and found and it.vector["id"] != TWO_FRAMES:
            checked += 1
            assert (it.vector["id"], [it.vector["fault"]]) == (it.vector["id"], found["dcon.fault"])
            assert (it.vector["id"], []) == (it.vector["id"], found["dcon.message"]) or it.vector["fault"] == "checksum"
    assert checked > 800


def test_what_no_host_sends_is_out_of_range_and_nothing_else(seen: list[Dissected]) -> None:
    refused = 0
    for it in seen:
        if it.vector["command"] and it.sent:
            flagged = any(OUT_OF_RANGE in text for text in it.sent["_ws.expert.message"])
            refused += flagged
            assert (it.vector["id"], "host-refuses" in it.vector["flags"]) == (it.vector["id"], flagged)
    assert refused > 40


def test_every_response_names_the_packet_of_its_command(seen: list[Dissected]) -> None:
    paired = [it for it in seen if it.vector["outcome"] in ("response", "refused") and it.received]

    assert len(paired) > 400
    assert all(it.received and it.received["dcon.response_to"] for it in paired)


def test_a_refusal_and_every_erratum_of_the_command_are_expert_infos(seen: list[Dissected]) -> None:
    errata = {row["name"]: row["errata"] for row in COMMANDS}
    for it in seen:
        if it.vector["outcome"] == "refused" and it.received and it.sent and it.vector["command"]:
            name = it.vector["command"]["type"]
            assert f"Refused: {name}" in it.received["_ws.expert.message"]
            told = [text.partition(":")[0] for text in it.sent["_ws.expert.message"]]
            assert errata[name] == [text for text in told if text.startswith("E")]


READING = ("dcon.reading.value", "dcon.reading.unit", "dcon.reading.status", "dcon.expert.not_of_type")


def reading_vectors(*names: str) -> list[dict[str, Any]]:
    """Return the vectors of files in ``vectors/readings``."""
    return [
        vector
        for name in names
        for vector in json.loads((SPEC / f"vectors/readings/{name}.json").read_text("utf-8"))["vectors"]
    ]


def test_every_reading_has_value_unit_and_status(tmp_path: Path) -> None:
    lines = Lines(DCON)
    chosen = [it for it in reading_vectors("engineering", "percent", "hex") if it["direction"] != "encode"]
    for it in chosen:
        profile = {
            "model": "M-7019R", "firmware": None, "type_codes": [int(it["type_code"], 16)],
            "data_format": it["format"], "checksum": False, "single_ended": False,
        }  # fmt: skip
        lines.add(profile, b"#010\r".hex(), sent=True)
        lines.add(profile, f">{it['text']}\r".encode().hex(), sent=False)

    found = lines.dissect(tmp_path, READING)[1::2]

    assert len(chosen) > 1_000
    for it, one in zip(chosen, found, strict=True):
        if "lenient" in it["flags"]:
            assert (it["id"], 1) == (it["id"], len(one["dcon.expert.not_of_type"]))
            continue
        value = close([it["value"]])
        assert (it["id"], value, [it["status"]], [it["unit"]]) == (
            it["id"], [float(text) for text in one["dcon.reading.value"]], one["dcon.reading.status"],
            one["dcon.reading.unit"],
        )  # fmt: skip


SYNTAX = {
    "ReadAnalogInputs": ("#{address:02X}\r", ">"),
    "ReadAnalogInput": ("#{address:02X}{channel:X}\r", ">"),
    "ReadAnalogInputsHex": ("${address:02X}A\r", ">"),
    "ReadSynchronizedData": ("${address:02X}4\r", ">{address:02X}{first_reading:d}"),
}


def test_every_channel_is_read_with_its_own_type(tmp_path: Path) -> None:
    lines = Lines(DCON)
    chosen = reading_vectors("channels")
    for it in chosen:
        profile = it["profile"] | {"checksum": False}
        command, response = SYNTAX[it["command"]["type"]]
        fields = it["command"]["fields"] | it["response"]["fields"]
        texts = "".join(fields.get("values") or fields["value"])
        lines.add(profile, command.format(**fields).encode().hex(), sent=True)
        lines.add(profile, (response.format(**fields) + texts + "\r").encode().hex(), sent=False)

    found = lines.dissect(tmp_path, READING)[1::2]

    assert len(chosen) > 10
    for it, one in zip(chosen, found, strict=True):
        values = close(it["values"])
        assert (it["id"], values, it["statuses"], it["units"]) == (
            it["id"], [float(text) for text in one["dcon.reading.value"]], one["dcon.reading.status"],
            one["dcon.reading.unit"],
        )  # fmt: skip


def test_the_lines_of_old_firmware_are_cut_into_their_fields(tmp_path: Path) -> None:
    lines = Lines(DCON)
    chosen = reading_vectors("legacy")
    for it in chosen:
        profile = it["profile"] | {"checksum": False}
        lines.add(profile, b"#01\r".hex(), sent=True)
        lines.add(profile, f">{it['line']}\r".encode().hex(), sent=False)

    found = lines.dissect(tmp_path, [*READING, "dcon.reading"])[1::2]

    for it, one in zip(chosen, found, strict=True):
        assert (it["id"], it["values"], it["statuses"]) == (it["id"], one["dcon.reading"], one["dcon.reading.status"])
