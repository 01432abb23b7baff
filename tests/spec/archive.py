"""The data of ``spec/`` as one archive, for those who have no use for a package of Python.

``python -m tests.spec.archive FOLDER`` writes ``i7000-spec-VERSION.tar.gz`` there and prints its SHA-256. Beside the
files it has ``SHA256SUMS``, for ``sha256sum -c``.

Laws: the same files make the same bytes, whatever their times, owners and modes and whoever packs them, as long as zlib
is the same.
"""

from __future__ import annotations

import gzip
import io
import sys
import tarfile
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from tests.spec import index, lint

if TYPE_CHECKING:
    from collections.abc import Sequence

SUMS = "SHA256SUMS"


def packed() -> bytes:
    """The archive: every file of the data in one folder that has the version in its name."""
    files = {lint.name(path): path.read_bytes() for path in (*index.released_files(), index.INDEX)}
    sums = "".join(f"{sha256(files[name]).hexdigest()}  {name}\n" for name in sorted(files))
    files[SUMS] = sums.encode()
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for name in sorted(files):
            entry = tarfile.TarInfo(f"{stem()}/{name}")
            entry.size = len(files[name])
            archive.addfile(entry, io.BytesIO(files[name]))
    return gzip.compress(data.getvalue(), mtime=0)


def stem() -> str:
    """The name of the archive without its ending, and of its one folder."""
    return f"i7000-spec-{index.version()}"


def main(arguments: Sequence[str]) -> int:
    """Write the archive; the exit status is 1 if the index does not follow the files."""
    if len(arguments) != 1:
        sys.stderr.write("usage: python -m tests.spec.archive FOLDER\n")
        return 2
    wrong = index.faults()
    if wrong:
        sys.stderr.write("".join(f"{fault}\n" for fault in wrong))
        return 1
    path = Path(arguments[0]) / f"{stem()}.tar.gz"
    path.parent.mkdir(parents=True, exist_ok=True)
    data = packed()
    path.write_bytes(data)
    sys.stdout.write(f"{sha256(data).hexdigest()}  {path}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
