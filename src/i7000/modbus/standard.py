"""The functions of the Modbus specification that the address maps need: 01 02 03 04 05 06 0F 10 (manual 3.1, 3.2, 3.4).

Laws: addresses begin at 0; the manual numbers items from 1 and puts the digit of their kind before: 40489 is the
holding register at address 488.
"""

from i7000.availability import Availability
from i7000.errors import EncodeError
from i7000.message import frozen
from i7000.modbus import items
from i7000.modbus.registers import Area
from i7000.modbus.request import Request, Response
from i7000.profile import Profile

__all__ = [
    "Coils",
    "DiscreteInputs",
    "HoldingRegisters",
    "InputRegisters",
    "MultipleCoilsWritten",
    "MultipleRegistersWritten",
    "ReadCoils",
    "ReadDiscreteInputs",
    "ReadHoldingRegisters",
    "ReadInputRegisters",
    "SingleCoilWritten",
    "SingleRegisterWritten",
    "WriteMultipleCoils",
    "WriteMultipleRegisters",
    "WriteSingleCoil",
    "WriteSingleRegister",
]

_MOST_WRITTEN_TO_7019 = 11
"""The maximum number of registers in one write to the 7019 series."""


@frozen
class Coils(Response):
    """The states of coils.

    Wire: ``01 bytes values:bits``
    Shape: as many bits as the request reads; decoded without the request, the padding bits of the last byte too.
    Manual: 3.4; E55, E120.
    """

    pdu = "01 bytes values:bits"
    section = "3.4"
    title = "coils"
    area = Area.COIL

    values: items.Bits


@frozen
class ReadCoils(Request[Coils]):
    """A request to read coils.

    Wire: ``01 start:2 count:2`` -> ``01 bytes values:bits``
    Range: 1 to 2000 of them, none beyond address 65535.
    Manual: 3.4; E55.
    """

    pdu = "01 start:2 count:2"
    section = "3.4"
    title = "coils"
    availability = Availability.ADDRESS_MAP

    start: items.Start
    count: items.BitCount


@frozen
class DiscreteInputs(Response):
    """The states of discrete inputs.

    Wire: ``02 bytes values:bits``
    Shape: as many bits as the request reads; decoded without the request, the padding bits of the last byte too.
    Manual: 3.1; E55, E120.
    """

    pdu = "02 bytes values:bits"
    section = "3.1"
    title = "discrete inputs"
    area = Area.DISCRETE_INPUT

    values: items.Bits


@frozen
class ReadDiscreteInputs(Request[DiscreteInputs]):
    """A request to read discrete inputs.

    Wire: ``02 start:2 count:2`` -> ``02 bytes values:bits``
    Range: 1 to 2000 of them, none beyond address 65535.
    Manual: 3.1; E55.
    """

    pdu = "02 start:2 count:2"
    section = "3.1"
    title = "discrete inputs"
    availability = Availability.RANGE_STATUS

    start: items.Start
    count: items.BitCount


@frozen
class HoldingRegisters(Response):
    """The values of holding registers.

    Wire: ``03 bytes values:words``
    Shape: as many words as the request reads.
    Manual: 3.4; E55.
    """

    pdu = "03 bytes values:words"
    section = "3.4"
    title = "holding registers"
    area = Area.HOLDING_REGISTER

    values: items.Words


@frozen
class ReadHoldingRegisters(Request[HoldingRegisters]):
    """A request to read holding registers.

    Wire: ``03 start:2 count:2`` -> ``03 bytes values:words``
    Range: 1 to 125 of them, none beyond address 65535.
    Manual: 3.4; E55.
    """

    pdu = "03 start:2 count:2"
    section = "3.4"
    title = "holding registers"
    availability = Availability.ADDRESS_MAP

    start: items.Start
    count: items.WordCount


@frozen
class InputRegisters(Response):
    """The values of input registers.

    Wire: ``04 bytes values:words``
    Shape: as many words as the request reads.
    Manual: 3.2; E55.
    """

    pdu = "04 bytes values:words"
    section = "3.2"
    title = "input registers"
    area = Area.INPUT_REGISTER

    values: items.Words


@frozen
class ReadInputRegisters(Request[InputRegisters]):
    """A request to read input registers.

    Wire: ``04 start:2 count:2`` -> ``04 bytes values:words``
    Range: 1 to 125 of them, none beyond address 65535.
    Manual: 3.2; E55.
    """

    pdu = "04 start:2 count:2"
    section = "3.2"
    title = "input registers"
    availability = Availability.M_SERIES

    start: items.Start
    count: items.WordCount


@frozen
class SingleCoilWritten(Response):
    """The confirmation that a coil was written.

    Wire: ``05 coil:2 value:2``
    Manual: 3.4; E55.
    """

    pdu = "05 coil:2 value:2"
    section = "3.4"
    title = "coil"
    area = Area.COIL

    coil: items.Word
    value: items.Coil


@frozen
class WriteSingleCoil(Request[SingleCoilWritten]):
    """A request to write one coil.

    Wire: ``05 coil:2 value:2`` -> ``05 coil:2 value:2``
    Shape: FF00 is true, 0000 false; other values are invalid.
    Manual: 3.4; E55.
    """

    pdu = "05 coil:2 value:2"
    section = "3.4"
    title = "coil"
    availability = Availability.ADDRESS_MAP
    broadcast = True

    coil: items.Word
    value: items.Coil


@frozen
class SingleRegisterWritten(Response):
    """The confirmation that a holding register was written.

    Wire: ``06 register:2 value:2``
    Manual: 3.4; E55.
    """

    pdu = "06 register:2 value:2"
    section = "3.4"
    title = "holding register"
    area = Area.HOLDING_REGISTER

    register: items.Word
    value: items.Word


@frozen
class WriteSingleRegister(Request[SingleRegisterWritten]):
    """A request to write one holding register.

    Wire: ``06 register:2 value:2`` -> ``06 register:2 value:2``
    Manual: 3.4; E55.
    """

    pdu = "06 register:2 value:2"
    section = "3.4"
    title = "holding register"
    availability = Availability.ADDRESS_MAP
    broadcast = True

    register: items.Word
    value: items.Word


@frozen
class MultipleCoilsWritten(Response):
    """The confirmation that coils were written.

    Wire: ``0F start:2 count:2``
    Manual: 3.4; E55.
    """

    pdu = "0F start:2 count:2"
    section = "3.4"
    title = "coils"
    area = Area.COIL

    start: items.Start
    count: items.WrittenBitCount


@frozen
class WriteMultipleCoils(Request[MultipleCoilsWritten]):
    """A request to write coils.

    Wire: ``0F start:2 count:2 bytes values:bits`` -> ``0F start:2 count:2``
    Range: 1 to 1968 of them, none beyond address 65535.
    Special: padding bits are written as 0, and ignored when read.
    Manual: 3.4; E55, E120.
    """

    pdu = "0F start:2 count:2 bytes values:bits"
    section = "3.4"
    title = "coils"
    availability = Availability.ADDRESS_MAP
    broadcast = True

    start: items.Start
    values: items.WrittenBits


@frozen
class MultipleRegistersWritten(Response):
    """The confirmation that holding registers were written.

    Wire: ``10 start:2 count:2``
    Manual: 3.4; E55.
    """

    pdu = "10 start:2 count:2"
    section = "3.4"
    title = "holding registers"
    area = Area.HOLDING_REGISTER

    start: items.Start
    count: items.WrittenWordCount


@frozen
class WriteMultipleRegisters(Request[MultipleRegistersWritten]):
    """A request to write holding registers.

    Wire: ``10 start:2 count:2 bytes values:words`` -> ``10 start:2 count:2``
    Range: 1 to 123 of them, none beyond address 65535.
    Errors: `EncodeError` for more than 11 to the 7019 series.
    Manual: 3.4, 3.4.8, 3.4.9; E55.
    """

    pdu = "10 start:2 count:2 bytes values:words"
    section = "3.4"
    title = "holding registers"
    availability = Availability.ADDRESS_MAP
    broadcast = True

    start: items.Start
    values: items.WrittenWords

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for more registers than the module accepts at once."""
        count = len(self.values)
        if profile.model.series == "7019" and count > _MOST_WRITTEN_TO_7019:
            allowed = f"1..{_MOST_WRITTEN_TO_7019} registers in one write on {profile.model.value}"
            raise EncodeError("count", count, allowed, self.section)


REQUESTS = (
    ReadCoils,
    ReadDiscreteInputs,
    ReadHoldingRegisters,
    ReadInputRegisters,
    WriteSingleCoil,
    WriteSingleRegister,
    WriteMultipleCoils,
    WriteMultipleRegisters,
)
"""The requests of this module, by function and sub-function."""
