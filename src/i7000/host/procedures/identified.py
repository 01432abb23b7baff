"""What is learned about a module by asking it: its identity, the models that it can be, and what was not learned.

Laws: only a response rules a model out. Silence, which a line fault can cause too, makes a model less likely.
"""

from typing import Any, cast

from attrs import evolve, field

from i7000.availability import Availability
from i7000.dissect import Known
from i7000.errors import EncodeError
from i7000.frozen import frozen
from i7000.host.events import Ended
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import LineSettings, ModbusDataFormat, Protocol

__all__ = ["Candidate", "Identified", "Unknown"]


@frozen
class Candidate:
    """A model that a module can be, and the `doubts`: what makes another model more likely, or this one unsure."""

    model: Model
    doubts: tuple[str, ...] = ()


@frozen
class Unknown:
    """A property that was not learned.

    Shape: `name` is a field of `i7000.dissect.Known`, or ``protocol`` or ``name``; `reason` says in words why it was
        not learned; `outcome` is the outcome that prevented it, or None if no request reads it.
    """

    name: str
    reason: str
    outcome: Ended | None = None


@frozen
class Identified:
    """The identity of the module at an address, as far as it was learned.

    Shape: `known` has the learned facts. `candidates` has the models that it can be, the most likely one first. It is
        empty if nothing answered, or if the module is another product. `reasons` has the evidence for the candidates.
        `unknown` has what was not learned.
    """

    address: int
    protocol: Protocol | None = None
    """The protocol in which the module answered; None if nothing did."""
    name: str | None = field(default=None, kw_only=True)
    """The name as sent: by DCON, the answer to ``$AAM``; by Modbus, the name of the series as 8 hex digits."""
    version: str | None = field(default=None, kw_only=True)
    """The firmware version as sent; by Modbus, as 6 hex digits."""
    known: Known = field(factory=Known, kw_only=True)
    line_settings: LineSettings | None = field(default=None, kw_only=True)
    """The stored line settings, in use from the next power-on."""
    stored_address: int | None = field(default=None, kw_only=True)
    """The stored address, if it is not the one that answered: the module is in INIT mode."""
    candidates: tuple[Candidate, ...] = field(default=(), kw_only=True)
    reasons: tuple[str, ...] = field(default=(), kw_only=True)
    unknown: tuple[Unknown, ...] = field(default=(), kw_only=True)

    @property
    def model(self) -> Model | None:
        """The most likely model; None if there are no candidates."""
        return self.candidates[0].model if self.candidates else None

    @property
    def profile(self) -> Profile | None:
        """The profile of the most likely model; None if there are no candidates.

        Special: what is in `unknown` has its default there, but types that were not learned are left out.
        """
        return None if self.model is None else profile_of(self.known, self.model)


def profile_of(known: Known, model: Model) -> Profile:
    """Return the profile of a model with what is known of it, without types unless all of them are known and fit."""
    single_ended = bool(known.single_ended) and model in Availability.SERIES_7017Z.gates
    plain = evolve(known, model=model, models=(), types=None, single_ended=single_ended)
    profile: Any = plain.default
    profile = evolve(profile, type_codes=())
    if Protocol.MODBUS_RTU in model.protocols:
        profile = evolve(profile, modbus_data_format=known.modbus_data_format or ModbusDataFormat.HEX)
    if known.types is None or known.partial:
        return cast(Profile, profile)
    try:
        typed: Any = evolve(plain, types=known.types).default
    except EncodeError:
        return cast(Profile, profile)
    return cast(Profile, evolve(profile, type_codes=typed.type_codes))
