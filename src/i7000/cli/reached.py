"""A module that is reached at a port: opened, asked what it is, and then whatever a command is about.

Laws: nothing is written before the module is identified. A signal breaks off what only reads.
"""

import signal
from collections.abc import Callable
from contextlib import ExitStack
from typing import TypeVar

from attrs import define, evolve, frozen

from i7000 import I7000Error, InvalidValueError, Model, Profile, Protocol
from i7000.cli.asked import Asked
from i7000.cli.confirm import confirmed
from i7000.cli.durations import duration_words
from i7000.cli.elsewhere import Elsewhere, answers_words
from i7000.cli.port import BreakingEnding, broken_off_by_signals, opened
from i7000.cli.silence import silence_cause
from i7000.cli.station import at_words, found_words, merged
from i7000.cli.stored import line_words, stored_settings
from i7000.cli.text import Printer
from i7000.cli.wanted import Wanted
from i7000.cli.words import LineError, UsageError
from i7000.conformance import GuardError
from i7000.dissect import Known
from i7000.host.procedures import Identified, Procedure, identify
from i7000.link import Line, LinkError, Observed, Port

__all__ = ["OpenLine", "Reached", "given_profile", "reach", "run"]

T = TypeVar("T")
Note = Callable[[str], None]
"""What is called with messages beside the output."""


@frozen
class OpenLine:
    """A line that is open until a command ends."""

    line: Line
    ending: BreakingEnding
    guarded: bool = False
    """Whether the port has a guard: what it refuses counts as not answered, and is reported."""

    def run(self, procedure: Procedure[T]) -> T:
        """Carry out a procedure that changes nothing; a signal breaks it off."""
        with self.ending.breakable():
            return self.finish(procedure)

    def finish(self, procedure: Procedure[T]) -> T:
        """Carry out a procedure that no signal breaks off."""
        if not self.guarded:
            return self.line.run(procedure)
        from i7000.conformance.allowed import as_allowed  # noqa: PLC0415 - it takes time

        return self.line.run(as_allowed(procedure), _report_refused)

    def consents(self, why: str, question: str, printer: Printer, *, yes: bool) -> bool:
        """Return whether the user says yes to a question, see `confirmed`; a signal breaks it off."""
        with self.ending.breakable():
            return confirmed(why, question, printer, yes=yes)


def _report_refused(told: object) -> None:
    if isinstance(told, I7000Error):
        Printer().note(f"not asked: {told}")


@define
class Reached:
    """A module that said what it is, and where it is now."""

    open: OpenLine
    address: int
    protocol: Protocol
    profile: Profile

    @property
    def words(self) -> str:
        """The module in words."""
        return f"{self.profile.model.value} at {at_words(self.address)}"


def run(
    asked: Asked,
    body: Callable[[OpenLine], int],
    observe: Callable[[Observed], object] | None = None,
    *,
    guard: Callable[[Port], Port] | None = None,
) -> int:
    """Open the port of a module, do the work of a command, and return the exit code.

    Shape: `guard` returns the port that the line gets, such as a `GuardedPort` of the one that was opened.
    Errors: `UsageError` for a text that is not a target, and for what a guard refuses; `LineError` for a port that
        cannot be opened or is lost.
    """
    with broken_off_by_signals() as ending:
        try:
            with ExitStack() as stack:
                with ending.breakable():
                    port = stack.enter_context(opened(asked.target, asked.settings))
                port = guard(port) if guard else port
                line = Line(port, asked.settings, asked.policy, echo=asked.echo, observe=observe)
                return body(OpenLine(line, ending, guarded=guard is not None))
        except LinkError as error:
            raise LineError(error) from None
        except GuardError as error:
            raise UsageError(error) from None
        except KeyboardInterrupt:
            return 128 + (ending.number or signal.SIGINT)


def reach(
    open_line: OpenLine, asked: Asked, note: Note, like: Model | None = None, *, nearest: bool = False
) -> Reached:
    """Identify the module that is asked.

    Shape: `note` gets that in words; a module that can be several models is taken for `like`, if that is one of them.
        With `nearest`, a module of an unknown model is taken for the model that is given, or for `like`, whatever its
        settings are.
    Errors: `LineError` if it does not answer, `UsageError` for a module of an unknown model, and for what is given and
        does not fit.
    """
    wanted = asked.wanted
    found, tried = _identified(open_line, wanted), ""
    if found.protocol is None and asked.others:
        elsewhere = Elsewhere(wanted, asked.settings, asked.others, open_line.line.policy)
        tried = f"; tried: {elsewhere.tried_words}"
        if _moved(open_line, elsewhere, note):
            found = _identified(open_line, wanted)
    if found.protocol is None:
        with open_line.ending.breakable():
            cause = silence_cause(open_line.line, wanted.address, wanted.tried, wanted.given.model)
        raise LineError(f"{at_words(wanted.address)} does not answer: {cause}{tried}")
    profile = _profile(wanted, found, like, nearest=nearest)
    for words in found_words(wanted, found, profile, open_line.run(stored_settings(found))):
        note(words)
    return Reached(open_line, wanted.address, found.protocol, profile)


def _identified(open_line: OpenLine, wanted: Wanted) -> Identified:
    return open_line.run(identify(wanted.address, protocols=wanted.protocols, checksum=wanted.given.checksum))


def _moved(open_line: OpenLine, elsewhere: Elsewhere, note: Note) -> bool:
    """Look for a module at other line settings, and leave the line at those at which it answers, if there are any."""
    at, longest = at_words(elsewhere.wanted.address), duration_words(elsewhere.seconds)
    looking = f"looking for it at {elsewhere.count_words}, up to {longest}"
    note(f"{at} does not answer at {line_words(elsewhere.first)}: {looking}")
    place = open_line.run(elsewhere.procedure())
    if place is not None:
        note(f"{at} answers at {answers_words(place)}")
    return place is not None


def given_profile(wanted: Wanted) -> Profile:
    """Return the profile of a module whose model is given, with what else is given, or the factory defaults.

    Errors: `UsageError` if no module has this combination.
    """
    return _profile(wanted, Identified(wanted.address), None)


def _profile(wanted: Wanted, found: Identified, like: Model | None, *, nearest: bool = False) -> Profile:
    at, known = at_words(wanted.address), wanted.given
    possible = {candidate.model for candidate in found.candidates}
    if known.model is None and like is not None and (like in possible or (nearest and found.model is None)):
        known = evolve(known, model=like)
    try:
        profile = _merged(known, found, nearest=nearest)
    except InvalidValueError as error:
        raise UsageError(f"{at}: what is given does not fit the module: {error}") from None
    if profile is None:
        raise UsageError(f"{at}: {'; '.join(found.reasons)}: give --model")
    return profile


def _merged(known: Known, found: Identified, *, nearest: bool) -> Profile | None:
    """Return the profile of a module, see `merged`; with `nearest`, settings that the model cannot have are left out.

    Errors: `InvalidValueError` if no module has this combination.
    """
    try:
        return merged(known, found)
    except InvalidValueError:
        if not nearest or known.model is None:
            raise
    merged(known, Identified(found.address))
    return Profile(known.model, type_codes=(), checksum=bool(found.known.checksum))
