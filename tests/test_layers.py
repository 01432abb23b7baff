"""Imports point inward only, and what is below the tools does no I/O (read with `ast`, nothing is imported)."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

SRC = Path(__file__).parents[1] / "src" / "i7000"

RINGS = {
    "errors": 1,
    "frozen": 1,
    "arguments": 1,
    "availability": 1,
    "compiled": 1,
    "type_codes": 1,
    "settings": 1,
    "describe": 1,
    "fields": 1,
    "models": 1,
    "names": 1,
    "profile": 1,
    "readings": 2,
    "message": 2,
    "dcon": 2,
    "modbus": 2,
    "device": 3,
    "dissect": 3,
    "host": 3,
    "conformance": 3,
    "strategies": 4,
    "cli": 4,
    "spec": 4,
    "__main__": 4,
    "examples": 4,
    "link": 4,
    "simulator": 4,
    "recording": 4,
    "lazy": 4,
}
EXTRAS = {
    "strategies": {"hypothesis"},
    "cli": {"cyclopts", "rich"},
    "examples": {"serial"},
    "link": {"serial"},
    "simulator": {"cattrs", "filelock", "serial"},
}
PURE = {
    "attrs", "bisect", "codecs", "collections", "contextlib", "datetime", "decimal", "enum", "functools", "itertools",
    "difflib", "fnmatch", "hashlib", "html", "json", "linecache", "math", "operator", "random", "re", "shlex", "struct",
    "types", "typing", "xml",
}  # fmt: skip
MODULES = sorted(SRC.rglob("*.py"))


def unit(path: Path) -> str:
    """The module or package of `i7000` that a file belongs to; empty for the package itself."""
    return path.relative_to(SRC).parts[0].removesuffix(".py").removeprefix("__init__")


def imports(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: a relative import"
            assert node.module
            if node.module == "i7000":
                yield from (f"i7000.{alias.name}" for alias in node.names)
            else:
                yield node.module


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.relative_to(SRC).as_posix())
def test_imports_point_inward(path: Path) -> None:
    own = unit(path)

    for name in imports(path):
        first, *rest = name.split(".")
        if first != "i7000" or not rest or rest[0] not in RINGS:
            continue
        if own == "":
            assert RINGS[rest[0]] <= 2
        elif rest[0] != own:
            assert RINGS[rest[0]] <= RINGS[own]
            assert {rest[0], own} != {"dcon", "modbus"}


@pytest.mark.parametrize(
    "path",
    [path for path in MODULES if RINGS.get(unit(path), 1) <= 3],
    ids=lambda path: path.relative_to(SRC).as_posix(),
)
def test_nothing_below_the_tools_does_io(path: Path) -> None:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    outside = {name.split(".")[0] for name in imports(path)} - {"i7000"}
    opened = [node for node in ast.walk(tree) if isinstance(node, ast.Name) and node.id in ("open", "print", "input")]

    assert outside <= PURE
    assert opened == []


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.relative_to(SRC).as_posix())
def test_extras_are_imported_by_their_tools_only(path: Path) -> None:
    extras = set().union(*EXTRAS.values())

    assert {name.split(".")[0] for name in imports(path)} & extras <= EXTRAS.get(unit(path), set())


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.relative_to(SRC).as_posix())
def test_no_module_is_longer_than_can_be_read(path: Path) -> None:
    assert len(path.read_text(encoding="utf-8").splitlines()) <= 450
