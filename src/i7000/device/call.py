"""What a module was asked, with all that its answer can depend on: the same for both protocols."""

from typing import Any, NamedTuple

from i7000.device.signals import Signals
from i7000.device.state import Eeprom, State

__all__ = ["Call"]


class Call(NamedTuple):
    """A command or request that was understood, and the module that is to carry it out."""

    state: State
    message: Any
    signals: Signals
    now: float
    values: tuple[Any, ...] = ()
    """What is to be written to a row of registers."""

    @property
    def eeprom(self) -> Eeprom:
        """What the module has stored."""
        return self.state.eeprom

    @property
    def address(self) -> int:
        """The address that the message is for."""
        address: int = self.message.address
        return address

    @property
    def value(self) -> Any:  # noqa: ANN401 - what the row holds
        """The value that is to be written to a row of one."""
        return self.values[0]
