"""mbpoll, a host in C on top of libmodbus, reads on a pseudo-terminal what is on the inputs, and sets what can be."""

import re
import subprocess
from calendar import timegm

import pytest
from attrs import frozen

from i7000.simulator.pseudo_terminal import open_pty
from tests.interop import program
from tests.interop.scenes import (
    LOGGER,
    MANY_DEGREES,
    MANY_THERMOCOUPLES,
    MIXED,
    NAMES,
    NOBODY,
    ONE_BUS,
    SCENES,
    SINGLE_ENDED,
    THERMOCOUPLES,
    VOLTAGES,
    Scene,
)
from tests.simulator.running import Running, running
from tests.waiting import ENOUGH

INPUT_REGISTERS, HOLDING_REGISTERS, DISCRETE_INPUTS, COILS = "3", "4", "1", "0"
LONG_NUMBERS = "4:int"


@frozen
class Polled:
    """What it printed: the items by their numbers, or what was wrong."""

    code: int
    items: dict[int, int]
    error: str


def mbpoll(here: Running, table: str, first: int, *values: int, count: int = 1, address: str = "1") -> Polled:
    """Read items, counted from 1 on, or write them."""
    how = ("-m", "rtu", "-b", "9600", "-P", "none", "-1", "-q", "-o", "0.3")
    what = ("-a", address, "-t", table, "-r", str(first), *(() if values else ("-c", str(count))))
    command = [program("mbpoll"), *how, *what, here.place, *map(str, values)]
    ran = subprocess.run(command, check=False, capture_output=True, text=True, timeout=ENOUGH)  # noqa: S603 - our arguments
    found = re.findall(r"^\[(\d+)\]:\s+(\d+)", ran.stdout, re.MULTILINE)
    return Polled(ran.returncode, {int(number): int(item) for number, item in found}, ran.stderr.strip())


def numbered(first: int, *items: int) -> Polled:
    return Polled(0, dict(enumerate(items, first)), "")


@pytest.mark.parametrize("scene", SCENES, ids=NAMES)
@pytest.mark.parametrize("table", [INPUT_REGISTERS, HOLDING_REGISTERS])
def test_it_reads_all_channels(scene: Scene, table: str) -> None:
    with running(open_pty, scene.simulated) as here:
        polled = mbpoll(here, table, 1, count=len(scene.words), address=str(scene.address))

    assert numbered(1, *scene.words) == polled


def test_it_reads_a_bus_of_many_modules_in_one_go() -> None:
    with running(open_pty, *ONE_BUS) as here:
        polled = [mbpoll(here, INPUT_REGISTERS, 1, count=8, address=str(scene.address)) for scene in SCENES]
        all_at_once = mbpoll(here, INPUT_REGISTERS, 1, count=8, address="1:6")

    assert [numbered(1, *scene.words[:8]) for scene in SCENES] == polled
    assert numbered(1, *LOGGER.words[:8]) == all_at_once  # those of the last, which it prints with the same numbers


def test_it_reads_the_cold_junction_and_whole_degrees() -> None:
    with running(open_pty, THERMOCOUPLES.simulated, MIXED.simulated, MANY_THERMOCOUPLES.simulated) as here:
        junctions = [mbpoll(here, INPUT_REGISTERS, 129, address=address) for address in "235"]
        degrees = mbpoll(here, INPUT_REGISTERS, 33, count=16, address="5")

    assert [numbered(129, 2345), numbered(129, 65536 - 321), numbered(129, 3120)] == junctions
    assert numbered(33, *(round(value) % 65536 for value in MANY_DEGREES)) == degrees


def test_it_reads_who_a_module_is_and_how_it_is_set() -> None:
    """B4.5, 00701700, address 1, 9600 N81, +/-10 V, no delay, no watchdog, all channels."""
    with running(open_pty, VOLTAGES.simulated) as here:
        polled = mbpoll(here, HOLDING_REGISTERS, 481, count=10)

    assert numbered(481, 0x0405, 0x000B, 0x1700, 0x0070, 1, 0x06, 0x08, 0, 0, 0xFF) == polled


@pytest.mark.parametrize("table", [DISCRETE_INPUTS, COILS])
def test_it_reads_which_channels_are_out_of_range(table: str) -> None:
    with running(open_pty, MIXED.simulated, SINGLE_ENDED.simulated) as here:
        degrees = mbpoll(here, table, 129, count=8, address="3")
        milliamperes = mbpoll(here, table, 129, count=10, address="4")

    assert numbered(129, 0, 0, 1, 1, 0, 0, 0, 0) == degrees
    assert numbered(129, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0) == milliamperes


def test_it_sets_registers_and_coils() -> None:
    with running(open_pty, MIXED.simulated) as here:
        one_register = mbpoll(here, HOLDING_REGISTERS, 489, 20, address="3")
        registers = mbpoll(here, HOLDING_REGISTERS, 353, 100, 65436, address="3")
        one_coil = mbpoll(here, COILS, 261, 1, address="3")
        coils = mbpoll(here, COILS, 268, 0, 0, address="3")

        assert [(it.code, it.error) for it in (one_register, registers, one_coil, coils)] == [(0, "")] * 4
        assert numbered(489, 20) == mbpoll(here, HOLDING_REGISTERS, 489, address="3")
        assert numbered(353, 100, 65436, 0) == mbpoll(here, HOLDING_REGISTERS, 353, count=3, address="3")
        assert numbered(260, 0, 1) == mbpoll(here, COILS, 260, count=2, address="3")
        assert numbered(268, 0, 0) == mbpoll(here, COILS, 268, count=2, address="3")


def test_what_it_sets_changes_what_it_reads() -> None:
    with running(open_pty, VOLTAGES.simulated) as here:
        mbpoll(here, COILS, 269, 1)
        engineering = mbpoll(here, INPUT_REGISTERS, 1, count=2)
        mbpoll(here, HOLDING_REGISTERS, 487, 0x09)
        five_volts = mbpoll(here, INPUT_REGISTERS, 1, count=2)
        mbpoll(here, HOLDING_REGISTERS, 485, NOBODY)
        moved = mbpoll(here, INPUT_REGISTERS, 1, count=2, address=str(NOBODY))

    assert numbered(1, 1500, 65536 - 2500) == engineering
    assert numbered(1, 1500, 65536 - 2500) == five_volts
    assert five_volts == moved


def test_it_sets_the_clock_of_the_logger_and_reads_it_as_seconds() -> None:
    moment = (2031, 7, 4, 12, 34, 56)
    with running(open_pty, LOGGER.simulated) as here:
        mbpoll(here, HOLDING_REGISTERS, 865, *moment, address="6")
        date = mbpoll(here, HOLDING_REGISTERS, 865, count=5, address="6")
        seconds = mbpoll(here, LONG_NUMBERS, 17, address="6")

    assert numbered(865, *moment[:5]) == date
    assert seconds.items[17] - timegm(moment) in range(3)


def test_it_reads_what_was_logged() -> None:
    start = timegm((2040, 1, 1, 0, 0, 0))
    with running(open_pty, LOGGER.simulated) as here:
        mbpoll(here, LONG_NUMBERS, 17, start, address="6")
        mbpoll(here, HOLDING_REGISTERS, 878, 0, 0, 59, address="6")
        mbpoll(here, HOLDING_REGISTERS, 876, 1, address="6")
        status = mbpoll(here, HOLDING_REGISTERS, 875, address="6")
        index = mbpoll(here, LONG_NUMBERS, 871, address="6")
        record = mbpoll(here, INPUT_REGISTERS, 1001, count=18, address="6")
        part = mbpoll(here, INPUT_REGISTERS, 1001, count=17, address="6")

    items = list(record.items.values())
    assert numbered(875, 1) == status
    assert numbered(871, 1) == index
    assert LOGGER.words == tuple(items[:16])
    assert items[16] + items[17] * 65536 - start in range(3)
    assert (part.code, part.error) == (1, "Read input register failed: Illegal data value")


@pytest.mark.parametrize(
    ("table", "first", "count", "reason"),
    [
        (INPUT_REGISTERS, 9, 1, "Read input register failed: Illegal data address"),
        (INPUT_REGISTERS, 8, 2, "Read input register failed: Illegal data value"),
        (HOLDING_REGISTERS, 491, 1, "Read output (holding) register failed: Illegal data address"),
        (DISCRETE_INPUTS, 1, 1, "Read discrete input failed: Illegal data address"),
        (COILS, 1, 1, "Read discrete output (coil) failed: Illegal data address"),
    ],
)
def test_what_does_not_exist_is_an_exception(table: str, first: int, count: int, reason: str) -> None:
    with running(open_pty, VOLTAGES.simulated) as here:
        polled = mbpoll(here, table, first, count=count)

    assert Polled(1, {}, reason) == polled


@pytest.mark.parametrize(
    ("table", "first", "values", "reason"),
    [
        (HOLDING_REGISTERS, 1, (0,), "Write output (holding) register failed: Illegal data address"),
        (HOLDING_REGISTERS, 485, (248,), "Write output (holding) register failed: Illegal data value"),
        (HOLDING_REGISTERS, 489, (1, 256), "Write output (holding) register failed: Illegal data value"),
        (COILS, 273, (1,), "Write discrete output (coil) failed: Illegal data address"),
    ],
)
def test_what_cannot_be_written_is_an_exception_and_changes_nothing(
    table: str, first: int, values: tuple[int, ...], reason: str
) -> None:
    with running(open_pty, VOLTAGES.simulated) as here:
        before = mbpoll(here, table, first, count=len(values))
        refused = mbpoll(here, table, first, *values)
        after = mbpoll(here, table, first, count=len(values))

    assert Polled(1, {}, reason) == refused
    assert before.items.keys() == set(range(first, first + len(values)))
    assert (before == after) == (first != 273)  # the reset status is 1 for its first reader


@pytest.mark.parametrize("address", ["7", str(NOBODY)])
def test_nobody_answers_for_a_module_that_is_not_there_or_speaks_dcon(address: str) -> None:
    with running(open_pty, *ONE_BUS) as here:
        polled = mbpoll(here, INPUT_REGISTERS, 1, address=address)

    assert Polled(1, {}, "Read input register failed: Connection timed out") == polled


def test_a_function_that_no_module_has_is_an_exception() -> None:
    with running(open_pty, VOLTAGES.simulated) as here:
        command = [program("mbpoll"), "-m", "rtu", "-b", "9600", "-P", "none", "-u", here.place]
        ran = subprocess.run(command, check=False, capture_output=True, text=True, timeout=ENOUGH)  # noqa: S603

    assert ran.stderr.strip() == "Report slave ID failed(-1): Illegal function"
