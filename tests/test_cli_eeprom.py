"""``i7000 simulate --eeprom``: the file that keeps what modules remember."""

import errno
import os
from pathlib import Path
from threading import Thread

import pytest

from i7000 import Model
from i7000.cli.simulation import read_modules
from i7000.cli.words import UsageError
from i7000.device import factory
from i7000.simulator.memory import held, load, save
from tests.simulation import KELVIN, free_port, simulated, talk, unanswered
from tests.terminal import Run


def test_a_file_keeps_what_modules_remember(run: Run, tmp_path: Path) -> None:
    memory, port = tmp_path / "modules.json", free_port()
    url = f"socket://127.0.0.1:{port}"
    answers = []

    simulated(
        run, "--model", KELVIN, "--eeprom", str(memory), "--tcp", str(port),
        meanwhile=lambda: answers.extend(talk(url, b"~01OABC\r")),
    )  # fmt: skip
    simulated(run, "--eeprom", str(memory), "--tcp", str(port), meanwhile=lambda: answers.extend(talk(url, b"$01M\r")))

    assert answers == [b"!01\r", b"!01ABC\r"]
    assert [eeprom.name for eeprom in load(memory)] == ["ABC"]


def test_a_file_is_made_before_anything_is_printed(run: Run, tmp_path: Path) -> None:
    memory = tmp_path / "modules.json"

    simulated(run, "--model", KELVIN, "--eeprom", str(memory), "--tcp", "0")

    assert [eeprom.model for eeprom in load(memory)] == [Model.M_7019R]


def test_a_damaged_file_is_refused_and_left_as_it_is(run: Run, tmp_path: Path) -> None:
    memory = tmp_path / "modules.json"
    memory.write_text("{", encoding="utf-8")

    told = run("simulate", "--model", KELVIN, "--eeprom", str(memory))

    assert (told.code, told.out) == (2, "")
    assert str(memory) in told.err
    assert memory.read_text(encoding="utf-8") == "{"


def test_a_file_of_other_modules_is_refused(tmp_path: Path) -> None:
    memory = tmp_path / "modules.json"
    save(memory, [factory(Model.I_7018)])

    with pytest.raises(UsageError, match=r"holds I-7018@B4.5, not M-7019R@B3.7"):
        read_modules([KELVIN], [], seed=0, memory=memory)


def test_the_init_switch_is_not_in_the_file(tmp_path: Path) -> None:
    memory = tmp_path / "modules.json"
    save(memory, [factory(Model.I_7018)])

    (without,) = read_modules([], [], seed=0, memory=memory)
    (switched,) = read_modules(["I-7018,init=true"], [], seed=0, memory=memory)

    assert (without.init_switch, switched.init_switch) == (False, True)


def test_a_file_that_turns_into_something_else_is_shown(run: Run, tmp_path: Path) -> None:
    memory, port = tmp_path / "modules.json", free_port()

    def meanwhile() -> None:
        talk(f"socket://127.0.0.1:{port}", b"$01M\r")
        memory.unlink()
        os.mkfifo(memory)
        answers.append(unanswered(port, b"~01OABC\r"))

    answers: list[bytes] = []
    doing = Thread(target=meanwhile)
    doing.start()
    told = run("simulate", "--model", KELVIN, "--eeprom", str(memory), "--tcp", str(port))
    doing.join()

    assert answers == [b""]
    assert told.code == 2
    assert "is a device or pipe" in told.err


def test_a_file_that_cannot_be_written_is_shown(run: Run, tmp_path: Path) -> None:
    memory = tmp_path / "nowhere" / "modules.json"

    told = run("simulate", "--model", KELVIN, "--eeprom", str(memory))

    assert (told.code, told.out) == (2, "")
    assert told.err == f"i7000: {memory}: No such file or directory\n"


def test_a_file_that_another_simulator_uses_is_refused(run: Run, tmp_path: Path) -> None:
    memory = tmp_path / "modules.json"

    with held(memory):
        told = run("simulate", "--model", KELVIN, "--eeprom", str(memory))

    assert (told.code, told.out) == (2, "")
    assert told.err.startswith(f"i7000: {memory} is used by another simulator")


def test_what_a_full_disk_does_not_store_is_not_acknowledged(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    memory, port = tmp_path / "modules.json", free_port()
    answers = []

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def meanwhile() -> None:
        answers.extend(talk(f"socket://127.0.0.1:{port}", b"$01M\r"))
        monkeypatch.setattr(os, "fsync", full)
        answers.append(unanswered(port, b"~01OABC\r"))

    doing = Thread(target=meanwhile)
    doing.start()
    told = run("simulate", "--model", KELVIN, "--eeprom", str(memory), "--tcp", str(port))
    doing.join()

    assert answers == [b"!017019R\r", b""]
    assert (told.code, told.err) == (2, f"i7000: {memory}: No space left on device\n")
    assert [eeprom.name for eeprom in load(memory)] == ["7019R"]
