"""What is known about modules, and what a DCON frame means to those who know that much.

A `Known` stands for all the profiles that fit what is known; `reader` reads frames with each of them.

Laws: what is not known and need not be guessed is left open; a factory default that is relied on is named in
`Meaning.assumed`.
"""

import re
from collections.abc import Iterable
from functools import cache, cached_property
from itertools import product
from typing import NamedTuple

from attrs import evolve, frozen

from i7000 import (
    DataFormat,
    DecodeError,
    EncodeError,
    Firmware,
    ModbusDataFormat,
    Model,
    Profile,
    Status,
    TypeCode,
    Unit,
    dcon,
    modbus,
)
from i7000.availability import Availability
from i7000.message import Message
from i7000.profile import LAST_LEGACY

__all__ = ["ChannelReading", "Fit", "Known", "Meaning", "errata", "gates", "is_command", "scope"]

_COMMAND_LEADS = b"%#$~@"


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


class ChannelReading(NamedTuple):
    """One field of a report, and what is known of it."""

    channel: int | None
    text: str
    status: Status | None
    """None: a number of an unknown type, or one that no module of the type writes."""
    type_code: TypeCode | None
    value: float | None = None
    unit: Unit | None = None


@frozen(eq=False)
class Fit:
    """The profiles that a meaning fits, in the order in which they are tried."""

    profiles: tuple[Profile, ...]

    @cached_property
    def models(self) -> tuple[Model, ...]:
        """Their models."""
        return tuple(dict.fromkeys(profile.model for profile in self.profiles))

    @cached_property
    def checksum(self) -> bool | None:
        """Whether they have a checksum; None: some do."""
        first, *others = {profile.checksum for profile in self.profiles}
        return None if others else first

    @cached_property
    def data_formats(self) -> tuple[DataFormat, ...]:
        """Their data formats."""
        return tuple(sorted({profile.data_format for profile in self.profiles}))


@frozen(eq=False)
class Meaning:
    """One thing that a frame can mean."""

    message: dcon.Message
    command: dcon.AnyCommand | None
    """The one that it answers."""
    readings: tuple[ChannelReading, ...]
    fit: Fit
    """The profiles it was read with."""
    assumed: tuple[str, ...]
    """What has its factory default because it was not told: ``type``, ``format``."""
    misfit: DecodeError | None = None
    """Why the first reading without a value cannot be one of its type."""

    @property
    def data_formats(self) -> tuple[DataFormat, ...]:
        """The formats its readings fit; none if it has none, or if they are always in hex."""
        if not self.readings or isinstance(self.message, dcon.AnalogInputsHex):
            return ()
        return self.fit.data_formats

    @property
    def pause(self) -> float:
        """The seconds to leave the module alone after it."""
        if not isinstance(self.message, dcon.Command | dcon.Broadcast):
            return 0.0
        return max(dcon.pause_after(self.message, profile) for profile in self.fit.profiles)


def is_command(frame: bytes) -> bool:
    """Whether a frame is one that a host sends."""
    return frame[0] in _COMMAND_LEADS


def errata(kind: type[Message]) -> tuple[str, ...]:
    """List the errata that the docstring of a message class names.

    >>> errata(dcon.SetConnectingMode)
    ('E03',)
    """
    return _errata(kind.__doc__ or "")


@cache
def _errata(docstring: str) -> tuple[str, ...]:
    manual = docstring.partition("Manual:")[2]
    return tuple(f"E{int(number):02d}" for number in re.findall(r"\bE(\d+)\b", manual))


_AVAILABILITY: dict[str, Availability] = {
    kind.section: kind.availability for kinds in (dcon.COMMANDS, modbus.REQUESTS) for kind in kinds
}


def gates(section: str) -> dict[Model, Firmware | None]:
    """List the models that have a command, and the firmware from which on."""
    return dict(_AVAILABILITY[section].gates) if section in _AVAILABILITY else dict.fromkeys(Model)


def scope(models: Iterable[Model], section: str) -> str:
    """Name models in few words.

    >>> scope(Model, "2.3"), scope([Model.I_7017Z], "2.4")
    ('all models', 'I-7017Z')
    """
    models = set(models)
    if models == set(Model):
        return "all models"
    if section in _AVAILABILITY and models == set(_AVAILABILITY[section].gates):
        return _AVAILABILITY[section].scope
    others = set(Model) - models
    few = min(models, others, key=len)
    names = ", ".join(model.value for model in Model if model in few)
    return f"all but {names}" if few is others else names
