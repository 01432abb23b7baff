"""DCON frames -> what they can mean, to those who know much, little or nothing about the module.

A frame is read with every profile that fits what is known, and a response together with its command, so that what one
of the two proves is used for the other. Profiles that read frames alike are tried once: see `_COMMAND_FORM` and
`_RESPONSE_FORM`.

Laws: every meaning is one that a codec of `i7000.dcon` found.
"""

from collections.abc import Callable, Hashable, Iterable, Iterator
from contextlib import suppress
from functools import cached_property, lru_cache, partial
from operator import attrgetter, itemgetter
from typing import Any, NamedTuple

from i7000 import DataFormat, DecodeError, Fault, Profile, Status, TypeCode, dcon
from i7000.availability import Availability
from i7000.cli.dcon import ChannelReading, Fit, Known, Meaning, is_command
from i7000.readings import decode_field

__all__ = ["Reader"]

_RESPONSE_LEADS = b"!>?"
_REMEMBERED = 256
"""Commands, and sets of profiles, of which the work is not done again: who polls sends the same again and again."""

_COMMAND_FORM = attrgetter("checksum", "channel_digits", "mask_digits", "refused")
"""What decides how a profile reads a command."""
_RESPONSE_FORM = attrgetter(
    "checksum", "channels", "channel_digits", "mask_digits", "data_format", "legacy_sentinels", "type_codes"
)
"""What decides how a profile reads a response to a known command, and the readings in it."""


class _Group(NamedTuple):
    """Profiles that read alike."""

    profile: Profile
    """The first of them."""
    places: tuple[int, ...]
    """Where they stand among those of the `Reader`."""


class _Found(NamedTuple):
    """A message, the command that it answers, and the profiles that read it."""

    message: dcon.Message
    command: dcon.AnyCommand | None
    group: _Group
    kind: int = 0
    """Where its class stands among those that were tried."""


_Attempt = Callable[[bytes], Iterable[_Found]]
"""Read a frame as a group of profiles does, or raise `DecodeError`."""
_Stages = tuple[tuple[_Attempt, ...], ...]
"""Attempts with the factory defaults, then with all that is possible; the second stage counts if the first fails."""
_Places = list[tuple[int, Profile]]
_Groups = tuple[tuple[int, ...], ...]
_Read = tuple[_Found, tuple[ChannelReading, ...], DecodeError | None]
"""What was found, its readings, and why the first of them that has no value cannot be one of its type."""


class Reader:
    """Reads frames of modules of which so much is known; it remembers what it needs for the next frame."""

    def __init__(self, known: Known) -> None:
        self._known = known
        defaults = () if known.default is None else (known.default,)
        self._profiles = (*defaults, *known.all)
        numbered = list(enumerate(self._profiles))
        self._places = tuple(places for places in (numbered[: len(defaults)], numbered[len(defaults) :]) if places)
        self._answers = lru_cache(maxsize=_REMEMBERED)(self._answer_stages)
        self._fit = lru_cache(maxsize=_REMEMBERED)(self._fit_of)

    def meanings(self, frame: bytes, asked: bytes | None = None) -> tuple[Meaning, ...]:
        r"""Return what a frame can mean, as the response to `asked` if that is given.

        Special: factory defaults are tried first. A meaning with numbers that no module of their types writes is
            given, as a misfit, only if no other type or data format fits.
        Errors: `DecodeError` if it means nothing.

        >>> [type(meaning.message).__name__ for meaning in Reader(Known()).meanings(b"$01A\r")]
        ['ReadAnalogInputsHex', 'ReadCjcUpdate']
        """
        stages = self._commands if is_command(frame) else self._alone if asked is None else self._answers(asked)
        misfits: list[_Read] = []
        faults: list[DecodeError] = []
        for attempts in stages:
            read: list[_Read] = []
            for attempt in attempts:
                try:
                    for found in attempt(frame):
                        readings, misfit = _readings(found.message, found.command, found.group.profile)
                        (misfits if misfit else read).append((found, readings, misfit))
                except DecodeError as fault:
                    faults.append(fault)
            if read:
                return self._meanings(read)
        if misfits:
            return self._meanings(misfits)
        raise faults[0]

    def _meanings(self, read: list[_Read]) -> tuple[Meaning, ...]:
        if len(read) == 1:  # nearly always, if the model is known
            (one,) = read
            return (self._meaning(one, (one[0].group.places,)),)
        same: dict[object, list[_Read]] = {}
        for one in read:
            found, readings, _ = one
            same.setdefault((found.message, found.command, readings), []).append(one)
        return tuple(
            self._meaning(those[0], tuple(found.group.places for found, _, _ in those))
            for those in sorted(same.values(), key=_order)
        )

    def _meaning(self, read: _Read, places: _Groups) -> Meaning:
        found, readings, misfit = read
        known, fit = self._known, self._fit(places)
        assumed: tuple[str, ...] = ()
        if readings and fit.profiles == (known.default,):
            assumed = tuple(
                name for name, value in (("type", known.types), ("format", known.data_format)) if value is None
            )
        return Meaning(found.message, found.command, readings, fit, assumed, misfit)

    def _fit_of(self, groups: _Groups) -> Fit:
        return Fit(tuple(self._profiles[place] for place in sorted(place for places in groups for place in places)))

    # --- ways to read -------------------------------------------------------------------------------------------------

    @cached_property
    def _command_groups(self) -> tuple[tuple[_Group, ...], ...]:
        return tuple(_groups(places, _COMMAND_FORM) for places in self._places)

    @cached_property
    def _commands(self) -> _Stages:
        return tuple(tuple(partial(_command, group) for group in groups) for groups in self._command_groups)

    @cached_property
    def _alone(self) -> _Stages:
        return tuple(_in_turn(_alone_attempts(places)) for places in self._places)

    def _answer_stages(self, asked: bytes) -> _Stages:
        """Choose how to read the responses to a command: as each profile does that can read it, or else as if alone."""
        stages = []
        for groups in self._command_groups:
            answered: dict[dcon.AnyCommand, _Places] = {}
            for group in groups:
                try:
                    command = dcon.decode_command(asked, group.profile)
                except DecodeError:
                    continue  # what the command was read with is elsewhere
                answered.setdefault(command, []).extend((place, self._profiles[place]) for place in group.places)
            attempts: list[tuple[int, _Attempt]] = []
            for command, places in answered.items():
                places.sort(key=_PLACE)
                if isinstance(command, dcon.Broadcast):
                    attempts += _alone_attempts(places)
                else:
                    groups_of_it = _groups(places, _RESPONSE_FORM)
                    attempts += [(group.places[0], partial(_answer, command, group)) for group in groups_of_it]
            stages.append(_in_turn(attempts))
        return tuple(stages) if any(stages) else self._alone


_PLACE = itemgetter(0)


def _in_turn(attempts: Iterable[tuple[int, _Attempt]]) -> tuple[_Attempt, ...]:
    return tuple(attempt for _, attempt in sorted(attempts, key=_PLACE))


def _groups(places: _Places, form: Callable[[Profile], Hashable]) -> tuple[_Group, ...]:
    """Put the profiles of one form together."""
    found: dict[Hashable, _Places] = {}
    for place, profile in places:
        found.setdefault(form(profile), []).append((place, profile))
    return tuple(_Group(group[0][1], tuple(map(_PLACE, group))) for group in found.values())


def _order(those: list[_Read]) -> tuple[int, ...]:
    """Sort meanings by section, and then as if each profile were tried by itself."""
    (first, _, _), *_ = those
    section = map(int, (first.command or first.message).section.split("."))
    return *section, *min((found.group.places[0], found.kind) for found, _, _ in those)


def _command(group: _Group, frame: bytes) -> Iterator[_Found]:
    yield _Found(dcon.decode_command(frame, group.profile), None, group)


def _answer(command: dcon.Command[Any], group: _Group, frame: bytes) -> Iterator[_Found]:
    yield _Found(dcon.decode_response(frame, command, group.profile), command, group)


_Kinds = tuple[tuple[type[dcon.Response], _Group], ...]
_RESPONSES: dict[type[dcon.Response], tuple[Availability, ...]] = {dcon.Refused: ()}
"""Every response, and who has the commands that it answers; a refusal is that of any."""
for _kind in dcon.COMMANDS:
    if issubclass(_kind, dcon.Command):
        _RESPONSES[_kind.response] = (*_RESPONSES.get(_kind.response, ()), _kind.availability)


def _alone_attempts(places: _Places) -> Iterator[tuple[int, _Attempt]]:
    """Choose how to read responses to whatever modules can be asked."""
    by_form: dict[Hashable, _Places] = {}
    for place, profile in places:
        by_form.setdefault(_RESPONSE_FORM(profile), []).append((place, profile))
    for alike in by_form.values():
        kinds = []
        for kind, who in _RESPONSES.items():
            having = [(place, it) for place, it in alike if not who or not it.refused.issuperset(who)]
            if having:
                kinds.append((kind, _Group(having[0][1], tuple(map(_PLACE, having)))))
        yield alike[0][0], partial(_response, tuple(kinds))


def _response(kinds: _Kinds, frame: bytes) -> Iterator[_Found]:
    """Read a response without its command: all that it could be."""
    profile = kinds[0][1].profile
    body = dcon.unseal(frame, checksum=profile.checksum, leads=_RESPONSE_LEADS).decode("ascii")
    read = False
    for at, (kind, group) in enumerate(kinds):
        try:
            message = kind.layout.decode(body, profile)
        except (KeyError, DecodeError):
            continue
        read = True
        yield _Found(message, None, group, at)
    if not read:
        raise DecodeError(Fault.COMMAND, frame, 1, allowed="a response of chapter 2", section="2")


# --- readings ---------------------------------------------------------------------------------------------------------


def _readings(
    message: dcon.Message, command: dcon.AnyCommand | None, profile: Profile
) -> tuple[tuple[ChannelReading, ...], DecodeError | None]:
    """Read the fields of a report, of which the types may be unknown, and say why the first misfit is one."""
    types = profile.type_codes
    if isinstance(message, dcon.AnalogInputs | dcon.AnalogInputsHex | dcon.SynchronizedData):
        if len(types) == len(message.values):  # all at once, which takes a fifth of the time
            with suppress(DecodeError):  # where one of them is a misfit
                values, units, statuses = zip(*dcon.readings(message, profile), strict=True)
                return tuple(
                    map(ChannelReading, range(len(types)), message.values, statuses, types, values, units)
                ), None
        fields: Iterable[tuple[int | None, str]] = enumerate(message.values)
    elif isinstance(message, dcon.AnalogInput):
        fields = [(command.channel if isinstance(command, dcon.ReadAnalogInput) else None, message.value)]
    else:
        return (), None
    data_format = DataFormat.HEX if isinstance(message, dcon.AnalogInputsHex) else profile.data_format
    by_channel: dict[int | None, TypeCode] = dict(enumerate(types))
    if len(set(types)) == 1:
        by_channel[None] = types[0]
    found = []
    misfit = None
    for channel, text in fields:
        type_code = by_channel.get(channel)
        known = type_code is not None
        try:
            reading = decode_field(
                text, type_code or TypeCode.V_10, data_format, legacy=profile.legacy_sentinels, lenient=not known
            )
        except DecodeError as error:
            misfit = misfit or error
            found.append(ChannelReading(channel, text, None, type_code))
            continue
        if known:
            found.append(ChannelReading(channel, text, reading.status, type_code, reading.value, reading.unit))
        else:
            status = None if reading.status is Status.OK else reading.status
            found.append(ChannelReading(channel, text, status, None))
    return tuple(found), misfit
