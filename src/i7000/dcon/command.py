"""The base classes of DCON messages, and the two responses that many commands share (manual 2).

Laws: every message that can be constructed has a wire form; `check` raises if a model does not accept it. A command
names the type of its response: ``class ReadConfiguration(Command[Configuration])``.
"""

from typing import ClassVar, Never, TypeVar

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


class Response(Message, message.Response):
    """The base class of responses: the messages that a module sends."""

    __slots__ = ()

    _instead = "one of the responses, such as AnalogInputs"


R = TypeVar("R", bound=Response)
"""The response of a command."""


class Broadcast(Message, message.Query[Never]):
    """The base class of broadcasts: commands to all modules, without a response."""

    __slots__ = ()

    _instead = "one of the broadcasts, such as HostOk"


@message.frozen
class Command(Message, message.Query[R]):
    """The base class of commands to one module; `response` is the type of the valid response."""

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
    """The response that a command was carried out.

    Wire: ``!AA``
    Manual: 2.
    """

    syntax = "!AA"
    section = "2"
    title = "command carried out"

    address: Address


@message.frozen
class Refused(Response):
    """The response that a well-formed command was not carried out: the invalid response of every command.

    Wire: ``?AA``
    Manual: 2; E16, E27.
    """

    syntax = "?AA"
    section = "2"
    title = "command refused"

    address: Address
