"""The bus of the load run: 32 modules, and what each has to answer to what.

Laws: what is expected is made by arithmetic on what is on the inputs, without `i7000`; a reading tells the module and
the channel, a setting the module and the value that was written.
"""

from attrs import evolve, frozen

from i7000 import Model, Protocol, Unit
from i7000.device import Signal, factory
from i7000.settings import DataFormat
from i7000.simulator.simulator import Simulated
from i7000.simulator.sources import Fixed, Sources
from tests.crc import crc

__all__ = ["STATIONS", "VALUES", "Exchange", "Station"]

Exchange = tuple[bytes, bytes]
"""A request, and the only right answer."""

VALUES = range(64)
"""What is written, one after the other."""


@frozen
class Station:
    """A module of the bus; those with odd addresses speak DCON, every other one of them with a checksum."""

    address: int
    model: Model

    @property
    def protocol(self) -> Protocol:
        """What it speaks."""
        return Protocol.DCON if self.address % 2 else Protocol.MODBUS_RTU

    @property
    def checksum(self) -> bool:
        """Whether its frames have a checksum."""
        return self.address % 4 == 1

    @property
    def data_format(self) -> DataFormat:
        """How it tells readings by DCON."""
        return DataFormat(self.address // 2 % 3)

    @property
    def channels(self) -> int:
        """How many inputs it has."""
        return {"Z": 10, "6": 16}.get(self.model.value[-1], 8)

    @property
    def span(self) -> tuple[float, int, Unit]:
        """The full scale of its factory type, its decimals and its unit."""
        if "C" in self.model.value:
            return 20.0, 3, Unit.MILLIAMPERE
        return (2.5, 4, Unit.VOLT) if "7018" in self.model.value else (10.0, 3, Unit.VOLT)

    def thousandths(self, channel: int) -> int:
        """Return the signal of an input, in thousandths of the full scale; all inputs differ."""
        return (20 * (self.address - 1) + channel + 1) * (-1 if channel % 2 else 1)

    def simulated(self) -> Simulated:
        """Make it for the simulator."""
        made = factory(self.model)
        report = evolve(made.report_settings, checksum=self.checksum, data_format=self.data_format)
        eeprom = evolve(made, address=self.address, protocol=self.protocol, report_settings=report)
        full, _, unit = self.span
        channels = [Fixed(Signal(self.thousandths(it) * full / 1000, unit)) for it in range(self.channels)]
        return Simulated(eeprom, Sources(tuple(channels)))

    # --- reading ------------------------------------------------------------------------------------------------------

    def reads(self) -> tuple[Exchange, ...]:
        """Read all inputs, each input alone and the name."""
        if self.protocol is Protocol.DCON:
            fields = [self._field(channel) for channel in range(self.channels)]
            alone = [self._dcon(f"#{self.address:02X}{at:X}", ">" + field) for at, field in enumerate(fields)]
            name = self.model.value[2:].replace("-", "")[:6]
            asked = f"{self.address:02X}"
            return self._dcon("#" + asked, ">" + "".join(fields)), self._dcon(f"${asked}M", f"!{asked}{name}"), *alone
        words = [self._word(channel) for channel in range(self.channels)]
        some = [(at, count) for at in range(self.channels) for count in (1, self.channels - at)]
        return tuple(
            self._rtu(b"\x04" + _words(at, count), b"\x04" + bytes((2 * count,)) + _words(*words[at : at + count]))
            for at, count in some
        )

    def _field(self, channel: int) -> str:
        thousandths = self.thousandths(channel)
        full, decimals, _ = self.span
        if self.data_format is DataFormat.HEX:
            return f"{self._word(channel):04X}"
        if self.data_format is DataFormat.PERCENT:
            return f"{thousandths / 10:+07.2f}"
        return f"{thousandths * full / 1000:+07.{decimals}f}"

    def _word(self, channel: int) -> int:
        thousandths = self.thousandths(channel)
        return round(thousandths * (0x7FFF if thousandths > 0 else 0x8000) / 1000) & 0xFFFF

    # --- writing ------------------------------------------------------------------------------------------------------

    def writes(self, value: int) -> tuple[Exchange, ...]:
        """Write two settings: name and mask, or time-out of the host watchdog and mask, which silence has to end."""
        if self.protocol is Protocol.DCON:
            asked = f"{self.address:02X}"
            mask = self._mask(value)
            return (
                self._dcon(f"~{asked}OW{asked}{value:02X}", f"!{asked}"),
                self._dcon(f"${asked}5{mask}", f"!{asked}"),
            )
        timeout = b"\x06" + _words(488, value)
        written = (self._rtu(timeout, timeout),)
        return written if self.channels > 8 else (*written, self._rtu(bytes((0x46, 0x26, value)), b"\x46\x26\x00"))

    def written(self, value: int) -> tuple[Exchange, ...]:
        """Read back what `writes` wrote."""
        if self.protocol is Protocol.DCON:
            asked = f"{self.address:02X}"
            return (
                self._dcon(f"${asked}M", f"!{asked}W{asked}{value:02X}"),
                self._dcon(f"${asked}6", f"!{asked}{self._mask(value)}"),
            )
        told = (self._rtu(b"\x03" + _words(488, 1), b"\x03\x02" + _words(value)),)
        return told if self.channels > 8 else (*told, self._rtu(b"\x46\x25", bytes((0x46, 0x25, value))))

    def _mask(self, value: int) -> str:
        return f"{value:02X}" if self.channels == 8 else f"{value:04X}"

    # --- frames -------------------------------------------------------------------------------------------------------

    def _dcon(self, asked: str, told: str) -> Exchange:
        request, answer = [text + f"{sum(text.encode()) % 256:02X}" * self.checksum + "\r" for text in (asked, told)]
        return request.encode(), answer.encode()

    def _rtu(self, asked: bytes, told: bytes) -> Exchange:
        request, answer = [bytes((self.address,)) + pdu for pdu in (asked, told)]
        return request + crc(request), answer + crc(answer)


def _words(*values: int) -> bytes:
    return b"".join(value.to_bytes(2, "big") for value in values)


_BY_DCON = (
    Model.I_7017,
    Model.I_7018,
    Model.I_7017C,
    Model.I_7018Z,
    Model.I_7019R,
    Model.M_7017,
    Model.M_7018R,
    Model.M_7019Z,
)
_BY_MODBUS = (
    Model.M_7017,
    Model.M_7018,
    Model.M_7017C,
    Model.M_7018Z,
    Model.M_7019R,
    Model.M_7017mC_16,
    Model.M_7018R,
    Model.M_7019Z,
)
STATIONS = tuple(
    Station(address, (_BY_DCON if address % 2 else _BY_MODBUS)[(address - 1) // 2 % 8]) for address in range(1, 33)
)
