"""tshark gives the Modbus vectors the names, values and faults that they have in ``spec/``."""

import json
from pathlib import Path
from typing import Any

import pytest

from i7000.modbus import crc16
from tests.spec.lint import SPEC
from tests.wireshark import RTU, Dissected, Lines, Seen, as_written, close, vectors_seen

KNOWN = ("i7000.message", "i7000.fault", "i7000.response_to", "_ws.expert.message")
ROWS = [
    row
    for table in ("modbus_functions", "module_settings")
    for row in json.loads((SPEC / f"tables/{table}.json").read_text("utf-8"))["rows"]
]
ITEMS = ("bits", "words")
FIELDS = sorted(
    {field["name"] for row in ROWS for field in row["fields"] + row["response_fields"] if field["kind"] not in ITEMS}
)
OUT_OF_RANGE = "is out of range"


@pytest.fixture(scope="module")
def seen(tmp_path_factory: pytest.TempPathFactory) -> list[Dissected]:
    fields = [*KNOWN, "i7000.address", *(f"i7000.{name}" for name in FIELDS)]
    return vectors_seen(tmp_path_factory.mktemp("modbus"), RTU, "modbus", "request", fields)


def expected(message: dict[str, Any]) -> dict[str, Any]:
    """Return a message without its items, which are shown one by one."""
    fields = message["fields"]
    left_out = {"values", "value"} | ({"count"} if "values" in fields else set())
    return {"type": message["type"], "fields": {name: it for name, it in fields.items() if name not in left_out}}


def said(message: dict[str, Any], seen: Seen) -> dict[str, Any]:
    """Return what tshark says of a message, in the form of the vectors."""
    fields = expected(message)["fields"]
    return {
        "type": "".join(seen["i7000.message"]),
        "fields": {name: as_written(value, seen[f"i7000.{name}"]) for name, value in fields.items()},
    }


def test_every_message_has_the_name_and_values_of_its_vector(seen: list[Dissected]) -> None:
    checked = 0
    for it in seen:
        if it.vector["outcome"] == "reject":
            continue
        for side, found in (("request", it.sent), ("response", it.received)):
            message = it.vector[side]
            if message and found:
                checked += 1
                assert (it.vector["id"], [], expected(message)) == (
                    it.vector["id"],
                    found["i7000.fault"],
                    said(message, found),
                )
    assert checked > 1_800


def test_every_rejected_frame_has_the_fault_of_its_vector(seen: list[Dissected]) -> None:
    checked = 0
    for it in seen:
        wire = it.vector["request_wire"] if it.vector["response_wire"] is None else it.vector["response_wire"]
        found = it.sent if it.vector["response_wire"] is None else it.received
        if it.vector["outcome"] == "reject" and wire:
            checked += 1
            assert found
            assert (it.vector["id"], [it.vector["fault"]]) == (it.vector["id"], found["i7000.fault"])
    assert checked > 500


def test_what_no_host_sends_by_46h_is_out_of_range_and_nothing_else(seen: list[Dissected]) -> None:
    refused = 0
    for it in seen:
        if it.vector["id"].startswith("modbus-46-") and it.vector["request"] and it.sent:
            if it.vector["request"]["fields"]["address"] == 0:
                continue
            flagged = any(OUT_OF_RANGE in text for text in it.sent["_ws.expert.message"])
            refused += flagged
            assert (it.vector["id"], "host-refuses" in it.vector["flags"]) == (it.vector["id"], flagged)
    assert refused > 20


def test_a_request_that_the_map_refuses_has_an_expert_info_and_no_other_has(seen: list[Dissected]) -> None:
    flagged, plain = 0, 0
    for it in seen:
        if it.vector["id"].startswith("modbus-3.4.") and it.vector["request"] and it.sent:
            told = [text for text in it.sent["_ws.expert.message"] if not text.startswith("E")]
            refused = it.vector["outcome"] == "exception"
            flagged, plain = flagged + refused, plain + (not refused)
            assert (it.vector["id"], refused, told) == (it.vector["id"], bool(told), told)
    assert flagged > 50
    assert plain > 300


def test_a_request_that_the_model_does_not_have_has_an_expert_info_and_no_other_has(seen: list[Dissected]) -> None:
    models = {row["name"]: row["models"] for row in ROWS if row["name"]}
    flagged = 0
    for it in seen:
        if it.vector["request"] and it.sent and it.vector["profile"]["firmware"] is None:
            name, model = it.vector["request"]["type"], it.vector["profile"]["model"]
            missing = models[name] != "all" and model not in models[name]
            flagged += missing
            assert (it.vector["id"], missing) == (
                it.vector["id"],
                f"The {model} does not have {name}" in it.sent["_ws.expert.message"],
            )
    assert flagged > 5


def test_every_response_names_the_packet_of_its_request(seen: list[Dissected]) -> None:
    paired = [it for it in seen if it.vector["outcome"] in ("response", "exception") and it.received]

    assert len(paired) > 900
    assert all(it.received and it.received["i7000.response_to"] for it in paired)


def framed(body: str) -> str:
    """Return a frame in hex with its CRC."""
    return body + crc16(bytes.fromhex(body)).to_bytes(2, "little").hex()


AREAS = {"coil": 1, "discrete_input": 2, "holding_register": 3, "input_register": 4}
ITEM = ("i7000.item.name", "i7000.item.value", "i7000.item.unit")
READING = ("i7000.reading.value", "i7000.reading.unit", "i7000.reading.status")


def rows_of(model: str) -> list[dict[str, Any]]:
    """Return the map of a model."""
    for file in (SPEC / "tables/modbus_registers").glob("*.json"):
        found = json.loads(file.read_text("utf-8"))
        if model in found["models"]:
            return list(found["rows"])
    raise AssertionError(model)


def reads(name: str) -> list[tuple[dict[str, Any], str, str]]:
    """Return the vectors of registers that can be read, each with a request and a response."""
    found = []
    for it in json.loads((SPEC / f"vectors/registers/{name}.json").read_text("utf-8"))["vectors"]:
        row = next((row for row in rows_of(it["profile"]["model"]) if row["name"] == it["name"]), None)
        if it["fault"] or it["big_endian"] or row is None or row["type"] == "record" or "R" not in row["access"]:
            continue
        width = 2 if row["type"] == "uint32" else 1
        start, items = row["address"] + it["first"] * width, it["items"]
        code = AREAS[row["area"]]
        if code > 2:
            data = b"".join(item.to_bytes(2, "big") for item in items)
        else:
            number = sum(bit << place for place, bit in enumerate(items))
            data = number.to_bytes((len(items) + 7) // 8, "little")
        request = f"01{code:02x}{start:04x}{len(items):04x}"
        found.append((it, framed(request), framed(f"01{code:02x}{len(data):02x}{data.hex()}")))
    return found


def dissected(name: str, folder: Path, fields: tuple[str, ...]) -> list[tuple[dict[str, Any], Seen]]:
    """Return the vectors of a file in ``vectors/registers`` with what tshark says of the responses."""
    lines = Lines(RTU)
    chosen = reads(name)
    for it, request, response in chosen:
        lines.add(it["profile"], request, sent=True)
        lines.add(it["profile"], response, sent=False)
    found = lines.dissect(folder, fields)[1::2]
    return [(it, one) for (it, _, _), one in zip(chosen, found, strict=True)]


def test_every_register_of_a_reading_has_value_unit_and_status(tmp_path: Path) -> None:
    found = dissected("readings", tmp_path, READING)

    assert len(found) > 60
    for it, one in found:
        values = close(it["values"])
        units = [it["unit"]] * len(it["values"])
        assert (it["id"], values, units, it["statuses"]) == (
            it["id"],
            [float(text) for text in one["i7000.reading.value"]],
            one["i7000.reading.unit"],
            one["i7000.reading.status"],
        )


def test_every_other_row_has_name_value_and_unit(tmp_path: Path) -> None:
    found = dissected("rows", tmp_path, ITEM)

    assert len(found) > 100
    for it, one in found:
        values = close(it["values"])
        assert (it["id"], {it["name"]}) == (it["id"], set(one["i7000.item.name"]))
        assert (it["id"], values) == (it["id"], [float(text) for text in one["i7000.item.value"]])
        assert set(one["i7000.item.unit"]) <= {it["unit"]}
