"""The names of the package, and what their import brings along."""

import subprocess
import sys

import pytest

from i7000 import link


@pytest.mark.parametrize("name", link.__all__)
def test_each_public_name_is_there_and_documented(name: str) -> None:
    assert getattr(link, name).__doc__
    assert name in dir(link)


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'Serial'"):
        link.Serial  # noqa: B018


@pytest.mark.parametrize(
    ("use", "unwanted"),
    [
        ("link.Line", {"asyncio", "i7000.device", "i7000.simulator", "i7000.cli", "cyclopts", "rich"}),
        ("link.open_target('sim:I-7018')", {"cyclopts", "rich", "cattrs", "filelock"}),
    ],
)
def test_what_a_use_does_not_need_is_not_imported(use: str, unwanted: set[str]) -> None:
    script = f"import sys; from i7000 import link; {use}; print(sorted({unwanted} & set(sys.modules)))"

    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)  # noqa: S603

    assert found.stdout == "[]\n"
