"""The errata of the table of models: which models each is about, by its own words or by what the code knows."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from i7000 import Model, TypeCode
from tests.spec import lint
from tests.spec.cells import Cell, wrong

if TYPE_CHECKING:
    from collections.abc import Callable

ROWS = {row["name"]: row for row in lint.rows("models")}
RULES: dict[str, Callable[[Model], object]] = {
    "E39": lambda model: TypeCode.L_DIN43710 in model.type_codes,
    "E42": lambda model: model is Model.M_7017RMS,
    "E43": lambda model: model.fast_mode and not model.fast_mode_default,
    "E44": lambda model: model.character_formats_from,
    "E81": lambda model: not model.type_by_configuration,
    "E95": lambda model: model.fast_mode_default,
    "E96": lambda model: model.fast_mode,
}
"""The errata about a feature, and who has it."""
NAMED = {
    "E12": {"M-7018-16"},
    "E13": {"M-7019Z"},
    "E34": {"I-7017Z", "M-7017Z", "M-7017RMS", "M-7017mC-16", "I-7018Z", "M-7018Z"},
    "E35": {"I-7018BL"},
    "E36": {"M-7017", "I-7019R", "M-7019R"},
    "E37": {"I-7017FC", "I-7017Z", "M-7017Z", "M-7018-16", "I-7018BL"},
    "E38": {"I-7018R", "M-7018R"},
    "E40": {"M-7019Z"},
    "E41": {"I-7017", "I-7017F", "I-7017R", "M-7017", "M-7017R"},
    "E67": {"M-7018R"},
    "E68": {"M-7018R"},
    "E69": {"I-7018BL", "I-7018Z", "M-7018Z", "M-7018-16"},
    "E72": {"M-7019R"},
    "E88": {"M-7017mC-16"},
}
"""The errata that name their models, or the columns of the manual that these share."""


def errata_of(model: Model) -> list[str]:
    found = {erratum for erratum, holds in RULES.items() if holds(model)}
    found |= {erratum for erratum, names in NAMED.items() if model.value in names}
    return sorted(found)


@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
def test_a_model_names_the_errata_that_are_about_it(model: Model) -> None:
    assert (
        wrong([Cell("tables/models.json", model.value, "errata", ROWS[model.value]["errata"], errata_of(model))]) == []
    )
