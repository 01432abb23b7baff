"""``i7000 provoke``: real drivers on real ports, few scenarios; all others run in virtual time."""

import json
import os
import shlex
import signal
import socket
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from threading import Thread
from threading import enumerate as threads
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from i7000 import Model, Profile, Protocol
from i7000.cli import drivers, main, provoke_report, provoking
from i7000.conformance import believed
from i7000.conformance.provoked import Finding, Judgement, Kind, Verdict
from i7000.conformance.scenarios import SCENARIOS
from i7000.simulator.faults import Piece
from i7000.simulator.observed import Observed
from tests.drivers import fixed_length, number_finder
from tests.simulation import free_port
from tests.terminal import Run
from tests.waiting import ENOUGH, until

FOREVER = "10000"
EXAMPLE = (
    "--model", "I-7018", "--type", "K", "--address", "1", "--address", "2", "--polls", FOREVER, "--json",
)  # fmt: skip


def example(name: str, *arguments: str) -> tuple[str, ...]:
    return ("--", sys.executable, "-m", f"i7000.examples.{name}", "{target}", *EXAMPLE, *arguments)


def script(text: str) -> tuple[str, ...]:
    return ("--", sys.executable, "-c", text, "{target}")


@pytest.fixture(scope="module", autouse=True)
def importable() -> Iterator[None]:
    """The drivers that are started find this package."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("PYTHONPATH", os.pathsep.join(filter(None, sys.path)))
        yield


@pytest.mark.parametrize("name", ["sync_driver", "async_driver"])
def test_the_example_drivers_pass(run: Run, name: str) -> None:
    told = run("provoke", "--scenario", "late-reply", "--scenario", "blank-channels", *example(name))

    assert [line.split()[:2] for line in told.out.splitlines()[:2]] == [
        ["PASS", "late-reply"],
        ["PASS", "blank-channels"],
    ]
    assert (told.code, told.out.splitlines()[2:]) == (0, ["2 PASS"])


def test_the_example_driver_passes_by_modbus_over_a_network(run: Run) -> None:
    told = run(
        "provoke", "--scenario", "wrong-address", "--rfc2217", "0",
        *("--model", "M-7018,type=K,protocol=rtu") * 2,
        *example("sync_driver", "--modbus", "--model", "M-7018"),
    )  # fmt: skip

    assert told.code == 0


@pytest.mark.parametrize(("driver", "name"), [(fixed_length, "zero-after-frame"), (number_finder, "blank-channels")])
def test_naive_drivers_fail_with_the_bytes_and_a_reason(run: Run, tmp_path: Path, driver: Any, name: str) -> None:
    path = tmp_path / "report.jsonl"

    again = ("--patience", "3", "--", sys.executable, str(driver.__file__), "{target}")
    told = run("provoke", "--scenario", name, "--report", f"json={path}", *again)

    assert told.code == 1
    assert told.out.splitlines()[0].startswith(f"FAIL         {name}")
    assert "-> #01  ReadAnalogInputs" in told.out
    assert f"again: {shlex.join(('i7000', 'provoke', '--scenario', name, '--seed', '0', *again))}\n" in told.out
    start, scenario, end = records(path)
    assert (start["scenarios"], scenario["verdict"], end["exit_code"]) == ([name], "FAIL", 1)
    assert scenario["findings"][0]["traffic"][0]["request"] in (b"#01\r".hex(), b"#02\r".hex())


def test_the_line_that_plays_a_scenario_again_can_be_run(run: Run) -> None:
    given = (
        "--pty", "--tcp", "0", "--rfc2217", "127.0.0.1:0", "--model", "I-7018,type=J", "--model", "I-7018,type=K",
        "--max-time", "60", "--patience", "0.5",
    )  # fmt: skip
    driver = script('import sys; print(\'{"address": 1}\', flush=True); "it\'s"')
    told = run("provoke", "--scenario", "echo", "--seed", "7", *given, *driver)
    again = next(line for line in told.out.splitlines() if line.startswith("  again: "))
    words = shlex.split(again.removeprefix("  again: "))
    repeated = run(*words[1:])

    assert (told.code, words[:2]) == (3, ["i7000", "provoke"])
    assert (repeated.code, again in repeated.out.splitlines()) == (3, True)
    assert sorted(words[2:]) == sorted(("--scenario", "echo", "--seed", "7", *given, *driver))


def test_the_line_for_a_driver_that_somebody_else_starts_names_its_output(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "out.jsonl"
    path.touch()

    def write_later() -> None:
        time.sleep(0.3)
        path.write_text('{"address": 1}\n')

    Thread(target=write_later).start()
    told = run("provoke", "--scenario", "echo", "--tcp", "0", "--driver-output", str(path))

    assert told.code == 3
    assert f"again: i7000 provoke --scenario echo --seed 0 --tcp 0 --driver-output {path}\n" in told.out


def records(path: Path) -> list[Any]:
    """The records of a report, which all fit its schema."""
    found = [json.loads(line) for line in path.read_text().splitlines()]
    validator = Draft202012Validator(json.loads(provoke_report.SCHEMA))
    for record in found:
        validator.validate(record)
    return found


@pytest.mark.parametrize("name", ["echo", "old-firmware"])
def test_a_driver_that_does_nothing_is_inconclusive(run: Run, name: str) -> None:
    told = run("provoke", "--scenario", name, "--patience", "0.5", *script("import time; time.sleep(99)"))

    assert told.code == 5
    assert told.out.splitlines()[1:] == ["  the driver sent nothing", "1 INCONCLUSIVE"]


def test_a_driver_that_asks_once_and_waits_for_ever_is_stuck(run: Run) -> None:
    asks = "import sys,time,serial; p=serial.serial_for_url(sys.argv[1]); p.write(b'#01\\r'); time.sleep(99)"

    told = run("provoke", "--scenario", "silence", "--patience", "1", *script(asks))

    assert told.code == 1
    assert told.out.splitlines()[1].startswith("  deadlock at 0.0")


def test_a_driver_that_asks_slowly_is_inconclusive(run: Run) -> None:
    asks = (
        "import sys,time,serial; p=serial.serial_for_url(sys.argv[1]); p.write(b'#01\\r')\n"
        'while True: print(\'{"address": 1, "status": "missing"}\'); time.sleep(0.1)'
    )

    told = run("provoke", "--scenario", "silence", "--max-time", "1", *script(asks))

    assert told.code == 5
    assert "asked too little: step 1 of 5 was not over in time" in told.out


def test_a_driver_that_crashes_has_its_last_words(run: Run) -> None:
    asks = "import sys,serial; p=serial.serial_for_url(sys.argv[1]); p.write(b'#01\\r'); p.read(1); sys.exit('oops')"

    told = run("provoke", "--scenario", "silence", *script(asks))

    assert told.code == 1
    assert "the driver ended with exit code 1" in told.out
    assert "its last words: oops" in told.out


def test_output_that_does_not_fit_the_schema_is_an_error(run: Run) -> None:
    prints = "import time; print('hello\\n{\"address\": 1}'); time.sleep(99)"

    told = run("provoke", "--scenario", "echo", *script(prints))

    assert told.code == 3
    assert "line 2 of the driver's output: no channel" in told.out


def test_a_driver_that_cannot_be_started_is_an_error(run: Run) -> None:
    told = run("provoke", "--scenario", "echo", "--", "/no/such/driver", "{target}")

    assert (told.code, told.out.splitlines()[1]) == (
        3,
        "  the driver cannot be started: No such file or directory: /no/such/driver",
    )


def test_a_driver_that_does_not_want_to_end_is_killed(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drivers, "_PATIENCE", 0.2)
    stays = "import signal,time; signal.signal(signal.SIGTERM, signal.SIG_IGN); time.sleep(99)"

    assert run("provoke", "--scenario", "echo", "--patience", "1", *script(stays)).code == 5


def test_what_is_not_applicable_is_skipped_and_never_passes(run: Run) -> None:
    told = run("provoke", "--scenario", "wrong-address", "--", "true", "{target}")

    assert told.code == 5
    assert told.out.splitlines() == [
        "SKIP         wrong-address       not applicable: only Modbus RTU has it", "1 SKIP",
    ]  # fmt: skip


def test_no_scenario_begins_after_the_time_is_over(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(provoking, "monotonic", iter([0.0, 99.0]).__next__)

    told = run("provoke", "--scenario", "echo", "--max-time", "9", "--", "true", "{target}")

    assert (told.code, "no time was left: give a longer --max-time" in told.out) == (5, True)


def test_a_scenario_is_played_again_while_its_failure_is_doubtful(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    doubtful = Judgement(Verdict.FAIL, (Finding(Kind.WRONG, 1.0, "x"),), "doubtful")
    judged = iter([doubtful, Judgement(Verdict.PASS), doubtful, doubtful, doubtful])
    monkeypatch.setattr(provoking, "judge", lambda _: next(judged))

    codes = [run("provoke", "--scenario", "echo", "--patience", "0.3", "--", "true", "{target}").code for _ in range(2)]

    assert codes == [0, 1]
    assert list(judged) == []


# --- drivers that somebody else starts --------------------------------------------------------------------------------


class Plain(socket.socket):
    """A connection with the methods of a port that a naive driver uses; pyserial does not close one that is reset."""

    def __init__(self, port: int) -> None:
        super().__init__()
        self.settimeout(ENOUGH)
        self.connect(("127.0.0.1", port))

    def write(self, data: bytes) -> None:
        self.sendall(data)

    def read_until(self, end: bytes) -> bytes:
        heard = b""
        while not heard.endswith(end):
            heard += self.recv(1) or self.gone()
        return heard

    @staticmethod
    def gone() -> bytes:
        raise EOFError


@contextmanager
def polling(port: int, write: Any) -> Iterator[None]:
    """A driver that polls as soon as there is a port, until there is none."""

    def is_open() -> bool:
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", port)) == 0

    def poll() -> None:
        until(is_open)
        with Plain(port) as opened, suppress(OSError, EOFError):
            while True:
                for line in number_finder.poll(opened):
                    write(f"{line}\n".encode())

    thread = Thread(target=poll)
    thread.start()
    try:
        yield
    finally:
        thread.join(ENOUGH)


def test_the_output_of_another_driver_is_followed_in_a_file(run: Run, tmp_path: Path) -> None:
    port, path = free_port(), tmp_path / "out"
    emptied: list[bytes] = []
    path.write_text("old text\n" * 10_000)

    def write(data: bytes) -> None:
        with path.open("ab" if emptied else "wb") as file:
            file.write(data)
        emptied.append(data)

    with polling(port, write):
        told = run("provoke", "--scenario", "undisturbed", "--tcp", str(port), "--driver-output", str(path))

    assert (told.code, told.out.splitlines()[-1]) == (0, "1 PASS")
    assert told.err == f"i7000: undisturbed: start your driver at socket://127.0.0.1:{port}\n"


def test_the_output_of_another_driver_is_followed_on_standard_input(monkeypatch: pytest.MonkeyPatch) -> None:
    port = free_port()
    reading, writing = os.pipe()
    with os.fdopen(reading, "rb") as pipe, polling(port, lambda data: os.write(writing, data)):

        class Stdin:
            def fileno(self) -> int:
                return pipe.fileno()

        monkeypatch.setattr("sys.stdin", Stdin())
        code = main(("provoke", "--scenario", "undisturbed", "--tcp", str(port), "--driver-output", "-"))
        os.write(writing, b"more\n")  # The thread that reads it ends then.
        until(lambda: "i7000 driver" not in {it.name for it in threads()})
        os.close(writing)

    assert code == 0


def test_a_file_that_is_not_there_is_an_error(run: Run) -> None:
    told = run("provoke", "--scenario", "echo", "--tcp", "0", "--driver-output", "/no/such/file")

    assert told.code == 3
    assert "No such file or directory: /no/such/file" in told.out


def test_there_may_be_no_standard_input(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", None)

    assert main(("provoke", "--scenario", "echo", "--tcp", "0", "--driver-output", "-")) == 2


def test_an_output_that_ends_before_the_scenario_is_the_end_of_the_driver(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "fifo"
    os.mkfifo(path)

    def write() -> None:
        until(lambda: "i7000 driver" in {it.name for it in threads()})
        path.write_bytes(b'{"address": 1, "status": "error"}')

    writer = Thread(target=write)
    writer.start()

    told = run("provoke", "--scenario", "echo", "--tcp", "0", "--driver-output", str(path))
    writer.join()

    assert told.code == 1
    assert "the driver's output ended" in told.out


# --- lines ------------------------------------------------------------------------------------------------------------


def test_lines_that_are_too_long_or_too_many_are_unreadable(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drivers, "MOST_LINES", 2)
    driver = drivers.Driver(lambda: 0.0)
    driver.feed(b"{" * 2000 + b"\n" + b'{"address": 1, "status": "error"}\n' * 5)
    driver.end("done")
    driver.end("again")

    assert [getattr(line.said, "reason", "") for line in driver.lines] == [
        "a line has at most 1000 bytes", "", "there are more than 100000 lines",
    ]  # fmt: skip
    assert driver.ended is not None
    assert driver.ended.words == "done"


# --- usage ------------------------------------------------------------------------------------------------------------


def test_all_scenarios_are_listed_and_explained(run: Run) -> None:
    listed = run("provoke", "--list").out.splitlines()

    assert [line.split()[0] for line in listed] == [it.name for it in SCENARIOS]
    for scenario in SCENARIOS:
        explained = run("provoke", "--explain", scenario.name)
        assert explained.code == 0
        assert scenario.right in explained.out


def test_the_schemas_are_shown(run: Run) -> None:
    assert run("provoke", "--schema").out == f"{believed.SCHEMA}\n"
    assert run("provoke", "--report-schema").out == f"{provoke_report.SCHEMA}\n"
    for schema in (believed.SCHEMA, provoke_report.SCHEMA):
        Draft202012Validator.check_schema(json.loads(schema))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((), "give --scenario NAME or --scenario all"),
        (("--scenario", "ecco"), "there is no scenario 'ecco'; did you mean echo?"),
        (("--explain", "zzzzzz"), "there is no scenario 'zzzzzz'; --list shows them"),
        (("--scenario", "echo"), "give a driver to start after --, or --driver-output"),
        (("--scenario", "echo", "--", "driver"), "write {target} in the command"),
        (("--scenario", "echo", "--driver-output", "-", "--", "d", "{target}"), "give a driver to start after --"),
        (("--scenario", "all", "--driver-output", "-"), "takes one scenario"),
        (("--scenario", "echo", "--patience", "0", "--", "d", "{target}"), "--patience 0: give more than 0"),
        (("--scenario", "echo", "--max-time", "1e9", "--", "d", "{target}"), "--max-time 1e+09: give more"),
        (("--scenario", "echo", "--report", "xml=x", "--", "d", "{target}"), "--report xml=x: give json=FILE"),
        (("--scenario", "echo", "--report", "json=/no/such/x", "--", "d", "{target}"), "/no/such/x: No such file"),
        (("--scenario", "echo", "--model", "X", "--", "d", "{target}"), "there is no model 'X'"),
        (("--scenario", "echo", "--tcp", "x", "--", "d", "{target}"), "is not [HOST:]PORT"),
    ],
)
def test_wrong_usage_is_explained(run: Run, arguments: tuple[str, ...], said: str) -> None:
    told = run("provoke", *arguments)

    assert (told.code, told.out) == (2, "")
    assert said in told.err


def test_ctrl_c_ends_the_driver_and_leaves_the_report_without_its_end(run: Run, tmp_path: Path) -> None:
    path, there = tmp_path / "report.jsonl", tmp_path / "pid"
    says = f"import os,time; open({str(there)!r}, 'w').write(str(os.getpid())); time.sleep(99)"

    def interrupt() -> None:
        until(lambda: there.exists() and there.read_text())
        os.kill(os.getpid(), signal.SIGINT)

    interrupting = Thread(target=interrupt)
    interrupting.start()
    told = run("provoke", "--scenario", "echo", "--report", f"json={path}", *script(says))
    interrupting.join()

    assert told.code == 130
    assert [record["record"] for record in records(path)] == ["run-start"]
    with pytest.raises(ProcessLookupError):
        os.kill(int(there.read_text()), 0)


def shown(*findings: Finding, exchanges: tuple[Observed, ...] = ()) -> list[str]:
    result = provoke_report.Result(SCENARIOS[0], Judgement(Verdict.FAIL, findings), 1.0, exchanges)
    return ["".join(part for part, _ in line) for line in provoke_report.result_lines(result, "again")]


def test_a_finding_without_traffic_has_none() -> None:
    finding = Finding(Kind.INVENTED, 1.0, "the module has not answered")

    lines = shown(finding, finding)

    assert lines[1:3] == ["  invented value at 1.000 s: the module has not answered", "  and 1 more"]
    assert list(provoke_report.summary([])) == [[("nothing ran", "bold")]]


@pytest.mark.parametrize(
    ("pieces", "arrives"),
    [
        ((), "nothing"),
        ((Piece(b"!01", 0.5), Piece(b"7018\r", 0.6)), None),
        ((Piece(b"?01\r", 0.5),), r"b'?01\r' at 1.500 s"),
    ],
)
def test_what_arrives_in_place_of_an_answer_is_shown(pieces: tuple[Piece, ...], arrives: str | None) -> None:
    observed = Observed(1.0, "host", b"$01M\r", Protocol.DCON, Profile(Model.I_7018), b"!017018\r", (), None, pieces)
    finding = Finding(Kind.WRONG, 1.0, "x", 0, 3)

    lines = shown(finding, exchanges=(observed,))

    assert [line.partition("arrives: ")[2] for line in lines if "arrives" in line] == ([arrives] if arrives else [])
