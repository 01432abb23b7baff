"""Every generated file by its name."""

from pathlib import Path

from c.generate.fuzz import fuzz_harness
from c.generate.header import header
from c.generate.proof import selftest
from c.generate.spec import Spec
from c.generate.tables import tables
from c.generate.vectors import sections, vectors_header

__all__ = ["generated"]


def generated(folder: Path) -> dict[str, str]:
    """Return the text of each file, by its path in the project, from the files of ``spec/`` in a folder."""
    spec = Spec(folder)
    made, found = tables(spec), sections(spec)
    return {
        "c/i7000.h": header(spec, made),
        "c/i7000_fuzz.c": fuzz_harness(spec),
        "c/i7000_selftest.c": selftest(spec, made, found),
        "c/i7000_vectors.h": vectors_header(found),
    }
