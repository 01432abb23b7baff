"""What every DCON message is, and the answers that many commands share (manual 2).

Laws: a message that can be constructed has a wire form; whether a certain model takes it is what `check` knows. A
command names its response by type: ``class ReadConfiguration(Command[Configuration])``.
"""

from typing import ClassVar, Generic, TypeVar

from i7000 import message
from i7000.dcon.layout import Layout
from i7000.dcon.parts import Address

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
        cls.response = message.answer_of(cls)

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
