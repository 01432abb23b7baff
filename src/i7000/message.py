"""The base of all messages of both protocols: frozen values whose class states its wire form once.

Laws: every message that can be constructed has a wire form, so base classes cannot be constructed. `check` raises if a
model does not accept a message.
"""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar, get_args

from attrs import fields

import i7000.frozen
from i7000.availability import Availability
from i7000.errors import ArgumentError
from i7000.profile import Profile

__all__ = ["CompiledOnce", "Message", "Query", "Response", "answer_of", "frozen"]

_IN_HEX = ("address", "new_address", "mask")


class CompiledOnce:
    """The layout of a message class, compiled at its first use."""

    def __init__(self, compile_layout: Callable[[Any], Any]) -> None:
        self._compile = compile_layout

    def __get__(self, message: object, kind: Any) -> Any:  # noqa: ANN401 - a class and its layout
        kind.layout = self._compile(kind)
        return kind.layout


class ConstructedOnce:
    """The constructor of a message class, taken from its layout."""

    def __get__(self, message: Any, kind: Any) -> Any:  # noqa: ANN401 - a message or None, its class, the constructor
        if not hasattr(kind, "section"):
            return _construct_a_base.__get__(message, kind)
        constructor = kind.layout.construct
        constructor.__name__, constructor.__qualname__ = "__init__", f"{kind.__qualname__}.__init__"
        constructor.__module__ = kind.__module__
        constructor.__annotations__ = {it.name: it.type for it in fields(kind)} | {"return": None}
        kind.__init__ = constructor
        return constructor.__get__(message, kind)


def _construct_a_base(message: Any, *_: object, **__: object) -> None:  # noqa: ANN401 - a message
    kind = type(message)
    instead: str = kind._instead  # noqa: SLF001 - of the class that this constructs
    raise ArgumentError("message", kind, f"construct {instead}", f"{kind.__name__} is a base class")


if TYPE_CHECKING:
    from attrs import frozen
else:
    # The comparison, text and constructor are those of `Message`.
    frozen = partial(i7000.frozen.frozen, eq=False, repr=False, init=False)


class Message:
    """A message of one of the protocols.

    Shape: `section` of the manual; `title`, a short name for people; `availability`, the models that have it; `layout`,
        the compiled wire form.
    """

    __slots__ = ()

    section: ClassVar[str]
    title: ClassVar[str]
    availability: ClassVar[Availability] = Availability.ALL
    layout: ClassVar[Any]
    _instead: ClassVar[str] = "one of the messages, such as ReadConfiguration"
    """The classes to construct in place of a base class, which has no section."""

    if not TYPE_CHECKING:  # pragma: no branch - attrs knows its arguments
        __init__ = ConstructedOnce()

    def _values(self) -> dict[str, Any]:
        return {it.name: getattr(self, it.name) for it in fields(type(self))}  # type: ignore[arg-type] # of an attrs class

    def __eq__(self, other: object) -> bool:
        return self._values() == other._values() if type(self) is type(other) else NotImplemented

    def __hash__(self) -> int:
        return hash((type(self), *self._values().values()))

    def __repr__(self) -> str:
        """Return the constructor call, with addresses in hex as the manual writes them."""
        values = (
            f"{name}=0x{value:02X}" if name in _IN_HEX else f"{name}={value!r}"
            for name, value in self._values().items()
        )
        return f"{type(self).__name__}({', '.join(values)})"

    def describe(self, request: "Message | None" = None) -> dict[str, str]:  # noqa: ARG002 - for those that need it
        """Return the fields in words, by name; `request` is the command or request that the message answers.

        Shape: codes, masks and settings with their meaning, quantities with their unit.
        """
        parts = {it.name: it.type.__metadata__[0] for it in fields(type(self))}  # type: ignore[arg-type] # as in `_values`
        return {name: parts[name].describe(value) for name, value in self._values().items()}

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a message that the module of `profile` does not accept or send.

        Errors: `EncodeError`.
        """


class Response(Message):
    """The base class of the responses of both protocols: the messages that a module sends."""

    __slots__ = ()

    _instead = "one of the responses, such as InputRegisters"


R_co = TypeVar("R_co", bound=Response, covariant=True)
"""The response to a message of a host."""


class Query(Message, Generic[R_co]):
    """The base class of the messages that a host sends, of both protocols; R_co is the class of the response.

    Shape: a `i7000.dcon.Command`, a `i7000.dcon.Broadcast` (a query without a response: ``Query[Never]``) or a
        `i7000.modbus.Request`.
    """

    __slots__ = ()

    _instead = "one of the requests, such as ReadInputRegisters"


def answer_of(kind: Any) -> Any:  # noqa: ANN401 - classes
    """Return the class in the brackets of a message class: ``class ReadConfiguration(Command[Configuration])``.

    Special: a response has the availability of its command if both have the same section.
    """
    response = get_args(kind.__orig_bases__[0])[0]
    if getattr(response, "section", None) == getattr(kind, "section", ""):
        response.availability = kind.availability
    return response
