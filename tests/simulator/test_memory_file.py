"""The file of a memory: how it is written, and who may use it."""

import errno
import fcntl
import os
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from attrs import evolve

from i7000.device import CAPACITY, Log, Record
from i7000.simulator import memory
from i7000.simulator.memory import MemoryFileError, held, load, save
from tests.simulator.eeproms import MODULES


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "bus.json"


# --- how it is written ------------------------------------------------------------------------------------------------


def test_a_file_keeps_its_mode(path: Path) -> None:
    save(path, [])
    path.chmod(0o640)

    save(path, MODULES)

    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_a_new_file_has_the_mode_of_new_files(path: Path) -> None:
    other = path.with_name("other")
    other.touch()

    save(path, MODULES)

    assert path.stat().st_mode == other.stat().st_mode


def test_what_a_link_names_is_replaced_and_not_the_link(path: Path) -> None:
    target = path.parent / "elsewhere" / "real.json"
    target.parent.mkdir()
    path.symlink_to(target)

    save(path, MODULES)
    save(path, MODULES[:1])

    assert path.is_symlink()
    assert load(target) == MODULES[:1]


@pytest.mark.parametrize(("place", "call"), [(os, "fsync"), (Path, "replace")])
def test_a_failure_leaves_the_old_file_and_nothing_else(
    path: Path, monkeypatch: pytest.MonkeyPatch, place: object, call: str
) -> None:
    save(path, MODULES)
    before = path.read_bytes()

    def fail(*_: object) -> None:
        raise OSError(errno.ENOSPC, "disk full", "a temporary file")

    monkeypatch.setattr(place, call, fail)
    with pytest.raises(OSError, match="disk full") as failed:
        save(path, [])

    assert failed.value.filename == str(path)
    assert path.read_bytes() == before
    assert list(path.parent.iterdir()) == [path]


def test_what_could_not_be_loaded_is_not_saved(path: Path) -> None:
    save(path, MODULES)
    of_15_channels = Log(records=(Record(1, (0,) * 15, 0),))

    with pytest.raises(MemoryFileError) as caught:
        save(path, [MODULES[0], evolve(MODULES[1], log=of_15_channels)])

    assert caught.value.place == "modules[1].log.records[0].words"
    assert load(path) == MODULES
    assert list(path.parent.iterdir()) == [path]


def test_the_new_file_is_on_the_disk_before_it_takes_the_place_of_the_old(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = []
    fsync, replace = os.fsync, Path.replace

    def synced(descriptor: int) -> None:
        calls.append("directory" if stat.S_ISDIR(os.fstat(descriptor).st_mode) else "file")
        fsync(descriptor)

    def replaced(self: Path, target: Path) -> Path:
        calls.append("replace")
        return replace(self, target)

    monkeypatch.setattr(os, "fsync", synced)
    monkeypatch.setattr(Path, "replace", replaced)
    save(path, MODULES)

    assert calls == ["file", "replace", "directory"]


def test_a_directory_that_cannot_be_opened_is_no_failure(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> int:
        raise PermissionError("no directories")

    with monkeypatch.context() as patched:
        patched.setattr(os, "open", refuse)
        save(path, MODULES)

    assert load(path) == MODULES


@pytest.mark.parametrize("call", [load, lambda path: save(path, MODULES)], ids=["load", "save"])
def test_a_pipe_is_no_memory(path: Path, call: Callable[[Path], object]) -> None:
    os.mkfifo(path)

    with pytest.raises(MemoryFileError, match="a device or pipe; allowed: a regular file"):
        call(path)

    assert stat.S_ISFIFO(path.stat().st_mode)


@pytest.mark.parametrize("call", [load, lambda path: save(path, MODULES)], ids=["load", "save"])
def test_a_directory_is_no_memory(path: Path, call: Callable[[Path], object]) -> None:
    path.mkdir()

    with pytest.raises(IsADirectoryError):
        call(path)


def hold(path: Path) -> None:
    with held(path):
        pass


@pytest.mark.parametrize("call", [hold, lambda path: save(path, MODULES)], ids=["held", "save"])
def test_a_directory_that_is_not_there_is_not_made(path: Path, call: Callable[[Path], object]) -> None:
    nowhere = path.parent / "nowhere" / "bus.json"
    with pytest.raises(FileNotFoundError) as failed:
        call(nowhere)

    assert str(failed.value) == f"[Errno 2] No such file or directory: '{nowhere}'"
    assert list(path.parent.iterdir()) == []


@pytest.mark.parametrize("call", [hold, lambda path: save(path, [])], ids=["held", "save"])
def test_a_read_only_file_is_not_replaced(path: Path, call: Callable[[Path], object]) -> None:
    save(path, MODULES)
    path.chmod(0o444)

    with pytest.raises(PermissionError, match="the file is read-only") as failed:
        call(path)

    assert failed.value.filename == str(path)
    assert load(path) == MODULES
    assert list(path.parent.iterdir()) == [path]


def test_a_file_that_another_user_may_write_is_not_replaced(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    save(path, MODULES)
    monkeypatch.setattr(os, "access", lambda *_: False)

    with pytest.raises(PermissionError, match="the file is read-only"):
        save(path, [])


def test_more_than_can_be_loaded_is_not_saved(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "_MOST", 1000)

    with pytest.raises(MemoryFileError, match=r"would have \d{4} bytes; allowed: 1000 bytes"):
        save(path, MODULES)

    assert not path.exists()


def test_a_file_has_room_for_256_modules_with_full_logs(path: Path) -> None:
    record = Record(0xFFFFFFFF, (0xFFFF,) * 16, 0xFFFFFFFF)
    save(path, [evolve(MODULES[1], log=evolve(MODULES[1].log, records=(record,) * CAPACITY))])

    assert 256 * path.stat().st_size < memory._MOST  # noqa: SLF001


# --- who may use it ---------------------------------------------------------------------------------------------------


def test_a_file_is_used_by_one_simulator_at_a_time(path: Path) -> None:
    link = path.with_name("link.json")
    link.symlink_to(path)

    with held(path):
        save(path, MODULES)
        with pytest.raises(MemoryFileError) as refused:
            hold(link)
    hold(link)

    assert str(refused.value) == (f"{link} is used by another simulator; allowed: one simulator for each file")


def test_a_file_that_cannot_be_locked_is_not_said_to_be_used(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", fail)
    with pytest.raises(OSError, match=r"cannot be locked by .bus.json.lock beside it: No locks available") as failed:
        hold(path)

    assert failed.value.filename == str(path)


def test_a_lock_that_cannot_be_made_is_named(path: Path) -> None:
    path.with_name(".bus.json.lock").mkdir()

    with pytest.raises(IsADirectoryError, match=r"cannot be locked by .bus.json.lock beside it: .*: '.*bus.json'$"):
        hold(path)


def test_a_hard_link_is_a_file_of_its_own_once_it_is_saved(path: Path) -> None:
    save(path, MODULES)
    link = path.with_name("link.json")
    link.hardlink_to(path)

    with held(path), held(link):
        save(link, MODULES[:1])

        assert (load(path), load(link)) == (MODULES, MODULES[:1])


def test_the_lock_of_a_process_that_was_killed_is_gone(path: Path) -> None:
    script = f"from i7000.simulator.memory import held\nwith held({str(path)!r}): print('held', flush=True); input()"
    with subprocess.Popen(  # noqa: S603 - ourselves
        [sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as other:
        assert other.stdout
        assert other.stdout.readline() == b"held\n"
        with pytest.raises(MemoryFileError, match="is used by another simulator"):
            hold(path)

        other.kill()
    hold(path)

    assert not path.exists()


def test_what_an_interrupted_save_has_left_is_removed(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", interrupted)
        patched.setattr(Path, "unlink", lambda *_, **__: None)
        with pytest.raises(KeyboardInterrupt):
            save(path, MODULES)
    (left,) = path.parent.iterdir()
    others = [path.with_name(name) for name in (".bus.json.tmp", ".bus.json.more.0123456789abcdef.tmp", "other.tmp")]
    for other in others:
        other.touch()

    hold(path)

    assert left.suffix == ".tmp"
    assert sorted(path.parent.iterdir()) == sorted([path.with_name(".bus.json.lock"), *others])
