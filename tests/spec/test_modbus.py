"""What the Modbus half of the data under ``spec/`` promises."""

from __future__ import annotations

from collections import Counter
from itertools import chain, pairwise
from typing import TYPE_CHECKING

import pytest

from tests.crc import crc
from tests.spec import lint

if TYPE_CHECKING:
    from pathlib import Path

    from tests.spec.lint import Record

MODELS = {row["name"]: row for row in lint.rows("models") if "modbus" in row["protocols"]}
FUNCTIONS = {row["function"]: row for row in lint.rows("modbus_functions")}
SUB_FUNCTIONS = {row["sub_function"]: row for row in lint.rows("module_settings")}
REQUESTS = {row["name"]: row for row in chain(FUNCTIONS.values(), SUB_FUNCTIONS.values()) if row["name"] is not None}
MAPS = {path.stem: lint.load(path) for path in lint.table_files("modbus_registers")}
VECTORS = [pytest.param(path, id=path.stem) for path in lint.vector_files("modbus")]
AREAS = {"0": "coil", "1": "discrete_input", "3": "input_register", "4": "holding_register"}
READ = {
    "ReadCoils": "coil",
    "ReadDiscreteInputs": "discrete_input",
    "ReadHoldingRegisters": "holding_register",
    "ReadInputRegisters": "input_register",
}
WRITE = {"WriteSingleCoil": "coil", "WriteSingleRegister": "holding_register"}
WRITE_MORE = {"WriteMultipleCoils": "coil", "WriteMultipleRegisters": "holding_register"}


def sealed(wire: str) -> bool:
    frame = bytes.fromhex(wire)
    return crc(frame[:-2]) == frame[-2:]


def tokens(pdu: str) -> list[tuple[str, int | None]]:
    """The fields of a PDU with the byte of the frame where each begins, or None behind a field of any length."""
    found: list[tuple[str, int | None]] = []
    offset: int | None = 1
    for token in pdu.split():
        named, _, size = token.partition(":")
        if not token[0].isdigit() and token != token.upper():
            found.append((named, offset))
        width = int(size) if size.isdigit() else None if size else 1
        offset = None if offset is None or width is None else offset + width
    return found


def expected_models(row: Record) -> list[str]:
    return [model for model in MODELS if model in row["models"]]


# Tables


def test_the_functions_are_those_of_the_manual_and_of_the_maps() -> None:
    assert list(FUNCTIONS) == ["01", "02", "03", "04", "05", "06", "0F", "10", "46", "+80"]


def test_the_sub_functions_are_one_a_section_in_order() -> None:
    sections = [row["section"] for row in SUB_FUNCTIONS.values()]

    assert sections == [f"3.3.{number}" for number, _ in enumerate(sections, 1)]
    assert list(SUB_FUNCTIONS) == sorted(SUB_FUNCTIONS)


def test_no_class_is_named_twice() -> None:
    rows = [*FUNCTIONS.values(), *SUB_FUNCTIONS.values()]
    names = [row[key] for row in rows for key in ("name", "response_name") if row[key] is not None]

    assert len(names) == len(set(names)) == 51


@pytest.mark.parametrize("name", REQUESTS)
def test_a_request_and_its_response_begin_alike(name: str) -> None:
    row = REQUESTS[name]
    lead = f"46 {row['sub_function']}" if "sub_function" in row else row["function"]

    assert [f"{row[side]} ".startswith(f"{lead} ") for side in ("request", "response")] == [True, True]
    assert sorted(row["models"]) == sorted(expected_models(row))


@pytest.mark.parametrize("sub_function", SUB_FUNCTIONS)
def test_the_fields_of_a_sub_function_stand_where_its_pdu_says(sub_function: str) -> None:
    row = SUB_FUNCTIONS[sub_function]

    for pdu, fields in (("request", "fields"), ("response", "response_fields")):
        assert tokens(row[pdu]) == [(field["name"], field["offset"]) for field in row[fields]]


def test_every_model_has_one_map() -> None:
    assert sorted(chain.from_iterable(data["models"] for data in MAPS.values())) == sorted(MODELS)
    assert [data["section"] for data in MAPS.values()] == [f"3.4.{number}" for number in range(1, 10)]


@pytest.mark.parametrize("stem", MAPS)
def test_a_map_is_named_after_its_section(stem: str) -> None:
    assert stem == f"{MAPS[stem]['section']}-{MAPS[stem]['models'][0].lower()}"


@pytest.mark.parametrize("stem", MAPS)
def test_a_row_of_a_map_agrees_with_itself(stem: str) -> None:
    for row in MAPS[stem]["rows"]:
        first, last = int(row["first"][1:]), int(row["last"][1:])
        numbers = [int(value) for value in row["values"] or {}]
        coil = row["area"] in ("coil", "discrete_input")

        assert AREAS[row["first"][0]] == AREAS[row["last"][0]] == row["area"]
        assert (row["address"], row["count"]) == (first - 1, last - first + 1)
        assert coil == (row["type"] == "bool")
        assert row["access"] == "R" or row["area"] in ("coil", "holding_register")
        assert all(row["minimum"] <= number <= row["maximum"] for number in numbers)
        assert set(row["models"] or []) < set(MAPS[stem]["models"])
        assert (row["unit"] is None) == (row["scale"] is None)
        assert row["type"] != "uint32" or row["count"] == 2


@pytest.mark.parametrize("stem", MAPS)
def test_no_two_rows_of_a_map_overlap(stem: str) -> None:
    taken = Counter(
        (row["area"], row["address"] + index) for row in MAPS[stem]["rows"] for index in range(row["count"])
    )

    assert [place for place, times in taken.items() if times > 1] == []


@pytest.mark.parametrize("stem", MAPS)
def test_the_twins_of_a_map_are_alike(stem: str) -> None:
    """What has two printed numbers has the same address, count and meaning in both areas."""
    by_name: dict[str, list[Record]] = {}
    for row in MAPS[stem]["rows"]:
        by_name.setdefault(row["name"], []).append(row)
    twins = [rows for rows in by_name.values() if len(rows) > 1]
    alike = ("address", "count", "access", "type", "unit", "scale", "minimum", "maximum", "values", "meaning")

    assert [(len(rows), {rows[0]["area"], rows[1]["area"]}) for rows in twins] == [
        (2, {"discrete_input", "coil"} if rows[0]["type"] == "bool" else {"input_register", "holding_register"})
        for rows in twins
    ]
    assert [rows[0]["name"] for rows in twins for key in alike if rows[0][key] != rows[1][key]] == []


@pytest.mark.parametrize("stem", MAPS)
def test_a_map_has_room_for_every_channel(stem: str) -> None:
    model = MODELS[MAPS[stem]["models"][0]]
    channels = max(model["channels"], model["single_ended_channels"] or 0)
    counts = {row["count"] for row in MAPS[stem]["rows"] if row["name"] in ("analog_input", "type_code", "cjc_offset")}

    assert counts == {channels}


# Vectors


def test_every_function_sub_function_and_map_has_its_file() -> None:
    stems = {path.stem for path in lint.vector_files("modbus")}
    functions = {code for code, row in FUNCTIONS.items() if row["name"] is not None}

    assert {stem.partition("-")[0] for stem in stems - set(MAPS) if not stem.startswith(("46-", "frames"))} == functions
    assert {stem.split("-")[1] for stem in stems if stem.startswith("46-")} == set(SUB_FUNCTIONS)
    assert set(MAPS) | {"frames"} <= stems


@pytest.mark.parametrize("path", VECTORS)
def test_a_file_has_an_answer_and_a_refusal_of_what_it_is_named_after(path: Path) -> None:
    outcomes = Counter(vector["outcome"] for vector in lint.records(lint.load(path)))
    lead = path.stem.replace("46-", "46", 1).partition("-")[0]

    assert outcomes["response"] > 0
    assert outcomes["exception"] > 0
    assert outcomes["reject"] > 0 or path.stem in MAPS
    if path.stem not in MAPS and path.stem != "frames":
        requests = [vector["request_wire"] for vector in lint.records(lint.load(path)) if vector["request"]]
        assert [wire for wire in requests if not wire[2:].startswith(lead.lower())] == []


@pytest.mark.parametrize("path", VECTORS)
def test_a_vector_has_what_its_outcome_needs(path: Path) -> None:
    shapes = {
        "response": {(True, True, True, False)},
        "exception": {(True, True, True, False)},
        "silence": {(True, False, False, False)},
        "reject": {(False, False, False, True), (True, False, True, True)},
    }
    refused = (True, False, False, True)
    for vector in lint.records(lint.load(path)):
        present = tuple(vector[key] is not None for key in ("request", "response", "response_wire", "fault"))
        if vector["outcome"] == "reject" and "host-refuses" in vector["flags"]:
            assert present == refused, vector["id"]
        else:
            assert present in shapes[vector["outcome"]], vector["id"]


@pytest.mark.parametrize("path", VECTORS)
def test_an_answer_is_that_of_its_request(path: Path) -> None:
    for vector in lint.records(lint.load(path)):
        request, response = vector["request"], vector["response"]
        if response is None:
            continue
        excepted = vector["outcome"] == "exception"
        assert response["type"] == ("ExceptionResponse" if excepted else REQUESTS[request["type"]]["response_name"])
        assert response["fields"]["address"] == request["fields"]["address"], vector["id"]
        function = int(vector["request_wire"][2:4], 16)
        assert int(vector["response_wire"][2:4], 16) == function + 0x80 * excepted, vector["id"]
        assert not excepted or response["fields"]["function"] == function


@pytest.mark.parametrize("path", VECTORS)
def test_a_frame_that_is_accepted_has_a_right_crc_and_its_address(path: Path) -> None:
    for vector in lint.records(lint.load(path)):
        for side in ("request", "response"):
            if vector[side] is not None:
                frame = bytes.fromhex(vector[f"{side}_wire"])
                assert sealed(vector[f"{side}_wire"]), vector["id"]
                assert frame[0] == vector[side]["fields"]["address"], vector["id"]
                assert len(frame) <= 256, vector["id"]


@pytest.mark.parametrize("path", VECTORS)
def test_a_crc_is_at_fault_where_and_only_where_it_is_wrong(path: Path) -> None:
    for vector in lint.records(lint.load(path)):
        wire = vector["request_wire"] if vector["response_wire"] is None else vector["response_wire"]
        if vector["outcome"] == "reject":
            size = len(wire) // 2
            short = not (4 if vector["response_wire"] is None else 5) <= size <= 256
            assert (vector["fault"] == "crc") == (not short and not sealed(wire)), vector["id"]
            assert vector["fault"] == "length" or not short, vector["id"]


@pytest.mark.parametrize("path", VECTORS)
def test_only_a_broadcast_is_silent(path: Path) -> None:
    for vector in lint.records(lint.load(path)):
        if vector["request"] is not None:
            to_all = vector["request"]["fields"]["address"] == 0
            broadcast = REQUESTS[vector["request"]["type"]].get("broadcast", False)
            assert (to_all and broadcast) == (vector["outcome"] == "silence"), vector["id"]
            assert not to_all or broadcast or (vector["outcome"], vector["fault"]) == ("reject", "address"), vector[
                "id"
            ]


def firmware(text: str) -> tuple[int, int]:
    major, minor = text[1:].split(".")
    return int(major), int(minor)


def has(models: Record, profile: Record) -> bool:
    model, version = profile["model"], profile["firmware"]
    if model not in models:
        return False
    return models[model] is None or version is None or firmware(version) >= firmware(models[model])


@pytest.mark.parametrize("path", VECTORS)
def test_a_request_that_is_answered_is_one_of_the_model(path: Path) -> None:
    for vector in lint.records(lint.load(path)):
        if vector["outcome"] == "response":
            assert has(REQUESTS[vector["request"]["type"]]["models"], vector["profile"]), vector["id"]


@pytest.mark.parametrize("path", VECTORS)
def test_a_profile_fits_its_model(path: Path) -> None:
    for vector in lint.records(lint.load(path)):
        profile = vector["profile"]
        model = MODELS[profile["model"]]
        channels = model["single_ended_channels"] if profile["single_ended"] else model["channels"]
        since = {f"{code:02X}": model["types"][f"{code:02X}"] for code in profile["type_codes"]}
        assert len(profile["type_codes"]) == channels, vector["id"]
        assert all(has({profile["model"]: limit}, profile) for limit in since.values()), vector["id"]


@pytest.mark.parametrize("path", VECTORS)
def test_a_code_of_an_exception_is_one_of_its_function(path: Path) -> None:
    for vector in lint.records(lint.load(path)):
        if vector["outcome"] == "exception":
            listed = {exception["code"] for exception in REQUESTS[vector["request"]["type"]]["exceptions"]}
            assert vector["response"]["fields"]["exception_code"] in listed, vector["id"]


def filled(pdu: str, fields: Record, channels: int) -> bytes:
    """The PDU with its fields in place."""
    values = fields.get("values", [])
    if isinstance(values, str):
        data = int(values[::-1], 2).to_bytes((len(values) + 7) // 8, "little")
    else:
        data = b"".join(value.to_bytes(2, "big") for value in values)
    given = {"bytes": len(data), "count": len(values), **fields}
    found = b""
    for token in pdu.split():
        named, _, size = token.partition(":")
        value = given.get(named)
        if size in ("bits", "words"):
            found += data
        elif isinstance(value, str):
            found += bytes.fromhex(value)
        elif isinstance(value, int):
            width = (channels + 7) // 8 if size == "mask" else int(size or 1)
            number = 0xFF00 * value if named == "value" and isinstance(value, bool) else value
            found += number.to_bytes(width, "big", signed=number < 0)
        else:
            found += bytes.fromhex(token)
    return found


def without_padding(pdu: bytes, count: int) -> bytes:
    """A PDU that ends with `count` bits, with its padding bits zero."""
    return pdu[:-1] + bytes((pdu[-1] & 0xFF >> -count % 8,))


@pytest.mark.parametrize("path", VECTORS)
def test_a_wire_is_its_pdu_with_its_fields(path: Path) -> None:
    for vector in lint.records(lint.load(path)):
        if vector["request"] is not None:
            row = REQUESTS[vector["request"]["type"]]
            channels = len(vector["profile"]["type_codes"])
            sides = ["request"] if vector["outcome"] in ("silence", "reject", "exception") else ["request", "response"]
            for side in sides:
                pdu = bytes.fromhex(vector[f"{side}_wire"])[1:-2]
                if "decode-only" in vector["flags"] and "values:bits" in row[side]:
                    pdu = without_padding(pdu, len(vector[side]["fields"]["values"]))
                assert pdu == filled(row[side], vector[side]["fields"], channels), vector["id"]
        if vector["outcome"] == "exception":
            fields = vector["response"]["fields"]
            pdu = bytes((fields["function"] + 0x80, fields["exception_code"]))
            assert bytes.fromhex(vector["response_wire"])[1:-2] == pdu, vector["id"]


def touched(vector: Record) -> tuple[str, str, int, int]:
    """What a standard request does (R or W), where, from which address on, and to how many."""
    kind, fields = vector["request"]["type"], vector["request"]["fields"]
    if kind in READ:
        return "R", READ[kind], fields["start"], fields["count"]
    if kind in WRITE:
        return "W", WRITE[kind], fields["coil"] if "coil" in fields else fields["register"], 1
    return "W", WRITE_MORE[kind], fields["start"], len(fields["values"])


@pytest.mark.parametrize("stem", MAPS)
def test_every_row_of_a_map_is_read_and_written_as_it_may_be(stem: str) -> None:
    rows = MAPS[stem]["rows"]
    wanted = {
        (way, row["area"], row["address"], row["count"]) for row in rows for way in row["access"].replace("/", "")
    }
    records = lint.records(lint.load(lint.SPEC / "vectors" / "modbus" / f"{stem}.json"))
    answered = Counter(touched(vector) for vector in records if vector["outcome"] == "response")

    assert answered == dict.fromkeys(wanted, 1)
    assert [vector["id"] for vector in records if vector["profile"]["model"] not in MAPS[stem]["models"]] == []


@pytest.mark.parametrize("stem", MAPS)
def test_what_a_row_forbids_is_refused(stem: str) -> None:
    rows = MAPS[stem]["rows"]
    records = lint.records(lint.load(lint.SPEC / "vectors" / "modbus" / f"{stem}.json"))
    refused = {touched(vector)[:3] for vector in records if vector["outcome"] == "exception"}
    forbidden = {("W", row["area"], row["address"]) for row in rows if row["access"] == "R"}
    writable = {place for place in forbidden if place[1] in WRITE.values()}
    unreadable = {("R", row["area"], row["address"]) for row in rows if row["access"] == "W"}

    assert (writable | unreadable) - refused == set()


def test_a_crc_is_that_of_its_body() -> None:
    found = [vector for _, vector in lint.vectors("frames/crc.json")]

    assert [vector["id"] for vector in found if crc(bytes.fromhex(vector["body"])).hex() != vector["crc"]] == []


# Streams

STREAMS = [vector for _, vector in lint.vectors("frames/rtu_split.json")]


def parts(events: list[Record]) -> list[str]:
    return [event["frame"] if "frame" in event else event["noise"] for event in events]


def test_a_stream_is_its_events_and_its_rest_and_the_rest_is_what_a_silence_gives() -> None:
    for vector in STREAMS:
        assert "".join(parts(vector["events"])) + vector["rest"] == vector["stream"], vector["id"]
        assert "".join(parts(vector["flushed"])) == vector["rest"], vector["id"]


def test_all_noise_between_two_frames_is_one_run() -> None:
    for vector in STREAMS:
        for events in (vector["events"], vector["flushed"]):
            pairs = pairwise(events)
            assert not any("noise" in first and "noise" in second for first, second in pairs), vector["id"]


def test_a_frame_in_a_stream_has_a_right_crc() -> None:
    for vector in STREAMS:
        for event in vector["events"] + vector["flushed"]:
            assert "noise" in event or (sealed(event["frame"]) and len(event["frame"]) <= 512), vector["id"]


@pytest.mark.parametrize("side", ["requests", "responses", "both"])
def test_the_streams_of_a_side_have_every_function_and_sub_function(side: str) -> None:
    events = chain.from_iterable(vector["events"] + vector["flushed"] for vector in STREAMS if vector["side"] == side)
    frames = [event["frame"].upper() for event in events if "frame" in event]
    found = {frame[2:4] for frame in frames}
    sub_functions = {frame[4:6] for frame in frames if frame[2:4] == "46"}
    refused = {f"{int(code, 16) + 0x80:02X}" for code in FUNCTIONS if code != "+80"}

    assert set(FUNCTIONS) - {"+80"} <= found
    assert set(SUB_FUNCTIONS) <= sub_functions
    assert side != "responses" or refused <= found


@pytest.mark.parametrize("fault", ["address", "function", "sub_function", "count", "crc", "length"])
def test_every_fault_of_noise_is_shown(fault: str) -> None:
    events = chain.from_iterable(vector["events"] + vector["flushed"] for vector in STREAMS)

    assert fault in {event.get("fault") for event in events}
