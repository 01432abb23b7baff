"""Faults of the line as they are written at the terminal."""

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000.cli.faults import faults_words, read_faults
from i7000.simulator.faults import Faults, Way
from tests.terminal import refusal

PROBABILITIES = st.floats(0, 1, exclude_min=True)
ANYWHERE = st.sampled_from(["drop", "flip", "noise"])
OF_ANSWERS = ANYWHERE | st.sampled_from(
    [
        "late", "silent", "refuse", "replay", "misaddress", "misfunction", "corrupt", "lookalike", "trailing",
        "truncate", "duplicate", "split",
    ]
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("echo=much", "'much' is not true or false"),
        ("drop", "give a probability, such as drop=0.01"),
        ("drop=much", "give a probability"),
        ("late", "give a probability, such as late=0.1:0.25"),
        ("drop=0.1:3", "only late and split have a time, and refuse a code"),
        ("late=0.1:soon", "'late=0.1:soon': 'soon' is not a number of seconds, such as late=0.1:0.25"),
        ("split=0.1:61", "the number of seconds of split cannot be 61: 0..60"),
        ("late=0.1:61", "the number of seconds of late cannot be 61: 0..60"),
        ("flip=2", "flip cannot be 2: 0..1"),
        ("flip=nan", "flip cannot be nan: 0..1"),
        ("flip=2@01", "'flip=2@01': flip cannot be 2: 0..1"),
        ("late_by=1", "there is no fault 'late_by'"),
        ("scoped=1", "there is no fault 'scoped'"),
        ("refuse=1:0", "the code of refuse cannot be 0: 1..255"),
        ("refuse=1:FF", "'FF' is not a code, such as refuse=0.1:02h"),
        ("late=1@to", "'late=1@to': requests can only have drop, flip and noise: write late=1"),
        ("echo@01", "'echo@01': echo is for all: write echo"),
        ("drop=1@both", "after @ stands to, from or an address such as 01"),
        ("drop=1@", "after @ stands to, from or an address such as 01"),
        ("drop=1@256", "'drop=1@256': an address is 0..255 or 00h..FFh"),
        ("dropp=1", "did you mean drop?"),
    ],
)
def test_an_invalid_fault_is_refused(text: str, said: str) -> None:
    assert said in refusal(lambda: read_faults([text]))


def test_faults_add_up_and_the_last_of_a_name_counts() -> None:
    texts = ["echo", "lumps", "drop=0.1", "drop=0.2", "late=0.4:0.5", "refuse=1:02h"]

    expected = Faults(echo=True, lumps=True, drop=0.2, late=0.4, late_by=0.5, refuse=1.0, refuse_code=2)
    assert expected == read_faults(texts)


def test_a_fault_can_be_in_one_direction_or_of_one_address() -> None:
    faults = read_faults(["late=0.25:0.9@01", "drop=0.01@to", "flip=0.5@from", "late=0.1", "silent=1@1Fh"])

    assert faults == (
        Faults(late=0.1)
        .at(0x01, late=0.25, late_by=0.9)
        .at(Way.TO, drop=0.01)
        .at(Way.FROM, flip=0.5)
        .at(0x1F, silent=1.0)
    )


def test_faults_can_be_changed_and_switched_off_one_by_one() -> None:
    faults = read_faults(["echo", "late=0.1", "drop=0.01@to"])

    assert read_faults(["echo=off", "late=0", "drop=0@to"], faults) == Faults().at(Way.TO, drop=0.0)


def test_faults_are_shown_as_they_are_written() -> None:
    texts = "echo lumps drop=0.01 late=0.1:0.3 refuse=1:2 split=0.5:0.02 drop=0.01@to lumps=off@01h late=0.5:1@01h"

    assert texts == faults_words(read_faults(texts.split()))
    assert faults_words(Faults(late_by=0.5)) == "late=0:0.5"


@given(
    st.dictionaries(OF_ANSWERS, PROBABILITIES),
    st.dictionaries(ANYWHERE, PROBABILITIES),
    st.integers(0, 255),
    st.dictionaries(OF_ANSWERS, PROBABILITIES),
)
def test_what_is_shown_reads_as_the_same_faults(
    everywhere: dict[str, float], requests: dict[str, float], address: int, of_one: dict[str, float]
) -> None:
    faults = Faults(**everywhere).at(Way.TO, **requests).at(address, **of_one)  # type: ignore[arg-type]

    words = faults_words(faults)
    read = read_faults([] if words == "off" else words.split())

    assert faults == evolve(read, scoped=faults.scoped)
    assert set(faults.scoped) == set(read.scoped)
