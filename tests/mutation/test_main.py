import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.mutation import __main__ as program
from tests.mutation import equivalent
from tests.mutation.results import Result
from tests.mutation.runner import BrokenTestsError
from tests.mutation.scratch import ROOT


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--only", "src/i7000/nowhere"], "--only: no file of 'src/i7000/nowhere' has mutants; the targets are CRC, "),
        (["--sample", "0"], "--sample: 0 is less than 1"),
        (["--stages", "0"], "--stages: 0 is less than 1"),
        (["--timeout", "0"], "--timeout: 0 is not above 0"),
        (["--report", "/nowhere/at/all.json"], "--report: there is no folder /nowhere/at"),
        (["--seed", "x"], "argument --seed: invalid int value: 'x'"),
    ],
)
def test_wrong_usage_is_refused_with_the_reason(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit, match="2"):
        program.arguments(words)

    assert said in capsys.readouterr().err


class Copied:
    """In place of the scratch copy: the checkout itself, which is only read."""

    def __init__(self, *_: object) -> None:
        self.folder = ROOT

    def text(self, file: str) -> str:
        return (ROOT / file).read_text(encoding="utf-8")

    def close(self) -> None:
        """Nothing was started."""


@pytest.fixture(autouse=True)
def copied(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(program, "Scratch", Copied)
    monkeypatch.setattr(program, "files_of_git", list)


@pytest.fixture
def play(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Returns a function that sets what comes of the mutants."""

    def played(*results: object) -> None:
        monkeypatch.setattr(program, "Runner", type("Here", (Played,), {"results": results}))

    return played


class Played:
    """In place of the runner: the results that a test wants, one for each mutant."""

    results: tuple[Any, ...] = ()

    def __init__(self, *_: object) -> None:
        self._left = list(self.results)

    def stages(self, _: object) -> int:
        return 1

    def run(self, *_: object) -> Result:
        result = self._left.pop(0)
        if isinstance(result, BaseException):
            raise result
        return Result(result, 1, 0.5)


@pytest.mark.parametrize(
    ("results", "code", "said"),
    [
        (("killed", "timeout"), 0, "CRC               2        1        1        0        0   100.0%  100% met"),
        (("killed", "survived"), 1, "CRC               2        1        0        1        0    50.0%  100% MISSED"),
        (("killed", KeyboardInterrupt()), 130, "INCOMPLETE: the run was stopped"),
    ],
)
def test_the_exit_code_and_the_report_say_how_a_run_ended(
    results: tuple[Any, ...], code: int, said: str, tmp_path: Path, play: Callable[..., None]
) -> None:
    report, text = tmp_path / "report.json", tmp_path / "report.txt"
    words = ["--only", "CRC", "--sample", "2", "--seed", "1", "--report", str(report), "--report", str(text)]
    play(*results)

    assert program.main(words, tmp_path / "results.jsonl") == code
    assert said in text.read_text()
    assert json.loads(report.read_text())["complete"] is (code != 130)


def test_tests_that_fail_without_a_mutant_end_the_run(
    tmp_path: Path, play: Callable[..., None], capsys: pytest.CaptureFixture[str]
) -> None:
    play(BrokenTestsError("tests: failed without a mutant"))

    assert program.main(["--only", "CRC", "--sample", "1"], tmp_path / "results.jsonl") == 3
    assert "tests: failed without a mutant" in capsys.readouterr().err


def test_a_run_goes_on_where_it_was(tmp_path: Path, play: Callable[..., None]) -> None:
    words = ["--only", "CRC", "--sample", "3", "--seed", "1"]
    results = tmp_path / "results.jsonl"
    play("killed", KeyboardInterrupt())
    assert program.main(words, results) == 130
    play("killed", "killed")
    assert program.main(words, results) == 0
    play()

    assert program.main(words, results) == 0


def test_equivalent_mutants_alone_are_no_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(equivalent, "reason_of", lambda *_: "It is the same.")

    assert program.main(["--only", "CRC", "--sample", "2"], tmp_path / "results.jsonl") == 5
