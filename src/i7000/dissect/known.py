"""What is known about the modules on a line, each fact with its origin.

A `Known` is what is known of one module; it stands for all profiles that fit. A `Module` is what the caller gave, and
what the traffic showed; `Knowledge` is all modules.

Laws: given beats learned, and learned beats the factory default. A setting that the traffic shows being changed beats
what was given. Facts never make a combination that no module has.
"""

from collections.abc import Iterable, Mapping
from enum import Enum, StrEnum
from functools import cached_property
from itertools import product
from types import MappingProxyType
from typing import Any

from attrs import evolve, field, fields_dict, frozen

from i7000.errors import EncodeError
from i7000.models import Firmware, Model
from i7000.profile import LAST_LEGACY, Profile
from i7000.settings import DataFormat, ModbusDataFormat, Protocol
from i7000.type_codes import TypeCode

__all__ = ["Fact", "Knowledge", "Known", "Module", "Origin", "fact_words"]


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

    @classmethod
    def of(cls, profile: Profile) -> "Known":
        """Return the knowledge that a profile has."""
        return cls(
            profile.model,
            profile.firmware,
            profile.type_codes,
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
        return fresh if self.types is None else self._typed(fresh)

    @cached_property
    def all(self) -> tuple[Profile, ...]:
        """Every profile that fits, of every model if none is known; with types only if they are known.

        Errors: `EncodeError` if there is none.
        """
        found = []
        error = None
        for model, firmware, single_ended in product(
            self._models,
            (self.firmware,) if self.firmware else (None, LAST_LEGACY),
            _either(self.single_ended),
        ):
            try:
                profile = Profile(model, firmware=firmware, single_ended=single_ended, type_codes=())
                if profile.firmware == self.firmware or profile.legacy_sentinels:
                    found.append(self._typed(profile))
            except EncodeError as refused:
                error = error or refused
        if error is not None and not found:
            raise error
        formats = DataFormat if self.data_format is None else (self.data_format,)
        return tuple(
            evolve(profile, data_format=data_format, checksum=checksum)
            for profile, data_format, checksum in product(found, formats, _either(self.checksum))
        )

    @cached_property
    def modbus(self) -> tuple[Profile, ...]:
        """Every profile that fits, of all models that speak Modbus if none is known; without types then.

        Errors: `EncodeError` for a model that does not speak it, or a combination that no module has.
        """
        models = [model for model in self._models if Protocol.MODBUS_RTU in model.protocols]
        if not models:
            raise EncodeError("model", self._models[0].value, "the M-7000 series, which alone speaks Modbus RTU", "3")
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
    def _models(self) -> tuple[Model, ...]:
        return (self.model,) if self.model else self.models or tuple(Model)

    def _typed(self, profile: Profile) -> Profile:
        types = self.types or ()
        if len(types) == 1:
            types *= profile.channels
        if self.partial:
            rest = types[profile.channels :]
            if any(rest):
                raise EncodeError("types", len(types), f"at most {profile.channels}: {profile.name}", "1.3")
            types = (*types, *[None] * profile.channels)[: profile.channels]
            defaults = profile.type_codes
            types = tuple(map(_first, types, defaults)) if defaults else ()
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
    """It is the factory default."""


@frozen
class Fact:
    """A fact about a module."""

    name: str
    """An attribute of `Known`, or ``name``, ``mask``, ``line_settings``, ``protocol``."""
    value: Any
    origin: Origin = Origin.LEARNED
    where: str = ""
    """The frame that showed it, and from which on it holds: ``frame 3``."""
    changed: bool = False
    """Whether the frame accepted a change, so that what was given no longer holds."""


_KNOWN = fields_dict(Known)
_NOTHING: Mapping[Any, Any] = MappingProxyType({})


def _unchanging(mapping: Mapping[Any, Any]) -> Mapping[Any, Any]:
    return MappingProxyType(dict(mapping))


@frozen(eq=False)
class Module:
    """The knowledge of one module: given and learned."""

    given: Known = Known()
    facts: Mapping[str, Fact] = field(factory=dict, converter=_unchanging)
    """What was learned, by the name of the fact."""

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
        """Return whether a property was given."""
        return getattr(self.given, name, None) not in (None, ())

    def learn(self, fact: Fact) -> "Module":
        """Add a fact, unless no module has the combination that it makes: then it is dropped."""
        learned = Module(self.given, {**self.facts, fact.name: fact})
        try:
            _ = learned.known.all, learned.known.default
        except EncodeError:
            return self
        return learned

    def without(self, names: Iterable[str]) -> "Module":
        """Drop facts that were learned."""
        dropped = frozenset(names)
        return Module(self.given, {name: fact for name, fact in self.facts.items() if name not in dropped})


@frozen(eq=False)
class Knowledge:
    """The knowledge of all modules on a line."""

    others: Module = field(factory=Module)
    """The knowledge of every module that is not in `modules`."""
    modules: Mapping[int, Module] = field(factory=dict, converter=_unchanging)
    """Modules by address."""

    @classmethod
    def given(cls, others: Known, by_address: Mapping[int, Known] = _NOTHING) -> "Knowledge":
        """Return knowledge that you give: of the modules at some addresses, and of all others."""
        return cls(Module(others), {address: Module(known) for address, known in by_address.items()})

    def of(self, address: int | None) -> Module:
        """Return the knowledge of the module at an address; None for any address."""
        return self.others if address is None else self.modules.get(address, self.others)

    def put(self, address: int, module: Module) -> "Knowledge":
        """Return knowledge with that of one module replaced."""
        return evolve(self, modules={**self.modules, address: module})


def fact_words(fact: Fact) -> str:
    """Return a fact in words."""
    match fact.name:
        case "types":
            codes = dict.fromkeys(code for code in fact.value if code is not None)
            return "type " + " ".join(f"{code:02X} ({code.name})" for code in codes)
        case "checksum":
            return "with a checksum" if fact.value else "without a checksum"
        case "single_ended":
            return "single-ended" if fact.value else "differential"
        case "models":
            return "an " + " or ".join(model.value for model in fact.value)
    value = fact.value.name.lower() if isinstance(fact.value, Enum) else fact.value
    return f"{fact.name.replace('_', ' ')} {value}"
