"""pyserial on a pseudo-terminal and by RFC 2217: dialogues in DCON, by hand, most of them those of the manual."""

from collections.abc import Sequence
from time import sleep
from typing import Any

import pytest
import serial

from i7000 import BaudRate, CharacterFormat, DataFormat, LineSettings, Model, Protocol, ReportSettings, TypeCode, Unit
from i7000.simulator.pseudo_terminal import open_pty
from i7000.simulator.simulator import Simulated
from tests.interop.scenes import ONE_BUS, SAID_BY_7018, connected
from tests.simulator.running import RFC_2217, Transport, module, port, running

TRANSPORTS: dict[str, Transport] = {"pty": open_pty, "rfc2217": RFC_2217}

MILLIVOLTS = connected(Unit.MILLIVOLT, (25.12, 20.45, 12.78, 18.97, 3.24, 15.35, 8.07, 14.79), 31.2)
SAID = "+025.12+020.45+012.78+018.97+003.24+015.35+008.07+014.79"
BLANK = " " * 7
IN_HEX = ReportSettings(DataFormat.HEX)


def words_of_ten_volts(*words: int) -> Any:
    """Voltages that have these words, 10 V being 7FFF (A.5)."""
    return connected(Unit.VOLT, [word * 10 / 32767 if word < 0x8000 else (word - 65536) * 10 / 32768 for word in words])


I_7018 = module(Model.I_7018, "A2.0", sources=MILLIVOLTS)
M_7019R = module(Model.M_7019R, sources=MILLIVOLTS, type_codes=(TypeCode.MV_100,) * 8)

DIALOGUES: dict[str, tuple[Sequence[Simulated], str]] = {
    "2.1 configuration": (
        [I_7018],
        """
        %0102000600 -> !02
        $012 ->
        %0202000602 -> !02
        $022 -> !02000602
        %0202000A02 -> ?02
        %0202000642 -> ?02
        $022 -> !02000602
        """,
    ),
    "2.2, 2.12 synchronized sampling": (
        [M_7019R],
        f"""
        $014 -> ?01
        #** ->
        $014 -> >011{SAID}
        $014 -> >010{SAID}
        """,
    ),
    "2.3 all channels": (
        [
            M_7019R,
            module(
                Model.I_7017,
                sources=words_of_ten_volts(0x4C53, 0x2628, 0xE2D6, 0x83A2, 0x0F2A, 0xDBA1, 0x6284, 0xBA71),
                address=2,
                report_settings=IN_HEX,
            ),
            module(
                Model.M_7018,
                sources=connected(Unit.CELSIUS, [-300] * 8),
                address=3,
                type_codes=(TypeCode.K,) * 8,
            ),
            module(
                Model.M_7019R,
                sources=connected(Unit.VOLT, (2.5, -5.0, -10.0, 0, 0, 0, 0, 7.5)),
                address=0xA4,
                channel_mask=0xFB,
                report_settings=ReportSettings(DataFormat.PERCENT),
            ),
        ],
        f"""
        #01 -> >{SAID}
        #02 -> >4C532628E2D683A20F2ADBA16284BA71
        #03 -> >-9999.9-9999.9-9999.9-9999.9-9999.9-9999.9-9999.9-9999.9
        #A4 -> >+025.00-050.00{BLANK}+000.00+000.00+000.00+000.00+075.00
        #a4 ->
        #05 ->
        """,
    ),
    "2.4 one channel": (
        [
            module(
                Model.I_7018,
                sources=connected(Unit.MILLIVOLT, (1, 2, 25.13)),
                address=3,
                type_codes=(TypeCode.MV_100,) * 8,
            ),
            module(Model.I_7017, address=2),
            module(
                Model.I_7017Z,
                sources=connected(Unit.MILLIVOLT, (0,) * 17 + (25.13,)),
                address=5,
                single_ended=True,
                type_codes=(TypeCode.MV_150,) * 20,
            ),
        ],
        """
        #032 -> >+025.13
        #0511 -> >+025.13
        #0514 -> ?05
        #029 -> ?02
        """,
    ),
    "2.5, 2.6, 2.31 calibration": (
        [I_7018],
        """
        $010 -> ?01
        ~01E1 -> !01
        $010 -> !01
        $011 -> !01
        ~01E0 -> !01
        $011 -> ?01
        """,
    ),
    "2.7 to 2.9, 2.27, 2.28 calibration of one channel": (
        [module(Model.M_7017mC_16), module(Model.M_7019R, address=2), module(Model.I_7019R, address=3)],
        """
        ~01E1 -> !01
        $010C0 -> !01
        ~02E1 -> !02
        $020C5 -> !02
        $021C5 -> !02
        $030C1 -> ?03
        $031C1 -> ?03
        $02S0 -> !02
        $02S1 -> !02
        """,
    ),
    "2.10 configuration": (
        [I_7018, module(Model.M_7018, address=2, type_codes=(TypeCode.MV_500_03,) * 8, report_settings=IN_HEX)],
        """
        $012 -> !01050600
        $022 -> !02030602
        """,
    ),
    "2.11, 2.17, 2.18, 2.20, 2.21, 2.29, 2.30 cold junction": (
        [I_7018, module(Model.M_7019R, address=2, sources=MILLIVOLTS)],
        """
        $013 -> >+0031.2
        $019+0010 -> !01
        $019 -> !01+0010
        $013 -> >+0031.4
        $019+1001 -> ?01
        $019-1000 -> !01
        $013 -> >-0009.8
        ~01C -> !011
        ~01C0 -> !01
        ~01C -> !010
        $01A ->
        $02A -> !021
        $02A0 -> !02
        $02A -> !020
        $02A1 -> !02
        $023 -> >+0031.2
        """,
    ),
    "2.13, 2.14 channels": (
        [M_7019R, module(Model.M_7017Z, address=2, single_ended=True), module(Model.M_7017mC_16, address=3)],
        f"""
        $0153A -> !01
        $016 -> !013A
        #01 -> >{BLANK}+020.45{BLANK}+018.97+003.24+015.35{BLANK}{BLANK}
        $026 -> !020FFFFF
        $025000001 -> !02
        $026 -> !02000001
        $025100000 -> ?02
        $0358001 -> !03
        $036 -> !038001
        """,
    ),
    "2.15, 2.16 types": (
        [M_7019R, module(Model.M_7019R, address=2), module(Model.M_7019R, address=3)],
        """
        $018C0 -> !01C0R02
        $017C0R03 -> !01
        $018C0 -> !01C0R03
        $027C5R16 -> !02
        $037C1R30 -> ?03
        $018C8 -> ?01
        """,
    ),
    "2.19 all channels in hex": (
        [
            module(
                Model.I_7017,
                sources=words_of_ten_volts(0x0000, 0x0123, 0x0125, 0x7FFF, 0x1802, 0x744F, 0x9823, 0x8124),
            )
        ],
        "$01A -> >0000012301257FFF1802744F98238124",
    ),
    "2.22, 2.40, 2.41 diagnosis": (
        [
            module(
                Model.M_7019R,
                sources=connected(Unit.CELSIUS, (None, *(20.0,) * 7)),
                type_codes=(TypeCode.J,) * 8,
            )
        ],
        """
        ~01EO -> !011
        $01B -> !0101
        #010 -> >+9999.9
        ~01EO0 -> !01
        ~01EO -> !010
        $01B -> !0100
        """,
    ),
    "2.23, 2.24, 2.33 identity": (
        [I_7018],
        """
        $01F -> !01A2.0
        $01M -> !017018
        ~01O7019A -> !01
        $01M -> !017019A
        """,
    ),
    "2.25, 2.26 protocol": (
        [M_7019R],
        """
        $01P -> !0110
        $01P1 -> ?01
        """,
    ),
    "2.26, A.1 protocol in INIT mode": (
        [module(Model.M_7019R, init_switch=True, address=0x21)],
        """
        $21P ->
        $00P -> !0010
        $00P1 -> !00
        $00P -> !0011
        """,
    ),
    "2.32, 2.34 soft INIT": (
        [M_7019R],
        """
        ~01I -> !01
        %0101000640 -> ?01
        ~01T3D -> ?01
        ~01T10 -> !01
        ~01I -> !01
        $01M -> !017019R
        %0101000640 -> ?01
        ~01I -> !01
        %0101000640 -> !01
        $012 ->
        $012B7 -> !01020640AE
        """,
    ),
    "2.35, 2.38, 2.39 watchdog": (
        [I_7018],
        """
        ~012 -> !01000
        ~013164 -> !01
        ~** ->
        ~012 -> !01164
        ~010 -> !0180
        ~0131FF -> !01
        ~012 -> !011FF
        """,
    ),
    "2.42, 2.43 connecting mode": (
        [module(Model.M_7017Z), I_7018],
        """
        @01S -> !010
        @01S1 -> !01
        @01S -> !011
        """,
    ),
    "2 checksum": (
        [
            module(
                Model.I_7018,
                sources=connected(Unit.VOLT, (1.5, -1.0, 0.25, 0, 0, 0, 0, 2.5)),
                report_settings=ReportSettings(checksum=True),
            )
        ],
        """
        $012B7 -> !01050640B1
        #0184 -> >+1.5000-1.0000+0.2500+0.0000+0.0000+0.0000+0.0000+2.50009D
        $012 ->
        $012B8 ->
        $012b7 ->
        $01MD2 -> !01701852
        %010205064017 -> !0283
        #0285 -> >+1.5000-1.0000+0.2500+0.0000+0.0000+0.0000+0.0000+2.50009D
        %02020506421A -> !0283
        #0285 -> >4CCCCCCD0CCD00000000000000007FFF4B
        #028BD -> ?02A1
        ~02OBADF7 ->
        ~02OBADF6 -> !0283
        $02MD3 -> !02BAD4A
        """,
    ),
}  # fmt: skip


def said(opened: serial.Serial, sent: str, *, silence: bool = False) -> str:
    """What comes back, without its carriage return; where silence is expected, what comes in a tenth of a second."""
    opened.write(f"{sent}\r".encode())
    if silence:
        sleep(0.1)
    heard = (opened.read(opened.in_waiting) if silence else opened.read_until(b"\r")).decode("latin-1")
    assert heard[-1:] in ("", "\r")
    return heard[:-1]


def dialogue(lines: str) -> list[tuple[str, str]]:
    pairs = [line.lstrip(" ").partition(" ->")[::2] for line in lines.split("\n") if line.strip()]
    return [(sent, answer.removeprefix(" ")) for sent, answer in pairs]


BY_BOTH = ("2.2, 2.12 synchronized sampling", "2.3 all channels", "2.32, 2.34 soft INIT", "2 checksum")
"""Dialogues that are held by RFC 2217 too, where it takes long to open a port."""
every_port = pytest.mark.parametrize("scheme", TRANSPORTS)


@pytest.mark.parametrize(
    ("scheme", "name"), [*(("pty", name) for name in DIALOGUES), *(("rfc2217", name) for name in BY_BOTH)]
)
def test_modules_answer_as_the_manual_says(scheme: str, name: str) -> None:
    modules, lines = DIALOGUES[name]
    expected = dialogue(lines)
    with running(TRANSPORTS[scheme], *modules) as here, port(here, scheme) as opened:
        heard = [(sent, said(opened, sent, silence=not answer)) for sent, answer in expected]

    assert expected == heard


def test_the_watchdog_notices_that_the_host_is_silent() -> None:
    with running(open_pty, I_7018) as here, port(here, "pty") as opened:
        set_to_half_a_second = said(opened, "~013105")
        for _ in range(3):
            sleep(0.2)
            opened.write(b"~**\r")
        fed = said(opened, "~010")
        sleep(0.7)

        assert [said(opened, sent) for sent in ("~010", "~011", "~010")] == ["!0104", "!01", "!0100"]
        assert (set_to_half_a_second, fed) == ("!01", "!0180")


@every_port
def test_modules_of_both_protocols_share_a_line(scheme: str) -> None:
    """What the ones send and hear is nothing to the others."""
    read_two_words_of_module_1 = b"\x01\x04\x00\x00\x00\x02\x71\xcb"
    with running(TRANSPORTS[scheme], *ONE_BUS) as here, port(here, scheme) as opened:
        for _ in range(20):
            opened.write(b"#07\r")
            inputs = opened.read_until(b"\r")
            opened.write(read_two_words_of_module_1)
            words = opened.read(9)

            assert inputs == SAID_BY_7018
            assert words[:7] == b"\x01\x04\x04\x13\x33\xe0\x00"


# --- RFC 2217: the line settings are those of the host ----------------------------------------------------------------


def test_a_module_that_is_spoken_to_at_another_speed_says_nothing() -> None:
    fast = module(Model.I_7017, address=2, line_settings=LineSettings(BaudRate.BAUD_115200))
    answers = {(9600, "01"): "!017018", (115200, "02"): "!027017"}
    heard = {}
    with running(RFC_2217, I_7018, fast) as here, port(here, "rfc2217", baudrate=19200) as opened:
        for rate in (19200, 9600, 115200, 57600):
            opened.baudrate = rate
            for address in ("01", "02"):
                heard[rate, address] = said(opened, f"${address}M", silence=(rate, address) not in answers)

    assert {key: answer for key, answer in heard.items() if answer} == answers


def test_a_module_with_parity_hears_hosts_with_the_same() -> None:
    even = module(Model.I_7018, line_settings=LineSettings(BaudRate.BAUD_9600, CharacterFormat.E81))
    heard = {}
    with running(RFC_2217, even) as here, port(here, "rfc2217") as opened:
        for parity in "NEO":
            opened.parity = parity
            heard[parity] = said(opened, "$01M", silence=parity != "E")

    assert heard == {"N": "", "E": "!017018", "O": ""}


def test_the_baud_rate_changes_after_the_answer_to_a_soft_init() -> None:
    """The dialogue of 2.34; who comes back at the new speed is answered."""
    with running(RFC_2217, M_7019R) as here:
        with port(here, "rfc2217", baudrate=9600) as opened:
            sent = ("~01I", "%0101000700", "~01T10", "~01I", "%0101000700")
            heard = [said(opened, command) for command in sent]
            too_slow = said(opened, "$01M", silence=True)
        with port(here, "rfc2217", baudrate=19200) as opened:
            configuration = said(opened, "$012")

    assert heard == ["!01", "?01", "!01", "!01", "!01"]
    assert too_slow == ""
    assert configuration == "!01020700"


def test_in_init_mode_a_module_has_the_factory_line_and_reports_its_stored_settings() -> None:
    """It speaks DCON at 9600 with address 00, and tells 115200 and, with the checksum set, its address (A.1)."""
    lost = module(
        Model.M_7018,
        address=0x37,
        init_switch=True,
        line_settings=LineSettings(BaudRate.BAUD_115200),
        report_settings=ReportSettings(checksum=True),
        protocol=Protocol.MODBUS_RTU,
    )
    with running(RFC_2217, lost) as here, port(here, "rfc2217", baudrate=9600) as opened:
        heard = [said(opened, sent) for sent in ("$002", "%0001050600", "$002")]

    assert heard == ["!37050A40", "!01", "!01050600"]
