"""The checks of the DCON commands: what they pass, and what each of them catches."""

from collections.abc import Iterator

import pytest

from i7000 import Model, dcon
from i7000.conformance.run import selected
from i7000.conformance.statement import statements
from i7000.conformance.verdict import Verdict
from i7000.device import Signals, State, step
from tests.conformance.bench import Step, answering, checked, failing, memory, undone
from tests.each import each

READS = sorted(id for id in selected(["dcon"]) if id.endswith("/reply"))
MODELS = (Model.I_7017, Model.M_7017Z, Model.M_7019R)
"""Together they have every command."""


def of_models(select: str, firmware: Step) -> Iterator[tuple[str, Verdict]]:
    """Yield the verdicts of checks of all `MODELS` that have what they are about."""
    for model in MODELS:
        for result in checked([select], memory(model), firmware).values():
            if result.verdict is not Verdict.SKIP:
                yield result.id, result.verdict


# --- what is read -----------------------------------------------------------------------------------------------------


@each("model", Model)
def test_every_model_passes_the_checks_of_what_is_read(model: Model) -> None:
    assert not undone(checked(["dcon"], memory(model)))


@each(
    "alter",
    [
        pytest.param(lambda wire: wire[:-2] + b"\r", id="the last character is lost"),
        pytest.param(lambda wire: b"?" + wire[1:], id="another leading character"),
        pytest.param(lambda wire: wire[:-1] + b"0\r", id="one character more"),
        pytest.param(lambda wire: wire[:-1], id="no carriage return"),
        pytest.param(lambda wire: wire.replace(b"01", b"02", 1), id="another address"),
    ],
)
def test_an_answer_of_another_form_is_found(alter: object) -> None:
    def altered(frame: bytes, wire: bytes | None) -> bytes | None:
        return wire if wire is None or frame == b"$01M\r" else alter(wire)  # type: ignore[operator]

    found = {id for id, verdict in of_models("dcon/*/reply", answering(altered)) if verdict is Verdict.FAIL}
    of_readings = {"dcon/2.3/reply", "dcon/2.4/reply", "dcon/2.11/reply", "dcon/2.19/reply", "dcon/2.12/reply"}

    assert set(READS) - found <= of_readings | {"dcon/2.24/reply"}


def test_a_name_of_other_characters_is_found() -> None:
    lower = answering(lambda _, wire: wire and wire.replace(b"7017", b"7O17"))

    assert "dcon/2.24/reply" not in failing(checked(["dcon/2.24"], memory(Model.I_7017)))
    assert checked(["dcon/2.24/reply"], memory(Model.I_7017), lower)["dcon/2.24/reply"].verdict is not Verdict.PASS
