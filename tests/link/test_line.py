"""Both lines, on a virtual port with and without faults: what comes of requests and procedures."""

import asyncio
import logging
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from attrs import frozen
from serial import SerialException

from i7000 import BaudRate, CharacterFormat, EncodeError, LineSettings, dcon, modbus
from i7000.errors import I7000Error, InvalidValueError, StateError
from i7000.host import Answered, Declined, Late, Outcome, Policy, Sent, TimedOut, Transmit
from i7000.host.procedures import Ask, Procedure, Result, Tell, Tune, Wait, ask
from i7000.link import (
    Abandoned,
    Asked,
    AsyncLine,
    Happened,
    Line,
    LinkError,
    Observed,
    Received,
    Tuned,
    VirtualPort,
    Written,
)
from i7000.message import Response
from i7000.simulator.faults import Faults
from tests.link import scene
from tests.link.scene import FAST, HASTY, MODULES, NO_SUCH_MODULE, PROFILE, PROFILES, requests, truth

READ = dcon.ReadAnalogInput(0x01, 0)


class InTurn:
    """The line of a program without an event loop."""

    def __init__(self, port: VirtualPort, line: LineSettings = FAST, policy: Policy = HASTY, **options: Any) -> None:
        self.line = Line(port, line, policy, **options)

    def ask(self, *asked: scene.Asked) -> list[Outcome[Response]]:
        return [self.line.ask(command, profile) for command, profile in asked]

    def run(self, procedure: Procedure[Any], tell: Callable[[object], None] | None = None) -> Any:
        return self.line.run(procedure, tell)

    def close(self) -> None:
        self.line.close()


class AtOnce:
    """The line of tasks in an event loop."""

    def __init__(self, port: VirtualPort, line: LineSettings = FAST, policy: Policy = HASTY, **options: Any) -> None:
        self.runner = asyncio.Runner()

        async def opened() -> AsyncLine:
            return AsyncLine(port, line, policy, **options)

        try:
            self.line = self.runner.run(opened())
        except LinkError:
            self.runner.close()
            raise

    def ask(self, *asked: scene.Asked) -> list[Outcome[Response]]:
        async def gathered() -> list[Outcome[Response]]:
            return list(await asyncio.gather(*(self.line.ask(command, profile) for command, profile in asked)))

        return self.runner.run(gathered())

    def run(self, procedure: Procedure[Any], tell: Callable[[object], None] | None = None) -> Any:
        return self.runner.run(self.line.run(procedure, tell))

    def close(self) -> None:
        self.runner.run(self.line.close())
        self.runner.close()


Open = Callable[..., InTurn | AtOnce]


@pytest.fixture(params=[InTurn, AtOnce])
def opened(request: pytest.FixtureRequest) -> Iterator[Open]:
    """What opens a line of either kind; it is closed at the end of the test."""
    lines: list[InTurn | AtOnce] = []

    def opening(port: VirtualPort, *settings: Any, **options: Any) -> InTurn | AtOnce:
        lines.append(request.param(port, *settings, **options))
        return lines[-1]

    yield opening
    for line in lines:
        line.close()


def bus(faults: Faults | None = None, seed: int = 7) -> VirtualPort:
    return VirtualPort(MODULES, None, faults, seed=seed, line=FAST)


# --- what comes of requests -------------------------------------------------------------------------------------------


def test_what_is_read_is_what_is_on_the_inputs(opened: Open) -> None:
    asked = list(requests(60))

    assert opened(bus()).ask(*asked) == [truth(command) for command, _ in asked]


PATIENT = Policy(retries=3, turnaround=0.1, grace=0.5)


@frozen
class Case:
    """How a line fails, and what a host has to allow for."""

    faults: Faults
    policy: Policy = PATIENT
    echo: bool = False
    """Whether the host expects to hear itself."""


CASES = {
    "echo": Case(Faults(echo=True), echo=True),
    "echo that is not expected": Case(Faults(echo=True)),
    "lumps": Case(Faults(lumps=True)),
    "drop": Case(Faults(drop=0.002)),
    "flip": Case(Faults(flip=0.002)),
    "noise": Case(Faults(noise=0.3)),
    "late": Case(Faults(late=0.1, late_by=0.1), Policy(retries=3, turnaround=0.03, grace=0.2)),
    "silent": Case(Faults(silent=0.2)),
    "truncate": Case(Faults(truncate=0.2)),
    "duplicate": Case(Faults(duplicate=0.5)),
    "misaddress": Case(Faults().at(0x03, misaddress=0.2)),
    "all": Case(
        Faults(echo=True, lumps=True, drop=0.001, flip=0.001, noise=0.1, late=0.1, late_by=0.3),
        Policy(retries=5, turnaround=0.1, grace=0.5),
        echo=True,
    ),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_whatever_the_line_does_nothing_wrong_is_read(opened: Open, case: Case) -> None:
    asked = list(requests(40))

    outcomes = opened(bus(case.faults), FAST, case.policy, echo=case.echo).ask(*asked)

    answered = [outcome for outcome in outcomes if isinstance(outcome, Answered)]
    assert [command for command, _ in asked] == [outcome.command for outcome in outcomes]
    assert [truth(outcome.command) for outcome in answered] == answered
    assert len(answered) >= 0.95 * len(asked)


def test_each_request_has_the_outcome_that_is_its_own(opened: Open) -> None:
    asked: list[Any] = [
        (dcon.ReadChannelMask(0x01), PROFILE),
        (dcon.SetChannelMask(0x01, 0x0F), PROFILE),
        (dcon.CalibrateSpan(0x02), PROFILES[0x02]),
        (NO_SUCH_MODULE, PROFILE),
        (dcon.HostOk(), PROFILE),
        (modbus.ReadInputRegisters(0x03, 8, 1), PROFILES[0x03]),
        (dcon.ReadChannelMask(0x01), PROFILE),
    ]
    commands = [command for command, _ in asked]
    seen: list[Observed] = []

    outcomes = opened(bus(), observe=seen.append).ask(*asked)

    assert outcomes == [
        Answered(commands[0], dcon.ChannelMask(0x01, 0xFB)),
        Answered(commands[1], dcon.Acknowledged(0x01)),
        Declined(commands[2], dcon.Refused(0x02)),
        TimedOut(commands[3]),
        Sent(commands[4]),
        Declined(commands[5], modbus.ExceptionResponse(0x03, 0x04, modbus.ExceptionCode.ILLEGAL_DATA_ADDRESS)),
        Answered(commands[6], dcon.ChannelMask(0x01, 0x0F)),
    ]
    assert [it.data for it in seen if isinstance(it, Written)].count(b"#0F99\r") == 2


def test_a_late_response_is_not_the_answer_to_the_next_request(opened: Open) -> None:
    port = bus(Faults(late=1.0, late_by=0.1))
    second = dcon.ReadAnalogInput(0x01, 1)

    def observe(observed: Observed) -> None:
        if isinstance(observed, Happened) and isinstance(observed.event, TimedOut):
            port.faults = Faults()

    line = opened(port, FAST, Policy(retries=0, turnaround=0.05, grace=0.3), observe=observe)

    assert line.ask((READ, PROFILE), (second, PROFILE)) == [TimedOut(READ), truth(second)]


def test_what_came_before_a_request_is_not_its_answer(opened: Open) -> None:
    port = bus()
    port.write(b"#010B4\r")
    port.sleep(1.0)
    second = dcon.ReadAnalogInput(0x01, 1)

    assert opened(port).ask((second, PROFILE)) == [truth(second)]


def test_a_request_has_its_own_policy_if_it_is_given_one() -> None:
    port = bus()
    with Line(port, FAST, Policy(turnaround=10.0)) as line:
        line.ask(NO_SUCH_MODULE, PROFILE, Policy(retries=0, turnaround=0.1))

        assert port.now() < 1.0
        assert line.policy == Policy(turnaround=10.0)


def test_a_command_that_a_module_does_not_have_raises_and_leaves_the_line_as_it_is(opened: Open) -> None:
    line = opened(bus())

    with pytest.raises(EncodeError):
        line.ask((dcon.ReadCjcUpdate(0x02), PROFILES[0x02]))
    assert line.ask((READ, PROFILE)) == [truth(READ)]


def test_the_same_seed_gives_the_same_conversation(opened: Open) -> None:
    def said(seed: int) -> list[Observed]:
        seen: list[Observed] = []
        faults = Faults(drop=0.01, flip=0.01, noise=0.2, late=0.2)
        opened(bus(faults, seed), observe=seen.append).ask(*requests(20))
        return seen

    assert said(7) == said(7) != said(8)


def test_both_lines_have_the_same_conversation() -> None:
    asked = list(requests(30))
    seen: list[list[Observed]] = []
    for kind in (InTurn, AtOnce):
        seen.append([])
        line = kind(bus(Faults(drop=0.01, noise=0.2)), observe=seen[-1].append)
        line.ask(*asked)
        line.close()

    assert seen[0] == seen[1]


# --- line settings ----------------------------------------------------------------------------------------------------


def test_the_port_gets_the_settings_of_the_line(opened: Open) -> None:
    port = VirtualPort(MODULES)
    line = opened(port, LineSettings(BaudRate.BAUD_1200, CharacterFormat.E81))
    assert (port.baudrate, port.parity, port.stopbits) == (1200, "E", 1)

    line.run(steps(Tune(LineSettings(BaudRate.BAUD_9600, CharacterFormat.N82))))
    assert (port.baudrate, port.parity, port.stopbits) == (9600, "N", 2)
    assert line.line.line == LineSettings(BaudRate.BAUD_9600, CharacterFormat.N82)


def test_a_line_can_wait() -> None:
    port = bus()
    with Line(port, FAST) as line:
        line.wait(1e5)

    assert port.now() == 1e5


@pytest.mark.parametrize("seconds", [-1.0, float("inf")])
def test_a_line_does_not_wait_for_an_impossible_time(seconds: float) -> None:
    with Line(bus(), FAST) as line, pytest.raises(InvalidValueError, match="seconds"):
        line.wait(seconds)


@pytest.mark.parametrize("line", [FAST, LineSettings()])
def test_a_line_can_be_tuned(line: LineSettings) -> None:
    port = bus()
    with Line(port, LineSettings()) as tuned:
        tuned.tune(line)

        assert isinstance(tuned.ask(READ, PROFILE), Answered if line == FAST else TimedOut)


def test_an_asynchronous_line_can_be_tuned_and_wait() -> None:
    async def tuned(port: VirtualPort) -> Outcome[dcon.AnalogInput]:
        async with AsyncLine(port) as line:
            await line.tune(FAST)
            await line.wait(10.0)
            assert (line.line, line.policy) == (FAST, Policy())
            return await line.ask(READ, PROFILE)

    port = bus()

    assert asyncio.run(tuned(port)) == truth(READ)
    assert 10.0 < port.now() < 10.1


# --- procedures -------------------------------------------------------------------------------------------------------


def steps(*yielded: Any) -> Procedure[list[Any]]:
    """A procedure that returns what it is sent for each step."""
    sent = []
    for step in yielded:
        answer = yield step
        sent.append(answer)
    return sent


def test_a_procedure_is_sent_the_results_of_its_requests_and_nothing_for_other_steps(opened: Open) -> None:
    told: list[object] = []
    procedure = steps(Ask(READ, PROFILE), Tell("half"), Ask(NO_SUCH_MODULE, PROFILE, Policy(retries=0)), Wait(1.0))

    sent = opened(bus()).run(procedure, told.append)

    assert sent == [Result(truth(READ)), None, Result(TimedOut(NO_SUCH_MODULE)), None]
    assert told == ["half"]


def test_what_a_procedure_tells_can_be_ignored(opened: Open) -> None:
    assert opened(bus()).run(steps(Tell(1))) == [None]


def test_a_result_has_the_other_traffic(opened: Open) -> None:
    port = bus()
    port.write(b"#010B4\r")
    port.sleep(1.0)

    (result,) = opened(port).run(steps(Ask(READ, PROFILE)))

    assert result == Result(truth(READ), (Late(b">+0025.18F\r"),))


def test_a_wait_hears_what_arrives_meanwhile(opened: Open) -> None:
    port = bus()
    seen: list[Observed] = []
    line = opened(port, observe=seen.append)
    port.write(b"#010B4\r")
    line.run(steps(Wait(2.0)))

    assert port.now() == 2.0
    assert b"".join(it.data for it in seen if isinstance(it, Received)) == b">+0025.18F\r"


def test_the_settings_that_a_procedure_leaves_stay(opened: Open) -> None:
    port = VirtualPort(MODULES)
    line = opened(port, LineSettings())
    line.run(steps(Tune(FAST)))

    assert line.ask((READ, PROFILE)) == [truth(READ)]


def test_an_error_in_a_procedure_leaves_the_line_settings_as_they_were(opened: Open) -> None:
    def failing() -> Procedure[None]:
        yield Tune(LineSettings(BaudRate.BAUD_1200))
        raise KeyError

    line = opened(bus())

    with pytest.raises(KeyError):
        line.run(failing())
    assert line.ask((READ, PROFILE)) == [truth(READ)]


def test_a_procedure_can_use_another(opened: Open) -> None:
    def twice() -> Procedure[tuple[Result[dcon.AnalogInput], ...]]:
        first = yield from ask(READ, PROFILE)
        second = yield from ask(READ, PROFILE)
        return first, second

    assert opened(bus()).run(twice()) == (Result(truth(READ)), Result(truth(READ)))


# --- observers --------------------------------------------------------------------------------------------------------


def test_an_observer_hears_each_byte_and_each_event_in_order(opened: Open) -> None:
    seen: list[Observed] = []
    opened(bus(), observe=seen.append).ask((READ, PROFILE))

    heard = b"".join(it.data for it in seen if isinstance(it, Received))
    others = [it for it in seen if not isinstance(it, Received)]
    assert heard == b">+0025.18F\r"
    assert others == [
        Asked(0.0, READ, PROFILE),
        Written(others[1].at, b"#010B4\r"),
        Happened(others[1].at, Transmit(b"#010B4\r")),
        Happened(seen[-1].at, truth(READ)),
    ]
    assert [it.at for it in seen] == sorted(it.at for it in seen)


def test_an_observer_hears_of_line_settings(opened: Open) -> None:
    seen: list[Observed] = []
    opened(bus(), observe=seen.append).run(steps(Tune(FAST), Tune(LineSettings())))

    assert seen == [Tuned(0.0, LineSettings())]


def test_an_observer_that_fails_is_logged_and_dropped_and_the_line_goes_on(
    opened: Open, caplog: pytest.LogCaptureFixture
) -> None:
    def observe(observed: Observed) -> None:
        raise KeyError(type(observed).__name__)

    with caplog.at_level(logging.ERROR):
        outcomes = opened(bus(), observe=observe).ask((READ, PROFILE))

    assert outcomes == [truth(READ)]
    assert [record.getMessage() for record in caplog.records] == [
        "the observer of a line failed, and is not called again"
    ]


# --- the end of a line ------------------------------------------------------------------------------------------------


class Gone(VirtualPort):
    """A port that disappears when it is read for the n-th time."""

    reads = 5
    error: Exception = OSError(5, "Input/output error")

    def read(self, size: int = 1) -> bytes:
        self.reads -= 1
        if not self.reads:
            raise self.error
        return super().read(size)


@pytest.mark.parametrize("error", [OSError(5, "Input/output error"), TypeError("fd is None")])
def test_a_port_that_disappears_is_one_error_and_closes_the_line(opened: Open, error: Exception) -> None:
    port = Gone(MODULES, line=FAST)
    port.error = error
    seen: list[Observed] = []
    line = opened(port, observe=seen.append)

    for _ in range(2):
        with pytest.raises(LinkError, match=f"Gone: the port is lost: {re.escape(str(error))}"):
            line.ask((READ, PROFILE))
    assert isinstance(seen[-1], Abandoned)
    assert not port.is_open


def test_a_device_that_is_gone_is_said_in_plain_words() -> None:
    port = Gone(MODULES, line=FAST)
    port.error = SerialException(
        "device reports readiness to read but returned no data (device disconnected or multiple access on port?)"
    )
    said = "Gone: the port is lost: the device was unplugged or has ended, or another program reads it too"

    with pytest.raises(LinkError, match=f"^{said}$"):
        Line(port, FAST).ask(READ, PROFILE)


def test_a_lost_port_is_an_error_of_the_package_and_of_the_system() -> None:
    assert issubclass(LinkError, OSError)
    assert issubclass(LinkError, I7000Error)
    assert str(LinkError("COM3: the port is lost")) == "COM3: the port is lost"


def test_a_port_that_was_closed_under_the_line_is_one_error(opened: Open) -> None:
    port = bus()
    line = opened(port)
    port.close()

    for _ in range(2):
        with pytest.raises(LinkError, match="VirtualPort: the port is closed"):
            line.ask((READ, PROFILE))


def test_a_closed_line_says_so(opened: Open) -> None:
    line = opened(bus())
    line.line.port.close()
    with pytest.raises(LinkError):
        line.ask((READ, PROFILE))


def test_a_line_that_was_closed_raises() -> None:
    with Line(bus(), FAST) as line:
        pass

    assert not line.port.is_open  # type: ignore[attr-defined] # of a VirtualPort
    with pytest.raises(LinkError, match="the line is closed"):
        line.ask(READ, PROFILE)


def test_an_error_while_closing_a_lost_port_is_not_shown() -> None:
    class Stuck(VirtualPort):
        def close(self) -> None:
            raise OSError

    with Line(Stuck(MODULES, line=FAST), FAST) as line:
        assert line.ask(READ, PROFILE) == truth(READ)


def test_a_write_that_fails_or_ends_early_is_an_error(opened: Open) -> None:
    class Short(VirtualPort):
        def write(self, data: object) -> int:  # noqa: ARG002
            return 3

    class Broken(VirtualPort):
        def write(self, data: object) -> int:
            raise OSError(data)

    with pytest.raises(LinkError, match="Short: only 3 of 7 bytes could be sent"):
        opened(Short(MODULES, line=FAST)).ask((READ, PROFILE))
    with pytest.raises(LinkError, match="Broken: the port is lost"):
        opened(Broken(MODULES, line=FAST)).ask((READ, PROFILE))


def test_settings_that_a_port_cannot_have_are_an_error(opened: Open) -> None:
    class Slow(VirtualPort):
        def _reconfigure_port(self) -> None:
            raise ValueError("too slow")

    with pytest.raises(LinkError, match="Slow: the port cannot be set to 1200 N81: too slow"):
        opened(Slow(MODULES), LineSettings(BaudRate.BAUD_1200))


@pytest.mark.parametrize("kind", [Line, AsyncLine])
def test_a_port_is_closed_again_if_its_line_cannot_be_made(
    kind: type[Line | AsyncLine], monkeypatch: pytest.MonkeyPatch
) -> None:
    closed: list[VirtualPort] = []

    def close(port: VirtualPort) -> None:
        closed.append(port)

    async def opened(policy: Any) -> None:
        line = kind.open("sim:I-7018", policy=policy)
        if not isinstance(line, Line):
            await line

    monkeypatch.setattr(VirtualPort, "close", close)
    with pytest.raises(InvalidValueError, match="policy") as raised:
        asyncio.run(opened("patient"))

    assert raised.value.field == "policy"  # it holds the port, which is closed when it is forgotten
    assert "sim:I-7018" in [port.name for port in closed]


def test_a_call_during_another_is_refused_and_disturbs_nothing() -> None:
    with Line(bus(), FAST) as line:
        with pytest.raises(StateError, match="the line is in use"):
            line.run(steps(Tell(1)), lambda _: line.ask(READ, PROFILE))

        assert line.ask(READ, PROFILE) == truth(READ)


def test_a_wrong_use_of_a_virtual_port_is_its_own_error(opened: Open) -> None:
    port = bus()
    line = opened(port)
    port.signals.clear()

    with pytest.raises(I7000Error, match="signals") as raised:
        line.ask((READ, PROFILE))
    assert not isinstance(raised.value, LinkError)


# --- requests that do not get to their end ----------------------------------------------------------------------------


def test_ctrl_c_ends_a_request_and_leaves_the_line_usable() -> None:
    class Interrupted(VirtualPort):
        reads = 2

        def read(self, size: int = 1) -> bytes:
            self.reads -= 1
            if not self.reads:
                raise KeyboardInterrupt
            return super().read(size)

    seen: list[Observed] = []
    port = Interrupted(MODULES, line=FAST)
    with Line(port, FAST, HASTY, observe=seen.append) as line:
        with pytest.raises(KeyboardInterrupt):
            line.ask(READ, PROFILE)

        assert isinstance(seen[-1], Abandoned)
        second = dcon.ReadAnalogInput(0x01, 1)
        assert line.ask(second, PROFILE) == truth(second)
        assert Late(b">+0025.18F\r") in [it.event for it in seen if isinstance(it, Happened)]
