"""``i7000 check`` where the guard refuses a question of its own."""

from typing import Any

import pytest

from i7000.conformance import GuardError, Hazard
from i7000.settings import LineSettings
from tests.terminal import Run


def test_a_question_that_the_guard_refuses_is_reported_and_the_run_goes_on(run: Run) -> None:
    told = run("check", "sim:M-7019R,address=FFh,checksum=true,protocol=dcon", "link/alive", "--address", "0xFF")

    assert told.code == 0
    assert "not asked: $FFP00\\r was not sent: it can make the module unreachable (--allow comm)" in told.err
    assert "1 PASS" in told.out


def test_a_frame_that_is_refused_beside_the_checks_is_a_usage_error(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def cause(*_: Any) -> str:
        raise GuardError(b"~01I\r", frozenset({Hazard.COMM}), b"", LineSettings(), own=True)

    monkeypatch.setattr("i7000.cli.reached.silence_cause", cause)

    line = ("--baud", "9600", "--character-format", "N81")
    told = run("check", "sim:I-7018", "link/alive", "--address", "9", *line)

    assert told.code == 2
    assert told.err == "i7000: ~01I\\r was not sent: it can make the module unreachable (--allow comm)\n"
