"""What holds for every DCON message, frame and stream."""

import re
from itertools import combinations
from typing import Any

import pytest
from attrs import evolve, fields
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from i7000 import DataFormat, DecodeError, EncodeError, Fault, Model, Noise, Profile, dcon
from i7000.dissect import meanings
from i7000.names import is_name
from i7000.readings import decode_field
from i7000.strategies import addresses, profiles, readings
from i7000.strategies.dcon import (
    DAMAGES,
    Damage,
    Exchange,
    Stream,
    any_commands,
    chunkings,
    commands,
    damaged,
    exchanges,
    frames,
    messages,
    near_misses,
    profiles_with,
    streams,
)
from tests.properties.outcomes import decoded, encoded

pytestmark = pytest.mark.no_cover

FEW = settings(max_examples=settings().max_examples // 6)
"""For what is tried with every class."""

COMMANDS = [kind for kind in dcon.COMMANDS if issubclass(kind, dcon.Command)]
BROADCASTS = [kind for kind in dcon.COMMANDS if issubclass(kind, dcon.Broadcast)]
MESSAGES = [kind for kind in vars(dcon).values() if isinstance(kind, type) and "syntax" in vars(kind)]

ODD = st.sampled_from(b"%#$~@!>?0123456789ABCDEFabcS*+-. \r\n\x00\x7f\xff")
ANY_BYTES = st.binary(max_size=300) | st.lists(ODD, max_size=80).map(bytes)
"""Bytes of every kind, and such as look like frames."""

each_command = pytest.mark.parametrize("kind", COMMANDS, ids=lambda kind: kind.__name__)
each_message = pytest.mark.parametrize("kind", MESSAGES, ids=lambda kind: kind.__name__)


def damages() -> st.SearchStrategy[tuple[Exchange, Damage]]:
    """An exchange, and its command or its response damaged."""
    return exchanges().flatmap(
        lambda exchange: st.tuples(
            st.just(exchange), st.sampled_from((exchange.command_wire, exchange.response_wire)).flatmap(damaged)
        )
    )


def decode(wire: bytes, exchange: Exchange) -> dcon.Message:
    """Read the bytes as the module does, or as the host does, by their leading character."""
    if wire[:1] in (b"!", b">", b"?"):
        return dcon.decode_response(wire, exchange.command, exchange.profile)
    return dcon.decode_command(wire, exchange.profile)


# --- round trips ------------------------------------------------------------------------------------------------------


@each_command
@FEW
@given(data=st.data())
def test_an_exchange_is_read_as_it_was_written(kind: type[dcon.Command[Any]], data: st.DataObject) -> None:
    exchange = data.draw(exchanges(kind))

    assert exchange.command == dcon.decode_command(exchange.command_wire, exchange.profile)
    assert exchange.response == dcon.decode_response(exchange.response_wire, exchange.command, exchange.profile)
    assert type(exchange.response) in (kind.response, dcon.Refused)


@pytest.mark.parametrize("kind", BROADCASTS)
@given(data=st.data())
def test_a_broadcast_is_read_as_it_was_written(kind: type[dcon.Broadcast], data: st.DataObject) -> None:
    profile = data.draw(profiles_with(kind))
    broadcast = data.draw(commands(profile, kind))

    assert broadcast == dcon.decode_command(dcon.encode(broadcast, profile), profile)


@given(data=st.data())
def test_a_forced_command_is_read_as_it_was_written_or_as_another_one(data: st.DataObject) -> None:
    profile = data.draw(profiles())
    command = data.draw(any_commands(profile))
    wire = dcon.encode(command, profile, force=True)

    if command.availability not in profile.refused:
        assert command == dcon.decode_command(wire, profile)
        return
    other = decoded(dcon.decode_command, wire, profile)

    if isinstance(other, DecodeError):
        assert other.fault is Fault.UNSUPPORTED
    else:
        assert {type(command), type(other)} in (
            {dcon.ReadAnalogInputsHex, dcon.ReadCjcUpdate},
            {dcon.CalibrateChannelZero, dcon.CalibrateCurrentChannelSpan},
        )


@given(damages())
def test_a_frame_that_is_read_is_written_as_it_was(case: tuple[Exchange, Damage]) -> None:
    exchange, damage = case
    wire = damage.wire
    message = decoded(decode, wire, exchange)

    assert isinstance(message, DecodeError) or is_written_as_read(message, wire, exchange.profile)


def is_written_as_read(message: dcon.Message, wire: bytes, profile: Profile) -> bool:
    """Whether the bytes that gave a message are those that it gives; the minus of a zero is lost."""
    offset = isinstance(message, dcon.CjcOffset | dcon.SetCjcOffset)
    minus_zero = b"-0000" if offset else b"-0000.0" if isinstance(message, dcon.CjcTemperature) else None
    return (minus_zero is not None and minus_zero in wire) or wire == dcon.encode(message, profile, force=True)


def test_minus_zero_is_the_one_offset_that_is_written_otherwise_than_it_was_read() -> None:
    profile = Profile(Model.M_7019R)

    command = dcon.decode_command(b"$019-0000\r", profile)

    assert command == dcon.SetCjcOffset(0x01, 0)
    assert dcon.encode(command, profile) == b"$019+0000\r"


@given(st.data())
def test_readings_go_through_a_report_unchanged(data: st.DataObject) -> None:
    profile = data.draw(profiles(known_types=True))
    values = tuple(data.draw(readings(code, profile.data_format)) for code in profile.type_codes)

    report = dcon.AnalogInputs(dcon.fields(values, profile))

    assert values == dcon.readings(report, profile)
    assert values == tuple(
        dcon.reading(dcon.AnalogInput(field), channel, profile) for channel, field in enumerate(report.values)
    )


@given(exchanges(dcon.ReadAnalogInputs, dcon.ReadAnalogInputsHex, dcon.ReadAnalogInput, dcon.ReadSynchronizedData))
def test_what_a_module_answers_has_readings(exchange: Exchange) -> None:
    response, profile = exchange.response, exchange.profile
    assume(profile.type_codes and not isinstance(response, dcon.Refused))

    if isinstance(response, dcon.AnalogInput):
        assert isinstance(exchange.command, dcon.ReadAnalogInput)
        assert dcon.reading(response, exchange.command.channel, profile).unit is not None
    else:
        assert isinstance(response, dcon.AnalogInputs | dcon.AnalogInputsHex | dcon.SynchronizedData)
        assert profile.units == tuple(reading.unit for reading in dcon.readings(response, profile))


@given(messages(dcon.AnalogInputs) | messages(dcon.AnalogInputsHex), profiles(known_types=True))
def test_readings_are_those_of_the_fields_one_by_one(
    report: dcon.AnalogInputs | dcon.AnalogInputsHex, profile: Profile
) -> None:
    assume(len(report.values) == profile.channels)
    data_format = DataFormat.HEX if isinstance(report, dcon.AnalogInputsHex) else profile.data_format
    fields = zip(report.values, profile.type_codes, strict=True)
    try:
        each = tuple(decode_field(it, code, data_format, legacy=profile.legacy_sentinels) for it, code in fields)
    except DecodeError:
        with pytest.raises(DecodeError):
            dcon.readings(report, profile)
    else:
        assert each == dcon.readings(report, profile)


# --- totality: a value or the package's own error ---------------------------------------------------------------------


@given(ANY_BYTES, exchanges())
def test_any_bytes_are_a_message_or_a_decode_error(wire: bytes, exchange: Exchange) -> None:
    command = decoded(dcon.decode_command, wire, exchange.profile)
    response = decoded(dcon.decode_response, wire, exchange.command, exchange.profile)

    assert isinstance(command, dcon.Command | dcon.Broadcast | DecodeError)
    assert isinstance(response, dcon.Response | DecodeError)


@given(damages(), st.data())
def test_a_frame_damaged_twice_is_a_message_or_a_decode_error(
    case: tuple[Exchange, Damage], data: st.DataObject
) -> None:
    exchange, once = case
    assume(once.wire)
    wire = data.draw(damaged(once.wire)).wire

    assert isinstance(decoded(decode, wire, exchange), dcon.Message | DecodeError)


@each_command
@FEW
@given(data=st.data())
def test_a_character_of_a_field_in_another_place_is_a_message_or_a_decode_error(
    kind: type[dcon.Command[Any]], data: st.DataObject
) -> None:
    exchange = data.draw(exchanges(kind))

    for frame in (exchange.command_wire, exchange.response_wire):
        for wire in near_misses(frame, checksum=exchange.profile.checksum):
            message = decoded(decode, wire, exchange)
            assert isinstance(message, DecodeError) or is_written_as_read(message, wire, exchange.profile)


@given(ANY_BYTES | damages().map(lambda case: case[1].wire))
def test_any_bytes_have_meanings_or_a_decode_error(wire: bytes) -> None:
    found = decoded(meanings, wire)

    assert isinstance(found, DecodeError) or found


@each_command
@FEW
@given(data=st.data())
def test_no_beginning_of_a_frame_is_a_message(kind: type[dcon.Command[Any]], data: st.DataObject) -> None:
    exchange = data.draw(exchanges(kind))

    for frame in (exchange.command_wire, exchange.response_wire):
        for length in range(len(frame)):
            error = decoded(decode, frame[:length], exchange)

            assert isinstance(error, DecodeError)
            assert error.fault is (Fault.TERMINATOR if length else Fault.LENGTH)


@given(messages(dcon.AnalogInputs) | messages(dcon.AnalogInputsHex) | messages(dcon.SynchronizedData), profiles())
def test_a_report_of_another_module_has_readings_or_a_decode_error(
    report: dcon.AnalogInputs | dcon.AnalogInputsHex | dcon.SynchronizedData, profile: Profile
) -> None:
    wire = "".join(report.values).encode()
    try:
        values = dcon.readings(report, profile)
    except DecodeError as error:
        assert wire.find(error.wire) >= 0  # noqa: PT017 - most reports have readings
    else:
        assert len(profile.type_codes) == len(values)


JUNK = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(), st.binary(), st.lists(st.text(), max_size=3),
    st.lists(st.text(), max_size=20).map(tuple), st.dictionaries(st.text(), st.none(), max_size=1),
)  # fmt: skip


@each_message
@FEW
@given(data=st.data())
def test_what_can_be_constructed_can_be_written_and_nothing_else_than_encode_error_is_raised(
    kind: type[dcon.Message], data: st.DataObject
) -> None:
    profile = data.draw(profiles())
    valid = data.draw(messages(kind, profile))
    values = {field.name: getattr(valid, field.name) for field in fields(kind)}  # type: ignore[arg-type]
    for name in data.draw(st.sets(st.sampled_from(sorted(values)))) if values else ():
        values[name] = data.draw(JUNK | st.just(getattr(valid, name)))

    message = encoded(kind, **values)
    if isinstance(message, EncodeError):
        assert message.field in values
        return
    wire = encoded(dcon.encode, message, profile, force=True)
    if isinstance(wire, EncodeError):  # a channel or mask of more digits than this module reads
        assert getattr(message, wire.field) >= 0x10
        assert "hex digit(s)" in str(wire)
    else:
        assert wire.endswith(b"\r")


@given(messages(dcon.Message), profiles())
def test_a_message_for_another_module_is_written_or_refused(message: dcon.Message, profile: Profile) -> None:
    wire = encoded(dcon.encode, message, profile)

    if isinstance(wire, EncodeError):
        assert str(wire).endswith(f"manual {wire.section}")
    else:
        assert wire == dcon.encode(message, profile, force=True)


# --- what is noticed, and what cannot be ------------------------------------------------------------------------------


def sealed_exchanges() -> st.SearchStrategy[Exchange]:
    return profiles().map(lambda profile: evolve(profile, checksum=True)).flatmap(lambda it: exchanges(profile=it))


@given(sealed_exchanges())
def test_no_flipped_bit_goes_unnoticed_by_the_checksum(exchange: Exchange) -> None:
    for wire in DAMAGES["flipped bit"](exchange.command_wire):
        with pytest.raises(DecodeError):
            dcon.decode_command(wire, exchange.profile)
    for wire in DAMAGES["flipped bit"](exchange.response_wire):
        with pytest.raises(DecodeError):
            dcon.decode_response(wire, exchange.command, exchange.profile)


@given(frames(checksum=True), st.data())
def test_a_changed_byte_is_noticed_by_the_checksum(frame: bytes, data: st.DataObject) -> None:
    at = data.draw(st.integers(0, len(frame) - 1))
    byte = data.draw(st.integers(0, 0xFF).filter(lambda byte: byte != frame[at]))

    with pytest.raises(DecodeError):
        dcon.unseal(frame[:at] + bytes((byte,)) + frame[at + 1 :], checksum=True)


@given(frames(checksum=True))
def test_every_other_checksum_is_refused(frame: bytes) -> None:
    right = dcon.unseal(frame, checksum=True)

    for wire in DAMAGES["wrong checksum"](frame):
        if wire != frame:
            with pytest.raises(DecodeError) as caught:
                dcon.unseal(wire, checksum=True)

            assert caught.value.fault is Fault.CHECKSUM
            assert len(right) == caught.value.offset


@given(frames(checksum=True).filter(lambda frame: frame[-3:].upper() != frame[-3:].lower()))
def test_a_checksum_in_lower_case_is_refused(frame: bytes) -> None:
    with pytest.raises(DecodeError) as caught:
        dcon.unseal(frame[:-3] + frame[-3:].lower(), checksum=True)

    assert caught.value.fault is Fault.CHECKSUM


@given(frames(checksum=True), st.data())
@example(dcon.seal(b">+025.12", checksum=True), None)
def test_swapped_neighbours_are_not_noticed_by_the_checksum(frame: bytes, data: st.DataObject | None) -> None:
    body = dcon.unseal(frame, checksum=True)
    assume(len(body) > 2)
    at = data.draw(st.integers(1, len(body) - 2)) if data else 3

    swapped = body[:at] + body[at : at + 2][::-1] + body[at + 2 :]

    assert swapped == dcon.unseal(swapped + frame[-3:], checksum=True)


def test_two_digits_of_a_reading_that_change_places_are_another_reading() -> None:
    profile = Profile(Model.I_7017, checksum=True)
    told, swapped = dcon.AnalogInput("+025.12"), dcon.AnalogInput("+052.12")
    wire = dcon.encode(told, profile)

    assert wire[-3:] == dcon.encode(swapped, profile)[-3:]
    assert swapped == dcon.decode_response(wire.replace(b"025", b"052"), dcon.ReadAnalogInput(0x01, 0), profile)


REPORT = dcon.seal(b">+025.12+020.45+012.78+018.97+003.24+015.35+008.07+014.79", checksum=True)


def passes(frame: bytes) -> bool:
    """Whether a report of 8 channels would be taken for one."""
    profile = Profile(Model.I_7017, checksum=True)
    try:
        return isinstance(dcon.decode_response(frame, dcon.ReadAnalogInputs(0x01), profile), dcon.AnalogInputs)
    except DecodeError:
        return False


def flipped(*bits: int) -> bytes:
    return (int.from_bytes(REPORT) ^ sum(1 << bit for bit in bits)).to_bytes(len(REPORT))


def test_what_a_report_loses_to_its_checksum_is_measured() -> None:
    """No flipped bit passes, of any two 0.94 %; of any two characters that change places 51 %."""
    bits = range(len(REPORT) * 8)
    body = range(1, len(REPORT) - len("CC\r"))
    places = [(one, other) for one, other in combinations(body, 2) if REPORT[one] != REPORT[other]]
    swapped = [
        REPORT[:one] + REPORT[other : other + 1] + REPORT[one + 1 : other] + REPORT[one : one + 1] + REPORT[other + 1 :]
        for one, other in places
    ]

    assert sum(passes(flipped(bit)) for bit in bits) == 0
    assert (sum(passes(flipped(*pair)) for pair in combinations(bits, 2)), len(bits)) == (1086, 480)
    assert (sum(map(passes, swapped)), len(swapped)) == (698, 1378)


@given(exchanges(), st.data())
def test_the_answer_of_another_module_is_refused(exchange: Exchange, data: st.DataObject) -> None:
    assume(exchange.response.layout.addressed)
    own: int = exchange.response.address  # type: ignore[attr-defined] # it is addressed
    address = data.draw(addresses().filter(lambda address: address != own))
    moved = {"address": address}
    if isinstance(exchange.command, dcon.SetConfiguration) and isinstance(exchange.response, dcon.Acknowledged):
        moved = {"new_address": address}
    command = evolve(exchange.command, **moved)
    assume(command != dcon.ReadConfiguration(0x00))  # in INIT mode

    with pytest.raises(DecodeError) as caught:
        dcon.decode_response(exchange.response_wire, command, exchange.profile)

    assert caught.value.fault is Fault.ADDRESS
    assert caught.value.offset == 1


@given(exchanges(dcon.ReadChannelTypeCode))
def test_the_type_of_another_channel_is_refused(exchange: Exchange) -> None:
    assume(isinstance(exchange.response, dcon.ChannelTypeCode))
    assert isinstance(exchange.command, dcon.ReadChannelTypeCode)
    other = evolve(exchange.command, channel=exchange.command.channel ^ 1)

    with pytest.raises(DecodeError) as caught:
        dcon.decode_response(exchange.response_wire, other, exchange.profile)

    assert caught.value.fault is Fault.VALUE


@pytest.mark.parametrize("kind", [kind for kind in COMMANDS if kind.response.syntax.startswith("!")])
@FEW
@given(data=st.data())
def test_no_answer_to_another_command_is_a_name_or_a_version(
    kind: type[dcon.Command[Any]], data: st.DataObject
) -> None:
    exchange = data.draw(exchanges(kind))
    response = exchange.response
    assume(not isinstance(response, dcon.Refused))
    address: int = response.address  # type: ignore[attr-defined] # all of these have one
    number = re.search(rb"^!..701[789]", exchange.response_wire)  # a mask that is the number of a series

    name = decoded(dcon.decode_response, exchange.response_wire, dcon.ReadModuleName(address), exchange.profile)
    version = decoded(dcon.decode_response, exchange.response_wire, dcon.ReadFirmwareVersion(address), exchange.profile)

    assert isinstance(name, dcon.ModuleName) == isinstance(response, dcon.ModuleName) or number
    assert isinstance(version, dcon.FirmwareVersion) == isinstance(response, dcon.FirmwareVersion)


@given(st.from_regex(r"[0-9A-F+\-CR.]{1,6}", fullmatch=True))
def test_what_is_no_name_is_another_answer(text: str) -> None:
    assume(not re.match("701[789]", text))
    frame = f"!01{text}\r".encode()
    assume(frame[-3:-1] != b"%02X" % (sum(frame[:-3]) & 0xFF))
    others = decoded(meanings, frame)

    told = () if isinstance(others, DecodeError) else [meaning.message for meaning in others]
    assert is_name(text) == all(isinstance(response, dcon.ModuleName) for response in told)


# --- what the profile and the command tell beforehand -----------------------------------------------------------------


@given(exchanges())
def test_a_command_is_among_its_meanings(exchange: Exchange) -> None:
    assert exchange.command in [meaning.message for meaning in meanings(exchange.command_wire)]


@given(exchanges())
def test_a_response_is_among_its_meanings(exchange: Exchange) -> None:
    assert exchange.response in [meaning.message for meaning in meanings(exchange.response_wire)]


@given(exchanges())
def test_no_response_is_longer_than_the_longest_response(exchange: Exchange) -> None:
    longest = dcon.longest_response(exchange.command, exchange.profile)

    assert len(exchange.response_wire) <= longest <= dcon.LONGEST_FRAME


@each_command
@FEW
@given(data=st.data())
def test_the_longest_response_is_exact_for_a_fixed_length(kind: type[dcon.Command[Any]], data: st.DataObject) -> None:
    exchange = data.draw(exchanges(kind))
    assume(type(exchange.response) is kind.response)
    assume(not exchange.profile.legacy_sentinels)

    told = dcon.longest_response(exchange.command, exchange.profile)

    if isinstance(exchange.response, dcon.FirmwareVersion):
        assert len(exchange.response.version) - 5 == len(exchange.response_wire) - told
    elif isinstance(exchange.response, dcon.ModuleName):
        assert len(exchange.response.name) - 6 == len(exchange.response_wire) - told
    else:
        assert len(exchange.response_wire) == told


# --- streams ----------------------------------------------------------------------------------------------------------


def split(pieces: tuple[bytes, ...], *, checksum: bool) -> tuple[list[bytes | Noise], bytes]:
    """What is found in a stream that arrives in pieces; each rest is shorter than a frame."""
    found: list[bytes | Noise] = []
    rest = b""
    for piece in pieces:
        events, rest = dcon.split(rest + piece, checksum=checksum)
        assert len(rest) < dcon.LONGEST_FRAME
        found += events
    return found, rest


def runs(events: list[bytes | Noise] | tuple[bytes | Noise, ...]) -> tuple[bytes | Noise, ...]:
    """The events with adjacent noise put together; a frame with a wrong checksum stays by itself."""
    found: list[bytes | Noise] = []
    for event in events:
        last = found[-1] if found else None
        if isinstance(event, Noise) and isinstance(last, Noise) and Fault.CHECKSUM not in (event.fault, last.fault):
            found[-1] = Noise(last.wire + event.wire, last.fault)
        else:
            found.append(event)
    return tuple(found)


def wires(events: list[bytes | Noise]) -> bytes:
    return b"".join(event.wire if isinstance(event, Noise) else event for event in events)


ANY_STREAM = streams() | streams(checksum=True)


@given(ANY_STREAM)
def test_every_frame_of_a_stream_is_found_and_all_noise_is_named(stream: Stream) -> None:
    events, rest = split((stream.wire,), checksum=stream.checksum)

    assert stream.events == runs(events)
    assert stream.rest == rest


@given(ANY_STREAM.flatmap(lambda stream: st.tuples(st.just(stream), chunkings(stream.wire))))
def test_however_a_stream_arrives_the_same_is_found(case: tuple[Stream, tuple[bytes, ...]]) -> None:
    stream, pieces = case

    events, rest = split(pieces, checksum=stream.checksum)

    assert stream.events == runs(events)
    assert stream.rest == rest


MANY_BYTES = st.lists(ODD, max_size=2000).map(bytes) | st.binary(max_size=2000)


@given(MANY_BYTES.flatmap(lambda wire: st.tuples(st.just(wire), chunkings(wire))), st.booleans())
def test_no_byte_of_a_stream_is_lost(case: tuple[bytes, tuple[bytes, ...]], checksum: bool) -> None:  # noqa: FBT001
    wire, pieces = case

    events, rest = split(pieces, checksum=checksum)

    assert wire == wires(events) + rest


@given(MANY_BYTES.flatmap(lambda wire: st.tuples(st.just(wire), chunkings(wire))))
def test_the_frames_of_any_bytes_are_those_of_their_definition(case: tuple[bytes, tuple[bytes, ...]]) -> None:
    wire, pieces = case
    frame = rb"[%#$~@!>?][^%#$~@!>?\x00-\x1f\x7f-\xff]{0,254}\r"

    events, _ = split(pieces, checksum=False)

    assert re.findall(frame, wire) == [event for event in events if isinstance(event, bytes)]


@given(MANY_BYTES.flatmap(lambda wire: st.tuples(st.just(wire), chunkings(wire))), st.booleans())
def test_any_bytes_are_split_the_same_however_they_arrive(
    case: tuple[bytes, tuple[bytes, ...]],
    checksum: bool,  # noqa: FBT001
) -> None:
    wire, pieces = case

    assert split((wire,), checksum=checksum)[1] == split(pieces, checksum=checksum)[1]
    assert runs(split((wire,), checksum=checksum)[0]) == runs(split(pieces, checksum=checksum)[0])


@given(frames(checksum=True))
def test_a_frame_without_its_end_is_kept_for_later(frame: bytes) -> None:
    assert dcon.split(frame[:-1], checksum=True) == ((), frame[:-1])
    assert dcon.split(frame, checksum=True) == ((frame,), b"")


@given(st.text(alphabet="".join(map(chr, range(0x20, 0x7F))), max_size=200).map(str.encode))
def test_a_body_that_is_sealed_is_unsealed(body: bytes) -> None:
    frame = b"!" + body

    for checksum in (False, True):
        assert frame == dcon.unseal(dcon.seal(frame, checksum=checksum), checksum=checksum)
