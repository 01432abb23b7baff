"""TCP: where hosts find the bus, how many of them, and what becomes of those that do not behave."""

import asyncio
import errno
import os
import socket
import struct
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from time import sleep
from typing import Any

import pytest

from i7000 import Model, Profile, Protocol, modbus
from i7000.simulator import tcp
from i7000.simulator.faults import Faults
from i7000.simulator.simulator import UNREAD, Simulator
from i7000.simulator.tcp import MOST_CONNECTIONS, Connection, listen
from tests.simulator.running import I_7018, RFC_2217, Network, ask, connected, module, port, running
from tests.waiting import ENOUGH, until


def opened_at(host: str, number: int = 0) -> str:
    """Listen, and tell the place."""

    async def wait() -> str:
        async with listen(Simulator([I_7018]), host, number) as place:
            return place

    return asyncio.run(wait())


@contextmanager
def having(addresses: list[tuple[socket.AddressFamily, str]], monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Have every host have these addresses."""

    async def getaddrinfo(_: object, __: object, number: int, **___: object) -> list[Any]:
        return [
            (family, socket.SOCK_STREAM, 6, "", (address, number, *((0, 0) if family is socket.AF_INET6 else ())))
            for family, address in addresses
        ]

    with monkeypatch.context() as patched:
        patched.setattr(asyncio.BaseEventLoop, "getaddrinfo", getaddrinfo)
        yield


# --- places -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("host", ["", "*"])
def test_every_address_of_this_machine_has_the_same_port(host: str) -> None:
    with running(lambda simulator: listen(simulator, host), I_7018) as here:
        _, _, number = here.place.rpartition(":")
        answers = []
        for address in ("127.0.0.1", "::1"):
            with socket.create_connection((address, int(number)), timeout=ENOUGH) as host_:
                host_.sendall(b"$01M\r")
                answers.append(host_.recv(100))

    assert here.place.startswith("0.0.0.0:")
    assert answers == [b"!017018\r"] * 2


def test_another_port_is_taken_if_one_of_the_addresses_has_it_in_use(monkeypatch: pytest.MonkeyPatch) -> None:
    create_server = socket.create_server
    refused: list[int] = []

    def create(address: Any, **others: Any) -> socket.socket:
        if address[0] == "::1" and not refused:
            refused.append(address[1])
            raise OSError(errno.EADDRINUSE, "in use")
        return create_server(address, **others)

    with having([(socket.AF_INET6, "::1"), (socket.AF_INET, "127.0.0.1")], monkeypatch):
        monkeypatch.setattr(socket, "create_server", create)
        place = opened_at("localhost")

    assert place.startswith("127.0.0.1:")
    assert place != f"127.0.0.1:{refused[0]}"


def test_a_search_for_a_free_port_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    create_server = socket.create_server

    def create(address: Any, **others: Any) -> socket.socket:
        if address[0] == "::1":
            raise OSError(errno.EADDRINUSE, "in use")
        return create_server(address, **others)

    monkeypatch.setattr(socket, "create_server", create)
    with (
        having([(socket.AF_INET, "127.0.0.1"), (socket.AF_INET6, "::1")], monkeypatch),
        pytest.raises(OSError, match=r"cannot listen at \[::1\]:\d+: Address already in use"),
    ):
        opened_at("localhost")


def test_an_address_that_this_machine_does_not_have_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    with having([(socket.AF_INET6, "2001:db8::1"), (socket.AF_INET, "127.0.0.1")], monkeypatch):
        assert opened_at("localhost").startswith("127.0.0.1:")


def test_an_address_that_this_machine_does_not_have_is_no_place_by_itself() -> None:
    with pytest.raises(OSError, match=r"cannot listen at 192\.0\.2\.1:0: Cannot assign requested address"):
        opened_at("192.0.2.1")


def test_a_place_that_is_taken_is_named() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        number = server.getsockname()[1]

        with pytest.raises(OSError, match=rf"cannot listen at 127\.0\.0\.1:{number}: Address already in use"):
            opened_at("127.0.0.1", number)


@pytest.mark.parametrize(
    ("host", "said"),
    [("no-such-host.invalid", "'no-such-host.invalid' is not a host: "), ("a" * 70, "cannot be the name of a host")],
)
def test_a_name_that_no_host_has_is_named(host: str, said: str) -> None:
    with pytest.raises(OSError, match=said):
        opened_at(host)


@pytest.mark.parametrize(("host", "noticed"), [("127.0.0.1", 0), ("127.0.0.2", 0), ("::1", 0), ("*", 1)])
def test_a_place_beyond_this_machine_is_noticed_once(host: str, noticed: int) -> None:
    reported: list[str] = []

    with running(lambda simulator: listen(simulator, host), I_7018, report=reported.append) as here:
        assert [f"{here.place} can be reached from other machines"] * noticed == reported


# --- hosts that do not read -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("unread", "written", "lost"), [(0, [b"!01\r"], 0), (1 << 16, [], 1)])
def test_a_host_that_has_not_read_for_long_loses_what_it_is_sent(unread: int, written: list[bytes], lost: int) -> None:
    async def answer() -> tuple[Network, Simulator]:
        simulator = Simulator([I_7018])
        connection, network = Connection(simulator, "host", set()), Network(unread)
        connection.transport = network
        connection.write(b"!01\r")
        return network, simulator

    network, simulator = asyncio.run(answer())

    assert (written, lost) == (network.written, simulator.notices[UNREAD])


def test_a_host_that_is_gone_is_sent_nothing(caplog: pytest.LogCaptureFixture) -> None:
    """The network would complain of each answer."""
    with running(listen, I_7018) as here:
        for _ in range(5):
            with connected(here) as opened:
                opened.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                opened.sendall(b"#01\r" * 2000)
                until(lambda: here.observed)
            here.observed.clear()

        with port(here, "socket") as opened:
            assert ask(opened, b"$01M\r", 8) == b"!017018\r"

    assert caplog.records == []


# --- hosts that send nothing more -------------------------------------------------------------------------------------


def said(opened: socket.socket) -> bytes:
    """All that a host is sent until it is hung up on."""
    heard = b""
    while received := opened.recv(1000):
        heard += received
    return heard


@pytest.mark.parametrize("transport", [listen, RFC_2217])
def test_a_host_that_sends_nothing_more_gets_its_late_answers(transport: Any) -> None:
    with (
        running(transport, I_7018, faults=Faults(late=1.0, late_by=0.2, lumps=True)) as here,
        connected(here) as opened,
    ):
        opened.sendall(b"$01M\r$012\r")
        opened.shutdown(socket.SHUT_WR)

        heard = said(opened)

    assert heard.endswith(b"!017018\r!01050600\r")


def test_a_host_that_sends_nothing_more_gets_the_answer_that_waits_for_silence() -> None:
    spoken = module(Model.M_7017, protocol=Protocol.MODBUS_RTU, response_delay=30)
    request = modbus.SetChannelMask(1, 0x0F)

    with running(listen, spoken) as here, connected(here) as opened:
        opened.sendall(modbus.encode(request, Profile(Model.M_7017)))
        opened.shutdown(socket.SHUT_WR)

        assert said(opened) == modbus.encode(modbus.ChannelMaskResult(1, 0))


def test_a_host_that_sends_nothing_at_all_is_hung_up_on() -> None:
    with running(listen, I_7018) as here, connected(here) as opened:
        opened.shutdown(socket.SHUT_WR)

        assert said(opened) == b""


def test_a_host_that_is_there_when_the_simulation_ends_is_hung_up_on() -> None:
    with ExitStack() as stack:
        with running(listen, I_7018) as here:
            opened = stack.enter_context(connected(here))
            opened.sendall(b"$01M\r")
            answer = opened.recv(100)
        with suppress(ConnectionResetError):
            assert opened.recv(100) == b""

    assert answer == b"!017018\r"


# --- more hosts than can be served ------------------------------------------------------------------------------------


def test_hosts_beyond_the_limit_are_hung_up_on_and_reported_once() -> None:
    reported: list[str] = []

    with running(listen, I_7018, report=reported.append) as here, ExitStack() as stack:
        served = [stack.enter_context(connected(here)) for _ in range(MOST_CONNECTIONS)]
        for _ in range(5):
            with connected(here) as refused, suppress(ConnectionResetError):
                assert refused.recv(100) == b""
        served[-1].sendall(b"$01M\r")
        answer = served[-1].recv(100)
        counted = dict(here.simulator.notices)

    assert answer == b"!017018\r"
    assert reported == [f"a connection was refused: {MOST_CONNECTIONS} are open"]
    assert counted == {reported[0]: 5}


def test_a_host_that_goes_leaves_room_for_another() -> None:
    with running(listen, I_7018) as here:
        for _ in range(3):
            with ExitStack() as stack:
                served = [stack.enter_context(connected(here)) for _ in range(MOST_CONNECTIONS)]
                served[-1].sendall(b"$01M\r")
                answer = served[-1].recv(100)
            until(lambda: here.call(lambda: len(asyncio.all_tasks()) < MOST_CONNECTIONS))

            assert answer == b"!017018\r"


def test_a_host_that_sends_nothing_more_makes_room_for_another() -> None:
    faults = Faults(late=1.0, late_by=60)
    with running(listen, I_7018, faults=faults) as here, ExitStack() as stack:
        for _ in range(MOST_CONNECTIONS):
            opened = stack.enter_context(connected(here))
            opened.sendall(b"$01M\r")
            opened.shutdown(socket.SHUT_WR)
        until(lambda: len(here.observed) == MOST_CONNECTIONS)
        sleep(0.1)
        here.call(lambda: setattr(here.simulator, "faults", Faults()))

        with connected(here) as another:
            another.sendall(b"$01M\r")

            assert another.recv(100) == b"!017018\r"
        assert not here.simulator.notices


def test_connections_that_cannot_be_accepted_wait_and_are_reported_once(monkeypatch: pytest.MonkeyPatch) -> None:
    sock_accept, failures = asyncio.SelectorEventLoop.sock_accept, iter(range(3))
    reported: list[str] = []

    async def accept(loop: Any, listening: socket.socket) -> Any:
        if next(failures, None) is not None:
            raise OSError(errno.EMFILE, os.strerror(errno.EMFILE))
        return await sock_accept(loop, listening)

    monkeypatch.setattr(asyncio.SelectorEventLoop, "sock_accept", accept)
    monkeypatch.setattr(tcp, "_PAUSE", 0.05)

    with (
        running(listen, I_7018, report=reported.append) as here,
        port(here, "socket") as opened,
    ):
        answer = ask(opened, b"$01M\r", 8)

    assert answer == b"!017018\r"
    assert reported == ["connections are not accepted for 0.05 s: Too many open files"]
    assert here.simulator.notices[reported[0]] == 3
