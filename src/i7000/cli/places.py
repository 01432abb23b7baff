"""The options of the commands that hosts connect to: where they do."""

from typing import TYPE_CHECKING, Annotated

from attrs import frozen
from cyclopts import Parameter

if TYPE_CHECKING:
    from i7000.cli.serving import Place

__all__ = ["DEFAULT_PLACES", "PlaceOptions"]


@Parameter(name="*")
@frozen
class PlaceOptions:
    """Where hosts connect."""

    pty: Annotated[
        bool,
        Parameter(
            help="Open a pseudo-terminal. The default without --tcp and --rfc2217.", negative="", show_default=False
        ),
    ] = False
    tcp: Annotated[str | None, Parameter(help="Listen for TCP at [HOST:]PORT, plain bytes. Example: 5020.")] = None
    rfc2217: Annotated[str | None, Parameter(help="Listen for RFC 2217 at [HOST:]PORT. Example: 5021.")] = None

    @property
    def has_pty(self) -> bool:
        """Whether a pseudo-terminal is opened."""
        return self.pty or (self.tcp is None and self.rfc2217 is None)

    @property
    def given(self) -> tuple[str, ...]:
        """The options as they were given."""
        named = (("--tcp", self.tcp), ("--rfc2217", self.rfc2217))
        words = [word for name, text in named if text is not None for word in (name, text)]
        return (*(("--pty",) if self.pty else ()), *words)

    def places(self) -> "tuple[Place, ...]":
        """Return the places on the network.

        Errors: `UsageError`.
        """
        from i7000.cli.serving import read_place  # noqa: PLC0415 - networks take time to import

        schemes = (("socket", self.tcp), ("rfc2217", self.rfc2217))
        return tuple(read_place(scheme, text) for scheme, text in schemes if text is not None)


DEFAULT_PLACES = PlaceOptions()
