import subprocess
import sys

STARTED_WITH_SIGNALS_IGNORED = """
import signal, subprocess, sys
for ignored in (signal.SIGINT, signal.SIGHUP):
    signal.signal(ignored, signal.SIG_IGN)
import tests.conftest
subprocess.run([sys.executable, "-c", "import signal as s; print(s.SIG_IGN in map(s.getsignal, (s.SIGINT, s.SIGHUP)))"])
"""


def test_what_tests_start_hears_the_signals_that_a_background_job_or_nohup_ignores() -> None:
    started = subprocess.run(  # noqa: S603 - ourselves
        [sys.executable, "-c", STARTED_WITH_SIGNALS_IGNORED], check=True, capture_output=True, text=True
    )

    assert started.stdout == "False\n"
