"""Steps that send bytes as they are and switch the power, for threads and for asyncio."""

import asyncio
from collections.abc import Callable
from typing import Any

import pytest

from i7000 import InvalidValueError, Model
from i7000.device import factory, power_on
from i7000.errors import I7000Error
from i7000.host.procedures import BytesHeard, PowerCycle, Procedure, SendBytes
from i7000.link import AsyncLine, Line, LinkError, Observed, Port, PowerCycled, VirtualPort
from i7000.link.guarded import GuardedPort
from i7000.simulator import Faults

Driven = Callable[..., Any]
NAME, TOLD = b"$01M\r", b"!017018\r"


def by_threads(port: Port, procedure: Procedure[Any], *, echo: bool = False) -> Any:
    with Line(port, echo=echo) as line:
        return line.run(procedure)


def by_tasks(port: Port, procedure: Procedure[Any], *, echo: bool = False) -> Any:
    async def driven() -> Any:
        async with AsyncLine(port, echo=echo) as line:
            return await line.run(procedure)

    return asyncio.run(driven())


@pytest.fixture(params=[by_threads, by_tasks])
def drive(request: pytest.FixtureRequest) -> Driven:
    driven: Driven = request.param
    return driven


def module(**faults: Any) -> VirtualPort:
    return VirtualPort([power_on(factory(Model.I_7018), now=0.0)], faults=Faults(**faults))


def sent(*pieces: tuple[float, bytes], seconds: float = 0.5, ends: bytes = b"\r") -> Procedure[BytesHeard]:
    heard: BytesHeard = yield SendBytes(pieces, seconds, 0.02, ends)
    return heard


def test_what_a_module_answers_to_bytes_is_returned(drive: Driven) -> None:
    heard = drive(module(), sent((0.0, NAME)))

    assert heard.wire == TOLD
    assert 0 < heard.pieces[0][0] < 0.05
    assert heard.now < 0.1  # the answer ends it, not the time


def test_pieces_of_a_command_are_one_command(drive: Driven) -> None:
    heard = drive(module(), sent((0.0, b"$0"), (0.3, b"1M"), (0.0, b""), (0.0, b"\r")))

    assert heard.wire == TOLD
    assert heard.now > 0.3


def test_silence_is_listened_to_for_as_long_as_it_takes(drive: Driven) -> None:
    heard = drive(module(), sent((0.0, b"$02M\r"), seconds=0.25))

    assert heard.pieces == ()
    assert 0.25 <= heard.now < 0.3


def test_bytes_that_are_no_answer_are_listened_to_for_longer(drive: Driven) -> None:
    unfinished = drive(module(), sent((0.0, NAME), ends=b"!"))

    assert (unfinished.wire, unfinished.now > 0.5) == (TOLD, True)


def test_nothing_is_sent_without_pieces(drive: Driven) -> None:
    port = module()

    assert drive(port, sent(seconds=0.0)).wire == b""


def test_an_echo_is_dropped_where_the_line_has_one(drive: Driven) -> None:
    assert drive(module(echo=True), sent((0.0, NAME)), echo=True).wire == TOLD
    assert drive(module(), sent((0.0, NAME)), echo=True).wire == TOLD
    assert drive(module(echo=True), sent((0.0, NAME))).wire == NAME + TOLD


def power(*, init_switch: bool) -> Procedure[tuple[bool, bytes]]:
    switched = yield PowerCycle(init_switch)
    heard = yield from sent((0.0, b"$00M\r"))
    return switched, heard.wire


@pytest.mark.parametrize(("init_switch", "told"), [(True, b"!007018\r"), (False, b"")])
def test_the_power_is_switched_with_the_init_switch(drive: Driven, *, init_switch: bool, told: bytes) -> None:
    port = module()

    assert drive(GuardedPort(port), power(init_switch=init_switch)) == (True, told)
    assert port.modules[0].ram.init_mode is init_switch


@pytest.mark.parametrize("can", [True, False])
def test_an_observer_hears_of_the_power_if_it_was_switched(*, can: bool) -> None:
    seen: list[Observed] = []
    port: Any = module() if can else Plain(module())
    Line(port, observe=seen.append).run(power(init_switch=True))

    assert [it for it in seen if isinstance(it, PowerCycled)] == [PowerCycled(0.0, init_switch=True)] * can


class Plain:
    """A port without anything but the methods of a serial port."""

    def __init__(self, port: VirtualPort) -> None:
        self.__dict__["port"] = port

    def __setattr__(self, name: str, value: object) -> None:
        setattr(self.port, name, value)

    def __getattr__(self, name: str) -> Any:
        if name == "power_cycle":
            raise AttributeError(name)
        return getattr(self.port, name)


def test_a_port_that_cannot_switch_the_power_says_so(drive: Driven) -> None:
    assert drive(Plain(module()), power(init_switch=False))[0] is False


class Broken(VirtualPort):
    """A port whose power switch does not work."""

    error: Exception = RuntimeError("stuck")

    def power_cycle(self, *, init_switch: bool | None = None) -> None:  # noqa: ARG002 - as of `VirtualPort`
        raise self.error


def broken(error: Exception) -> Broken:
    port = Broken([power_on(factory(Model.I_7018), now=0.0)])
    port.error = error
    return port


def test_a_switch_that_fails_loses_the_port(drive: Driven) -> None:
    with pytest.raises(LinkError, match="the port is lost: stuck"):
        drive(broken(RuntimeError("stuck")), power(init_switch=False))


def refusing() -> Procedure[str]:
    try:
        yield SendBytes(((0.0, b"~01O7018\r"),), 0.5)
    except I7000Error as error:
        return str(error)
    return "sent"


def test_what_a_port_refuses_is_raised_in_the_procedure(drive: Driven) -> None:
    assert "~01O7018\\r was not sent" in drive(GuardedPort(module()), refusing())


def switching() -> Procedure[str]:
    try:
        yield PowerCycle()
    except I7000Error as error:
        return str(error)
    return "switched"


def test_a_switch_that_is_refused_leaves_the_line_usable(drive: Driven) -> None:
    refusal = InvalidValueError("power", "off", "on", "")

    assert drive(broken(refusal), switching()) == str(refusal)


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: SendBytes([(0.0, NAME)], 0.5), "pieces"),  # type: ignore[arg-type]
        (lambda: SendBytes((NAME,), 0.5), "pieces"),  # type: ignore[arg-type]
        (lambda: SendBytes(((0.0, "text"),), 0.5), "pieces"),  # type: ignore[arg-type]
        (lambda: SendBytes(((-1.0, NAME),), 0.5), "pieces"),
        (lambda: SendBytes(((0.0, NAME),), float("nan")), "seconds"),
        (lambda: SendBytes(((0.0, NAME),), 0.5, -0.1), "quiet"),
        (lambda: SendBytes(((0.0, NAME),), 0.5, 0.1, "text"), "ends"),  # type: ignore[arg-type]
    ],
)
def test_a_step_that_cannot_be_is_refused(make: Callable[[], object], field: str) -> None:
    with pytest.raises(InvalidValueError) as refused:
        make()

    assert refused.value.field == field
