"""What every DCON message is, and the answers that many commands share (manual 2).

Laws: a message that can be constructed has a wire form; whether a certain model takes it is what `check` knows. A
command names its response by type: ``class ReadConfiguration(Command[Configuration])``.
"""

from typing import Any, ClassVar, Generic, TypeVar

from i7000 import message
from i7000.dcon.layout import Address, Layout
from i7000.errors import EncodeError
from i7000.profile import Profile

__all__ = ["Acknowledged", "Broadcast", "Command", "Message", "Refused", "Response"]


class Message(message.Message):
    """A DCON message: a command, a broadcast or a response.

    Shape: `syntax` in the manual's notation, without checksum and carriage return.
    """

    __slots__ = ()

    syntax: ClassVar[str]
    layout: ClassVar[Layout] = message.CompiledOnce(Layout.compile)  # type: ignore[assignment] # until the first use


class Response(Message):
    """What a module answers."""

    __slots__ = ()

    _instead = "one of the responses, such as AnalogInputs"


R = TypeVar("R", bound=Response)
"""The response of a command."""


class Broadcast(Message):
    """A command to all modules; none answers."""

    __slots__ = ()

    _instead = "one of the broadcasts, such as HostOk"


@message.frozen
class Command(Message, Generic[R]):
    """A command to one module, and the type of its valid response."""

    response: ClassVar[type[Response]]
    _instead = "one of the commands, such as ReadConfiguration"

    address: Address

    def __init_subclass__(cls) -> None:
        super(Command, cls).__init_subclass__()  # noqa: UP008 - `frozen`
        cls.response = message.type_of_answer(cls)

    @property
    def answering_address(self) -> int:
        """The address in the valid response."""
        return self.address


@message.frozen
class Acknowledged(Response):
    """Say that a command was carried out.

    Wire: ``!AA``
    Manual: 2.
    """

    syntax = "!AA"
    section = "2"
    title = "command carried out"

    address: Address


@message.frozen
class Refused(Response):
    """Say that a command is well-formed but was not carried out: the invalid response of every command.

    Wire: ``?AA``
    Manual: 2; E16, E27.
    """

    syntax = "?AA"
    section = "2"
    title = "command refused"

    address: Address


def check_channel(command: Command[Any], channel: int, profile: Profile) -> None:
    """Refuse a channel that the module does not have."""
    if channel >= profile.channels:
        allowed = f"0..{profile.channels - 1}: {profile.model.value}"
        raise EncodeError("channel", channel, allowed, command.section)


def check_mask(sent: Message, mask: int, profile: Profile) -> None:
    """Refuse a mask with bits of channels that the module does not have."""
    if mask >> profile.channels:
        allowed = f"bits 0..{profile.channels - 1}: {profile.model.value}"
        raise EncodeError("mask", f"{mask:X}", allowed, sent.section)


def check_type_code(command: Command[Any], type_code: int, profile: Profile) -> None:
    """Refuse a type code that the module cannot be set to."""
    if not profile.supports(type_code):
        allowed = f"{profile.supported_types()}: {profile.model.value}"
        raise EncodeError("type_code", f"{type_code:02X}", allowed, command.section)
