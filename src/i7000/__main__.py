"""``python -m i7000``: the command line."""

import sys

from i7000_cli import main

sys.exit(main())
