"""What DCON frames can mean, to those who know much, little or nothing about the module.

A `Known` stands for all the profiles that fit what is known; a frame is read with each of them, and a response together
with its command, so that what one of the two tells is used for the other.

Laws: every meaning is one that a codec of `i7000.dcon` found. What is not known and need not be guessed is left open;
a factory default that is relied on is named in `Meaning.assumed`.
"""

import re
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property, lru_cache
from itertools import product

from attrs import evolve, frozen

from i7000 import (
    DataFormat,
    DecodeError,
    EncodeError,
    Fault,
    Firmware,
    ModbusDataFormat,
    Model,
    Profile,
    Status,
    TypeCode,
    Unit,
    dcon,
)
from i7000.message import Message
from i7000.models import AVAILABILITY
from i7000.profile import LAST_LEGACY
from i7000.readings import decode_field

__all__ = ["ChannelReading", "Known", "Meaning", "errata", "gates", "is_command", "meanings", "scope"]

_COMMAND_LEADS = b"%#$~@"
_RESPONSE_LEADS = b"!>?"


@frozen
class Known:
    """What is known about the modules on the line; None: not known."""

    model: Model | None = None
    firmware: Firmware | None = None
    types: tuple[TypeCode, ...] | None = None
    """One for all channels, or one for each."""
    data_format: DataFormat | None = None
    checksum: bool | None = None
    single_ended: bool | None = None
    modbus_data_format: ModbusDataFormat | None = None

    @cached_property
    def default(self) -> Profile | None:
        """The profile of a known model, with its factory defaults for what is not known.

        Errors: `EncodeError` for a combination that no module has.
        """
        if self.model is None:
            return None
        fresh = Profile(
            self.model,
            firmware=self.firmware,
            data_format=self.data_format or DataFormat.ENGINEERING,
            checksum=bool(self.checksum),
            single_ended=bool(self.single_ended),
        )
        return fresh if self.types is None else self._typed(fresh)

    @cached_property
    def all(self) -> tuple[Profile, ...]:
        """Every profile that what is known fits, of every model if none is known; with types only if they are known.

        Errors: `EncodeError` if there is none.
        """
        found = []
        error = None
        for model, firmware, single_ended in product(
            (self.model,) if self.model else Model,
            (self.firmware,) if self.firmware else (None, LAST_LEGACY),
            _either(self.single_ended),
        ):
            try:
                profile = Profile(model, firmware=firmware, single_ended=single_ended, type_codes=())
                if profile.firmware == self.firmware or profile.legacy_sentinels:
                    found.append(self._typed(profile))
            except EncodeError as refused:
                error = error or refused
        if error is not None and not found:
            raise error
        formats = DataFormat if self.data_format is None else (self.data_format,)
        return tuple(
            evolve(profile, data_format=data_format, checksum=checksum)
            for profile, data_format, checksum in product(found, formats, _either(self.checksum))
        )

    def _typed(self, profile: Profile) -> Profile:
        types = self.types or ()
        return evolve(profile, type_codes=types * profile.channels if len(types) == 1 else types)


def _either(known: bool | None) -> tuple[bool, ...]:  # noqa: FBT001 - it is the value
    return (False, True) if known is None else (known,)


@frozen
class ChannelReading:
    """One field of a report, and what is known of it."""

    channel: int | None
    text: str
    status: Status | None
    """None: a number of an unknown type, or one that no module of the type writes."""
    type_code: TypeCode | None
    value: float | None = None
    unit: Unit | None = None


@frozen
class Meaning:
    """One thing that a frame can mean."""

    message: dcon.Message
    command: dcon.AnyCommand | None
    """The one that it answers."""
    readings: tuple[ChannelReading, ...]
    profiles: tuple[Profile, ...]
    """Those it was read with."""
    assumed: tuple[str, ...]
    """What has its factory default because it was not told: ``type``, ``format``."""
    misfit: DecodeError | None = None
    """Why the first reading without a value cannot be one of its type."""

    @property
    def models(self) -> tuple[Model, ...]:
        """The models it fits."""
        return tuple(dict.fromkeys(profile.model for profile in self.profiles))

    @property
    def checksum(self) -> bool | None:
        """Whether the frame ends in a checksum; None: it fits both."""
        first, *others = {profile.checksum for profile in self.profiles}
        return None if others else first

    @property
    def data_formats(self) -> tuple[DataFormat, ...]:
        """The formats its readings fit; none if it has none, or if they are always in hex."""
        if not self.readings or isinstance(self.message, dcon.AnalogInputsHex):
            return ()
        return tuple(sorted({profile.data_format for profile in self.profiles}))

    @property
    def pause(self) -> float:
        """The seconds to leave the module alone after it."""
        if not isinstance(self.message, dcon.Command | dcon.Broadcast):
            return 0.0
        return max(dcon.pause_after(self.message, profile) for profile in self.profiles)


def is_command(frame: bytes) -> bool:
    """Whether a frame is one that a host sends."""
    return frame[0] in _COMMAND_LEADS


def errata(message: Message | type[Message]) -> tuple[str, ...]:
    """List the errata that the docstring of a message names.

    >>> errata(dcon.SetConnectingMode)
    ('E03',)
    """
    manual = (message.__doc__ or "").partition("Manual:")[2]
    return tuple(f"E{int(number):02d}" for number in re.findall(r"\bE(\d+)\b", manual))


def gates(section: str) -> dict[Model, Firmware | None]:
    """List the models that have a command, and the firmware from which on."""
    return dict(AVAILABILITY[section].gates) if section in AVAILABILITY else dict.fromkeys(Model)


def scope(models: Iterable[Model], section: str) -> str:
    """Name models in few words.

    >>> scope(Model, "2.3"), scope([Model.I_7017Z], "2.4")
    ('all models', 'I-7017Z')
    """
    models = set(models)
    if models == set(Model):
        return "all models"
    if section in AVAILABILITY and models == set(AVAILABILITY[section].gates):
        return AVAILABILITY[section].scope
    others = set(Model) - models
    few = min(models, others, key=len)
    names = ", ".join(model.value for model in Model if model in few)
    return f"all but {names}" if few is others else names


# --- meanings ---------------------------------------------------------------------------------------------------------

_Found = tuple[dcon.Message, dcon.AnyCommand | None]


@lru_cache(maxsize=1024)  # who polls says the same again and again
def meanings(frame: bytes, asked: bytes | None, known: Known) -> tuple[Meaning, ...]:
    r"""Tell what a frame can mean, as the response to `asked` if that is given.

    Special: factory defaults are tried first. A meaning with numbers that no module of their types writes is given,
        as a misfit, only if no other type or data format fits.
    Errors: `DecodeError` if it means nothing.

    >>> [type(meaning.message).__name__ for meaning in meanings(b"$01A\r", None, Known())]
    ['ReadAnalogInputsHex', 'ReadCjcUpdate']
    """

    def read(profile: Profile) -> Iterable[_Found]:
        if is_command(frame):
            return [(dcon.decode_command(frame, profile), None)]
        if asked is None:
            return _responses(frame, profile)
        try:
            command = dcon.decode_command(asked, profile)
        except DecodeError:
            return []  # what the command was read with is elsewhere
        if isinstance(command, dcon.Broadcast):
            return _responses(frame, profile)
        return [(dcon.decode_response(frame, command, profile), command)]

    return _search(read, known)


def _search(read: Callable[[Profile], Iterable[_Found]], known: Known) -> tuple[Meaning, ...]:
    faults: list[DecodeError] = []
    misfits: _Meanings = {}
    for profiles in ((known.default,) if known.default else (), known.all):
        found: _Meanings = {}
        for profile in profiles:
            try:
                pairs = list(read(profile))
            except DecodeError as fault:
                faults.append(fault)
                continue
            for message, command in pairs:
                readings, misfit = _readings(message, command, profile)
                which = misfits if misfit else found
                which.setdefault((message, command, readings), ([], misfit))[0].append(profile)
        if found:
            return _sorted(found, known)
    if misfits:
        return _sorted(misfits, known)
    raise faults[0]


_Meanings = dict[
    tuple[dcon.Message, dcon.AnyCommand | None, tuple[ChannelReading, ...]], tuple[list[Profile], DecodeError | None]
]


def _sorted(found: _Meanings, known: Known) -> tuple[Meaning, ...]:
    unknown = [("type", known.types), ("format", known.data_format)]
    result = []
    for (message, command, readings), (profiles, misfit) in found.items():
        by_default = readings and profiles == [known.default]
        assumed = tuple(name for name, value in unknown if value is None) if by_default else ()
        result.append(Meaning(message, command, readings, tuple(profiles), assumed, misfit))
    return tuple(sorted(result, key=_section))


def _section(meaning: Meaning) -> tuple[int, ...]:
    command = meaning.command or meaning.message
    return tuple(map(int, command.section.split(".")))


def _responses(frame: bytes, profile: Profile) -> Iterator[_Found]:
    """Read a response to whatever the module can be asked."""
    body = dcon.unseal(frame, checksum=profile.checksum, leads=_RESPONSE_LEADS).decode("ascii")
    kinds = (
        command.response
        for command in dcon.COMMANDS
        if issubclass(command, dcon.Command) and command.section not in profile.refused
    )
    read = False
    responses: dict[type[dcon.Response], None] = dict.fromkeys((dcon.Refused, *kinds))
    for kind in responses:
        try:
            yield kind.layout.decode(body, profile), None
        except (KeyError, DecodeError):
            continue
        read = True
    if not read:
        raise DecodeError(Fault.COMMAND, frame, 1, allowed="a response of chapter 2", section="2")


def _readings(
    message: dcon.Message, command: dcon.AnyCommand | None, profile: Profile
) -> tuple[tuple[ChannelReading, ...], DecodeError | None]:
    """Read the fields of a report, and say why the first one that does not fit its type does not."""
    data_format = DataFormat.HEX if isinstance(message, dcon.AnalogInputsHex) else profile.data_format
    types = dict(enumerate(profile.type_codes))
    if isinstance(message, dcon.AnalogInputs | dcon.AnalogInputsHex | dcon.SynchronizedData):
        fields: list[tuple[int | None, str]] = list(enumerate(message.values))
    elif isinstance(message, dcon.AnalogInput):
        fields = [(command.channel if isinstance(command, dcon.ReadAnalogInput) else None, message.value)]
    else:
        return (), None
    uniform = profile.type_codes[0] if len(set(profile.type_codes)) == 1 else None
    found = []
    misfit = None
    for channel, text in fields:
        type_code = uniform if channel is None else types.get(channel)
        try:
            reading = decode_field(
                text,
                type_code or TypeCode.V_10,
                data_format,
                legacy=profile.legacy_sentinels,
                lenient=type_code is None,
            )
        except DecodeError as error:
            misfit = misfit or error
            found.append(ChannelReading(channel, text, None, type_code))
            continue
        if type_code is not None:
            found.append(ChannelReading(channel, text, reading.status, type_code, reading.value, reading.unit))
        else:
            status = None if reading.status is Status.OK else reading.status
            found.append(ChannelReading(channel, text, status, None))
    return tuple(found), misfit
