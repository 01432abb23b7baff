"""The verdict of a check, and what a check raises to end with one.

Laws: a check that ends without raising has passed, if bytes of the module were received in it: see
`i7000.conformance.run`.
"""

from enum import Enum

__all__ = ["Difference", "Lost", "Note", "Reason", "SkipReason", "Skipped", "Strange", "Unclear", "Verdict"]


class Verdict(Enum):
    """What became of a check."""

    PASS = "PASS"  # noqa: S105 - a verdict
    PASS_GOOD_ONLY = "PASS-GOOD-ONLY"  # noqa: S105 - a verdict
    """The module does what it should, but whether it also does what it should not was not tested."""
    INCONCLUSIVE = "INCONCLUSIVE"
    """Nothing was received that could decide."""
    WARN = "WARN"
    """It is allowed, but strange."""
    INFO = "INFO"
    """The manual leaves the point open; the text says which reading the module takes."""
    FAIL = "FAIL"
    SKIP = "SKIP"
    ERROR = "ERROR"
    """The line or this program failed."""
    FLAKY = "FLAKY"
    """Repeated, the check ended otherwise."""


class SkipReason(Enum):
    """Why a check was not carried out."""

    NOT_APPLICABLE = "not-applicable"
    """The tables say that this module does not have what is tested."""
    HAZARD = "hazard"
    """What it sends was not allowed."""
    NEEDS_HARDWARE = "needs-hardware"
    """The power, or a switch of the module, would have to be switched by hand."""
    PREREQUISITE = "prerequisite"
    """A check that it needs has not passed."""
    BUDGET = "budget"
    """The writes to the EEPROM, or the time, that the run may take are used up."""


class Reason(Exception):  # noqa: N818 - most are no errors
    """What ends a check before its end: the verdict, and why.

    Shape: `sent` and `received` are the bytes that decided; `wrote` and `answered` are those of the write before them,
        if the settings were changed before. `expected` says what was allowed, and `right` are the only
        bytes that were, if there are such; `erratum` is the reading of the manual that the expectation rests on.
    """

    verdict = Verdict.FAIL

    def __init__(  # noqa: PLR0913 - each of them is a fact
        self,
        text: str,
        *,
        sent: bytes = b"",
        received: bytes = b"",
        expected: str = "",
        right: bytes = b"",
        wrote: bytes = b"",
        answered: bytes = b"",
        erratum: str | None = None,
    ) -> None:
        super().__init__(text)
        self.text = text
        self.sent, self.received, self.expected, self.right, self.erratum = sent, received, expected, right, erratum
        self.wrote, self.answered = wrote, answered


class Difference(Reason):
    """The module does something else than it should; the level of the check makes it a `FAIL` or an `INFO`."""

    def told_as(self, text: str) -> "Difference":
        """Return the same evidence with another text."""
        return Difference(
            text,
            sent=self.sent,
            received=self.received,
            expected=self.expected,
            right=self.right,
            wrote=self.wrote,
            answered=self.answered,
            erratum=self.erratum,
        )


class Strange(Reason):
    """The module does what is allowed but strange."""

    verdict = Verdict.WARN


class Note(Reason):
    """The manual leaves open what the module does; `text` says what it does."""

    verdict = Verdict.INFO


class Unclear(Reason):
    """Nothing was received that could decide."""

    verdict = Verdict.INCONCLUSIVE


class Lost(Unclear):
    """A request that should be answered was not; repeating shows whether the frame before it is to blame."""


class Skipped(Reason):
    """The check cannot be carried out here."""

    verdict = Verdict.SKIP

    def __init__(self, reason: SkipReason, text: str) -> None:
        super().__init__(text)
        self.reason = reason
