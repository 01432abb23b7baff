"""Several modules on one pair of wires."""

import pytest

from i7000 import EncodeError, Model, Protocol, dcon, modbus
from i7000.device import Bus, Signals
from tests.device.driver import bench


def bus(**modules: Model) -> Bus:
    """A bus of modules: address ``A`` and DCON, or ``M`` and Modbus."""
    return Bus(
        tuple(
            bench(
                model,
                address=int(place[1:], 16),
                protocol=Protocol.MODBUS_RTU if place[0] == "M" else Protocol.DCON,
            ).state
            for place, model in modules.items()
        )
    )


def hear(line: Bus, frame: bytes) -> tuple[Bus, bytes | None]:
    return line.step(frame, [Signals()] * len(line.modules), 1000.0)


MIXED = {"A01": Model.I_7018, "A02": Model.M_7019R, "M01": Model.M_7017, "M03": Model.M_7018}


def test_the_module_that_is_asked_answers_in_its_protocol() -> None:
    line = bus(**MIXED)

    assert hear(line, b"$01M\r")[1] == b"!017018\r"
    assert hear(line, b"$02M\r")[1] == b"!027019R\r"
    assert hear(line, b"$03M\r")[1] is None
    asked = modbus.encode(modbus.ReadModuleName(1)), modbus.encode(modbus.ReadModuleName(2))
    assert hear(line, asked[0])[1] == modbus.encode(modbus.ModuleName(1, b"\0\x70\x17\0"))
    assert hear(line, asked[1])[1] is None


def test_a_broadcast_reaches_all_that_know_it() -> None:
    line, answer = hear(bus(**MIXED), b"#**\r")

    assert answer is None
    assert [module.ram.sampled is not None for module in line.modules] == [False, True, False, False]
    line, answer = hear(line, modbus.encode(modbus.WriteSingleRegister(0, 487, 5)))
    assert answer is None
    assert [module.eeprom.response_delay for module in line.modules] == [0, 0, 5, 5]


def test_answers_that_collide_are_garbled_unless_they_are_equal() -> None:
    line = Bus((bench(Model.I_7017).state, bench(Model.I_7017F).state))

    assert hear(line, b"$016\r")[1] == b"!01FF\r"
    answer = hear(line, b"$01M\r")[1]
    assert answer is not None
    assert answer == b"!017017\r"[:-1] + bytes((0x0D & ord("F"),)) + b"\r"


def test_every_module_has_its_signals() -> None:
    line = bus(A01=Model.I_7018)

    with pytest.raises(EncodeError, match="signals cannot be 0: 1, those of each module"):
        line.step(dcon.seal(b"#01", checksum=False), [], 0.0)
