"""The vectors of the installed ``spec/``, and its digest."""

import json
from collections.abc import Iterator
from functools import cache
from hashlib import sha256
from importlib.resources.abc import Traversable

from i7000 import spec
from i7000.conformance.vectors import Vector, vectors_of

__all__ = ["all_vectors", "spec_digest"]


@cache
def all_vectors() -> tuple[Vector, ...]:
    """Return every vector, file by file."""
    return tuple(
        vector
        for name, file in _files(spec.files().joinpath("vectors"))
        for vector in vectors_of(name, json.loads(file.read_bytes()))
    )


def spec_digest() -> str:
    """Return the SHA-256 of all files: of their names and contents, by name."""
    digest = sha256()
    for name, file in _files(spec.files()):
        data = file.read_bytes()
        digest.update(f"{name}\n{len(data)}\n".encode() + data)
    return digest.hexdigest()


def _files(folder: Traversable, above: str = "") -> Iterator[tuple[str, Traversable]]:
    """Yield the files under a folder with their names, in the order of the names."""
    for entry in sorted(folder.iterdir(), key=lambda it: it.name):
        if entry.is_dir() and not entry.name.startswith(("_", ".")):
            yield from _files(entry, f"{above}{entry.name}/")
        elif entry.name.endswith((".json", ".md")):
            yield f"{above}{entry.name}", entry
