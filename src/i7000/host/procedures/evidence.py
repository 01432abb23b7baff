"""The models that a module can be, narrowed down by what it answers.

Laws: a response rules models out, silence only makes them less likely. Evidence that no candidate agrees with is noted
as a contradiction, and rules nothing out.
"""

from collections.abc import Callable, Collection, Iterable
from typing import Any

from attrs import evolve

from i7000.dissect import Known
from i7000.frozen import frozen
from i7000.host.procedures.identified import Candidate, Unknown, profile_of
from i7000.models import Model
from i7000.type_codes import TypeCode

__all__ = ["Evidence", "by_factory_type", "by_types"]


@frozen
class Evidence:
    """The candidates, the most likely one first, and the reasons for them."""

    candidates: tuple[Candidate, ...]
    reasons: tuple[str, ...] = ()

    @classmethod
    def of(cls, models: Iterable[Model], reason: str) -> "Evidence":
        """Return models that are all equally likely, with the reason for them."""
        return cls(tuple(map(Candidate, models)), (reason,))

    @property
    def models(self) -> tuple[Model, ...]:
        """The models of the candidates, the most likely one first."""
        return tuple(candidate.model for candidate in self.candidates)

    def only(self, models: Collection[Model], reason: str) -> "Evidence":
        """Rule out every candidate that is not one of `models`."""
        left = tuple(candidate for candidate in self.candidates if candidate.model in models)
        if len(left) == len(self.candidates):
            return self
        if not left:
            return evolve(self, reasons=(*self.reasons, f"{reason}, but this contradicts the rest"))
        ruled_out = _names(it.model for it in self.candidates if it not in left)
        return Evidence(left, (*self.reasons, f"{reason}: not {ruled_out}"))

    def doubt(self, models: Collection[Model], reason: str) -> "Evidence":
        """Make `models` less likely, unless they are all that is left."""
        if set(self.models) <= set(models):
            return self
        doubted = [evolve(it, doubts=(*it.doubts, reason)) if it.model in models else it for it in self.candidates]
        return evolve(self, candidates=tuple(sorted(doubted, key=lambda it: len(it.doubts))))

    def alone(self, reason: str) -> "Evidence":
        """Doubt the only candidate that is left; several make each other doubtful already."""
        if len(self.candidates) != 1:
            return self
        return evolve(self, candidates=(evolve(self.candidates[0], doubts=(reason,)),))

    def groups(self, key: Callable[[Model], Any]) -> dict[Any, tuple[Model, ...]]:
        """Return the models by a key, the group of the most likely one first."""
        found: dict[Any, tuple[Model, ...]] = {}
        for model in self.models:
            of_model = key(model)
            found[of_model] = (*found.get(of_model, ()), model)
        return found

    def unknown(self, silent: Unknown | None) -> tuple[Unknown, ...]:
        """Return that the model is unknown, unless there is one candidate; `silent` is a request without an answer."""
        if len(self.candidates) == 1:
            return ()
        reason = f"it can be {_names(self.models)}" if self.candidates else self.reasons[-1]
        return (Unknown("model", reason, None if silent is None else silent.outcome),)

    def known(self, known: Known) -> Known:
        """Add the model, or the models that are left, to what is known."""
        if len(self.models) == 1:
            return evolve(known, model=self.models[0])
        return evolve(known, models=self.models)


def by_types(evidence: Evidence, known: Known) -> Evidence:
    """Keep the models that can have the known types of the channels; a model may have more channels than were read."""
    types = {code for code in known.types or () if code is not None}
    profiles = [profile_of(evolve(known, types=None), model) for model in evidence.models]
    able = [
        profile.model
        for profile in profiles
        if all(map(profile.supports, types)) and (len(types) <= 1 or profile.individually_configurable)
    ]
    return evidence.only(able, f"the types are {_codes(known.types or ())}")


def by_factory_type(evidence: Evidence, known: Known) -> Evidence:
    """Prefer the models that have the known type from the factory."""
    types = set(known.types or ())
    models = [model for model in evidence.models if {model.default_type} == types]
    if not models:
        return evidence
    others = set(evidence.models).difference(models)
    return evidence.doubt(others, f"{_codes(types)} is the factory type of {_names(models)}")


def _codes(types: Iterable[TypeCode | None]) -> str:
    return " ".join(f"{code:02X}" for code in dict.fromkeys(types) if code is not None)


def _names(models: Iterable[Model]) -> str:
    return ", ".join(model.value for model in models)
