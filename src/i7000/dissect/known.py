"""What is known about the modules on a line, each fact with its origin.

A `Known` is what is known of one module; it stands for all profiles that fit. A `Module` is what the caller gave, and
what the traffic showed; `Knowledge` is all modules.

Laws: given beats learned, and learned beats the factory default. A setting that the traffic shows being changed beats
what was given. Facts never make a combination that no module has.
"""

from collections.abc import Callable, Iterable, Mapping
from enum import StrEnum
from functools import cached_property, lru_cache
from itertools import product
from types import MappingProxyType, NoneType
from typing import Any

from attrs import evolve, field, fields_dict, frozen

from i7000 import describe
from i7000.arguments import as_tuple, check_fields, check_int, check_type
from i7000.errors import ArgumentError, EncodeError, InvalidValueError
from i7000.models import Firmware, Model
from i7000.profile import LAST_LEGACY, Profile
from i7000.settings import DataFormat, ModbusDataFormat, Protocol
from i7000.type_codes import MIXED, TypeCode

__all__ = ["Fact", "Knowledge", "Known", "Module", "Origin", "fact_words", "lacking_type"]


@frozen(cache_hash=True)
class Known:
    """The known properties of a module; None if unknown."""

    model: Model | None = None
    firmware: Firmware | None = None
    types: tuple[TypeCode | None, ...] | None = None
    """One type for all channels, or one for each. None in it, and a missing one at the end, are unknown."""
    data_format: DataFormat | None = None
    checksum: bool | None = None
    single_ended: bool | None = None
    modbus_data_format: ModbusDataFormat | None = None
    models: tuple[Model, ...] = ()
    """The models that it can be, where `model` is None; all if there are none."""

    def __attrs_post_init__(self) -> None:
        check_fields(self, _KINDS)
        if self.types is not None and not (self.types and {TypeCode, NoneType}.issuperset(map(type, self.types))):
            raise InvalidValueError("types", self.types, "members of TypeCode, or None, at least one", "1.11")
        if not {Model}.issuperset(map(type, self.models)):
            raise InvalidValueError("models", self.models, "members of Model", "")

    @classmethod
    def of(cls, profile: Profile) -> "Known":
        """Return everything that a profile says.

        Errors: `InvalidValueError` for what is not a profile.
        """
        if not isinstance(profile, Profile):
            raise InvalidValueError("profile", profile, "an instance of Profile", "")
        return cls(
            profile.model,
            profile.firmware,
            profile.type_codes or None,
            profile.data_format,
            profile.checksum,
            profile.single_ended,
            profile.modbus_data_format,
        )

    @property
    def partial(self) -> bool:
        """Whether only some channels have a known type."""
        return self.types is not None and None in self.types

    @cached_property
    def default(self) -> Profile | None:
        """The profile of a known model, with the factory defaults for what is unknown.

        Errors: `EncodeError` for a combination that no module has.
        """
        if self.model is None:
            return None
        fresh = Profile(
            self.model,
            firmware=self.firmware,
            data_format=self.data_format or DataFormat.ENGINEERING,
            checksum=bool(self.checksum),
            single_ended=bool(self.single_ended),
        )
        return fresh if self.types is None else _typed(self.types, fresh)

    @property
    def all(self) -> tuple[Profile, ...]:
        """Every profile that fits, of every model if none is known; with types only if they are known.

        Errors: `EncodeError` if there is none.
        """
        return _all(self)

    @property
    def modbus(self) -> tuple[Profile, ...]:
        """Every profile that fits, of all models that speak Modbus if none is known; without types then.

        Errors: `EncodeError` for a model that does not speak it, or a combination that no module has.
        """
        models = [model for model in self.possible_models if Protocol.MODBUS_RTU in model.protocols]
        if not models:
            raise EncodeError(
                "model", self.possible_models[0].value, "the M-7000 series, which alone speaks Modbus RTU", "3"
            )
        found = []
        error = None
        for model, single_ended in product(models, _either(self.single_ended)):
            try:
                profile: Any = evolve(self, model=model, single_ended=single_ended).default
            except EncodeError as refused:
                error = error or refused
                continue
            found.append(evolve(profile, modbus_data_format=self.modbus_data_format or ModbusDataFormat.HEX))
        if error is not None and not found:
            raise error
        return tuple(found)

    @property
    def possible_models(self) -> tuple[Model, ...]:
        """The models that it can be."""
        return (self.model,) if self.model else self.models or tuple(Model)


_KINDS: dict[str, tuple[type, ...]] = {
    "model": (Model, NoneType),
    "firmware": (Firmware, NoneType),
    "types": (tuple, NoneType),
    "data_format": (DataFormat, NoneType),
    "checksum": (bool, NoneType),
    "single_ended": (bool, NoneType),
    "modbus_data_format": (ModbusDataFormat, NoneType),
    "models": (tuple,),
}
"""What each field of `Known` can be."""
_REMEMBERED = 64
"""Combinations of what is known of which the profiles are kept: of an unknown module they are hundreds."""


@lru_cache(maxsize=_REMEMBERED)
def _all(known: Known) -> tuple[Profile, ...]:
    found = []
    error = None
    for model, firmware, single_ended in product(
        known.possible_models,
        (known.firmware,) if known.firmware else (None, LAST_LEGACY),
        _either(known.single_ended),
    ):
        try:
            profile = Profile(model, firmware=firmware, single_ended=single_ended, type_codes=())
            if profile.firmware == known.firmware or profile.legacy_sentinels:
                found.append(_typed(known.types, profile))
        except EncodeError as refused:
            error = error or refused
    if error is not None and not found:
        raise error
    formats = DataFormat if known.data_format is None else (known.data_format,)
    return tuple(
        evolve(profile, data_format=data_format, checksum=checksum)
        for profile, data_format, checksum in product(found, formats, _either(known.checksum))
    )


def _typed(known: tuple[TypeCode | None, ...] | None, profile: Profile) -> Profile:
    """Return a profile with the types that are known, and defaults for the others if there are any."""
    types = known or ()
    if len(types) == 1:
        types *= profile.channels
    if None in types:
        if any(code is not None for code in types[profile.channels :]):
            raise EncodeError("types", len(types), f"at most {profile.channels}: {profile.name}", "1.3")
        for code in types:
            if code is not None:
                profile.check_type_code(code, "1.3", field="types")
        types = (*types, *[None] * profile.channels)[: profile.channels]
        types = tuple(map(_first, types, profile.type_codes))
    return evolve(profile, type_codes=types)  # type: ignore[arg-type] # There is no None in it now.


def _first(known: TypeCode | None, default: TypeCode) -> TypeCode:
    return default if known is None else known


def _either(known: bool | None) -> tuple[bool, ...]:  # noqa: FBT001 - it is the value
    return (False, True) if known is None else (known,)


# --- facts ------------------------------------------------------------------------------------------------------------


class Origin(StrEnum):
    """The origin of a fact."""

    GIVEN = "given"
    """The caller said so."""
    LEARNED = "learned"
    """The traffic showed it."""
    ASSUMED = "assumed"
    """Nothing shows it: it is the factory default, or what a broadcast set, which no module confirms (E94)."""


@frozen
class Fact:
    """A fact about a module."""

    name: str
    """An attribute of `Known`, or ``name``, ``mask``, ``line_settings``."""
    value: Any
    origin: Origin = Origin.LEARNED
    where: str = ""
    """The frame that showed it, and from which on it holds: ``frame 3``."""
    changed: bool = False
    """Whether the frame accepted a change, so that what was given no longer holds."""
    doubted_by: str = ""
    """The kind of the response that contradicted it, if none of this kind has fitted since: ``AnalogInputs``."""

    def __attrs_post_init__(self) -> None:
        check_fields(self, _FACT_KINDS)
        try:
            hash(self.value)
        except TypeError:
            raise InvalidValueError("value", self.value, "what can be hashed", "") from None


_FACT_KINDS: dict[str, tuple[type, ...]] = {
    "name": (str,), "origin": (Origin,), "where": (str,), "changed": (bool,), "doubted_by": (str,),
}  # fmt: skip
_KNOWN = fields_dict(Known)
_NOTHING: Mapping[Any, Any] = MappingProxyType({})


def _unchanging(mapping: Mapping[Any, Any]) -> Mapping[Any, Any]:
    """Return a copy that does not change; what is not a mapping is refused later."""
    return MappingProxyType(dict(mapping)) if isinstance(mapping, Mapping) else mapping


@frozen(eq=False)
class Module:
    """What is known of one module; it is compared by identity, as what was read with it is remembered.

    Errors: `EncodeError` for a combination that no module has, `InvalidValueError` for fields of other types.
    """

    given: Known = Known()
    facts: Mapping[str, Fact] = field(factory=dict, converter=_unchanging)
    """What was learned, by the name of the fact."""

    def __attrs_post_init__(self) -> None:
        check_fields(self, {"given": (Known,), "facts": (Mapping,)})
        for name, fact in self.facts.items():
            if not isinstance(fact, Fact) or fact.name != name:
                raise InvalidValueError("facts", fact, "facts by their names", "")
        _ = self.known.all, self.known.default

    @cached_property
    def known(self) -> Known:
        """Given and learned facts together."""
        learned = {fact.name: fact.value for fact in self.learned}
        if "model" in learned or self.given.model:
            learned.pop("models", None)
        return evolve(self.given, **learned) if learned else self.given

    @property
    def learned(self) -> tuple[Fact, ...]:
        """The learned facts that say how frames are read, and are not given."""
        return tuple(
            fact for fact in self.facts.values() if fact.name in _KNOWN and (fact.changed or not self.gives(fact.name))
        )

    def gives(self, name: str) -> bool:
        """Return whether the caller knows something: an attribute of `Known`."""
        check_type("name", name, str)
        return name in _KNOWN and getattr(self.given, name) not in (None, ())

    def learn(self, fact: Fact) -> "Module":
        """Add a fact, unless no module has the combination that it makes: then it is dropped."""
        check_type("fact", fact, Fact)
        try:
            return Module(self.given, {**self.facts, fact.name: fact})
        except EncodeError:
            return self

    @cached_property
    def in_doubt(self) -> bool:
        """Whether a response contradicted a learned fact, which still holds."""
        return any(fact.doubted_by for fact in self.facts.values())

    def without(self, names: Iterable[str]) -> "Module":
        """Drop facts that were learned, and types that cannot be without them."""
        dropped = as_tuple("names", names)
        facts = {name: fact for name, fact in self.facts.items() if name not in dropped}
        try:
            return Module(self.given, facts)
        except EncodeError:  # The types are of more channels than the module then has.
            return Module(self.given, {name: fact for name, fact in facts.items() if name != "types"})


@frozen(eq=False)
class Knowledge:
    """What is known of all modules on a line.

    Errors: `InvalidValueError` for fields of other types, and for addresses beyond 00..FF.
    """

    others: Module = field(factory=Module)
    """The knowledge of every module that is not in `modules`."""
    modules: Mapping[int, Module] = field(factory=dict, converter=_unchanging)
    """Modules by address."""

    def __attrs_post_init__(self) -> None:
        check_fields(self, {"others": (Module,), "modules": (Mapping,)})
        for address, module in self.modules.items():
            if not isinstance(address, int) or isinstance(address, bool) or not 0 <= address <= 0xFF:
                raise InvalidValueError("address", address, "00..FF", "")
            if not isinstance(module, Module):
                raise InvalidValueError("module", module, "an instance of Module", "")

    @classmethod
    def given(cls, others: Known, by_address: Mapping[int, Known] = _NOTHING) -> "Knowledge":
        """Return what the caller knows: of the modules at some addresses, and of those at any other.

        Errors: `EncodeError` for a combination that no module has.
        """
        check_type("others", others, Known)
        check_type("by_address", by_address, Mapping)
        return cls(Module(others), {address: Module(known) for address, known in by_address.items()})

    def of(self, address: int | None) -> Module:
        """Return what is known of the module at an address; None: of any."""
        if address is None:
            return self.others
        try:
            return self.modules.get(address, self.others)
        except TypeError:
            raise ArgumentError("address", address, "int or None") from None

    def put(self, address: int, module: Module) -> "Knowledge":
        """Replace what is known of the module at an address."""
        check_int("address", address)
        check_type("module", module, Module)
        return Knowledge(self.others, {**self.modules, address: module})

    def move(self, address: int, new_address: int) -> "Knowledge":
        """Take what is known of a module to its new address; of another one at the old address nothing is known."""
        check_int("address", address)
        check_int("new_address", new_address)
        kept = {at: module for at, module in self.modules.items() if at != address}
        return Knowledge(self.others, {**kept, new_address: self.of(address)})


def lacking_type(known: Known, code: int | None) -> str | None:
    """Return a note that a module cannot have a type; None if it can, or if its model is unknown.

    >>> lacking_type(Known(Model.I_7018), 0x08)
    'an I-7018 has no type 08, -10..10 V'
    """
    models = (known.model,) if known.model else known.models
    if code in (None, MIXED) or not models or any(profile.supports(code) for profile in known.all):
        return None
    return f"{fact_words(Fact('models', models))} has no type {describe.type_code(code)}"


def fact_words(fact: Fact) -> str:
    """Return a fact in words."""
    if fact.name in _WORDS:
        return _WORDS[fact.name](fact.value)
    return f"{fact.name.replace('_', ' ')} {describe.value(fact.value)}"


def _type_words(types: Iterable[TypeCode | None]) -> str:
    return "type " + " ".join(f"{code:02X} ({code.name})" for code in dict.fromkeys(types) if code is not None)


_WORDS: Mapping[str, Callable[[Any], str]] = {
    "types": _type_words,
    "checksum": lambda value: "with a checksum" if value else "without a checksum",
    "single_ended": lambda value: "single-ended" if value else "differential",
    "model": lambda value: f"an {value.value}",
    "models": lambda value: "an " + " or ".join(model.value for model in value),
    "line_settings": lambda value: f"line settings {describe.line_settings(value)}",
    "mask": lambda value: f"mask {describe.mask(value)}",
}
"""Facts whose name and value alone would not be words."""
