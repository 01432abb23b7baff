"""The dissector is in step with ``spec/``."""

from pathlib import Path

import pytest

from tests.spec.lint import SPEC
from wireshark.generate.__main__ import main
from wireshark.generate.files import generated
from wireshark.generate.lua import WIDTH

FILES = generated(SPEC)


@pytest.mark.parametrize("name", FILES)
def test_a_file_is_what_the_generator_makes_of_spec(name: str) -> None:
    """The file is too long for pytest to show how it differs."""
    is_current = (SPEC.parent / name).read_text("utf-8") == FILES[name]

    assert is_current, f"{name} is not what spec/ says; run: python -m wireshark.generate"


def test_the_command_writes_only_what_differs(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("wireshark.generate.__main__.ROOT", tmp_path)
    (tmp_path / "spec").symlink_to(SPEC)
    (tmp_path / "wireshark").mkdir()

    assert main() == 0
    assert capsys.readouterr().out == "wrote wireshark/i7000.lua\n"
    assert (tmp_path / "wireshark" / "i7000.lua").read_text("utf-8") == FILES["wireshark/i7000.lua"]
    assert main() == 0
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    "file", sorted((SPEC.parent / "wireshark/generate/templates").glob("*.lua")), ids=lambda it: it.name
)
def test_a_template_has_no_long_line_and_no_long_text(file: Path) -> None:
    lines = file.read_text("utf-8").splitlines()

    assert max(map(len, lines)) <= WIDTH
    assert len(lines) <= 450
