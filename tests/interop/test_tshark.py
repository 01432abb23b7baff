"""tshark sees in our frames what we put there, and in the vectors what they say."""

from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import pytest

from i7000 import modbus
from i7000.modbus import REQUESTS, ExceptionCode, ExceptionResponse, crc16, encode
from i7000.modbus.request import MODULE_SETTINGS
from tests.interop import program
from tests.interop.samples import PROFILE, exchanges
from tests.interop.tshark import Dissected, dissect, write_capture
from tests.spec.lint import vectors

Dissect = Callable[[list[bytes]], list[Dissected]]

EXCHANGES = [exchange for kind in REQUESTS for exchange in exchanges(kind, 100)]
UNNAMED = (0x05, 0x06, MODULE_SETTINGS)
"""Functions of which tshark 4 names nothing but the number when it does not know the direction."""


@pytest.fixture
def dissected(tmp_path: Path) -> Dissect:
    """Dissect frames with tshark; skipped if it is not installed."""
    tshark = program("tshark")

    def ask(frames: list[bytes]) -> list[Dissected]:
        capture = tmp_path / "frames.pcap"
        write_capture(capture, frames)
        found = dissect(tshark, capture)
        assert [len(frame) for frame in frames] == [it.length for it in found]
        return found

    return ask


def taken_for_a_response(request: Any) -> bool:
    """Whether a request to read looks to it like a response of three bytes, which has the same length."""
    return not request.broadcast and request.start >> 8 == 3


def named_items(seen: Dissected, count: int) -> list[int]:
    """The items of a response; bits may be followed by the spare ones, which are zero."""
    items = seen.words or seen.bits
    assert not any(items[count:])
    return list(items[:count])


def test_it_names_address_and_function_of_every_frame_and_finds_every_crc_good(dissected: Dissect) -> None:
    messages: list[Any] = [message for it in EXCHANGES for message in (it.request, it.response)]
    frames = [encode(message, PROFILE, force=True) for message in messages]

    seen = dissected(frames)

    assert len(messages) > 4_000
    assert [(frame[0], frame[1], True) for frame in frames] == [(it.address, it.function, it.good_crc) for it in seen]


def test_it_sees_requests_and_responses(dissected: Dissect) -> None:
    """Request and response follow each other, so that it knows which is which and how many bits are asked for."""
    named = [it for it in EXCHANGES if it.request.function not in UNNAMED]
    chosen = [it for it in named if not taken_for_a_response(it.request)]
    seen = dissected([encode(message) for it in chosen for message in (it.request, it.response)])

    for exchange, request_seen, response_seen in zip(chosen, seen[::2], seen[1::2], strict=True):
        request: Any = exchange.request
        response: Any = exchange.response
        writes = request.broadcast
        count = len(request.values) if writes else request.count
        assert (request.start, count) == (request_seen.start, request_seen.count)
        if not writes:
            assert list(response.values) == named_items(response_seen, count)
        elif request.function == 0x10:
            assert request.values == request_seen.words
        else:
            assert sum(bit << at for at, bit in enumerate(request.values)) == int.from_bytes(
                request_seen.data, "little"
            )
        if writes:
            assert (response.start, response.count) == (response_seen.start, response_seen.count)


def test_it_sees_exceptions_of_every_function_and_code(dissected: Dissect) -> None:
    exceptions = [
        ExceptionResponse(address, function, code)
        for address in (1, 247)
        for function in sorted({request.function for request in REQUESTS})
        for code in ExceptionCode
    ]

    seen = dissected([encode(exception) for exception in exceptions])

    assert [(it.address, it.function, it.exception_code, True) for it in exceptions] == [
        (it.address, it.function, it.exception_code, it.good_crc) for it in seen
    ]


def test_it_finds_every_damaged_frame_bad(dissected: Dissect) -> None:
    """Address, function and byte count stay as they are: it looks for the CRC where they say that it is."""
    random = Random(7000)
    damaged = []
    for exchange in EXCHANGES:
        frame = bytearray(encode(exchange.response, PROFILE, force=True))
        frame[random.randrange(3, len(frame))] ^= 1 << random.randrange(8)
        damaged.append(bytes(frame))

    seen = dissected(damaged)

    assert all(crc16(frame) for frame in damaged)
    assert {False} == {it.good_crc for it in seen}


def test_it_takes_no_broadcast_for_modbus(dissected: Dissect) -> None:
    """Address 0, of all modules, is no unit for it; those above 247 are none for both."""
    (seen,) = dissected([encode(modbus.WriteSingleCoil(0, 1, True))])

    assert seen.address is None


def wires(outcomes: tuple[str, ...]) -> list[tuple[str, dict[str, Any], bytes]]:
    """The requests and responses of the vectors: id, message, frame."""
    return [
        (vector["id"], vector[side], bytes.fromhex(vector[f"{side}_wire"]))
        for _, vector in vectors("modbus")
        for side in ("request", "response")
        if vector["outcome"] in outcomes and vector[side] is not None and vector[f"{side}_wire"] is not None
    ]


def test_it_sees_in_the_vectors_what_they_say(dissected: Dissect) -> None:
    chosen = [it for it in wires(("response", "exception", "silence")) if it[1]["fields"]["address"]]
    seen = dissected([frame for _, _, frame in chosen])

    assert len(chosen) > 1_500
    for (name, message, frame), it in zip(chosen, seen, strict=True):
        values = message["fields"]
        assert (name, values["address"], True) == (name, it.address, it.good_crc)
        if message["type"] == "ExceptionResponse":
            assert (name, values["function"], values["exception_code"]) == (name, it.function, it.exception_code)
            continue
        assert (name, frame[1]) == (name, it.function)
        if frame[1] not in UNNAMED and "start" in values:
            count = values["count"] if "count" in values else len(values["values"])
            assert (name, values["start"], count) == (name, it.start, it.count)
        elif frame[1] not in UNNAMED:
            items = [int(item) for item in values["values"]]
            assert (name, items) == (name, named_items(it, len(items)))


def test_it_finds_the_vectors_with_a_bad_crc_bad_and_no_others(dissected: Dissect) -> None:
    """But for those of another length than their function has: it looks for the CRC elsewhere, or not at all."""
    of_expected_length = ("crc", "range", "count", "reserved", "value", "echo")
    chosen = [
        (vector["id"], vector["fault"] == "crc", bytes.fromhex(vector["response_wire"] or vector["request_wire"]))
        for _, vector in vectors("modbus")
        if vector["fault"] in of_expected_length and vector["id"] != "modbus-frame-256-bytes-bad-crc"
    ]

    seen = dissected([frame for _, _, frame in chosen])

    assert sum(bad for _, bad, _ in chosen) > 50
    assert [(name, bad) for name, bad, _ in chosen] == [
        (name, it.good_crc is False) for (name, _, _), it in zip(chosen, seen, strict=True)
    ]
