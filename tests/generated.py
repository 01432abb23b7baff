"""The files that are generated from ``spec/``, for the tests that hold them to it and to programs."""

from functools import cache
from importlib import import_module

from tests.spec.lint import SPEC

GENERATORS = ("c", "wireshark")
"""The folders of the generators, which are run as ``python -m FOLDER.generate``."""


@cache
def files_of(generator: str) -> dict[str, str]:
    """Return what a generator makes of ``spec/``: the texts of its files by their paths in the project."""
    found: dict[str, str] = import_module(f"{generator}.generate.files").generated(SPEC)
    return found
