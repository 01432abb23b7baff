"""The command line as a user calls it, in process."""

import io
import json
from collections.abc import Callable

import pytest

from i7000 import Protocol
from i7000.cli import main
from i7000.cli.readers import of_lines
from i7000.cli.records import json_of
from i7000.cli.words import UsageError
from i7000.dissect import Knowledge, Known
from tests.spec.lint import Record
from tests.vectors import profile_of

__all__ = ["Run", "Told", "known_of", "logged", "plain", "refusal", "run"]


@pytest.fixture
def plain(monkeypatch: pytest.MonkeyPatch) -> None:
    """No wishes for colours or widths."""
    for name in ("FORCE_COLOR", "NO_COLOR", "TTY_COMPATIBLE", "COLUMNS"):
        monkeypatch.delenv(name, raising=False)


class Told:
    """What a call told."""

    def __init__(self, code: int, out: str, err: str) -> None:
        self.code, self.out, self.err = code, out, err

    @property
    def records(self) -> list[Record]:
        return [json.loads(line) for line in self.out.splitlines()]


Run = Callable[..., Told]


@pytest.fixture
def run(plain: None, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:  # noqa: ARG001
    """Call the command line with arguments, and what stands on standard input."""

    def call(*arguments: str, stdin: bytes = b"") -> Told:
        monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BufferedReader(io.BytesIO(stdin))))
        code = main(arguments)
        return Told(code, *capsys.readouterr())

    return call


def logged(*lines: str, known: Known = Known(), protocol: Protocol | None = None) -> list[Record]:  # noqa: B008 - frozen
    """The records of a log."""
    return [json.loads(json_of(read)) for read in of_lines(enumerate(lines, 1), Knowledge.given(known), protocol)]


def known_of(vector: Record) -> Known:
    """What the profile of a vector says."""
    return Known.of(profile_of(vector["profile"]))


def refusal(read: Callable[[], object]) -> str:
    """Why nothing can be read; empty if it can."""
    try:
        read()
    except UsageError as refused:
        return str(refused)
    return ""
