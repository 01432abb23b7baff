"""Every generated file by its name."""

from pathlib import Path

from wireshark.generate.data import data
from wireshark.generate.lua import assigned

__all__ = ["generated"]

_TEMPLATES = Path(__file__).with_name("templates")


def generated(folder: Path) -> dict[str, str]:
    """Return the text of each file, by its path in the project, from the files of ``spec/`` in a folder."""
    head, *code = (file.read_text("utf-8") for file in sorted(_TEMPLATES.glob("*.lua")))
    tables = (assigned(name, value) for name, value in data(folder).items())
    return {"wireshark/i7000.lua": "\n".join((head, *tables, *code))}
