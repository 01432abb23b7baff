"""The package against programs that nobody here wrote: tshark, mbpoll, pymodbus, libmodbus, minimalmodbus, pyserial."""

import os
import shutil
from typing import NoReturn

import pytest


def program(name: str) -> str:
    """The path of a program; without it the test is skipped, or fails where ``CI`` is set."""
    path = shutil.which(name)
    return not_installed(name) if path is None else path


def not_installed(name: str) -> NoReturn:
    """Skip the test that needs something, or fail where ``CI`` is set."""
    if os.environ.get("CI"):
        pytest.fail(f"{name} is not installed, and CI is to run what needs it")
    pytest.skip(f"{name} is not installed")
