"""The clock and the data logger of the M-7017mC-16."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Model, Protocol, Unit, modbus
from i7000.device import CAPACITY, Log, LogCommand, Signals, advance
from i7000.device.logger import date_of, moment_of
from tests.device.driver import Bench, bench

NOON = moment_of((2024, 2, 29, 12, 0, 0))
HALF = 0x4000
VALUE = modbus.ExceptionCode.ILLEGAL_DATA_VALUE


def logger(**settings: Any) -> Bench:
    """A logger at noon of a leap day, with a period of ten seconds and 10 mA on channel 0."""
    log = Log(clock_offset=NOON - 1000.0, **{"period": (0, 0, 10)} | settings)
    signals = Signals.of(Unit.MILLIAMPERE, 10.0)
    return bench(Model.M_7017mC_16, signals=signals, protocol=Protocol.MODBUS_RTU, log=log)


def times(module: Bench) -> list[int]:
    """When the records of the window were made, in seconds after noon."""
    return [record.time - NOON if record.time else -1 for record in module.read("log_records")]


def test_the_clock_runs_and_outlives_the_power() -> None:
    module = logger()
    module.wait(3600.5)
    module.power_cycle()

    assert [module.read(f"rtc_{part}") for part in ("year", "month", "date", "hour", "minute", "second")] == [
        2024, 2, 29, 13, 0, 0,
    ]  # fmt: skip
    assert module.read("rtc_epoch") == NOON + 3600


def test_the_clock_is_set_in_parts_or_at_once() -> None:
    module = logger()
    module.write("rtc_year", 2023)
    assert module.read("rtc_date") == 28
    module.ask(modbus.WriteMultipleRegisters(1, 864, (2020, 12, 22, 13, 5, 9)))
    assert module.read("rtc_epoch") == moment_of((2020, 12, 22, 13, 5, 9))
    module.write("rtc_epoch", NOON)
    assert [module.read("rtc_month"), module.read("rtc_date"), module.read("rtc_hour")] == [2, 29, 12]
    module.ask(modbus.WriteSingleRegister(1, 16, NOON & 0xFFFF ^ 1))
    assert module.read("rtc_epoch") == NOON ^ 1


@pytest.mark.parametrize("seconds", [0, 951_782_399, 951_782_400, 1_582_934_400, 4_107_542_400, 5_999_999_999, -1])
def test_a_date_is_a_moment_and_back(seconds: int) -> None:
    assert moment_of(date_of(seconds)) == seconds


@pytest.mark.parametrize("seconds", [1e15, -1e15, 1e18])
def test_every_moment_has_a_date(seconds: float) -> None:
    assert moment_of(date_of(seconds)) == int(seconds)


def test_continuous_mode_records_at_once_and_then_every_period() -> None:
    module = logger()
    module.write("log_command", 1)
    assert module.read("log_status") == 1
    module.wait(9.9)
    assert module.read("log_last_index") == 1
    module.wait(0.1)
    module.signals = Signals.of(Unit.MILLIAMPERE, -20.0)
    module.wait(25)

    records = module.read("log_records")

    assert times(module) == [0, 10, 20, 30, -1, -1]
    assert [record.readings[0].value for record in records[:4]] == pytest.approx([10.0, 10.0, -20.0, -20.0], abs=1e-3)
    assert module.read("log_last_index") == 4


def test_a_stopped_logger_records_nothing_more() -> None:
    module = logger()
    module.write("log_command", 1)
    module.wait(10)
    module.write("log_command", 0)
    module.wait(100)

    assert [module.read("log_status"), module.read("log_command"), module.read("log_last_index")] == [0, 0, 2]


def test_a_period_of_zero_records_nothing() -> None:
    module = logger(period=(0, 0, 0))
    module.write("log_command", 1)
    module.wait(100)

    assert [module.read("log_status"), module.read("log_last_index")] == [0, 0]
    module.write("log_period_minute", 1)
    module.wait(60)
    assert [module.read("log_status"), module.read("log_last_index")] == [1, 2]


def test_period_mode_records_from_the_start_to_the_end() -> None:
    module = logger(start=(2024, 2, 29, 12, 0, 20), end=(2024, 2, 29, 12, 0, 45))
    module.write("log_command", 2)
    assert module.read("log_status") == 0
    module.wait(20)
    assert module.read("log_status") == 1
    module.wait(1000)

    assert times(module) == [20, 30, 40, -1, -1, -1]
    assert module.read("log_status") == 0


def test_period_mode_begun_late_keeps_to_the_periods_after_the_start() -> None:
    module = logger(end=(2024, 2, 29, 12, 0, 45))
    module.write("log_start_year", 2024)
    module.ask(modbus.WriteMultipleRegisters(1, 881, (2, 29, 11, 59, 55)))
    assert [module.read("log_start_month"), module.read("log_start_second")] == [2, 55]
    module.write("log_end_second", 30)
    module.write("log_command", 2)
    module.wait(100)

    assert times(module) == [5, 15, 25, -1, -1, -1]


def test_the_window_begins_at_the_read_index() -> None:
    module = logger()
    module.write("log_command", 1)
    module.wait(90)
    module.write("log_read_index", 8)

    assert times(module) == [70, 80, 90, -1, -1, -1]


def test_records_are_read_whole() -> None:
    module = logger()

    assert len(module.ask(modbus.ReadInputRegisters(1, 1018, 36)).values) == 36
    for start, count in ((1000, 17), (1001, 18), (1000, 19)):
        assert module.ask(modbus.ReadInputRegisters(1, start, count)).exception_code == VALUE


@pytest.mark.parametrize("big_endian", [False, True])
def test_the_order_of_32_bits_follows_its_coil(big_endian: bool) -> None:  # noqa: FBT001
    module = logger()
    module.write("log_command", 1)
    module.write("big_endian", big_endian)

    words = module.ask(modbus.ReadInputRegisters(1, 1000, 18)).values

    time = (NOON & 0xFFFF, NOON >> 16)
    assert words == (HALF, *(0,) * 15, *(time[::-1] if big_endian else time))
    assert module.ask(modbus.ReadHoldingRegisters(1, 16, 2)).values == words[16:]
    assert times(module)[0] == 0


def test_a_full_logger_stops() -> None:
    module = logger(period=(0, 0, 1))
    module.write("log_command", 1)
    module.wait(10 * CAPACITY)

    assert [module.read("log_last_index"), module.read("log_status")] == [CAPACITY, 0]
    assert times(module) == [0, 1, 2, 3, 4, 5]


def test_a_full_logger_that_may_overwrite_forgets_the_oldest() -> None:
    module = logger(period=(0, 0, 1))
    module.write("log_overwrite", 1)
    module.write("log_command", 1)
    module.wait(3)
    module.wait(CAPACITY)
    assert [module.read("log_last_index"), module.read("log_status")] == [CAPACITY + 4, 1]
    assert times(module) == [-1] * 4 + [4, 5]
    module.wait(10 * CAPACITY)
    module.write("log_read_index", 11 * CAPACITY)

    assert times(module) == [
        11 * CAPACITY - 1,
        11 * CAPACITY,
        11 * CAPACITY + 1,
        11 * CAPACITY + 2,
        11 * CAPACITY + 3,
        -1,
    ]


def test_of_a_long_time_only_the_records_are_made_that_are_kept() -> None:
    module = logger(period=(0, 0, 1), overwrite=True)
    module.write("log_command", 1)
    module.wait(1e12)

    assert len(module.state.eeprom.log.records) == CAPACITY
    assert module.read("log_last_index") == (10**12 + 1) % 2**32


def test_the_logger_goes_on_after_a_power_cycle() -> None:
    module = logger()
    module.write("log_command", 1)
    module.wait(10)
    module.power_cycle()
    module.wait(10)

    assert module.read("log_last_index") == 3
    assert module.state.eeprom.log.command is LogCommand.CONTINUOUS


@pytest.mark.parametrize("command", [1, 2])
def test_nothing_is_recorded_without_power(command: int) -> None:
    module = logger(start=(2024, 2, 29, 12, 0, 0))
    module.write("log_command", command)
    module.wait(15)
    module.now += 3610
    module.power_cycle()
    module.wait(10)

    assert times(module) == [0, 10, 3630, -1, -1, -1]


@given(
    st.builds(
        Log,
        clock_offset=st.just(NOON - 1000.0),
        command=st.sampled_from(LogCommand),
        overwrite=st.booleans(),
        period=st.tuples(st.just(0), st.integers(0, 1), st.integers(0, 59)),
        start=st.tuples(st.just(2024), st.just(2), st.just(29), st.just(12), st.integers(0, 59), st.just(0)),
        end=st.tuples(st.just(2024), st.just(2), st.just(29), st.just(12), st.integers(0, 59), st.just(30)),
    ).map(lambda log: log.planned(1000.0)),
    st.lists(st.floats(1000.0, 5000.0)).map(sorted),
)
def test_how_often_the_time_is_looked_at_makes_no_difference(log: Log, moments: list[float]) -> None:
    module = bench(Model.M_7017mC_16, log=log, host_watchdog_enabled=True, host_watchdog_timeout=255)
    often = module.state
    for moment in (*moments, 5000.0):
        often = advance(often, module.signals, moment)

    assert advance(module.state, module.signals, 5000.0) == often


def test_a_clock_that_is_set_back_does_not_keep_the_logger_waiting() -> None:
    module = logger()
    module.write("log_command", 1)
    module.write("rtc_hour", 1)
    module.wait(10)

    assert times(module) == [0, -11 * 3600, 10 - 11 * 3600, -1, -1, -1]
