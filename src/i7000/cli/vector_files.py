"""The vectors of the installed ``spec/``."""

import json
from functools import cache

from i7000 import spec
from i7000.conformance.vectors import Vector, vectors_of

__all__ = ["all_vectors"]


@cache
def all_vectors() -> tuple[Vector, ...]:
    """Return every vector, file by file."""
    return tuple(
        vector
        for name, file in spec.data_files(spec.files().joinpath("vectors"))
        for vector in vectors_of(name, json.loads(file.read_bytes()))
    )
