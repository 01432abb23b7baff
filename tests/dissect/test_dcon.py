"""Frames read with groups of profiles, against reading them with each profile by itself."""

from collections.abc import Iterable, Iterator
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import DataFormat, DecodeError, Fault, Firmware, Model, Profile, TypeCode, dcon
from i7000.dissect import Known, meanings
from i7000.dissect.dcon import DconReader, is_command
from i7000.message import Message
from tests.vectors import dcon_vectors

KNOWN = [
    Known(),
    Known(Model.M_7019R),
    Known(Model.I_7018, firmware=Firmware("B1.2")),
    Known(Model.I_7018, types=(TypeCode.K,)),
    Known(Model.I_7017Z, single_ended=True),
    Known(checksum=True),
    Known(data_format=DataFormat.HEX),
    Known(types=(TypeCode.V_10,)),
]
READERS = [(known, DconReader(known)) for known in KNOWN]
EXCHANGES = [
    tuple(bytes.fromhex(wire) if wire else None for wire in (vector["command_wire"], vector["response_wire"]))
    for case in dcon_vectors("response", "refused", "silence", "reject")
    for vector in case.values
]

Read = set[tuple[Message, Message | None]]


def read_by_itself(frame: bytes, asked: bytes | None, profile: Profile) -> Iterator[Read]:
    """All that a frame is to one profile; nothing where it is not to be read."""
    if is_command(frame):
        yield {(dcon.decode_command(frame, profile), None)}
        return
    command = None
    if asked is not None:
        try:
            command = dcon.decode_command(asked, profile)
        except DecodeError:
            return
    if isinstance(command, dcon.Command):
        yield {(dcon.decode_response(frame, command, profile), command)}
        return
    body = dcon.unseal(frame, checksum=profile.checksum, leads=b"!>?").decode("ascii")
    kinds = {dcon.Refused} | {
        it.response for it in dcon.COMMANDS if issubclass(it, dcon.Command) and it.availability not in profile.refused
    }
    for kind in kinds:
        try:
            yield {(kind.layout.decode(body, profile), None)}
        except (KeyError, DecodeError):
            continue


def by_profile(frame: bytes, asked: bytes | None, profiles: Iterable[Profile]) -> dict[Profile, Read]:
    found: dict[Profile, Read] = {}
    for profile in profiles:
        try:
            read = set().union(*read_by_itself(frame, asked, profile))
        except DecodeError:
            continue
        if read:
            found[profile] = read
    return found


def can_be_asked(asked: bytes, known: Known) -> bool:
    profiles = known.all if known.default is None else (known.default, *known.all)
    return bool(by_profile(asked, None, profiles))


def agree(frame: bytes, asked: bytes | None, known: Known, reader: DconReader) -> None:
    """Check that what profiles read in groups is what each of them reads."""
    try:
        meanings = reader.meanings(frame, asked)
    except DecodeError:
        meanings = ()
    found: dict[Profile, Read] = {}
    for meaning in meanings:
        for profile in meaning.fit.profiles:
            found.setdefault(profile, set()).add((meaning.message, meaning.command))
    if asked is not None and not can_be_asked(asked, known):
        asked = None
    by_default = known.default is not None and set(found) == {known.default}
    expected = by_profile(frame, asked, [known.default] if known.default is not None and by_default else known.all)

    if known.types is None and not by_default:
        assert expected == found
    else:  # what has other decimals than the type is left out where another format fits
        assert all(found[profile] <= expected[profile] for profile in found)
        assert bool(found) == bool(expected)


@pytest.mark.no_cover
@pytest.mark.parametrize(("known", "reader"), READERS, ids=lambda it: "" if isinstance(it, DconReader) else str(it))
def test_groups_of_profiles_read_what_each_of_them_reads(known: Known, reader: DconReader) -> None:
    for command, response in EXCHANGES[:: 1 if known.model else 7]:  # all models are many
        if command and is_command(command):
            agree(command, None, known, reader)
        if response and not is_command(response):
            agree(response, command if command and is_command(command) else None, known, reader)
            agree(response, None, known, reader)


COMMANDS = sorted({command for command, _ in EXCHANGES if command and is_command(command)})
FRAMES = sorted({frame for exchange in EXCHANGES for frame in exchange if frame})


@pytest.mark.no_cover
@given(
    st.sampled_from(READERS), st.sampled_from(FRAMES), st.sampled_from([None, *COMMANDS]), st.integers(0, 60),
    st.sampled_from(b"0129AF+-. !>$#"),
)  # fmt: skip
def test_groups_of_profiles_read_damaged_frames_alike(
    known_reader: tuple[Known, DconReader], frame: bytes, asked: bytes | None, at: int, byte: int
) -> None:
    known, reader = known_reader
    damaged = frame[: at % len(frame)] + bytes((byte,)) + frame[at % len(frame) + 1 :]

    agree(damaged, None if is_command(damaged) else asked, known, reader)


def test_meanings_are_in_the_order_of_the_sections() -> None:
    (first, *_, last) = DconReader(Known()).meanings(b"!01050600\r")

    assert [type(it.message).__name__ for it in (first, last)] == ["Configuration", "ChannelMask"]
    assert first.fit.models == tuple(Model)


def test_the_first_fault_is_that_of_the_factory_defaults() -> None:
    with pytest.raises(DecodeError) as error:
        DconReader(Known(Model.I_7018)).meanings(b"!0105\r", b"$012\r")

    with pytest.raises(DecodeError) as expected:
        dcon.decode_response(b"!0105\r", dcon.ReadConfiguration(1), Profile(Model.I_7018))
    assert str(expected.value) == str(error.value)


# --- unknown modules --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("frame", "commands"),
    [
        (b"$01A\r", [dcon.ReadAnalogInputsHex, dcon.ReadCjcUpdate]),
        (b"$010C0\r", [dcon.CalibrateCurrentChannelSpan, dcon.CalibrateChannelZero]),
        (b"#0184\r", [dcon.ReadAnalogInputs, dcon.ReadAnalogInput]),
        (b"#**\r", [dcon.SynchronizedSampling]),
    ],
)
def test_a_command_of_an_unknown_module_is_all_that_it_could_be(frame: bytes, commands: list[Any]) -> None:
    assert commands == [type(meaning.message) for meaning in meanings(frame)]


@pytest.mark.parametrize(
    ("frame", "fault", "offset"),
    [
        (b"", Fault.LENGTH, 0),
        (b"$01z\r", Fault.COMMAND, 3),
        (b"$012B6", Fault.TERMINATOR, 6),
        (b"x" * 300, Fault.LENGTH, 256),
        (b"$01A3\r", Fault.VALUE, 4),
        (b"$017C0X30\r", Fault.CHARACTER, 6),
    ],
)
def test_what_no_module_understands_is_shown_by_the_command_that_is_nearest(
    frame: bytes, fault: Fault, offset: int
) -> None:
    with pytest.raises(DecodeError) as caught:
        meanings(frame)

    assert (fault, offset) == (caught.value.fault, caught.value.offset)


@pytest.mark.parametrize("frame", [b"", b"!01\xff\r", b"!\r", b">zz\r"])
def test_what_no_module_says_means_nothing(frame: bytes) -> None:
    with pytest.raises(DecodeError):
        meanings(frame)


@pytest.mark.parametrize(
    ("known", "names"),
    [
        (Known(Model.I_7018), ["AnalogInput", "CjcTemperature"]),
        (Known(Model.I_7018, types=(TypeCode.K,) * 8), ["AnalogInput", "CjcTemperature"]),
        (Known(Model.I_7018, types=(TypeCode.V_2_5,) * 8), ["CjcTemperature"]),
        (Known(), ["AnalogInput", "CjcTemperature"]),
    ],
)
def test_a_type_that_is_only_assumed_excludes_no_meaning(known: Known, names: list[str]) -> None:
    found = meanings(b">+0025.1\r", known=known)

    assert [type(it.message).__name__ for it in found] == names


def test_a_meaning_that_the_assumed_type_excludes_has_an_unknown_type() -> None:
    found, _ = meanings(b">+0025.1\r", known=Known(Model.I_7018))

    assert [(it.text, it.type_code, it.value) for it in found.readings] == [("+0025.1", None, None)]
