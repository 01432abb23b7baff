"""Registers by name, with units: requests to read and write them, and values from the responses (manual 3.4).

Laws: `RegisterMap.write` accepts every value that `RegisterMap.decode` returns, if it is in the range of its register.
Counters and states of a module can only be cleared. Nothing is clamped: values beyond the range or between two
counts are decoded, but not written.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, overload

from attrs import evolve, field

from i7000.arguments import as_tuple, check_type
from i7000.errors import DecodeError, EncodeError, Fault, InvalidValueError, shown
from i7000.frozen import frozen
from i7000.modbus.register_values import RegisterValue, counts_of, values_of
from i7000.modbus.registers import Access, Area, Kind, Register, rows
from i7000.modbus.request import ExceptionResponse, Request, Response
from i7000.modbus.standard import (
    Coils,
    DiscreteInputs,
    HoldingRegisters,
    InputRegisters,
    ReadCoils,
    ReadDiscreteInputs,
    ReadHoldingRegisters,
    ReadInputRegisters,
    WriteMultipleRegisters,
    WriteSingleCoil,
    WriteSingleRegister,
)
from i7000.profile import Profile
from i7000.settings import is_int

__all__ = ["Items", "Plan", "ReadItems", "RegisterMap"]

Items = Coils | DiscreteInputs | HoldingRegisters | InputRegisters
"""The responses that contain coils, inputs or registers."""
ReadItems = ReadCoils | ReadDiscreteInputs | ReadHoldingRegisters | ReadInputRegisters
"""The requests that read coils, inputs or registers."""

READERS: dict[Area | None, Any] = {
    kind.area: kind for kind in (ReadCoils, ReadDiscreteInputs, ReadInputRegisters, ReadHoldingRegisters)
}
"""The request that reads the items of an area."""
_FIRST_NUMBER, _LAST_NUMBER = 10001, 99999


@frozen
class RegisterMap:
    """The address map of one module: its coils, inputs and registers, by name and by number.

    Shape: if a row has a value for each channel, its name selects all of them. A number or address selects one: 30003
        is channel 2, a single value and not a tuple. `channels` overrides both, and counts from the first of the row.
        The log of the M-7017mC-16 has records instead of channels, of 18 registers each.
    Errors: `EncodeError` for registers that the module does not have or that cannot be read or written, and for values
        that a row cannot contain.
    Manual: 3.4.1 to 3.4.9.

    >>> from i7000 import Model
    >>> registers = RegisterMap(Profile(Model.M_7019R))
    >>> registers.find("host_watchdog_timeout").number, registers.find(40489).name
    ('40489', 'host_watchdog_timeout')
    >>> registers.write(0x01, "host_watchdog_timeout", 10.0)
    WriteSingleRegister(address=0x01, register=488, value=100)
    """

    profile: Profile
    rows: tuple[Register, ...] = field(init=False, repr=False, eq=False)

    @rows.default
    def _rows_of_profile(self) -> tuple[Register, ...]:
        if not isinstance(self.profile, Profile):
            raise EncodeError("profile", self.profile, "a Profile", "3.4")
        return rows(self.profile)

    def __iter__(self) -> Iterator[Register]:
        """Iterate over the rows, by area and address."""
        return iter(self.rows)

    def find(self, key: str | int, area: Area | None = None) -> Register:
        """Return a row by its name, by the manual's number of one of its items, or by the address of one.

        Shape: numbers are ints from 10001 on, or five digits as text (coils: ``"00257"``); lower ints are addresses, of
            holding registers unless `area` is given. The name of a reading finds its input register, not its holding
            register.
        """
        check_type("key", key, str, int)
        check_type("area", area, Area, optional=True)
        place = _place(key, area)
        found = [
            row
            for row in self.rows
            if area in (None, row.area)
            and (key == row.name or (place and row.area is place[0] and 0 <= place[1] - row.address < row.count))
        ]
        if found:
            return next((row for row in found if row.area in (Area.DISCRETE_INPUT, Area.INPUT_REGISTER)), found[0])
        names = ", ".join(sorted({row.name for row in self.rows})) or "it has no address map"
        raise EncodeError("register", key, names, "3.4", f"{self.profile.name} has no register {shown(key)}")

    def read(self, address: int, key: str | int, *, channels: range | None = None) -> ReadItems:
        """Return the request that reads a row, or some of its channels.

        Special: if a row has more channels than the connecting mode, only the channels of the mode are read.
        """
        row = self.find(key)
        if row.access is Access.WRITE:
            raise EncodeError("register", row.name, "it can only be written", "3.4")
        first, count, _ = self._span(row, key, channels)
        if row.kind is Kind.READING and first + count > self.profile.channels:
            allowed = f"a range within 0..{self.profile.channels - 1}, the channels of this connecting mode"
            raise EncodeError("channels", range(first, first + count), allowed, "3.4")
        width = row.kind.width
        request: ReadItems = READERS[row.area](address, row.address + first * width, count * width)
        return request

    def write(
        self,
        address: int,
        key: str | int,
        value: RegisterValue | Sequence[RegisterValue],
        *,
        channels: range | None = None,
        big_endian: bool = False,
    ) -> Request[Any]:
        """Return the request that writes a row, or some of its channels.

        Shape: `value` is what `decode` returns: one value for one item, a tuple or list for several. Coils take a bool;
            coded settings take a member of their enumeration.
        Special: `big_endian` as in `decode`. ``host_watchdog_timeout_count`` can only be cleared, by 0, and
            ``host_watchdog_timed_out`` by 1.
        """
        check_type("big_endian", big_endian, bool)
        row = self.find(key)
        if row.access is Access.READ:
            raise EncodeError("register", row.name, "it can only be read", "3.4")
        first, count, _ = self._span(row, key, channels)
        values = tuple(value) if isinstance(value, tuple | list) else (value,)
        if len(values) != count:
            raise EncodeError(row.name, value, _amount(count, first), "")
        counts = [it for one in values for it in counts_of(row, one, self.profile, big_endian=big_endian)]
        start = row.address + first
        if row.area is Area.COIL:
            return WriteSingleCoil(address, start, bool(counts[0]))
        if len(counts) == 1:
            return WriteSingleRegister(address, start, counts[0])
        return WriteMultipleRegisters(address, start, tuple(counts))

    @overload
    def decode(
        self, key: str | int, items: Iterable[int], *, channels: range, big_endian: bool = False
    ) -> tuple[RegisterValue, ...]: ...
    @overload
    def decode(
        self, key: str | int, items: Iterable[int], *, channels: range | None = None, big_endian: bool = False
    ) -> RegisterValue | tuple[RegisterValue, ...]: ...
    def decode(
        self, key: str | int, items: Iterable[int], *, channels: range | None = None, big_endian: bool = False
    ) -> RegisterValue | tuple[RegisterValue, ...]:
        """Return the values of a row, or of some of its channels, from the `values` of the response.

        Shape: a row of one item, or one item by its number, is returned as one value; everything else as a tuple,
            channel by channel. Readings are `Reading`, coded settings members of their enumeration, the log of the
            M-7017mC-16 `LogRecord`.
        Unit: that of the row.
        Special: `big_endian` is the state of coil 00283 of the M-7017mC-16: the 32-bit values of clock and log have
            their high word first; firmware version and module name never do (assumption; E75).
        Errors: `DecodeError` for a wrong number of items (`Fault.COUNT`), for an invalid item (`NUMBER`: words are ints
            0..65535, bits 0, 1 or bools), and for an invalid value of the row; `wire` is empty.
        """
        check_type("big_endian", big_endian, bool)
        row = self.find(key)
        first, count, one = self._span(row, key, channels)
        values = values_of(row, as_tuple("items", items), first, count, self.profile, big_endian=big_endian)
        return values[0] if one else values

    def plan(self, address: int, keys: Iterable[str | int], *, big_endian: bool = False) -> "Plan":
        """Plan to read several rows in few requests: neighbours are read together, as far as one frame can carry them.

        Errors: also `EncodeError` for two values of one name: the two rows of a reading, two channels.
        """
        check_type("big_endian", big_endian, bool)
        wanted: dict[str, tuple[Register, ReadItems, str | int]] = {}
        for key in as_tuple("keys", keys):
            row, request = self.find(key), self.read(address, key)
            if wanted.setdefault(row.name, (row, request, key))[:2] != (row, request):
                reason = f"{row.name} is requested twice, but values are returned by name"
                raise EncodeError("keys", key, "each name once", "3.4", reason)
        requests: list[ReadItems] = []
        places = []
        for row, request, key in sorted(wanted.values(), key=lambda it: (it[0].area.value, it[1].start)):
            last = requests[-1] if requests else None
            if isinstance(last, type(request)) and last.start + last.count == request.start:
                requests[-1] = evolve(last, count=last.count + request.count)
            else:
                requests.append(request)
            places.append((row, len(requests) - 1, request.start - requests[-1].start, request.count, key))
        return Plan(tuple(requests), tuple(places), self, big_endian)

    def _span(self, row: Register, key: str | int, channels: range | None) -> tuple[int, int, bool]:
        """Return which values of a row are selected: the first, how many, and whether it is a single value."""
        most = row.count // row.kind.width
        if channels is not None:
            if (
                most == 1
                or not isinstance(channels, range)
                or channels.step != 1
                or not 0 <= channels.start < channels.stop <= most
            ):
                several = f"a range within 0..{most - 1}"
                allowed = several if most > 1 else f"no channels: {row.name} is a single value"
                raise EncodeError("channels", channels, allowed, "3.4")
            return channels.start, len(channels), False
        place = _place(key, None)
        if most == 1 or place:
            return (place[1] - row.address) // row.kind.width if place else 0, 1, True
        return 0, most if row.kind is Kind.RECORD else min(most, self.profile.channels), False


def _amount(count: int, first: int) -> str:
    """Return how many values are expected, and how to write fewer."""
    if count == 1:
        return "1 value"
    return f"{count} values, one for each channel; or channels=range({first}, {first + 1}) to write one"


def _place(key: str | int, area: Area | None) -> tuple[Area, int] | None:
    """Return the area and address of a number; None for a name, or a number of no area."""
    if isinstance(key, int) and key < _FIRST_NUMBER:
        return area or Area.HOLDING_REGISTER, key
    if not isinstance(key, str) and not is_int(key, _FIRST_NUMBER, _LAST_NUMBER):
        return None
    text = str(key)
    if len(text) == 5 and text.isdecimal() and text.isascii() and int(text[0]) in {it.value for it in Area}:
        return Area(int(text[0])), int(text[1:]) - 1
    return None


@frozen
class Plan:
    """Requests that read several rows, and how to decode their responses.

    >>> from i7000 import Model
    >>> plan = RegisterMap(Profile(Model.M_7017)).plan(0x01, ["response_delay", "host_watchdog_timeout", "filter"])
    >>> plan.requests
    (ReadCoils(address=0x01, start=258, count=1), ReadHoldingRegisters(address=0x01, start=487, count=2))
    >>> plan.decode([Coils(0x01, (True,)), HoldingRegisters(0x01, (0, 25))])["host_watchdog_timeout"]
    2.5
    """

    requests: tuple[ReadItems, ...]
    places: tuple[tuple[Register, int, int, int, str | int], ...]
    """Places of the rows: the request that reads each, its first item in the response, its number of items, and its
    key.
    """
    registers: RegisterMap
    big_endian: bool

    def decode(
        self, responses: Sequence[Items | ExceptionResponse]
    ) -> dict[str, RegisterValue | tuple[RegisterValue, ...] | ExceptionResponse]:
        """Return the values by name; the value of a row whose request was refused is the exception.

        Errors: `InvalidValueError` for a wrong number of responses; `DecodeError` as for `RegisterMap.decode`, and for
            a response that does not answer its request, or None: `Fault.FUNCTION`, `ADDRESS`, `COUNT`.
        """
        responses = as_tuple("responses", responses)
        for response in responses:
            check_type("responses", response, Response, optional=True)
        if len(responses) != len(self.requests):
            raise InvalidValueError("responses", len(responses), f"{len(self.requests)}, one for each request", "3.4")
        for request, response in zip(self.requests, responses, strict=True):
            _check_response(request, response)
        values: dict[str, RegisterValue | tuple[RegisterValue, ...] | ExceptionResponse] = {}
        for row, at, first, count, key in self.places:
            response = responses[at]
            if isinstance(response, ExceptionResponse):
                values[row.name] = response
            else:
                items = response.values[first : first + count]
                values[row.name] = self.registers.decode(key, items, big_endian=self.big_endian)
        return values


def _check_response(request: ReadItems, response: Items | ExceptionResponse) -> None:
    """Raise `DecodeError` for a response that does not answer the request."""
    if isinstance(response, ExceptionResponse):
        answers = response.function == request.function
    else:
        answers = isinstance(response, request.response)
    if not answers:
        allowed = f"{request.response.__name__}, or an exception of function {request.function:02X}"
        raise DecodeError(Fault.FUNCTION, b"", field="responses", allowed=allowed, section=request.section)
    if response.address != request.address:
        allowed = f"{request.address:02X}, not {response.address:02X}"
        raise DecodeError(Fault.ADDRESS, b"", field="responses", allowed=allowed, section=request.section)
    if not isinstance(response, ExceptionResponse) and len(response.values) != request.count:
        allowed = f"{request.count} items, not {len(response.values)}"
        raise DecodeError(Fault.COUNT, b"", field="responses", allowed=allowed, section=request.section)
