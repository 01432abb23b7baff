"""Models, firmware and series: what is possible, and that what is not is refused with the reason."""

from typing import Any

import pytest

from i7000 import EncodeError, Firmware, Model, TypeCode, series


@pytest.mark.parametrize("text", ["B3.9", "B309", "A2.0", "B405", "B3.10"])
def test_a_firmware_is_read_in_both_ways_of_writing(text: str) -> None:
    assert Firmware(text) == Firmware(str(Firmware(text)))


@pytest.mark.parametrize(
    "text",
    ["", "B", "3.9", "b3.9", "B3", "B3.", "B3.9 ", "B39", "B3.123", "B3.9\n", "Б3.9", "B\u0663.\u0669", None, 39],
)
def test_what_is_no_firmware_is_refused(text: Any) -> None:
    with pytest.raises(EncodeError, match="firmware cannot be"):
        Firmware(text)


def test_firmware_is_ordered_by_numbers() -> None:
    ordered = [Firmware(text) for text in ("A1.9", "A2.0", "B1.4", "B2.9", "B2.10", "B305", "B3.6", "C1.0")]

    assert ordered == sorted(set(ordered))
    assert repr(Firmware("B405")) == "Firmware('B4.5')"
    assert len({Firmware("B405"), Firmware("B4.5")}) == 1
    assert Firmware("B4.5") != "B4.5"


@pytest.mark.parametrize(
    ("names", "models"),
    [
        (("I-7019",), {Model.I_7019R}),
        (("7019",), {Model.I_7019R, Model.M_7019R, Model.M_7019Z}),
        (("7017Z",), {Model.I_7017Z, Model.M_7017Z}),
        (("I-7018R", "M-7018R"), {Model.I_7018R, Model.M_7018R}),
        (("M-7018",), {Model.M_7018, Model.M_7018R, Model.M_7018Z, Model.M_7018_16}),
    ],
)
def test_a_series_is_all_its_variations(names: tuple[str, ...], models: set[Model]) -> None:
    assert models == series(*names)


def test_the_three_series_are_all_models() -> None:
    assert set(Model) == series("7017", "7018", "7019")
    assert not series("7017") & series("7018")


@pytest.mark.parametrize("name", ["", "7016", "I-70", "7017Q"])
def test_a_series_that_does_not_exist_is_refused(name: str) -> None:
    with pytest.raises(EncodeError, match="series cannot be"):
        series(name)


def test_a_model_is_found_by_its_name_in_any_case() -> None:
    assert Model.M_7017mC_16 is Model.find("m-7017MC-16")
    assert Model.M_7019R is Model.find("M-7019")
    assert all(model is Model.find(model.value) for model in Model)


def test_an_unknown_model_is_answered_with_the_near_ones() -> None:
    with pytest.raises(EncodeError, match="I-7019R, M-7019R, M-7019Z"):
        Model.find("7019Q")
    with pytest.raises(EncodeError, match="model cannot be 3"):
        Model.find(3)  # type: ignore[arg-type]
    with pytest.raises(EncodeError, match=r"I-7017, .* M-7019Z"):
        Model.find("Q")


def test_the_types_of_a_model_cannot_be_changed() -> None:
    types: Any = Model.I_7018.type_codes

    with pytest.raises(TypeError):
        types[TypeCode.V_10] = None
