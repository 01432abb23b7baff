"""``python -m c.generate`` writes the C files that are made from ``spec/``."""

import sys
from pathlib import Path

from c.generate.files import generated
from c.generate.writing import write

ROOT = Path(__file__).parents[2]


def main() -> int:
    """Write every file that differs, and name it."""
    return write(generated(ROOT / "spec"), ROOT)


if __name__ == "__main__":
    sys.exit(main())
