"""The base classes of Modbus messages, and the exception that can answer every request (manual 3).

Laws: a request names the type of its response: ``class ReadCoils(Request[Coils])``. An exception of a module is a value
too: `ExceptionResponse`.
"""

from enum import IntEnum
from typing import Annotated, ClassVar, TypeVar

from i7000 import message
from i7000.modbus.items import Address, ExceptionFunction, ResultByte, byte
from i7000.modbus.layout import Layout
from i7000.modbus.registers import Area

__all__ = ["BROADCAST", "ExceptionCode", "ExceptionResponse", "Message", "Request", "Response", "SettingResult"]

BROADCAST = 0
"""The address of a request that all modules carry out and none of them answers: functions 05, 06, 0F and 10."""
MODULE_SETTINGS = 0x46
"""The function code that has sub-functions."""
EXCEPTION_BIT = 0x80
FIRST_ITEMS = "start", "coil", "register"
"""The fields that have the address of the first item that a message is about."""
LAST_ADDRESS = 247
"""The highest address of a module."""


class ExceptionCode(IntEnum):
    """The reason why a module did not carry out a request (manual 3; names as in the Modbus specification)."""

    ILLEGAL_FUNCTION = 0x01
    ILLEGAL_DATA_ADDRESS = 0x02
    ILLEGAL_DATA_VALUE = 0x03
    SERVER_DEVICE_FAILURE = 0x04
    ACKNOWLEDGE = 0x05
    SERVER_DEVICE_BUSY = 0x06
    MEMORY_PARITY_ERROR = 0x08
    GATEWAY_PATH_UNAVAILABLE = 0x0A
    GATEWAY_TARGET_DEVICE_FAILED_TO_RESPOND = 0x0B


@message.frozen
class Message(message.Message):
    """A Modbus message: a request or a response.

    Shape: `pdu` in the notation of `i7000.modbus.layout`.
    """

    pdu: ClassVar[str]
    layout: ClassVar[Layout] = message.CompiledOnce(Layout.compile)  # type: ignore[assignment] # until the first use

    area: ClassVar[Area | None] = None
    """The table of the coils, inputs or registers that it reads, writes or has; None for other messages."""
    _instead = "one of the messages, such as ReadInputRegisters"

    address: Address

    @property
    def first_item(self) -> int | None:
        """The address of the first coil, input or register that it names; None if it names none."""
        return next((getattr(self, name) for name in FIRST_ITEMS if hasattr(self, name)), None)


class Response(Message, message.Response):
    """The base class of responses: the messages that a module sends."""

    _instead = "one of the responses, such as InputRegisters"


R = TypeVar("R", bound=Response)
"""The response of a request."""


class Request(Message, message.Query[R]):
    """The base class of requests to one module; `response` is the type of the response. Address 0 is `BROADCAST`."""

    response: ClassVar[type[Response]]
    function: ClassVar[int]
    sub_function: ClassVar[int | None]
    broadcast: ClassVar[bool] = False
    """Whether the request can be sent to all modules."""
    _instead = "one of the requests, such as ReadInputRegisters"

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.response = message.answer_of(cls)
        cls.area = cls.response.area
        function, *rest = cls.pdu.split(" ")
        cls.function = int(function, 16)
        cls.sub_function = int(rest[0], 16) if cls.function == MODULE_SETTINGS else None


@message.frozen
class SettingResult(Response):
    """The result of a request that changes a setting.

    Shape: a `result` of 0 means that the setting was made; other values are not documented (E90).
    """

    _instead = "one of the results, such as ModuleAddressResult"

    result: ResultByte


def _exception(code: int) -> str:
    known = {it.value: it.name.lower().replace("_", " ") for it in ExceptionCode}
    return f"{code:02X}, {known.get(code, 'not defined')}"


@message.frozen
class ExceptionResponse(Response):
    """The response that a request was not carried out, with the reason; it can answer every request.

    Wire: function + 80h, exception code
    Shape: `exception_code` as sent; `ExceptionCode` has the defined codes.
    Manual: 3, 3.1, 3.2, 3.3; E90, E94, E99.
    """

    pdu = "function exception_code"
    section = "3"
    title = "exception"

    function: ExceptionFunction
    """The function code of the request, without the bit that marks an exception."""
    exception_code: Annotated[int, byte(_exception)]
