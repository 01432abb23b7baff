"""Which files are opened: regular ones, not empty and not too large."""

import os
from pathlib import Path

import pytest

from i7000.simulator.files import UnsuitableFileError, open_regular


def refusal(path: Path | str) -> str:
    with pytest.raises(UnsuitableFileError) as refused:
        open_regular(path, 1_000_000)
    return str(refused.value)


def test_a_regular_file_is_opened(tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.write_bytes(b"x" * 1_000_000)

    with open_regular(path, 1_000_000) as file:
        assert file.read() == path.read_bytes()


@pytest.mark.parametrize("path", ["/dev/zero", "/dev/full", "/dev/null"])
def test_a_device_is_refused(path: str) -> None:
    assert refusal(path) == f"{path} is a device or pipe; allowed: a regular file"


def test_a_pipe_is_refused_without_waiting_for_a_writer(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")

    assert "is a device or pipe" in refusal(tmp_path / "pipe")


def test_a_pipe_that_takes_the_place_of_a_file_is_refused_without_waiting(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, other = tmp_path / "pipe", tmp_path / "file"
    os.mkfifo(path)
    other.write_text("x")
    regular = other.stat()
    monkeypatch.setattr(Path, "stat", lambda _: regular)

    assert "is a device or pipe" in refusal(path)


def test_a_directory_is_refused(tmp_path: Path) -> None:
    with pytest.raises(IsADirectoryError, match="Is a directory"):
        open_regular(tmp_path, 1)


def test_an_empty_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.touch()

    assert refusal(path) == f"{path} is empty; allowed: a file with contents"


@pytest.mark.skipif(not Path("/proc/kmsg").exists(), reason="not Linux")
def test_a_file_of_the_kernel_that_is_read_without_end_is_refused() -> None:
    assert "is empty" in refusal("/proc/self/status")


def test_a_file_that_is_too_large_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "file"
    with path.open("wb") as file:
        file.truncate(10**12)

    assert refusal(path) == f"{path} has 1000000 MB; allowed: 1 MB"
