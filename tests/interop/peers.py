"""pymodbus, modbus-tk and minimalmodbus as hosts, pymodbus and modbus-tk as modules, all asked in the same way.

Laws: a peer is used through what it offers to its users wherever that can be done without a line; nothing of this
package is used here, so that what peers say cannot lean on it.
"""

import asyncio
import struct
from itertools import count
from typing import Any, Protocol

import minimalmodbus
from attrs import define, field, frozen
from modbus_tk import defines
from modbus_tk.exceptions import InvalidArgumentError, ModbusError, ModbusInvalidResponseError
from modbus_tk.modbus import Databank
from modbus_tk.modbus_rtu import RtuMaster, RtuQuery
from modbus_tk.utils import calculate_crc
from pymodbus.constants import ExcCodes
from pymodbus.exceptions import ModbusException
from pymodbus.framer import FramerRTU
from pymodbus.pdu import DecodePDU, ModbusPDU, bit_message, register_message

READS_OF_BITS = (0x01, 0x02)
READS = (0x01, 0x02, 0x03, 0x04)
WRITES_OF_BITS = (0x05, 0x0F)
SINGLE_WRITES = (0x05, 0x06)
AREAS = {0x01: 0x01, 0x05: 0x01, 0x0F: 0x01, 0x02: 0x02, 0x03: 0x03, 0x06: 0x03, 0x10: 0x03, 0x04: 0x04}
"""The function that reads what a function is about."""

Items = tuple[int, ...]


@frozen
class Call:
    """The task of a host: how many items to read, or which to write."""

    address: int
    function: int
    start: int
    count: int = 0
    items: Items = ()


@frozen
class Told:
    """What a peer understood: the items read, none for a write; or an exception."""

    items: Items = ()
    exception_code: int | None = None


@frozen
class Asked:
    """What a host sent and what it made of the answer; None for what it refused."""

    sent: bytes | None
    told: Told | None


class Host(Protocol):
    """A peer that asks."""

    name: str

    def ask(self, call: Call, answer: bytes) -> Asked:
        """Have it send a request, and give it the answer."""

    def crc(self, data: bytes) -> bytes:
        """The CRC as it sends it."""


@define
class Line:
    """A serial port that answers whatever is sent with the same bytes."""

    answer: bytes
    sent: bytes | None = None
    timeout: float = 1.0
    baudrate: int = 115200
    is_open: bool = True
    inter_byte_timeout: float = 0.0
    name: str = "line"
    port: str = field(factory=(f"line {number}" for number in count()).__next__)
    """No two are the same: minimalmodbus waits after what it last read from a port."""

    def flush(self) -> None:
        """Do nothing: nothing is kept back."""

    open = close = reset_input_buffer = reset_output_buffer = flush

    def write(self, data: bytes) -> None:
        """Keep what is sent."""
        self.sent = data

    def read(self, size: int) -> bytes:
        """Hand out the answer."""
        taken, self.answer = self.answer[:size], self.answer[size:]
        return taken


class PymodbusHost:
    """pymodbus without its transport: messages and framer."""

    name = "pymodbus"

    def ask(self, call: Call, answer: bytes) -> Asked:
        """Have it send a request, and give it the answer."""
        framer = FramerRTU(DecodePDU(is_server=False))
        try:
            sent = framer.buildFrame(_pymodbus_request(call))
        except (ModbusException, ValueError, OverflowError, struct.error):
            return Asked(None, None)
        try:
            _, message = framer.handleFrame(answer, call.address, 0)
        except ModbusException:
            message = None
        return Asked(sent, None if message is None else self._told(call, message))

    @staticmethod
    def _told(call: Call, message: ModbusPDU) -> Told:
        if message.isError():
            return Told(exception_code=message.exception_code)
        if call.function not in READS:
            return Told()
        bits = call.function in READS_OF_BITS
        return Told(tuple(message.bits[: call.count] if bits else message.registers))

    def crc(self, data: bytes) -> bytes:
        """The CRC as it sends it."""
        return FramerRTU.compute_CRC(data).to_bytes(2, "big")


_PYMODBUS_REQUESTS: dict[int, Any] = {
    0x01: bit_message.ReadCoilsRequest,
    0x02: bit_message.ReadDiscreteInputsRequest,
    0x03: register_message.ReadHoldingRegistersRequest,
    0x04: register_message.ReadInputRegistersRequest,
    0x05: bit_message.WriteSingleCoilRequest,
    0x06: register_message.WriteSingleRegisterRequest,
    0x0F: bit_message.WriteMultipleCoilsRequest,
    0x10: register_message.WriteMultipleRegistersRequest,
}


def _pymodbus_request(call: Call) -> ModbusPDU:
    values: dict[str, Any] = {"dev_id": call.address, "address": call.start}
    if call.function in READS:
        values["count"] = call.count
    elif call.function in WRITES_OF_BITS:
        values["bits"] = [bool(item) for item in call.items]
    else:
        values["registers"] = list(call.items)
    request: ModbusPDU = _PYMODBUS_REQUESTS[call.function](**values)
    return request


class ModbusTkHost:
    """The master of modbus-tk."""

    name = "modbus-tk"

    def ask(self, call: Call, answer: bytes) -> Asked:
        """Have it send a request, and give it the answer."""
        line = Line(answer)
        master = RtuMaster(line)
        value: Any = call.items[0] if call.function in SINGLE_WRITES else call.items
        try:
            found = master.execute(call.address, call.function, call.start, call.count, output_value=value)
        except ModbusError as error:
            return Asked(line.sent, Told(exception_code=error.get_exception_code()))
        except (InvalidArgumentError, ModbusInvalidResponseError, struct.error):
            return Asked(line.sent, None)
        return Asked(line.sent, Told(found if call.function in READS else ()))

    def crc(self, data: bytes) -> bytes:
        """The CRC as it sends it."""
        crc: int = calculate_crc(data)
        return crc.to_bytes(2, "big")


class MinimalmodbusHost:
    """The instrument of minimalmodbus."""

    name = "minimalmodbus"

    def ask(self, call: Call, answer: bytes) -> Asked:
        """Have it send a request, and give it the answer."""
        line = Line(answer)
        instrument = minimalmodbus.Instrument(line, call.address)
        try:
            found = self._run(instrument, call)
        except minimalmodbus.SlaveReportedException as error:
            text = str(error)  # "Slave reported error code 9", or one of those it has words for
            code = _MINIMALMODBUS_CODES.get(text) or int(text.rsplit(" ", 1)[1])
            return Asked(line.sent, Told(exception_code=code))
        except (minimalmodbus.ModbusException, ValueError):
            return Asked(line.sent, None)
        return Asked(line.sent, Told(tuple(found or ())))

    @staticmethod
    def _run(instrument: Any, call: Call) -> list[int] | None:
        items = list(call.items)
        found: list[int] | None = None
        match call.function:
            case 0x01 | 0x02:
                found = instrument.read_bits(call.start, call.count, call.function)
            case 0x03 | 0x04:
                found = instrument.read_registers(call.start, call.count, call.function)
            case 0x05:
                instrument.write_bit(call.start, int(items[0]))
            case 0x06:
                instrument.write_register(call.start, items[0], functioncode=call.function)
            case 0x0F:
                instrument.write_bits(call.start, [int(item) for item in items])
            case _:
                instrument.write_registers(call.start, items)
        return found

    def crc(self, data: bytes) -> bytes:
        """The CRC as it sends it."""
        crc: bytes = minimalmodbus._calculate_crc(data)  # noqa: SLF001 - it offers none
        return crc


_MINIMALMODBUS_CODES = {
    "Slave reported illegal function": 1,
    "Slave reported illegal data address": 2,
    "Slave reported illegal data value": 3,
    "Slave reported device failure": 4,
    "Slave reported device busy": 6,
    "Slave reported memory parity error": 8,
    "Slave reported gateway path unavailable": 10,
    "Slave reported gateway target device failed to respond": 11,
}

HOSTS: tuple[Host, ...] = (PymodbusHost(), ModbusTkHost(), MinimalmodbusHost())


class Module(Protocol):
    """A peer that is asked: it has items 0 to `SIZE` of every area, zero at first."""

    name: str

    def store(self, function: int, start: int, items: Items) -> None:
        """Put items where the function reads or writes."""

    def stored(self, function: int, start: int, count: int) -> Items:
        """The items there."""

    def answer(self, frame: bytes) -> bytes:
        """What it answers; nothing if it is silent."""


SIZE = 0xC000


@define
class PymodbusModule:
    """pymodbus without its server: messages, framer, and a memory of our own under them."""

    name = "pymodbus"
    address: int
    areas: dict[int, list[int]] = field(factory=lambda: {area: [0] * SIZE for area in READS})

    def store(self, function: int, start: int, items: Items) -> None:
        """Put items where the function reads or writes."""
        self.areas[AREAS[function]][start : start + len(items)] = items

    def stored(self, function: int, start: int, count: int) -> Items:
        """The items there."""
        return tuple(self.areas[AREAS[function]][start : start + count])

    def answer(self, frame: bytes) -> bytes:
        """What it answers; nothing if it is silent."""
        framer = FramerRTU(DecodePDU(is_server=True))
        try:
            _, request = framer.handleFrame(frame, 0, 0)
        except ModbusException:
            return b""
        if request is None:
            return b""
        response = asyncio.run(request.datastore_update(self, self.address))  # type: ignore[arg-type] # a context to it
        if request.dev_id == 0:
            return b""
        response.dev_id = request.dev_id
        return framer.buildFrame(response)

    async def async_getValues(self, _: int, function: int, start: int, count: int) -> Items | ExcCodes:  # noqa: N802
        """What its requests read of a context."""
        return ExcCodes.ILLEGAL_ADDRESS if start + count > SIZE else self.stored(function, start, count)

    async def async_setValues(self, _: int, function: int, start: int, items: Items) -> ExcCodes | None:  # noqa: N802
        """What its requests write to a context."""
        if start + len(items) > SIZE:
            return ExcCodes.ILLEGAL_ADDRESS
        self.store(function, start, items)
        return None


class ModbusTkModule:
    """The data bank of modbus-tk."""

    name = "modbus-tk"

    def __init__(self, address: int) -> None:
        self._bank = Databank()
        self._slave = self._bank.add_slave(address)
        for area, kind in (
            (0x01, defines.COILS),
            (0x02, defines.DISCRETE_INPUTS),
            (0x03, defines.HOLDING_REGISTERS),
            (0x04, defines.ANALOG_INPUTS),
        ):
            self._slave.add_block(area, kind, 0, SIZE)

    def store(self, function: int, start: int, items: Items) -> None:
        """Put items where the function reads or writes."""
        self._slave.set_values(AREAS[function], start, items)

    def stored(self, function: int, start: int, count: int) -> Items:
        """The items there."""
        found: Items = self._slave.get_values(AREAS[function], start, count)
        return found

    def answer(self, frame: bytes) -> bytes:
        """What it answers; nothing if it is silent."""
        return self._bank.handle_request(RtuQuery(), frame) or b""


MODULES = (PymodbusModule, ModbusTkModule)
