"""``i7000 proxy`` in front of simulated modules."""

import errno
import io
import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from threading import Event, Thread
from typing import Any

import pytest
import serial

from i7000 import Model
from i7000.cli import proxying
from i7000.cli.outlet import Outlet
from i7000.cli.proxying import carried_line
from i7000.cli.text import Printer
from i7000.recording.records import Carried
from i7000.simulator import Simulated, default_sources, simulate
from tests.simulation import MAIN, free_port, process, talk
from tests.simulator.running import I_7018, module
from tests.terminal import Run, Told
from tests.test_cli_control import said
from tests.waiting import ENOUGH, until


def proxied(
    run: Run, target: str, *arguments: str, control: Path, meanwhile: Callable[[], object], end: bytes = b"quit\n"
) -> Told:
    """Call the command, do something when it listens for commands, and end it."""

    ended = Event()

    def do() -> None:
        until(lambda: ended.is_set() or control.is_socket())
        if ended.is_set():
            return
        try:
            meanwhile()
        finally:
            if end:
                said(control, end)

    doing = Thread(target=do)
    doing.start()
    try:
        return run("proxy", target, "--control", str(control), *arguments)
    finally:
        ended.set()
        doing.join()


def test_a_driver_talks_to_the_target_through_faults_that_change(run: Run, tmp_path: Path) -> None:
    port, control = free_port(), tmp_path / "sock"
    url = f"socket://127.0.0.1:{port}"
    heard: list[bytes] = []

    def meanwhile() -> None:
        heard.extend(talk(url, b"$01M\r"))
        heard.append(said(control, b"fault refuse=1@01\nsignal 0=1V\n"))
        heard.extend(talk(url, b"$01M\r", b"$02M\r"))

    with simulate(I_7018, module(Model.I_7017, address=2)) as running:
        told = proxied(
            run, running, "--tcp", str(port), "--fault", "duplicate=1@02", "--view", "lines",
            control=control, meanwhile=meanwhile,
        )  # fmt: skip

    answered, *answers = heard[0], heard[1].splitlines()[0], *heard[2:]
    assert answered == b"!017018\r"
    assert answers == [b"ok duplicate=1@02h refuse=1@01h", b"?01\r", b"!027017\r"]
    assert heard[1].splitlines()[1].startswith(b"error: 'signal' is not a command; commands are fault")
    place, *lines = told.out.splitlines()
    assert (told.code, told.err, place) == (0, "", url)
    assert [re.sub(r"^ +\d+\.\d{3}  ", "", line) for line in lines] == [
        "-> $01M", "<- !017018", "-> $01M", "<- ?01  [refused]", "-> $02M",
        r"<- !027017\r!027017  [sent twice]",
    ]  # fmt: skip


def test_rfc_2217_sets_the_line_of_the_target(run: Run, tmp_path: Path) -> None:
    outer = free_port()
    heard: list[bytes] = []
    eeprom = module(Model.I_7018).eeprom

    def meanwhile() -> None:
        opened: Any = serial.serial_for_url(f"rfc2217://127.0.0.1:{outer}", timeout=0.5, baudrate=19200)
        with opened:
            opened.write(b"$01M\r")
            heard.append(opened.read(8))
            opened.timeout, opened.baudrate = ENOUGH, 9600
            opened.write(b"$01M\r")
            heard.append(opened.read_until(b"!017018\r")[-8:])

    with simulate(Simulated(eeprom, default_sources(eeprom)), over="rfc2217") as running:
        told = proxied(run, running, "--rfc2217", str(outer), control=tmp_path / "sock", meanwhile=meanwhile)

    assert (told.code, told.err) == (0, "")
    assert heard[0] != b"!017018\r"
    assert heard[1] == b"!017018\r"


def test_a_pseudo_terminal_is_the_default(run: Run, tmp_path: Path) -> None:
    with simulate(I_7018, over="socket") as running:
        told = proxied(run, running, control=tmp_path / "sock", meanwhile=lambda: None)

    assert re.fullmatch(r"/dev/\S+\n", told.out)


def test_a_target_that_cannot_be_opened_is_no_link(run: Run) -> None:
    told = run("proxy", f"socket://127.0.0.1:{free_port()}", "--tcp", "0")

    assert (told.code, told.out) == (3, "")
    assert re.match(r"i7000: socket://127\.0\.0\.1:\d+: ", told.err)


def test_a_target_that_is_gone_is_no_link(run: Run, tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:

        def leave() -> None:
            server.accept()[0].close()

        target = f"socket://127.0.0.1:{server.getsockname()[1]}"
        told = proxied(run, target, "--tcp", "0", control=tmp_path / "sock", meanwhile=leave, end=b"")

    assert told.code == 3
    assert told.err.startswith("i7000: ")


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 0)])
def test_a_signal_ends_it(run: Run, tmp_path: Path, number: signal.Signals, code: int) -> None:
    with simulate(I_7018, over="socket") as running:
        told = proxied(
            run, running, "--tcp", "0", control=tmp_path / "sock",
            meanwhile=lambda: os.kill(os.getpid(), number), end=b"",
        )  # fmt: skip

    assert (told.code, told.err) == (code, "")


def test_it_needs_no_control(run: Run) -> None:
    port = free_port()

    def talk_and_end() -> None:
        heard.extend(talk(f"socket://127.0.0.1:{port}", b"$01M\r"))
        os.kill(os.getpid(), signal.SIGTERM)

    heard: list[bytes] = []
    ending = Thread(target=talk_and_end)
    with simulate(I_7018, over="socket") as url:
        ending.start()
        told = run("proxy", url, "--tcp", str(port))
        ending.join()

    assert (told.code, heard) == (0, [b"!017018\r"])


def test_lines_that_nobody_reads_are_dropped() -> None:
    class Unread(Outlet):
        def skip(self, lines: int) -> bool:  # noqa: ARG002
            return True

    out = Unread(io.StringIO())
    try:
        assert proxying._show(Printer(), out, Carried(0.1, b"#01\r")) is None  # type: ignore[func-returns-value] # noqa: SLF001
    finally:
        out.close()


def test_commands_come_from_standard_input_too(run: Run) -> None:
    with simulate(I_7018, over="socket") as running:
        told = run("proxy", running, "--tcp", "0", "--control", "-", stdin=b"fault late=0.1\nquit\n")

    assert told.code == 0
    assert told.out.splitlines()[1:] == ["ok late=0.1:0.3", "ok"]


def test_an_output_that_cannot_be_written_is_a_failure(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    class Full(io.StringIO):
        def write(self, text: str) -> int:  # noqa: ARG002
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("sys.stdout", Full())
    with simulate(I_7018, over="socket") as running:
        told = run("proxy", running, "--tcp", "0", "--control", "-", stdin=b"fault\n")

    assert told.code == 2


@pytest.mark.parametrize(
    ("arguments", "said_"),
    [
        ((" ",), "target cannot be"),
        (("sim:I-7018",), "i7000 simulate --fault"),
        (("/dev/null", "--fault", "x"), "there is no fault 'x'"),
        (("/dev/null", "--character-format", "N8"), "N8"),
        (("/dev/null", "--baud", "0"), "--baud 0"),
        (("/dev/null", "--tcp", "x"), "is not [HOST:]PORT"),
    ],
)
def test_wrong_usage_is_explained(run: Run, arguments: tuple[str, ...], said_: str) -> None:
    told = run("proxy", *arguments)

    assert (told.code, told.out) == (2, "")
    assert said_ in told.err


def test_a_simulator_process_is_proxied_by_another_process() -> None:
    pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    command = [sys.executable, "-c", MAIN, "proxy"]
    with process("--model", "I-7018", "--tcp", "0", **pipes) as simulator:
        assert simulator.stdout
        target = simulator.stdout.readline().strip()
        arguments = [*command, target, "--fault", "refuse=1", "--control", "-"]
        with subprocess.Popen(arguments, **pipes) as proxy:  # noqa: S603 - ourselves
            assert proxy.stdout
            path = proxy.stdout.readline().strip()
            refused = talk(path, b"$01M\r")
            out, _ = proxy.communicate("fault off\nquit\n", timeout=ENOUGH)

    assert refused == [b"?01\r"]
    assert (out, proxy.returncode) == ("ok off\nok\n", 0)


# --- lines ------------------------------------------------------------------------------------------------------------


def test_dcon_is_shown_as_text_and_other_bytes_in_hex() -> None:
    carried = [
        Carried(0.1, b"$012\r", sent=True),
        Carried(0.2, b"!010F0600\r", sent=False, notes=("late by 0.3 s",)),
        Carried(0.3, bytes.fromhex("01 04 00 00 00 01 31 CA"), sent=True),
        Carried(0.4, b"\xff\r", sent=False),
    ]
    lines = [carried_line(it).plain for it in carried]

    assert lines == [
        "     0.100  -> $012",
        "     0.200  <- !010F0600  [late by 0.3 s]",
        "     0.300  -> 01 04 00 00 00 01 31 CA",
        "     0.400  <- FF 0D",
    ]
