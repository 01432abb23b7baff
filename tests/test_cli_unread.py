"""``i7000 simulate`` as a process whose output nobody reads, or whose resources are used up: it goes on, and ends."""

import os
import pty
import resource
import select
import signal
import socket
import subprocess
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, suppress
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import pytest

from tests.simulation import process as started_process
from tests.waiting import ENOUGH, until

MODEL = ("--model", "I-7018", "--signal", "all=1.5V")
SAID = b">" + b"+1.5000" * 8 + b"\r"
XTERM = os.environ | {"TERM": "xterm"}
AT_ONCE = 100
PROMPTLY = 3.0
"""Seconds, on a machine that has much else to do."""


def process(*arguments: str, **others: Any) -> AbstractContextManager["subprocess.Popen[bytes]"]:
    return started_process(*MODEL, *arguments, bufsize=0, **others)


def place(line: bytes) -> tuple[str, int]:
    """The address in a line such as ``socket://127.0.0.1:5020``."""
    host, _, number = line.decode().strip().rpartition("/")[2].rpartition(":")
    return host, int(number)


def first_line(descriptor: int, begins: bytes = b"://") -> bytes:
    """Read until there is a line that begins so, and no further than that line."""
    heard = b""
    deadline = monotonic() + ENOUGH
    while not (heard.endswith(b"\n") and begins in heard):
        assert select.select([descriptor], [], [], max(0, deadline - monotonic()))[0]
        heard += os.read(descriptor, 1)
    return heard


def asked(host: socket.socket, command: bytes, answer: bytes, times: int) -> None:
    """Have a command answered so many times."""
    for _ in range(0, times, AT_ONCE):
        count = min(times, AT_ONCE)
        host.sendall(command * count)
        heard = b""
        while not heard.endswith(answer * count):
            received = host.recv(4096)
            assert received
            heard += received


def ended(started: "subprocess.Popen[bytes]") -> tuple[int, float]:
    """End it by Ctrl-C, and tell the exit code and how long that took."""
    began = monotonic()
    started.send_signal(signal.SIGINT)
    return started.wait(ENOUGH), monotonic() - began


def read_all(descriptor: int, until: Callable[[bytes], bool] = lambda _: False) -> bytes:
    """Read until something is there, or nothing comes any more."""
    heard = b""
    while not until(heard) and select.select([descriptor], [], [], 1)[0]:
        with suppress(OSError):  # The other end of a pseudo-terminal is gone.
            received = os.read(descriptor, 1 << 16)
            if received:
                heard += received
                continue
        break
    return heard


# --- a pipe -----------------------------------------------------------------------------------------------------------


def test_lines_that_nobody_reads_hold_up_nothing() -> None:
    with process("--tcp", "0", "--view", "lines", stdout=subprocess.PIPE, stderr=subprocess.PIPE) as started:
        assert started.stdout
        assert started.stderr
        with socket.create_connection(place(first_line(started.stdout.fileno())), timeout=ENOUGH) as host:
            asked(host, b"#01\r", SAID, 5_200)
            code, took = ended(started)
        errors = started.stderr.read()

    assert code == 130
    assert took < PROMPTLY
    assert errors.startswith(b"i7000: ")
    assert errors.endswith(b" lines not shown\n")


@pytest.mark.parametrize("again", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_second_signal_does_not_cut_the_end_short(again: signal.Signals) -> None:
    with process("--tcp", "0", "--view", "lines", stdout=subprocess.PIPE, stderr=subprocess.PIPE) as started:
        assert started.stdout
        assert started.stderr
        with socket.create_connection(place(first_line(started.stdout.fileno())), timeout=ENOUGH) as host:
            asked(host, b"#01\r", SAID, 5_200)
            started.send_signal(signal.SIGINT)
            host.settimeout(5)
            assert host.recv(100) == b""  # The simulation has ended, and waits for whoever reads its lines.
            started.send_signal(again)
            code = started.wait(ENOUGH)
        errors = started.stderr.read()

    assert code == 130
    assert errors.endswith(b" lines not shown\n")


def test_a_disk_that_is_full_is_reported_while_the_bus_goes_on(tmp_path: Path) -> None:
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (200, 200))

    shown = tmp_path / "shown.txt"
    with (
        shown.open("wb") as file,
        process("--tcp", "0", "--view", "lines", stdout=file, stderr=subprocess.PIPE, preexec_fn=limit) as started,
    ):
        assert started.stderr
        until(lambda: shown.read_bytes().endswith(b"\n"))
        with socket.create_connection(place(shown.read_bytes()), timeout=ENOUGH) as host:
            asked(host, b"#01\r", SAID, 100)
            errors = first_line(started.stderr.fileno(), b"i7000")
            asked(host, b"#01\r", SAID, 100)
            code, _ = ended(started)
        errors += started.stderr.read()

    assert (code, errors) == (2, b"i7000: the output cannot be written: File too large\n")
    assert len(shown.read_bytes()) == 200


def test_lines_that_were_dropped_are_counted_where_they_would_have_been() -> None:
    with process("--tcp", "0", "--view", "lines", stdout=subprocess.PIPE, stderr=subprocess.PIPE) as started:
        assert started.stdout
        assert started.stderr
        out = started.stdout.fileno()
        with socket.create_connection(place(first_line(out)), timeout=ENOUGH) as host:
            asked(host, b"#01\r", SAID, 5_000)
            shown = read_all(out, lambda heard: b"not shown\n" in heard)
            asked(host, b"$01M\r", b"!017018\r", 1)
            shown += read_all(out, lambda heard: b"!017018" in heard and heard.endswith(b"\n"))
        code, _ = ended(started)
        errors = started.stderr.read()

    lines = shown.splitlines()
    (missed,) = [number for number, line in enumerate(lines) if line.endswith(b" lines not shown")]
    assert missed + int(lines[missed].split()[0]) == 2 * 5_000
    assert b"ReadModuleName" in lines[missed + 1]
    assert (code, errors) == (130, b"")


def test_a_reader_that_is_gone_holds_up_nothing() -> None:
    with process("--tcp", "0", "--view", "lines", stdout=subprocess.PIPE, stderr=subprocess.PIPE) as started:
        assert started.stdout
        assert started.stderr
        with socket.create_connection(place(first_line(started.stdout.fileno())), timeout=ENOUGH) as host:
            started.stdout.close()
            asked(host, b"#01\r", SAID, 100)
            code, _ = ended(started)
        errors = started.stderr.read()

    assert (code, errors) == (130, b"")


# --- a terminal -------------------------------------------------------------------------------------------------------


@contextmanager
def terminal() -> Iterator[tuple[int, int]]:
    """A terminal, from the side of the person and from that of the program."""
    person, program = pty.openpty()
    try:
        yield person, program
    finally:
        os.close(person)
        os.close(program)


@pytest.mark.parametrize("view", ["live", "lines"])
def test_a_terminal_that_is_stopped_holds_up_nothing_and_gets_its_screen_back(view: str) -> None:
    with (
        terminal() as (person, program),
        process("--tcp", "0", "--view", view, stdout=program, stderr=subprocess.PIPE, env=XTERM) as started,
        socket.create_connection(place(first_line(person)), timeout=ENOUGH) as host,
    ):
        asked(host, b"#01\r", SAID, 10)
        os.write(person, b"\x13")
        sleep(0.5)
        before = read_all(person)
        asked(host, b"#01\r", SAID, 5_000)
        held = read_all(person)
        code, took = ended(started)
        after = read_all(person)

    assert (code, held) == (130, b"")
    assert took < PROMPTLY
    assert before.count(b"\x1b[?1049h") == after.count(b"\x1b[?1049l") == (view == "live")
    assert before.count(b"\x1b[?25l") == after.count(b"\x1b[?25h") == (view == "live")


def test_a_terminal_that_goes_on_shows_what_is_there_then() -> None:
    with (
        terminal() as (person, program),
        process("--tcp", "0", stdout=program, stderr=subprocess.PIPE, env=XTERM) as started,
    ):
        with socket.create_connection(place(first_line(person)), timeout=ENOUGH) as host:
            os.write(person, b"\x13")
            asked(host, b"#01\r", SAID, 1_000)
            asked(host, b"$01M\r", b"!017018\r", 1)
            os.write(person, b"\x11")
            shown = read_all(person, lambda heard: b"ReadModuleName" in heard)
        code, _ = ended(started)

    assert b"ReadModuleName" in shown
    assert b"not shown" not in shown
    assert code == 130


def test_a_terminal_that_nobody_reads_holds_up_nothing() -> None:
    with (
        terminal() as (person, program),
        process("--tcp", "0", stdout=program, stderr=subprocess.PIPE, env=XTERM) as started,
        socket.create_connection(place(first_line(person)), timeout=ENOUGH) as host,
    ):
        for _ in range(20):
            asked(host, b"#01\r", SAID, 100)
            sleep(0.1)
        code, took = ended(started)

    assert code == 130
    assert took < PROMPTLY


# --- file descriptors -------------------------------------------------------------------------------------------------


def few_descriptors() -> None:
    resource.setrlimit(resource.RLIMIT_NOFILE, (32, 32))


@pytest.mark.parametrize("scheme", ["--tcp", "--rfc2217"])
def test_without_file_descriptors_connections_wait_and_one_line_says_so(scheme: str) -> None:
    with process(scheme, "0", stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=few_descriptors) as started:
        assert started.stdout
        assert started.stderr
        where = place(first_line(started.stdout.fileno()))
        with socket.create_connection(where, timeout=ENOUGH) as first:
            asked(first, b"$01M\r", b"!017018\r", 1)
            with ExitStack() as stack:
                for _ in range(60):
                    stack.enter_context(socket.create_connection(where, timeout=ENOUGH))
                sleep(2.5)
                asked(first, b"$01M\r", b"!017018\r", 100)
            with socket.create_connection(where, timeout=ENOUGH) as later:
                asked(later, b"$01M\r", b"!017018\r", 1)
        code, took = ended(started)
        errors = started.stderr.read()

    assert (code, errors) == (130, b"i7000: connections are not accepted for 1 s: Too many open files\n")
    assert took < PROMPTLY


def test_the_end_comes_however_full_the_pipe_of_errors_is() -> None:
    reading, writing = os.pipe()
    os.set_blocking(writing, False)
    with suppress(BlockingIOError):
        while True:
            os.write(writing, bytes(1 << 12))
    os.set_blocking(writing, True)
    with (
        process(
            "--tcp", "0", "--view", "none", stdout=subprocess.PIPE, stderr=writing, preexec_fn=few_descriptors
        ) as started,
        ExitStack() as stack,
    ):
        assert started.stdout
        where = place(first_line(started.stdout.fileno()))
        for _ in range(60):
            stack.enter_context(socket.create_connection(where, timeout=ENOUGH))
        sleep(0.5)
        code, took = ended(started)
    os.close(reading)
    os.close(writing)

    assert code == 130
    assert took < PROMPTLY
