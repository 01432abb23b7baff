"""Every vector of ``spec/vectors/dcon`` and ``spec/vectors/frames``, from the host's side and from the module's."""

from typing import Any

import pytest

from i7000 import DataFormat, DecodeError, EncodeError, Noise, TypeCode, dcon
from i7000.dcon.frame import checksum, seal, split, unseal
from i7000.dissect import meanings
from i7000.readings import decode_field
from tests.each import each
from tests.spec.lint import Record
from tests.vectors import dcon_vectors, message_of, parameters, profile_of


def wire(record: Record, name: str) -> bytes:
    return bytes.fromhex(record[f"{name}_wire"])


def written(*outcomes: str) -> list[Any]:
    """The vectors whose messages are written as they are read."""
    return [case for case in dcon_vectors(*outcomes) if "decode-only" not in case.values[0]["flags"]]


def of_a_command(cases: list[Any]) -> list[Any]:
    """Of these vectors those in which the command is not what is rejected."""
    return [case for case in cases if case.values[0]["command"] is not None]


@each("vector", of_a_command(written("response", "refused", "silence", "reject")))
def test_a_command_is_written_as_the_vector_says(vector: Record) -> None:
    command, profile = message_of(vector["command"]), profile_of(vector["profile"])

    if "host-refuses" in vector["flags"]:
        with pytest.raises(EncodeError):
            dcon.encode(command, profile)

    assert wire(vector, "command") == dcon.encode(command, profile, force="host-refuses" in vector["flags"])


@each("vector", of_a_command(dcon_vectors("response", "refused", "silence", "reject")))
def test_a_command_is_read_as_the_vector_says(vector: Record) -> None:
    assert message_of(vector["command"]) == dcon.decode_command(wire(vector, "command"), profile_of(vector["profile"]))


@each("vector", dcon_vectors("response", "refused", "silence"))
def test_a_command_is_among_its_meanings(vector: Record) -> None:
    assert message_of(vector["command"]) in [it.message for it in meanings(wire(vector, "command"))]


@each("vector", dcon_vectors("response", "refused"))
def test_a_response_is_read_as_the_vector_says(vector: Record) -> None:
    command, profile = message_of(vector["command"]), profile_of(vector["profile"])

    assert message_of(vector["response"]) == dcon.decode_response(wire(vector, "response"), command, profile)


@each("vector", dcon_vectors("response", "refused"))
def test_a_response_is_among_its_meanings(vector: Record) -> None:
    assert message_of(vector["response"]) in [it.message for it in meanings(wire(vector, "response"))]


@each("vector", dcon_vectors("response", "refused"))
def test_a_response_is_not_longer_than_the_longest_response(vector: Record) -> None:
    command, profile = message_of(vector["command"]), profile_of(vector["profile"])

    assert len(wire(vector, "response")) <= dcon.longest_response(command, profile)


@each("vector", written("response", "refused"))
def test_a_response_is_written_as_the_vector_says(vector: Record) -> None:
    response, profile = message_of(vector["response"]), profile_of(vector["profile"])

    assert wire(vector, "response") == dcon.encode(response, profile)


@each("vector", dcon_vectors("silence"))
def test_silence_is_expected_of_broadcasts_only(vector: Record) -> None:
    command = message_of(vector["command"])

    assert isinstance(command, dcon.Broadcast)
    assert dcon.longest_response(command, profile_of(vector["profile"])) == 0


@each("vector", dcon_vectors("reject"))
def test_a_damaged_frame_is_rejected_with_the_fault_of_the_vector(vector: Record) -> None:
    profile = profile_of(vector["profile"])

    def decode() -> Any:
        if vector["response_wire"] is None:
            return dcon.decode_command(wire(vector, "command"), profile)
        return dcon.decode_response(wire(vector, "response"), message_of(vector["command"]), profile)

    with pytest.raises(DecodeError) as caught:
        decode()

    assert vector["fault"] == caught.value.fault.value


@each("vector", parameters("vectors/readings/rejected.json"))
def test_a_field_that_is_no_reading_is_rejected_with_the_fault_of_the_vector(vector: Record) -> None:
    data_format = DataFormat[vector["format"].upper()]

    with pytest.raises(DecodeError) as caught:
        decode_field(vector["text"], TypeCode(int(vector["type_code"], 16)), data_format)

    assert vector["fault"] == caught.value.fault.value


@each("vector", parameters("vectors/readings/channels.json"))
def test_a_field_is_read_with_the_type_of_its_channel(vector: Record) -> None:
    command, response = message_of(vector["command"]), message_of(vector["response"])
    profile = profile_of(vector["profile"])

    single = isinstance(command, dcon.ReadAnalogInput)
    found = [dcon.reading(response, command.channel, profile)] if single else list(dcon.readings(response, profile))

    assert response == dcon.decode_response(dcon.encode(response, profile), command, profile)
    assert vector["values"] == [reading.value for reading in found]
    assert vector["units"] == [reading.unit for reading in found]
    assert vector["statuses"] == [reading.status.value for reading in found]


@each("vector", parameters("vectors/frames/checksums.json"))
def test_checksums_are_those_of_the_vectors(vector: Record) -> None:
    body = bytes.fromhex(vector["body"])

    assert vector["checksum"] == f"{checksum(body):02X}"
    if body.isascii():
        assert body == unseal(seal(body, checksum=True), checksum=True)


def events(stream: bytes, size: int, *, checksum: bool) -> tuple[list[Record], bytes]:
    """What `split` tells of a stream that arrives in pieces, adjacent noise put together."""
    found: list[Record] = []
    rest = b""
    for at in range(0, len(stream), size):
        frames, rest = split(rest + stream[at : at + size], checksum=checksum)
        for frame in frames:
            if not isinstance(frame, Noise):
                found.append({"frame": frame.hex()})
            elif found and "noise" in found[-1] and "checksum" not in (found[-1]["fault"], frame.fault.value):
                found[-1]["noise"] += frame.wire.hex()
            else:
                found.append({"noise": frame.wire.hex(), "fault": frame.fault.value})
    return found, rest


@each("vector", parameters("vectors/frames/split.json"))
def test_a_stream_is_split_as_the_vector_says_however_it_arrives(vector: Record) -> None:
    stream = bytes.fromhex(vector["stream"])

    whole = events(stream, len(stream) or 1, checksum=vector["checksum"])

    assert (vector["events"], bytes.fromhex(vector["rest"])) == whole
    for size in (1, 2, 3, 7, 64):
        pieces, rest = events(stream, size, checksum=vector["checksum"])
        assert [event.get("frame") or event["noise"] for event in pieces] == [
            event.get("frame") or event["noise"] for event in whole[0]
        ]
        assert whole[1] == rest
