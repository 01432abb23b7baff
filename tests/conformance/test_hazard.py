"""The hazard of each command, row by row as the specification of the conformance kit has it."""

from typing import Any

import pytest

from i7000 import ArgumentError, dcon, modbus
from i7000.conformance import DEFAULT_ALLOWED, Hazard, allowing, worst_of
from i7000.conformance.hazard import hazard_of, hazards_of_writes, items_that_end_when_read
from i7000.modbus import Area
from tests.conformance.acting import CALIBRATING, CALLING, LOSING, WRITING
from tests.each import each

COMMANDS = (*dcon.COMMANDS, *modbus.REQUESTS)


@each("command", [pytest.param(it, id=f"{it.section} {it.__name__}") for it in COMMANDS])
def test_a_command_has_the_hazard_of_the_specification(command: Any) -> None:
    name = command.__name__
    expected = {
        Hazard.CALIBRATION: name in CALIBRATING,
        Hazard.COMM: name in LOSING,
        Hazard.WRITE: name in WRITING or name.startswith("Write"),
        Hazard.BROADCAST: name in CALLING,
        Hazard.MEMORY: name == "ReadSynchronizedData",
    }

    assert [hazard_of(command)] == ([hazard for hazard, it in expected.items() if it] or [Hazard.OBSERVE])


def test_items_are_dangerous_to_write_as_the_specification_has_them() -> None:
    coils = {256: Hazard.COMM, 260: Hazard.COMM, 271: Hazard.CALIBRATION}
    registers = dict.fromkeys((484, 485, 487, 488), Hazard.COMM)

    assert hazards_of_writes() == {
        **{(Area.COIL, address): hazard for address, hazard in coils.items()},
        **{(Area.HOLDING_REGISTER, address): hazard for address, hazard in registers.items()},
    }


def test_only_the_reset_status_ends_when_it_is_read() -> None:
    assert items_that_end_when_read() == {(Area.COIL, 272)}


def test_comm_brings_write_with_it_and_calibration_nothing() -> None:
    assert allowing() == DEFAULT_ALLOWED == {Hazard.OBSERVE, Hazard.MEMORY}
    assert allowing([Hazard.COMM]) == {*DEFAULT_ALLOWED, Hazard.COMM, Hazard.WRITE}
    assert allowing([Hazard.CALIBRATION]) == {*DEFAULT_ALLOWED, Hazard.CALIBRATION}
    assert allowing([Hazard.WRITE, Hazard.BROADCAST]) == {*DEFAULT_ALLOWED, Hazard.WRITE, Hazard.BROADCAST}


def test_a_permission_of_another_type_is_refused() -> None:
    wrong: Any = ["write"]
    with pytest.raises(ArgumentError):
        allowing(wrong)


def test_the_order_of_the_classes_is_that_of_harm() -> None:
    assert [it.value for it in Hazard] == ["observe", "memory", "broadcast", "write", "comm", "calibration"]
    assert worst_of(Hazard) is Hazard.CALIBRATION
    assert worst_of(()) is Hazard.OBSERVE


def test_every_class_has_words() -> None:
    assert len({it.words for it in Hazard}) == len(Hazard)
