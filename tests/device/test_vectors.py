"""Every vector of ``spec/`` that needs no state beyond its profile, heard by the model of its module."""

from typing import Any

from attrs import evolve

from i7000 import Firmware, Model, Protocol, ReportSettings, TypeCode, dcon, modbus
from i7000.device import Eeprom, factory
from tests.device.driver import bench
from tests.each import each
from tests.spec.lint import Record
from tests.vectors import parameters, profile_of


def eeprom_of(vector: Record, address: int, protocol: Protocol) -> Eeprom:
    """What a module remembers that fits the profile of a vector."""
    profile = profile_of(vector["profile"])
    made = factory(profile.model, profile.firmware)
    types = made.type_codes if not profile.type_codes else profile.type_codes[:1] * len(made.type_codes)
    if len(set(profile.type_codes)) > 1:
        types = (*profile.type_codes, *made.type_codes[profile.channels :])
    return evolve(
        made,
        address=address,
        type_codes=types,
        single_ended=profile.single_ended,
        modbus_data_format=profile.modbus_data_format,
        protocol=protocol,
        report_settings=ReportSettings(profile.data_format, checksum=profile.checksum),
    )


def stateless(folder: str, command: str) -> list[Any]:
    """The vectors of what is sent to a module, but those that depend on what came before."""
    return parameters(
        folder,
        lambda vector: (
            "needs-state" not in vector["flags"]
            and (vector["outcome"] != "reject" or vector["response_wire"] is None)
            and vector[f"{command}_wire"]
        ),
    )


def heard(eeprom: Eeprom, wire: bytes) -> tuple[bool, bytes | None]:
    """Whether a frame changes anything, and what answers it."""
    module = bench(Model.I_7018)
    module.state = evolve(module.state, eeprom=eeprom)
    module.power_cycle()
    before = module.state
    answer = module.send(wire)
    return module.state != before, answer


def dcon_address(wire: bytes) -> int:
    digits = wire[1:3].decode("latin-1")
    return int(digits, 16) if len(digits) == 2 and set(digits) <= set("0123456789ABCDEF") else 1


@each("vector", stateless("vectors/dcon", "command"))
def test_a_dcon_module_is_silent_refuses_or_answers_as_the_vector_says(vector: Record) -> None:
    wire = bytes.fromhex(vector["command_wire"])

    changed, answer = heard(eeprom_of(vector, dcon_address(wire), Protocol.DCON), wire)

    if vector["outcome"] == "response":
        assert answer is not None
        assert answer[0] in b"!>"
    elif vector["outcome"] == "refused":
        assert answer == bytes.fromhex(vector["response_wire"])
        assert not changed
    else:
        assert answer is None
        assert not changed or vector["outcome"] == "silence"


@each("vector", stateless("vectors/modbus", "request"))
def test_a_modbus_module_is_silent_excepts_or_answers_as_the_vector_says(vector: Record) -> None:
    wire = bytes.fromhex(vector["request_wire"])
    address = wire[0] if 1 <= wire[0] <= 247 else 1

    changed, answer = heard(eeprom_of(vector, address, Protocol.MODBUS_RTU), wire)

    match vector["outcome"], vector["fault"]:
        case "silence", _:
            assert answer is None
        case "response", _:
            assert answer is not None
            assert answer[1] == wire[1]
            if wire[1] in (0x05, 0x06, 0x0F, 0x10):
                assert answer.hex() == vector["response_wire"]
        case "exception", _:
            assert answer == bytes.fromhex(vector["response_wire"])
            assert not changed
        case _, "crc" | "address":
            assert answer is None
            assert not changed
        case _, fault:
            code = {"function": 1, "sub_function": 2}.get(fault, 3)
            unframed = (
                not modbus.SHORTEST_FRAME <= len(wire) <= modbus.LONGEST_FRAME
                or modbus.crc16(wire)
                or not wire[1] & 0x7F
            )
            assert answer == (None if unframed else modbus.seal(bytes((wire[0], wire[1] | 0x80, code))))
            assert not changed


def test_the_module_reports_the_firmware_of_a_vector() -> None:
    assert bench(Model.M_7017R, "B3.9").say("$01F") == f"!01{Firmware('B3.9')}"
    assert factory(Model.M_7017R, Firmware("B3.9")).type_codes == (TypeCode.V_10,) * 8
    assert dcon.decode_command(b"$01F\r", bench(Model.M_7017R).state.profile) == dcon.ReadFirmwareVersion(0x01)
