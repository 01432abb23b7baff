"""The zoo: each animal is caught by the checks that are named for it, and by few others; without its bug it passes."""

import shlex
import sys
from typing import Any

import pytest
from attrs import evolve

from i7000 import Model, Protocol, spec
from i7000.conformance.hazard import Hazard
from i7000.conformance.oracle import rows_of
from i7000.conformance.statement import Level
from i7000.conformance.verdict import SkipReason, Verdict
from i7000.device import Eeprom, power_on
from tests.conformance.zoo import zoo
from tests.conformance.zoo.animal import Animal
from tests.conformance.zoo.catch import Caught, caught_of, examined
from tests.conformance.zoo.families import HERD
from tests.conformance.zoo.species import settings, signals_of
from tests.conformance.zoo.table import PAGE, page, told
from tests.each import each
from tests.terminal import Run

ANIMALS = zoo()
FAMILIES = HERD.animals
EVERYTHING = tuple(Hazard)
FIRMWARES = ("B4.4", "B4.1", "B3.8", "B3.6", "B3.4", "B3.0", "B2.8", "B2.6", "B2.1", "B1.3")
"""A firmware before each that changed something, newest first."""
FEWEST = 40
BASES = {(it.eeprom, it.allow) for it in ANIMALS.values() if not it.select}
MEASURED = ("frame/", "timing/", "stateful/")
"""The checks that few other tests carry out."""
NOT_THERE = ("line/no-cable-dcon", "line/no-cable-rtu", "line/babbler-dcon", "line/babbler-rtu")


def measured_if(value: object, *, is_measured: bool) -> Any:
    """A parameter whose test counts for the coverage, or does not: to measure it takes five times as long."""
    return pytest.param(value, marks=() if is_measured else pytest.mark.no_cover)


@pytest.mark.parametrize(
    "name",
    [
        measured_if(name, is_measured=bool(it.caught) and it.caught[0].startswith(MEASURED))
        for name, it in ANIMALS.items()
    ],
)
def test_an_animal_fails_the_checks_that_the_page_of_the_zoo_says(name: str) -> None:
    species = ANIMALS[name]
    found = caught_of(species)
    ids = set(found.ids)

    assert set(species.caught) <= ids
    assert len(ids - set(species.caught)) <= species.others
    assert tuple(sorted(ids)) == told()[name]
    assert name not in NOT_THERE or not passed(found)
    assert not unproved(found)


SILENCE = ("answer", "did not end", "not understood", "an empty frame")
"""Words that say that nothing was heard."""


def unproved(found: Caught) -> list[str]:
    """The failures that say something of the module and do not show it: what it answered, or what was written."""
    failures = [it for it in found.results if it.verdict in (Verdict.FAIL, Verdict.WARN)]
    unheard = [it.id for it in failures if not it.received and not any(words in it.text for words in SILENCE)]
    return [*unheard, *(it.id for it in failures if "reads back" in it.text and not it.wrote)]


def passed(found: Caught) -> list[str]:
    return [it.id for it in found.results if it.verdict is Verdict.PASS]


def test_the_page_of_the_zoo_is_up_to_date() -> None:
    assert page(ANIMALS, told()) == PAGE.read_text("utf-8")


def test_there_are_enough_animals_in_both_protocols() -> None:
    protocols = [it.eeprom.protocol for it in ANIMALS.values()]

    assert len(ANIMALS) >= FEWEST
    assert min(protocols.count(protocol) for protocol in Protocol) >= FEWEST / 2


def undone(found: Caught) -> dict[str, tuple[Verdict, str]]:
    """What neither passed, nor is open, nor does not concern the module, nor was not allowed from the first."""
    return {
        it.id: (it.verdict, it.text)
        for it in found.results
        if it.verdict not in (Verdict.PASS, Verdict.INFO)
        and it.reason is not SkipReason.NOT_APPLICABLE
        and not (it.reason is SkipReason.HAZARD and it.text.startswith("not allowed"))
        and it.reason is not SkipReason.BUDGET
    }


@pytest.mark.no_cover
@each("base", sorted(BASES, key=str))
def test_a_module_without_a_bug_passes(base: tuple[Eeprom, tuple[object, ...]]) -> None:
    eeprom, allow = base
    found = examined(Animal(eeprom, signals_of(eeprom)), eeprom, *allow)  # type: ignore[arg-type] # hazards

    assert not undone(found)
    assert found.settled.is_as_before


# --- every check finds something --------------------------------------------------------------------------------------


@pytest.mark.no_cover
def test_every_check_fails_some_firmware() -> None:
    left = {it.id for it in spec.statements().values() if it.level is not Level.OPEN and it.group != "statement"} - {
        id_ for ids in told().values() for id_ in ids
    }
    for family in FAMILIES.values():
        profile = power_on(family.eeprom, now=0.0).profile
        select = sorted(id_ for id_ in left if spec.statements()[id_].applies(profile, family.eeprom.protocol))
        if select:
            left -= set(caught_of(evolve(family, select=tuple(select))).ids)

    assert not left


# --- every model ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "model", [measured_if(model, is_measured=model is Model.M_7019R) for model in Model], ids=lambda model: model.value
)
def test_every_model_passes_with_everything_allowed(model: Model) -> None:
    for protocol in model.protocols:
        eeprom = settings(model, protocol)
        found = examined(Animal(eeprom, signals_of(eeprom)), eeprom, *EVERYTHING)

        assert not undone(found)
        assert found.settled.is_as_before


def kinds_of(model: Model, protocol: Protocol) -> list[Eeprom]:
    """Settings with each older firmware that has other commands, functions or rows."""
    found: dict[object, Eeprom] = {}
    for firmware in (None, *FIRMWARES):
        eeprom = settings(model, protocol, firmware)
        profile = power_on(eeprom, now=0.0).profile
        rows = () if protocol is Protocol.DCON else rows_of(profile)
        found.setdefault((profile.refused, tuple((row.area, row.name, row.count) for row in rows)), eeprom)
    return list(found.values())[1:]


@pytest.mark.no_cover
@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
def test_every_firmware_that_differs_passes(model: Model) -> None:
    for eeprom in [eeprom for protocol in model.protocols for eeprom in kinds_of(model, protocol)]:
        found = examined(Animal(eeprom, signals_of(eeprom)), eeprom)

        assert not undone(found), eeprom.firmware


# --- the command ------------------------------------------------------------------------------------------------------

TARGET = f"exec:{shlex.quote(sys.executable)} -m tests.conformance.zoo "


@each("name", ["dcon/answers-foreign-addresses", "dcon/channel-beyond-the-last"])
def test_a_played_animal_is_caught_by_the_command(run: Run, name: str) -> None:
    ids = ANIMALS[name].caught
    found = run("check", TARGET + name, *ids, "--address", "1", "--protocol", "dcon")

    assert found.code == 1
    assert all(it in found.out for it in ids)


def test_a_module_without_a_bug_passes_the_command(run: Run) -> None:
    found = run("check", TARGET + "clean", "frame", "dcon/2.4/reply", "--address", "1", "--protocol", "dcon")

    assert found.code == 0
