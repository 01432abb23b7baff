"""Run a target under Atheris: ``python -m fuzz.fuzzers.dcon_command_fuzzer [OPTION OF LIBFUZZER]... [CORPUS]...``."""

import sys
from collections.abc import Mapping
from types import FunctionType
from typing import Any

__all__ = ["INSTALL", "main"]

INSTALL = "Atheris is not installed: pip install --group fuzz (Linux or macOS, Python 3.11 to 3.13)"

_NOT_INSTRUMENTED = (
    "i7000.arguments", "i7000.availability", "i7000.errors", "i7000.frozen", "i7000.models", "i7000.profile",
    "i7000.type_codes",
)  # fmt: skip
"""Modules whose branches show a fuzzer nothing: the first bytes of an input select a profile from a cache."""


def main(target: str) -> None:
    """Fuzz a target until an option of libFuzzer ends it, or an input fails; does not return."""
    try:
        import atheris  # noqa: PLC0415 - an extra
    except ImportError:
        sys.exit(INSTALL)
    with atheris.instrument_imports(include=["i7000"], exclude=list(_NOT_INSTRUMENTED)):
        from i7000 import compiled  # noqa: PLC0415 - instrumented

        _instrument_generated(atheris, compiled)
        from fuzz.targets import TARGETS  # noqa: PLC0415 - the same
    atheris.Setup([_program(), *sys.argv[1:]], TARGETS[target].run)
    atheris.Fuzz()


def _program() -> str:
    """Return what the shell starts this program with: libFuzzer does that to merge corpora, and for several jobs."""
    spec = getattr(sys.modules["__main__"], "__spec__", None)
    return sys.argv[0] if spec is None else f"{sys.executable} -m {spec.name}"


def _instrument_generated(atheris: Any, module: Any) -> None:  # noqa: ANN401 - modules
    """Instrument the functions that the library generates from the syntax of messages: most of its branches."""
    compile_them = module.compiled

    def compiled(source: str, name: str, names: dict[str, Any]) -> Mapping[str, Any]:
        found: dict[str, Any] = compile_them(source, name, names)
        for value in found.values():
            if isinstance(value, FunctionType) and value.__code__.co_filename.startswith("<i7000: "):
                atheris.instrument_func(value)
        return found

    module.compiled = compiled
