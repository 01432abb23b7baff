"""`i7000 statement`, and `i7000 check --statement`."""

import json
from pathlib import Path

import pytest

from tests.terminal import Run


def test_a_statement_is_json_that_the_module_is_checked_against(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "module.json"
    told = run("statement", "sim:I-7018")
    file.write_text(told.out, encoding="utf-8")

    checked = run("check", "sim:I-7018", "statement", "--statement", str(file))

    assert (told.code, json.loads(told.out)["model"]) == (0, "I-7018")
    assert checked.code == 0
    assert checked.out.count("statement/") == 3
    assert "4 PASS" in checked.out


def test_another_module_does_not_pass(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "module.json"
    file.write_text(run("statement", "sim:M-7019R,protocol=dcon").out, encoding="utf-8")

    checked = run("check", "sim:I-7018", "statement", "--statement", str(file))

    assert checked.code == 1
    assert "the statement claims" in checked.out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("statement",), "give --statement FILE, made by i7000 statement"),
        (("--statement", "no-such-file"), "no-such-file: No such file or directory"),
        (("--statement", "{here}"), "this is not a statement"),
    ],
)
def test_a_missing_or_damaged_statement_is_an_error(
    arguments: tuple[str, ...], message: str, run: Run, tmp_path: Path
) -> None:
    file = tmp_path / "damaged.json"
    file.write_text("{}", encoding="utf-8")

    told = run("check", "sim:I-7018", *(it.replace("{here}", str(file)) for it in arguments))

    assert told.code == 2
    assert message in told.err


def test_a_silent_module_has_no_statement(run: Run) -> None:
    told = run("statement", "sim:I-7018", "--address", "2")

    assert (told.code, told.out) == (3, "")
    assert "does not answer" in told.err
