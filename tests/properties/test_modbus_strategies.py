"""That the strategies for Modbus make what they say."""

from typing import Any

import pytest
from hypothesis import Phase, find, given, settings
from hypothesis import strategies as st

import i7000
from i7000 import Fault, Firmware, Model, Noise, Profile, Protocol, TypeCode, modbus
from i7000.modbus import Access, Kind, Register, RegisterMap, Side
from i7000.strategies.modbus import (
    DAMAGES,
    Damage,
    Stream,
    any_requests,
    damaged,
    exception_responses,
    exchanges,
    frames,
    messages,
    plans,
    profiles,
    profiles_with,
    register_items,
    register_maps,
    register_values,
    registers,
    requests,
    responses,
    streams,
)

MODELS = [model for model in Model if Protocol.MODBUS_RTU in model.protocols]
PLAINEST = Profile(Model.M_7017)
PLAINEST_7019 = Profile(Model.M_7019R)
LOGGER = Profile(Model.M_7017mC_16)
QUICKLY = settings(max_examples=200, database=None, phases=(Phase.generate, Phase.shrink))
ONCE = settings(QUICKLY, max_examples=10_000, phases=(Phase.generate,))
"""For what has to be there at all; the smallest takes longer to find."""


def smallest(strategy: st.SearchStrategy[Any]) -> Any:
    return find(strategy, lambda _: True, settings=QUICKLY)


# --- the smallest example is the plainest -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("strategy", "plainest"),
    [
        (profiles(), PLAINEST),
        (profiles(known_types=True), PLAINEST),
        (profiles_with(modbus.ReadCjcUpdate), PLAINEST_7019),
        (requests(PLAINEST), modbus.ReadModuleName(0x01)),
        (requests(PLAINEST, modbus.ReadInputRegisters), modbus.ReadInputRegisters(0x01, 0, 1)),
        (requests(PLAINEST, modbus.WriteMultipleCoils), modbus.WriteMultipleCoils(0x01, 0, (False,))),
        (requests(PLAINEST, modbus.SetTypeCode), modbus.SetTypeCode(0x01, 0, TypeCode.V_10)),
        (requests(PLAINEST_7019, modbus.SetCjcOffset), modbus.SetCjcOffset(0x01, 0, 0)),
        (any_requests(PLAINEST), modbus.ReadModuleName(0x01)),
        (messages(modbus.Request), modbus.ReadModuleName(0x01)),
        (messages(modbus.SettingResult), modbus.CjcUpdateResult(0x01, 0)),
        (exception_responses(modbus.ReadCoils(0x07, 0, 1)), modbus.ExceptionResponse(0x07, 1, 1)),
        (exchanges().map(lambda it: (it.profile, it.request)), (PLAINEST, modbus.ReadModuleName(0x01))),
        (frames(), modbus.encode(modbus.ReadModuleName(0x01))),
        (streams(), Stream(b"", Side.REQUESTS, None, ())),
        (register_maps(), RegisterMap(PLAINEST)),
        (registers(), RegisterMap(PLAINEST).find("analog_input")),
        (plans().map(lambda it: it.requests), (modbus.ReadInputRegisters(0x01, 0, 8),)),
    ],
)  # fmt: skip
def test_the_smallest_example_is_the_plainest(strategy: st.SearchStrategy[Any], plainest: object) -> None:
    assert plainest == smallest(strategy)


# --- what is made is what was asked for -------------------------------------------------------------------------------


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.value)
@settings(max_examples=20)
@given(data=st.data())
def test_requests_and_responses_are_those_of_the_module(model: Model, data: st.DataObject) -> None:
    profile = Profile(model)
    request = data.draw(requests(profile))
    wires = [modbus.encode(request, profile)]
    if modbus.is_answered(request):
        wires.append(modbus.encode(data.draw(responses(request, profile)), profile))

    assert all(modbus.SHORTEST_FRAME < len(wire) <= modbus.LONGEST_FRAME for wire in wires)


@pytest.mark.parametrize("kind", modbus.REQUESTS, ids=lambda kind: kind.__name__)
@settings(max_examples=10)
@given(data=st.data())
def test_a_profile_for_a_request_has_it(kind: type[modbus.Request[Any]], data: st.DataObject) -> None:
    profile = data.draw(profiles_with(kind))

    assert kind.availability not in profile.refused
    assert isinstance(data.draw(requests(profile, kind)), kind)


@given(profiles())
def test_every_profile_is_of_a_module_that_speaks_modbus(profile: Profile) -> None:
    assert Protocol.MODBUS_RTU in profile.model.protocols


@pytest.mark.parametrize(
    ("model", "kind", "at_limit"),
    [
        (Model.M_7019Z, modbus.ReadTypeCode, lambda it: it.channel == 9),
        (Model.M_7019Z, modbus.SetChannelMask, lambda it: it.mask == 0x3FF),
        (Model.M_7019R, modbus.SetCjcOffset, lambda it: it.channel > 0x84 and it.offset > 0xF0),
        (Model.M_7019R, modbus.SetCjcOffset, lambda it: it.offset > 0x0F00),
        (Model.M_7019R, modbus.SetCjcOffset, lambda it: it.offset < -0x0F00),
        (Model.M_7019R, modbus.WriteMultipleRegisters, lambda it: len(it.values) == 11),
        (Model.M_7017R, modbus.SetMiscellaneousSettings, lambda it: it.settings == 0xA0),
        (Model.M_7017, modbus.SetModuleAddress, lambda it: it.new_address == 247),
        (Model.M_7017, modbus.SetCommunicationSettings, lambda it: it.line_settings.byte == 0xCA),
        (Model.M_7017, modbus.ReadCoils, lambda it: it.count == 2000),
        (Model.M_7017, modbus.ReadInputRegisters, lambda it: it.start == 0xFFFF),
        (Model.M_7017, modbus.WriteMultipleRegisters, lambda it: len(it.values) == 123),
        (Model.M_7017, modbus.WriteSingleCoil, lambda it: it.address == modbus.BROADCAST),
    ],
)
def test_all_that_a_module_takes_is_made(model: Model, kind: type[modbus.Request[Any]], at_limit: Any) -> None:
    assert at_limit(find(requests(Profile(model), kind), at_limit, settings=ONCE))


@pytest.mark.parametrize(
    "refusal",
    [
        lambda request: request.availability in PLAINEST.refused,
        lambda request: getattr(request, "channel", 0) >= PLAINEST.channels,
        lambda request: isinstance(request, modbus.SetMiscellaneousSettings) and request.settings & 1,
    ],
    ids=["request", "channel", "reserved-bits"],
)
def test_what_a_module_refuses_is_made_too(refusal: Any) -> None:
    request = find(any_requests(PLAINEST), refusal, settings=ONCE)

    with pytest.raises(i7000.EncodeError):
        modbus.encode(request, PLAINEST)


# --- registers --------------------------------------------------------------------------------------------------------


@given(st.data())
def test_rows_are_such_as_were_asked_for(data: st.DataObject) -> None:
    profile = data.draw(profiles())

    assert data.draw(registers(profile)) in RegisterMap(profile).rows
    assert data.draw(registers(profile, readable=True)).access is not Access.WRITE
    assert data.draw(registers(LOGGER, writable=True)).access is not Access.READ


@pytest.mark.parametrize("name", ["firmware_version", "log_command", "big_endian"])
def test_rows_of_every_sort_are_made(name: str) -> None:
    assert find(registers(LOGGER), lambda row: row.name == name, settings=ONCE).name == name


@given(register_maps(), st.data())
def test_what_a_row_holds_is_one_value_or_one_for_each_channel(found: RegisterMap, data: st.DataObject) -> None:
    row = data.draw(st.sampled_from(found.rows))
    value = data.draw(register_values(row, found.profile))

    if row.kind is Kind.RECORD:
        assert len(value) == 6
    elif row.count > 1 and row.kind is not Kind.UINT32:
        assert len(value) == min(row.count, found.profile.channels)
    else:
        assert not isinstance(value, tuple)


def test_a_log_holds_six_records_of_sixteen_channels() -> None:
    row = RegisterMap(LOGGER).find("log_records")

    assert [len(record.readings) for record in smallest(register_values(row, LOGGER))] == [16] * 6


@pytest.mark.parametrize(
    ("profile", "name", "value"),
    [
        (PLAINEST, "host_watchdog_timeout", 25.5),
        (PLAINEST, "module_name", "7017"),
        (PLAINEST_7019, "module_cjc_offset", -40.96),
        (LOGGER, "rtc_epoch", 0xFFFFFFFF),
    ],
)
def test_values_go_to_the_ends_of_their_range(profile: Profile, name: str, value: object) -> None:
    row = RegisterMap(profile).find(name)

    assert value == find(register_values(row, profile), lambda it: it == value, settings=ONCE)


def test_the_map_of_old_firmware_has_few_rows_and_none_to_write() -> None:
    old = Profile(Model.M_7018, firmware=Firmware("B1.0"))

    assert registers(old, writable=True).is_empty
    assert registers(Profile(Model.I_7018)).is_empty

    assert [row.name for row in RegisterMap(old)] == ["analog_input", "cjc_temperature"]
    assert isinstance(smallest(registers(old)), Register)


# --- frames and streams -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("label", DAMAGES)
def test_every_kind_of_damage_is_done(label: str) -> None:
    frame = bytes.fromhex("010400000008f1cc")

    damage = find(damaged(frame), lambda damage: damage.label == label, settings=ONCE)

    assert Damage(label, frame, damage.wire) == damage
    assert frame != damage.wire
    assert damage.wire in DAMAGES[label](frame)
    assert label.endswith("right CRC") == (modbus.crc16(damage.wire) == 0)


@given(st.binary(min_size=1), st.data())
def test_damage_leaves_other_bytes(frame: bytes, data: st.DataObject) -> None:
    assert data.draw(damaged(frame)).wire != frame


def test_damage_is_what_its_label_says() -> None:
    done = {label: list(damages(b"\x01\x83\x02\xc0\xf1")) for label, damages in DAMAGES.items()}

    assert done["glued"] == [b"\x01\x83\x02\xc0\xf1\x01\x83\x02\xc0\xf1"]
    assert done["CRC high byte first"] == [b"\x01\x83\x02\xf1\xc0"]
    assert b"\x01\x83\x02\x00\xf1" in done["wrong CRC"]
    assert b"\x01\x83\x02\xc0\x00" in done["wrong CRC"]
    assert modbus.seal(b"\x01\x83") in done["truncated, right CRC"]
    assert modbus.seal(b"\x01\x83\x03") in done["flipped bit, right CRC"]


@pytest.mark.parametrize("fault", [Fault.ADDRESS, Fault.FUNCTION, Fault.SUB_FUNCTION, Fault.CRC, Fault.LENGTH])
def test_streams_have_noise_of_every_fault(fault: Fault) -> None:
    def has_fault(stream: Stream) -> bool:
        return any(isinstance(event, Noise) and event.fault is fault for event in stream.events)

    assert has_fault(find(streams(), has_fault, settings=ONCE))


@pytest.mark.parametrize(
    ("side", "wanted"),
    [
        (Side.REQUESTS, lambda frame: frame[0] == modbus.BROADCAST),
        (Side.RESPONSES, lambda frame: frame[1] & 0x80),
        (Side.BOTH, lambda frame: frame[1] & 0x80),
    ],
)
def test_frames_are_those_of_the_side(side: Side, wanted: Any) -> None:
    assert wanted(find(frames(side), wanted, settings=ONCE))


def test_items_of_a_row_are_all_that_a_module_can_send() -> None:
    row = RegisterMap(PLAINEST).find("analog_input")
    items = register_items(row, PLAINEST)

    assert len(find(items, lambda found: found[0] == 0xFFFF, settings=ONCE)) == PLAINEST.channels
