"""The program ``i7000``, and how signals and closed pipes end it."""

import io
import os
import pty
import runpy
import select
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from time import monotonic
from typing import Any

import pytest

from i7000.cli import app
from i7000_cli import CLOSED, FAILED, INTERRUPTED, program
from tests.simulation import INPUTS, KELVIN, MAIN, SAID, process, talk
from tests.waiting import ENOUGH

PROGRAM = (sys.executable, "-m", "i7000_cli")
MODELS = ("simulate", "--model", "I-7018")


# --- Ctrl-C -----------------------------------------------------------------------------------------------------------

INTERRUPTED_WHILE_IMPORTING = """\
import importlib, os, runpy, signal, sys

program = sys.argv.pop(1)
package = program.rpartition(".")[0]
if package:
    importlib.import_module(package)  # as `python -m` does before anything of the program runs

class Interrupting:
    left = int(sys.argv.pop(1))

    def find_spec(self, name, *_):
        Interrupting.left -= name not in (program, "i7000_cli")
        if Interrupting.left == 0:
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupting())
runpy.run_module(program, run_name="__main__", alter_sys=True)
"""
PROGRAMS = {
    "commands": ("i7000_cli", "commands"),
    "simulate": ("i7000_cli", *MODELS, "--tcp", "0"),
    "sync_driver": ("i7000.examples.sync_driver", "/dev/null", "--model", "M-7018"),
    "async_driver": ("i7000.examples.async_driver", "/dev/null", "--model", "M-7018"),
    "vector_runner": ("i7000.examples.vector_runner",),
}


@pytest.mark.parametrize("command", PROGRAMS.values(), ids=PROGRAMS)
@pytest.mark.parametrize("count", [1, *Random(7000).sample(range(2, 40), 3)])
def test_ctrl_c_while_importing_ends_it_without_a_word(command: tuple[str, ...], count: int) -> None:
    name, *arguments = command

    ended = subprocess.run(  # noqa: S603 - ourselves
        [sys.executable, "-c", INTERRUPTED_WHILE_IMPORTING, name, str(count), *arguments],
        capture_output=True,
        check=False,
        timeout=ENOUGH,
    )

    assert (ended.returncode, ended.stdout, ended.stderr) == (INTERRUPTED, b"", b"")


def test_ctrl_c_while_it_waits_for_input_ends_it_without_a_word() -> None:
    with subprocess.Popen(  # noqa: S603 - ourselves
        [*PROGRAM, "decode"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as started:
        assert started.stdin
        assert started.stdout
        started.stdin.write(b"$012\n")
        started.stdin.flush()
        told = started.stdout.readline()

        started.send_signal(signal.SIGINT)
        _, errors = started.communicate(timeout=ENOUGH)

    assert (started.returncode, errors) == (INTERRUPTED, b"")
    assert b"$012" in told


def test_a_job_in_the_background_goes_on_at_ctrl_c(monkeypatch: pytest.MonkeyPatch) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    monkeypatch.setattr(os, "_exit", pytest.fail)

    assert program(interrupted) == 7


def interrupted() -> int:
    os.kill(os.getpid(), signal.SIGINT)
    return 7


@pytest.mark.parametrize("output", [io.StringIO(), None], ids=["an output", "no output"])
def test_ctrl_c_ends_a_program_where_it_is(output: io.StringIO | None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "_exit", sys.exit)
    monkeypatch.setattr(sys, "stdout", output)

    with pytest.raises(SystemExit) as ended:
        program(interrupted)

    assert ended.value.code == INTERRUPTED


def test_ctrl_c_has_no_effect_when_a_program_is_done() -> None:
    code = program(lambda: 7)
    interrupted()

    assert code == 7


@pytest.mark.parametrize("module", ["i7000_cli", "i7000"])
def test_the_program_can_be_run_as_a_module(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], module: str
) -> None:
    monkeypatch.setattr(sys, "argv", ["i7000", "encode", "ReadConfiguration", "address=1"])
    monkeypatch.delitem(sys.modules, "i7000_cli")
    with pytest.raises(SystemExit) as ended:
        runpy.run_module(module, run_name="__main__")

    assert ended.value.code == 0
    assert capsys.readouterr().out.startswith("$012")


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_is_installed_for_a_shell(
    shell: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(Path, "home", lambda: tmp_path)
    for name in ("HOME", "USERPROFILE"):
        monkeypatch.setenv(name, str(tmp_path))

    assert app.run(["--install-completion", shell]) == 0
    installed = capsys.readouterr().out.removeprefix("completion is in ").partition(":")[0]
    assert "decode" in Path(installed).read_text(encoding="utf-8")
    assert Path(installed).is_relative_to(tmp_path)


# --- hanging up -------------------------------------------------------------------------------------------------------


@contextmanager
def on_a_terminal(*command: str) -> Iterator[tuple["subprocess.Popen[bytes]", Callable[[bytes], bytes]]]:
    """Run a program on a terminal; the function reads what it writes until some text, or its end."""
    end, near = pty.openpty()
    with subprocess.Popen(  # noqa: S603 - ourselves
        command, stdin=near, stdout=near, stderr=near, env={**os.environ, "TERM": "xterm"}, start_new_session=True
    ) as started:
        os.close(near)

        def read(until: bytes) -> bytes:
            seen, deadline = b"", monotonic() + ENOUGH
            while until not in seen and monotonic() < deadline:
                if select.select([end], [], [], 0.1)[0]:
                    try:
                        seen += os.read(end, 4096)
                    except OSError:  # how Linux tells that nobody is there any more
                        break
            return seen

        try:
            yield started, read
        finally:
            started.kill()
            os.close(end)


def test_a_live_view_that_is_hung_up_leaves_the_terminal_as_it_was() -> None:
    with on_a_terminal(*PROGRAM, *MODELS) as (started, read):
        before = read(b"I-7018")
        started.send_signal(signal.SIGHUP)
        after = read(b"no more")
        code = started.wait(ENOUGH)

    assert code == 0
    assert b"\x1b[?1049h" in before
    assert b"\x1b[?1049l" in after
    assert b"\x1b[?25h" in after
    assert b"Traceback" not in after


# --- a simulation that a script started -------------------------------------------------------------------------------


WITHOUT_SIGNALS = (
    "import asyncio; "
    "asyncio.SelectorEventLoop.add_signal_handler = lambda *_: (_ for _ in ()).throw(NotImplementedError)"
)


PIPES: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}


ENDINGS = [(signal.SIGINT, INTERRUPTED), (signal.SIGTERM, 0), (signal.SIGHUP, 0)]


@pytest.mark.parametrize(("ending", "code"), ENDINGS)
def test_a_script_reads_the_path_and_ends_it(ending: signal.Signals, code: int) -> None:
    with process("--model", KELVIN, *INPUTS, **PIPES) as started:
        assert started.stdout
        path = started.stdout.readline().strip()
        answers = talk(path, b"#01\r")

        started.send_signal(ending)
        rest, errors = started.communicate(timeout=ENOUGH)

    assert answers == [SAID]
    assert (started.returncode, rest, errors) == (code, "", "")
    assert not Path(path).exists()


@pytest.mark.parametrize(("ending", "code"), ENDINGS[:2])
def test_a_script_may_end_it_as_soon_as_it_reads_the_path(ending: signal.Signals, code: int) -> None:
    with process("--model", KELVIN, **PIPES) as started:
        assert started.stdout
        started.stdout.readline()

        started.send_signal(ending)
        rest, errors = started.communicate(timeout=ENOUGH)

    assert (started.returncode, rest, errors) == (code, "", "")


def test_where_no_signals_can_be_handled_ctrl_c_ends_it_too() -> None:
    with process("--model", KELVIN, main=f"{WITHOUT_SIGNALS}; {MAIN}", **PIPES) as started:
        assert started.stdout
        path = started.stdout.readline().strip()
        talk(path, b"#01\r")

        started.send_signal(signal.SIGINT)
        rest, errors = started.communicate(timeout=ENOUGH)

    assert (started.returncode, rest, errors) == (130, "", "")


def test_the_exit_codes_are_those_that_the_help_names(capsys: pytest.CaptureFixture[str]) -> None:
    assert app.run(["--help"]) == 0
    told = " ".join(capsys.readouterr().out.split())

    assert f"{FAILED} if the output cannot be written, {INTERRUPTED} after Ctrl-C, {CLOSED} if the reader" in told
