"""What is read of a module, and its JSON."""

import json
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import (
    CharacterFormat,
    DataFormat,
    Filter,
    Firmware,
    InvalidValueError,
    Model,
    Profile,
    Protocol,
    TypeCode,
    modbus,
)
from i7000.device import factory
from i7000.host.procedures.settings import settings_of
from i7000.host.procedures.snapshot import Snapshot, snapshot
from i7000.host.procedures.values import Choice
from i7000.settings import BaudRate, LineSettings, ModbusDataFormat, ReportSettings
from i7000.strategies.device import eeproms
from i7000.strategies.settings import snapshots
from tests.host.procedures.runner_settings import Bench

EACH = [(model, protocol) for model in Model for protocol in sorted(model.protocols)]


def take(bench: Bench, protocol: Protocol, *, profile: Profile | None = None) -> Snapshot:
    module = bench.modules.modules[0]
    return bench.run(snapshot(module.ram.address, profile or module.profile, protocol))


# --- reading ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("model", "protocol"), EACH)
def test_all_settings_of_every_model_are_read(model: Model, protocol: Protocol) -> None:
    taken = take(Bench.of(evolve(factory(model), protocol=protocol)), protocol)

    assert {setting.name for setting in settings_of(Profile(model, type_codes=()), protocol)} == set(
        dict(taken.settings)
    )
    assert taken.unread == ()


def test_a_snapshot_by_dcon_has_what_the_module_holds() -> None:
    eeprom = evolve(
        factory(Model.M_7019R, Firmware("B3.7")),
        protocol=Protocol.DCON,
        address=0x1A,
        type_codes=(TypeCode.K, TypeCode.J, *[TypeCode.V_10] * 6),
        line_settings=LineSettings(BaudRate.BAUD_19200, CharacterFormat.E81),
        report_settings=ReportSettings(DataFormat.HEX, checksum=True, filter=Filter.REJECT_50_HZ),
        name="OVEN 2",
        channel_mask=0x81,
        cjc_offset=-125,
        cjc_enabled=False,
        open_wire_detection=False,
        host_watchdog_timeout=25,
    )

    taken = take(Bench.of(eeprom), Protocol.DCON)

    expected: dict[str, Any] = {
        "address": 0x1A, "baud_rate": 19200, "character_format": "E81", "channel_mask": (0, 7), "checksum": True,
        "cjc_enabled": False, "data_format": "hex", "filter": "reject_50_hz", "host_watchdog_enabled": False,
        "host_watchdog_timeout": 2.5, "module_cjc_offset": -1.25, "name": "OVEN 2", "open_wire_detection": False,
        "protocol": "dcon", "type_code.0": "K", "type_code.1": "J",
    }  # fmt: skip
    expected |= {f"type_code.{channel}": "V_10" for channel in range(2, 8)}
    assert (taken.model, taken.firmware, taken.name, taken.protocol) == (Model.M_7019R, "B3.7", "OVEN 2", Protocol.DCON)
    assert expected == dict(taken.settings)


def test_a_snapshot_by_modbus_has_what_only_modbus_reads() -> None:
    eeprom = evolve(
        factory(Model.M_7019R),
        channel_offsets=(-128, *[127] * 7),
        channel_cjc_offsets=(-4096, *[25] * 7),
        modbus_data_format=ModbusDataFormat.ENGINEERING,
        response_delay=30,
        sampling_rate_8_hz=False,
    )

    taken = take(Bench.of(eeprom), Protocol.MODBUS_RTU)

    assert (taken.firmware, taken.name) == ("B4.5", "7019")
    assert (taken["temperature_offset.0"], taken["temperature_offset.7"]) == (-12.8, 12.7)
    assert (taken["cjc_offset.0"], taken["cjc_offset.1"]) == (-40.96, 0.25)
    assert (
        taken["modbus_data_format"],
        taken["response_delay"],
        taken["sampling_rate"],
    ) == ("engineering", 30, "10 Hz")


def test_function_46h_is_used_where_the_firmware_has_no_address_map() -> None:
    eeprom = evolve(factory(Model.M_7018, Firmware("B2.0")), channel_offsets=(-1, *[127] * 7), cjc_offset=5)

    taken = take(Bench.of(eeprom), Protocol.MODBUS_RTU)

    assert (taken["cjc_offset.0"], taken["cjc_offset.7"], taken["module_cjc_offset"]) == (-0.1, 12.7, 0.05)
    assert (taken["address"], taken["baud_rate"], taken["protocol"]) == (1, 9600, "rtu")


@pytest.mark.parametrize("protocol", Protocol)
@pytest.mark.parametrize("single_ended", [False, True])
def test_the_connecting_mode_is_read_before_the_channels(protocol: Protocol, *, single_ended: bool) -> None:
    eeprom = evolve(factory(Model.M_7017Z), protocol=protocol, single_ended=single_ended, channel_mask=0xFFFFF)
    profile = Profile(Model.M_7017Z, single_ended=not single_ended)

    taken = take(Bench.of(eeprom), protocol, profile=profile)

    assert tuple(range(20 if single_ended else 10)) == taken["channel_mask"]
    assert single_ended is ("type_code.19" in taken)
    assert taken.unread == ()


@pytest.mark.parametrize("protocol", Protocol)
def test_without_a_firmware_that_of_the_module_is_used(protocol: Protocol) -> None:
    eeprom = evolve(factory(Model.M_7018R, Firmware("B3.5")), protocol=protocol)

    taken = take(Bench.of(eeprom), protocol, profile=Profile(Model.M_7018R))

    assert taken.firmware == "B3.5"
    assert "type_code" in taken
    assert taken.unread == ()


@given(st.data(), st.sampled_from(EACH))
def test_reading_changes_nothing(data: st.DataObject, each: tuple[Model, Protocol]) -> None:
    model, protocol = each
    eeprom = evolve(data.draw(eeproms(model, protocol=protocol)), host_watchdog_enabled=False)
    eeprom = evolve(eeprom, log=factory(model).log)
    bench = Bench.of(eeprom)

    taken = take(bench, protocol)

    assert eeprom == bench.eeprom
    assert Snapshot.from_json(taken.to_json()) == taken


def test_a_firmware_that_is_none_is_kept_as_sent() -> None:
    bench = Bench.of(factory(Model.M_7018))
    odd = modbus.encode(modbus.FirmwareVersion(1, 0xFF, 0, 0))
    bench.spoil = lambda wire, to_module: [(0.0, odd if not to_module and wire[1:3] == b"\x46\x20" else wire)]

    taken = take(bench, Protocol.MODBUS_RTU, profile=Profile(Model.M_7018))

    assert taken.firmware == "ff0000"
    assert "response_delay" in taken


def test_types_that_the_firmware_of_the_module_does_not_have_are_no_obstacle() -> None:
    bench = Bench.of(evolve(factory(Model.I_7017, Firmware("B2.1"))))
    profile = Profile(Model.I_7017, type_codes=(TypeCode.MA_4_20,) * 8)

    taken = take(bench, Protocol.DCON, profile=profile)

    assert (taken.firmware, taken["type_code"], taken.unread) == ("B2.1", "V_10", ())


def test_without_an_answer_the_connecting_mode_is_that_of_the_profile() -> None:
    bench = Bench.of(evolve(factory(Model.I_7017Z), single_ended=True))
    bench.spoil = lambda wire, to_module: [] if to_module and wire.startswith(b"@") else [(0.0, wire)]

    taken = take(bench, Protocol.DCON)

    assert taken.unread == (("single_ended", "no answer, although the module answers other commands"),)
    assert taken["type_code.19"] == "V_10"


def test_an_absent_module_is_given_up_after_a_few_questions() -> None:
    bench = Bench.of(evolve(factory(Model.M_7019R), protocol=Protocol.DCON))

    taken = bench.run(snapshot(0x02, Profile(Model.M_7019R)))

    assert taken.settings == ()
    assert (taken.firmware, taken.name) == (None, None)
    assert {"no answer", "the module does not answer"} == {reason for _, reason in taken.unread}
    assert len(bench.asked) <= 6


def test_a_command_that_the_module_does_not_have_leaves_the_rest_readable() -> None:
    bench = Bench.of(evolve(factory(Model.M_7018R, Firmware("B3.5")), protocol=Protocol.DCON))
    profile = Profile(Model.M_7018R, firmware=Firmware("B4.5"))

    taken = take(bench, Protocol.DCON, profile=profile)

    unread = {f"type_code.{channel}" for channel in range(8)} | {"open_wire_detection"}
    assert dict.fromkeys(unread, "no answer, although the module answers other commands") == dict(taken.unread)
    assert taken["baud_rate"] == 9600


def test_a_refused_question_has_its_exception_as_the_reason() -> None:
    bench = Bench.of(factory(Model.M_7018R, Firmware("B3.5")))
    profile = Profile(Model.M_7018R, firmware=Firmware("B4.5"))

    taken = take(bench, Protocol.MODBUS_RTU, profile=profile)

    assert dict(taken.unread)["open_wire_detection"] == "refused: exception 02, illegal data address"


@pytest.mark.parametrize(
    ("address", "model", "protocol", "field"),
    [
        (0x100, Model.I_7017, Protocol.DCON, "address"),
        (0, Model.M_7017, Protocol.MODBUS_RTU, "address"),
        (248, Model.M_7017, Protocol.MODBUS_RTU, "address"),
        (1, Model.I_7017, Protocol.MODBUS_RTU, "protocol"),
    ],
)
def test_an_address_or_a_protocol_that_no_such_module_has_is_refused_at_once(
    address: int, model: Model, protocol: Protocol, field: str
) -> None:
    with pytest.raises(InvalidValueError) as error:
        snapshot(address, Profile(model), protocol)

    assert field == error.value.field


# --- the JSON ---------------------------------------------------------------------------------------------------------


@given(snapshots())
def test_a_snapshot_survives_its_json(taken: Snapshot) -> None:
    text = taken.to_json()

    assert taken == Snapshot.from_json(text) == Snapshot.from_json(text.encode())
    assert text == Snapshot.from_json(text).to_json()
    assert text.isascii()


@given(snapshots(), st.randoms())
def test_equal_snapshots_are_the_same_text(taken: Snapshot, chance: Any) -> None:
    settings = list(taken.settings)
    chance.shuffle(settings)
    numbers: Any = {name: int(it) if isinstance(it, float) and it == int(it) else it for name, it in settings}

    other = Snapshot(taken.model, taken.firmware, taken.name, taken.protocol, numbers, taken.unread)

    assert taken == other
    assert taken.to_json() == other.to_json()


def test_the_json_has_a_line_for_each_name() -> None:
    taken = Snapshot(
        Model.I_7018,
        "B2.9",
        "7018",
        settings={"channel_mask": (0, 1), "address": 1},
        unread={"type_code": "no answer"},
    )

    assert taken.to_json() == (
        '{\n  "schema_version": 1,\n  "model": "I-7018",\n  "firmware": "B2.9",\n  "name": "7018",\n'
        '  "protocol": "dcon",\n  "settings": {\n    "address": 1,\n    "channel_mask": [0, 1]\n  },\n'
        '  "unread": {\n    "type_code": "no answer"\n  }\n}\n'
    )


PLAIN = Snapshot(Model.I_7018, "B2.9", "7018", settings={"address": 1, "host_watchdog_timeout": 2.5})


def changed(**changes: Any) -> str:
    return json.dumps(json.loads(PLAIN.to_json()) | changes)


def test_a_snapshot_reads_both_words_for_modbus_rtu_and_writes_one() -> None:
    taken = Snapshot(Model.M_7018, protocol=Protocol.MODBUS_RTU, settings={"protocol": "rtu"})
    text = taken.to_json()

    assert text.count('"protocol": "rtu"') == 2
    assert taken == Snapshot.from_json(text) == Snapshot.from_json(text.replace('"rtu"', '"modbus_rtu"'))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "this is not a snapshot: Expecting value"),
        ("[]", "it is not an object"),
        (b"\xff", "codec can't decode"),
        ("[" * 100_000, "recursion"),
        ("1" * 10_000, "digits"),
        (PLAIN.to_json().replace("2.5", "NaN"), "NaN is not a value of JSON"),
        (PLAIN.to_json().replace('"unread": {}', '"unread": {}, "unread": {}'), "a name stands twice"),
        (PLAIN.to_json().replace('"unread"', '"read"'), "'read' is unknown; keys: schema_version"),
        (changed(schema_version=2), "schema_version cannot be 2: 1, that of this program"),
        (changed(schema_version=True), "schema_version cannot be True"),
        (changed(model="I-7020"), "model cannot be 'I-7020': I-7017"),
        (changed(model=["I-7018"]), "model cannot be ['I-7018']"),
        (changed(firmware=2.9), "firmware cannot be 2.9"),
        (changed(name=7018), "name cannot be 7018"),
        (changed(protocol="tcp"), "protocol cannot be 'tcp': dcon, rtu, modbus_rtu"),
        (changed(settings=[]), "settings cannot be []: an object of names"),
        (changed(unread=None), "unread cannot be None: an object of names"),
        (changed(unread={"filter": 1}), "unread[filter] cannot be 1: a reason in words"),
        (changed(settings={"fast_mode": True}), "I-7018 has no setting 'fast_mode'"),
        (changed(settings={"address": "1"}), "address cannot be '1': a plain value: 0..255"),
        (changed(settings={"address": 1.5}), "address cannot be 1.5: 0..255"),
        (changed(settings={"address": True}), "address cannot be True: 0..255"),
        (changed(settings={"checksum": 1}), "checksum cannot be 1: no, yes"),
        (changed(settings={"type_code": "V_150"}), "type_code cannot be 'V_150': MV_15"),
        (changed(settings={"channel_mask": [1, 0]}), "channel_mask cannot be (1, 0): a plain value"),
        (changed(settings={"channel_mask": [8]}), "channel_mask cannot be (8,): channels of 0..7"),
        (changed(settings={"channel_mask": {}}), "channel_mask cannot be {}: channels of 0..7"),
    ],
    ids=lambda it: None if isinstance(it, bytes) or len(it) > 90 else it,
)
def test_damaged_json_is_refused_with_what_is_wrong(text: str | bytes, words: str) -> None:
    with pytest.raises(InvalidValueError) as error:
        Snapshot.from_json(text)

    assert words in str(error.value)


@given(snapshots(), st.data())
def test_json_that_is_cut_anywhere_is_refused(taken: Snapshot, data: st.DataObject) -> None:
    text = taken.to_json().strip()
    end = data.draw(st.integers(0, len(text) - 1))

    with pytest.raises(InvalidValueError):
        Snapshot.from_json(text[:end])


@given(st.text() | st.binary())
def test_any_text_is_a_snapshot_or_refused(text: str | bytes) -> None:
    with pytest.raises(InvalidValueError):
        Snapshot.from_json(text)


@pytest.mark.parametrize("settings", [[("address", 1), ("address", 2)], [("address",)], ["address"], [(1, 2)]])
def test_settings_that_are_no_mapping_are_refused(settings: Any) -> None:
    with pytest.raises(InvalidValueError):
        Snapshot(Model.I_7018, settings=settings)


def test_a_setting_is_there_by_its_name() -> None:
    assert PLAIN["address"] == 1
    assert "address" in PLAIN
    assert "filter" not in PLAIN


@pytest.mark.parametrize("model", Model)
@pytest.mark.parametrize("firmware", [None, "B4.4", "B3.8", "B3.0", "B2.6", "B2.5", "B1.0", "A0.0"])
def test_a_snapshot_takes_every_value_that_a_module_of_any_firmware_can_have(
    model: Model, firmware: str | None
) -> None:
    profile = Profile(model, firmware=None if firmware is None else Firmware(firmware), type_codes=())

    for protocol in model.protocols:
        for setting in settings_of(profile, protocol):
            if isinstance(setting.values, Choice):
                for plain, _ in setting.values.options:
                    assert Snapshot(model, settings={setting.name: plain})[setting.name] == plain
