"""Every check there is: ``python -m tests``; what finds most in half a minute: ``python -m tests --fast``.

The first check that fails ends the run.
"""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
LINT = (("ruff", "check", "."), ("ruff", "format", "--check", "."))
SPEC = ("tests.spec.lint",)
FULL = (
    *LINT,
    ("mypy", "src", "tests", "fuzz", "c", "wireshark"),
    ("pytest", "--numprocesses=auto", "--dist=worksteal", "--cov", "--cov-report=term"),
)
# No processes, no other programs, nothing measured: every vector of `spec/`, and few examples of each property.
PLACES = (
    "dcon", "modbus", "host", "device", "dissect/test_logs_of_tools.py", "properties/test_dcon.py",
    "properties/test_modbus.py", "test_agreement.py", "test_profile.py", "test_readings.py",
)  # fmt: skip
FAST = (
    *LINT,
    SPEC,
    (
        "pytest",
        "--numprocesses=auto",
        "--dist=worksteal",
        "--hypothesis-profile=fast",
        *(f"tests/{place}" for place in PLACES),
    ),
)


def run(arguments: list[str]) -> int:
    """Run the checks that the arguments ask for, and return the exit code of the last."""
    if arguments not in ([], ["--fast"]):
        print("python -m tests [--fast]", file=sys.stderr)  # noqa: T201
        return 2
    for check in FAST if arguments else FULL:
        print("$ python -m", *check, flush=True)  # noqa: T201
        code = subprocess.run([sys.executable, "-m", *check], cwd=ROOT, check=False).returncode  # noqa: S603
        if code:
            return code
    return 0


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
