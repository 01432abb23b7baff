"""What a second type checker knows: pyright in its strict mode, on the samples, the examples and the README."""

import json
import os
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_pyright_agrees_about_user_code(tmp_path: Path) -> None:
    if find_spec("basedpyright") is None:
        assert not os.environ.get("CI"), "basedpyright is not installed, and CI is to run what needs it"
        pytest.skip("basedpyright is not installed")
    for number, block in enumerate(re.findall(r"```python\n(.*?)```", README, re.DOTALL)):
        (tmp_path / f"readme_{number}.py").write_text(block, encoding="utf-8")
    (tmp_path / "pyrightconfig.json").write_text(
        json.dumps(
            {"typeCheckingMode": "strict", "pythonPlatform": "Linux", "extraPaths": [str(ROOT / "src"), str(ROOT)]}
        ),
        encoding="utf-8",
    )
    places = [tmp_path, ROOT / "tests" / "typing", ROOT / "src" / "i7000" / "examples"]
    files = [str(path) for place in places for path in sorted(place.glob("*.py")) if path != Path(__file__)]

    checked = subprocess.run(  # noqa: S603
        [sys.executable, "-m", "basedpyright", "--pythonpath", sys.executable, "--project", str(tmp_path), *files],
        capture_output=True,
        text=True,
        check=False,
    )

    assert (checked.returncode, checked.stdout) == (0, "0 errors, 0 warnings, 0 notes\n")
