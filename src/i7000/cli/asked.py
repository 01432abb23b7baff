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


def asked_of(target: str, line: LineOptions, asking: AskOptions, one: OneModule, module: Module) -> Asked:
    """Return the module that options describe.

    Errors: `UsageError`.
    """
    first, *others = wanted(() if one.address is None else (one.address,), module, one.protocol)
    if others and one.address is None:
        raise UsageError("--model describes several modules: give the --address of one")
    return Asked(target, line.settings(), asking.policy(), asking.echo, first)
