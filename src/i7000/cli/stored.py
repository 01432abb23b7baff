"""The settings that a module in INIT mode has stored: those that are in use when INIT is off again."""

from attrs import frozen

from i7000 import BaudRate, LineSettings, Model, Profile, Protocol, dcon, describe
from i7000.cli.silence import protocol_words
from i7000.host import Answered
from i7000.host.procedures import Identified, Procedure, ask

__all__ = ["Stored", "line_words", "stored_settings"]


@frozen
class Stored:
    """The stored settings of a module in INIT mode, as far as it says them."""

    address: int
    line: LineSettings | None
    checksum: bool | None
    """Whether DCON frames have a checksum."""
    protocol: Protocol | None

    def words(self) -> str:
        """Return the settings in words.

        >>> Stored(0x05, LineSettings(), True, Protocol.DCON).words()
        'in INIT mode; stored: address 05, 9600 N81, DCON with a checksum'
        """
        words = [f"address {describe.address(self.address)}"]
        if self.line is not None:
            words.append(line_words(self.line))
        if self.protocol is not None and self.checksum is not None:
            words.append(protocol_words(self.protocol, checksum=self.checksum))
        return f"in INIT mode; stored: {', '.join(words)}"


def line_words(line: LineSettings) -> str:
    """Return line settings in words.

    >>> line_words(LineSettings())
    '9600 N81'
    """
    rate = line.baud_rate
    return f"{rate.bits_per_second if isinstance(rate, BaudRate) else f'{rate:02X}h'} {line.character_format.name}"


def stored_settings(found: Identified) -> Procedure[Stored | None]:
    """Make the procedure that reads the stored settings of a module in INIT mode; None for another module.

    Manual: 1.12.2, 2.10, 2.25, A.1; E18.
    """
    if found.stored_address is None:
        return None
    configured = yield from ask(dcon.ReadConfiguration(found.address), Profile(Model.I_7018, type_codes=()))
    checksum = None
    if isinstance(configured.outcome, Answered):
        checksum = configured.outcome.response.report_settings.checksum
    protocol: Protocol | None = Protocol.DCON
    models = [candidate.model for candidate in found.candidates]
    if any(Protocol.MODBUS_RTU in model.protocols for model in models):
        spoken = yield from ask(dcon.ReadProtocol(found.address), Profile(Model.M_7018, type_codes=()))
        if isinstance(spoken.outcome, Answered):
            protocol = spoken.outcome.response.protocol
        elif all(Protocol.MODBUS_RTU in model.protocols for model in models):
            protocol = None  # an I-model does not have the command
    return Stored(found.stored_address, found.line_settings, checksum, protocol)
