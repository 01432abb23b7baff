"""Several modules on one pair of wires."""

import pytest

from i7000 import DataFormat, Model, Protocol, ReportSettings, TypeCode, Unit, dcon, modbus
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


def test_three_modules_read_in_the_formats_that_the_manual_shows() -> None:
    volts = (5.96301157, 2.98104801, -2.27847715, -9.71633478, 1.18472854, -2.84153506, 7.69676809, -5.43434806)
    hexadecimal = ReportSettings(DataFormat.HEX)
    line = Bus((
        bench(Model.I_7017, type_code=TypeCode.MV_150).state,
        bench(Model.I_7017, address=2, report_settings=hexadecimal).state,
        bench(Model.I_7018, address=3, type_code=TypeCode.K).state,
    ))  # fmt: skip
    signals = (
        Signals.of(Unit.MILLIVOLT, 25.12, 20.45, 12.78, 18.97, 3.24, 15.35, 8.07, 14.79),
        Signals.of(Unit.VOLT, *volts),
        Signals.of(Unit.CELSIUS, *[-300.0] * 8),
    )

    assert line.step(b"#01\r", signals, 1000.0)[1] == (b">+025.12+020.45+012.78+018.97+003.24+015.35+008.07+014.79\r")
    assert line.step(b"#02\r", signals, 1000.0)[1] == b">4C532628E2D683A20F2ADBA16284BA71\r"
    assert line.step(b"#03\r", signals, 1000.0)[1] == b">" + b"-9999.9" * 8 + b"\r"


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

    with pytest.raises(ValueError, match="zip"):
        line.step(dcon.seal(b"#01", checksum=False), [], 0.0)
