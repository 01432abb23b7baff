"""What holds for every Modbus message."""

from typing import Any

import pytest
from attrs import evolve, fields
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from i7000 import DecodeError, EncodeError, Fault, ModbusDataFormat, Profile, modbus
from i7000.readings import encode_engineering_word, encode_word
from i7000.strategies import word_readings
from i7000.strategies.modbus import (
    Damage,
    Exchange,
    any_requests,
    damaged,
    exchanges,
    messages,
    profiles,
    profiles_with,
    requests,
    responses,
)
from tests.properties.outcomes import decoded, encoded

pytestmark = pytest.mark.no_cover

FEW = settings(max_examples=settings().max_examples // 6)
"""For what is tried with every class."""

SHORTEST_RESPONSE = 5
MESSAGES = [kind for kind in vars(modbus).values() if isinstance(kind, type) and "pdu" in vars(kind)]
BROADCASTS = [kind for kind in modbus.REQUESTS if kind.broadcast]

FUNCTIONS = [it | bit for it in (*range(0x01, 0x07), 0x0F, 0x10, 0x46) for bit in (0x00, 0x80)]
BODIES = st.binary(max_size=254) | st.builds(
    lambda address, function, others: bytes((address, function)) + others,
    st.integers(0, 0xFF),
    st.sampled_from(FUNCTIONS),
    st.lists(st.sampled_from((*range(0x31), 0x80, 0xFF)), max_size=20).map(bytes),
)
ANY_BYTES = st.binary(max_size=300) | BODIES.map(modbus.seal)
"""Bytes of every kind, and frames of every kind of bytes."""

each_request = pytest.mark.parametrize("kind", modbus.REQUESTS, ids=lambda kind: kind.__name__)
each_message = pytest.mark.parametrize("kind", MESSAGES, ids=lambda kind: kind.__name__)


class Case:
    """An exchange, its request or its response damaged, and who reads it."""

    def __init__(self, exchange: Exchange, damage: Damage) -> None:
        self.exchange = exchange
        self.damage = damage

    def decode(self, wire: bytes) -> modbus.Message:
        if self.damage.frame == self.exchange.request_wire:
            return modbus.decode_request(wire, self.exchange.profile)
        return modbus.decode_response(wire, self.exchange.request, self.exchange.profile)


def cases() -> st.SearchStrategy[Case]:
    return exchanges().flatmap(
        lambda exchange: st.builds(
            Case, st.just(exchange), st.sampled_from((exchange.request_wire, exchange.response_wire)).flatmap(damaged)
        )
    )


# --- round trips ------------------------------------------------------------------------------------------------------


@each_request
@FEW
@given(data=st.data())
def test_an_exchange_is_read_as_it_was_written(kind: type[modbus.Request[Any]], data: st.DataObject) -> None:
    exchange = data.draw(exchanges(kind))

    assert modbus.is_answered(exchange.request)
    assert exchange.request == modbus.decode_request(exchange.request_wire, exchange.profile)
    assert exchange.response == modbus.decode_response(exchange.response_wire, exchange.request, exchange.profile)
    assert type(exchange.response) in (kind.response, modbus.ExceptionResponse)


@pytest.mark.parametrize("kind", BROADCASTS, ids=lambda kind: kind.__name__)
@FEW
@given(data=st.data())
def test_a_broadcast_is_read_as_it_was_written(kind: type[modbus.Request[Any]], data: st.DataObject) -> None:
    profile = data.draw(profiles_with(kind))
    broadcast = evolve(data.draw(requests(profile, kind)), address=modbus.BROADCAST)

    assert not modbus.is_answered(broadcast)
    assert broadcast == modbus.decode_request(modbus.encode(broadcast, profile), profile)


@given(data=st.data())
def test_a_forced_request_is_read_as_it_was_written(data: st.DataObject) -> None:
    profile = data.draw(profiles())
    request = data.draw(any_requests(profile))

    assert request == modbus.decode_request(modbus.encode(request, profile, force=True), profile)


@given(cases())
def test_a_frame_that_is_read_is_written_as_it_was(case: Case) -> None:
    wire = case.damage.wire
    message = decoded(case.decode, wire)

    assert isinstance(message, DecodeError) or wire == modbus.encode(message, case.exchange.profile, force=True)


@given(ANY_BYTES, profiles())
def test_any_request_that_is_read_is_written_as_it_was(wire: bytes, profile: Profile) -> None:
    request = decoded(modbus.decode_request, wire, profile)

    assert isinstance(request, DecodeError) or wire == modbus.encode(request, profile, force=True)


@given(st.data())
def test_readings_go_through_registers_unchanged(data: st.DataObject) -> None:
    profile = data.draw(profiles(known_types=True))
    encode = encode_word if profile.modbus_data_format is ModbusDataFormat.HEX else encode_engineering_word
    values = tuple(data.draw(word_readings(code, profile.modbus_data_format)) for code in profile.type_codes)

    words = tuple(encode(reading, code) for reading, code in zip(values, profile.type_codes, strict=True))

    assert values == modbus.readings(words, profile)
    assert values == tuple(modbus.readings((word,), profile, channel=channel)[0] for channel, word in enumerate(words))


# --- totality: a value or the package's own error ---------------------------------------------------------------------


@given(ANY_BYTES, exchanges())
def test_any_bytes_are_a_message_or_a_decode_error(wire: bytes, exchange: Exchange) -> None:
    request = decoded(modbus.decode_request, wire, exchange.profile)
    response = decoded(modbus.decode_response, wire, exchange.request, exchange.profile)

    assert isinstance(request, modbus.Request | DecodeError)
    assert isinstance(response, modbus.Response | DecodeError)


@given(cases(), st.data())
def test_a_frame_damaged_twice_is_a_message_or_a_decode_error(case: Case, data: st.DataObject) -> None:
    assume(case.damage.wire)
    wire = data.draw(damaged(case.damage.wire)).wire

    assert isinstance(decoded(case.decode, wire), modbus.Message | DecodeError)


@each_request
@FEW
@given(data=st.data())
def test_no_beginning_of_a_frame_is_a_message(kind: type[modbus.Request[Any]], data: st.DataObject) -> None:
    exchange = data.draw(exchanges(kind))
    request, response = exchange.request_wire, exchange.response_wire

    beginnings: list[tuple[int, modbus.Message | DecodeError]] = [
        (modbus.SHORTEST_FRAME, decoded(modbus.decode_request, request[:end], exchange.profile))
        for end in range(len(request))
    ]
    beginnings += [
        (SHORTEST_RESPONSE, decoded(modbus.decode_response, response[:end], exchange.request, exchange.profile))
        for end in range(len(response))
    ]

    for shortest, error in beginnings:
        assert isinstance(error, DecodeError)
        if modbus.crc16(error.wire):
            assert error.fault is (Fault.CRC if len(error.wire) >= shortest else Fault.LENGTH)


@each_request
@FEW
@given(data=st.data())
def test_no_beginning_of_a_pdu_is_a_message_even_with_a_good_crc(
    kind: type[modbus.Request[Any]], data: st.DataObject
) -> None:
    exchange = data.draw(exchanges(kind))
    request, response = exchange.request_wire[:-2], exchange.response_wire[:-2]

    for length in range(len(request)):
        wire = modbus.seal(request[:length])
        assert isinstance(decoded(modbus.decode_request, wire, exchange.profile), DecodeError)
    for length in range(len(response)):
        wire = modbus.seal(response[:length])
        assert isinstance(decoded(modbus.decode_response, wire, exchange.request, exchange.profile), DecodeError)


@given(st.lists(st.integers(0, 0xFFFF), max_size=20), profiles(), st.integers(-5, 25))
def test_registers_of_another_module_have_readings_or_a_decode_error(
    words: list[int], profile: Profile, channel: int
) -> None:
    known = channel >= 0 and channel + len(words) <= len(profile.type_codes)
    try:
        values = modbus.readings(words, profile, channel=channel)
    except DecodeError as error:
        assert error.fault is Fault.NUMBER  # noqa: PT017 - most registers have readings
        assert not known
    else:
        assert known or not words
        assert len(words) == len(values)


JUNK = st.one_of(
    st.none(), st.booleans(), st.integers(), st.integers(min_value=1 << 64), st.floats(), st.text(), st.binary(),
    st.lists(st.integers(), max_size=3), st.lists(st.integers() | st.booleans(), max_size=20).map(tuple),
    st.just((False,) * 2001), st.just((0,) * 126), st.just(()),
)  # fmt: skip


@each_message
@FEW
@given(data=st.data())
def test_what_can_be_constructed_can_be_written_and_nothing_else_than_encode_error_is_raised(
    kind: type[modbus.Message], data: st.DataObject
) -> None:
    profile = data.draw(profiles())
    valid = data.draw(messages(kind, profile))
    values = {field.name: getattr(valid, field.name) for field in fields(kind)}
    for name in data.draw(st.sets(st.sampled_from(sorted(values)), max_size=2)):
        values[name] = data.draw(JUNK | st.just(getattr(valid, name)))

    message = encoded(kind, **values)
    wire = message if isinstance(message, EncodeError) else encoded(modbus.encode, message, profile, force=True)
    if isinstance(wire, EncodeError):
        assert wire.field in {*values, "count"}  # of what is in a list, and no field
        assert str(wire).endswith(f"manual {wire.section}")
    else:
        assert modbus.unseal(wire)[0] == values["address"]


@given(messages(modbus.Message), profiles())
def test_a_message_for_another_module_is_written_or_refused(message: modbus.Message, profile: Profile) -> None:
    wire = encoded(modbus.encode, message, profile)

    if isinstance(wire, EncodeError):
        assert str(wire).endswith(f"manual {wire.section}")
    else:
        assert wire == modbus.encode(message, profile, force=True)


@given(messages(modbus.Message))
def test_a_message_is_written_without_a_profile_but_for_masks(message: modbus.Message) -> None:
    wire = encoded(modbus.encode, message)

    assert isinstance(wire, EncodeError) == hasattr(message, "mask")


# --- answers to something else ----------------------------------------------------------------------------------------


@given(exchanges(), st.integers(1, 247))
def test_the_answer_of_another_module_is_refused(exchange: Exchange, address: int) -> None:
    assume(address != exchange.request.address)
    request = evolve(exchange.request, address=address)

    with pytest.raises(DecodeError) as caught:
        modbus.decode_response(exchange.response_wire, request, exchange.profile)

    assert caught.value.fault is Fault.ADDRESS
    assert caught.value.offset == 0


@given(exchanges(), st.data())
def test_the_answer_to_another_function_is_refused(exchange: Exchange, data: st.DataObject) -> None:
    asked = type(exchange.request)
    refused = exchange.profile.refused
    others = [kind for kind in modbus.REQUESTS if kind is not asked and kind.availability not in refused]
    other = evolve(data.draw(requests(exchange.profile, *others)), address=exchange.request.address)
    assume(other.function != asked.function or not isinstance(exchange.response, modbus.ExceptionResponse))

    with pytest.raises(DecodeError) as caught:
        modbus.decode_response(exchange.response_wire, other, exchange.profile)

    assert caught.value.fault is (Fault.FUNCTION if other.function != asked.function else Fault.SUB_FUNCTION)


READS: tuple[Any, ...] = (
    modbus.ReadCoils,
    modbus.ReadDiscreteInputs,
    modbus.ReadHoldingRegisters,
    modbus.ReadInputRegisters,
)


@given(st.data())
def test_other_items_than_were_asked_for_are_refused(data: st.DataObject) -> None:
    profile = data.draw(profiles())
    asked = data.draw(st.sampled_from(READS))
    one, other = (asked(1, 0, data.draw(st.integers(1, 125))) for _ in range(2))
    width = 8 if asked in READS[:2] else 1
    assume((one.count + width - 1) // width != (other.count + width - 1) // width)
    response = data.draw(responses(one, profile))
    assume(not isinstance(response, modbus.ExceptionResponse))

    with pytest.raises(DecodeError) as caught:
        modbus.decode_response(modbus.encode(response), other, profile)

    assert caught.value.fault is Fault.COUNT


def with_padding(frame: bytes, count: int, data: st.DataObject) -> bytes:
    """The frame with padding bits set behind its `count` items, in its last byte."""
    padding = data.draw(st.integers(1, 0xFF >> count % 8)) << count % 8
    return modbus.seal(frame[:-3] + bytes((frame[-3] | padding,)))


PADDED = st.lists(st.booleans(), min_size=1, max_size=1968).map(tuple).filter(lambda values: len(values) % 8)


@given(PADDED, st.sampled_from(READS[:2]), st.data())
def test_padding_bits_of_an_answer_are_dropped(values: Any, asked: Any, data: st.DataObject) -> None:
    request = asked(1, 0, len(values))
    response = request.response(1, values)
    wire = with_padding(modbus.encode(response), len(values), data)

    assert response == modbus.decode_response(wire, request, data.draw(profiles()))


@given(PADDED, st.data())
def test_padding_bits_of_a_request_are_dropped(values: Any, data: st.DataObject) -> None:
    request = modbus.WriteMultipleCoils(1, 0, values)
    wire = with_padding(modbus.encode(request), len(values), data)

    assert request == modbus.decode_request(wire, data.draw(profiles()))


@given(PADDED, st.sampled_from((modbus.Coils, modbus.DiscreteInputs)))
def test_padding_bits_are_written_as_zero(values: Any, kind: Any) -> None:
    for message in (kind(1, values), modbus.WriteMultipleCoils(1, 0, values)):
        assert modbus.encode(message)[-3] >> len(values) % 8 == 0


@given(st.data())
def test_reserved_bits_of_an_answer_are_refused(data: st.DataObject) -> None:
    profile = data.draw(profiles_with(modbus.ReadCjcOffset))
    bit = data.draw(st.sampled_from((0, 1, 2, 3, 4, 6)))
    channel = data.draw(st.integers(0x80, 0x7F + profile.channels))
    answers: dict[modbus.Request[Any], modbus.Response] = {
        modbus.ReadMiscellaneousSettings(1): modbus.MiscellaneousSettings(1, 0xA0 | 1 << bit),
        modbus.ReadCjcOffset(1, channel): modbus.CjcOffset(1, 0x100 << bit),
    }

    for request, answer in answers.items():
        with pytest.raises(DecodeError) as caught:
            modbus.decode_response(modbus.encode(answer), request, profile)

        assert caught.value.fault is Fault.RESERVED


@given(st.data())
def test_the_answer_to_another_write_is_refused(data: st.DataObject) -> None:
    profile = data.draw(profiles_with(modbus.WriteSingleCoil))
    kind = data.draw(st.sampled_from(BROADCASTS))
    exchange = data.draw(exchanges(kind, profile=profile))
    assume(not isinstance(exchange.response, modbus.ExceptionResponse))
    other = evolve(data.draw(requests(profile, kind)), address=exchange.request.address)
    own = modbus.encode(exchange.request)[:6]
    assume(own != modbus.encode(other)[:6])

    with pytest.raises(DecodeError) as caught:
        modbus.decode_response(exchange.response_wire, other, exchange.profile)

    assert caught.value.fault is Fault.ECHO
