"""What the README shows is what happens."""

import re
import shlex
from itertools import pairwise
from pathlib import Path

import pytest

from i7000 import Fault, Protocol
from i7000.cli.simulation import read_modules
from i7000.host import Policy
from i7000.simulator.faults import Piece
from tests.host.port import Port
from tests.terminal import Run

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


PAGE = (ROOT / "docs" / "half_duplex.md").read_text(encoding="utf-8")


def run_example(number: int) -> None:
    exec(compile(re.findall(r"```python\n(.*?)```", README, re.DOTALL)[number], "README.md", "exec"), {})  # noqa: S102


def test_the_modbus_example_runs_and_prints_what_it_says(capsys: pytest.CaptureFixture[str]) -> None:
    run_example(1)

    (printed,) = capsys.readouterr().out.splitlines()
    assert f"# {printed}" in README


def test_the_example_runs_and_prints_what_it_says(capsys: pytest.CaptureFixture[str]) -> None:
    run_example(0)

    printed = capsys.readouterr().out.splitlines()
    assert len(printed) == 8
    assert printed[2] == "2 None degC disabled"
    assert printed[3] == "3 None degC over_range"
    assert printed[0] == "0 25.1 degC ok"


def test_the_listener_prints_what_its_comments_say(capsys: pytest.CaptureFixture[str]) -> None:
    run_example(2)

    reading, facts = capsys.readouterr().out.splitlines()
    assert f"# {reading}\n" in README
    assert f"\n# {facts}\n" in README


def test_the_simulator_in_a_test_prints_what_its_comment_says(capsys: pytest.CaptureFixture[str]) -> None:
    run_example(5)

    assert f"# {capsys.readouterr().out.strip()}: a pseudo-terminal" in README


def test_the_driver_reads_what_a_module_answers(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    port = Port(lambda _wire, _now: (Piece(b">" + b"+0025.1" * 8 + b"\r", 0.02),))
    monkeypatch.setattr("time.monotonic", port.now)
    monkeypatch.setattr("serial.Serial", lambda *_: port)

    run_example(3)

    assert (capsys.readouterr().out, port.written) == ("25.1\n", [b"#01\r"])


def test_the_page_about_the_line_has_the_loop_of_the_driver() -> None:
    (loop,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)

    assert loop in README
    assert "(docs/half_duplex.md)" in README


def test_the_page_about_the_line_has_the_defaults() -> None:
    for text, value in re.findall(r"`Policy\.(\w+)`\s\(([\d.]+) (?:s )?unless\sgiven\)", PAGE):
        assert getattr(Policy(), text) == float(value)

    assert PAGE.count("unless given") == 3
    assert "1 second after each deadline" in README


@pytest.mark.parametrize(
    "name",
    [
        *sorted(path.name for path in ROOT.glob("*.md")),
        *sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "spec").glob("*.md")),
        "c/README.md",
        "tests/README.md",
        "docs/check_a_module.md",
        "docs/half_duplex.md",
        "docs/find_a_module.md",
        "docs/judge_a_line.md",
        "docs/port_the_codec.md",
        "docs/test_a_driver.md",
    ],
)
def test_text_keeps_to_the_line_width_of_the_code(name: str) -> None:
    text = re.sub(r"```.*?```|^[|#].*?$", "", (ROOT / name).read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)

    assert [line for line in text.splitlines() if len(line) > 120] == []


def test_every_fault_is_explained() -> None:
    assert {fault.name for fault in Fault} == set(
        re.findall(r"`([A-Z_]+)`", "".join(re.findall(r"^\| `[A-Z].*? \|", README, re.MULTILINE)))
    )


def test_there_is_one_command_to_see_it_work_and_one_to_run_the_tests() -> None:
    for heading in ("See it work", "Run the tests"):
        (block,) = re.findall(rf"## {heading}\n.*?```sh\n(.*?)```", README, re.DOTALL)
        assert block.count("\n") == 1


def test_the_first_command_understands_all(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    (arguments,) = re.findall(r"bin/i7000 (decode .*)", README)
    monkeypatch.chdir(ROOT)

    assert run(*arguments.split()).code == 0


def test_the_first_command_prints_the_lines_that_are_shown(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    (arguments,) = re.findall(r"bin/i7000 (decode .*)", README)
    (shown,) = re.findall(r"```text\n(.*?)```", README, re.DOTALL)
    monkeypatch.chdir(ROOT)

    assert shown in run(*arguments.split()).out


@pytest.mark.parametrize("arguments", re.findall(r"^i7000 (decode .*)$", README, re.MULTILINE))
def test_what_is_decoded_is_understood(run: Run, monkeypatch: pytest.MonkeyPatch, arguments: str) -> None:
    monkeypatch.chdir(ROOT)

    assert run(*shlex.split(arguments)).code == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    list(
        zip(
            re.findall(r"`i7000 ((?:decode|registers) --(?!schema|help)[^`]*)`", README),
            ["40489 host_watchdog_timeout 10 s", "40489 host_watchdog_timeout R/W"],
            strict=True,
        )
    ),
)
def test_the_examples_at_the_terminal_print_what_the_readme_says(run: Run, arguments: str, words: str) -> None:
    result = run(*shlex.split(arguments))

    assert words in " ".join(result.out.split())
    assert result.code == 0


@pytest.mark.parametrize("arguments", re.findall(r"`i7000 ((?:commands|registers|errata|encode) [^-`][^`]*)`", README))
def test_what_the_terminal_explains_and_writes_is_there(run: Run, arguments: str) -> None:
    assert run(*shlex.split(arguments)).code == 0


def test_the_modules_of_the_simulated_bus_speak_one_protocol() -> None:
    (example,) = re.findall(r"^i7000 simulate (.*)$", README, re.MULTILINE)
    arguments = shlex.split(example)
    values = {name: [value for before, value in pairwise(arguments) if before == name] for name in arguments}

    modules = read_modules(values["--model"], values["--signal"], seed=0, memory=None)

    assert [module.eeprom.protocol for module in modules] == [Protocol.DCON] * 2


@pytest.mark.parametrize("path", sorted(set(re.findall(r"`((?:spec|src|tests)/[\w./]*)`", README))))
def test_every_path_that_is_named_exists(path: str) -> None:
    assert (ROOT / path).exists()
