"""The oracle of modules says something of everything there is: nothing is left out that an example may not draw."""

from typing import Any

import pytest

from tests.device import modbus_oracle, oracle
from tests.spec.lint import rows

BROADCASTS = {row["section"] for row in rows("dcon_commands") if row["response"] is None}
M_MODELS = [name for name in oracle.MODELS if name.startswith("M-")]


def said(name: str, access: str) -> list[dict[str, Any]]:
    """The rows of a model's map that something is said of, and that allow an access."""
    (data,) = (data for data in modbus_oracle.MAPS if name in data["models"])
    return [
        row
        for row in data["rows"]
        if access in row["access"].split("/")
        and not modbus_oracle.UNSAID.fullmatch(row["name"])
        and (row["models"] is None or name in row["models"])
    ]


def test_every_command_that_has_an_answer_is_answered() -> None:
    answered = {section for section, _, _ in oracle.ANSWERS}

    assert answered | BROADCASTS == {row["section"] for row in rows("dcon_commands")}
    assert not answered & BROADCASTS


def test_every_function_and_sub_function_is_answered() -> None:
    assert set(modbus_oracle.ANSWERS) == {code for code in modbus_oracle.FUNCTIONS if code < 0x80}
    assert set(modbus_oracle.FORMS) == set(modbus_oracle.SUB_FUNCTIONS)


@pytest.mark.parametrize("model", M_MODELS)
def test_every_row_has_a_value(model: str) -> None:
    it = oracle.Oracle(model, oracle.VERSIONS[-1])

    assert [len(modbus_oracle.told(it, row)) for row in said(model, "R")] == [row["count"] for row in said(model, "R")]


@pytest.mark.parametrize("model", M_MODELS)
def test_every_row_is_stored(model: str) -> None:
    it = oracle.Oracle(model, oracle.VERSIONS[-1])

    stored = said(model, "W")
    for row in stored:
        modbus_oracle.store(it, row["name"], 0, row["maximum"] or 0)

    assert {"protocol", "line_settings", "channel_mask"} <= {row["name"] for row in stored}
    assert it.stored_protocol == "modbus"
