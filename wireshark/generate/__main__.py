"""``python -m wireshark.generate`` writes the dissector that is made from ``spec/``."""

import sys
from pathlib import Path

from wireshark.generate.files import generated

ROOT = Path(__file__).parents[2]


def main() -> int:
    """Write every file that differs, and name it."""
    for name, written in generated(ROOT / "spec").items():
        file = ROOT / name
        if not file.exists() or file.read_text("utf-8") != written:
            file.write_text(written, "utf-8")
            print(f"wrote {name}")  # noqa: T201
    return 0


if __name__ == "__main__":
    sys.exit(main())
