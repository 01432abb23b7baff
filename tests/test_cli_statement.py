"""`i7000 statement`, and `i7000 check --statement`."""

import json
import shlex
from pathlib import Path

import pytest

from tests.firmwares import FirmwarePort, Play, played
from tests.terminal import Run, Told, plain, run

__all__ = ["plain", "played", "run"]


def test_a_statement_is_json_that_the_module_is_checked_against(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "module.json"
    told = run("statement", "sim:I-7018")
    file.write_text(told.out, encoding="utf-8")

    checked = run("check", "sim:I-7018", "statement", "--statement", str(file))

    assert (told.code, json.loads(told.out)["model"]) == (0, "I-7018")
    assert checked.code == 0
    assert checked.out.count("statement/") == 3
    assert "4 PASS" in checked.out


def test_the_statement_is_checked_whatever_is_selected(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "module.json"
    file.write_text(run("statement", "sim:I-7018").out, encoding="utf-8")

    checked = run("check", "sim:I-7018", "link/alive", "--statement", str(file))

    assert (checked.code, checked.out.count("statement/")) == (0, 3)


def test_a_certificate_says_whether_there_was_a_statement(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "module.json"
    file.write_text(run("statement", "sim:I-7018").out, encoding="utf-8")
    without = run("check", "sim:I-7018", "--certify", "--quiet")
    stated = run("check", "sim:I-7018", "--certify", "--quiet", "--statement", str(file))

    scope = "PASSED for observe, memory; not allowed: broadcast, write, comm, calibration"
    assert [told.out.splitlines()[-1] for told in (without, stated)] == [f"{scope}; without a statement", scope]


def clone(frame: bytes, answer: bytes | None) -> bytes | None:
    """Answer as a module of no known model: another type, and a name of its own."""
    return {b"$012\r": b"!01440600\r", b"$01M\r": b"!01CLONE\r"}.get(frame, answer)


def test_an_unknown_module_is_taken_for_the_nearest_model(run: Run, tmp_path: Path, played: Play) -> None:
    def at_a_clone(*arguments: str) -> Told:
        played(FirmwarePort(clone))
        return run(*arguments)

    file = tmp_path / "module.json"
    unknown = at_a_clone("statement", "sim:I-7018")
    told = at_a_clone("statement", "sim:I-7018", "--model", "I-7018")
    file.write_text(told.out, encoding="utf-8")

    assert (unknown.code, "give --model" in unknown.err) == (2, True)
    assert (told.code, json.loads(told.out)["model"], json.loads(told.out)["name"]) == (0, "I-7018", "CLONE")
    assert at_a_clone("check", "sim:I-7018", "link").code == 2
    assert at_a_clone("check", "sim:I-7018", "link", "--model", "I-7018").code == 0
    assert at_a_clone("check", "sim:I-7018", "link/alive", "--statement", str(file)).code == 0
    assert at_a_clone("check", "sim:I-7018", "link/alive", "--model", "I-7018", "--type", "PT100").code == 2


def test_another_module_does_not_pass(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "module.json"
    file.write_text(run("statement", "sim:M-7019R,protocol=dcon").out, encoding="utf-8")

    checked = run("check", "sim:I-7018", "statement", "--statement", str(file))

    assert checked.code == 1
    assert "the statement claims" in checked.out
    again = f"i7000 check sim:I-7018 statement/is-there --statement {shlex.quote(str(file))}"
    assert f"    repeat    {again}\n" in checked.out
    assert run(*shlex.split(again)[1:]).code == 1


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
