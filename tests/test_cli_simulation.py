"""``i7000 simulate``, as a person and as a script call it."""

import io
import os
import re
import signal
import socket
import sys
from functools import partial
from pathlib import Path
from threading import Event
from time import sleep

import pytest

from i7000.cli.outlet import shown_by
from i7000.cli.serving import read_place
from i7000.cli.words import UsageError
from i7000.simulator.deliveries import MOST_LATE_BYTES, MOST_LATE_PIECES
from i7000.simulator.recordings import MOST_BYTES, MOST_ROWS
from i7000.simulator.tcp import MOST_CONNECTIONS
from tests.simulation import INPUTS, KELVIN, SAID, free_port, simulated, talk
from tests.terminal import Run
from tests.waiting import ENOUGH


def test_modules_are_there_until_the_end(run: Run) -> None:
    port = free_port()
    answers = []

    told = simulated(
        run, "--model", KELVIN, *INPUTS, "--tcp", str(port),
        meanwhile=lambda: answers.extend(talk(f"socket://127.0.0.1:{port}", b"#01\r", b"$01M\r")),
    )  # fmt: skip

    assert (told.code, told.out, told.err) == (0, f"socket://127.0.0.1:{port}\n", "")
    assert answers == [SAID, b"!017019R\r"]


def test_modules_that_would_answer_at_once_are_shown(run: Run) -> None:
    def told(*texts: str) -> str:
        models = [word for text in texts for word in ("--model", text)]
        return simulated(run, *models, "--tcp", "0").err

    assert told("I-7018", "I-7018,address=01") == (
        "i7000: several modules have address 01 and speak DCON: their responses collide\n"
    )
    assert told("I-7018", "M-7018,address=01") == ""


def test_all_ways_to_get_there_lead_to_the_same_modules(run: Run) -> None:
    tcp, rfc2217 = free_port(), free_port()
    answers = []

    def meanwhile() -> None:
        answers.extend(talk(f"socket://127.0.0.1:{tcp}", b"~01OABC\r"))
        answers.extend(talk(f"rfc2217://127.0.0.1:{rfc2217}", b"$01M\r"))

    told = simulated(
        run, "--model", KELVIN, "--pty", "--tcp", str(tcp), "--rfc2217", f"localhost:{rfc2217}", meanwhile=meanwhile
    )

    assert answers == [b"!01\r", b"!01ABC\r"]
    assert re.fullmatch(rf"/dev/\S+\nsocket://127.0.0.1:{tcp}\nrfc2217://127.0.0.1:{rfc2217}\n", told.out)


def test_traffic_can_be_shown_line_by_line(run: Run) -> None:
    port = free_port()

    told = simulated(
        run, "--model", KELVIN, *INPUTS, "--tcp", str(port), "--view", "lines",
        meanwhile=lambda: talk(f"socket://127.0.0.1:{port}", b"#01\r"),
    )  # fmt: skip

    _, asked, answered = told.out.splitlines()
    assert asked.endswith("#01  ReadAnalogInputs")
    assert "25.1, 25.1, 25.1, 25.1, 25.1, 25.1, 25.1, 25.1 degC" in answered


def test_on_a_terminal_there_is_a_live_view_that_leaves_it_as_it_was(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    port = free_port()
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")

    def meanwhile() -> None:
        talk(f"socket://127.0.0.1:{port}", b"#01\r")
        sleep(0.6)

    told = simulated(run, "--model", KELVIN, *INPUTS, "--tcp", str(port), meanwhile=meanwhile)

    assert told.code == 0
    assert "M-7019R@B3.7" in told.out
    assert "ReadAnalogInputs" in told.out
    assert told.out.index("\x1b[?1049h") < told.out.index("\x1b[?1049l")
    assert told.out.index("\x1b[?25l") < told.out.rindex("\x1b[?25h")


def test_a_place_beyond_this_machine_is_shown(run: Run) -> None:
    told = simulated(run, "--model", KELVIN, "--tcp", "*:0", "--view", "none")

    assert re.fullmatch(r"socket://0\.0\.0\.0:\d+\n", told.out)
    assert told.err == f"i7000: {told.out.strip().removeprefix('socket://')} can be reached from other machines\n"


def test_lines_that_nobody_reads_are_counted_at_the_end(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    port = free_port()
    going_on = Event()

    class Unread(io.StringIO):
        def write(self, text: str) -> int:
            assert going_on.wait(ENOUGH)
            return super().write(text)

    monkeypatch.setattr("sys.stdout", Unread())
    monkeypatch.setattr("i7000.cli.serving.shown_by", partial(shown_by, most=0))

    told = simulated(
        run, "--model", KELVIN, "--tcp", str(port), "--view", "lines",
        meanwhile=lambda: talk(f"socket://127.0.0.1:{port}", *[b"#01\r"] * 5),
    )  # fmt: skip
    going_on.set()

    assert (told.code, told.err) == (0, "i7000: 11 lines not shown\n")


def test_a_frame_of_the_other_protocol_is_explained(run: Run) -> None:
    port = free_port()

    def ask() -> None:
        with socket.create_connection(("127.0.0.1", port), timeout=ENOUGH) as host:
            host.sendall(b"$01M\r")
            host.shutdown(socket.SHUT_WR)
            assert host.recv(100) == b""

    told = simulated(run, "--model", "M-7017", "--tcp", str(port), "--view", "lines", meanwhile=ask)

    assert told.out.endswith("$01M  a DCON frame; the M-7017 speaks Modbus RTU: give --model M-7017,protocol=dcon\n")


def test_the_limits_that_the_help_names_are_those_of_the_simulator(run: Run) -> None:
    words = " ".join(run("simulate", "--help").out.replace("│", " ").split())

    assert f"serve {MOST_CONNECTIONS} hosts each at a time" in words
    assert f"{MOST_LATE_PIECES} pieces, or {MOST_LATE_BYTES} bytes, of late responses" in words


def test_faults_are_those_of_the_seed(run: Run) -> None:
    def answers(*seed: str) -> list[bytes]:
        port = free_port()
        told: list[bytes] = []
        simulated(
            run, "--model", KELVIN, "--tcp", str(port), "--fault", "flip=0.01", *seed,
            meanwhile=lambda: told.extend(talk(f"socket://127.0.0.1:{port}", *[b"#01\r"] * 5)),
        )  # fmt: skip
        return told

    assert answers("--seed", "7") == answers("--seed", "7") != answers()


def test_the_help_says_what_a_recording_is_and_how_long_it_may_be(run: Run) -> None:
    told = " ".join(run("simulate", "--help").out.replace("│", "").split())

    assert all(name in told for name in ("seconds", "cold_junction", "open wire"))
    assert f"at most {MOST_ROWS:,} rows and {MOST_BYTES // 10**6} MB." in told


def test_a_simulation_under_nohup_goes_on_when_it_is_hung_up(run: Run) -> None:
    port = free_port()
    answers = []

    def meanwhile() -> None:
        answers.extend(talk(f"socket://127.0.0.1:{port}", b"#01\r"))
        os.kill(os.getpid(), signal.SIGHUP)
        answers.extend(talk(f"socket://127.0.0.1:{port}", b"#01\r"))

    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        told = simulated(run, "--model", KELVIN, *INPUTS, "--tcp", str(port), meanwhile=meanwhile)
    finally:
        signal.signal(signal.SIGHUP, before)

    assert (told.code, answers) == (0, [SAID, SAID])


# --- wrong usage ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((), "no modules: give --model once for each, such as --model M-7019R"),
        (("--model", "M-7019X"), "M-7019X"),
        (("--model", KELVIN, "--signal", "nonsense"), "nonsense"),
        (("--model", KELVIN, "--tcp", "nonsense"), "'nonsense' is not [HOST:]PORT"),
        (("--model", KELVIN, "--tcp", "65536"), "a port is 0..65535"),
        (("--model", KELVIN, "--fault", "dropp=1"), "there is no fault 'dropp'"),
    ],
)
def test_what_cannot_be_simulated_is_shown(run: Run, arguments: tuple[str, ...], said: str) -> None:
    told = run("simulate", *arguments)

    assert (told.code, told.out) == (2, "")
    assert said in told.err


def test_a_place_that_is_taken_is_shown(run: Run) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        told = run("simulate", "--model", KELVIN, "--tcp", str(server.getsockname()[1]))

    assert (told.code, told.out) == (2, "")
    assert re.fullmatch(r"i7000: cannot listen at 127\.0\.0\.1:\d+: Address already in use\n", told.err)


def test_only_this_machine_can_connect_unless_a_host_is_given() -> None:
    assert read_place("socket", "5020").host == "127.0.0.1"
    assert read_place("socket", ":5020").host == "127.0.0.1"
    assert read_place("socket", "0.0.0.0:5020").host == "0.0.0.0"  # noqa: S104


@pytest.mark.parametrize("text", ["[::1]:0", "[fe80::1%lo]:65535", "[::ffff:127.0.0.1]:00005", "localhost:5020", "*:0"])
def test_a_place_is_a_host_and_a_port(text: str) -> None:
    place = read_place("rfc2217", text)

    host, port = text.rsplit(":", 1)
    assert (place.scheme, place.host, place.port) == ("rfc2217", host.strip("[]"), int(port))


@pytest.mark.parametrize(
    "text",
    [
        "[::1:0", "::1]:0", "::1:0", "[]:0", "[::1]x:0", "x[::1]:0", "[[::1]]:0", "[localhost]:0", "[::1%]:0",
        "[::g]:0", "[:0", "]:0", "a:b:0", ":::0",
    ],
)  # fmt: skip
def test_a_host_that_is_not_whole_is_refused(text: str) -> None:
    with pytest.raises(UsageError, match=re.escape(f"{text!r} is not [HOST:]PORT: write an IPv6 address in brackets")):
        read_place("socket", text)


@pytest.mark.parametrize(
    "text",
    ["", "[::1]", "localhost", "[::1]:", "1:65536", "1:-1", "1:+1", "1: 1", "1:1 ", "1:1e3", "1:000001", "1:\u0663"],
)
def test_an_invalid_port_is_refused(text: str) -> None:
    with pytest.raises(UsageError, match=re.escape(f"{text!r} is not [HOST:]PORT: a port is 0..65535")):
        read_place("socket", text)


def test_what_is_not_installed_is_shown(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "filelock", None)
    monkeypatch.delitem(sys.modules, "i7000.simulator.memory", raising=False)

    told = run("simulate", "--model", KELVIN, "--tcp", "0", "--eeprom", str(tmp_path / "bus.json"))

    assert told.code == 2
    assert 'pip install "i7000[simulator]"' in told.err


def test_without_pseudo_terminals_the_message_names_the_other_options(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "i7000.simulator.pseudo_terminal", None)

    told = run("simulate", "--model", KELVIN)

    assert (told.code, told.out) == (2, "")
    assert "give --tcp or --rfc2217" in told.err
