"""The folder ``spec/`` as it is installed: tables, vectors, stories, errata and schemas, as JSON files.

A wheel has the files in this package. In a checkout, and so in an editable install, they are in its ``spec/``; `files`
returns the folder wherever it is. ``README.md`` in it explains the files.
"""

from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path

__all__ = ["files"]


def files() -> Traversable:
    """Return the folder that has ``README.md``, ``errata.json``, ``schema``, ``stories``, ``tables`` and ``vectors``.

    >>> import json
    >>> commands = json.loads(files().joinpath("tables", "dcon_commands.json").read_text("utf-8"))
    >>> commands["rows"][9]["syntax"]
    '$AA2'
    """
    packaged = resources.files(__name__)
    return packaged if packaged.joinpath("errata.json").is_file() else Path(__file__).parents[3] / "spec"
