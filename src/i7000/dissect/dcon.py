"""DCON frames -> their possible meanings, with complete, partial or no knowledge of the module.

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

from attrs import evolve

from i7000 import DataFormat, DecodeError, Fault, Profile, Status, TypeCode, dcon
from i7000.arguments import as_bytes, check_type
from i7000.availability import Availability
from i7000.dcon.codec import deepest
from i7000.dissect.known import Fact, Known, Origin
from i7000.dissect.meaning import ChannelReading, Fit, Meaning
from i7000.readings import decode_field

__all__ = ["LEADS", "DconReader", "is_command", "meanings", "reader"]

_NOTHING_KNOWN = Known()
_COMMAND_LEADS = b"%#$~@"
_RESPONSE_LEADS = b"!>?"
LEADS = _COMMAND_LEADS + _RESPONSE_LEADS
"""The characters that DCON frames begin with."""
_REMEMBERED = 256
"""Commands, and sets of profiles, that are cached: a host that polls sends the same again and again."""

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
    """Where they stand among those of the `DconReader`."""


class _Found(NamedTuple):
    """A message, the command that it answers, and the profiles that read it."""

    message: dcon.Message
    command: dcon.AnyCommand | None
    group: _Group
    kind: int = 0
    """The position of its class among those that were tried."""


_Attempt = Callable[[bytes], Iterable[_Found]]
"""Read a frame as a group of profiles does, or raise `DecodeError`."""
_Stages = tuple[tuple[_Attempt, ...], ...]
"""Attempts with the factory defaults, then with all that is possible; the second stage counts if the first fails."""
_Places = list[tuple[int, Profile]]
_Groups = tuple[tuple[int, ...], ...]
_Read = tuple[_Found, tuple[ChannelReading, ...], DecodeError | None]
"""What was found, its readings, and why the first of them that has no value cannot be one of its type."""


class DconReader:
    """A reader of the frames of a module, with what is known of it; it caches what the next frame needs."""

    def __init__(self, known: Known) -> None:
        self._known = known
        defaults = () if known.default is None else (known.default,)
        self._profiles = (*defaults, *known.all)
        numbered = list(enumerate(self._profiles))
        self._places = tuple(places for places in (numbered[: len(defaults)], numbered[len(defaults) :]) if places)
        self._answers = lru_cache(maxsize=_REMEMBERED)(self._answer_stages)
        self._fit = lru_cache(maxsize=_REMEMBERED)(self._fit_of)
        self._facts = lru_cache(maxsize=_REMEMBERED)(lambda fit: tuple(self._facts_of(fit)))

    def meanings(self, frame: bytes, asked: bytes | None = None) -> tuple[Meaning, ...]:
        r"""Return what a frame can mean, as the response to `asked` if that is given.

        Special: factory defaults are tried first, and not used if they exclude a meaning. A meaning with numbers that
            no module of their types writes is given, as a misfit, only if no other type or data format fits.
        Errors: `DecodeError` if it means nothing.

        >>> [type(meaning.message).__name__ for meaning in DconReader(Known()).meanings(b"$01A\r")]
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
                        readings, misfit = _readings(found.message, found.command, found.group.profile, self._known)
                        (misfits if misfit else read).append((found, readings, misfit))
                except DecodeError as fault:
                    faults.append(fault)
            if read and (not misfits or attempts is stages[-1]):
                return self._meanings(read)
        if misfits:
            return self._meanings(misfits)
        raise faults[0] if self._known.model else _nearest(faults)

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
        fit = self._fit(places)
        if found.group.profile.checksum is not fit.profiles[0].checksum and isinstance(
            found.command, dcon.SetConfiguration
        ):
            fit = Fit((found.group.profile,))
        facts = self._facts(fit) if readings else ()
        return Meaning(found.message, found.command, fit, readings, facts=facts, misfit=misfit)

    def _facts_of(self, fit: Fit) -> Iterator[Fact]:
        """Yield what readings rest on: what is known, and what they have by default."""
        known = self._known
        by_default = fit.profiles == (known.default,)
        profile = fit.profiles[0]
        for name, value in (("types", profile.type_codes), ("data_format", profile.data_format)):
            if getattr(known, name) is not None:
                yield Fact(name, getattr(known, name), Origin.GIVEN)
            elif by_default:
                yield Fact(name, value, Origin.ASSUMED)

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
                    attempts += _with_new_checksum(command, groups_of_it)
            stages.append(_in_turn(attempts))
        return tuple(stages) if any(stages) else self._alone


def _nearest(faults: list[DecodeError]) -> DecodeError:
    """Return the fault that is farthest in the frame; a wrong checksum only if there is no other fault."""
    return deepest([fault for fault in faults if fault.fault is not Fault.CHECKSUM] or faults)


reader = lru_cache(maxsize=64)(DconReader)
"""Return the reader for modules with this knowledge."""


def meanings(frame: bytes, asked: bytes | None = None, known: Known = _NOTHING_KNOWN) -> tuple[Meaning, ...]:
    r"""Return everything that a DCON frame can mean, by section; as the response to `asked`, if that is given.

    Shape: frames with and without checksum, and all data formats, are considered, unless they are known.
    Errors: `DecodeError` if it means nothing; `EncodeError` if no module is as `known` says.
    Manual: 2; E7, E8, E93.

    >>> [meaning.message for meaning in meanings(b"#0184\r")]
    [ReadAnalogInputs(address=0x01), ReadAnalogInput(address=0x01, channel=132)]
    """
    check_type("known", known, Known)
    frame = as_bytes("frame", frame)
    if not frame:
        raise DecodeError(Fault.LENGTH, frame, allowed="a frame")
    return reader(known).meanings(frame, None if asked is None else as_bytes("asked", asked))


def is_command(frame: bytes) -> bool:
    """Return whether a frame is a command, by its leading character."""
    return frame[0] in _COMMAND_LEADS


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


def _with_new_checksum(command: dcon.Command[Any], groups: Iterable[_Group]) -> Iterator[tuple[int, _Attempt]]:
    """Choose how to read the response of a module whose checksum setting has just changed (2.1)."""
    if isinstance(command, dcon.SetConfiguration):
        checksum = command.report_settings.checksum
        for profile, places in groups:
            if profile.checksum is not checksum:
                yield places[0], partial(_answer, command, _Group(evolve(profile, checksum=checksum), places))


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
    """Return all that a response without its command could be."""
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
    message: dcon.Message, command: dcon.AnyCommand | None, profile: Profile, known: Known
) -> tuple[tuple[ChannelReading, ...], DecodeError | None]:
    """Return the readings of a report, whose types may be unknown, and why the first misfit is one."""
    types: tuple[TypeCode | None, ...] = profile.type_codes or (known.types if known.partial else None) or ()
    if isinstance(message, dcon.AnalogInputs | dcon.AnalogInputsHex | dcon.SynchronizedData):
        if len(types) == len(message.values) and None not in types:  # all at once, which takes a fifth of the time
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
    by_channel: dict[int | None, TypeCode | None] = dict(enumerate(types))
    if len(set(types)) == 1:
        by_channel[None] = types[0]
    found = []
    misfit = None
    for channel, text in fields:
        type_code = by_channel.get(channel)
        sure = type_code is not None
        try:
            reading = decode_field(
                text,
                TypeCode.V_10 if type_code is None else type_code,
                data_format,
                legacy=profile.legacy_sentinels,
                lenient=not sure,
            )
        except DecodeError as error:
            misfit = misfit or error
            found.append(ChannelReading(channel, text, None, type_code))
            continue
        if sure:
            found.append(ChannelReading(channel, text, reading.status, type_code, reading.value, reading.unit))
        else:
            status = None if reading.status is Status.OK else reading.status
            found.append(ChannelReading(channel, text, status, None))
    return tuple(found), misfit
