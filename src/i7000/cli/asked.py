"""The options of commands that ask one module.

Laws: nothing here needs a port.
"""

from typing import Annotated

from attrs import frozen
from cyclopts import Parameter

from i7000.cli.options import Module
from i7000.cli.port import AskOptions, LineOptions
from i7000.cli.wanted import ProtocolChoice, Wanted, wanted
from i7000.cli.words import UsageError
from i7000.host import Policy
from i7000.settings import LineSettings

__all__ = ["DEFAULT_ONE", "LEFT_CHANGED", "Asked", "OneModule", "Yes", "asked_of"]

LEFT_CHANGED = 6
"""The exit code if the module was left changed, or may be."""
_WITHOUT_LINE = ("exec:", "socket:")
"""The targets that pass bytes on whatever the line settings of the host are."""
Yes = Annotated[bool, Parameter(help="Do it without asking you first.", negative="")]


@Parameter(name="*")
@frozen
class OneModule:
    """Which module is asked."""

    address: str | None = None
    """Address of the module; 1 unless given. Example: --address 2."""
    protocol: ProtocolChoice = "auto"
    """Protocol of the module; auto tries both."""


DEFAULT_ONE = OneModule()


@frozen
class Asked:
    """A module to be asked, and how."""

    target: str
    settings: LineSettings
    policy: Policy
    echo: bool
    wanted: Wanted
    others: tuple[LineSettings, ...] = ()
    """The line settings at which the module is looked for if it does not answer."""


def asked_of(  # noqa: PLR0913 - each of them is an option
    target: str,
    line: LineOptions,
    asking: AskOptions,
    one: OneModule,
    module: Module,
    *,
    otherwise: LineSettings = LineSettings(),  # noqa: B008 - frozen
    detected: bool = False,
) -> Asked:
    """Return the module that options describe.

    Shape: `otherwise` are the line settings unless they are given. With `detected`, line settings that are not given
        are looked for, at a target that has some.
    Errors: `UsageError`.
    """
    first, *more = wanted(() if one.address is None else (one.address,), module, one.protocol)
    if more and one.address is None:
        raise UsageError("--model describes several modules: give the --address of one")
    settings = line.settings(otherwise)
    others = line.others() if detected and not target.startswith(_WITHOUT_LINE) else ()
    return Asked(target, settings, asking.policy(), asking.echo, first, others)
