"""``python -m wireshark.generate`` writes the dissector that is made from ``spec/``."""

import sys
from pathlib import Path

from c.generate.writing import write
from wireshark.generate.files import generated

ROOT = Path(__file__).parents[2]


def main() -> int:
    """Write every file that differs, and name it."""
    return write(generated(ROOT / "spec"), ROOT)


if __name__ == "__main__":
    sys.exit(main())
