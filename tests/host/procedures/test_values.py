"""Values as people write them, and as JSON has them."""

from decimal import Decimal
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import BaudRate, CharacterFormat, DataFormat, Filter, InvalidValueError, Model, Profile, TypeCode
from i7000.host.procedures.settings import Setting
from i7000.host.procedures.values import Channels, Choice, Name, Quantity, Values, choices, switch, types
from i7000.strategies.settings import plain_values, settings

TENTHS = Quantity(0, 255, 10, "s")
OFFSETS = Quantity(-4096, 4096, 100, "degC")


@given(settings(), st.data())
def test_a_plain_value_is_the_value_of_its_typed_one_and_of_its_text(setting: Setting, data: st.DataObject) -> None:
    plain = data.draw(plain_values(setting.values))
    typed = setting.values.typed(setting.name, plain)

    assert plain == setting.values.plain(setting.name, typed)
    if isinstance(plain, tuple):
        plain = ",".join(map(str, plain)) or "none"
    assert typed == setting.values.typed(
        setting.name, "on" if plain is True else "off" if plain is False else str(plain)
    )


@given(settings(), st.text() | st.floats() | st.integers() | st.booleans() | st.none() | st.lists(st.integers()))
def test_any_value_is_accepted_or_refused_with_what_is_allowed(setting: Setting, value: Any) -> None:
    refused = None
    try:
        setting.values.plain(setting.name, setting.values.typed(setting.name, value))
    except InvalidValueError as error:
        refused = error

    assert refused is None or (setting.name, setting.allowed) == (refused.field, refused.allowed)


@pytest.mark.parametrize(
    ("values", "value", "typed"),
    [
        (switch(), "YES", True),
        (switch(), " off ", False),
        (switch(), "1", True),
        (choices(BaudRate), 9600, BaudRate.BAUD_9600),
        (choices(BaudRate), BaudRate.BAUD_1200, BaudRate.BAUD_1200),
        (choices(CharacterFormat), "n82", CharacterFormat.N82),
        (choices(DataFormat), "Hex", DataFormat.HEX),
        (choices(Filter), "reject_50_hz", Filter.REJECT_50_HZ),
        (types(Profile(Model.I_7018)), "0f", TypeCode.K),
        (types(Profile(Model.I_7018)), "v_2_5", TypeCode.V_2_5),
        (TENTHS, "2.5 s", 2.5),
        (TENTHS, "2.5S", 2.5),
        (TENTHS, "0x19", 2.5),
        (TENTHS, "19h", 2.5),
        (TENTHS, 0.1 + 0.2, 0.3),
        (TENTHS, 2, 2.0),
        (OFFSETS, "-0.05", -0.05),
        (OFFSETS, "+1.", 1.0),
        (Quantity(0, 0xFF), "0x1A", 26),
        (Quantity(0, 0xFF), 26.0, 26),
        (Channels(8), "0-2,7", 0x87),
        (Channels(8), " ALL ", 0xFF),
        (Channels(8), "none", 0),
        (Channels(8), "1, 3", 0x0A),
        (Channels(8), [3, 1, 1], 0x0A),
        (Channels(8), {1}, 2),
        (Channels(8), (), 0),
        (Name(), "OVEN 2", "OVEN 2"),
    ],
)
def test_a_value_is_read_as_people_write_it(values: Values, value: object, typed: object) -> None:
    found = values.typed("it", value)

    assert (type(typed), typed) == (type(found), found)


@pytest.mark.parametrize(
    ("values", "value"),
    [
        (switch(), 1),
        (switch(), "2"),
        (switch(), None),
        (choices(BaudRate), 6),
        (choices(BaudRate), 9600.0),
        (choices(DataFormat), 0),
        (choices(DataFormat), Filter.REJECT_50_HZ),
        (types(Profile(Model.I_7018)), "08"),
        (types(Profile(Model.I_7018)), "FF"),
        (TENTHS, "2.55"),
        (TENTHS, 25.6),
        (TENTHS, -0.1),
        (TENTHS, "2.5 ms"),
        (TENTHS, "two"),
        (TENTHS, "1e1"),
        (TENTHS, "\u0662"),
        (TENTHS, "100h"),
        (TENTHS, True),
        (TENTHS, float("nan")),
        (TENTHS, float("inf")),
        (TENTHS, 1e308),
        (TENTHS, Decimal(1)),
        (TENTHS, DataFormat.HEX),
        (Quantity(0, 0xFF), 0.5),
        (Channels(8), "8"),
        (Channels(8), "3-1"),
        (Channels(8), "0-99"),
        (Channels(8), ""),
        (Channels(8), "0," * 60 + "0"),
        (Channels(8), 3),
        (Channels(8), [True]),
        (Channels(8), [-1]),
        (Name(), ""),
        (Name(), "OVEN 21"),
        (Name(), 7018),
    ],
)
def test_another_value_is_refused(values: Values, value: object) -> None:
    with pytest.raises(InvalidValueError):
        values.typed("it", value)


@pytest.mark.parametrize(
    ("values", "value"),
    [
        (types(Profile(Model.I_7018)), 0x2F),
        (switch(), 1),
        (Quantity(0, 30), 31),
        (Channels(8), 0x100),
        (Channels(8), True),
        (Name(), "0506"),
    ],
)
def test_what_a_module_should_not_have_has_no_plain_value(values: Values, value: object) -> None:
    with pytest.raises(InvalidValueError):
        values.plain("it", value)


@pytest.mark.parametrize(
    ("values", "allowed", "unit"),
    [
        (switch(), "no, yes", None),
        (choices(CharacterFormat), "N81, N82, E81, O81", None),
        (TENTHS, "0..25.5 s in steps of 0.1", "s"),
        (OFFSETS, "-40.96..40.96 degC in steps of 0.01", "degC"),
        (Quantity(1, 247), "1..247", None),
        (Channels(8), "channels of 0..7 such as 0-3,5, or all, or none", None),
        (Name(), "1 to 6 characters, not the text of another response (2, 4 or 6 hex digits, a version, ...)", None),
        (Choice((("10 Hz", False), ("8 Hz", True))), "10 Hz, 8 Hz", None),
    ],
)
def test_the_allowed_values_and_the_unit_are_in_words(values: Values, allowed: str, unit: str | None) -> None:
    assert (allowed, unit) == (values.allowed, values.unit)
