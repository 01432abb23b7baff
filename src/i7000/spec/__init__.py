"""The installed folder ``spec/``: tables, vectors, stories, checks, errata and schemas, as JSON files.

In a wheel, the files are in this package. In a checkout or an editable install, they are in its ``spec/``. `files`
returns the folder in both cases. Its ``README.md`` is the first of the pages that explain them.
"""

import json
from collections.abc import Iterator, Mapping
from functools import cache
from hashlib import sha256
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from i7000.conformance.statement import Statement

__all__ = ["data_files", "digest", "files", "statements", "version"]


def files() -> Traversable:
    """Return the folder with the pages, the index, the errata, and the folders of all other files.

    >>> import json
    >>> commands = json.loads(files().joinpath("tables", "dcon_commands.json").read_text("utf-8"))
    >>> commands["rows"][9]["syntax"]
    '$AA2'
    """
    packaged = resources.files(__name__)
    return packaged if packaged.joinpath("errata.json").is_file() else Path(__file__).parents[3] / "spec"


@cache
def statements() -> "Mapping[str, Statement]":
    """Return the statements of ``spec/checks`` by their ids, in the order of a run."""
    from i7000.conformance.statement import GROUPS, read_statements  # noqa: PLC0415 - the files alone need none of it

    folder = files().joinpath("checks")
    return read_statements(json.loads(folder.joinpath(f"{group}.json").read_text("utf-8")) for group in GROUPS)


@cache
def digest() -> str:
    """Return the SHA-256 of all files: of their names, sizes and contents, in the order of the names."""
    found = sha256()
    for name, file in data_files(files()):
        data = file.read_bytes()
        found.update(f"{name}\n{len(data)}\n".encode() + data)
    return found.hexdigest()


@cache
def version() -> str:
    """Return the version of the files; ``README.md`` says what its numbers mean."""
    return files().joinpath("VERSION").read_text("utf-8").strip()


_WITHOUT_ENDING = ("LICENSE", "VERSION")


def data_files(folder: Traversable, above: str = "") -> Iterator[tuple[str, Traversable]]:
    """Yield the files of the data under a folder with their names, in the order of the names."""
    for entry in sorted(folder.iterdir(), key=lambda it: it.name):
        if entry.is_dir() and not entry.name.startswith(("_", ".")):
            yield from data_files(entry, f"{above}{entry.name}/")
        elif entry.name.endswith((".json", ".md")) or entry.name in _WITHOUT_ENDING:
            yield f"{above}{entry.name}", entry
