"""The installed folder ``spec/``: tables, vectors, stories, errata and schemas, as JSON files.

In a wheel, the files are in this package. In a checkout or an editable install, they are in its ``spec/``. `files`
returns the folder in both cases. Its ``README.md`` explains the files.
"""

from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path

__all__ = ["files"]


def files() -> Traversable:
    """Return the folder with ``README.md``, ``errata.json``, ``schema``, ``stories``, ``tables`` and ``vectors``.

    >>> import json
    >>> commands = json.loads(files().joinpath("tables", "dcon_commands.json").read_text("utf-8"))
    >>> commands["rows"][9]["syntax"]
    '$AA2'
    """
    packaged = resources.files(__name__)
    return packaged if packaged.joinpath("errata.json").is_file() else Path(__file__).parents[3] / "spec"
