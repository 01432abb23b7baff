"""What the numbers of a map's rows mean (`values`), held against the code: its names, or what a module does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from i7000 import CjcUpdate, Filter, LogCommand, ModbusDataFormat, Model, Protocol, TypeCode, Unit
from i7000.device import Eeprom, Signals
from tests.device.driver import Bench, bench
from tests.spec import lint
from tests.spec.cells import Cell, row_id, wrong

if TYPE_CHECKING:
    from collections.abc import Callable


MAPS = {lint.name(path): lint.load(path) for path in lint.table_files("modbus_registers")}
NAMED: dict[str, dict[int, str]] = {
    "protocol": {code: {"DCON": "DCON", "MODBUS_RTU": "Modbus RTU"}[code.name] for code in Protocol},
    "filter": {int(it.value): it.name.removeprefix("REJECT_").replace("_HZ", " Hz rejection") for it in Filter},
    "modbus_data_format": {code: code.name.lower() for code in ModbusDataFormat},
    "cjc_update": {code: code.name.lower().replace("started", "running") for code in CjcUpdate},
    "log_command": {
        code: "stop" if code is LogCommand.STOP else f"run in {code.name.lower()} mode" for code in LogCommand
    },
}
"""The rows whose numbers have names in the code."""
CLEARS = "analog and digital output commands clear the time-out status"
SWITCHES: dict[str, tuple[Callable[[Eeprom], bool], str, str]] = {
    "cjc_enabled": (lambda it: it.cjc_enabled, "disabled", "enabled"),
    "host_watchdog_enabled": (lambda it: it.host_watchdog_enabled, "disabled", "enabled"),
    "open_wire_detection": (lambda it: it.open_wire_detection, "disabled", "enabled"),
    "fast_mode": (lambda it: it.report_settings.fast_mode, "normal mode", "fast mode"),
    "single_ended": (lambda it: it.single_ended, "differential", "single-ended"),
    "big_endian": (lambda it: it.big_endian, "little-endian", "big-endian"),
    "log_overwrite": (lambda it: it.log.overwrite, "stop", "go on writing"),
    "sampling_rate": (lambda it: it.sampling_rate_8_hz, "10 Hz", "8 Hz"),
    "host_watchdog_mode": (lambda it: it.host_watchdog_mode, "as on the I-7000 series", CLEARS),
}
"""The rows that switch something: what the module stores, and what it is called when it is off and on."""


def time_out(module: Bench) -> None:
    module.write("host_watchdog_timeout", 1.0)
    module.write("host_watchdog_enabled", True)
    module.wait(2.0)


def run(module: Bench) -> None:
    module.write("log_period_second", 1)
    module.write("log_command", int(LogCommand.CONTINUOUS))


def overdrive(module: Bench) -> None:
    """More than the type that the bench gives: 21 mA."""
    module.signals = Signals.of(Unit.MILLIAMPERE, *(21.0,) * module.state.profile.channels)


def look(module: Bench) -> None:
    module.read("reset_status")


HAPPENINGS: dict[str, tuple[Callable[[Bench], None], int, tuple[str, str]]] = {
    "host_watchdog_timed_out": (time_out, 1, ("not timed out", "timed out; writing 1 clears it")),
    "log_status": (run, 1, ("stopped", "running")),
    "range_status": (overdrive, 1, ("in range, or disabled", "over or under range")),
    "reset_status": (look, 0, ("read before since power-on", "first read since power-on")),
}
"""The rows that tell what has happened: what makes it happen, what they tell then, and what 0 and 1 are called."""
COMMANDS = {"load_factory_calibration": {1: "load the calibration of the factory"}}
"""The row that is only written; 0 is refused."""


def on_bench(name: str) -> Bench:
    model = Model.find(name)
    type_code = TypeCode.MA_0_20 if TypeCode.MA_0_20 in model.type_codes else None
    inputs = Signals.of(Unit.MILLIAMPERE, *(10.0,) * (model.single_ended_channels or model.channels))
    return bench(model, type_code=type_code, protocol=Protocol.MODBUS_RTU, signals=inputs)


def first(found: Any) -> int:
    return int(found[0] if isinstance(found, tuple) else found)


def labels_of(name: str, model: str) -> dict[int, str] | None:
    """What the numbers of a row are called by what the code does with them; None for what is a number or a type."""
    if name in NAMED:
        return NAMED[name]
    module = on_bench(model)
    if name in SWITCHES:
        stored, *words = SWITCHES[name]
        found = {}
        for number in (0, 1):
            module.write(name, number)
            found[number] = words[stored(module.state.eeprom)]
        return found
    if name in HAPPENINGS:
        happen, then, words_of = HAPPENINGS[name]
        if happen is not look:
            assert first(module.read(name)) != then
        happen(module)
        assert first(module.read(name)) == then
        return dict(enumerate(words_of))
    return COMMANDS.get(name)


@pytest.mark.parametrize("file", MAPS)
def test_the_numbers_of_a_row_are_called_what_a_module_makes_of_them(file: str) -> None:
    cells = []
    for row in MAPS[file]["rows"]:
        models = list(row["models"] or MAPS[file]["models"])
        labels = labels_of(row["name"], models[0])
        expected = None if labels is None else {str(number): label for number, label in labels.items()}
        cells.append(Cell(file, row_id(row), "values", row["values"], expected))

    assert wrong(cells) == []
