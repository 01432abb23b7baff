"""RFC 2217: what hosts set at their end of the line."""

import asyncio
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import BaudRate, LineSettings, Model
from i7000.device import Uart
from i7000.simulator.rfc2217 import Rfc2217Connection
from i7000.simulator.simulator import Simulator
from i7000.simulator.telnet import LONGEST_SUBNEGOTIATION, subnegotiation
from tests.simulator.running import I_7018, RFC_2217, Network, ask, connected, module, port, running


class Spoken:
    """What came of bytes that a host sent: what it was sent, after what is offered at first, and its settings."""

    def __init__(self, *pieces: bytes, spoken: Any = I_7018) -> None:
        async def converse() -> None:
            network = Network()
            connection = Rfc2217Connection(Simulator([spoken]), "host", set())
            connection.connection_made(network)
            offered = len(network.written)
            for piece in pieces:
                connection.receive(piece)
            self.heard = b"".join(network.written[offered:])
            self.uart = connection.host.uart
            connection.connection_lost(None)

        asyncio.run(converse())


def command(number: int, value: bytes = b"") -> bytes:
    return subnegotiation(bytes((0x2C, number)) + value)


def test_a_server_offers_what_it_can_do() -> None:
    with running(RFC_2217, I_7018) as here, connected(here) as opened:
        assert opened.recv(1000) == b"\xff\xfb\x01\xff\xfb\x03\xff\xfd\x00\xff\xfb\x2c"


# --- settings ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("settings", "hears"),
    [
        ({"baudrate": 19200}, True),
        ({"baudrate": 19200, "stopbits": 2}, True),
        ({"baudrate": 9600}, False),
        ({"baudrate": 19200, "parity": "E"}, False),
        ({"baudrate": 19200, "bytesize": 7}, False),
    ],
)
def test_a_module_hears_a_host_with_its_line_settings_only(settings: dict[str, object], *, hears: bool) -> None:
    spoken = module(Model.I_7018, line_settings=LineSettings(BaudRate.BAUD_19200))

    with running(RFC_2217, spoken) as here, port(here, "rfc2217", **settings) as opened:
        opened.timeout = 2 if hears else 0.1

        assert ask(opened, b"$01M\r", 8) == (b"!017018\r" if hears else b"")


@pytest.mark.parametrize(
    ("number", "value", "uart"),
    [
        (1, (57600).to_bytes(4), Uart(57600)),
        (1, (10**9).to_bytes(4), Uart(10**9)),
        (2, b"\x07", Uart(data_bits=7)),
        (3, b"\x02", Uart(parity="O")),
        (3, b"\x05", Uart(parity="S")),
        (4, b"\x02", Uart(stop_bits=2)),
        (4, b"\x03", Uart(stop_bits=1.5)),
    ],
)
def test_a_setting_is_made_and_confirmed(number: int, value: bytes, uart: Uart) -> None:
    spoken = Spoken(command(number, value))

    assert (spoken.heard, spoken.uart) == (command(100 + number, value), uart)


@pytest.mark.parametrize(
    ("number", "value", "current"),
    [
        (1, bytes(4), (9600).to_bytes(4)),
        (1, b"", (9600).to_bytes(4)),
        (1, bytes(5), (9600).to_bytes(4)),
        (2, b"\0", b"\x08"),
        (2, b"\x09", b"\x08"),
        (2, b"\x08\x08", b"\x08"),
        (3, b"\0", b"\x01"),
        (3, b"\x06", b"\x01"),
        (3, b"\xff", b"\x01"),
        (4, b"\0", b"\x01"),
        (4, b"\x63", b"\x01"),
        (5, b"\x00", b"\x01"),
        (5, b"\x04", b"\x06"),
        (5, b"\x07", b"\x08"),
        (5, b"\x0a", b"\x0b"),
        (5, b"\x0d", b"\x0e"),
    ],
)
def test_a_value_that_asks_or_is_unknown_is_answered_with_the_current_one(
    number: int, value: bytes, current: bytes
) -> None:
    spoken = Spoken(command(number, value))

    assert (spoken.heard, spoken.uart) == (command(100 + number, current), Uart())


@pytest.mark.parametrize(("request_", "state"), [(0, 2), (0, 19), (4, 5), (7, 9), (10, 12), (13, 18)])
def test_a_control_keeps_its_state(request_: int, state: int) -> None:
    spoken = Spoken(command(5, bytes((state,))), command(5, bytes((request_,))))

    assert spoken.heard == command(105, bytes((state,))) * 2


@pytest.mark.parametrize(("number", "value"), [(10, b"\x05"), (11, b"\xff"), (12, b"\x01"), (12, b"\x03")])
def test_masks_and_purging_are_confirmed(number: int, value: bytes) -> None:
    assert Spoken(command(number, value)).heard == command(100 + number, value)


@pytest.mark.parametrize(("number", "state"), [(6, b"\0"), (7, b"\xb0")])
def test_the_state_of_the_line_is_sent_on_request(number: int, state: bytes) -> None:
    assert Spoken(command(number)).heard == command(100 + number, state)


@pytest.mark.parametrize(
    "unknown",
    [
        subnegotiation(b""),
        subnegotiation(b"\x2c"),
        subnegotiation(b"\x18\x01"),
        command(0),
        command(5, b"\x14"),
        command(5),
        command(12, b"\x04"),
        command(200),
        command(8),
        b"\xff\xf0",
        b"\xff\xf1",
    ],
)
def test_what_is_no_command_has_no_effect(unknown: bytes) -> None:
    spoken = Spoken(unknown + b"$01M\r")

    assert (spoken.heard, spoken.uart) == (b"!017018\r", Uart())


# --- in the order in which it was sent --------------------------------------------------------------------------------


def test_what_comes_before_a_setting_is_heard_before_it_applies() -> None:
    faster, value = command(1, (19200).to_bytes(4)), (19200).to_bytes(4)

    assert Spoken(b"$01M\r" + faster).heard == b"!017018\r" + command(101, value)
    assert Spoken(faster + b"$01M\r").heard == command(101, value)


def test_two_settings_in_one_segment_apply_one_after_the_other() -> None:
    slower, faster = (command(1, rate.to_bytes(4)) for rate in (9600, 19200))

    heard = Spoken(faster + b"$01M\r" + slower + b"$01M\r" + faster + b"$01M\r").heard

    assert heard.count(b"!017018\r") == 1


@given(st.lists(st.integers(0, 60), max_size=12))
def test_any_pieces_are_heard_as_the_whole(places: list[int]) -> None:
    sent = b"$01M\r" + command(3, b"\x03") + b"\xff\xfd\x63$01M\r" + command(3, b"\x01") + b"\xff\xff$01M\r"
    cuts = [0, *sorted(places), len(sent)]
    pieces = [sent[first:last] for first, last in pairwise(cuts)]

    assert Spoken(*pieces).heard == Spoken(sent).heard


# --- hosts that do not behave -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "hostile",
    [
        command(1),
        b"\xff\xf0",
        command(3, b"\x63"),
        command(4, b"\x63"),
        b"\xff\xfa" + bytes(1000) + b"\xff\xf0",
        b"\xff\xfa" + bytes(1000) + b"\xff\xfd\x63",
        b"\xff\xfa\x2c\xff\xfa\x2c\xff\xf0",
        b"\xff\xfd\x63" * 100,
    ],
    ids=["short", "end only", "parity", "stop bits", "long", "without an end", "twice", "unknown option"],
)
def test_a_host_that_does_not_speak_rfc_2217_is_not_hung_up_on(hostile: bytes) -> None:
    with running(RFC_2217, I_7018) as here, connected(here) as opened:
        opened.sendall(hostile + b"$01M\r")
        heard = b""
        while not heard.endswith(b"!017018\r"):
            received = opened.recv(1000)
            assert received
            heard += received


def test_what_is_negotiated_with_a_host_that_does_not_read_is_not_kept() -> None:
    async def negotiate() -> int:
        network = Network()
        connection = Rfc2217Connection(Simulator([I_7018]), "host", set())
        connection.connection_made(network)
        connection.receive(command(1, (9600).to_bytes(4)) * 10_000)
        return network.unread

    assert asyncio.run(negotiate()) < (1 << 16) + 100


@pytest.mark.no_cover
def test_a_subnegotiation_without_an_end_is_not_kept() -> None:
    async def negotiate() -> Any:
        connection = Rfc2217Connection(Simulator([I_7018]), "host", set())
        connection.connection_made(Network())
        connection.receive(b"\xff\xfa" + bytes(1_000_000))
        return connection

    kept = asyncio.run(negotiate())._telnet._content  # noqa: SLF001 - memory is nobody's business else

    assert len(kept) <= LONGEST_SUBNEGOTIATION + 1


@given(
    st.lists(st.sampled_from([b"\xff", b"\xfa", b"\xf0", b"\xfd", b"\x2c", b"\x05", b"\x03"]) | st.binary(max_size=9))
)
def test_any_bytes_are_taken(pieces: list[bytes]) -> None:
    spoken = Spoken(*pieces)

    assert len(spoken.heard) <= 100 + 20 * sum(map(len, pieces))


def test_pyserial_gets_the_modem_state_and_can_change_settings() -> None:
    with running(RFC_2217, I_7018) as here, port(here, "rfc2217", baudrate=19200) as opened:
        opened.timeout = 0.1
        unheard = ask(opened, b"$01M\r", 8)
        opened.baudrate = 9600
        opened.timeout = 2

        assert (unheard, ask(opened, b"$01M\r", 8)) == (b"", b"!017018\r")
        assert (opened.cts, opened.dsr, opened.ri, opened.cd) == (True, True, False, True)
