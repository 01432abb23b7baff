"""The checks of `i7000 check` against slaves that nobody here wrote: what they fail is true, and each reason is known.

Both have the map of an M-7017 and the functions 01 to 06, 0F and 10. They lack function 46h, so the model is given.
"""

from collections import Counter
from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager
from fnmatch import fnmatchcase
from pathlib import Path

import pytest
from attrs import frozen
from pymodbus.simulator import DataType, SimData, SimDevice

from i7000 import Model, Profile, Protocol, spec
from i7000.conformance import DEFAULT_ALLOWED
from i7000.conformance.oracle import eeprom_of
from i7000.conformance.run import CheckResult, Options, Run, plan, selected
from i7000.conformance.verdict import Verdict
from i7000.device import power_on
from i7000.host import Policy
from i7000.host.procedures import identify, snapshot
from i7000.link import Line, open_target
from i7000.link.guarded import GuardedPort
from tests.interop.foreign import libmodbus_slave, pymodbus_server

STATEMENTS = spec.statements()
FRAMES_AND_MAP = ("link", "frame", "map", "rtu/46/00")
REQUESTS = ("rtu/crc", "rtu/address", "rtu/function", "rtu/0*", "rtu/1*")
"""46h 00 stands for all sub-functions of 46h: neither slave answers any, and each would be waited for."""
QUICK, PATIENT = 0.2, 2.0
"""The scales of all times to listen: what is not as expected is checked again, in case the machine was busy."""

NO_46H = "it does not have function 46h, and does not answer it"
NO_RESET_STATUS = "00273 is a plain coil: a read does not clear it"
START_AND_END = "a range that begins in the map and ends beyond it has the exception 02, not 03"
MAP_WITHOUT_GAPS = "the map of libmodbus is one run of items: what lies between two rows is there"
COUNTED_LENGTH = "the function says how long a request is: it waits for the rest of a short one, and is silent"
BLOCKS_OF_16 = "pymodbus has bits in blocks of 16: those between and behind the rows are there"
NO_TIMEOUT = "a silence ends no request: it takes the next one for the rest of an unfinished or unknown one"
ANSWERS_FOR_OTHERS = "it answers requests to other addresses, with the exception 04"
FUNCTION_00 = "it answers a count that no request may have with the exception 01 to function 00"

OF_PYMODBUS = {
    "rtu/46/00/*": NO_46H,
    "map/coil/reset_status": NO_RESET_STATUS,
    "map/across/input_register-n1": START_AND_END,
    "map/across/coil-n1": BLOCKS_OF_16,
    "map/across/discrete_input-n1": BLOCKS_OF_16,
    "map/gaps/coil": BLOCKS_OF_16,
    "map/gaps/discrete_input": BLOCKS_OF_16,
    "rtu/01/counts-n2": BLOCKS_OF_16,
    "rtu/02/counts-n2": BLOCKS_OF_16,
    "frame/rtu/truncated": NO_TIMEOUT,
    "frame/recovers/rtu": NO_TIMEOUT,
    "rtu/crc/missing": NO_TIMEOUT,
    "rtu/function/unknown": NO_TIMEOUT,
    "rtu/0?/length": NO_TIMEOUT,
    "frame/rtu/address": ANSWERS_FOR_OTHERS,
    "rtu/address/reserved": ANSWERS_FOR_OTHERS,
    "rtu/0?/counts-n1": FUNCTION_00,
}
OF_LIBMODBUS = {
    "rtu/46/00/*": NO_46H,
    "map/coil/reset_status": NO_RESET_STATUS,
    "map/across/discrete_input-n1": START_AND_END,
    "map/across/input_register-n1": START_AND_END,
    "map/across/coil-n1": MAP_WITHOUT_GAPS,
    "map/across/holding_register-n1": MAP_WITHOUT_GAPS,
    "map/gaps/coil": MAP_WITHOUT_GAPS,
    "map/gaps/holding_register": MAP_WITHOUT_GAPS,
    "rtu/02/length": COUNTED_LENGTH,
    "rtu/04/length": COUNTED_LENGTH,
}
"""What the slaves fail, by ids of checks, and why."""


def bits(first: int, *values: int) -> SimData:
    return SimData(first, values=list(map(bool, values)), datatype=DataType.BITS)


def words(first: int, *values: int) -> SimData:
    return SimData(first, values=list(values), datatype=DataType.REGISTERS)


def on_pymodbus(_: Path) -> AbstractContextManager[str]:
    coils = [bits(128, *8 * [0]), bits(256, 1, *15 * [0], 1)]  # 00257 Modbus RTU, 00273 reset
    settings = words(480, 0x0405, 0x000B, 0x1700, 0x0070, 1, 0x0006, 0x0008, 0, 0, 0x00FF)
    registers = [words(0, *8 * [0]), settings, words(491, 0)]
    return pymodbus_server(SimDevice(1, (coils, [bits(128, *8 * [0])], registers, [words(0, *8 * [0])])))


@frozen
class Slave:
    """A slave, what it fails, and how many checks of frames and the map, and of requests, pass at least."""

    served: Callable[[Path], AbstractContextManager[str]]
    fails: dict[str, str]
    passes: tuple[int, int]


SLAVES = {
    "pymodbus": Slave(on_pymodbus, OF_PYMODBUS, (33, 15)),
    "libmodbus": Slave(libmodbus_slave, OF_LIBMODBUS, (35, 26)),
}


def checked(target: str, select: Iterable[str], scale: float) -> dict[str, CheckResult]:
    """Return what became of the selected checks, as of those of `i7000 check --model M-7017 --protocol rtu`."""
    port = GuardedPort(open_target(target))
    with Line(port, policy=Policy(retries=1, turnaround=0.2, grace=0.05)) as line:
        found = line.run(identify(1, protocols=(Protocol.MODBUS_RTU,)))
        assert found.protocol is Protocol.MODBUS_RTU
        before = line.run(snapshot(1, Profile(Model.M_7017, type_codes=()), Protocol.MODBUS_RTU))
        eeprom = eeprom_of(before)
        ids, profile = selected(STATEMENTS, select), power_on(eeprom, now=0.0).profile
        chosen = [it for it in STATEMENTS.values() if it.id in ids]
        planned = plan(chosen, profile, Protocol.MODBUS_RTU, DEFAULT_ALLOWED)
        options = Options(allowed=DEFAULT_ALLOWED, timeout_scale=scale)
        run = Run(planned, eeprom, options, line=line.line, checksum=False)
        line.run(run.procedure())
    return {it.id: it for it in run.results}


def failing(results: dict[str, CheckResult]) -> set[str]:
    """Return the ids of what neither passed, nor is open, nor was skipped."""
    return {it.id for it in results.values() if it.verdict not in (Verdict.PASS, Verdict.INFO, Verdict.SKIP)}


def unexpected(results: dict[str, CheckResult], slave: Slave) -> set[str]:
    """Return the ids of what fails without a reason, and of what has a reason to fail, and does not."""
    ran = {it.id for it in results.values() if it.verdict is not Verdict.SKIP}
    return failing(results) ^ {it for it in ran if any(fnmatchcase(it, pattern) for pattern in slave.fails)}


@pytest.mark.parametrize("name", SLAVES)
@pytest.mark.parametrize("part", [0, 1], ids=["frames-and-map", "requests"])
def test_a_foreign_slave_fails_what_is_explained_and_nothing_else(name: str, part: int, tmp_path: Path) -> None:
    slave = SLAVES[name]
    with slave.served(tmp_path) as target:
        results = checked(target, (FRAMES_AND_MAP, REQUESTS)[part], QUICK)
        if again := unexpected(results, slave):
            results |= checked(target, again, PATIENT)

    assert {it: (results[it].verdict, results[it].text) for it in unexpected(results, slave)} == {}
    assert Counter(it.verdict for it in results.values())[Verdict.PASS] >= slave.passes[part]
