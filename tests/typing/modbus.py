"""What a type checker knows of Modbus: type-checked, never run."""

from typing import Any, assert_type

from i7000 import Profile, Reading, modbus


def check(profile: Profile, registers: modbus.RegisterMap) -> None:
    assert_type(
        modbus.decode_response(b"", modbus.ReadInputRegisters(0x01, 0, 8), profile),
        modbus.InputRegisters | modbus.ExceptionResponse,
    )
    assert_type(
        modbus.decode_response(b"", modbus.WriteSingleCoil(0x01, 256, True), profile),
        modbus.SingleCoilWritten | modbus.ExceptionResponse,
    )
    assert_type(
        modbus.decode_response(b"", modbus.ReadChannelMask(0x01), profile),
        modbus.ChannelMask | modbus.ExceptionResponse,
    )
    assert_type(modbus.decode_request(b"", profile), modbus.Request[Any])
    assert_type(modbus.readings(modbus.InputRegisters(0x01, (0,)).values, profile), tuple[Reading, ...])
    assert_type(registers.plan(0x01, ["filter", 40489]).requests, tuple[modbus.ReadItems, ...])
    one_or_several = registers.decode("filter", (0,))
    assert_type(one_or_several, modbus.RegisterValue | tuple[modbus.RegisterValue, ...])
    assert_type(registers.decode("type_code", (0, 1), channels=range(2)), tuple[modbus.RegisterValue, ...])
    assert_type(
        registers.plan(0x01, ["filter"]).decode([modbus.Coils(0x01, (True,))]),
        dict[str, modbus.RegisterValue | tuple[modbus.RegisterValue, ...] | modbus.ExceptionResponse],
    )
    assert_type(modbus.ReadCoils(0x01, 0, 1).response, type[modbus.Response])

    modbus.SetCjcEnabled(0x01, True)  # type: ignore[call-arg] # a boolean says its name
    modbus.ReadCoils(0x01, 0, 1).count = 2  # type: ignore[misc] # frozen
    modbus.decode_response(b"", modbus.Coils(0x01, (True,)), profile)  # type: ignore[arg-type] # no request
