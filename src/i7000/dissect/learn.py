"""The facts that an exchange shows about a module: a setting that was read, or a change that was accepted.

One row a command: the facts, from the command and its response.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from attrs import evolve

from i7000 import dcon, modbus
from i7000.dissect.heard import Line
from i7000.dissect.known import Fact, Known, Module, fact_words
from i7000.dissect.meaning import Item, Meaning
from i7000.dissect.registers import items
from i7000.models import Firmware, Model
from i7000.settings import DataFormat, ModbusDataFormat, Protocol
from i7000.type_codes import TypeCode

__all__ = ["learn", "with_facts"]


def learn(
    line: Line, address: int, meaning: Meaning, where: str, shown: tuple[str, ...] = ()
) -> tuple[Line, tuple[str, ...]]:
    """Return the knowledge after a response, and what in it contradicts earlier knowledge."""
    module = line.knowledge.of(address)
    facts = list(_facts_of(meaning, module.known, where)) if meaning.command is not None else []
    profile = meaning.fit.profiles[0]
    facts += [Fact(name, getattr(profile, name), where=where) for name in shown if name != "firmware"]
    learned, wrong = module, []
    for fact in facts:
        before = module.facts.get(fact.name)
        if before is not None and before.value == fact.value:
            continue
        contradiction = _contradiction(module, before, fact)
        if contradiction:
            wrong.append(contradiction)
        learned = learned.learn(fact)
    if learned is not module:
        line = evolve(line, knowledge=line.knowledge.put(address, learned))
    moved = _new_address(meaning) if meaning.command is not None else None
    if moved is not None and moved != address:
        line = evolve(line, knowledge=line.knowledge.put(moved, line.knowledge.of(address)))
    return line, tuple(wrong)


def _contradiction(module: Module, before: Fact | None, fact: Fact) -> str | None:
    """Return what a response contradicts; an accepted change contradicts nothing."""
    if fact.changed:
        return None
    given = getattr(module.given, fact.name, None)
    if module.gives(fact.name) and not (before is not None and before.changed):
        if _agree(given, fact.value):
            return None
        return f"{fact_words(fact)}, but {fact_words(evolve(fact, value=given))} was given"
    if before is None or _agree(before.value, fact.value):
        return None
    other = "; two modules on one address?" if fact.name in ("name", "firmware", "models") else ""
    return f"{fact_words(fact)}, but {before.where} said {fact_words(before)}{other}"


def _agree(known: Any, value: Any) -> bool:  # noqa: ANN401 - of any fact
    """Return whether two values can both be true: of types, where both are known."""
    if not isinstance(known, tuple) or not isinstance(value, tuple):
        return bool(known == value)
    if len(known) == 1 or len(value) == 1:
        ones, others = set(known) - {None}, set(value) - {None}
        return ones == others or not ones or not others
    return all(one is None or other is None or one == other for one, other in zip(known, value, strict=False))


def with_facts(meaning: Meaning, module: Module) -> Meaning:
    """Return a meaning whose facts name the frame that showed them."""
    learned = {fact.name: fact for fact in module.learned}
    facts = tuple(learned.get(fact.name, fact) for fact in meaning.facts)
    return meaning if facts == meaning.facts else evolve(meaning, facts=facts)


# --- facts of an exchange ---------------------------------------------------------------------------------------------

_Pairs = Iterator[tuple[str, Any]]


def _facts_of(meaning: Meaning, known: Known, where: str) -> Iterator[Fact]:
    """Yield the facts that a response shows together with its command; `where` is its place."""
    command, response = meaning.command, meaning.message
    if isinstance(response, dcon.Refused | modbus.ExceptionResponse):
        return
    for rows, changed in ((_READ, False), (_SET, True)):
        row = rows.get(type(command))
        if row is not None and not getattr(response, "result", 0):
            yield from (
                Fact(name, value, where=where, changed=changed) for name, value in row(command, response, known)
            )
    if isinstance(command, dcon.SetConfiguration) and meaning.checksum is not None:
        yield Fact("checksum", meaning.checksum, where=where, changed=True)
    changed = isinstance(command, _WRITES)
    for item in _sent(meaning) if changed else meaning.items:
        yield from (Fact(name, value, where=where, changed=changed) for name, value in _of_item(item, known))


def _new_address(meaning: Meaning) -> int | None:
    """Return the address that the module has from this response on, if the command changed it."""
    command, response = meaning.command, meaning.message
    done = isinstance(response, dcon.Acknowledged) or getattr(response, "result", 1) == 0
    if done and isinstance(command, dcon.SetConfiguration | modbus.SetModuleAddress):
        return command.new_address
    if isinstance(command, _WRITES) and not isinstance(response, modbus.ExceptionResponse):
        return next((item.value for item in _sent(meaning) if item.name == "module_address"), None)
    return None


# --- DCON, and function 46h -------------------------------------------------------------------------------------------


def _types(code: TypeCode | int) -> _Pairs:
    """The type of all channels, if it is one."""
    if isinstance(code, TypeCode):
        yield "types", (code,)


def _channel_type(channel: int, code: TypeCode | int, known: Known) -> _Pairs:
    if not isinstance(code, TypeCode):
        return
    types = known.types or ()
    if len(types) == 1:
        types *= channel + 1
    others = {at: it for at, it in enumerate(types) if it is not None} | {channel: code}
    full = known.types is not None and len(types) > 1 and None not in types and channel < len(types)
    last = len(types) if full else max(others) + 2
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


def _name(_: Any, response: dcon.ModuleName, __: Known) -> _Pairs:  # noqa: ANN401
    yield "name", response.name
    models = tuple(model for model in Model if model.factory_name == response.name)
    if models:
        yield "models", models


def _series(_: Any, response: modbus.ModuleName, __: Known) -> _Pairs:  # noqa: ANN401
    models = tuple(it for it in Model if it.modbus_name == response.name and Protocol.MODBUS_RTU in it.protocols)
    if models:
        yield "models", models


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

_WRITES = (modbus.WriteSingleCoil, modbus.WriteSingleRegister, modbus.WriteMultipleCoils, modbus.WriteMultipleRegisters)


def _sent(meaning: Meaning) -> tuple[Item, ...]:
    """Return the items of a write with the values that were written."""
    command: Any = meaning.command
    return tuple(items(command, None, meaning.fit.profiles[0]))


def _of_item(item: Item, known: Known) -> _Pairs:
    """Yield the facts that a register with a value shows."""
    if item.value is None or item.name not in _REGISTERS or known.model is None:
        return
    yield from _REGISTERS[item.name](item, known)


_REGISTERS: Mapping[str | None, Callable[[Item, Known], _Pairs]] = {
    "type_code": lambda item, known: _channel_type(item.channel or 0, TypeCode.of(item.value), known),
    "module_type_code": lambda item, _: _types(TypeCode.of(item.value)),
    "modbus_data_format": lambda item, _: iter((("modbus_data_format", ModbusDataFormat(int(item.value))),)),
    "firmware_version": lambda item, _: iter(
        (("firmware", Firmware(item.value)),) if isinstance(item.value, str) else ()
    ),
    "single_ended": lambda item, _: iter((("single_ended", bool(item.value)),)),
    "channel_mask": lambda item, _: iter((("mask", item.value),)),
}
"""The registers that decide how others, and frames, are read."""
