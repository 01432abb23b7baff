"""Run every check there is: ``python -m tests``. The first that fails ends the run."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
CHECKS = (
    ("ruff", "check", "."),
    ("ruff", "format", "--check", "."),
    ("mypy", "src", "tests"),
    ("tests.spec.lint",),
    ("pytest", "--numprocesses=auto", "--cov", "--cov-report=term"),
)

for check in CHECKS:
    print("$ python -m", *check, flush=True)  # noqa: T201
    code = subprocess.run([sys.executable, "-m", *check], cwd=ROOT, check=False).returncode  # noqa: S603
    if code:
        sys.exit(code)
