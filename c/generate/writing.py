"""How generated files are written."""

from pathlib import Path

__all__ = ["write"]


def write(files: dict[str, str], root: Path) -> int:
    """Write every file that differs, name it, and return the exit code of the program."""
    for name, written in files.items():
        file = root / name
        if not file.exists() or file.read_text("utf-8") != written:
            file.write_text(written, "utf-8")
            print(f"wrote {name}")  # noqa: T201
    return 0
