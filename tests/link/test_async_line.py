"""What only the line of an event loop has: many tasks, cancelled tasks, closing."""

import asyncio
import gc
from collections.abc import Callable
from threading import Event
from typing import Any

import pytest

from i7000 import BaudRate, Firmware, LineSettings, Model, Profile, dcon
from i7000.host import Answered, Late, Outcome, TimedOut
from i7000.host.procedures import Procedure, Tune, ask
from i7000.link import Asked, AsyncLine, Happened, LinkError, Observed, Tuned, VirtualPort, Written, async_line
from i7000.link.worker import Worker
from i7000.message import Query, Response
from tests.link.scene import FAST, HASTY, MODULES, NO_SUCH_MODULE, PROFILE, requests, truth
from tests.simulator.running import module as simulated
from tests.waiting import ENOUGH, until

READ = dcon.ReadAnalogInput(0x01, 0)
SECOND = dcon.ReadAnalogInput(0x01, 1)


class HeldUp(VirtualPort):
    """A port whose next read waits in real time until the test lets it go on."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.reading, self.go_on = Event(), Event()
        self.go_on.set()

    def hold(self) -> None:
        self.reading.clear()
        self.go_on.clear()

    def read(self, size: int = 1) -> bytes:
        if size:
            self.reading.set()
            assert self.go_on.wait(ENOUGH)
        return super().read(size)


async def held_up(port: HeldUp) -> None:
    """Wait until the thread of the line is in a read."""
    assert await asyncio.to_thread(port.reading.wait, ENOUGH)


def bus() -> HeldUp:
    return HeldUp(MODULES, line=FAST)


def opened(port: VirtualPort, observe: Callable[[Observed], None] | None = None) -> AsyncLine:
    return AsyncLine(port, FAST, HASTY, observe=observe)


def test_twenty_tasks_share_a_line() -> None:
    asked = list(requests(60))

    async def task(line: AsyncLine, mine: list[tuple[Query[Response], Profile]]) -> list[Outcome[Response]]:
        return [await line.ask(command, profile) for command, profile in mine]

    async def shared() -> list[list[Outcome[Response]]]:
        async with opened(bus()) as line:
            return list(await asyncio.gather(*(task(line, asked[at::20]) for at in range(20))))

    assert asyncio.run(shared()) == [[truth(command) for command, _ in asked[at::20]] for at in range(20)]


def test_a_cancelled_task_ends_at_once_and_leaves_the_line_to_the_next() -> None:
    async def cancelled(port: HeldUp, seen: list[Observed]) -> Outcome[Response]:
        async with opened(port, seen.append) as line:
            port.hold()
            first = asyncio.create_task(line.ask(READ, PROFILE))
            await held_up(port)
            first.cancel()
            with pytest.raises(asyncio.CancelledError):
                await first
            port.go_on.set()
            return await line.ask(SECOND, PROFILE)

    assert asyncio.run(cancelled(bus(), [])) == truth(SECOND)


def test_the_late_response_of_a_cancelled_request_answers_nothing() -> None:
    async def cancelled(port: HeldUp, seen: list[Observed]) -> Outcome[Response]:
        async with opened(port) as line:
            task = asyncio.create_task(line.ask(READ, PROFILE))

            def observe(observed: Observed) -> None:
                seen.append(observed)
                if len(seen) == 2:  # the request was written
                    task.cancel()

            line._conversation.observe = observe  # noqa: SLF001 - it needs the task
            with pytest.raises(asyncio.CancelledError):
                await task
            return await line.ask(SECOND, PROFILE)

    seen: list[Observed] = []
    outcome = asyncio.run(cancelled(bus(), seen))

    assert outcome == truth(SECOND)
    assert Late(b">+0025.18F\r") in [it.event for it in seen if isinstance(it, Happened)]


def test_a_task_that_is_cancelled_before_its_turn_sends_nothing() -> None:
    async def cancelled(port: HeldUp) -> list[Observed]:
        seen: list[Observed] = []
        async with opened(port, seen.append) as line:
            first, second = (asyncio.create_task(line.ask(it, PROFILE)) for it in (READ, SECOND))
            await asyncio.sleep(0)
            second.cancel()
            assert await first == truth(READ)
            with pytest.raises(asyncio.CancelledError):
                await second
        return seen

    assert not [it for it in asyncio.run(cancelled(bus())) if getattr(it, "command", None) == SECOND]


def test_a_timeout_of_asyncio_ends_a_request() -> None:
    async def waited(port: HeldUp) -> Outcome[Response]:
        async with opened(port) as line:
            port.hold()
            with pytest.raises(TimeoutError):
                await asyncio.wait_for(line.ask(READ, PROFILE), 0.01)
            port.go_on.set()
            return await line.ask(SECOND, PROFILE)

    assert asyncio.run(waited(bus())) == truth(SECOND)


def test_a_procedure_has_the_line_for_itself() -> None:
    def slow_then_fast() -> Procedure[tuple[bool, bool]]:
        yield Tune(LineSettings(BaudRate.BAUD_1200))
        slow = yield from ask(READ, PROFILE)
        yield Tune(FAST)
        fast = yield from ask(READ, PROFILE)
        return isinstance(slow.outcome, TimedOut), isinstance(fast.outcome, Answered)

    async def beside() -> tuple[Any, ...]:
        async with opened(bus()) as line:
            return tuple(await asyncio.gather(line.run(slow_then_fast()), line.ask(READ, PROFILE)))

    assert asyncio.run(beside()) == ((True, True), truth(READ))


def test_a_cancelled_procedure_leaves_the_line_settings_as_they_were() -> None:
    def tuned_away() -> Procedure[None]:
        yield Tune(LineSettings(BaudRate.BAUD_1200))
        yield from ask(NO_SUCH_MODULE, PROFILE)

    async def cancelled(port: HeldUp) -> Outcome[Response]:
        def observe(observed: Observed) -> None:
            if observed == Tuned(0.0, LineSettings(BaudRate.BAUD_1200)):
                task.cancel()

        async with opened(port, observe) as line:
            task = asyncio.create_task(line.run(tuned_away()))
            with pytest.raises(asyncio.CancelledError):
                await task
            return await line.ask(READ, PROFILE)

    assert asyncio.run(cancelled(bus())) == truth(READ)


CALIBRATION = dcon.CalibrateChannelZero(0x01, 0)
OLD = Profile(Model.I_7019R, firmware=Firmware("B2.6"))
"""A module that calibrates for 16 seconds."""


@pytest.mark.parametrize("sent", [False, True])
def test_a_cancelled_task_leaves_the_silence_that_is_owed_to_the_next(sent: bool) -> None:  # noqa: FBT001
    port = VirtualPort([simulated(OLD.model, str(OLD.firmware))])
    end: type[Observed] = Written if sent else Asked

    async def cancel_and_ask() -> Outcome[Response]:
        def observe(observed: Observed) -> None:
            if isinstance(observed, end):
                task.cancel()

        async with AsyncLine(port, observe=observe) as line:
            task = asyncio.create_task(line.ask(CALIBRATION, OLD))
            with pytest.raises(asyncio.CancelledError):
                await task
            return await line.ask(dcon.ReadModuleName(0x01), OLD)

    assert isinstance(asyncio.run(cancel_and_ask()), Answered)
    assert port.now() > 17.0 if sent else port.now() < 0.3


def test_the_tasks_that_wait_behind_a_cancelled_one_are_served() -> None:
    async def ask() -> list[Any]:
        async with opened(bus()) as line:
            tasks = [asyncio.create_task(line.ask(READ, PROFILE)) for _ in range(3)]
            await asyncio.sleep(0)
            tasks[1].cancel()
            return list(await asyncio.gather(*tasks, return_exceptions=True))

    first, second, third = asyncio.run(ask())

    assert first == third == truth(READ)
    assert isinstance(second, asyncio.CancelledError)


# --- closing ----------------------------------------------------------------------------------------------------------


def test_closing_ends_the_requests_of_other_tasks() -> None:
    async def closed(port: HeldUp) -> list[Any]:
        line = opened(port)
        port.hold()
        tasks = [asyncio.create_task(line.ask(READ, PROFILE)) for _ in range(3)]
        await held_up(port)
        closing = asyncio.create_task(line.close())
        await asyncio.sleep(0)
        port.go_on.set()
        await closing
        return list(await asyncio.gather(*tasks, return_exceptions=True))

    port = bus()
    errors = asyncio.run(closed(port))

    assert [str(error) for error in errors] == ["the line is closed"] * 3
    assert {type(error) for error in errors} == {LinkError}
    assert not port.is_open


def test_closing_twice_is_closing_once() -> None:
    async def closed(port: VirtualPort) -> None:
        line = opened(port)
        await line.close()
        await line.close()
        with pytest.raises(LinkError, match="the line is closed"):
            await line.ask(READ, PROFILE)

    asyncio.run(closed(bus()))


def test_a_port_that_is_held_up_does_not_hold_up_closing(monkeypatch: pytest.MonkeyPatch) -> None:
    async def closed(port: HeldUp) -> bool:
        line = opened(port)
        port.hold()
        task = asyncio.create_task(line.ask(READ, PROFILE))
        await held_up(port)
        await line.close()
        task.cancel()
        return port.is_open

    monkeypatch.setattr(async_line, "CLOSING", 0.01)
    port = bus()

    assert asyncio.run(closed(port))
    port.go_on.set()


def test_a_result_that_comes_after_the_end_of_the_event_loop_is_dropped() -> None:
    ended, done = Event(), Event()

    async def called() -> None:
        worker = Worker()
        worker.call(lambda: ended.wait(ENOUGH))
        worker.call(done.set)
        worker.end()

    asyncio.run(called())
    ended.set()

    assert done.wait(ENOUGH)


def test_an_error_that_nobody_waits_for_is_not_reported() -> None:
    reported: list[Any] = []

    async def called() -> None:
        asyncio.get_running_loop().set_exception_handler(lambda _, context: reported.append(context))
        worker = Worker()
        failing = worker.call(lambda: 1 // 0)
        worker.end()
        await asyncio.wait((failing,))

    asyncio.run(called())
    gc.collect()

    assert reported == []


# --- opening ----------------------------------------------------------------------------------------------------------


def test_a_target_is_opened_without_holding_up_the_event_loop() -> None:
    async def asked() -> Outcome[Response]:
        async with await AsyncLine.open("sim:M-7019R,type=K,protocol=dcon", policy=HASTY) as line:
            return await line.ask(dcon.ReadModuleName(0x01), PROFILE_WITHOUT_CHECKSUM)

    assert isinstance(asyncio.run(asked()), Answered)


PROFILE_WITHOUT_CHECKSUM = Profile(PROFILE.model)


def test_a_target_that_cannot_be_opened_raises() -> None:
    with pytest.raises(LinkError, match="no/such/port: No such file"):
        asyncio.run(AsyncLine.open("/no/such/port"))


@pytest.mark.parametrize("port", [bus(), None], ids=["opened", "not opened"])
def test_a_port_that_opens_after_its_task_was_cancelled_is_closed(
    port: HeldUp | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    opening, go_on = Event(), Event()

    def open_slowly(*_: Any) -> VirtualPort:
        opening.set()
        go_on.wait(ENOUGH)
        if port is None:
            raise LinkError("gone")
        return port

    async def cancelled() -> None:
        task = asyncio.create_task(AsyncLine.open("COM3"))
        await asyncio.to_thread(opening.wait, ENOUGH)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        go_on.set()
        if port is not None:
            await asyncio.to_thread(until, lambda: not port.is_open)

    monkeypatch.setattr(async_line, "open_target", open_slowly)
    asyncio.run(cancelled())

    assert opening.is_set()
