"""Where settings stand: in a field of a message, or in a register; and how each is read and written there.

Laws: a write is made from what was read just before (`draft`), with one field changed (`put`): the others stay as they
are. Settings with the same `key` stand in the same place, and one command writes them together.
"""

from collections.abc import Callable
from enum import Enum
from functools import lru_cache
from operator import attrgetter
from typing import Any, get_args

from attrs import evolve, fields, fields_dict

from i7000.errors import InvalidValueError
from i7000.frozen import frozen
from i7000.modbus import registers as rows
from i7000.modbus.cold_junction import FIRST_CHANNEL, offset_in_celsius
from i7000.modbus.register_map import RegisterMap
from i7000.profile import Profile

__all__ = ["Access", "InMessage", "InRegister", "Place", "message", "register", "registers_of"]


@lru_cache(maxsize=64)
def registers_of(profile: Profile) -> RegisterMap:
    """Return the map of a module; without rows if it has none."""
    return RegisterMap(profile)


@frozen
class InMessage:
    """A setting in a field of a message: `reader` asks for it, and `writer` sets it together with its neighbours.

    Shape: `path` leads to the field in the writer, with points between: ``report_settings.filter``.
        `response_path` is the path in the response, if it is another one. `bit` is the bit of a byte. `per_unit` is how
        many counts are one unit; 0 means as the layout of the message defines it.
    """

    reader: Any
    writer: Any
    path: str
    response_path: str = ""
    bit: int = 0
    per_unit: int = 0
    channel: int | None = None
    """The channel, as the messages number it."""

    @property
    def key(self) -> object:
        """The place: equal for settings that one command writes."""
        return self.writer, self.channel

    @property
    def family(self) -> object:
        """The kind of request that reads it, the same for all channels."""
        return self.reader

    def read(self, address: int) -> Any:  # noqa: ANN401 - a query of either protocol
        """Return the request that reads it."""
        return self.reader(address, **self._channel(self.reader))

    def value(self, response: Any) -> Any:  # noqa: ANN401 - of any setting
        """Return the value in the response, in the unit of the setting."""
        held = attrgetter(self.response_path or self.path)(response)
        if self._in_byte:
            return offset_in_celsius(FIRST_CHANNEL, held)
        scale = self._scale
        return held if scale == 1 else held / scale

    def draft(self, address: int, response: Any) -> Any:  # noqa: ANN401
        """Return the command that writes back what was read."""
        values = {it.name: getattr(response, it.name, None) for it in fields(self.writer)}
        if "new_address" in values:
            values["new_address"] = response.address
        return self.writer(**values | {"address": address} | self._channel(self.writer))

    def put(self, draft: Any, value: Any) -> Any:  # noqa: ANN401
        """Return a draft with the value changed."""
        name, _, part = self.path.partition(".")
        held = getattr(draft, name)
        if part:
            return evolve(draft, **{name: evolve(held, **{part: value})})
        if self.bit:
            on = value.value if isinstance(value, Enum) else value
            return evolve(draft, **{name: held & ~self.bit | self.bit * on})
        if self._scale != 1:
            value = round(value * self._scale) & (0xFF if self._in_byte else -1)
        return evolve(draft, **{name: value})

    def command(self, address: int, draft: Any) -> Any:  # noqa: ANN401, ARG002 - the draft has the address
        """Return the command of a draft."""
        return draft

    def _channel(self, kind: Any) -> dict[str, int]:  # noqa: ANN401 - a class
        if "channel" not in fields_dict(kind):
            return {}
        return {"channel": self.channel or 0}

    @property
    def _in_byte(self) -> bool:
        """Whether it is an offset of a channel by function 46h: two's complement in the low byte (E62)."""
        return self.channel is not None and self.channel >= FIRST_CHANNEL

    @property
    def _scale(self) -> int:
        """The counts of one unit."""
        field = fields_dict(self.writer).get(self.path)
        if self.per_unit or field is None:
            return self.per_unit or 1
        return round(1 / getattr(get_args(field.type)[1], "scale", 1))


@frozen
class InRegister:
    """A setting in a row of the address map, by its name; `part` is a part of the value of the row."""

    registers: RegisterMap
    name: str
    part: str = ""
    channel: int | None = None

    @property
    def row(self) -> rows.Register:
        """The row of the map."""
        return self.registers.find(self.name)

    @property
    def key(self) -> object:
        """The place: equal for settings that one command writes."""
        return self.name, self.channel

    @property
    def family(self) -> object:
        """The kind of request that reads it, the same for all channels."""
        return self.name

    def read(self, address: int) -> Any:  # noqa: ANN401 - a request
        """Return the request that reads the row, with all channels."""
        return self.registers.read(address, self.name)

    def value(self, response: Any) -> Any:  # noqa: ANN401 - of any setting
        """Return the value in the response, in the unit of the row.

        Errors: `InvalidValueError` for a register with several settings whose value is undefined.
        """
        held: Any = self.registers.decode(self.name, response.values)
        if self.channel is not None:
            return held[self.channel]
        return getattr(self._defined(held), self.part) if self.part else held

    def _defined(self, held: Any) -> Any:  # noqa: ANN401 - of any row
        if not hasattr(held, self.part):
            raise InvalidValueError(self.name, held, f"a value that has a {self.part.replace('_', ' ')}", "3.4")
        return held

    def draft(self, address: int, response: Any) -> Any:  # noqa: ANN401, ARG002
        """Return what was read."""
        return self.registers.decode(self.name, response.values) if self.part else None

    def put(self, draft: Any, value: Any) -> Any:  # noqa: ANN401
        """Return a draft with the value changed."""
        return evolve(self._defined(draft), **{self.part: value}) if self.part else value

    def command(self, address: int, draft: Any) -> Any:  # noqa: ANN401
        """Return the request that writes a draft.

        Errors: `EncodeError` for a value that the row cannot contain.
        """
        channels = None if self.channel is None else range(self.channel, self.channel + 1)
        return self.registers.write(address, self.name, draft, channels=channels)


Access = InMessage | InRegister
"""How a setting is read and written."""
Place = Callable[[Profile, int | None], Access | None]
"""Returns where a setting stands on a module, of a channel or of the module; None if the module does not have it."""


def message(reader: Any, writer: Any, path: str, *, first: int = 0, **facts: Any) -> Place:  # noqa: ANN401
    """Return the place of a setting in a field of a message; `first` is the number of channel 0."""

    def on(profile: Profile, channel: int | None) -> InMessage | None:
        if not profile.refused.isdisjoint((reader.availability, writer.availability)):
            return None
        number = None if channel is None else first + channel
        return InMessage(reader, writer, path, channel=number, **facts)

    return on


def register(name: str, part: str = "") -> Place:
    """Return the place of a setting in a row of the address map."""

    def on(profile: Profile, channel: int | None) -> InRegister | None:
        registers = registers_of(profile)
        there = any(row.name == name and row.access is rows.Access.READ_WRITE for row in registers)
        return InRegister(registers, name, part, channel) if there else None

    return on
