"""Output that holds up nobody."""

import errno
import io
import os
import pty
import sys
import threading
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from time import monotonic, sleep
from typing import IO

import pytest
from rich.console import Console

from i7000.cli.outlet import MOST_WAITING, Outlet
from tests.waiting import ENOUGH, until

LINE = "x" * 99 + "\n"


class Stopped(io.StringIO):
    """A file that is not read until it goes on."""

    def __init__(self) -> None:
        super().__init__()
        self.going_on = threading.Event()

    def write(self, text: str) -> int:
        assert self.going_on.wait(ENOUGH)
        return super().write(text)


@contextmanager
def pipe(*, blocking: bool = True) -> Iterator[tuple[int, IO[str]]]:
    """A pipe, from the side of who reads and as the file of who writes."""
    reading, writing = os.pipe()
    os.set_blocking(writing, blocking)
    with os.fdopen(writing, "w", encoding="utf-8") as file:
        try:
            yield reading, file
        finally:
            os.close(reading)


def test_text_is_written_in_its_order() -> None:
    file = io.StringIO()
    out = Outlet(file)
    for number in range(1000):
        out.write(f"{number}\n")

    assert out.close() == 0
    assert file.getvalue() == "".join(f"{number}\n" for number in range(1000))


def test_text_for_a_file_of_the_system_passes_its_buffer() -> None:
    with pipe() as (reading, file):
        file.write("before ")
        out = Outlet(file)
        out.write("é\n")

        assert out.close() == 0
        assert os.read(reading, 100) == "before é\n".encode()


def test_what_an_encoding_does_not_have_is_escaped() -> None:
    with pipe() as (reading, file):
        file.reconfigure(encoding="ascii")  # type: ignore[attr-defined] # a TextIOWrapper
        out = Outlet(file)
        out.write("é\n")
        out.close()

        assert os.read(reading, 100) == b"\\xe9\n"


def test_it_is_a_file_for_rich() -> None:
    file = io.StringIO()
    console = Console(width=80)
    out = Outlet(file)
    console.file = out  # type: ignore[assignment] # as far as it needs one
    console.print("something")
    out.close()

    assert (file.getvalue(), console.is_terminal, console.encoding) == ("something\n", False, "utf-8")


# --- what is not read -------------------------------------------------------------------------------------------------


def test_what_there_is_no_room_for_is_counted_where_it_would_have_been() -> None:
    file = Stopped()
    out = Outlet(file)
    lines = MOST_WAITING // len(LINE) + 50
    for _ in range(lines):
        out.write(LINE)
    file.going_on.set()
    until(lambda: "not shown" in file.getvalue())
    out.write("later\n")

    assert out.close() == 0
    assert file.getvalue() == LINE * (lines - 50) + "50 lines not shown\nlater\n"


def test_while_lines_are_dropped_no_lines_are_made() -> None:
    file = Stopped()
    out = Outlet(file, most=0)
    before = out.skip(2)
    out.write("first\n")
    out.write("second\n")
    while_dropping = out.skip(2)
    file.going_on.set()
    until(lambda: not out.skip(0))

    assert (before, while_dropping, out.close()) == (False, True, 0)
    assert file.getvalue() == "first\n3 lines not shown\n"


def test_lines_can_be_dropped_without_a_word() -> None:
    file = Stopped()
    out = Outlet(file, most=0, counted=False)
    out.write("first\n")
    out.write("second\n")
    file.going_on.set()
    until(lambda: not out.skip(0))
    out.write("third\n")

    assert out.close() == 0
    assert file.getvalue() == "first\nthird\n"


def test_control_sequences_are_never_dropped() -> None:
    file = Stopped()
    out = Outlet(file, most=0, counted=False)
    out.write("first\n")
    out.write("second\n")
    out.write("\x1b[?25h")
    file.going_on.set()
    out.close()

    assert file.getvalue() == "first\n\x1b[?25h"


def test_lines_that_are_never_read_are_counted_at_the_end() -> None:
    file = Stopped()
    out = Outlet(file)
    for _ in range(5000):
        out.write(LINE)
    began = monotonic()
    missed = out.close()
    took = monotonic() - began
    file.going_on.set()

    assert missed == 5000
    assert took < 3


class Closed(io.StringIO):
    """A file that was closed."""

    def write(self, text: str) -> int:
        raise ValueError(text)


def written_to_nobody(out: Outlet) -> int:
    out.write(LINE)
    until(lambda: out.skip(1))
    for _ in range(5000):
        out.write(LINE)
    return out.close()


def test_a_file_that_was_closed_is_written_nothing() -> None:
    assert written_to_nobody(Outlet(Closed())) == 0


def test_a_reader_that_is_gone_is_written_nothing() -> None:
    reading, writing = os.pipe()
    with os.fdopen(writing, "w", encoding="utf-8") as file:
        os.close(reading)
        out = Outlet(file)

        assert written_to_nobody(out) == 0
        assert not out.failed


def test_a_disk_that_is_full_is_reported_once() -> None:
    reported: list[OSError] = []
    with open("/dev/full", "w", encoding="utf-8") as file:  # noqa: PTH123
        out = Outlet(file, report=reported.append)
        out.write(LINE)
        until(lambda: out.skip(1))
        out.write(LINE)
        out.close()

    assert out.failed
    assert [error.errno for error in reported] == [errno.ENOSPC]


def test_a_disk_that_is_full_need_not_be_reported() -> None:
    with open("/dev/full", "w", encoding="utf-8") as file:  # noqa: PTH123
        out = Outlet(file)
        out.write(LINE)
        out.close()

    assert out.failed


def test_a_file_that_others_made_non_blocking_is_waited_for_and_stays_so() -> None:
    with pipe(blocking=False) as (reading, file):
        out = Outlet(file)
        for _ in range(2000):
            out.write(LINE)
        sleep(0.2)
        heard = b""
        while len(heard) < 2000 * len(LINE):
            heard += os.read(reading, 1 << 16)

        assert out.close() == 0
        assert heard == LINE.encode() * 2000
        assert not os.get_blocking(file.fileno())


# --- terminals --------------------------------------------------------------------------------------------------------


@contextmanager
def stopped_terminal() -> Iterator[tuple[int, IO[str]]]:
    """A terminal after Ctrl-S, from the side of the person and as the file of a program."""
    person, program = pty.openpty()
    with os.fdopen(program, "w", encoding="utf-8") as file:
        try:
            tty.setcbreak(program)
            os.write(person, b"\x13")
            sleep(0.1)
            yield person, file
        finally:
            os.close(person)


def test_a_terminal_that_was_stopped_goes_on_at_the_end() -> None:
    with stopped_terminal() as (person, file):
        out = Outlet(file)
        out.write("the end")

        assert out.isatty()
        assert out.close() == 0
        assert os.read(person, 100) == b"the end"


def test_where_no_terminal_can_be_let_go_on_the_end_comes_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "termios", None)
    with stopped_terminal() as (_, file):
        out = Outlet(file)
        out.write("the end\n")

        assert out.close() == 1
