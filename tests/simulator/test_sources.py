"""What is on the inputs over time: example by example, and what holds for all sources and times."""

from math import inf, nan

import attrs
import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import InvalidValueError, Model, TypeCode, Unit
from i7000.device import OPEN_WIRE, Signal, Signals, factory
from i7000.simulator.sources import (
    OPEN,
    Fixed,
    Noise,
    Ramp,
    Recorded,
    Sine,
    Source,
    Sources,
    default_sources,
)


def volts(value: float) -> Signal:
    return Signal(value, Unit.VOLT)


def values(source: Source, *numbers: int) -> list[float]:
    return [signal.value for signal in map(source.sample, numbers) if signal]


# --- all sources and times --------------------------------------------------------------------------------------------

TIMES = st.floats(0, allow_infinity=False, allow_nan=False)
NUMBERS = st.floats(-30, 30) | st.floats(allow_infinity=False, allow_nan=False)
SIZES = st.floats(0, 30) | st.floats(0, 1e306)
PERIODS = st.floats(0, exclude_min=True, allow_infinity=False)
TENTHS = st.integers(0, 10**9)
SEEDS = st.integers() | st.text()


@st.composite
def recordings(draw: st.DrawFn, units: st.SearchStrategy[Unit]) -> Recorded:
    seconds = sorted(draw(st.sets(TIMES, min_size=1, max_size=5)))
    values = NUMBERS | st.just(nan)
    return Recorded(seconds, [draw(values) for _ in seconds], draw(units))


def ramp(one: float, other: float, period: float, unit: Unit) -> Ramp:
    return Ramp(min(one, other), max(one, other), period, unit)


def sources() -> st.SearchStrategy[Source]:
    units = st.sampled_from(Unit)
    means = st.floats(-1e306, 1e306)
    return st.one_of(
        st.builds(Fixed, st.none() | st.builds(Signal, NUMBERS, units)),
        st.builds(ramp, NUMBERS, NUMBERS, PERIODS, units),
        st.builds(Sine, means, SIZES, PERIODS, units),
        st.builds(Noise, means, SIZES, units, seed=SEEDS),
        recordings(units),
    )


def junctions() -> st.SearchStrategy[Source]:
    degrees = st.builds(Sine, st.floats(-100, 100), st.floats(0, 100), PERIODS, st.just(Unit.CELSIUS))
    return degrees | st.builds(Noise, st.floats(-100, 100), st.floats(0, 25), st.just(Unit.CELSIUS))


def modules() -> st.SearchStrategy[Sources]:
    return st.builds(Sources, st.lists(sources(), max_size=4).map(tuple), junctions())


@given(modules(), TIMES)
def test_at_any_time_there_are_signals(module: Sources, seconds: float) -> None:
    signals = module.at(seconds)

    assert len(module.channels) == len(signals.channels)


@given(sources(), TENTHS)
def test_a_source_stays_within_its_extremes(source: Source, number: int) -> None:
    signal = source.sample(number)

    if signal is None:
        assert OPEN_WIRE in source.extremes
    else:
        known = [extreme.value for extreme in source.extremes if extreme]
        assert min(known) <= signal.value <= max(known)


def sampled(module: Sources, number: int) -> Signals:
    """The signals of one sample, of which nothing is remembered."""
    (junction,) = values(module.cold_junction, number)
    return Signals(tuple(source.sample(number) for source in module.channels), cold_junction=junction)


@given(modules(), st.lists(TENTHS, min_size=1, max_size=20))
def test_what_is_there_does_not_depend_on_what_was_asked_before(module: Sources, tenths: list[int]) -> None:
    assert [sampled(module, number) for number in tenths] == [module.at(number / 10) for number in tenths]


@given(modules(), TENTHS, st.floats(0, 0.99))
def test_a_sample_holds_for_a_tenth_of_a_second(module: Sources, number: int, later: float) -> None:
    number %= 10**6

    assert module.at(number / 10) is module.at((number + later) / 10)


@given(st.integers(1, 10**6), TENTHS, st.floats(-10, 10), st.floats(0, 10))
def test_what_is_periodic_repeats_exactly(period: int, number: int, low: float, span: float) -> None:
    for source in (Ramp(low, low + span, period / 10, Unit.VOLT), Sine(low, span, period / 10, Unit.VOLT)):
        assert source.sample(number) == source.sample(number + period)


@given(st.integers(2, 10**6), st.data())
def test_a_ramp_rises_until_its_period_ends(period: int, data: st.DataObject) -> None:
    ramp = Ramp(0, 10, period / 10, Unit.VOLT)
    number = data.draw(st.integers(1, period - 1))
    before, after = values(ramp, number - 1, number)

    assert before < after


# --- each source ------------------------------------------------------------------------------------------------------


def test_a_fixed_source_never_changes() -> None:
    assert values(Fixed(volts(1.5)), 0, 1_000_000) == [1.5, 1.5]


def test_an_open_wire_has_no_signal() -> None:
    assert OPEN.sample(0) is OPEN_WIRE


def test_a_ramp_starts_again_after_its_period() -> None:
    assert values(Ramp(4, 20, 40, Unit.MILLIAMPERE), 0, 100, 200, 400) == [4.0, 8.0, 12.0, 4.0]


@pytest.mark.parametrize("number", range(0, 300, 3))
def test_a_period_of_tenths_never_ends_late(number: int) -> None:
    assert values(Ramp(0, 10, 0.3, Unit.VOLT), number) == [0.0]


def test_a_ramp_may_go_from_one_end_of_all_numbers_to_the_other() -> None:
    assert values(Ramp(-1.7e308, 1.7e308, 1, Unit.VOLT), 0, 5) == [-1.7e308, 0.0]


def test_a_sine_goes_around_its_mean() -> None:
    assert pytest.approx([5.0, 7.0, 5.0, 3.0]) == values(Sine(5, 2, 4, Unit.VOLT), 0, 10, 20, 30)


def test_noise_is_another_at_each_sample() -> None:
    assert len(set(values(Noise(5, 0.1, Unit.VOLT), *range(100)))) == 100


def test_noise_of_another_seed_is_another() -> None:
    assert Noise(5, 0.1, Unit.VOLT, seed=1).sample(0) != Noise(5, 0.1, Unit.VOLT, seed=2).sample(0)


def test_noise_has_its_mean_and_its_deviation() -> None:
    found = values(Noise(5, 0.5, Unit.VOLT), *range(10_000))
    mean = sum(found) / len(found)
    deviation = (sum((value - mean) ** 2 for value in found) / len(found)) ** 0.5

    assert pytest.approx([5, 0.5], abs=0.02) == [mean, deviation]


def test_noise_is_cut_off_at_four_deviations() -> None:
    found = values(Noise(0, 1, Unit.VOLT), *range(100_000))

    assert (min(found), max(found)) == (-4.0, 4.0)


def test_a_row_holds_until_the_next_and_the_last_for_ever() -> None:
    recorded = Recorded((1.0, 2.5), (1, 2), Unit.VOLT)

    assert values(recorded, 0, 10, 24, 25, 10**12) == [1, 1, 1, 2, 2]


def test_recordings_are_equal_if_their_rows_and_units_are() -> None:
    recorded = Recorded((0.0, 1.0), (1, nan), Unit.VOLT)

    assert recorded == Recorded((0, 1), (1.0, nan), Unit.VOLT)
    assert hash(recorded) == hash(Recorded((0, 1), (1.0, nan), Unit.VOLT))
    assert recorded != Recorded((0.0, 1.0), (1, 2), Unit.VOLT)
    assert recorded != Recorded((0.0, 1.0), (1, nan), Unit.MILLIVOLT)


@pytest.mark.parametrize(
    ("values", "extremes"),
    [
        ((3, 1, 2), (volts(1), volts(3))),
        ((3, nan, 2), (volts(2), volts(3), OPEN_WIRE)),
        ((nan, nan, nan), (OPEN_WIRE,)),
    ],
)
def test_the_extremes_of_a_recording_are_the_lowest_the_highest_and_an_open_wire(
    values: tuple[float, ...], extremes: tuple[Signal | None, ...]
) -> None:
    assert extremes == Recorded((0, 1, 2), values, Unit.VOLT).extremes


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: Ramp(nan, 10, 60, Unit.VOLT), "low"),
        (lambda: Ramp(0, inf, 60, Unit.VOLT), "high"),
        (lambda: Ramp(10, 0, 60, Unit.VOLT), "high"),
        (lambda: Ramp(0, 10, 0, Unit.VOLT), "period"),
        (lambda: Ramp(0, 10, inf, Unit.VOLT), "period"),
        (lambda: Sine(inf, 1, 60, Unit.VOLT), "mean"),
        (lambda: Sine(0, -1, 60, Unit.VOLT), "amplitude"),
        (lambda: Sine(0, 1, nan, Unit.VOLT), "period"),
        (lambda: Sine(1e308, 1e308, 60, Unit.VOLT), "value"),
        (lambda: Noise(nan, 1, Unit.VOLT), "mean"),
        (lambda: Noise(0, -0.1, Unit.VOLT), "deviation"),
        (lambda: Noise(0, 1e308, Unit.VOLT), "value"),
        (lambda: Recorded((), (), Unit.VOLT), "values"),
        (lambda: Recorded((0.0,), (nan, nan), Unit.VOLT), "values"),
        (lambda: Recorded((0.0, 1.0), (nan, -inf), Unit.VOLT), "values"),
        (lambda: Recorded((-1.0,), (nan,), Unit.VOLT), "seconds"),
        (lambda: Recorded((nan,), (nan,), Unit.VOLT), "seconds"),
        (lambda: Recorded((0.0, inf), (nan, nan), Unit.VOLT), "seconds"),
        (lambda: Recorded((1.0, 1.0), (nan, nan), Unit.VOLT), "seconds"),
        (lambda: Recorded((0.0, nan, 1.0), (nan, nan, nan), Unit.VOLT), "seconds"),
    ],
)
def test_what_could_give_no_signal_is_refused_when_it_is_made(make: object, field: str) -> None:
    assert callable(make)
    with pytest.raises(InvalidValueError) as refused:
        make()

    assert field == refused.value.field


def test_a_refusal_names_value_and_what_is_allowed() -> None:
    with pytest.raises(InvalidValueError) as refused:
        Ramp(0, 10, 0, Unit.VOLT)

    assert str(refused.value) == "period cannot be 0.0: more than 0 seconds"


# --- of a module ------------------------------------------------------------------------------------------------------


def test_sources_are_frozen() -> None:
    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        Sources().channels = ()  # type: ignore[misc]


def test_equal_sources_have_the_same_signals() -> None:
    assert Sources((Fixed(volts(1)),)).at(0) is Sources((Fixed(volts(1)),)).at(7)


def test_signals_stay_the_same_object_while_a_row_holds() -> None:
    module = Sources((Recorded((0.0, 60.0), (1, 2), Unit.VOLT),))

    assert module.at(0) is module.at(59.9)
    assert module.at(59.9) is not module.at(60)


def test_the_cold_junction_changes_too() -> None:
    module = Sources(cold_junction=Ramp(20, 30, 100, Unit.CELSIUS))

    assert [module.at(seconds).cold_junction for seconds in (0, 50)] == [20.0, 25.0]


@pytest.mark.parametrize(
    "source",
    [
        OPEN,
        Fixed(volts(1)),
        Fixed(Signal(200.1, Unit.CELSIUS)),
        Ramp(-201, 0, 60, Unit.CELSIUS),
        Sine(150, 60, 60, Unit.CELSIUS),
        Noise(190, 3, Unit.CELSIUS),
        Recorded((0.0, 1.0), (25, nan), Unit.CELSIUS),
        Recorded((0.0, 1.0), (25, 201), Unit.CELSIUS),
        Recorded((0.0,), (25,), Unit.VOLT),
    ],
)
def test_a_cold_junction_that_no_module_has_is_refused(source: Source) -> None:
    with pytest.raises(InvalidValueError, match="cold_junction"):
        Sources(cold_junction=source)


@pytest.mark.parametrize("seconds", [-0.1, inf, nan])
@pytest.mark.parametrize("module", [Sources(), Sources((Noise(0, 1, Unit.VOLT),))])
def test_what_is_no_time_is_refused(module: Sources, seconds: float) -> None:
    with pytest.raises(InvalidValueError, match="seconds"):
        module.at(seconds)


# --- when nothing is said ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("model", Model)
def test_each_channel_has_another_value_within_the_span_of_its_type(model: Model) -> None:
    for code in model.type_codes:
        eeprom = attrs.evolve(made := factory(model), type_codes=(code,) * len(made.type_codes))
        signals = default_sources(eeprom).at(0)
        found = [signal.value for signal in signals.channels if signal]

        assert len(eeprom.type_codes) == len(set(found))
        assert all(max(0, code.minimum) < value < code.maximum for value in found)
        assert {code.unit} == {signal.unit for signal in signals.channels if signal}
        assert signals.cold_junction == 25.0


def test_the_values_are_those_of_the_types_of_the_channels() -> None:
    eeprom = attrs.evolve(factory(Model.M_7019R), type_codes=(TypeCode.K, *[TypeCode.V_10] * 7))

    assert default_sources(eeprom).at(0).channels[:2] == (Signal(152.4, Unit.CELSIUS), Signal(2.222, Unit.VOLT))
