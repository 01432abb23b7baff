"""The host against the model of the modules, through the line: what it delivers is what the module said when asked."""

from collections.abc import Callable
from typing import Any

from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Model, Profile, Protocol, ReportSettings, Unit, dcon, modbus
from i7000.device import Signals, State, factory, power_on, step
from i7000.host import Answered, Bus, Declined, Policy, Query, TimedOut
from i7000.strategies.dcon import commands
from i7000.strategies.modbus import requests as modbus_requests
from tests.host.line import Asked, Line, encode

PROFILE = Profile(Model.M_7019R, checksum=True)
COMMANDS = [
    kind
    for kind in dcon.COMMANDS
    if issubclass(kind, dcon.Command) and kind is not dcon.SetConfiguration and kind.availability not in PROFILE.refused
]
"""All that leave the module to be found where it is, and understood."""
RTU = 0x03
ADDRESS = 484
"""The register 40485."""


def module(address: int) -> State:
    eeprom = factory(Model.M_7019R)
    protocol = Protocol.MODBUS_RTU if address == RTU else Protocol.DCON
    settings = ReportSettings(checksum=True)
    return power_on(evolve(eeprom, address=address, protocol=protocol, report_settings=settings), now=0.0)


def modules() -> Callable[[Query[Any]], Asked]:
    """Three modules, whose inputs are others each time that one is asked."""
    states = {address: module(address) for address in (0x01, 0x02, RTU)}

    def asked(command: Any) -> Asked:
        codec: Any = modbus if isinstance(command, modbus.Message) else dcon

        def answer(number: int) -> Any:
            signals = Signals.of(Unit.VOLT, *[command.address + number / 100] * 8)
            state, reply = step(states[command.address], encode(command, PROFILE), signals, float(number))
            states[command.address] = state
            return codec.decode_response(reply, command, PROFILE)

        return Asked(command, PROFILE, answer)

    return asked


def _stays(request: modbus.Request[Any]) -> bool:
    """Whether the module keeps its address."""
    if isinstance(request, modbus.WriteSingleRegister):
        return request.register != ADDRESS
    if isinstance(request, modbus.WriteMultipleRegisters):
        return not request.start <= ADDRESS < request.start + len(request.values)
    return not isinstance(request, modbus.SetModuleAddress)


def requests() -> st.SearchStrategy[Any]:
    addresses = st.sampled_from((0x01, 0x02))
    settings = st.builds(evolve, commands(PROFILE, *COMMANDS), address=addresses)
    inputs = st.builds(dcon.ReadAnalogInputs, addresses)
    registers = st.builds(modbus.ReadInputRegisters, st.just(RTU), st.integers(0, 9), st.integers(1, 8))
    coils = st.builds(modbus.WriteSingleCoil, st.just(RTU), st.just(258), value=st.booleans())
    more = modbus_requests(PROFILE).filter(modbus.is_answered).map(lambda it: evolve(it, address=RTU)).filter(_stays)
    return inputs | registers | settings | coils | more


@given(st.data(), st.integers(0, 2), st.booleans(), st.lists(requests(), min_size=1, max_size=6))
def test_what_is_delivered_is_what_the_module_said_for_that_request(
    data: st.DataObject,
    retries: int,
    echo: bool,  # noqa: FBT001 - as Hypothesis calls it
    dialogue: list[Any],
) -> None:
    line = Line(data.draw, Bus[Any](policy=Policy(retries=retries), echo=echo))
    asked = modules()

    for command in dialogue:
        ended = line.ask(asked(command))

        if isinstance(ended.outcome, Answered | Declined):
            assert ended.outcome.response in ended.sent
        else:
            assert (TimedOut(command), False) == (ended.outcome, ended.intact)
