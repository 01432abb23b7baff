"""A proxy of a line: what passes, and what its faults make of it."""

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

import pytest
from attrs import define, field
from hypothesis import given
from hypothesis import strategies as st

from i7000 import dcon, modbus
from i7000.device import Uart
from i7000.recording.records import Carried
from i7000.simulator.faults import Faults, Way
from i7000.simulator.proxy import UNSENT, Proxy, ProxyHost
from i7000.simulator.served import Served

ASKED = modbus.encode(modbus.ReadModuleName(1))
NAMED = modbus.encode(modbus.ModuleName(1, b"\0\x70\x17\0"))


@define
class Bench:
    """A proxy between a host and a target, both of them a test."""

    proxy: Proxy
    host: ProxyHost
    sent: list[bytes]
    received: list[bytes]
    carried: list[Carried]
    tuned: list[Uart]
    takes: list[bool] = field(factory=lambda: [True])

    def exchange(self, request: bytes, *answer: bytes) -> bytes:
        """Have a request answered, and return what the host receives at once."""
        self.received.clear()
        self.host.receive(request)
        for piece in answer:
            self.proxy.receive(piece)
        return b"".join(self.received)


def bench(do: Callable[[Bench], Awaitable[Any]], **options: Any) -> Any:
    async def run() -> Any:
        sent: list[bytes] = []
        received: list[bytes] = []
        carried: list[Carried] = []
        tuned: list[Uart] = []
        takes = [True]

        def write(data: bytes) -> bool:
            if takes[0]:
                sent.append(data)
            return takes[0]

        def tune(uart: Uart) -> bool:
            tuned.append(uart)
            return takes[0]

        proxy = Proxy(write, tune, uart=Uart(), observe=carried.append, **options)
        made = Bench(proxy, proxy.host("pty", received.append), sent, received, carried, tuned, takes)
        return await do(made)

    return asyncio.run(run())


def exchanged(*exchanges: tuple[bytes, bytes], faults: Faults = Faults()) -> list[bytes]:  # noqa: B008 - frozen
    """What a host receives at once of each answer."""

    async def exchange(it: Bench) -> list[bytes]:
        return [it.exchange(*one) for one in exchanges]

    found: list[bytes] = bench(exchange, faults=faults)
    return found


@given(st.lists(st.tuples(st.booleans(), st.binary(min_size=1, max_size=300)), max_size=10))
def test_without_faults_every_byte_passes_unchanged(pieces: list[tuple[bool, bytes]]) -> None:
    async def pass_all(it: Bench) -> tuple[bytes, bytes]:
        it.host.receive(b"x")
        for sent, data in pieces:
            if sent:
                it.host.receive(data)
            else:
                it.proxy.receive(data)
        it.host.end_answer()
        return b"".join(it.sent), b"".join(it.received)

    assert bench(pass_all) == (
        b"x" + b"".join(data for sent, data in pieces if sent),
        b"".join(data for sent, data in pieces if not sent),
    )


@pytest.mark.parametrize(("request_", "answer"), [(b"$01M\r", b"!017018\r"), (ASKED, NAMED)], ids=["dcon", "rtu"])
def test_an_answer_is_delivered_as_soon_as_it_is_complete(request_: bytes, answer: bytes) -> None:
    async def send(it: Bench) -> list[bytes]:
        it.host.receive(request_[:3])
        it.host.receive(request_[3:])
        it.proxy.receive(answer[:4])
        assert it.received == []
        it.proxy.receive(answer[4:])
        return it.received

    assert bench(send) == [answer]


def test_what_is_no_frame_is_delivered_when_the_line_is_silent() -> None:
    async def send(it: Bench) -> list[bytes]:
        it.host.receive(b"hello")
        it.proxy.receive(b"wor")
        it.proxy.receive(b"ld")
        await asyncio.sleep(0.2)
        return it.received

    assert bench(send) == [b"world"]


def test_an_answer_without_an_end_is_not_kept_for_ever() -> None:
    async def send(it: Bench) -> int:
        it.host.receive(b"#01\r")
        it.proxy.receive(b">" * 1000)
        return sum(map(len, it.received))

    assert bench(send) == 1000


@pytest.mark.parametrize(
    ("faults", "request_", "answer", "arrives"),
    [
        (Faults(refuse=1.0), b"$01M\r", b"!017018\r", b"?01\r"),
        (Faults(refuse=1.0, refuse_code=2), ASKED, NAMED, modbus.seal(b"\x01\xc6\x02")),
        (Faults(duplicate=1.0), b"#01\r", b">+1.0000\r", b">+1.0000\r" * 2),
        (Faults(misaddress=1.0), ASKED, NAMED, modbus.seal(b"\x02" + NAMED[1:-2])),
        (
            Faults(misaddress=1.0), dcon.seal(b"$01M", checksum=True), dcon.seal(b"!017018", checksum=True),
            dcon.seal(b"!027018", checksum=True),
        ),
        (Faults(refuse=1.0), dcon.seal(b"$01M", checksum=True), b"!017018\r", b"?01\r"),
        (Faults().at(1, silent=1.0), b"$01M\r", b"!017018\r", b""),
        (Faults().at(2, silent=1.0), b"$01M\r", b"!017018\r", b"!017018\r"),
        (Faults().at(1, silent=1.0), b"noise", b"!017018\r", b"!017018\r"),
        (Faults().at(Way.FROM, drop=1.0), b"$01M\r", b"!017018\r", b""),
        (Faults(echo=True), b"$01M\r", b"!017018\r", b"$01M\r!017018\r"),
    ],
)  # fmt: skip
def test_faults_are_those_of_the_simulator(faults: Faults, request_: bytes, answer: bytes, arrives: bytes) -> None:
    async def send(it: Bench) -> bytes:
        it.exchange(request_, answer)
        it.host.end_answer()
        return b"".join(it.received)

    assert bench(send, faults=faults) == arrives


def test_requests_after_each_other_are_told_from_each_other() -> None:
    asked_other = modbus.encode(modbus.ReadModuleName(2))

    assert exchanged((ASKED, NAMED), (asked_other, NAMED), faults=Faults().at(2, silent=1.0)) == [NAMED, b""]
    assert exchanged((b"$01M\r$02M\r", b"!027018\r"), faults=Faults().at(2, silent=1.0)) == [b""]


def test_an_earlier_answer_is_replayed() -> None:
    exchanges = (b"$01M\r", b"!017018\r"), (b"$016\r", b"!01FF\r"), (b"$016\r", b"!01FF\r")

    assert exchanged(*exchanges, faults=Faults(replay=1.0)) == [b"!017018\r"] * 3


def test_a_damaged_request_reaches_the_target_damaged() -> None:
    async def send(it: Bench) -> list[bytes]:
        it.host.receive(b"#01\r")
        it.proxy.faults = Faults(drop=1.0)
        it.host.receive(b"#01\r")
        return it.sent

    assert bench(send) == [b"#01\r"]


def test_a_late_answer_comes_after_the_next_request() -> None:
    async def send(it: Bench) -> list[bytes]:
        it.exchange(b"$01M\r", b"!017018\r")
        it.proxy.faults = Faults()
        it.exchange(b"$016\r", b"!01FF\r")
        await asyncio.sleep(0.3)
        return it.received

    assert bench(send, faults=Faults(late=1.0, late_by=0.1)) == [b"!01FF\r", b"!017018\r"]


def test_an_answer_goes_to_the_host_that_asked_last() -> None:
    async def send(it: Bench) -> tuple[bytes, bytes]:
        other: list[bytes] = []
        second = it.proxy.host("second", other.append)
        it.host.receive(b"$01M\r")
        it.proxy.receive(b"!01")
        second.receive(b"$02M\r")
        it.proxy.receive(b"!027018\r")
        second.close()
        it.proxy.receive(b"lost")
        return b"".join(it.received), b"".join(other)

    assert bench(send) == (b"!01", b"!027018\r")


def test_what_nobody_asked_for_is_observed() -> None:
    async def send(it: Bench) -> list[tuple[Any, ...]]:
        it.proxy.receive(b"early")
        it.exchange(b"$01M\r", b"!017018\r")
        return [(one.wire, one.sent, one.place, one.notes) for one in it.carried]

    assert bench(send, faults=Faults().at(Way.FROM, flip=0.0, late=0.0, duplicate=1.0)) == [
        (b"early", False, None, ("nobody has asked",)),
        (b"$01M\r", True, "pty", ()),
        (b"!017018\r!017018\r", False, "pty", ("sent twice",)),
    ]


def test_a_target_that_takes_nothing_loses_requests_and_says_so() -> None:
    reported: list[str] = []

    async def send(it: Bench) -> Any:
        it.takes[0] = False
        it.host.receive(b"#01\r")
        it.host.receive(b"#01\r")
        it.host.uart = Uart(19200)
        return it.proxy.notices[UNSENT], it.carried[-1].notes

    assert bench(send, report=reported.append) == (3, (UNSENT,))
    assert reported == [UNSENT]


def test_the_line_settings_of_a_host_are_those_of_the_target() -> None:
    async def tune(it: Bench) -> Any:
        it.host.uart = Uart()
        it.host.uart = Uart(19200, parity="E")
        return it.tuned, it.host.uart

    assert bench(tune) == ([Uart(19200, parity="E")], Uart(19200, parity="E"))


def test_a_host_that_sends_nothing_more_has_time_for_its_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("i7000.simulator.proxy._PATIENCE", 0.05)

    async def finish(it: Bench) -> list[bytes]:
        finished = asyncio.Event()
        it.host.receive(b"$01M\r")
        it.host.finish(finished.set)
        it.proxy.receive(b"!017018\r")
        await finished.wait()
        return it.received

    assert bench(finish, faults=Faults(late=1.0, late_by=0.2)) == [b"!017018\r"]


def test_a_host_that_is_gone_receives_nothing_more() -> None:
    async def leave(it: Bench) -> list[bytes]:
        it.exchange(b"$01M\r", b"!017018\r", b"!0")
        it.host.finish(lambda: it.received.append(b"finished"))
        it.host.close()
        await asyncio.sleep(0.1)
        it.proxy.receive(b"more")
        return it.received

    assert bench(leave, faults=Faults(late=1.0, late_by=0.01)) == []


def test_a_proxy_ends_once() -> None:
    async def end(it: Bench) -> None:
        it.proxy.end()
        it.proxy.end()
        it.proxy.fail(OSError("gone"))
        await it.proxy.run()

    async def fail(it: Bench) -> None:
        it.proxy.fail(OSError("gone"))
        await it.proxy.run()

    bench(end)
    with pytest.raises(OSError, match="gone"):
        bench(fail)


def test_a_proxy_is_served_as_a_simulator_is() -> None:
    def served(line: Served) -> Served:
        return line

    async def serve(it: Bench) -> Served:
        return served(it.proxy)

    assert isinstance(bench(serve), Proxy)
