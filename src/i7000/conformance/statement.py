"""The statements of ``spec/checks``: what is required, of which modules, and how dangerous it is to test."""

from collections.abc import Iterable, Mapping
from enum import Enum
from functools import cache
from types import MappingProxyType
from typing import Any

from attrs import evolve

from i7000 import dcon, modbus
from i7000.conformance.hazard import Hazard
from i7000.frozen import frozen
from i7000.host.procedures.values import PROTOCOLS
from i7000.message import Message
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import Protocol

__all__ = ["GROUPS", "Level", "Statement", "read_statements"]

GROUPS = ("link", "frame", "dcon", "values", "consistency", "rtu", "map", "timing", "stateful", "init", "statement")
"""The groups in the order of a run: the files of ``spec/checks`` and the modules of `i7000.conformance.checks`."""


class Level(Enum):
    """How firmly the manual states a requirement."""

    MUST = "must"
    """The manual says it."""
    EXAMPLE = "example"
    """Only an example shows it."""
    INFERRED = "inferred"
    """It follows from what the manual says."""
    OPEN = "open"
    """The manual contradicts itself or is silent: a module that differs is not at fault."""


@frozen
class Statement:
    """One requirement, which one check tests.

    Shape: `hazards` are the classes of what the check sends beside plain reads. `command`, `function` and `register`
        name what the module must have, as in ``spec/tables`` (a register as ``AREA/NAME``); `models` are those that the
        statement is about. None means that nothing more is needed. `needs` are checks that must have passed before.
    """

    id: str
    title: str
    requirement: str
    sections: tuple[str, ...]
    level: Level
    hazards: frozenset[Hazard]
    protocol: Protocol | None
    """The protocol; None for both."""
    command: str | None
    function: str | None
    register: str | None
    models: tuple[Model, ...] | None
    needs: tuple[str, ...]
    errata: tuple[str, ...]

    @property
    def group(self) -> str:
        """The first part of the id: the name of the file and of the module with the steps."""
        return self.id.partition("/")[0]

    @property
    def positive(self) -> str | None:
        """The id of the check of what the module should do, if this one tests that it does not do more."""
        base, mark, _ = self.id.rpartition("-n")
        return base if mark and self.id[len(base) + 2 :].isdecimal() else None

    def applies(self, profile: Profile, protocol: Protocol) -> bool:
        """Return whether the module of a profile has what is tested; the tables say so."""
        if self.protocol not in (None, protocol) or (self.models is not None and profile.model not in self.models):
            return False
        if self.command is not None and not _has(getattr(dcon, self.command), profile):
            return False
        if self.function is not None and not _has(getattr(modbus, self.function), profile):
            return False
        return self.register is None or self.register in _rows(evolve(profile, type_codes=()))


def _has(message: type[Message], profile: Profile) -> bool:
    return message.availability not in profile.refused


@cache
def _rows(profile: Profile) -> frozenset[str]:
    """Return the rows of the address map of a module, as ``AREA/NAME``."""
    return frozenset(f"{row.area.name.lower()}/{row.name}" for row in modbus.RegisterMap(profile))


_HAZARDS = {hazard.value: hazard for hazard in Hazard}
_MODELS = {model.value: model for model in Model}


def _statement(row: Mapping[str, Any]) -> Statement:
    models, protocol = row["models"], row["protocol"]
    return Statement(
        row["id"],
        row["title"],
        row["requirement"],
        tuple(row["sections"]),
        Level(row["level"]),
        frozenset(_HAZARDS[name] for name in row["hazards"]),
        None if protocol is None else PROTOCOLS[protocol],
        row["command"],
        row["function"],
        row["register"],
        None if models is None else tuple(_MODELS[name] for name in models),
        tuple(row["needs"]),
        tuple(row["errata"]),
    )


def read_statements(documents: Iterable[Mapping[str, Any]]) -> Mapping[str, Statement]:
    """Return the statements in the files of ``spec/checks`` by their ids, in the order of the files and rows.

    Special: `i7000.spec.statements` reads the files.
    """
    found = [_statement(row) for document in documents for row in document["rows"]]
    return MappingProxyType({statement.id: statement for statement in found})
