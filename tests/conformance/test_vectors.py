"""The vectors of ``spec/`` as cases."""

from typing import Any

import pytest

from i7000.cli.vector_files import all_vectors
from i7000.conformance.vectors import OPERATIONS, Case, Vector, selected, vectors_of
from i7000.dcon.codec import COMMANDS
from tests.spec.lint import SPEC, vectors
from tests.vectors import profile_of

ALL = all_vectors()
CASES = [case for vector in ALL for case in vector.cases]


def cases_of(key: str) -> dict[str, Case]:
    """The cases of a vector by operation; of several the last."""
    return {case.operation: case for vector in ALL if vector.id == key for case in vector.cases}


def test_every_vector_of_every_file_makes_a_case() -> None:
    expected = [(path.relative_to(SPEC / "vectors").as_posix(), vector["id"]) for path, vector in vectors()]

    assert sorted(expected) == sorted((vector.file, vector.id) for vector in ALL)
    assert all(vector.cases for vector in ALL)


def test_every_operation_has_a_case_and_every_case_the_keys_of_its_operation() -> None:
    assert {case.operation for case in CASES} == set(OPERATIONS)
    for case in CASES:
        operation, expected = OPERATIONS[case.operation], case.expected
        assert set(operation.given) == set(case.given)
        if expected.result is not None:
            assert (set(expected.result) == set(operation.result)) is not expected.partial
            assert set(expected.result) <= set(operation.result)


def test_a_vector_with_a_command_that_is_not_answered_is_of_a_module_that_has_the_command() -> None:
    availability = {command.__name__: command.availability for command in COMMANDS}

    silent = [vector for _, vector in vectors("dcon") if vector["outcome"] == "silence"]

    assert silent
    for vector in silent:
        assert availability[vector["command"]["type"]] not in profile_of(vector["profile"]).refused


def test_an_exchange_is_encoded_and_decoded_from_both_sides() -> None:
    found = cases_of("dcon-2.10-manual-1")

    assert [name.removeprefix("dcon.") for name in found] == [
        "encode_command", "decode_command", "is_answered", "encode_response", "decode_response",
    ]  # fmt: skip
    assert found["dcon.encode_command"].expected.record == {"result": {"wire": b"$012\r".hex()}}
    assert found["dcon.decode_response"].given["wire"] == b"!01050600\r".hex()


def test_a_rejected_frame_has_a_fault_and_is_not_encoded() -> None:
    found = cases_of("dcon-2.10-bad-checksum")

    assert list(found) == ["dcon.decode_command"]
    assert found["dcon.decode_command"].expected.record == {"error": {"fault": "checksum"}}


def test_what_a_host_refuses_has_any_error() -> None:
    refused = next(vector for _, vector in vectors("dcon") if "host-refuses" in vector["flags"])

    assert cases_of(refused["id"])["dcon.encode_command"].expected.record == {"error": {"fault": None}}


def test_what_a_host_may_refuse_has_a_result_or_an_error() -> None:
    refused = next(
        vector
        for _, vector in vectors("modbus")
        if "host-may-refuse" in vector["flags"] and "host-refuses" not in vector["flags"]
    )

    expected = cases_of(refused["id"])["modbus.encode_request"].expected

    assert expected.record == {"result": {"wire": refused["request_wire"]}, "or": "an error"}


@pytest.mark.parametrize("folder", ["dcon", "modbus"])
def test_what_is_only_decoded_is_not_encoded(folder: str) -> None:
    for vector in (vector for _, vector in vectors(folder) if "decode-only" in vector["flags"]):
        found = cases_of(vector["id"])
        writes_request = vector.get("request", {}).get("type") == "WriteMultipleCoils"

        assert (f"{folder}.encode_response" in found) is writes_request
        assert (f"{folder}.encode_request" in found) is (folder == "modbus" and not writes_request)
        assert "dcon.encode_command" not in found


def test_a_lenient_field_is_refused_by_a_strict_reader() -> None:
    lenient = next(vector for _, vector in vectors("readings") if "lenient" in vector["flags"])

    found = cases_of(lenient["id"])

    assert found["readings.read"].expected.record == {"error": {"fault": "number"}}
    assert found["readings.read_leniently"].expected.result == {"value": lenient["value"], "status": lenient["status"]}


def test_a_stream_comes_at_once_and_byte_by_byte() -> None:
    (vector,) = (vector for vector in ALL if vector.id == "split-one-frame")

    assert [case.given["pieces"] for case in vector.cases] == [["243031320d"], ["24", "30", "31", "32", "0d"]]


@pytest.mark.parametrize("file", ["other/new.json", "dcon", "frames/new.json"])
def test_a_file_whose_operations_are_unknown_is_refused(file: str) -> None:
    with pytest.raises(ValueError, match=f"{file}: the operations of its vectors are unknown"):
        vectors_of(file, {"vectors": []})


# --- selection --------------------------------------------------------------------------------------------------------


def files_of(found: dict[str, frozenset[str]]) -> set[str]:
    return {vector.file for vector in ALL if vector.id in found}


def of(name: str) -> list[Vector]:
    found = selected(ALL, name)
    return [vector for vector in ALL if vector.id in found]


def test_a_vector_is_selected_by_its_id_alone() -> None:
    assert [vector.id for vector in of("dcon-2.10-manual-1")] == ["dcon-2.10-manual-1"]


def test_vectors_are_selected_by_the_beginning_of_their_ids() -> None:
    assert {vector.id[:11] for vector in of("reading-hex")} == {"reading-hex"}


@pytest.mark.parametrize("name", ["frames/crc.json", "crc.json", "frames/crc", "crc", "frames.crc"])
def test_a_file_is_selected_by_its_name_with_and_without_folder_and_ending(name: str) -> None:
    assert files_of(selected(ALL, name)) == {"frames/crc.json"}


@pytest.mark.parametrize("name", ["frames", "frames/*", "frames.*"])
def test_a_folder_is_selected_by_its_name_or_a_glob(name: str) -> None:
    assert files_of(selected(ALL, name)) == {
        "frames/checksums.json", "frames/crc.json", "frames/split.json", "frames/rtu_split.json",
    }  # fmt: skip


def test_a_file_that_has_the_name_of_a_folder_is_selected_with_its_folder() -> None:
    assert files_of(selected(ALL, "modbus/frames")) == {"modbus/frames.json"}
    assert files_of(selected(ALL, "readings")) == {file for file in files_of(selected(ALL, "")) if "readings/" in file}


def test_a_glob_selects_ids() -> None:
    assert {vector.file[:9] for vector in of("dcon-2.1?-manual-[12]")} == {f"dcon/2.1{n}" for n in range(10)}


def test_an_operation_selects_its_cases_only() -> None:
    found = selected(ALL, "dcon.encode_response")

    assert set(found.values()) == {frozenset({"dcon.encode_response"})}


@pytest.mark.parametrize("name", ["", "no-such-vector"])
def test_an_unknown_name_selects_nothing_and_no_name_everything(name: str) -> None:
    found: Any = selected(ALL, name)

    assert len(found) == (0 if name else len(ALL))
