"""What a command brings on the line: what was sent and heard, decoded, and what the driver made of it."""

from collections.abc import Iterator

from i7000 import Profile, Protocol
from i7000.cli.readers import Read
from i7000.cli.records import frame_words
from i7000.dissect import Heard, Knowledge, Known, Line, flush, hear, hear_frame
from i7000.errors import Noise
from i7000.host import Late, Rejected
from i7000.link import Happened, Observed, Received, Written

__all__ = ["Traffic", "event_notes"]


class Traffic:
    """The traffic of one request, as an observer of a line; nothing is kept until `begin`."""

    def __init__(self) -> None:
        self.reads: list[Read] = []
        self.notes: list[str] = []
        self.sent = 0
        """How often the request was sent."""
        self._begun = False
        self._line = Line()
        self._protocol = Protocol.DCON
        self._began = self._heard_at = 0.0

    def begin(self, address: int | None, profile: Profile, protocol: Protocol) -> None:
        """Keep what comes from now on."""
        modules = {} if address is None else {address: Known.of(profile)}
        self._begun, self._protocol = True, protocol
        self._line = Line(Knowledge.given(Known.of(profile), modules), protocol)

    def observe(self, observed: Observed) -> None:
        """Take what happens on the line."""
        if not self._begun:
            return
        if isinstance(observed, Written):
            self._began = self._began or observed.at
            self.sent += 1
            self.end(observed.at)
            self._line, heard = hear_frame(self._line, observed.data, self._protocol, sent=True)
            self._keep((heard,), observed.at, sent=True)
        elif isinstance(observed, Received):
            self._heard_at = observed.at
            self._line, found = hear(self._line, observed.data, sent=False)
            self._keep(found, observed.at, sent=False)
        elif isinstance(observed, Happened):
            self.notes += event_notes(observed.event, self._protocol)

    def end(self, at: float | None = None) -> None:
        """Take what was heard as complete."""
        self._line, found = flush(self._line, sent=False)
        self._keep(found, self._heard_at if at is None else at, sent=False)

    def _keep(self, found: tuple[Heard, ...], at: float, *, sent: bool) -> None:
        for heard in found:
            after = f"+{at - self._began:.3f} s"
            text = f"{after:>10}  {'->' if sent else '<-'} {frame_words(heard.wire, heard.protocol)}"
            number = heard.place.number
            self.reads.append(Read(number, number, number, text, None, heard))


def event_notes(event: object, protocol: Protocol) -> Iterator[str]:
    r"""Yield what the driver did not take for the response, in words.

    >>> [*event_notes(Late(b"!01\r"), Protocol.DCON)]
    ['late or duplicate, and dropped: !01']
    """
    if isinstance(event, Rejected):
        yield f"not the response: {frame_words(event.wire, protocol)}: {event.reason}"
    elif isinstance(event, Late):
        yield f"late or duplicate, and dropped: {frame_words(event.wire, protocol)}"
    elif isinstance(event, Noise):
        yield f"noise, or a damaged frame: {frame_words(event.wire, protocol)}"
