"""What is generated from ``spec/`` is in step with it, and written only where it differs."""

from importlib import import_module
from pathlib import Path

import pytest

from tests.generated import GENERATORS, files_of
from tests.spec.lint import SPEC

each_generator = pytest.mark.parametrize("generator", GENERATORS)


@each_generator
def test_a_file_is_what_the_generator_makes_of_spec(generator: str) -> None:
    """The files are too long for pytest to show how they differ."""
    files = files_of(generator)
    stale = [name for name, written in files.items() if (SPEC.parent / name).read_text("utf-8") != written]

    assert stale == [], f"{', '.join(stale)}: not what spec/ says; run: python -m {generator}.generate"


@each_generator
def test_the_command_writes_only_what_differs(
    generator: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program = import_module(f"{generator}.generate.__main__")
    monkeypatch.setattr(program, "ROOT", tmp_path)
    (tmp_path / "spec").symlink_to(SPEC)
    (tmp_path / generator).mkdir()
    files = files_of(generator)
    *current, missing = files
    for name in current:
        (tmp_path / name).write_text(files[name], "utf-8")

    assert program.main() == 0
    assert capsys.readouterr().out == f"wrote {missing}\n"
    assert (tmp_path / missing).read_text("utf-8") == files[missing]
    assert program.main() == 0
    assert capsys.readouterr().out == ""
