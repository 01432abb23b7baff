"""The facts that an exchange shows about a module: a setting that was read, or a change that was accepted.

One row a command: the facts, from the command and its response.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any

from attrs import evolve, fields

from i7000 import dcon, modbus
from i7000.dissect.known import Fact, Knowledge, Known, Module, fact_words, lacking_type
from i7000.dissect.meaning import Item, Meaning
from i7000.dissect.registers import items
from i7000.modbus.request import LAST_ADDRESS
from i7000.models import Firmware, Model
from i7000.settings import DataFormat, ModbusDataFormat, Protocol
from i7000.type_codes import TypeCode

__all__ = ["learn", "teaches", "with_facts"]


_REMEMBERED = 256
"""Answers of which it is kept whether they show something new."""


def learn(
    knowledge: Knowledge, address: int, meaning: Meaning, where: str, shown: tuple[str, ...] = ()
) -> tuple[Knowledge, tuple[str, ...]]:
    """Learn from a response of the module at an address; and return what of it contradicts what was known before.

    Shape: `where` it stands; `shown`, the facts that its form alone shows.
    """
    if not shown and type(meaning.command) not in _TEACHING:
        return knowledge, ()
    module = knowledge.of(address)
    moved = _new_address(meaning)
    if moved in (None, address) and not _has_news(meaning, module, shown):
        return knowledge, ()
    learned, wrong = _learned(module, _all_facts(meaning, module, shown, where))
    if learned is not module:
        knowledge = knowledge.put(address, learned)
    if moved not in (None, address):
        knowledge = knowledge.move(address, moved)
    return knowledge, tuple(wrong)


def _learned(module: Module, facts: Iterable[Fact]) -> tuple[Module, list[str]]:
    """Return a module with these facts, and what of them contradicts what was known."""
    learned, wrong = module, []
    for fact in facts:
        before = module.facts.get(fact.name)
        contradiction = _contradiction(module, before, fact)
        if contradiction:
            wrong.append(contradiction)
            if fact.name == "name" and before is not None:
                learned = Module(module.given)  # Another module has taken the place of the old one.
        if _is_new(before, fact):
            if before is not None and before.changed:
                fact = evolve(fact, changed=True)  # noqa: PLW2901 - what was given does not come back
            after = learned.learn(fact)
            if after is learned:
                wrong.append(_impossible(learned, fact))
            learned = after
    return learned, wrong


@lru_cache(maxsize=_REMEMBERED)
def _has_news(meaning: Meaning, module: Module, shown: tuple[str, ...]) -> bool:
    """Return whether a response shows anything that is new, or contradicts what is known."""
    for fact in _all_facts(meaning, module, shown, ""):
        before = module.facts.get(fact.name)
        if _is_new(before, fact) or _contradiction(module, before, fact):
            return True
    return False


def _all_facts(meaning: Meaning, module: Module, shown: tuple[str, ...], where: str) -> Iterator[Fact]:
    """Yield what a response shows, by its fields or by its form."""
    facts = {fact.name: fact for fact in _facts_of(meaning, module.known, where)}
    profile = meaning.fit.profiles[0]
    facts |= {name: Fact(name, getattr(profile, name), where=where) for name in shown}
    name = module.facts.get("name")
    if name is not None and name.changed:
        facts.pop("models", None)  # A name that was set does not show the model.
    yield from facts.values()


def _is_new(before: Fact | None, fact: Fact) -> bool:
    """Return whether a fact adds anything: a change is one once only."""
    return before is None or before.value != fact.value or fact.changed > before.changed


_NAMING = ("name", "firmware", "models")
"""Facts that no setting changes, or hardly ever."""


def _contradiction(module: Module, before: Fact | None, fact: Fact) -> str | None:
    """Return what a response contradicts; an accepted change contradicts nothing."""
    if fact.changed:
        return None
    model = module.given.model
    if fact.name == "models" and model is not None:
        return None if model in fact.value else f"{fact_words(fact)} by its name, but an {model.value} was given"
    if module.gives(fact.name) and not (before is not None and before.changed):
        given = evolve(fact, value=getattr(module.given, fact.name))
        return None if _agree(given, fact) else f"{fact_words(fact)}, but {fact_words(given)} was given"
    if before is None or before.value is None or _agree(before, fact):
        return None
    other = "; two modules on one address?" if fact.name in _NAMING else ""
    return f"{fact_words(fact)}, but {before.where} said {fact_words(before)}{other}"


def _agree(one: Fact, other: Fact) -> bool:
    """Return whether two facts of one name can both be true: of types, where both are known."""
    if one.name == "models":
        return not set(one.value).isdisjoint(other.value)
    if one.name != "types":
        return bool(one.value == other.value)
    if 1 in (len(one.value), len(other.value)):  # The type of all channels.
        known, others = set(one.value) - {None}, set(other.value) - {None}
        return known == others or not known or not others
    return all(None in pair or pair[0] == pair[1] for pair in zip(one.value, other.value, strict=False))


def _impossible(module: Module, fact: Fact) -> str:
    """Return a note that no module has what was shown together with what is known."""
    known = module.known
    lacking = fact.name == "types" and next(filter(None, (lacking_type(known, code) for code in fact.value)), None)
    if lacking:
        return f"{lacking}; another model?"
    others = (Fact(it.name, getattr(known, it.name)) for it in fields(Known) if it.name != fact.name)
    words = " and ".join(fact_words(other) for other in others if other.value not in (None, ()))
    return f"{fact_words(fact)} does not go with {words}"


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
    changed = isinstance(command, _WRITES)
    for item in _sent(meaning) if changed else meaning.items:
        for name, value in _of_item(item, known):
            known = evolve(known, types=value) if name == "types" else known  # of one channel after the other
            yield Fact(name, value, where=where, changed=changed)


def _new_address(meaning: Meaning) -> int | None:
    """Return the address that the module has from this response on, if the command changed it."""
    command, response = meaning.command, meaning.message
    done = isinstance(response, dcon.Acknowledged) or getattr(response, "result", 1) == 0
    if done and isinstance(command, dcon.SetConfiguration):
        return command.new_address
    moved: int | None = None
    if done and isinstance(command, modbus.SetModuleAddress):
        moved = command.new_address
    elif isinstance(command, _WRITES) and not isinstance(response, modbus.ExceptionResponse):
        moved = next((item.value for item in _sent(meaning) if item.name == "module_address"), None)
    return moved if moved is not None and 1 <= moved <= LAST_ADDRESS else None


# --- DCON, and function 46h -------------------------------------------------------------------------------------------


_MIXED = 2
"""Types that there are at least where each channel has its own."""


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
    speaking = (model for model in Model if Protocol.MODBUS_RTU in model.protocols)
    yield from _models((model for model in speaking if model.modbus_name == response.name), known)


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

_AREAS_READ = (
    modbus.ReadCoils, modbus.ReadDiscreteInputs, modbus.ReadHoldingRegisters, modbus.SetModuleAddress,
)  # fmt: skip
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
_TEACHING = frozenset((*_READ, *_SET, *_WRITES, *_AREAS_READ))
"""The commands whose responses show something."""


def teaches(command: object) -> bool:
    """Return whether the response to a command can show a setting."""
    return type(command) in _TEACHING
