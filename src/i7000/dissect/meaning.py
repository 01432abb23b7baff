"""What a frame means: one `Meaning` for both protocols."""

import re
from functools import cache, cached_property
from typing import Any, NamedTuple

from attrs import frozen

from i7000 import dcon
from i7000.dissect.known import Fact, Origin
from i7000.errors import DecodeError
from i7000.message import Message
from i7000.models import Model
from i7000.profile import Profile
from i7000.readings import Reading, Status
from i7000.settings import DataFormat, ModbusDataFormat, Protocol
from i7000.type_codes import TypeCode, Unit

__all__ = ["ChannelReading", "Field", "Fit", "Item", "Meaning", "errata"]


class Field(NamedTuple):
    """A field of a message."""

    name: str
    value: Any
    """The value in the message."""
    text: str
    """The value in words, with its unit."""


class ChannelReading(NamedTuple):
    """The reading of a channel, as it was sent and as a value."""

    channel: int | None
    text: str
    status: Status | None
    """None for a number of an unknown type, or one that the type cannot have."""
    type_code: TypeCode | None
    value: float | None = None
    unit: Unit | None = None


class Item(NamedTuple):
    """A coil, an input or a register that a Modbus message touches; or the registers of one number."""

    number: str
    """The number of the manual: 40489."""
    name: str | None
    """None if the map does not have it, or the model is unknown."""
    channel: int | None
    value: Any
    """The value in its unit; as sent if it has no name; None if the message has no values."""
    unit: str | None
    text: str | None
    """The value in words; for a reading, the word in hex."""
    reading: Reading | None = None
    type_code: TypeCode | None = None
    fact: tuple[str, Any] | None = None
    """The property of the module that it shows or sets, and its value: see `i7000.modbus.Register.fact`."""


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
    """One thing that a frame can mean.

    It is compared by identity: what was made of a meaning is remembered, and found again at once.
    """

    message: Message
    command: Message | None
    """The command or request that it answers."""
    fit: Fit
    """The profiles it was read with."""
    readings: tuple[ChannelReading, ...] = ()
    items: tuple[Item, ...] = ()
    """The coils and registers that it touches."""
    facts: tuple[Fact, ...] = ()
    """The facts that its readings depend on: ``types`` and the data format."""
    notes: tuple[str, ...] = ()
    misfit: DecodeError | None = None
    """Why the first reading without a value cannot be one of its type."""
    refuted: tuple[Fact, ...] = ()
    """The learned facts that it does not fit, and was read without."""

    @property
    def protocol(self) -> Protocol:
        """The protocol of the frame."""
        return Protocol.DCON if isinstance(self.message, dcon.Message) else Protocol.MODBUS_RTU

    @property
    def section(self) -> str:
        """The section of the manual: that of the command."""
        return self.message.section if self.command is None else self.command.section

    @cached_property
    def fields(self) -> tuple[Field, ...]:
        """The fields of the message."""
        message = self.message
        texts = message.describe(self.command)
        return tuple(Field(name, getattr(message, name), text) for name, text in texts.items())

    @property
    def errata(self) -> tuple[str, ...]:
        """The errata that concern the message."""
        kind: Any = type(self.message)
        return errata(kind)

    @cached_property
    def pause(self) -> float:
        """The seconds to leave the module alone after it."""
        if not isinstance(self.message, dcon.Command | dcon.Broadcast):
            return 0.0
        return max(dcon.pause_after(self.message, profile) for profile in self.fit.profiles)

    @cached_property
    def models(self) -> tuple[Model, ...]:
        """The models that can have sent it, or been sent it."""
        sent: Any = self.command or self.message
        having = (it.model for it in self.fit.profiles if sent.availability not in it.refused)
        return tuple(dict.fromkeys(having)) if self.protocol is Protocol.MODBUS_RTU else self.fit.models

    @property
    def assumed(self) -> tuple[str, ...]:
        """The names of the facts that nothing shows: factory defaults, and what a broadcast set."""
        return tuple(fact.name for fact in self.facts if fact.origin is Origin.ASSUMED)

    @property
    def data_formats(self) -> tuple[DataFormat | ModbusDataFormat, ...]:
        """The formats that its readings fit; empty if it has none, or if they are always in hex."""
        if not self.readings or isinstance(self.message, dcon.AnalogInputsHex):
            return ()
        return self.fit.data_formats if self.protocol is Protocol.DCON else (self.fit.profiles[0].modbus_data_format,)

    @property
    def checksum(self) -> bool | None:
        """Whether it has a DCON checksum; None: it fits with and without."""
        return None if self.protocol is Protocol.MODBUS_RTU else self.fit.checksum


@cache
def errata(kind: Any) -> tuple[str, ...]:  # noqa: ANN401 - a message class
    """Return the errata that the docstring of a message class names.

    >>> errata(dcon.SetConnectingMode)
    ('E03',)
    """
    manual = (kind.__doc__ or "").partition("Manual:")[2]
    return tuple(f"E{int(number):02d}" for number in re.findall(r"\bE(\d+)\b", manual))
