"""What differs between snapshots, and making a module as a snapshot has it."""

from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import (
    BaudRate,
    CharacterFormat,
    Firmware,
    InvalidValueError,
    LineSettings,
    Model,
    Profile,
    Protocol,
    ReportSettings,
    TypeCode,
    dcon,
    modbus,
)  # fmt: skip
from i7000.device import Eeprom, factory
from i7000.errors import ArgumentError
from i7000.host.procedures.change import Change, diff, restore, set_one
from i7000.host.procedures.restoring import Restoration, Restored, Status, Writing
from i7000.host.procedures.settings import Hazard, hazard_of, settings_of
from i7000.host.procedures.snapshot import Snapshot, snapshot
from i7000.strategies.settings import snapshots
from tests.host.procedures.eeproms import differences, two_modules
from tests.host.procedures.runner_settings import Bench

HELD = (Status.DONE, Status.ALREADY, Status.PENDING)
READS = ("Read", "SoftInit", "SetSoftInitTimeout")


def take(eeprom: Eeprom) -> Snapshot:
    bench = Bench.of(eeprom)
    return bench.run(snapshot(eeprom.address, bench.modules.modules[0].profile, eeprom.protocol))


def put(bench: Bench, wanted: Snapshot, names: Any = None, **facts: Any) -> Restoration:
    module = bench.modules.modules[0]
    protocol = module.ram.protocol
    return bench.run(restore(module.ram.address, module.profile, wanted, names, protocol=protocol, **facts))


def written(bench: Bench) -> list[Any]:
    return [it for it in bench.asked if not type(it).__name__.startswith(READS)]


def module(model: Model = Model.M_7019R, **changes: Any) -> Eeprom:
    firmware = changes.pop("firmware", None)
    return evolve(factory(model, firmware), **{"protocol": Protocol.DCON} | changes)


# --- differences ------------------------------------------------------------------------------------------------------


def test_only_what_differs_is_a_change() -> None:
    one = Snapshot(Model.I_7018, settings={"address": 1, "filter": "reject_60_hz", "type_code": "J"})
    other = Snapshot(Model.I_7018, settings={"address": 2, "filter": "reject_60_hz", "checksum": True})

    assert diff(one, other) == (
        Change("address", 1, 2, Hazard.LOSES),
        Change("checksum", None, True, Hazard.LOSES),
        Change("type_code", "J", None, Hazard.PLAIN),
    )


@given(snapshots(), snapshots())
def test_differences_are_the_same_in_both_directions(one: Snapshot, other: Snapshot) -> None:
    there, back = diff(one, other), diff(other, one)

    assert diff(one, one) == ()
    assert there == tuple(Change(it.name, it.after, it.before, it.hazard) for it in back)
    assert {it.name for it in there} == set(dict(set(one.settings) ^ set(other.settings)))


def test_what_is_no_snapshot_is_refused() -> None:
    one: Any = "snapshot"

    with pytest.raises(ArgumentError):
        diff(one, one)


# --- restoring --------------------------------------------------------------------------------------------------------


def place(name: str, protocol: Protocol) -> str:
    """What one command writes: the configuration of DCON, the watchdog of DCON, and everything else alone."""
    by_dcon = {"type_code": "%", "data_format": "%", "filter": "%", "fast_mode": "%"}
    by_dcon |= {"host_watchdog_timeout": "~3", "host_watchdog_enabled": "~3"}
    return by_dcon.get(name, name) if protocol is Protocol.DCON else name


@given(two_modules())
def test_a_module_is_as_the_snapshot_has_it_and_nothing_else_has_changed(both: tuple[Eeprom, Eeprom]) -> None:
    before, wanted = both
    taken, had = take(wanted), take(before)
    bench = Bench.of(before)

    made = put(bench, taken)

    plain = {name for name, _ in taken.settings if hazard_of(name) is Hazard.PLAIN}
    held = {it.name for it in made.results if it.status in HELD}
    changed = {it.name for it in made.results if it.status is Status.DONE}
    now = take(bench.eeprom)
    assert {name: taken[name] for name in held} == {name: now[name] for name in held}
    assert plain == held | {it.name for it in made.results if it.status is Status.SKIPPED and it.name in plain}
    assert {it.name for it in diff(had, now) if it.before is not None and it.after is not None} <= changed
    assert {f"{it.name}" for it in made.results} == set(dict(taken.settings))
    assert len({place(name, before.protocol) for name in changed}) == len(written(bench)) or "line" in str(changed)
    assert (made.address, made.line) == (before.address, None)
    assert made.profile == bench.modules.modules[0].profile


@given(two_modules(), st.data())
def test_what_is_not_named_stays_as_it_is(both: tuple[Eeprom, Eeprom], data: st.DataObject) -> None:
    before, wanted = both
    taken, had = take(wanted), take(before)
    plain = [name for name, _ in taken.settings if hazard_of(name) is Hazard.PLAIN]
    names = data.draw(st.lists(st.sampled_from(plain), unique=True, max_size=4))
    bench = Bench.of(before)

    made = put(bench, taken, names)

    changes = diff(had, take(bench.eeprom))
    changed = {it.name for it in changes if it.before is not None and it.after is not None}
    if "single_ended" in names:
        changed.discard("channel_mask")  # other channels are shown then
    assert changed <= set(names)
    assert "channel_mask" in names or bench.eeprom.channel_mask == before.channel_mask
    assert {it.name for it in made.results if it.status is not Status.SKIPPED} <= set(names)


def test_nothing_is_written_if_nothing_differs() -> None:
    bench = Bench.of(module())

    made = put(bench, take(module()))

    assert written(bench) == []
    assert {Status.ALREADY, Status.SKIPPED} == {it.status for it in made.results}


@pytest.mark.parametrize("protocol", Protocol)
def test_the_channels_of_another_connecting_mode_are_restored_too(protocol: Protocol) -> None:
    types = (TypeCode.V_5,) * 20
    wanted = module(Model.M_7017Z, protocol=protocol, single_ended=True, type_codes=types, channel_mask=0xF0F0F)
    bench = Bench.of(module(Model.M_7017Z, protocol=protocol))

    made = put(bench, take(wanted))

    assert wanted == bench.eeprom
    assert (True, types) == (made.profile.single_ended, bench.eeprom.type_codes)


def test_fields_of_one_command_are_written_together() -> None:
    report = ReportSettings.from_byte(0xA2)
    wanted = take(module(Model.M_7017R, report_settings=report, type_codes=(TypeCode.V_5,) * 8))
    before = module(
        Model.M_7017R, address=0x1A, line_settings=LineSettings(BaudRate.BAUD_19200), firmware=Firmware("B3.5")
    )
    bench = Bench.of(before)

    made = put(bench, wanted, ["data_format", "filter", "fast_mode"])

    (command,) = written(bench)
    assert before.line_settings == command.line_settings
    assert {"report_settings.data_format", "report_settings.filter", "report_settings.fast_mode"} == differences(
        before, bench.eeprom
    )
    assert [it.status for it in made.results if it.status is not Status.SKIPPED] == [Status.DONE] * 3


def test_a_name_without_a_channel_stands_for_all_channels() -> None:
    wanted = take(module(type_codes=(TypeCode.K,) * 8))
    bench = Bench.of(module())

    made = put(bench, wanted, "type_code")

    assert (TypeCode.K,) * 8 == bench.eeprom.type_codes == made.profile.type_codes


def test_changes_name_what_to_restore() -> None:
    wanted = take(module(cjc_enabled=False, name="OVEN"))
    bench = Bench.of(module())

    put(bench, wanted, [it for it in diff(take(module()), wanted) if it.name == "name"])

    assert {"name"} == differences(module(), bench.eeprom)


def test_what_the_module_does_not_have_is_skipped_with_the_reason() -> None:
    bench = Bench.of(module(Model.I_7017))
    wanted = Snapshot(
        Model.M_7018R, settings={"cjc_enabled": True, "type_code": "K", "response_delay": 1, "filter": "reject_50_hz"}
    )

    made = put(bench, wanted)

    assert made.of("cjc_enabled").reason == "I-7017 with firmware B4.5 has no setting cjc_enabled"
    assert "type_code cannot be 'K': MA_4_20, V_10" in made.of("type_code").reason
    assert Status.SKIPPED is made.of("response_delay").status
    assert {"report_settings.filter"} == differences(module(Model.I_7017), bench.eeprom)


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (["colour"], "the snapshot has no setting 'colour': "),
        ("type_code.9", "the snapshot has no setting 'type_code.9'"),
        ([1], "names must be str or Change, not 1 (int)"),
        (1, "names must be an iterable, not 1 (int)"),
    ],
)
def test_a_name_that_the_snapshot_does_not_have_is_refused_at_once(names: Any, words: str) -> None:
    with pytest.raises((InvalidValueError, ArgumentError)) as error:
        restore(1, Profile(Model.M_7019R), take(module()), names)

    assert words in str(error.value)


def test_an_unexpected_value_of_the_module_can_be_overwritten() -> None:
    """A module with mixed types that the profile does not expect reads FF."""
    bench = Bench.of(module(Model.I_7018R, firmware=Firmware("B4.2"), type_codes=(TypeCode.J, *[TypeCode.K] * 7)))
    profile = Profile(Model.I_7018R, firmware=Firmware("B4.1"))

    made = bench.run(set_one(1, profile, "type_code", "T"))

    assert Restored("type_code", Status.DONE, "T", None, "T") == made.of("type_code")


# --- what could lose the module ---------------------------------------------------------------------------------------


def test_without_its_name_nothing_is_changed_that_could_lose_the_module() -> None:
    line = LineSettings(BaudRate.BAUD_19200, CharacterFormat.E81)
    wanted = take(module(address=5, line_settings=line, report_settings=ReportSettings(checksum=True)))
    bench = Bench.of(module())

    made = put(bench, wanted)

    assert module() == bench.eeprom
    assert written(bench) == []
    assert {"it was not named"} == {it.reason for it in made.results if it.status is Status.SKIPPED}


@pytest.mark.parametrize("protocol", Protocol)
def test_an_address_is_changed_last_and_read_back_at_the_new_one(protocol: Protocol) -> None:
    bench = Bench.of(module(protocol=protocol))
    wanted = take(module(protocol=protocol, address=0x1A, cjc_enabled=False))

    made = put(bench, wanted, ["address", "cjc_enabled"])

    assert (made.address, made.of("address").status) == (0x1A, Status.DONE)
    assert [it.name for it in made.results if it.status is Status.DONE] == ["cjc_enabled", "address"]
    assert module(protocol=protocol, address=0x1A, cjc_enabled=False) == bench.eeprom


@pytest.mark.parametrize("protocol", Protocol)
def test_an_address_is_changed_without_an_address_map_too(protocol: Protocol) -> None:
    before = module(Model.M_7018, firmware=Firmware("B2.0"), protocol=protocol)
    bench = Bench.of(before)

    made = bench.run(set_one(1, Profile(Model.M_7018), "address", "0x1A", protocol=protocol))

    assert (made.address, made.of("address").status) == (0x1A, Status.DONE)
    assert evolve(before, address=0x1A) == bench.eeprom


@pytest.mark.parametrize("protocol", Protocol)
def test_the_address_of_another_module_is_not_taken(protocol: Protocol) -> None:
    bench = Bench.of(module(protocol=protocol), module(protocol=protocol, address=2))

    made = bench.run(set_one(1, Profile(Model.M_7019R), "address", 2, protocol=protocol))

    assert (
        made.of("address").status,
        made.of("address").reason,
    ) == (Status.SKIPPED, "another module answers at address 02")
    assert module(protocol=protocol) == bench.eeprom
    assert written(bench) == []


@pytest.mark.parametrize("protocol", Protocol)
@pytest.mark.parametrize(
    "other",
    [
        module(Model.I_7018, address=2),
        module(Model.I_7018, address=2, report_settings=ReportSettings(checksum=True)),
        module(protocol=Protocol.MODBUS_RTU, address=2),
    ],
    ids=["DCON", "DCON with a checksum", "Modbus RTU"],
)
def test_the_address_of_a_module_that_is_spoken_to_differently_is_not_taken(protocol: Protocol, other: Eeprom) -> None:
    bench = Bench.of(module(protocol=protocol), other)

    made = bench.run(set_one(1, Profile(Model.M_7019R), "address", 2, protocol=protocol))

    assert made.of("address").status is Status.SKIPPED
    assert module(protocol=protocol) == bench.eeprom
    assert written(bench) == []


def test_an_address_that_modbus_does_not_have_is_looked_at_by_dcon_only() -> None:
    bench = Bench.of(module())

    made = bench.run(set_one(1, Profile(Model.M_7019R), "address", 0xFF))

    assert made.address == 0xFF
    assert not any(isinstance(it, modbus.Request) for it in bench.asked)


def test_an_address_in_init_mode_is_pending() -> None:
    bench = Bench.of(module(Model.I_7018), init_switch=True)

    made = bench.run(set_one(0, Profile(Model.I_7018), "address", 7))

    assert (made.address, made.of("address").status, bench.eeprom.address) == (0, Status.PENDING, 7)


@pytest.mark.parametrize(
    ("name", "value"),
    [("baud_rate", 19200), ("character_format", "E81"), ("checksum", "on"), ("protocol", "modbus_rtu")],
)
def test_without_the_init_switch_line_settings_are_refused_by_dcon(name: str, value: object) -> None:
    bench = Bench.of(module(Model.M_7018))

    made = bench.run(set_one(1, Profile(Model.M_7018), name, value))

    assert (made.of(name).status, made.of(name).reason) == (Status.NEEDS_INIT, "refused")
    assert made.of(name).before == made.of(name).after
    assert module(Model.M_7018) == bench.eeprom


@pytest.mark.parametrize("init_switch", [False, True])
def test_a_model_with_soft_init_changes_its_line_at_once(*, init_switch: bool) -> None:
    before = module(address=0 if init_switch else 1)
    line = LineSettings(BaudRate.BAUD_115200, CharacterFormat.O81)
    wanted = module(line_settings=line, report_settings=ReportSettings(checksum=True))
    bench = Bench.of(before, init_switch=init_switch)

    made = put(bench, take(wanted), ["baud_rate", "character_format", "checksum"])

    status = {it.status for it in made.results if it.status is not Status.SKIPPED}
    assert {Status.PENDING if init_switch else Status.DONE} == status
    assert (None if init_switch else line, not init_switch) == (made.line, made.profile.checksum)
    assert evolve(wanted, address=before.address) == bench.eeprom
    assert (LineSettings() if init_switch else line) == bench.line
    assert bench.modules.modules[0].ram.soft_init_timeout == 0


def test_after_a_change_of_the_line_the_module_is_reached_there() -> None:
    bench = Bench.of(module(line_settings=LineSettings(BaudRate.BAUD_1200)))
    wanted = take(module(address=3, line_settings=LineSettings(BaudRate.BAUD_57600)))

    made = put(bench, wanted, ["address", "baud_rate"], line=LineSettings(BaudRate.BAUD_1200))

    assert (3, LineSettings(BaudRate.BAUD_57600)) == (made.address, made.line)
    assert [it.status for it in made.results if it.status is not Status.SKIPPED] == [Status.DONE] * 2
    assert len(bench.run(snapshot(made.address, made.profile)).unread) == 0


@pytest.mark.parametrize("model", [Model.M_7019R, Model.M_7017])
@pytest.mark.parametrize("firmware", [None, Firmware("B2.6")])
def test_by_modbus_line_settings_and_protocol_are_pending(model: Model, firmware: Firmware | None) -> None:
    before = module(model, firmware=firmware, protocol=Protocol.MODBUS_RTU)
    line = LineSettings(BaudRate.BAUD_1200)
    wanted = Snapshot(model, settings={"baud_rate": 1200, "protocol": "dcon"})
    bench = Bench.of(before)

    made = put(bench, wanted, ["baud_rate", "protocol"])

    assert [it.status for it in made.results] == [Status.PENDING] * 2
    assert evolve(before, line_settings=line, protocol=Protocol.DCON) == bench.eeprom
    assert LineSettings() == bench.line


# --- one setting ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "value", "changes"),
    [
        ("type_code.3", "0F", {"type_codes": (*[TypeCode.V_10] * 3, TypeCode.K, *[TypeCode.V_10] * 4)}),
        ("channel_mask", "0-2, 7", {"channel_mask": 0x87}),
        ("module_cjc_offset", "-1.25 degC", {"cjc_offset": -125}),
        ("host_watchdog_timeout", 2.5, {"host_watchdog_timeout": 25}),
        ("cjc_enabled", "off", {"cjc_enabled": False}),
        ("name", "OVEN 2", {"name": "OVEN 2"}),
    ],
)
def test_a_value_is_given_as_people_write_it(name: str, value: object, changes: dict[str, Any]) -> None:
    bench = Bench.of(module())

    made = bench.run(set_one(1, Profile(Model.M_7019R), name, value))

    assert Status.DONE is made.of(name).status
    assert module(**changes) == bench.eeprom
    assert [Writing((name,)), made.of(name)] == bench.told


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("type_code.3", "V_150", "type_code.3 cannot be 'V_150': MV_15, MV_50"),
        ("host_watchdog_timeout", 30, "host_watchdog_timeout cannot be 30: 0..25.5 s in steps of 0.1"),
        ("baud_rate", "9601", "baud_rate cannot be '9601': 1200, 2400, 4800, 9600"),
        ("checksum", "maybe", "checksum cannot be 'maybe': no, yes"),
        ("name", "0506", "name cannot be '0506': 1 to 6 characters"),
    ],
)
def test_a_value_that_the_module_cannot_have_is_refused_at_once(name: str, value: object, words: str) -> None:
    with pytest.raises(InvalidValueError) as error:
        set_one(1, Profile(Model.M_7019R), name, value)

    assert words in str(error.value)


def test_a_watchdog_that_times_out_at_once_is_not_verified() -> None:
    bench = Bench.of(module(Model.I_7018, host_watchdog_timeout=1))
    bench.spoil = lambda wire, to_module: [(0.0 if to_module else 0.12, wire)]

    made = bench.run(set_one(1, Profile(Model.I_7018), "host_watchdog_enabled", "on"))

    expected = Restored(
        "host_watchdog_enabled", Status.NOT_VERIFIED, True, False, False, "the module acknowledged the command"
    )
    assert expected == made.of("host_watchdog_enabled")


# --- a line that breaks -----------------------------------------------------------------------------------------------


def breaking(at: bytes, *, answered: bool) -> Any:
    """Have the line break at a command: nothing passes after it; before its answer, or after it."""
    broken = [False]

    def spoil(wire: bytes, to_module: bool) -> list[tuple[float, bytes]]:  # noqa: FBT001 - the direction
        passes = not broken[0] or (answered and wire == b"!01\r")
        broken[0] |= to_module and wire.startswith(at)
        return [(0.0, wire)] if passes else []

    return spoil


@pytest.mark.parametrize(
    ("answered", "reason"), [(False, "no answer to the command"), (True, "no answer when it was read back")]
)
def test_a_setting_is_in_doubt_if_the_line_breaks_before_it_is_read_back(*, answered: bool, reason: str) -> None:
    bench = Bench.of(module(), spoil=breaking(b"~01C0", answered=answered))
    wanted = Snapshot(Model.M_7019R, settings={"cjc_enabled": False, "open_wire_detection": False, "address": 9})

    made = put(bench, wanted, ["cjc_enabled", "open_wire_detection", "address"])

    assert Restored("cjc_enabled", Status.IN_DOUBT, False, True, None, reason) == made.of("cjc_enabled")
    for name in ("open_wire_detection", "address"):
        assert (made.of(name).status, made.of(name).reason) == (Status.UNREAD, "the module does not answer")
    assert module(cjc_enabled=False) == bench.eeprom


def test_a_module_that_is_lost_by_a_change_of_its_line_is_in_doubt_at_the_old_one() -> None:
    bench = Bench.of(module(), spoil=second(breaking(b"%0101", answered=False), b"%0101"))
    wanted = Snapshot(Model.M_7019R, settings={"baud_rate": 38400, "checksum": True})

    made = put(bench, wanted, ["baud_rate", "checksum"])

    assert {Status.IN_DOUBT} == {it.status for it in made.results}
    assert (1, None, False, LineSettings()) == (made.address, made.line, made.profile.checksum, bench.line)
    assert BaudRate.BAUD_38400 is bench.eeprom.line_settings.baud_rate


def second(spoil: Any, at: bytes) -> Any:
    """Have faults begin with the second command of a kind: the first is refused without soft INIT."""
    seen = [0]

    def later(wire: bytes, to_module: bool) -> Any:  # noqa: FBT001 - the direction
        seen[0] += to_module and wire.startswith(at)
        return spoil(wire, to_module) if seen[0] > 1 else [(0.0, wire)]

    return later


# --- refusals ---------------------------------------------------------------------------------------------------------


def answering(bench: Bench, answer: dict[type, Any], profile: Profile) -> None:
    """Have commands answered otherwise, as firmware may that differs from the manual."""

    def spoil(wire: bytes, to_module: bool) -> list[tuple[float, bytes]]:  # noqa: FBT001 - the direction
        codec: Any = dcon if wire.endswith(b"\r") else modbus
        if to_module:
            bench_last[0] = (
                codec.decode_command(wire, profile) if codec is dcon else codec.decode_request(wire, profile)
            )
            return [] if answer.get(type(bench_last[0])) == "ignored" else [(0.0, wire)]
        other = answer.get(type(bench_last[0]))
        return [(0.0, wire if other is None else codec.encode(other, profile))]

    bench_last: list[Any] = [None]
    bench.spoil = spoil


def test_a_refused_setting_says_so() -> None:
    bench = Bench.of(module())
    profile = Profile(Model.M_7019R)
    answering(bench, {dcon.SetCjcEnabled: "ignored"}, profile)

    made = bench.run(set_one(1, profile, "cjc_enabled", "off"))

    expected = Restored("cjc_enabled", Status.NOT_VERIFIED, False, True, True, "no answer to the command")
    assert expected == made.of("cjc_enabled")


def test_an_exception_is_a_refusal() -> None:
    profile = Profile(Model.M_7018, firmware=Firmware("B3.5"))
    bench = Bench.of(module(Model.M_7018, firmware=Firmware("B2.0"), protocol=Protocol.MODBUS_RTU))
    wanted = Snapshot(Model.M_7018, settings={"response_delay": 5})

    made = bench.run(restore(1, profile, wanted, protocol=Protocol.MODBUS_RTU))

    expected = Restored("response_delay", Status.UNREAD, 5, reason="refused: exception 01, illegal function")
    assert expected == made.of("response_delay")


def test_a_result_that_is_not_0_is_a_refusal() -> None:
    profile = Profile(Model.M_7017mC_16)
    bench = Bench.of(module(Model.M_7017mC_16, protocol=Protocol.MODBUS_RTU, channel_mask=1))
    other = modbus.ChannelMaskResult(1, 0xFF)
    answering(bench, {modbus.SetChannelMask: other, modbus.ReadChannelMask: modbus.ChannelMask(1, 0x01)}, profile)

    made = bench.run(set_one(1, profile, "channel_mask", "all", protocol=Protocol.MODBUS_RTU))

    assert (made.of("channel_mask").status, made.of("channel_mask").reason) == (Status.REFUSED, "refused: result FF")


def test_reserved_bits_that_cannot_be_written_back_are_not_lost() -> None:
    profile = Profile(Model.I_7018)
    bench = Bench.of(module(Model.I_7018))
    odd = dcon.Configuration(1, TypeCode.V_2_5, LineSettings(), ReportSettings.from_byte(0x04))
    answering(bench, {dcon.ReadConfiguration: odd}, profile)

    made = bench.run(set_one(1, profile, "filter", "reject_50_hz"))

    assert (
        made.of("filter").status,
        made.of("filter").reason,
    ) == (Status.SKIPPED, "reserved cannot be 1: 0, manual 1.11")
    assert written(bench) == []


def test_every_setting_has_a_result_by_its_name() -> None:
    made = put(Bench.of(module()), take(module()), ["filter"])

    assert {it.name for it in settings_of(Profile(Model.M_7019R), Protocol.DCON)} == {it.name for it in made.results}
    with pytest.raises(InvalidValueError, match="there is no result for 'colour'"):
        made.of("colour")
