"""Every vector of ``spec/vectors/modbus`` and the CRCs, from the host's side and from the module's."""

from typing import Any

import pytest

from i7000 import DecodeError, EncodeError, modbus
from tests.each import each
from tests.spec.lint import Record
from tests.vectors import modbus_message_of, modbus_vectors, parameters, profile_of, written_modbus_vectors


def wire(record: Record, name: str) -> bytes:
    return bytes.fromhex(record[f"{name}_wire"])


@each("vector", written_modbus_vectors("response", "exception", "silence"))
def test_a_request_is_written_as_the_vector_says(vector: Record) -> None:
    request, profile = modbus_message_of(vector["request"]), profile_of(vector["profile"])
    may_be_refused = bool({"host-refuses", "host-may-refuse"} & set(vector["flags"]))

    if "host-refuses" in vector["flags"]:
        with pytest.raises(EncodeError):
            modbus.encode(request, profile)

    assert wire(vector, "request") == modbus.encode(request, profile, force=may_be_refused)
    if "mask" not in vector["request"]["fields"]:
        assert wire(vector, "request") == modbus.encode(request)


@each("vector", modbus_vectors("response", "exception", "silence"))
def test_a_request_is_read_as_the_vector_says(vector: Record) -> None:
    request = modbus.decode_request(wire(vector, "request"), profile_of(vector["profile"]))

    assert modbus_message_of(vector["request"]) == request
    assert modbus.is_answered(request) == (vector["outcome"] != "silence")


@each("vector", written_modbus_vectors("response", "exception"))
def test_a_response_is_written_as_the_vector_says(vector: Record) -> None:
    response, profile = modbus_message_of(vector["response"]), profile_of(vector["profile"])

    assert wire(vector, "response") == modbus.encode(response, profile)


@each("vector", modbus_vectors("response", "exception"))
def test_a_response_is_read_as_the_vector_says(vector: Record) -> None:
    request, profile = modbus_message_of(vector["request"]), profile_of(vector["profile"])

    assert modbus_message_of(vector["response"]) == modbus.decode_response(wire(vector, "response"), request, profile)
    assert len(wire(vector, "response")) <= modbus.longest_response(request, profile)


@each("vector", modbus_vectors("reject"))
def test_a_damaged_frame_is_rejected_with_the_fault_of_the_vector(vector: Record) -> None:
    profile = profile_of(vector["profile"])

    def decode() -> Any:
        if vector["response_wire"] is None:
            return modbus.decode_request(wire(vector, "request"), profile)
        return modbus.decode_response(wire(vector, "response"), modbus_message_of(vector["request"]), profile)

    with pytest.raises(DecodeError) as caught:
        decode()

    assert vector["fault"] == caught.value.fault.value
    assert caught.value.wire == wire(vector, "request" if vector["response_wire"] is None else "response")


@each("vector", [case for case in modbus_vectors("reject") if case.values[0]["request"] is not None])
def test_of_a_rejected_frame_the_request_is_written_or_is_what_is_refused(vector: Record) -> None:
    request, profile = modbus_message_of(vector["request"]), profile_of(vector["profile"])

    if vector["response_wire"] is None:
        assert "host-refuses" in vector["flags"]
        with pytest.raises(EncodeError, match="address cannot be 0"):
            modbus.encode(request, profile, force=True)
    else:
        assert wire(vector, "request") == modbus.encode(request, profile, force=True)


@each("vector", parameters("vectors/frames/crc.json"))
def test_crcs_are_those_of_the_vectors(vector: Record) -> None:
    body, crc = bytes.fromhex(vector["body"]), bytes.fromhex(vector["crc"])

    assert int.from_bytes(crc, "little") == modbus.crc16(body)
    assert body + crc == modbus.seal(body)
    assert modbus.crc16(body + crc) == 0
