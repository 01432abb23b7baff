"""The campaign runs targets and keeps the ledger; what fails is said."""

import json
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from fuzz import campaign
from fuzz.campaign import Run, executions, main, totals
from fuzz.engine import INSTALL
from fuzz.targets import FOLDER, TARGETS

needs_atheris = pytest.mark.skipif(find_spec("atheris") is None, reason=INSTALL)


class Engine:
    """An engine that runs nothing, and is told what comes of it."""

    def __init__(self, *crashes: str) -> None:
        self.asked: list[tuple[str, int, int | None]] = []
        self.crashes = crashes

    def __call__(self, target: str, seconds: int, most: int | None) -> Run:
        self.asked.append((target, seconds, most))
        return Run(target, 1000, 2.4, self.crashes, "Uncaught Python exception" if self.crashes else "")


def entries(ledger: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in ledger.read_text("utf-8").splitlines()]


def test_each_run_is_a_line_of_the_ledger(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ledger = tmp_path / "ledger.jsonl"
    engine = Engine()

    for _ in range(2):
        assert (
            main(["--minutes", "1", "--target", "dcon_split", "--executions", "7"], engine=engine, ledger=ledger) == 0
        )

    assert engine.asked == [("dcon_split", 60, 7)] * 2
    first, _ = entries(ledger)
    assert first.keys() == {"target", "executions", "seconds", "commit", "date", "crashes"}
    assert (first["target"], first["executions"], first["seconds"], first["crashes"]) == ("dcon_split", 1000, 2, 0)
    assert totals(ledger)["dcon_split"] == 2000
    assert "dcon_split: 2,000 executions in the ledger" in capsys.readouterr().out


def test_the_time_is_shared_by_the_targets(tmp_path: Path) -> None:
    engine = Engine()

    main(["--minutes", "9"], engine=engine, ledger=tmp_path / "ledger.jsonl")

    assert [target for target, _, _ in engine.asked] == list(TARGETS)
    assert {seconds for _, seconds, _ in engine.asked} == {round(9 * 60 / len(TARGETS))}


@pytest.mark.parametrize(("crash", "named"), [("crash-1", "crash-1"), ("", "the fuzzer itself")])
def test_an_input_that_fails_is_named_and_counted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], crash: str, named: str
) -> None:
    ledger = tmp_path / "ledger.jsonl"

    code = main(["--minutes", "1", "--target", "recording"], engine=Engine(crash), ledger=ledger)

    told = capsys.readouterr().out
    assert code == 1
    assert entries(ledger)[0]["crashes"] == 1
    assert "Uncaught Python exception" in told
    assert f"recording: failed: {named}; see fuzz/crashes/recording" in told


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["--minutes", "0"],
        ["--minutes", "nan"],
        ["--minutes", "1", "--executions", "0"],
        ["--minutes", "1", "--target", "x"],
    ],
)
def test_wrong_options_are_refused(arguments: list[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(arguments, engine=Engine())

    assert caught.value.code == 2


def test_without_atheris_the_campaign_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(campaign, "find_spec", lambda _: None)

    assert main(["--minutes", "1"]) == 2
    assert "pip install --group fuzz" in capsys.readouterr().err


def test_a_fuzzer_without_atheris_says_what_to_install() -> None:
    program = "import sys; sys.modules['atheris'] = None; from fuzz.engine import main; main('dcon_command')"
    done = subprocess.run(  # noqa: S603
        [sys.executable, "-c", program], cwd=FOLDER.parent, check=False, capture_output=True, text=True, timeout=60
    )

    assert (done.returncode, done.stderr) == (1, f"{INSTALL}\n")


@pytest.mark.parametrize(
    ("output", "count"),
    [
        ("#2\tINITED cov: 3\n#5\tDONE\nstat::number_of_executed_units: 7\n", 7),
        ("#2\tINITED cov: 3\n#512\tpulse cov: 3\n", 512),
        ("ModuleNotFoundError", 0),
    ],
)
def test_executions_are_what_the_fuzzer_printed(output: str, count: int) -> None:
    assert executions(output) == count


def test_the_ledger_of_the_repository_is_of_its_targets() -> None:
    found = entries(campaign.LEDGER)

    assert {entry["target"] for entry in found} <= set(TARGETS)
    assert all(entry["executions"] >= 0 and entry["crashes"] >= 0 and entry["commit"] for entry in found)


def test_a_fuzzer_that_does_not_end_is_ended_and_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(campaign, "FOLDER", tmp_path / "fuzz")
    monkeypatch.setattr(campaign, "_TO_END", 0.1)
    monkeypatch.setattr(campaign, "_command", lambda *_: [sys.executable, "-c", "input()"])
    monkeypatch.setattr(subprocess, "run", _times_out)

    run = campaign.fuzz("dcon_split", 1, None)

    assert (run.executions, run.crashes) == (0, ("",))


def _times_out(command: list[str], **_: object) -> None:
    raise subprocess.TimeoutExpired(command, 1)


@needs_atheris
def test_a_target_is_fuzzed_with_atheris(tmp_path: Path) -> None:
    ledger = tmp_path / "ledger.jsonl"

    assert main(["--minutes", "1", "--target", "reading_text", "--executions", "3000"], ledger=ledger) == 0
    assert entries(ledger)[0]["executions"] >= 3000
