"""What is on the inputs of simulated modules, as it is said on the command line."""

from math import nan
from pathlib import Path
from unittest.mock import Mock

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Model, Unit
from i7000.cli import signals as reading
from i7000.cli.module import read_module
from i7000.cli.signals import read_signals
from i7000.device import Eeprom, Signal, factory
from i7000.simulator.recordings import read_recording
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
from tests.terminal import refusal


def module(text: str) -> Eeprom:
    return read_module(text, 0x01).eeprom


# --- signals ----------------------------------------------------------------------------------------------------------

VOLTS, AMPERES, DEGREES = factory(Model.I_7017), module("M-7019R,address=0Ah,type=MA_4_20"), module("I-7018,type=K")


def signals(*texts: str, eeprom: Eeprom = VOLTS) -> Sources:
    (found,) = read_signals(texts, [eeprom])
    return found


def refusal_of_signals(*texts: str) -> str:
    return refusal(lambda: signals(*texts))


def test_settings_that_are_not_given_have_the_default() -> None:
    assert (default_sources(VOLTS), default_sources(AMPERES)) == read_signals([], [VOLTS, AMPERES])


@pytest.mark.parametrize(
    ("text", "source"),
    [
        ("1.5V", Fixed(Signal(1.5, Unit.VOLT))),
        ("-1.5", Fixed(Signal(-1.5, Unit.VOLT))),
        (" .5 v ", Fixed(Signal(0.5, Unit.VOLT))),
        ("500mV", Fixed(Signal(500, Unit.MILLIVOLT))),
        ("4mA", Fixed(Signal(4, Unit.MILLIAMPERE))),
        ("25degC", Fixed(Signal(25, Unit.CELSIUS))),
        ("25°C", Fixed(Signal(25, Unit.CELSIUS))),
        ("1e-3C", Fixed(Signal(0.001, Unit.CELSIUS))),
        ("open", OPEN),
        ("Open", OPEN),
        ("ramp:0:10:60", Ramp(0, 10, 60, Unit.VOLT)),
        ("ramp:0V:10V:60s", Ramp(0, 10, 60, Unit.VOLT)),
        ("ramp:0:10mV:60", Ramp(0, 10, 60, Unit.MILLIVOLT)),
        ("RAMP:0mV:10:0.5", Ramp(0, 10, 0.5, Unit.MILLIVOLT)),
        ("sine:5:2.5:3600", Sine(5, 2.5, 3600, Unit.VOLT)),
        ("sine:5mA:1:10", Sine(5, 1, 10, Unit.MILLIAMPERE)),
        ("noise:5:0.1", Noise(5, 0.1, Unit.VOLT, seed="0.0.3")),
        ("noise:5mA:0.1mA", Noise(5, 0.1, Unit.MILLIAMPERE, seed="0.0.3")),
    ],
)
def test_a_signal_is_the_one_that_was_given(text: str, source: Source) -> None:
    assert source == signals(f"3={text}").channels[3]


@pytest.mark.parametrize(
    ("text", "channels"),
    [
        ("0", {0}),
        ("0-3", {0, 1, 2, 3}),
        ("0,2,5", {0, 2, 5}),
        ("0-1, 7", {0, 1, 7}),
        ("01:7", {7}),
        ("0x01:7", {7}),
        ("ALL", set(range(8))),
        ("1:all", set(range(8))),
        (":0", {0}),
    ],
)
def test_channels_are_numbers_ranges_or_all(text: str, channels: set[int]) -> None:
    found = signals(f"{text}=open").channels

    assert channels == {channel for channel, source in enumerate(found) if source is OPEN}


def test_the_cold_junction_has_a_name() -> None:
    found = signals("cjc=ramp:20:30:60")

    assert Sources(default_sources(VOLTS).channels, Ramp(20, 30, 60, Unit.CELSIUS)) == found


def test_a_plain_number_has_the_unit_of_the_type_of_each_channel() -> None:
    eeprom = module("M-7019R,type=K/V_10/MV_100/MA_4_20/K/K/K/K")
    found = signals("0-3=5", eeprom=eeprom).at(0).channels[:4]

    assert found == tuple(Signal(5, unit) for unit in (Unit.CELSIUS, Unit.VOLT, Unit.MILLIVOLT, Unit.MILLIAMPERE))


def test_later_ones_count() -> None:
    found = signals("all=1", "2=2", "2-3=open").channels

    assert (Fixed(Signal(1, Unit.VOLT)), OPEN, OPEN) == found[1:4]


def test_an_address_selects_the_modules_that_have_it() -> None:
    found = read_signals(["10:0=open", "1=open"], [VOLTS, AMPERES, AMPERES])

    assert [sources.channels[0] is OPEN for sources in found] == [False, True, True]
    assert [sources.channels[1] is OPEN for sources in found] == [True, True, True]


def test_each_noise_is_another() -> None:
    found = read_signals(["all=noise:5mV:1", "cjc=noise:25:1"], [VOLTS, AMPERES], seed=7)
    noises = {source for sources in found for source in (*sources.channels, sources.cold_junction)}

    assert len(noises) == 18


def test_the_same_seed_has_the_same_noise() -> None:
    first, again, other = (read_signals(["0=noise:5:1"], [VOLTS], seed=seed) for seed in (1, 1, 2))

    assert first == again
    assert first != other


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "'': write [ADDRESS:]CHANNELS=SIGNAL, such as 0=1.5V"),
        ("0:1.5V", "'0:1.5V': write [ADDRESS:]CHANNELS=SIGNAL, such as 0=1.5V"),
        ("02:0=1V", "'02:0=1V': no module has the address 02, only 01"),
        ("xyz:0=1V", "'xyz:0=1V': 'xyz' is not a whole number"),
        ("=1V", "'=1V': I-7017 at 01: '' is not a channel: give 0..7, a range such as 0-7, or all; or cjc"),
        ("8=1V", "'8=1V': I-7017 at 01: there is no channel 8: 0..7; or cjc"),
        ("3-1=1V", "'3-1=1V': I-7017 at 01: there is no channel 3-1: 0..7"),
        ("0-999=1V", "'0-999=1V': I-7017 at 01: there is no channel 0-999: 0..7"),
        ("0=", "'0=': '' is not a quantity: give a number, with mV, V, mA, degC or no unit"),
        ("0=1W", "'0=1W': '1W' is not a quantity"),
        ("0=1e999", "'0=1e999': '1e999' is not a quantity"),
        ("0=1:2", "'0=1:2': '1:2' is not a quantity"),
        ("0=rmap:0:1:2", "'0=rmap:0:1:2': 'rmap:0:1:2' is not a signal: give a quantity such as 1.5V, ramp:"),
        ("0=ramp:0:1", "'0=ramp:0:1': 'ramp:0:1' is not ramp:LOW:HIGH:SECONDS"),
        ("0=open:1", "'0=open:1': 'open:1' is not open"),
        ("0=ramp:0V:1mV:60", "'0=ramp:0V:1mV:60': 0V and 1mV have different units"),
        ("0=ramp:0:1:60V", "'0=ramp:0:1:60V': '60V' is not a time: give seconds without a unit"),
        ("0=ramp:0:1:0", "'0=ramp:0:1:0': period cannot be 0.0: more than 0 seconds"),
        ("0=ramp:1:0:1", "'0=ramp:1:0:1': high cannot be 0.0: 1 or more"),
        ("0=sine:0:-1:1", "'0=sine:0:-1:1': amplitude cannot be -1.0: 0 or more"),
        ("0=noise:0:-1", "'0=noise:0:-1': deviation cannot be -1.0: 0 or more"),
        ("cjc=open", "'cjc=open': cjc must be a temperature in degC"),
        ("cjc=1V", "'cjc=1V': cjc must be a temperature in degC"),
        ("cjc=201", "'cjc=201': cjc must be -200..200 degC"),
        ("0=csv", "'0=csv': 'csv' is not csv:FILE"),
        ("0=csv:/no/such/file", "'0=csv:/no/such/file': /no/such/file: No such file or directory"),
        ("0=csv:\0", "'0=csv:\\x00': \0: embedded null byte"),
    ],
)  # fmt: skip
def test_a_signal_that_there_is_not_is_refused_with_the_reason(text: str, message: str) -> None:
    assert refusal_of_signals(text).startswith(message)


def test_a_misspelt_signal_is_answered_with_suggestions() -> None:
    assert refusal_of_signals("0=nois:1:1").endswith("; did you mean noise?")


PIECES = st.sampled_from(
    ("0", "all", "cjc", "=", ":", "open", "ramp", "sine", "noise", "1V", "25", "-", ",", "5mA", "1e308", "degC", "s")
)


@given(st.lists(PIECES | st.text(max_size=3), max_size=10).map("".join).filter(lambda text: "csv" not in text.lower()))
def test_any_text_is_a_signal_or_refused(text: str) -> None:
    message = refusal(lambda: signals(text).at(12.3))

    assert not message or message.startswith(repr(text))


# --- recordings -------------------------------------------------------------------------------------------------------


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    file = tmp_path / "a=b:c.csv"
    file.write_bytes(b"\xef\xbb\xbfseconds,0,1,cold_junction\r\n0,1.5,2.5,25\r\n60,open,3.5,30\r\n")
    return file


def test_a_recording_plays_the_columns_of_the_channels_named(recording: Path) -> None:
    found = signals(f"0-1=csv:{recording}")

    assert (
        Recorded((0.0, 60.0), (1.5, nan), Unit.VOLT),
        Recorded((0.0, 60.0), (2.5, 3.5), Unit.VOLT),
    ) == found.channels[:2]
    assert default_sources(VOLTS).channels[2:] == found.channels[2:]
    assert found.at(60).cold_junction == 25.0


def test_a_recording_plays_the_cold_junction_where_it_is_named(recording: Path) -> None:
    assert [signals(f"cjc=csv:{recording}").at(seconds).cold_junction for seconds in (59.9, 60)] == [25.0, 30.0]


def test_a_recording_has_the_units_of_the_types(recording: Path) -> None:
    assert Signal(1.5, Unit.CELSIUS) == signals(f"0=CSV:{recording}", eeprom=DEGREES).at(0).channel(0)


def test_a_recording_is_read_once_for_modules_of_the_same_types(
    recording: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = Mock(wraps=read_recording)
    monkeypatch.setattr(reading, "read_recording", read)

    found = read_signals([f"0=csv:{recording}"], [VOLTS, VOLTS, DEGREES])

    assert read.call_count == 2
    assert found[0].channels[0] is found[1].channels[0] != found[2].channels[0]


def test_a_recording_that_cannot_be_read_is_refused_with_file_and_line(tmp_path: Path) -> None:
    file = tmp_path / "recording.csv"
    file.write_text("seconds,0\n0,1\n1,x\n")

    message = refusal_of_signals(f"0=csv:{file}")

    assert message == f"'0=csv:{file}': {file}: line 3: 0 cannot be 'x': a number as 12.5 or -1e-3, or open"


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/full", "/dev/stdin"])
def test_a_device_is_no_recording(device: str) -> None:
    assert refusal_of_signals(f"0=csv:{device}") == (
        f"'0=csv:{device}': {device} is a device or pipe; allowed: a regular file"
    )


def test_a_directory_is_no_recording(tmp_path: Path) -> None:
    assert refusal_of_signals(f"0=csv:{tmp_path}").endswith(f"{tmp_path}: Is a directory")


@given(st.binary(max_size=40))
def test_any_file_is_a_recording_or_refused(tmp_path_factory: pytest.TempPathFactory, content: bytes) -> None:
    file = tmp_path_factory.getbasetemp() / "any.csv"
    file.write_bytes(b"seconds,0\n" + content)
    text = f"0=csv:{file}"
    message = refusal(lambda: signals(text).at(12.3))

    assert not message or message.startswith(f"{text!r}: {file}: ")
