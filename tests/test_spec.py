"""`i7000.spec`: where the files of ``spec/`` are, installed or in a checkout."""

import importlib.util
import shutil
import sys
from pathlib import Path

import pytest

from i7000 import spec
from tests.spec.lint import SPEC


def test_a_checkout_has_the_files_in_its_own_folder() -> None:
    assert spec.files() == SPEC


def test_a_wheel_has_the_files_beside_the_module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    installed = Path(shutil.copytree(SPEC, tmp_path / "installed_spec"))
    module = Path(shutil.copy(str(spec.__file__), installed))
    found = importlib.util.spec_from_file_location(installed.name, module, submodule_search_locations=[str(installed)])
    assert found is not None
    assert found.loader is not None
    package = importlib.util.module_from_spec(found)
    monkeypatch.setitem(sys.modules, installed.name, package)
    found.loader.exec_module(package)

    assert installed == package.files()
