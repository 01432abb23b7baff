"""The arguments of a command or request, with all that its response can depend on; the same for both protocols."""

from typing import Any, NamedTuple

from i7000.device.signals import Signals
from i7000.device.state import Eeprom, State

__all__ = ["Call"]


class Call(NamedTuple):
    """A decoded command or request, and the module that carries it out."""

    state: State
    message: Any
    signals: Signals
    now: float
    values: tuple[Any, ...] = ()
    """The values to write to a row of registers."""

    @property
    def eeprom(self) -> Eeprom:
        """The stored settings of the module."""
        return self.state.eeprom

    @property
    def address(self) -> int:
        """The address of the message."""
        address: int = self.message.address
        return address

    @property
    def value(self) -> Any:  # noqa: ANN401 - what the row holds
        """The value to write to a row with one value."""
        return self.values[0]
