"""Identification: of every model with every firmware that differs, by both protocols, and over lines with faults."""

from collections.abc import Iterator
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import (
    ArgumentError,
    BaudRate,
    EncodeError,
    Fault,
    Firmware,
    LineSettings,
    Model,
    Protocol,
    ReportSettings,
    TypeCode,
    dcon,
    modbus,
)
from i7000.availability import Availability
from i7000.device import Eeprom, factory, power_on
from i7000.host import Policy, Rejected, TimedOut
from i7000.host.procedures import Candidate, Identified, Result, identify
from i7000.simulator.faults import Faults
from i7000.strategies.device import eeproms
from tests.host.procedures.lines import faults
from tests.host.procedures.runner import Runner
from tests.host.procedures.scripted import commands, refused, run, unanswered

QUICK = Policy(retries=0, turnaround=0.1, grace=0.1)
PATIENT = Policy(retries=2, turnaround=0.2, grace=0.4)


def firmwares(model: Model) -> Iterator[Firmware | None]:
    """Yield the newest firmware, and those on both sides of every change of a model."""
    gates = [availability.gates.get(model) for availability in Availability]
    changes = {*gates, *model.type_codes.values(), model.filter_from, model.character_formats_from, Firmware("B1.5")}
    yield None
    for first in sorted(it for it in changes if it is not None):
        yield first
        letter, minor = str(first).split(".")
        yield Firmware(f"{letter}.{int(minor) - 1}" if minor != "0" else f"{letter[0]}{int(letter[1]) - 1}.9")


MODULES = [
    evolve(factory(model, firmware), protocol=protocol)
    for model in Model
    for firmware in dict.fromkeys(firmwares(model))
    for protocol in sorted(model.protocols)
]


def truths(eeprom: Eeprom) -> dict[str, Any]:
    """Return what is true of a module, by the names of `Known`."""
    state = power_on(eeprom, now=0.0)
    profile = state.profile
    return {
        "firmware": eeprom.firmware,
        "data_format": profile.data_format,
        "checksum": profile.checksum,
        "single_ended": profile.single_ended,
        "modbus_data_format": profile.modbus_data_format,
        "types": profile.type_codes,
    }


def lies(found: Identified, eeprom: Eeprom) -> list[str]:
    """Return what an identity says that is not so."""
    wrong = [
        name
        for name, value in truths(eeprom).items()
        if getattr(found.known, name) not in (None, value) and name != "types"
    ]
    types = truths(eeprom)["types"]
    learned = found.known.types or ()
    learned *= len(types) if len(learned) == 1 else 1
    if any(code not in (None, true) for code, true in zip(learned, types, strict=False)):
        wrong.append("types")
    if found.candidates and eeprom.model not in {candidate.model for candidate in found.candidates}:
        wrong.append("candidates")
    return wrong


def silently_unknown(found: Identified) -> set[str]:
    """Return what is neither known nor said to be unknown."""
    known = {"model", "firmware", "types"}
    known |= {"data_format", "checksum"} if found.protocol is Protocol.MODBUS_RTU else {"checksum", "data_format"}
    if found.protocol is Protocol.MODBUS_RTU:
        known.add("modbus_data_format")
    missing = {name for name in known if getattr(found.known, name) is None}
    return missing - {it.name for it in found.unknown}


READING = {
    dcon.ReadChannelMask,
    dcon.ReadChannelTypeCode,
    dcon.ReadCjcEnabled,
    dcon.ReadConfiguration,
    dcon.ReadConnectingMode,
    dcon.ReadDiagnostics,
    dcon.ReadFirmwareVersion,
    dcon.ReadModuleName,
    dcon.ReadProtocol,
    modbus.ReadCoils,
    modbus.ReadFirmwareVersion,
    modbus.ReadHoldingRegisters,
    modbus.ReadInputRegisters,
    modbus.ReadModuleName,
    modbus.ReadTypeCode,
}
"""The requests that change nothing in a module."""


@pytest.mark.parametrize("eeprom", MODULES, ids=lambda it: f"{it.model.value}-{it.firmware}-{it.protocol.name.lower()}")
def test_every_model_with_every_firmware_is_identified_and_left_as_it_was(eeprom: Eeprom) -> None:
    runner = Runner.on(eeprom)
    (before,) = runner.modules

    found = runner.run(identify(0x01, policy=QUICK))

    true, profile = before.profile, found.profile
    assert profile is not None
    assert (eeprom.protocol, eeprom.firmware) == (found.protocol, found.known.firmware)
    assert eeprom.model in {candidate.model for candidate in found.candidates}
    assert lies(found, eeprom) == []
    assert set() == silently_unknown(found)
    assert (true.channels, true.type_codes) == (profile.channels, profile.type_codes)
    (after,) = runner.modules
    assert (before.eeprom, before.ram) == (after.eeprom, after.ram)
    assert {type(step.command) for step in runner.asked} <= READING


LONGEST_SILENCE = 0.45
"""The seconds of one request that a module leaves unanswered, and of the silence before the next."""
LONGEST_ANSWER = 0.04
"""The seconds of one request with its answer."""
MAYBE_SILENT = (
    dcon.ReadProtocol,
    dcon.ReadConnectingMode,
    dcon.ReadDiagnostics,
    dcon.ReadCjcEnabled,
    dcon.ReadChannelMask,
    dcon.ReadChannelTypeCode,
)
"""The commands that not all models answer."""


@pytest.mark.parametrize(
    "model", [it for it in Model if Protocol.MODBUS_RTU not in it.protocols], ids=lambda it: it.value
)
@pytest.mark.parametrize("name", ["", "TANK 1"])
def test_a_silent_i_module_is_waited_for_once_for_each_command_that_it_may_not_have(model: Model, name: str) -> None:
    eeprom = factory(model)
    runner = Runner.on(evolve(eeprom, name=name or eeprom.name))

    runner.run(identify(0x01))

    probes = [step.command for step in runner.asked if isinstance(step.command, MAYBE_SILENT)]
    assert runner.now <= LONGEST_SILENCE * len(probes) + LONGEST_ANSWER * len(runner.asked)


def test_a_module_that_answers_only_after_a_long_time_is_waited_for_as_long_by_every_request() -> None:
    patient = Policy(retries=1, turnaround=1.5, grace=0.5)
    eeprom = evolve(factory(Model.M_7017), protocol=Protocol.DCON)
    runner = Runner.on(eeprom, faults=Faults(late=1.0, late_by=0.9), policy=patient)

    found = runner.run(identify(0x01))

    assert models(found) == ["M-7017"]
    assert {step.policy for step in runner.asked if isinstance(step.command, MAYBE_SILENT)} == {None}


NAMES = st.sampled_from(("", "", "TANK 1", "x", "7018-1"))
"""Names that users give; of a factory name it is taken for granted that nobody gave it to another model."""


def modules(**settings: Any) -> st.SearchStrategy[Eeprom]:
    """Draw modules of any model and settings that Modbus can address too."""
    addressed = eeproms().filter(lambda it: 1 <= it.address <= 247)
    return st.builds(lambda it, name: evolve(it, name=name or it.model.factory_name, **settings), addressed, NAMES)


@given(modules(), st.booleans())
def test_any_settings_are_identified_on_a_line_without_faults(eeprom: Eeprom, echo: bool) -> None:  # noqa: FBT001
    runner = Runner.on(eeprom, line=eeprom.line_settings, faults=Faults(echo=echo))

    found = runner.run(identify(eeprom.address, policy=QUICK))

    assert eeprom.protocol is found.protocol
    assert lies(found, eeprom) == []
    assert set() == silently_unknown(found)


MOST_REQUESTS = 8 + 3 + 2 * 12 + 1 + 20 + 5
"""The most requests of an identity: contact, name and version, probes, mode, types, and what is left."""


@given(modules(), faults(), st.integers(0, 2**32))
def test_what_is_identified_on_a_bad_line_is_so_or_said_to_be_unknown(eeprom: Eeprom, bad: Faults, seed: int) -> None:
    eeprom = evolve(eeprom, report_settings=evolve(eeprom.report_settings, checksum=True))
    runner = Runner.on(eeprom, line=eeprom.line_settings, policy=PATIENT, faults=bad, seed=seed)

    found = runner.run(identify(eeprom.address, checksum=True))

    assert len(runner.asked) <= MOST_REQUESTS
    assert lies(found, eeprom) == []
    assert found.protocol is not None or "protocol" in {it.name for it in found.unknown}
    assert found.protocol is None or silently_unknown(found) == set()


# --- hand-written outcomes --------------------------------------------------------------------------------------------

LINE = LineSettings()


PROBES = (
    dcon.ReadProtocol,
    dcon.ReadChannelTypeCode,
    dcon.ReadDiagnostics,
    dcon.ReadCjcEnabled,
    dcon.ReadConnectingMode,
)
"""The commands that not all models have."""
READS = (modbus.ReadCoils, modbus.ReadHoldingRegisters, modbus.ReadInputRegisters)


def by_dcon(**answers: Any) -> dict[type, Any]:
    """Return the outcomes of a DCON module: an I-7019R whose settings are given."""
    said: dict[str, Any] = {"name": "7019R", "version": "B4.5", "code": 0x08, "report": ReportSettings()} | answers
    return {
        dcon.ReadConfiguration: lambda it: dcon.Configuration(it.address, said["code"], LINE, said["report"]),
        dcon.ReadModuleName: lambda it: dcon.ModuleName(it.address, said["name"]),
        dcon.ReadFirmwareVersion: lambda it: dcon.FirmwareVersion(it.address, said["version"]),
        dcon.ReadChannelTypeCode: lambda it: dcon.ChannelTypeCode(it.address, it.channel, 0x0F),
        dcon.ReadProtocol: unanswered,
    }


def by_modbus(**answers: Any) -> dict[type, Any]:
    """Return the outcomes of a Modbus module: an M-7019 whose identity is given, and that has no map."""
    said: dict[str, Any] = {"name": "00701900", "version": (0x0B, 2, 0), "code": 0x0F} | answers
    return {
        modbus.ReadModuleName: lambda it: modbus.ModuleName(it.address, bytes.fromhex(said["name"])),
        modbus.ReadFirmwareVersion: lambda it: modbus.FirmwareVersion(it.address, *said["version"]),
        modbus.ReadTypeCode: lambda it: modbus.TypeCodeSetting(it.address, said["code"]),
        modbus.ReadCoils: refused,
        modbus.ReadHoldingRegisters: refused,
        modbus.ReadInputRegisters: refused,
    }


def models(found: Identified) -> list[str]:
    return [candidate.model.value for candidate in found.candidates]


def unknown(found: Identified) -> dict[str, str]:
    return {it.name: it.reason for it in found.unknown}


def test_silence_to_what_only_an_m_model_answers_leaves_both_models_the_i_model_first() -> None:
    found, _ = run(identify(0x01), by_dcon())

    assert models(found) == ["I-7019R", "M-7019R"]
    assert found.candidates[1].doubts == ("no answer to $01P",)
    assert unknown(found)["model"] == "it can be I-7019R, M-7019R"
    assert TimedOut(dcon.ReadProtocol(0x01)) in [it.outcome for it in found.unknown]
    assert (found.model, found.known.model) == (Model.I_7019R, None)


def test_a_refusal_of_what_only_an_m_model_answers_proves_the_i_model() -> None:
    found, _ = run(identify(0x01), by_dcon() | {dcon.ReadProtocol: refused})

    assert models(found) == ["I-7019R"]
    assert "$01P is refused: not M-7019R" in found.reasons
    assert "model" not in unknown(found)
    assert Model.I_7019R is found.known.model


def test_an_answer_of_what_only_an_m_model_has_proves_the_m_model() -> None:
    said = dcon.ProtocolSetting(0x01, modbus_supported=True, protocol=Protocol.DCON)

    found, _ = run(identify(0x01), by_dcon() | {dcon.ReadProtocol: lambda _: said})

    assert models(found) == ["M-7019R"]
    assert "$01P is answered: not I-7019R" in found.reasons
    assert unknown(found)["modbus_data_format"] == "DCON has no command that reads it"


def test_without_the_firmware_a_refusal_is_only_a_doubt() -> None:
    outcomes = by_dcon() | {dcon.ReadProtocol: refused, dcon.ReadFirmwareVersion: refused}

    found, _ = run(identify(0x01), outcomes)

    assert models(found) == ["I-7019R", "M-7019R"]
    assert unknown(found)["firmware"] == "$01F is refused"
    assert None is found.version


def test_a_name_that_begins_like_those_of_a_series_makes_the_others_less_likely() -> None:
    runner = Runner.on(evolve(factory(Model.I_7017), name="7017-1"))

    found = runner.run(identify(0x01, policy=QUICK))

    assert models(found)[0] == "I-7017"
    assert all("7017-1 is not of its series" in it.doubts for it in found.candidates if it.model.series != "7017")


@pytest.mark.parametrize("name", ["7050D", "87017R"])
def test_the_name_of_another_product_has_no_candidates(name: str) -> None:
    found, steps = run(identify(0x01), by_dcon(name=name, code=0x40))

    assert found.candidates == ()
    assert (found.model, found.profile) == (None, None)
    assert unknown(found)["model"] == unknown(found)["types"] == f"{name} is the name of another product"
    assert found.name == name
    assert len(commands(steps)) == 4


def test_a_type_code_of_no_module_behind_a_name_that_was_set_is_that_of_another_product() -> None:
    found, _ = run(identify(0x01), by_dcon(name="TANK", code=0x40))

    assert found.candidates == ()
    assert unknown(found)["model"] == "the type code 40 is that of another product"


def test_a_type_code_that_the_model_does_not_use_can_have_any_value() -> None:
    found, _ = run(identify(0x01), by_dcon(code=0x40))

    assert models(found) == ["I-7019R", "M-7019R"]
    assert found.known.types == (TypeCode.K,) * 8


def test_a_factory_name_whose_models_do_not_have_the_type_was_given_to_another_model() -> None:
    found, _ = run(identify(0x01), by_dcon(name="7018", code=0x1B) | dict.fromkeys(PROBES, refused))

    assert models(found)[0] == "I-7017R-A5"
    assert "7018 was given to the module: the models of that name do not have its type" in found.reasons


def test_different_types_are_those_of_a_model_that_can_have_them() -> None:
    found, _ = run(identify(0x01), by_dcon(name="TANK", code=0xFF))

    assert all(candidate.model.individually_configurable for candidate in found.candidates)
    assert "the channels have different types" in found.reasons[1]


def test_a_type_code_that_is_not_defined_is_not_learned() -> None:
    found, _ = run(identify(0x01), by_dcon(name="7018", code=0x40))

    assert unknown(found)["types"] == "the type code 40 is not defined"
    assert found.profile.type_codes == () if found.profile else False


def test_the_types_that_are_not_defined_or_not_answered_are_not_learned() -> None:
    def types(command: dcon.ReadChannelTypeCode) -> Any:
        if command.channel == 2:
            return None
        return dcon.ChannelTypeCode(command.address, command.channel, 0x1D if command.channel == 1 else 0x0F)

    found, _ = run(identify(0x01), by_dcon() | {dcon.ReadChannelTypeCode: types})

    assert (TypeCode.K, None, None, *(TypeCode.K,) * 5) == found.known.types
    assert [it.reason for it in found.unknown if it.name == "types"] == [
        "no answer to $018C2",
        "the type code 1D of channel 1 is not defined",
    ]
    assert found.profile is not None
    assert found.profile.type_codes == ()


def test_channels_that_do_not_answer_are_not_all_asked() -> None:
    found, steps = run(identify(0x01), by_dcon() | {dcon.ReadChannelTypeCode: refused})

    assert None is found.known.types
    assert sum(isinstance(command, dcon.ReadChannelTypeCode) for command in commands(steps)) == 2


def test_a_data_format_that_is_not_defined_is_not_learned() -> None:
    found, _ = run(identify(0x01), by_dcon(report=ReportSettings(3)))

    assert None is found.known.data_format
    assert unknown(found)["data_format"] == "the data format 3 is not defined"


def test_a_module_that_refuses_its_configuration_is_there() -> None:
    found, _ = run(identify(0x01), by_dcon(name="7018") | {dcon.ReadConfiguration: refused})

    assert Protocol.DCON is found.protocol
    assert unknown(found)["data_format"] == "$012 is refused"
    assert unknown(found)["types"] == "the configuration was not learned"
    assert (found.line_settings, found.stored_address) == (None, None)


def test_a_module_whose_configuration_is_unreadable_is_asked_for_its_name() -> None:
    wire = b"!01\r"
    unreadable: Result[Any] = Result(
        TimedOut(dcon.ReadConfiguration(0x01)), (Rejected(wire, Fault.LENGTH, "too short"),)
    )

    found, _ = run(identify(0x01), by_dcon() | {dcon.ReadConfiguration: lambda _: unreadable})

    assert (found.protocol, found.name) == (Protocol.DCON, "7019R")
    assert unknown(found)["data_format"] == r"the answer to $012 is not understood: !01\r"


def test_a_module_without_a_readable_name_can_be_every_model_that_answers_like_it() -> None:
    found, _ = run(identify(0x01), by_dcon(code=0x1B) | dict.fromkeys((dcon.ReadModuleName, *PROBES), refused))

    assert found.reasons[0] == "the name was not learned"
    assert "I-7017R-A5" in models(found)


@pytest.mark.parametrize(("single_ended", "channels"), [(True, 20), (False, 10)])
def test_the_connecting_mode_decides_the_channels(channels: int, *, single_ended: bool) -> None:
    mode = dcon.ConnectingMode(0x01, single_ended=single_ended)

    found, _ = run(identify(0x01), by_dcon(name="7017Z") | {dcon.ReadConnectingMode: lambda _: mode})

    assert found.profile is not None
    assert (single_ended, channels) == (found.known.single_ended, found.profile.channels)


def test_the_only_model_that_fits_is_doubted_if_the_module_has_a_name_of_its_own() -> None:
    eeprom = evolve(factory(Model.M_7017R_A5), name="OVEN", protocol=Protocol.DCON)

    found = Runner.on(eeprom).run(identify(0x01))

    assert models(found) == ["M-7017R-A5"]
    assert found.candidates[0].doubts == ("OVEN is not its factory name",)


def test_the_only_model_that_fits_is_doubted_if_its_name_is_lost() -> None:
    said = dcon.ProtocolSetting(0x01, modbus_supported=True, protocol=Protocol.DCON)
    refusals = dict.fromkeys((*PROBES, dcon.ReadModuleName), refused)

    found, _ = run(identify(0x01), by_dcon(code=0x1B) | refusals | {dcon.ReadProtocol: lambda _: said})

    assert models(found) == ["M-7017R-A5"]
    assert found.candidates[0].doubts == ("the name was not learned",)


def test_a_factory_name_leaves_no_doubt_about_the_only_model() -> None:
    found, _ = run(identify(0x01), by_dcon() | {dcon.ReadProtocol: refused})

    assert found.candidates == (Candidate(Model.I_7019R),)


def test_a_7017z_whose_name_was_set_is_known_by_its_connecting_mode() -> None:
    eeprom = evolve(factory(Model.M_7017Z), name="TANK", single_ended=True, protocol=Protocol.DCON)
    runner = Runner.on(eeprom)

    found = runner.run(identify(0x01, policy=QUICK))

    assert models(found) == ["M-7017Z"]
    assert (found.known.single_ended, found.known.types) == (True, (TypeCode.V_10,) * 20)
    assert [it.command for it in runner.asked].count(dcon.ReadConnectingMode(0x01)) == 1


def test_a_connecting_mode_that_is_not_learned_is_said_to_be_unknown() -> None:
    found, _ = run(identify(0x01), by_dcon(name="7017Z"))

    assert unknown(found)["single_ended"] == "no answer to @01S"


def test_types_that_no_candidate_has_are_noted_and_left_out_of_the_profile() -> None:
    found, _ = run(
        identify(0x01),
        by_dcon(name="7017RM", code=0xFF)
        | {dcon.ReadChannelTypeCode: lambda it: dcon.ChannelTypeCode(0x01, it.channel, 0x0F)},
    )

    assert "the types are 0F, but this contradicts the rest" in found.reasons
    assert found.profile is not None
    assert found.profile.type_codes == ()


def test_a_module_in_init_mode_has_another_stored_address() -> None:
    eeprom = evolve(factory(Model.M_7018), address=0x23, line_settings=LineSettings(BaudRate.BAUD_19200))
    runner = Runner.on(eeprom, init_switch=True)

    found = runner.run(identify(0x00, policy=QUICK))

    assert (0x23, eeprom.line_settings) == (found.stored_address, found.line_settings)
    assert models(found) == ["M-7018"]


def test_nothing_that_answers_is_said_for_each_protocol_and_checksum() -> None:
    found, steps = run(identify(0xF8), {})

    assert (found.protocol, found.profile, found.candidates) == (None, None, ())
    assert [it.reason for it in found.unknown] == [
        "no answer to $F82",
        "no answer to $F82",
    ]
    assert [(step.profile.checksum, step.policy is None) for step in steps] == [
        (False, False), (True, False), (False, True), (True, True),
    ]  # fmt: skip


def test_a_silent_address_is_asked_by_both_protocols() -> None:
    found, _ = run(identify(0x01), {})

    assert found.unknown[-1].reason == "no answer to function 04 of address 0"
    assert {"protocol"} == set(unknown(found))


@pytest.mark.parametrize(
    ("named", "reason"),
    [(unanswered, "does not answer function 46"), (refused, "function 46, sub-function 00 is refused: exception 01")],
)
def test_a_modbus_device_without_function_46_is_none_of_the_models(named: Any, reason: str) -> None:
    inputs = {modbus.ReadInputRegisters: lambda it: modbus.InputRegisters(it.address, (0,) * it.count)}

    found, steps = run(identify(0x01, protocols=[Protocol.MODBUS_RTU]), inputs | {modbus.ReadModuleName: named})

    assert Protocol.MODBUS_RTU is found.protocol
    assert (found.profile, found.candidates) == (None, ())
    assert {"name", "model", "types", "modbus_data_format", "data_format", "checksum"} <= set(unknown(found))
    assert reason in unknown(found)["model"]
    assert len(steps) <= 4


def test_a_name_of_no_series_is_that_of_another_product() -> None:
    found, _ = run(identify(0x01, protocols=[Protocol.MODBUS_RTU]), by_modbus(name="00705500"))

    assert (found.candidates, found.name) == ((), "00705500")
    assert unknown(found)["model"] == "00 70 55 00 is the name of another product"


def test_a_name_that_is_lost_leaves_every_m_model_that_answers_like_it() -> None:
    found, _ = run(
        identify(0x01, protocols=[Protocol.MODBUS_RTU]), by_modbus(code=0x1B) | {modbus.ReadModuleName: unanswered}
    )

    assert models(found) == ["M-7017R-A5"]
    assert unknown(found)["name"] == "no answer to function 46, sub-function 00"


def test_a_version_of_undefined_bytes_is_not_learned() -> None:
    found, _ = run(identify(0x01, protocols=[Protocol.MODBUS_RTU]), by_modbus(version=(2, 7, 0)))

    assert (found.known.firmware, found.version) == (None, "020700")
    assert unknown(found)["firmware"] == "02 07 00 is not a version (E75)"


def test_a_module_without_its_map_is_asked_for_the_type_of_each_channel() -> None:
    found, steps = run(identify(0x01, protocols=[Protocol.MODBUS_RTU]), by_modbus())

    assert found.known.types == (TypeCode.K,) * 8
    assert sum(isinstance(command, modbus.ReadTypeCode) for command in commands(steps)) == 9
    assert unknown(found)["modbus_data_format"] == "M-7019R with firmware B2.0 has no register for it"


def test_the_type_of_one_channel_is_not_that_of_all_while_the_model_may_have_several() -> None:
    outcomes = by_modbus(name="00701800", version=(0x0B, 1, 0)) | dict.fromkeys(READS, unanswered)

    found, _ = run(identify(0x01, protocols=[Protocol.MODBUS_RTU]), outcomes)

    assert models(found) == ["M-7018", "M-7018R", "M-7018Z", "M-7018-16"]
    assert "whether channel 0 has the type of all" in unknown(found)["types"]


def test_a_type_that_does_not_answer_by_modbus_is_not_learned() -> None:
    outcomes = by_modbus(name="00701800", version=(0x0B, 1, 0)) | {modbus.ReadTypeCode: refused}

    found, _ = run(identify(0x01, protocols=[Protocol.MODBUS_RTU]), outcomes)

    assert unknown(found)["types"] == "function 46, sub-function 07 is refused: exception 01, illegal function"


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        ({"address": 0x100}, EncodeError),
        ({"address": 0xF8, "protocols": [Protocol.MODBUS_RTU]}, EncodeError),
        ({"protocols": []}, EncodeError),
        ({"address": "01"}, ArgumentError),
        ({"protocols": 1}, ArgumentError),
        ({"protocols": ["DCON"]}, ArgumentError),
        ({"checksum": 1}, ArgumentError),
        ({"policy": 1}, ArgumentError),
    ],
)
def test_invalid_arguments_are_refused_at_the_call(arguments: dict[str, Any], error: type[Exception]) -> None:
    with pytest.raises(error):
        identify(**{"address": 0x01} | arguments)
