"""Commands to a running simulation: from standard input, from a socket, and what they do."""

import asyncio
import io
import os
import socket
import subprocess
import threading
from collections.abc import Awaitable, Callable
from pathlib import Path
from threading import Event
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Model, Unit
from i7000.cli import control as controlling
from i7000.cli.control import LONGEST_LINE, MOST_CONNECTIONS, Control, Lines, follow_input, listening
from i7000.cli.operating import module_commands
from i7000.cli.words import UsageError
from i7000.device import Signal
from i7000.simulator import Faults, Fixed, Simulator, Sine
from tests.simulation import KELVIN, free_port, process, simulated, talk
from tests.simulator.running import I_7018, module
from tests.terminal import Run
from tests.waiting import ENOUGH, until

MODULES = (I_7018, module(Model.I_7017, address=0x1F))


def controlled(do: Callable[[Simulator, Control], Awaitable[Any]]) -> Any:
    """What comes of using the control of a simulator."""

    async def run() -> Any:
        simulator = Simulator(MODULES)
        return await do(simulator, Control(simulator, module_commands(simulator, 0)))

    return asyncio.run(run())


def answers(*lines: str) -> list[str]:
    """The answers to commands, one after the other."""

    async def ask(_: Simulator, control: Control) -> list[str]:
        return [await control.answer(line) for line in lines]

    found: list[str] = controlled(ask)
    return found


# --- commands ---------------------------------------------------------------------------------------------------------


def test_faults_are_added_changed_shown_and_switched_off() -> None:
    assert answers("fault late=0.1 drop=0.01@to", " fault\tx", "fault late=0", "fault", "fault off", "fault") == [
        "ok late=0.1:0.3 drop=0.01@to",
        "error: 'fault\\tx' is not a command; " + COMMANDS,
        "ok drop=0.01@to",
        "ok drop=0.01@to",
        "ok off",
        "ok off",
    ]


COMMANDS = (
    "commands are power-cycle [ADDRESS]; init ADDRESS on|off; signal [ADDRESS:]CHANNELS=SIGNAL; "
    "fault [off | NAME=PROBABILITY[@WHERE]...]; quit"
)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("", f"error: '' is not a command; {COMMANDS}"),
        ("reset 01", f"error: 'reset' is not a command; {COMMANDS}"),
        ("\udcff\udcfe", rf"error: '\xff\xfe' is not a command; {COMMANDS}"),
        ("init \udcff on", r"error: '\xff' is not "),
        ("fault late=2", "error: 'late=2': late cannot be 2: 0..1"),
        ("power-cycle 2", "error: no module has the address 02, only 01, 1Fh (31)"),
        ("power-cycle all", "error: 'all' is not "),
        ("init 01", "error: write init ADDRESS on|off"),
        ("init 01 up", "error: 'up' is not true or false"),
        ("signal", "error: '': write [ADDRESS:]CHANNELS=SIGNAL, such as 0=1.5V"),
        ("signal 01:9=1V", "error: '01:9=1V': I-7018 at 01"),
        ("signal cjc=open", "error: 'cjc=open': cjc must be a temperature in degC"),
        ("signal 0=csv:/nowhere\x1b.csv", r"error: '0=csv:/nowhere\x1b.csv': /nowhere\x1b.csv: No such file"),
        ("quit now", "error: quit has no arguments"),
    ],
)
def test_a_command_that_cannot_be_carried_out_is_answered_with_the_reason(line: str, said: str) -> None:
    (answer,) = answers(line)

    assert answer.startswith(said)


def test_power_and_init_switch_are_operated_by_the_stored_address() -> None:
    async def operate(simulator: Simulator, control: Control) -> list[Any]:
        commands = ["init 1Fh on", "power-cycle 1Fh", "init 1Fh off", "power-cycle"]
        said = [(await control.answer(it), simulator.bus.modules[1].ram.address) for it in commands]
        return [*said, simulator.bus.modules[0].ram.address]

    assert controlled(operate) == [("ok", 0x1F), ("ok", 0), ("ok", 0), ("ok", 0x1F), 1]


def test_a_signal_leaves_the_others_connected() -> None:
    async def connect(simulator: Simulator, control: Control) -> Any:
        said = [await control.answer(it) for it in ("signal 0=sine:0:1:60", "signal 1Fh:1=5V")]
        first, second = (sources.channels[:2] for _, _, sources in simulator.modules())
        return said, first, second

    said, first, second = controlled(connect)

    assert said == ["ok", "ok"]
    assert first == (Sine(0, 1, 60, Unit.VOLT), I_7018.sources.channels[1])
    assert second == (Sine(0, 1, 60, Unit.VOLT), Fixed(Signal(5.0, Unit.VOLT)))


@given(st.sampled_from(["", "fault ", "init ", "signal ", "power-cycle "]), st.text(max_size=100))
def test_any_line_is_answered_by_one_line(command: str, arguments: str) -> None:
    (answer,) = answers(command + arguments)

    assert answer.startswith(("ok", "error: "))
    assert answer.isprintable()


# --- lines ------------------------------------------------------------------------------------------------------------


@given(st.binary(max_size=100), st.integers(1, 10))
def test_lines_do_not_depend_on_how_they_arrive(data: bytes, size: int) -> None:
    def lines(*pieces: bytes) -> list[str | None]:
        found = Lines()
        return [line for piece in pieces for line in found.feed(piece)] + list(found.end())

    assert lines(data) == lines(*[data[at : at + size] for at in range(0, len(data), size)])


@pytest.mark.parametrize("size", [1, 7, 5000])
def test_a_long_line_is_dropped_and_the_next_one_is_not(size: int) -> None:
    lines = Lines()
    data = b"x" * (LONGEST_LINE + 1) + b"\nquit\n" + b"y" * LONGEST_LINE + b"\n" + b"z" * 2000

    found = [line for at in range(0, len(data), size) for line in lines.feed(data[at : at + size])]

    assert found == [None, "quit", "y" * LONGEST_LINE]
    assert list(lines.end()) == [None]
    assert list(lines.end()) == []


# --- a socket ---------------------------------------------------------------------------------------------------------


def said(path: Path, data: bytes) -> bytes:
    """What a program hears that sends something to a socket, and no more."""
    with socket.socket(socket.AF_UNIX) as program:
        program.settimeout(ENOUGH)
        program.connect(str(path))
        program.sendall(data)
        program.shutdown(socket.SHUT_WR)
        heard = b""
        while received := program.recv(4096):
            heard += received
        return heard


def test_programs_are_answered_at_a_socket_of_the_user_that_is_gone_afterwards(tmp_path: Path) -> None:
    path = tmp_path / "bus.sock"

    async def ask(simulator: Simulator, control: Control) -> Any:
        async with listening(control, path):
            mode = path.stat().st_mode & 0o777
            heard = await asyncio.to_thread(said, path, b"fault late=0.1\n" + b"x" * 2000 + b"\nfault off")
        return mode, heard, simulator.faults

    mode, heard, faults = controlled(ask)

    assert mode == 0o600
    assert heard == b"ok late=0.1:0.3\nerror: a line has at most 1000 bytes\nok off\n"
    assert faults == Faults()
    assert not path.exists()


def test_only_so_many_programs_are_connected(tmp_path: Path) -> None:
    path = tmp_path / "bus.sock"

    async def ask(unused: Simulator, control: Control) -> Any:  # noqa: ARG001
        async with listening(control, path):
            opened = [await asyncio.open_unix_connection(path) for _ in range(MOST_CONNECTIONS + 1)]
            refused = [await asyncio.wait_for(opened[-1][0].readline(), ENOUGH)]
            opened[0][1].write(b"fault\n")
            refused.append(await asyncio.wait_for(opened[0][0].readline(), ENOUGH))
            for reader, writer in opened[:-1]:
                writer.write_eof()
                await asyncio.wait_for(reader.read(), ENOUGH)
            for _, writer in opened:
                writer.close()
            return [*refused, await asyncio.to_thread(said, path, b"fault\n")]

    assert controlled(ask) == [b"error: 8 programs are connected\n", b"ok off\n", b"ok off\n"]


def test_a_program_that_stays_connected_does_not_hold_up_the_end(tmp_path: Path) -> None:
    path = tmp_path / "bus.sock"

    async def ask(_: Simulator, control: Control) -> bytes:
        async with listening(control, path):
            reader, writer = await asyncio.open_unix_connection(path)
            writer.write(b"fault\n")
            answer = await asyncio.wait_for(reader.readline(), ENOUGH)
        assert await asyncio.wait_for(reader.read(), ENOUGH) == b""
        writer.close()
        return answer

    assert controlled(ask) == b"ok off\n"


def test_a_socket_that_nobody_listens_at_is_replaced_and_others_are_not(tmp_path: Path) -> None:
    stale, used, file = tmp_path / "stale", tmp_path / "used", tmp_path / "file"
    with socket.socket(socket.AF_UNIX) as gone:
        gone.bind(str(stale))
    file.touch()

    async def listen(_: Simulator, control: Control) -> list[str]:
        refused = []
        async with listening(control, stale), listening(control, used):
            for path in (used, file, tmp_path / "no" / "where", tmp_path / ("x" * 200)):
                try:
                    async with listening(control, path):
                        pass
                except UsageError as error:
                    refused.append(str(error).replace(str(tmp_path), ""))
        return refused

    first, second, third, fourth = controlled(listen)

    assert first == "/used: another program listens there"
    assert second == "/file exists and is not a socket: give another path, or -"
    assert third == "/no/where: No such file or directory"
    assert "too long" in fourth
    assert file.exists()


def test_without_unix_sockets_the_message_names_the_other_way(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delattr(asyncio, "start_unix_server")

    async def listen(_: Simulator, control: Control) -> None:
        async with listening(control, tmp_path / "bus.sock"):
            pass

    with pytest.raises(UsageError, match="give --control -"):
        controlled(listen)


# --- standard input ---------------------------------------------------------------------------------------------------


def test_the_lines_of_standard_input_are_answered_and_its_end_is_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(b"fault late=0.1\nnonsense\nfault off")))
    heard: list[str] = []

    async def follow(simulator: Simulator, control: Control) -> None:
        follow_input(control, heard.append)
        await asyncio.wait_for(simulator.run(), ENOUGH)

    controlled(follow)

    assert [heard[0], heard[1][:16], heard[2]] == ["ok late=0.1:0.3", "error: 'nonsense", "ok off"]


def test_standard_input_is_read_from_its_descriptor_and_may_go(monkeypatch: pytest.MonkeyPatch) -> None:
    reading, writing = os.pipe()
    answered = Event()

    async def follow(simulator: Simulator, control: Control) -> None:
        follow_input(control, lambda _: answered.set())
        os.write(writing, b"fault\n")
        assert await asyncio.to_thread(answered.wait, ENOUGH)
        os.close(writing)
        await asyncio.wait_for(simulator.run(), ENOUGH)

    with os.fdopen(os.dup(reading)) as stdin:
        monkeypatch.setattr("sys.stdin", stdin)
        controlled(follow)
        read = controlling._reader()  # noqa: SLF001 - a terminal that is gone
    os.close(reading)

    assert read() == b""


def test_a_line_of_standard_input_that_is_carried_out_at_the_end_ends_with_the_loop(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(b"fault\n")))
    begun = asyncio.Event()
    failed: list[object] = []

    async def endless(_: str) -> str:
        begun.set()
        await asyncio.Event().wait()
        raise AssertionError

    async def follow(_: Simulator, control: Control) -> None:
        monkeypatch.setattr(control, "answer", endless)
        follow_input(control, print)
        await asyncio.wait_for(begun.wait(), ENOUGH)

    monkeypatch.setattr("threading.excepthook", failed.append)
    controlled(follow)
    for thread in threading.enumerate():
        if thread.name == "i7000 control":
            thread.join(ENOUGH)

    assert failed == []


def test_a_line_of_standard_input_that_comes_after_the_end_is_dropped(monkeypatch: pytest.MonkeyPatch) -> None:
    read, ended = threading.Event(), threading.Event()
    failed: list[object] = []

    def late() -> bytes:
        read.set()
        assert ended.wait(ENOUGH)
        return b"fault\n"

    async def follow(_: Simulator, control: Control) -> None:
        follow_input(control, print)
        assert await asyncio.to_thread(read.wait, ENOUGH)

    monkeypatch.setattr(controlling, "_reader", lambda: late)
    monkeypatch.setattr("threading.excepthook", failed.append)
    controlled(follow)
    ended.set()
    for thread in threading.enumerate():
        if thread.name == "i7000 control":
            thread.join(ENOUGH)

    assert failed == []


def test_without_standard_input_another_way_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", None)

    async def follow(_: Simulator, control: Control) -> None:
        follow_input(control, print)

    with pytest.raises(UsageError, match="give --control a path"):
        controlled(follow)


# --- the command line -------------------------------------------------------------------------------------------------


def test_a_test_program_does_what_a_person_does_at_the_module(run: Run, tmp_path: Path) -> None:
    path, port = tmp_path / "bus.sock", free_port()
    url = f"socket://127.0.0.1:{port}"
    heard: list[bytes] = []

    def meanwhile() -> None:
        talk(url, b"$01M\r")
        heard.append(said(path, b"signal all=30degC\nfault refuse=1@to\ninit 1 on\npower-cycle 1\n"))
        heard.extend(talk(url, b"$00M\r", b"$002\r"))

    told = simulated(
        run, "--model", KELVIN, "--tcp", str(port), "--control", str(path), "--view", "lines", meanwhile=meanwhile
    )

    assert heard == [
        b"ok\nerror: 'refuse=1@to': requests can only have drop, flip and noise: write refuse=1\nok\nok\n",
        b"!007019R\r",
        b"!010F0600\r",
    ]
    assert "01 M-7019R  INIT switch on\n" in told.out
    assert "01 M-7019R  power cycle in INIT mode\n" in told.out
    assert not path.exists()


def test_a_process_is_controlled_by_its_input() -> None:
    pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with process("--model", "I-7018", "--tcp", "0", "--control", "-", text=True, **pipes) as started:
        out, errors = started.communicate("fault late=0.1\nquit\n", timeout=ENOUGH)

    place, *answered = out.splitlines()
    assert place.startswith("socket://")
    assert (answered, errors, started.returncode) == (["ok late=0.1:0.3", "ok"], "", 0)


def test_ctrl_c_ends_a_process_that_waits_for_its_input() -> None:
    pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with process("--model", "I-7018", "--tcp", "0", "--control", "-", text=True, **pipes) as started:
        assert started.stdin
        assert started.stdout
        started.stdout.readline()
        started.stdin.write("fault\n")
        started.stdin.flush()
        assert started.stdout.readline() == "ok off\n"
        started.send_signal(2)
        code = started.wait(ENOUGH)
        assert started.stderr
        errors = started.stderr.read()

    assert (code, errors) == (130, "")


def test_input_is_for_commands_or_for_keys(run: Run) -> None:
    told = run("simulate", "--model", KELVIN, "--control", "-", "--view", "live")

    assert (told.code, told.out) == (2, "")
    assert "both read standard input" in told.err


def test_a_socket_that_cannot_be_made_is_wrong_usage(run: Run, tmp_path: Path) -> None:
    told = run("simulate", "--model", KELVIN, "--tcp", "0", "--control", str(tmp_path))

    assert told.code == 2
    assert told.err == f"i7000: {tmp_path} exists and is not a socket: give another path, or -\n"


def test_quit_from_a_socket_ends_a_process_without_a_word(tmp_path: Path) -> None:
    path = tmp_path / "bus.sock"
    pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with process("--model", "I-7018", "--tcp", "0", "--control", str(path), **pipes) as started:
        until(path.is_socket)
        with socket.socket(socket.AF_UNIX) as program:
            program.settimeout(ENOUGH)
            program.connect(str(path))
            program.sendall(b"quit\n")
            answer = program.recv(100)
            code = started.wait(ENOUGH)
        assert started.stderr
        errors = started.stderr.read()

    assert (answer, code, errors) == (b"ok\n", 0, b"")
