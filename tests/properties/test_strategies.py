"""That the strategies make what they say, and that Hypothesis knows them."""

import subprocess
import sys
from typing import Any

import pytest
from hypothesis import Phase, find, given, settings
from hypothesis import strategies as st

import i7000
from i7000 import DataFormat, Fault, Model, Noise, Profile, Reading, Status, TypeCode, dcon, device, host, modbus
from i7000.host import procedures
from i7000.strategies import errors, firmwares, line_settings, profiles, readings, report_settings, word_readings
from i7000.strategies.dcon import (
    DAMAGES,
    Damage,
    Stream,
    any_commands,
    channel_fields,
    chunkings,
    commands,
    damaged,
    exchanges,
    frames,
    messages,
    near_misses,
    profiles_with,
    responses,
    streams,
)

CLASSES = [
    kind
    for module in (i7000, dcon, modbus, device, host, procedures)
    for kind in (getattr(module, name) for name in module.__all__)
    if isinstance(kind, type)
]
PLAINEST = Profile(Model.I_7017)
QUICKLY = settings(max_examples=200, database=None, phases=(Phase.generate, Phase.shrink))
ONCE = settings(QUICKLY, max_examples=10_000, phases=(Phase.generate,))
"""For what has to be there at all; the smallest takes longer to find."""


def smallest(strategy: st.SearchStrategy[Any]) -> Any:
    return find(strategy, lambda _: True, settings=QUICKLY)


# --- registration -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: f"{kind.__module__}.{kind.__name__}")
@settings(max_examples=5)
@given(data=st.data())
def test_hypothesis_makes_values_of_every_public_class(kind: type, data: st.DataObject) -> None:
    assert isinstance(data.draw(st.from_type(kind)), kind)


@given(st.from_type(dcon.AnyCommand))  # type: ignore[arg-type] # a union
def test_hypothesis_knows_what_a_host_sends(command: dcon.AnyCommand) -> None:
    assert isinstance(command, dcon.Command | dcon.Broadcast)


@pytest.mark.parametrize(
    "code",
    [
        "import sys, i7000, i7000.dcon, i7000.modbus; assert 'hypothesis' not in sys.modules",
        "import i7000.strategies; from hypothesis import strategies as st; st.from_type(i7000.Profile).validate()",
        "from hypothesis import strategies as st; import i7000; st.from_type(i7000.Profile).validate()",
    ],
    ids=["the-package-alone", "strategies-first", "hypothesis-first"],
)
def test_whatever_is_imported_first_nothing_warns(code: str) -> None:
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)  # noqa: S603 - our own


# --- the smallest example is the plainest -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("strategy", "plainest"),
    [
        (profiles(), PLAINEST),
        (profiles(known_types=True), PLAINEST),
        (profiles(Model.M_7019Z), Profile(Model.M_7019Z)),
        (line_settings(), i7000.LineSettings()),
        (report_settings(), i7000.ReportSettings()),
        (readings(TypeCode.V_10, DataFormat.ENGINEERING), Reading(0.0, i7000.Unit.VOLT)),
        (readings(TypeCode.MA_4_20, DataFormat.PERCENT), Reading(4.0, i7000.Unit.MILLIAMPERE)),
        (commands(PLAINEST), dcon.ReadAnalogInputs(0x01)),
        (commands(PLAINEST, dcon.ReadAnalogInput), dcon.ReadAnalogInput(0x01, 0)),
        (any_commands(PLAINEST), dcon.ReadAnalogInputs(0x01)),
        (messages(dcon.Command), dcon.ReadAnalogInputs(0x01)),
        (messages(dcon.Response), dcon.Refused(0x01)),
        (exchanges().map(lambda it: (it.profile, it.command)), (PLAINEST, dcon.ReadAnalogInputs(0x01))),
        (channel_fields(DataFormat.ENGINEERING), "+00.000"),
        (channel_fields(DataFormat.PERCENT), "+000.00"),
        (channel_fields(DataFormat.HEX), "0000"),
        (streams(), Stream(b"", False, (), b"")),
        (chunkings(b"!01\r!02\r"), (b"!01\r!02\r",)),
    ],
)  # fmt: skip
def test_the_smallest_example_is_the_plainest(strategy: st.SearchStrategy[Any], plainest: object) -> None:
    assert plainest == smallest(strategy)


# --- what is made is what was asked for -------------------------------------------------------------------------------


@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
@settings(max_examples=20)
@given(data=st.data())
def test_commands_and_responses_are_those_of_the_module(model: Model, data: st.DataObject) -> None:
    profile = data.draw(profiles(model))
    command = data.draw(commands(profile))
    wires = [dcon.encode(command, profile)]
    if isinstance(command, dcon.Command):
        wires.append(dcon.encode(data.draw(responses(command, profile)), profile))

    assert profile.model is model
    assert all(len(wire) <= dcon.LONGEST_FRAME for wire in wires)


@pytest.mark.parametrize("kind", dcon.COMMANDS, ids=lambda kind: kind.__name__)
@settings(max_examples=10)
@given(data=st.data())
def test_a_profile_for_a_command_has_it(kind: type[dcon.AnyCommand], data: st.DataObject) -> None:
    profile = data.draw(profiles_with(kind))

    assert kind.availability not in profile.refused
    assert isinstance(data.draw(commands(profile, kind)), kind)


@pytest.mark.parametrize(
    ("model", "kind", "at_limit"),
    [
        (Model.M_7019Z, dcon.ReadAnalogInput, lambda it: it.channel == 9),
        (Model.M_7019R, dcon.SetChannelMask, lambda it: it.mask == 0xFF),
        (Model.M_7019R, dcon.SetCjcOffset, lambda it: it.offset > 0x0F00),
        (Model.M_7019R, dcon.SetCjcOffset, lambda it: it.offset < -0x0F00),
        (Model.M_7019R, dcon.SetSoftInitTimeout, lambda it: it.timeout == 60),
        (Model.M_7019R, dcon.SetModuleName, lambda it: len(it.name) == 6),
        (Model.M_7019R, dcon.SetConfiguration, lambda it: it.new_address == 0xFF),
        (Model.M_7019R, dcon.SetConfiguration, lambda it: not isinstance(it.type_code, TypeCode)),
        (Model.I_7017R, dcon.SetConfiguration, lambda it: it.type_code == i7000.MIXED),
        (Model.I_7017R, dcon.SetConfiguration, lambda it: it.report_settings.byte == 0xE2),
        (Model.I_7017R, dcon.SetConfiguration, lambda it: it.line_settings.byte == 0xCA),
    ],
)
def test_all_that_a_module_takes_is_made(model: Model, kind: type[dcon.AnyCommand], at_limit: Any) -> None:
    strategy = commands(Profile(model), kind)

    assert at_limit(find(strategy, at_limit, settings=ONCE))


@pytest.mark.parametrize(
    "refusal",
    [
        lambda command: command.availability in PLAINEST.refused,
        lambda command: getattr(command, "channel", 0) >= PLAINEST.channels,
        lambda command: isinstance(command, dcon.SetConfiguration) and command.report_settings.reserved,
    ],
    ids=["command", "channel", "reserved-bits"],
)
def test_what_a_module_refuses_is_made_too(refusal: Any) -> None:
    command = find(any_commands(PLAINEST), refusal, settings=ONCE)

    with pytest.raises(i7000.EncodeError):
        dcon.encode(command, PLAINEST)


@pytest.mark.parametrize(
    "wanted",
    [
        lambda it: it.firmware is None,
        lambda it: it.legacy_sentinels,
        lambda it: it.single_ended,
        lambda it: len(set(it.type_codes)) > 1,
        lambda it: not it.type_codes,
        lambda it: it.checksum and it.modbus_data_format is i7000.ModbusDataFormat.ENGINEERING,
    ],
    ids=["newest", "legacy", "single-ended", "mixed", "unknown-types", "modbus"],
)
def test_profiles_of_every_sort_are_made(wanted: Any) -> None:
    assert wanted(find(profiles(), wanted, settings=ONCE))


def test_a_module_in_init_mode_may_answer_with_any_address() -> None:
    command = dcon.ReadConfiguration(0x00)

    def elsewhere(response: dcon.Response) -> bool:
        return isinstance(response, dcon.Configuration) and response.address > 1

    answers = responses(command, PLAINEST)
    told = find(answers, elsewhere, settings=QUICKLY)

    assert told == dcon.decode_response(dcon.encode(told, PLAINEST), command, PLAINEST)


@given(profiles(known_types=True))
def test_known_types_are_one_a_channel(profile: Profile) -> None:
    assert len(profile.type_codes) == profile.channels


@pytest.mark.parametrize("status", Status)
@pytest.mark.parametrize("data_format", DataFormat)
def test_readings_have_every_status(status: Status, data_format: DataFormat) -> None:
    strategy = (
        readings(TypeCode.K, data_format)
        if status is Status.DISABLED
        else st.one_of(
            readings(TypeCode.K, data_format), *[word_readings(TypeCode.K, each) for each in i7000.ModbusDataFormat]
        )
    )

    assert status is find(strategy, lambda reading: reading.status is status, settings=ONCE).status


@given(errors(), firmwares())
def test_errors_are_of_both_kinds(error: i7000.I7000Error, firmware: i7000.Firmware) -> None:
    assert isinstance(error, i7000.EncodeError | i7000.DecodeError)
    assert str(firmware)


# --- frames and streams -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("label", DAMAGES)
def test_every_kind_of_damage_is_done(label: str) -> None:
    frame = b"$01AB7\r"

    damage = find(damaged(frame), lambda damage: damage.label == label, settings=ONCE)

    assert Damage(label, frame, damage.wire) == damage
    assert frame != damage.wire
    assert damage.wire in DAMAGES[label](frame)


@given(st.binary(min_size=1), st.data())
def test_damage_leaves_other_bytes(frame: bytes, data: st.DataObject) -> None:
    assert data.draw(damaged(frame)).wire != frame


def test_damage_is_what_its_label_says() -> None:
    done = {label: list(damages(b"$01A\r")) for label, damages in DAMAGES.items()}

    assert b"$01a\r" in done["lower-cased"]
    assert b"$0A1\r" in done["swapped neighbours"]
    assert b"$01\r" in done["lost byte"]
    assert b"$011A\r" in done["doubled byte"]
    assert b"%01A\r" in done["flipped bit"]
    assert b"$0" in done["truncated"]
    assert b"$000\r" in done["wrong checksum"]
    assert b"$\xff01A\r" in done["foreign byte"]
    assert b"$0\r1A\r" in done["early end"]
    assert done["glued"] == [b"$01A\r$01A\r"]


@given(st.binary(), st.data())
def test_a_stream_arrives_whole_whatever_its_pieces(stream: bytes, data: st.DataObject) -> None:
    assert stream == b"".join(data.draw(chunkings(stream)))


@given(frames(), frames(checksum=True))
def test_a_frame_has_one_beginning_and_one_end(plain: bytes, sealed: bytes) -> None:
    for frame in (plain, sealed):
        assert frame.index(b"\r") == len(frame) - 1
        assert len([byte for byte in frame if byte in b"%#$~@!>?"]) == 1


@pytest.mark.parametrize("fault", [Fault.LEADING, Fault.TERMINATOR, Fault.CHARACTER, Fault.LENGTH, Fault.CHECKSUM])
def test_streams_have_noise_of_every_fault(fault: Fault) -> None:
    def has_fault(stream: Stream) -> bool:
        return any(isinstance(event, Noise) and event.fault is fault for event in stream.events)

    assert has_fault(find(streams(checksum=True), has_fault, settings=ONCE))


def test_a_near_miss_is_a_frame_with_one_other_character() -> None:
    found = set(near_misses(b">+1\r", checksum=False))

    assert {b">-1\r", b">++\r", b">+a\r"} < found
    assert {sum(left != right for left, right in zip(frame, b">+1\r", strict=True)) for frame in found} == {1}
