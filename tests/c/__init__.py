"""The C files: that they are what ``spec/`` makes of them, and what compilers and the example make of them."""

import subprocess
from pathlib import Path

import pytest

from tests.interop import program
from tests.waiting import ENOUGH

C = Path(__file__).parents[2] / "c"
COMPILERS = ("gcc", "clang")
STANDARDS = ("c99", "c11", "c17")
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror")

compilers = pytest.mark.parametrize("compiler", COMPILERS)


def compile_c(compiler: str, *arguments: str | Path, standard: str = "c99") -> None:
    """Compile C with every warning as an error; without the compiler skip the test, or fail it where ``CI`` is set."""
    command = [program(compiler), f"-std={standard}", *WARNINGS, f"-I{C}", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=ENOUGH)  # noqa: S603 - compiles
    assert not done.returncode, done.stderr


def output_of(*command: str | Path) -> str:
    """Run a program that has to succeed, and return what it prints."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=ENOUGH)  # noqa: S603 - just compiled
    assert not done.returncode, done.stdout + done.stderr
    return done.stdout
