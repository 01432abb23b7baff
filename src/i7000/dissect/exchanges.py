"""The facts that an exchange shows about a module: a setting that was read, or a change that was accepted.

One row a command: the facts, from the command and its response. What a register shows stands at its row, in
`i7000.modbus.Register.fact`.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any

from attrs import evolve

from i7000 import dcon, modbus
from i7000.dissect.known import Fact, Known
from i7000.dissect.meaning import Item, Meaning
from i7000.dissect.registers import items
from i7000.errors import EncodeError
from i7000.message import Message
from i7000.modbus.request import LAST_ADDRESS
from i7000.models import Firmware, Model
from i7000.settings import DataFormat, Protocol
from i7000.type_codes import TypeCode

__all__ = ["TEACHING", "address_of_all", "broadcast_facts", "facts_of", "new_address"]


def facts_of(meaning: Meaning, known: Known, where: str) -> Iterator[Fact]:
    """Yield the facts that a response shows together with its command; `where` is its place."""
    command, response = meaning.command, meaning.message
    if command is None or isinstance(response, dcon.Refused | modbus.ExceptionResponse):
        return
    for rows, changed in ((_READ, False), (_SET, True)):
        row = rows.get(type(command))
        if row is not None and not getattr(response, "result", 0):
            yield from (
                Fact(name, value, where=where, changed=changed) for name, value in row(command, response, known)
            )
    if isinstance(command, dcon.SetConfiguration) and meaning.checksum is not None:
        wanted = command.report_settings.checksum  # which holds from the next power-on, or at once in soft INIT mode
        yield Fact("checksum", wanted if wanted is meaning.checksum else None, where=where, changed=True)
    for name, value in _of_registers(meaning, known):
        yield Fact(name, value, where=where, changed=isinstance(command, _WRITES))


def new_address(meaning: Meaning) -> int | None:
    """Return the address that the module has from this response on, if the command changed it."""
    command, response = meaning.command, meaning.message
    done = isinstance(response, dcon.Acknowledged) or getattr(response, "result", 1) == 0
    if done and isinstance(command, dcon.SetConfiguration):
        return command.new_address
    moved: int | None = None
    if done and isinstance(command, modbus.SetModuleAddress):
        moved = command.new_address
    elif isinstance(command, _WRITES) and not isinstance(response, modbus.ExceptionResponse):
        moved = _address_in(items(command, None, meaning.fit.profiles[0]))
    return moved if moved is not None and 1 <= moved <= LAST_ADDRESS else None


_Pairs = Iterator[tuple[str, Any]]
_REMEMBERED = 64
"""The number of pairs of a broadcast and a module for which the cache keeps what the one sets in the other."""

# --- DCON, and function 46h -------------------------------------------------------------------------------------------


_SPEAKING = tuple(model for model in Model if Protocol.MODBUS_RTU in model.protocols)
_MIXED = 2
"""The fewest types of a module whose channels have a type each."""


def _types(code: TypeCode | int) -> _Pairs:
    """Yield the type of all channels, if the code is defined."""
    if isinstance(code, TypeCode):
        yield "types", (code,)


def _channel_type(channel: int, code: TypeCode | int, known: Known) -> _Pairs:
    """Yield the types of all channels, from the type of one of them and those that are known."""
    if not isinstance(code, TypeCode):
        return
    types = known.types or ()
    if types == (code,):
        return
    open_ended = len(types) < _MIXED
    if len(types) == 1:
        default = evolve(known, types=None).default
        types *= channel + 1 if default is None else default.channels
        open_ended = default is None
    others = {at: it for at, it in enumerate(types) if it is not None} | {channel: code}
    last = max(others) + 2 if open_ended or None in types or channel >= len(types) else len(types)
    yield "types", tuple(others.get(at) for at in range(last))


def _configuration(message: Any, known: Known) -> _Pairs:  # noqa: ANN401 - the command or the response
    report = message.report_settings
    if known.model is None or known.model.type_by_configuration:
        yield from _types(message.type_code)
    if isinstance(report.data_format, DataFormat):
        yield "data_format", report.data_format
    yield "line_settings", message.line_settings


def _read_configuration(_: Any, response: dcon.Configuration, known: Known) -> _Pairs:  # noqa: ANN401
    yield from _configuration(response, known)
    yield "checksum", response.report_settings.checksum


def _name(_: Any, response: dcon.ModuleName, known: Known) -> _Pairs:  # noqa: ANN401
    yield "name", response.name
    yield from _models((model for model in Model if model.factory_name == response.name), known)


def _series(_: Any, response: modbus.ModuleName, known: Known) -> _Pairs:  # noqa: ANN401
    yield from _models((model for model in _SPEAKING if model.modbus_name == response.name), known)


def _models(named: Iterable[Model], known: Known) -> _Pairs:
    """Yield the named models, or only those of them that are known to be possible if there are any."""
    models = tuple(named)
    if models:
        yield "models", tuple(model for model in models if model in known.models) or models


def _version(_: Any, response: dcon.FirmwareVersion, __: Known) -> _Pairs:  # noqa: ANN401
    yield "firmware", Firmware(response.version)


def _bytes_version(_: Any, response: modbus.FirmwareVersion, __: Known) -> _Pairs:  # noqa: ANN401
    version = Firmware.from_bytes(bytes((response.major, response.minor, response.build)))
    if version is not None:
        yield "firmware", version


_Row = Callable[[Any, Any, Known], _Pairs]
_READ: Mapping[type | None, _Row] = {
    dcon.ReadConfiguration: _read_configuration,
    dcon.ReadChannelTypeCode: lambda _, response, known: _channel_type(response.channel, response.type_code, known),
    dcon.ReadModuleName: _name,
    dcon.ReadFirmwareVersion: _version,
    dcon.ReadChannelMask: lambda _, response, __: iter((("mask", response.mask),)),
    dcon.ReadConnectingMode: lambda _, response, __: iter((("single_ended", response.single_ended),)),
    modbus.ReadModuleName: _series,
    modbus.ReadFirmwareVersion: _bytes_version,
    modbus.ReadTypeCode: lambda command, response, known: _channel_type(command.channel, response.type_code, known),
    modbus.ReadChannelMask: lambda _, response, __: iter((("mask", response.mask),)),
}
"""Commands that read settings."""
_SET: Mapping[type | None, _Row] = {
    dcon.SetConfiguration: lambda command, _, known: _configuration(command, known),
    dcon.SetChannelTypeCode: lambda command, _, known: _channel_type(command.channel, command.type_code, known),
    dcon.SetModuleName: lambda command, _, __: iter((("name", command.name),)),
    dcon.SetChannelMask: lambda command, _, __: iter((("mask", command.mask),)),
    dcon.SetConnectingMode: lambda command, _, __: iter((("single_ended", command.single_ended),)),
    modbus.SetTypeCode: lambda command, _, known: _channel_type(command.channel, command.type_code, known),
    modbus.SetChannelMask: lambda command, _, __: iter((("mask", command.mask),)),
}
"""Commands that change settings, from the moment they are accepted."""

# --- registers --------------------------------------------------------------------------------------------------------

_READS = (modbus.ReadCoils, modbus.ReadDiscreteInputs, modbus.ReadHoldingRegisters)
_WRITES = (modbus.WriteSingleCoil, modbus.WriteSingleRegister, modbus.WriteMultipleCoils, modbus.WriteMultipleRegisters)
_ADDRESS = "address"
TEACHING = frozenset((*_READ, *_SET, *_WRITES, *_READS, modbus.SetModuleAddress))
"""The commands whose responses show something."""


def _of_registers(meaning: Meaning, known: Known) -> _Pairs:
    """Yield what the registers show that a read or an accepted write touches.

    Special: of several possible models, what all of them show.
    """
    command: Any = meaning.command
    if not isinstance(command, _READS + _WRITES):
        return
    written = isinstance(command, _WRITES)
    if known.model is not None:
        yield from _of_items(items(command, None, meaning.fit.profiles[0]) if written else meaning.items, known)
    elif known.models:
        message, request = (command, None) if written else (meaning.message, command)
        yield from (pair for pair in _by_profile(message, request, known) if pair[1] is not None)


def _by_profile(message: Any, request: Any, known: Known) -> _Pairs:  # noqa: ANN401
    """Yield what the registers of a message show, whichever profile the module has; None for what depends on it."""
    try:
        profiles = known.modbus
    except EncodeError:  # It does not speak Modbus.
        return
    found = [dict(_of_items(items(message, request, profile), known)) for profile in profiles]
    for name in dict.fromkeys(name for one in found for name in one):
        pair = name, found[0].get(name)
        yield pair if all(pair in one.items() for one in found) else (name, None)


def _of_items(touched: Iterable[Item], known: Known) -> _Pairs:
    """Yield the facts that registers with values show, of one channel after the other."""
    for item in touched:
        for name, value in () if item.fact is None else _of_item(item.channel, *item.fact, known):
            known = evolve(known, types=value) if name == "types" else known
            yield name, value


def _of_item(channel: int | None, name: str, value: Any, known: Known) -> _Pairs:  # noqa: ANN401 - of any row
    if name == "types":
        yield from _types(value) if channel is None else _channel_type(channel, value, known)
    elif name == "series":
        yield from _models((model for model in _SPEAKING if model.series == value), known)
    elif name != _ADDRESS and not (name == "firmware" and isinstance(value, int)):  # a version that is not defined
        yield name, value


@lru_cache(maxsize=_REMEMBERED)
def broadcast_facts(command: Message, known: Known) -> tuple[tuple[str, Any], ...]:
    """Return what a write to all modules sets in one of which this is known; None for what depends on its model."""
    return tuple(_by_profile(command, None, known))


def address_of_all(command: Message, known: Known) -> int | None:
    """Return the address that a write to all modules sets in one of which this is known; None if it sets none."""
    if known.model is None or Protocol.MODBUS_RTU not in known.model.protocols:
        return None
    write: Any = command
    moved = _address_in(items(write, None, known.modbus[0]))
    return moved if moved is not None and 1 <= moved <= LAST_ADDRESS else None


def _address_in(touched: Iterable[Item]) -> int | None:
    """Return the module address among registers with values."""
    return next((item.value for item in touched if item.fact and item.fact[0] == _ADDRESS), None)
