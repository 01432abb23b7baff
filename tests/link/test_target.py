"""What targets open, and what they say if they cannot."""

import os
import pty
import socket
import sys
from collections.abc import Iterator
from contextlib import closing, contextmanager
from typing import Any

import pytest
import serial
from serial.rs485 import RS485Settings
from serial.tools.list_ports_common import ListPortInfo

from i7000 import BaudRate, CharacterFormat, InvalidValueError, LineSettings, Unit
from i7000.device import Signals
from i7000.link import LinkError, ProcessPort, VirtualPort, open_target
from i7000.simulator.faults import Faults
from tests.simulator.running import I_7018, RFC_2217, SAID, TRANSPORTS, running

LINE = LineSettings(BaudRate.BAUD_19200, CharacterFormat.E81)


def refusal(text: str, **options: Any) -> str:
    """The error of a target, which has one line and names it."""
    with pytest.raises((LinkError, InvalidValueError)) as raised:
        open_target(text, **options)
    said = str(raised.value)
    assert "\n" not in said
    return said


@contextmanager
def pseudo_terminal() -> Iterator[str]:
    far, near = pty.openpty()
    try:
        yield os.ttyname(near)
    finally:
        os.close(far)
        os.close(near)


# --- serial ports -----------------------------------------------------------------------------------------------------


def test_a_device_is_opened_with_the_settings_of_the_line_for_this_program_alone() -> None:
    with pseudo_terminal() as path, closing(open_target(path, LINE)) as port:
        assert isinstance(port, serial.Serial)
        assert (port.port, port.baudrate, port.parity, port.stopbits, port.exclusive) == (path, 19200, "E", 1, True)
        assert refusal(path).startswith(f"{path}: another program uses it; ")


@pytest.mark.parametrize("text", ["localhost:5020", "192.168.0.7:10001", "[::1]:5020"])
def test_a_host_and_port_without_a_scheme_is_an_error_that_names_the_schemes(text: str) -> None:
    assert refusal(text).endswith(f"; for a host and port, write socket://{text} or rfc2217://{text}")


def test_a_device_that_does_not_exist_is_an_error_with_those_that_do(monkeypatch: pytest.MonkeyPatch) -> None:
    def listed(count: int) -> None:
        monkeypatch.setattr(
            "serial.tools.list_ports.comports", lambda: [ListPortInfo(f"COM{number}") for number in range(count)]
        )

    listed(0)
    assert refusal("/dev/no") == (
        "/dev/no: No such file or directory; there are no serial ports here, but a target can also be a device such as "
        "/dev/ttyUSB0 or COM3, socket://HOST:PORT, rfc2217://HOST:PORT, sim:MODEL or exec:COMMAND"
    )
    listed(2)
    assert refusal("/dev/no").endswith("; the serial ports here are COM0, COM1")
    listed(9)
    assert refusal("/dev/no").endswith("COM6, COM7, ...")


def test_an_undefined_baud_rate_is_an_error() -> None:
    with pytest.raises(InvalidValueError, match=r"baud_rate cannot be '3F': 03\.\.0A"):
        open_target("/dev/ttyUSB0", LineSettings(0x3F))


def test_a_file_that_is_no_serial_port_is_an_error() -> None:
    assert refusal("/dev/null").startswith("/dev/null: Inappropriate ioctl for device; ")


def test_the_direction_by_rts_is_an_error_where_the_driver_cannot_do_it() -> None:
    with pseudo_terminal() as path:
        assert refusal(path, rs485=RS485Settings()).startswith(f"{path}: ")
        with closing(open_target(path)):
            pass


def test_the_direction_by_rts_is_set_where_the_user_asks_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    settings = RS485Settings()
    monkeypatch.setattr(serial.Serial, "_set_rs485_mode", lambda _, given: applied.append(given))
    applied: list[RS485Settings] = []

    with pseudo_terminal() as path, closing(open_target(path, rs485=settings)):
        assert set(applied) == {settings}


# --- URLs -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("scheme", ["socket", "rfc2217"])
def test_a_simulator_on_the_network_is_opened(scheme: str) -> None:
    transport = TRANSPORTS[scheme]
    with running(transport, I_7018) as here, closing(open_target(f"{scheme}://{here.place}")) as port:
        port.timeout = 30.0
        port.write(b"#01\r")

        assert port.read(len(SAID)) == SAID


def test_a_timeout_of_rfc_2217_negotiates_nothing_and_a_baud_rate_does(monkeypatch: pytest.MonkeyPatch) -> None:
    negotiated: list[int] = []
    original = vars(serial.rfc2217.Serial)["_reconfigure_port"]

    def counted(self: Any) -> None:
        negotiated.append(self.baudrate)
        original(self)

    monkeypatch.setattr(serial.rfc2217.Serial, "_reconfigure_port", counted)
    with running(RFC_2217, I_7018) as here, closing(open_target(f"rfc2217://{here.place}")) as port:
        for seconds in (0.1, 0.2, 0.3):
            port.timeout = seconds
        port.baudrate = 19200

    assert negotiated == [9600, 19200]


@pytest.mark.parametrize("scheme", ["socket", "rfc2217"])
def test_a_network_port_that_nobody_listens_at_is_an_error(scheme: str) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        place = f"{scheme}://127.0.0.1:{server.getsockname()[1]}"

    assert refusal(place) == f"{place}: Connection refused"


def test_a_loop_returns_what_is_written() -> None:
    with closing(open_target("loop://")) as port:
        port.timeout = 1.0
        port.write(b"$012\r")

        assert port.read(5) == b"$012\r"


@pytest.mark.parametrize(
    "text",
    ["tcp://127.0.0.1:5020", "socket://:5020", "rfc2217://localhost", "socket://localhost:http", "socket://[::1"],
)
def test_a_url_that_is_none_of_pyserial_is_an_error_with_those_that_are(text: str) -> None:
    assert refusal(text) == (
        f"target cannot be '{text}': a device such as /dev/ttyUSB0 or COM3, socket://HOST:PORT, "
        "rfc2217://HOST:PORT, sim:MODEL or exec:COMMAND"
    )


def test_a_url_that_matches_no_port_is_an_error() -> None:
    assert refusal("hwgrep://no_such") == "hwgrep://no_such: no ports found matching regexp 'no_such'"


@pytest.mark.parametrize("text", ["", " "])
def test_an_empty_target_is_an_error_with_the_forms(text: str) -> None:
    assert refusal(text).endswith("sim:MODEL or exec:COMMAND")


# --- simulated modules ------------------------------------------------------------------------------------------------


def answer(port: Any, request: bytes) -> bytes:
    port.timeout = 1.0
    port.write(request)
    return bytes(port.read(1000))


def test_simulated_modules_have_addresses_in_order_and_their_settings() -> None:
    port = open_target("sim:I-7018@B2.9,type=K + M-7017,protocol=dcon+m-7019R,protocol=dcon,address=10,cjc_offset=+0.5")

    assert isinstance(port, VirtualPort)
    assert answer(port, b"$012\r") == b"!010F0600\r"
    assert answer(port, b"$02M\r") == b"!027017\r"
    assert answer(port, b"$0AM\r") == b"!0A7019R\r"
    assert port.now() == 3.0


def test_simulated_modules_have_the_line_settings_of_the_line() -> None:
    assert answer(open_target("sim:I-7018", LINE), b"$01M\r") == b""
    assert answer(open_target("sim:I-7018,baud=19200,character_format=E81", LINE), b"$01M\r") == b"!017018\r"


def test_simulated_modules_have_faults_signals_and_the_init_switch() -> None:
    options: dict[str, Any] = {"faults": Faults(echo=True), "signals": [Signals.of(Unit.VOLT, 1.5)], "seed": 7}

    assert answer(open_target("sim:I-7018", **options), b"#010\r") == b"#010\r>+1.5000\r"
    assert answer(open_target("sim:I-7018,address=5", init_switch=True), b"$002\r")[:3] == b"!05"
    assert answer(open_target("sim:I-7018,address=5,init=true"), b"$002\r")[:3] == b"!05"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("sim:", "target cannot be 'sim:': module '': there is no model ''"),
        ("sim:FOO", "module FOO: there is no model 'FOO'; models have names such as I-7017, M-7018R and M-7019Z"),
        ("sim:I-7020", "target cannot be 'sim:I-7020': module I-7020: there is no model 'I-7020'; did you mean I-7018"),
        ("sim:I-7018,typ=K", "a module has no setting 'typ'"),
    ],
)
def test_a_module_that_does_not_exist_is_an_error(text: str, reason: str) -> None:
    assert reason in refusal(text)


@pytest.mark.parametrize(
    ("text", "option", "kinds"),
    [
        ("/dev/ttyUSB0", {"seed": 1}, "sim"),
        ("loop://", {"rs485": RS485Settings()}, "device"),
        ("exec:cat", {"signals": []}, "sim"),
        ("loop://", {"init_switch": True}, "sim or exec"),
    ],
)
def test_an_option_of_another_target_is_an_error(text: str, option: dict[str, Any], kinds: str) -> None:
    assert refusal(text, **option).endswith(f": for {kinds} targets only, not for {text}")


# --- processes --------------------------------------------------------------------------------------------------------


def test_a_process_is_started_with_its_arguments() -> None:
    script = "import os; print(os.environ['I7000_INIT'], flush=True)"
    for switch in (False, True):
        text = f'exec:{sys.executable} -c "{script}"'
        with closing(open_target(text, init_switch=switch)) as port:
            port.timeout = 30.0

            assert isinstance(port, ProcessPort)
            assert port.read(2) == (b"1\n" if switch else b"0\n")


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("exec:", "target cannot be 'exec:': exec:COMMAND, such as exec:./module"),
        ("exec:'cat", 'target cannot be "exec:\'cat": No closing quotation: a command as a shell reads it'),
        ("exec:/no/such/program", "exec:/no/such/program: No such file or directory"),
    ],
)
def test_a_command_that_cannot_be_started_is_an_error(text: str, reason: str) -> None:
    assert refusal(text) == reason
