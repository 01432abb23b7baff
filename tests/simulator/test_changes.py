"""Changes of EEPROMs in words."""

from typing import Any

import pytest
from attrs import evolve
from hypothesis import given

from i7000 import LineSettings, Model, ReportSettings, TypeCode
from i7000.device import Eeprom, Log, factory
from i7000.simulator.changes import changes
from i7000.strategies.device import eeproms

MODULE = factory(Model.I_7018Z)
K = MODULE.type_codes[1:]


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"type_codes": (TypeCode.K, *K)}, ("channel 0 type V_2_5 -> K",)),
        ({"type_codes": (TypeCode.K,) * 10}, ("type V_2_5 -> K",)),
        ({"channel_mask": 0x0F}, ("channels 3FFh -> Fh",)),
        ({"channel_offsets": (0, 0, 5, 0, 0, 0, 0, -1, 0, 0)}, (
            "channel 2 channel_offsets 0 -> 5", "channel 7 channel_offsets 0 -> -1",
        )),
        ({"name": "HOT", "address": 2}, ("name 7018Z -> HOT", "address 1 -> 2")),
        ({"line_settings": LineSettings.from_byte(0x8A)}, (
            "line_settings 06, 9600 baud, N81 -> 8A, 115200 baud, E81",
        )),
        ({"report_settings": ReportSettings(checksum=True)}, ("report_settings",)),
        ({"host_watchdog_timed_out": True, "host_watchdog_timeouts": 1}, ("watchdog tripped",)),
        ({"host_watchdog_timeouts": 1}, ("watchdog tripped",)),
        ({}, ("unchanged settings written",)),
    ],
)  # fmt: skip
def test_a_change_is_in_the_words_of_the_manual(settings: dict[str, Any], words: tuple[str, ...]) -> None:
    found = changes(MODULE, evolve(MODULE, **settings))

    assert list(words) == [one[: len(other)] for one, other in zip(found, words, strict=True)]


def test_a_watchdog_that_is_cleared_is_noticed() -> None:
    assert changes(evolve(MODULE, host_watchdog_timed_out=True), MODULE) == ("watchdog cleared",)


def test_what_only_the_logger_writes_is_no_change() -> None:
    assert changes(MODULE, evolve(MODULE, log=evolve(Log()))) == ()


@given(eeproms(Model.M_7019R), eeproms(Model.M_7019R))
def test_any_change_is_in_words_of_one_line(before: Eeprom, after: Eeprom) -> None:
    assert all(word.isprintable() for word in changes(before, after))
