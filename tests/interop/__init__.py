"""The package against programs that nobody here wrote: tshark, mbpoll, pymodbus, modbus-tk, minimalmodbus, pyserial."""

import os
import shutil

import pytest


def program(name: str) -> str:
    """The path of a program; without it the test is skipped, or fails where ``CI`` is set."""
    path = shutil.which(name)
    if path is not None:
        return path
    if os.environ.get("CI"):
        pytest.fail(f"{name} is not installed, and CI is to run what needs it")
    pytest.skip(f"{name} is not installed")
