"""The search for modules at a port: what is found as it comes, a table of it at the end, and advice if it is nothing.

Laws: a search only reads, and never sends a broadcast. Ctrl-C ends it with what was found.
"""

import shlex
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, cast

from attrs import frozen
from rich.progress import BarColumn, Progress, TextColumn

from i7000 import BaudRate, LineSettings, Protocol, describe
from i7000.cli.choices import SPOKEN
from i7000.cli.durations import duration_words
from i7000.cli.port import broken_off_by_signals, opened
from i7000.cli.silence import protocol_words
from i7000.cli.station import candidates_words
from i7000.cli.stored import Stored, line_words, stored_settings
from i7000.cli.text import Line as Spans
from i7000.cli.text import Printer
from i7000.cli.words import LineError
from i7000.host import Policy
from i7000.host.procedures import (
    EVERY_LINE,
    Finding,
    FindingKind,
    Identified,
    Place,
    Procedure,
    Scanned,
    Tell,
    identify,
    places,
    scan,
    scan_time,
)
from i7000.host.procedures import Progress as Done
from i7000.link import Line, LinkError

__all__ = ["GUIDE", "Search", "advice", "run"]


@frozen
class Search:
    """Where to search, and how."""

    target: str
    lines: tuple[LineSettings, ...]
    addresses: tuple[int, ...]
    protocols: tuple[Protocol, ...]
    checksums: tuple[bool, ...]
    policy: Policy
    echo: bool

    @property
    def seconds(self) -> float:
        """How long it takes if nothing answers."""
        return scan_time(self.lines, self.addresses, self.protocols, self.checksums, policy=self.policy)

    def procedure(self) -> Procedure[Scanned]:
        """Make the procedure that searches, and identifies each module where it is found."""
        scanning = scan(self.lines, self.addresses, self.protocols, self.checksums, policy=self.policy)
        return _identifying(scanning, _asking(self.policy))


@frozen
class Found:
    """A module that was found, and what it says that it is."""

    place: Place
    identified: Identified
    stored: Stored | None
    """The stored settings, if it is in INIT mode."""

    @property
    def models(self) -> tuple[str, ...]:
        """The models that it can be, the most likely one first."""
        return tuple(candidate.model.value for candidate in self.identified.candidates)

    @property
    def firmware(self) -> str | None:
        """The firmware; None if it is unknown."""
        version = self.identified.known.firmware or self.identified.version
        return None if version is None else str(version)


def _asking(policy: Policy) -> Policy:
    """Return the policy for modules that are there."""
    return Policy(retries=max(policy.retries, 1), turnaround=max(policy.turnaround, Policy().turnaround), grace=0.2)


def _identifying(scanning: Procedure[Scanned], policy: Policy) -> Procedure[Scanned]:
    answer: Any = None
    while True:
        try:
            step = scanning.send(answer)
        except StopIteration as end:
            scanned: Scanned = end.value
            return scanned
        answer = yield step
        if isinstance(step, Tell) and isinstance(step.value, Finding) and step.value.is_device:
            place = step.value.place
            identified = yield from identify(
                place.address, protocols=(place.protocol,), checksum=place.checksum, policy=policy
            )
            stored = yield from stored_settings(identified)
            yield Tell(Found(place, identified, stored))


# --- words ------------------------------------------------------------------------------------------------------------


def _found_words(found: Found) -> str:
    place, models = found.place, candidates_words(found.identified) or "unknown model"
    protocol = protocol_words(place.protocol, checksum=place.checksum)
    firmware = f" {found.firmware}" if found.firmware else ""
    init = f"; {found.stored.words()}" if found.stored else ""
    return f"address {describe.address(place.address)}, {line_words(place.line)}, {protocol}: {models}{firmware}{init}"


def _table(modules: list[Found]) -> Iterator[Spans]:
    """Yield a table of modules."""
    rows = [("address", "baud", "format", "protocol", "checksum", "name", "firmware", "models")]
    for found in modules:
        place = found.place
        rate, character_format = line_words(place.line).split()
        dcon = place.protocol is Protocol.DCON
        rows.append((
            describe.address(place.address),
            rate,
            character_format,
            "DCON" if dcon else "Modbus RTU",
            ("yes" if place.checksum else "no") if dcon else "CRC",
            found.identified.name or "",
            found.firmware or "",
            candidates_words(found.identified) or "unknown",
        ))  # fmt: skip
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for number, cells in enumerate(rows):
        yield [("  ".join(map(str.ljust, cells, widths)).rstrip(), "" if number else "bold")]


def _record(found: Found) -> dict[str, Any]:
    place = found.place
    return {
        "record": "module",
        "address": place.address,
        "baud_rate": _rate(place.line),
        "character_format": place.line.character_format.name,
        "protocol": SPOKEN[place.protocol],
        "checksum": place.checksum if place.protocol is Protocol.DCON else None,
        "name": found.identified.name,
        "firmware": found.firmware,
        "models": list(found.models),
        "stored": None if found.stored is None else _stored_record(found.stored),
    }


def _rate(line: LineSettings) -> int | None:
    return line.baud_rate.bits_per_second if isinstance(line.baud_rate, BaudRate) else None


def _stored_record(stored: Stored) -> dict[str, Any]:
    return {
        "address": stored.address,
        "baud_rate": None if stored.line is None else _rate(stored.line),
        "character_format": None if stored.line is None else stored.line.character_format.name,
        "protocol": None if stored.protocol is None else SPOKEN[stored.protocol],
        "checksum": stored.checksum,
    }


_HEARD = {
    FindingKind.ECHO: "the echo of the requests: give --echo",
    FindingKind.NOISE: "bytes that are not a frame: devices with other line settings, swapped wires, or interference",
    FindingKind.FRAME: "frames that are not the response: another host sends, or responses are late (--timeout 0.5)",
    FindingKind.OTHER_PROTOCOL: "frames of the other protocol: another host is sending",
    FindingKind.WRONG_CHECKSUM: "frames with a wrong checksum: interference, or several modules with the same address",
}
GUIDE = "docs/find_a_module.md"


def _heard_words(findings: list[Finding]) -> Iterator[str]:
    """Yield what was heard that is not an answer, with the line settings."""
    for (heard, line), count in Counter((it.heard, it.place.line) for it in findings if not it.is_device).items():
        yield f"heard at {line_words(line)}, {count} {'time' if count == 1 else 'times'}: {_HEARD[heard]}"


def advice(search: Search, findings: list[Finding]) -> Iterator[str]:
    """Yield what to try if nothing answered."""
    if not findings:
        yield (
            "nothing was heard: is the power LED of the module on (10..30 V DC), are DATA+ and DATA- connected and not"
            " swapped, is the line terminated and biased, and is this the right port?"
        )
    untried = []
    if {line.baud_rate for line in search.lines} != {line.baud_rate for line in EVERY_LINE}:
        untried.append("other baud rates: --baud all")
    if {line.character_format for line in search.lines} != {line.character_format for line in EVERY_LINE}:
        untried.append("other character formats: --character-format all")
    if len(search.addresses) < len(range(0x100)):
        untried.append("other addresses: leave --addresses out")
    if len(search.protocols) < len(Protocol):
        untried.append("the other protocol: --protocol auto")
    if untried:
        yield f"not tried: {'; '.join(untried)}"
    yield (
        "the sure way: switch INIT on, the power of the module off and on, and call"
        f" i7000 read {shlex.quote(search.target)} --address 0 --protocol dcon --no-checksum; {GUIDE} has all steps"
    )


# --- searching --------------------------------------------------------------------------------------------------------


def run(search: Search, printer: Printer) -> int:
    """Search, and return the exit code.

    Errors: `UsageError` for a text that is not a target; `LineError` for a port that cannot be opened or is lost.
    """
    count = len(places(search.lines, search.addresses, search.protocols, search.checksums))
    noun = "place to look at takes" if count == 1 else "places to look at take"
    printer.note(f"{count} {noun} {duration_words(search.seconds)} if nothing answers")
    found: list[Found] = []
    findings: list[Finding] = []
    with opened(search.target, search.lines[0]) as port, broken_off_by_signals() as ending:
        try:
            with _drawn(printer) as draw, ending.breakable():
                line = Line(port, search.lines[0], search.policy, echo=search.echo)
                line.run(search.procedure(), _teller(found, findings, printer, draw))
        except KeyboardInterrupt:
            pass
        except LinkError as error:
            raise LineError(error) from None
        finally:
            if found and not printer.json:
                printer.lines(_table(found))
    if ending.number:
        return 128 + ending.number
    for words in _heard_words(findings):
        printer.note(words)
    if found:
        return 0
    printer.note("no module answered", "red")
    for words in advice(search, findings):
        printer.note(words)
    return LineError.code


def _teller(
    found: list[Found], findings: list[Finding], printer: Printer, draw: Callable[[Done], None]
) -> Callable[[object], None]:
    """Return the function that is called with each finding and with the progress of the search."""

    def tell(value: object) -> None:
        if isinstance(value, Done):
            draw(value)
        elif isinstance(value, Finding):
            findings.append(value)
        else:
            it = cast(Found, value)
            found.append(it)
            printer.record(_record(it), [[(_found_words(it), "green")]])
            printer.flush()

    return tell


@contextmanager
def _drawn(printer: Printer) -> Iterator[Callable[[Done], None]]:
    """Draw a progress bar on a terminal."""
    if printer.json or not printer.out.is_terminal:
        yield lambda _: None
        return
    columns = (BarColumn(bar_width=_BAR), TextColumn("{task.percentage:>3.0f} %  {task.description}"))
    with Progress(*columns, console=printer.out, transient=True, redirect_stdout=False) as bar:
        task = bar.add_task("", total=None)

        def draw(done: Done) -> None:
            place = done.place
            words = f"{duration_words(done.seconds_left)} left  {line_words(place.line)}  address {place.address:02X}"
            bar.update(task, total=done.total, completed=done.done, description=words)

        yield draw


_BAR = 20
