"""The archive of ``spec/``: the same bytes from the same files, and whole without Python."""

from __future__ import annotations

import os
import shutil
import subprocess
from hashlib import sha256
from typing import TYPE_CHECKING

import pytest

from tests.spec import archive, index, lint

if TYPE_CHECKING:
    from pathlib import Path

needs_programs = pytest.mark.skipif(
    not (shutil.which("tar") and shutil.which("sha256sum")) and not os.environ.get("CI"),
    reason="needs tar and sha256sum",
)


def test_the_same_files_make_the_same_archive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = archive.packed()
    copy = shutil.copytree(lint.SPEC, tmp_path / "spec", copy_function=shutil.copyfile)
    monkeypatch.setattr(lint, "SPEC", copy)
    monkeypatch.setattr(index, "INDEX", copy / lint.INDEX)
    (copy / "VERSION").chmod(0o600)

    assert archive.packed() == before


@needs_programs
def test_the_archive_is_unpacked_and_verified_without_python(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert archive.main([str(tmp_path)]) == 0
    (packed,) = tmp_path.glob("*.tar.gz")
    subprocess.run(["tar", "xzf", packed.name], cwd=tmp_path, check=True)  # noqa: S603, S607
    folder = tmp_path / archive.stem()
    subprocess.run(["sha256sum", "--check", "--quiet", archive.SUMS], cwd=folder, check=True)  # noqa: S603, S607

    names = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
    assert names == {lint.name(path) for path in lint.SPEC.rglob("*") if path.is_file()} | {archive.SUMS}
    assert capsys.readouterr().out == f"{sha256(packed.read_bytes()).hexdigest()}  {packed}\n"


def test_files_that_the_index_does_not_follow_are_not_packed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(index, "text", lambda: "")

    assert archive.main([str(tmp_path)]) == 1
    assert index.COMMAND in capsys.readouterr().err
    assert [*tmp_path.iterdir()] == []


def test_a_folder_has_to_be_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert archive.main([]) == 2
    assert "FOLDER" in capsys.readouterr().err
