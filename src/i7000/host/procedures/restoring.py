"""The procedure that makes settings so: read, change, write, read back.

Laws: a setting has one result. `Status.DONE`, `ALREADY` and `PENDING` mean that the module holds the wanted value;
`REFUSED`, `NEEDS_INIT`, `SKIPPED` and `UNREAD` that this procedure has not changed it. `NOT_VERIFIED` has in `after`
what the module holds. Only `IN_DOUBT` leaves it open: the line broke between the write and its verification.
"""

from collections.abc import Mapping
from enum import Enum
from typing import Any

from attrs import evolve

from i7000 import dcon, modbus
from i7000.arguments import check_type
from i7000.availability import Availability
from i7000.dcon.identity import LONGEST_TIMEOUT
from i7000.errors import I7000Error, InvalidValueError, shown
from i7000.frozen import frozen
from i7000.host.events import Answered, Declined, Outcome, Rejected, TimedOut
from i7000.host.procedures.inquiry import (
    Answer,
    Here,
    Seen,
    ask_firmware,
    ask_for,
    ask_setting,
    plain_value,
    profile_after,
    refined,
    refusal,
)
from i7000.host.procedures.places import SCAN_POLICY, Place
from i7000.host.procedures.settings import Setting, settings_of, why_not
from i7000.host.procedures.snapshot import in_order
from i7000.host.procedures.step import Procedure, Tell, Tune, ask
from i7000.host.procedures.values import Plain
from i7000.modbus.request import LAST_ADDRESS
from i7000.profile import Profile
from i7000.settings import LineSettings, Protocol
from i7000.type_codes import TypeCode

__all__ = ["Restoration", "Restored", "Status", "Writing", "make_so"]


class Status(Enum):
    """What became of a setting."""

    DONE = "done"
    """It was written, and reads back as wanted."""
    ALREADY = "already so"
    """It was as wanted, and nothing was written."""
    PENDING = "pending"
    """It was written and reads back as wanted; it is in use from the next power-on."""
    REFUSED = "refused"
    """The module refused the command; it holds the old value."""
    NEEDS_INIT = "needs INIT"
    """The module refused the command because its INIT switch is not set; it holds the old value."""
    NOT_VERIFIED = "not verified"
    """It was written, but reads back as another value: `Restored.after`."""
    IN_DOUBT = "in doubt"
    """It was written, and then the module could not be read: it may hold the old value or the new one."""
    UNREAD = "unread"
    """It could not be read, so nothing was written."""
    SKIPPED = "skipped"
    """Nothing was sent for it; the reason says why."""


@frozen
class Restored:
    """What became of one setting: its value before, the wanted one, and the one after, as far as they were read."""

    name: str
    status: Status
    wanted: Plain
    before: Plain | None = None
    after: Plain | None = None
    reason: str = ""


@frozen
class Writing:
    """The names of settings that are about to be written: until their results come, they are in doubt."""

    names: tuple[str, ...]


@frozen
class Restoration:
    """The results of all settings, in the order in which they were processed; and where the module is now.

    Shape: `line` has the line settings of the host, if the procedure changed them; else None.
    """

    results: tuple[Restored, ...]
    address: int
    profile: Profile
    line: LineSettings | None = None

    def of(self, name: str) -> Restored:
        """Return the result of a setting.

        Errors: `InvalidValueError` for a name without a result; `ArgumentError`.
        """
        check_type("name", name, str)
        by_name = {result.name: result for result in self.results}
        if name not in by_name:
            raise InvalidValueError("name", name, ", ".join(by_name), "", f"there is no result for {shown(name)}")
        return by_name[name]


def make_so(here: Here, wanted: Mapping[str, Plain], named: frozenset[str]) -> Procedure[Restoration]:
    """Make the named settings as wanted; those that are not named are left alone, and reported as skipped."""
    seen = Seen()
    known = Answer() if here.profile.firmware is not None else (yield from ask_firmware(here))
    here = yield from refined(here, known.response, seen)
    started, results, left = here, [], set(named)
    while group := _next_group(here, left):
        here, found = yield from _process(here, group, wanted, seen)
        left.difference_update(setting.name for setting in group)
        for result in found:
            results.append(result)
            yield Tell(result)
    for name in sorted(set(wanted) - named | left, key=in_order):
        reason = why_not(name, here.profile, here.protocol) if name in left else _NOT_NAMED
        results.append(Restored(name, Status.SKIPPED, wanted[name], reason=reason))
    line = None if here.line == started.line else here.line
    return Restoration(tuple(results), here.address, _with_types(here.profile, results), line)


def _with_types(profile: Profile, results: list[Restored]) -> Profile:
    """Return a profile whose types, unknown after a change of the connecting mode, are those of the results."""
    after = {it.name: it.after for it in results}
    types = [after.get(f"type_code.{channel}") for channel in range(profile.channels)]
    if profile.type_codes or None in types:
        return profile
    return evolve(profile, type_codes=tuple(TypeCode[str(plain)] for plain in types))


_NOT_NAMED = "it was not named"


def _next_group(here: Here, names: set[str]) -> list[Setting]:
    """Return the next settings that one command can write, in the order of the table."""
    settings = [setting for setting in settings_of(here.profile, here.protocol) if setting.name in names]
    return [setting for setting in settings if _place(setting) == _place(settings[0])]


def _place(setting: Setting) -> tuple[object, ...]:
    """Return what settings of one command have in common: those that need a permission have a command of their own."""
    return setting.access.key, setting.deferred, setting.hazard


@frozen
class Target:
    """A setting with the value that it shall have, and the one that it has."""

    setting: Setting
    wanted: Plain
    before: Plain | None

    @property
    def typed(self) -> Any:  # noqa: ANN401 - of any setting
        """The wanted value, as messages and registers take it."""
        return self.setting.values.typed(self.setting.name, self.wanted)

    def value(self, answer: Answer) -> Plain | None:
        """Return the value in an answer."""
        return plain_value(self.setting, answer)[0]

    def ended(self, status: Status, after: Plain | None = None, reason: str = "") -> Restored:
        """Return the result."""
        return Restored(self.setting.name, status, self.wanted, self.before, after, reason)


def _process(
    here: Here, group: list[Setting], wanted: Mapping[str, Plain], seen: Seen
) -> Procedure[tuple[Here, list[Restored]]]:
    """Make settings of one place as wanted."""
    results: list[Restored] = []
    targets: list[Target] = []
    answer = yield from ask_setting(here, group[0], seen)
    for setting in group:
        name = setting.name
        before, reason = plain_value(setting, answer)
        try:
            plain = setting.values.plain(name, setting.values.typed(name, wanted[name]))
        except InvalidValueError as error:
            results.append(Restored(name, Status.SKIPPED, wanted[name], before, before, str(error)))
            continue
        if answer.response is None:
            results.append(Restored(name, Status.UNREAD, plain, reason=reason))
        elif plain == before:
            here = evolve(here, profile=profile_after(here.profile, setting, before))
            results.append(Restored(name, Status.ALREADY, plain, before, before))
        else:
            targets.append(Target(setting, plain, before))
    if targets:
        here, written = yield from _write(here, targets, answer, seen)
        results += written
    return here, results


def _write(here: Here, targets: list[Target], answer: Answer, seen: Seen) -> Procedure[tuple[Here, list[Restored]]]:
    """Write settings with one command, and read them back where the module is then."""
    try:
        command = _command(here, targets, answer.response)
    except I7000Error as error:
        return here, [target.ended(Status.SKIPPED, target.before, str(error)) for target in targets]
    setting = targets[0].setting
    places: tuple[Here, ...] = (here,)
    if setting.name == "address":
        places = (evolve(here, address=targets[0].typed), here)
        if (yield from _is_taken(places[0])):
            reason = f"another module answers at address {places[0].address:02X}"
            return here, [target.ended(Status.SKIPPED, target.before, reason) for target in targets]
    yield Tell(Writing(tuple(target.setting.name for target in targets)))
    result = yield from ask(command, here.profile)
    unlocking = _unlocking(here, setting) if isinstance(result.outcome, Declined) else ()
    if unlocking:
        for permission in unlocking:
            yield from ask(permission, here.profile)
        places = _retuned(here, answer.response, command)
        result = yield from ask(command, here.profile)
    seen.answers.clear()
    now, back = yield from _read_back(places, targets)
    in_use = now is places[0] and (bool(unlocking) or not setting.deferred)
    if unlocking:
        yield from ask(dcon.SetSoftInitTimeout(now.address, 0), now.profile)
    if now is places[-1]:
        now = here
    results = []
    for target in targets:
        after = target.value(back)
        if after == target.wanted and in_use:
            now = evolve(now, profile=profile_after(now.profile, target.setting, after))
        results.append(_ended(target, back, result.outcome, in_use=in_use))
    return now, results


def _command(here: Here, targets: list[Target], response: Any) -> Any:  # noqa: ANN401 - of either protocol
    """Return the command that writes what was read back, with the wanted values.

    Errors: `I7000Error` for a command that the module does not accept.
    """
    access = targets[0].setting.access
    draft = access.draft(here.address, response)
    for target in targets:
        draft = target.setting.access.put(draft, target.typed)
    command = access.command(here.address, draft)
    codec: Any = modbus if here.protocol is Protocol.MODBUS_RTU else dcon
    codec.encode(command, here.profile)
    return command


def _unlocking(here: Here, setting: Setting) -> tuple[dcon.Command[dcon.Acknowledged], ...]:
    """Return the commands that permit a refused change of baud rate and checksum, on models that have them.

    Special: they are sent after a refusal only. Where the INIT switch is set, the change needs no permission and is in
        use from the next power-on.
    """
    by_configuration = setting.deferred and setting.access.family is dcon.ReadConfiguration
    if not by_configuration or Availability.SOFT_INIT in here.profile.refused:
        return ()
    return dcon.SetSoftInitTimeout(here.address, LONGEST_TIMEOUT), dcon.SoftInit(here.address)


def _retuned(here: Here, read: dcon.Configuration, command: dcon.SetConfiguration) -> tuple[Here, Here]:
    """Return where the module is after a soft INIT: with the new line settings and checksum, or the old ones."""
    profile = evolve(here.profile, checksum=command.report_settings.checksum)
    old = read.line_settings if here.line is None else here.line
    return evolve(here, profile=profile, line=command.line_settings), evolve(here, line=old)


def _is_taken(here: Here) -> Procedure[bool]:
    """Return whether anything answers at an address where nothing should, by any protocol and checksum setting.

    Time: only the request by the protocol of the module has the policy of the line; the others have a short one.
    """
    own = here.protocol, here.protocol is Protocol.DCON and here.profile.checksum
    for protocol, checksum in (own, *(way for way in _WAYS if way != own)):
        if protocol is Protocol.MODBUS_RTU and not 1 <= here.address <= LAST_ADDRESS:
            continue
        place = Place(LineSettings(), here.address, protocol, checksum=checksum)
        policy = None if (protocol, checksum) == own else SCAN_POLICY
        result = yield from ask(place.question, place.profile, policy)
        if not isinstance(result.outcome, TimedOut) or any(isinstance(it, Rejected) for it in result.others):
            return True
    return False


_WAYS = (Protocol.DCON, False), (Protocol.DCON, True), (Protocol.MODBUS_RTU, False)
"""The protocols, each with whether DCON frames have a checksum."""


def _read_back(places: tuple[Here, ...], targets: list[Target]) -> Procedure[tuple[Here, Answer]]:
    """Return where the module answers, and its answer; the last place if it answers nowhere.

    Special: a module that answers at a new place without the wanted values is at the last place: where only the stop
        bits differ, it hears both. An unexpected value is read twice: the first can be a late repetition of an old one.
    """
    line = places[-1].line
    for place in (*places, places[-1]):
        if place.line is not None and place.line != line:
            line = place.line
            yield Tune(line)
        answer = yield from ask_for(place, targets[0].setting.access.read(place.address))
        if all(target.value(answer) == target.wanted for target in targets):
            break
    return place, answer


def _ended(target: Target, back: Answer, outcome: Outcome[Any], *, in_use: bool) -> Restored:
    """Return the result of a setting that was written."""
    after = target.value(back)
    if after == target.wanted:
        return target.ended(Status.DONE if in_use else Status.PENDING, after)
    why = _why_not_done(outcome)
    if back.response is None and not why:
        why = "no answer to the command" if isinstance(outcome, TimedOut) else ""
        return target.ended(Status.IN_DOUBT, None, why or "no answer when it was read back")
    if why and after in (None, target.before):
        locked = target.setting.deferred and isinstance(outcome, Declined)
        needs_init = locked and isinstance(outcome.command, dcon.Command)
        return target.ended(Status.NEEDS_INIT if needs_init else Status.REFUSED, after, why)
    why = "no answer to the command" if isinstance(outcome, TimedOut) else why
    return target.ended(Status.NOT_VERIFIED, after, why or "the module acknowledged the command")


def _why_not_done(outcome: Outcome[Any]) -> str:
    """Return how the module refused a command, in words; empty if it did not."""
    if isinstance(outcome, Declined):
        return refusal(outcome)
    response = outcome.response if isinstance(outcome, Answered) else None
    codes = [getattr(response, name, 0) for name in ("result", "line_result", "protocol_result")]
    return f"refused: result {max(codes):02X}" if any(codes) else ""
