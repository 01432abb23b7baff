"""The templates of the dissector are of the size of other files."""

from pathlib import Path

import pytest

from tests.spec.lint import SPEC
from wireshark.generate.lua import WIDTH


@pytest.mark.parametrize(
    "file", sorted((SPEC.parent / "wireshark/generate/templates").glob("*.lua")), ids=lambda it: it.name
)
def test_a_template_has_no_long_line_and_no_long_text(file: Path) -> None:
    lines = file.read_text("utf-8").splitlines()

    assert max(map(len, lines)) <= WIDTH
    assert len(lines) <= 450
