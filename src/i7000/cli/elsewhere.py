"""The search for a module at line settings that the user did not give.

Laws: the search only reads what changes nothing, and ends at the first line settings at which the module answers.
"""

from typing import Any, cast

from attrs import evolve, frozen

from i7000 import BaudRate, CharacterFormat, LineSettings
from i7000.cli.silence import protocol_words
from i7000.cli.stored import line_words
from i7000.cli.wanted import Wanted
from i7000.host import Policy
from i7000.host.procedures import SCAN_POLICY, Finding, Place, Procedure, Tell, Tune, scan, scan_time

__all__ = ["Elsewhere", "answers_words"]


@frozen
class Elsewhere:
    """The search for a module that does not answer at the line settings `first`.

    Shape: `lines` are the other line settings to try. `policy` is that of the line: its longer timeout counts here too.
    """

    wanted: Wanted
    first: LineSettings
    lines: tuple[LineSettings, ...]
    policy: Policy

    @property
    def seconds(self) -> float:
        """How long it takes if nothing answers."""
        return scan_time(*self._where, policy=self._policy)

    def procedure(self) -> Procedure[Place | None]:
        """Make the procedure that returns where the module answers, and leaves the host at these line settings.

        Special: None if it answers nowhere; then the line settings are `first` again.
        """
        scanning = scan(*self._where, policy=self._policy)
        answer: Any = None
        while True:
            try:
                step = scanning.send(answer)
            except StopIteration:
                yield Tune(self.first)
                return None
            if isinstance(step, Tell):
                found = step.value
                if isinstance(found, Finding) and found.is_device and found.place.address == self.wanted.address:
                    return found.place
                answer = None
            else:
                answer = yield step

    @property
    def _where(self) -> tuple[Any, Any, Any, Any]:
        checksums = tuple(dict.fromkeys(checksum for _, checksum in self.wanted.tried))
        return self.lines, (self.wanted.address,), self.wanted.protocols, checksums

    @property
    def _policy(self) -> Policy:
        return evolve(SCAN_POLICY, turnaround=max(SCAN_POLICY.turnaround, self.policy.turnaround))

    # --- words --------------------------------------------------------------------------------------------------------

    @property
    def count_words(self) -> str:
        """The number of line settings to try, in words."""
        return f"{len(self.lines)} other line settings"

    @property
    def tried_words(self) -> str:
        """The protocols and line settings that were tried, in words."""
        spoken = ", ".join(protocol_words(protocol, checksum=checksum) for protocol, checksum in self.wanted.tried)
        every = (self.first, *self.lines)
        rates = sorted({cast(BaudRate, line.baud_rate).bits_per_second for line in every})
        formats = [form.name for form in CharacterFormat if any(line.character_format is form for line in every)]
        baud = f"{rates[0]} baud" if len(rates) == 1 else f"{rates[0]} to {rates[-1]} baud"
        return f"{spoken}, at {line_words(self.first)} and at {self.count_words}: {baud}, {', '.join(formats)}"


def answers_words(place: Place) -> str:
    """Return where a module answers, in words.

    >>> answers_words(Place(LineSettings(), 0x01))
    '9600 N81, DCON without a checksum'
    """
    return f"{line_words(place.line)}, {protocol_words(place.protocol, checksum=place.checksum)}"
