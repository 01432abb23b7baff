"""Recordings in CSV files: what is read, and what is refused with the number of its line."""

import csv
import subprocess
import sys
from math import nan
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import InvalidValueError, Unit
from i7000.simulator import recordings
from i7000.simulator.files import UnsuitableFileError
from i7000.simulator.recordings import read_recording
from i7000.simulator.sources import Recorded

VOLTS = {"0": Unit.VOLT}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "recording.csv"


def read(path: Path, content: str | bytes) -> dict[str, Recorded]:
    path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass"))
    return read_recording(path, VOLTS)


def refusal(path: Path, content: str | bytes) -> str:
    with pytest.raises(InvalidValueError) as refused:
        read(path, content)
    return str(refused.value)


# --- what is read -----------------------------------------------------------------------------------------------------


def test_a_recording_has_a_source_for_each_column(path: Path) -> None:
    path.write_text("\n\nseconds,0,cold_junction\n0,1.5,25\n\n 2.5 , open , 26 \n")

    found = read_recording(path, {"0": Unit.VOLT, "cold_junction": Unit.CELSIUS})

    assert found == {
        "0": Recorded((0.0, 2.5), (1.5, nan), Unit.VOLT),
        "cold_junction": Recorded((0.0, 2.5), (25, 26), Unit.CELSIUS),
    }


def test_the_columns_of_a_recording_share_its_times(path: Path) -> None:
    path.write_text("seconds,0,1\n0,1,2\n")

    found = read_recording(path, {"0": Unit.VOLT, "1": Unit.VOLT})

    assert found["0"].seconds is found["1"].seconds


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_lines_end_in_any_manner(path: Path, end: str) -> None:
    content = f"\ufeffseconds,0{end}0,1.5{end}1,2.5"

    assert read(path, content) == {"0": Recorded((0.0, 1.0), (1.5, 2.5), Unit.VOLT)}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1.0), ("+1.", 1.0), ("-.5", -0.5), ("1e3", 1000.0), ("12.5E-1", 1.25), (" 7\t", 7.0), ('"1.5"', 1.5),
        ("open", nan), (" open", nan), ('"open"', nan), ("1e-999", 0.0), ("9" * 308, float("9" * 308)),
    ],
)  # fmt: skip
def test_a_value_is_a_number_or_open(path: Path, text: str, value: float) -> None:
    assert read(path, f"seconds,0\n0,{text}\n") == {"0": Recorded((0.0,), (value,), Unit.VOLT)}


@pytest.mark.parametrize(
    "note", ["door open", '"a, b"', '"he said ""no"""', 'inch"', ' "x"', "\x00", "é", "", "1_000", b"\xff\xe9"]
)
def test_columns_that_are_not_asked_for_may_hold_anything(path: Path, note: str | bytes) -> None:
    cell = note if isinstance(note, bytes) else note.encode()

    found = read(path, b"seconds,note,0,note\n0,%s,1.5,%s\n1,,2.5,\n" % (cell, cell))

    assert found == {"0": Recorded((0.0, 1.0), (1.5, 2.5), Unit.VOLT)}


def test_blocks_end_anywhere(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    content = "seconds,0,note\n" + "".join(f"{row},{'open' if row % 7 == 0 else row},\n" for row in range(100))
    whole = read(path, content)

    for size in range(len("seconds,0,note") + 1, 40):
        monkeypatch.setattr(recordings, "_BLOCK", size)
        assert read(path, content) == whole


CELLS = st.sampled_from(("1", "-.5", " 2 ", "open", " open", '"3"', "1e3", '"a, b"', "", "x", "1_0", "1e999"))


@given(rows=st.lists(st.tuples(CELLS, CELLS), min_size=1, max_size=4), odd=st.sampled_from(("", "\n", '0.5,"0",\n')))
def test_rows_are_read_alike_whatever_stands_beside_them(
    tmp_path_factory: pytest.TempPathFactory, rows: list[tuple[str, str]], odd: str
) -> None:
    path = tmp_path_factory.getbasetemp() / "beside.csv"
    lines = "".join(f"{number + 1},{value},{note}\n" for number, (value, note) in enumerate(rows))

    def outcome(content: str) -> object:
        try:
            return list(read(path, content)["0"].values)[-len(rows) :]
        except InvalidValueError as refused:
            return refused.value

    assert repr(outcome(f"seconds,0,note\n{lines}")) == repr(outcome(f"seconds,0,note\n{odd}{lines}"))


# --- what is refused --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("\n", "line 1: the columns are none: they must include seconds"),
        ("\n0,1", "line 2: the columns are 0, 1: they must include seconds"),
        ("seconds;0\n0;1", "line 1: the columns are seconds;0: they must include seconds"),
        ("seconds,1\n0,1", "line 1: the columns are seconds, 1: they must include 0"),
        ("seconds,0,0\n0,1,2", "line 1: the columns are seconds, 0, 0: 0 must be there once, not twice"),
        ("seconds,0,0,0", "line 1: the columns are seconds, 0, 0, 0: 0 must be there once, not 3 times"),
        ("seconds,0", "line 1: no rows follow: at least one"),
        ("seconds,0\n\n\n", "line 1: no rows follow: at least one"),
        ("seconds,0\nx,1", "line 2: seconds cannot be 'x': a number as 12.5 or -1e-3"),
        ("seconds,0\nopen,1", "line 2: seconds cannot be 'open': a number as 12.5 or -1e-3"),
        ("seconds,0\n1e999,1", "line 2: seconds cannot be '1e999': a number as 12.5 or -1e-3"),
        ("seconds,0\n-1,1", "line 2: seconds cannot be -1.0: 0 or more"),
        ("seconds,0\n0,1\n\n0,1", "line 4: seconds cannot be 0.0: more than the 0 before"),
        ("seconds,0\n0,1\n2,1\n1,1", "line 4: seconds cannot be 1.0: more than the 2 before"),
        ('seconds,0\n0,"1', "line 2: unexpected end of data: values with commas between"),
        ("seconds,0\n0,5,1,2", "line 2: there are 4 values: one for each of 2 columns, decimals with a point"),
        ("seconds,0\n0,1\n1,1,\n", "line 3: there are 3 values: one for each of 2 columns, decimals with a point"),
        ("seconds,0\n0,1\n1\n", "line 3: there are 1 values: one for each of 2 columns, decimals with a point"),
    ],
)
def test_a_recording_that_cannot_be_read_names_line_and_reason(path: Path, content: str, message: str) -> None:
    assert message == refusal(path, content)


@pytest.mark.parametrize(
    "text",
    [
        "", "nan", "inf", "-Infinity", "1e999", "-1e999", "1_000", "1 000", "0x10", "1e", ".", "+", "--1", "+open",
        "OPEN", "\N{FULLWIDTH DIGIT ONE}", "1\N{ARABIC DECIMAL SEPARATOR}5",
    ],
)  # fmt: skip
def test_what_is_no_number_is_refused(path: Path, text: str) -> None:
    message = refusal(path, f"seconds,0\n0,1\n1,{text}\n2,1\n")

    assert message == f"line 3: 0 cannot be {text!r}: a number as 12.5 or -1e-3, or open"


def test_a_decimal_comma_in_quotes_is_refused(path: Path) -> None:
    message = refusal(path, 'seconds,0\n0,"1,5"\n')

    assert message == "line 2: 0 cannot be '1,5': a number as 12.5 or -1e-3, or open"


def test_bytes_that_are_not_utf_8_are_no_number(path: Path) -> None:
    assert refusal(path, b"seconds,0\n0,\xff\n").startswith(r"line 2: 0 cannot be '\udcff'")


def test_times_rise_from_block_to_block(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recordings, "_BLOCK", len("seconds,0\n"))

    message = refusal(path, "seconds,0\n1,1.000\n2,1.000\n2,1.000\n")

    assert message == "line 4: seconds cannot be 2.0: more than the 2 before"


def test_a_line_that_is_too_long_is_refused(path: Path) -> None:
    message = refusal(path, "seconds,0\n0,1\n1," + "1" * 200_000)

    assert message == "line 3: it is too long: 65536 characters"


def test_more_rows_than_a_recording_may_have_are_refused(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recordings, "MOST_ROWS", 2)
    rows = "seconds,0\n0,1\n1,1\n"

    assert len(read(path, rows)["0"].seconds) == 2
    assert refusal(path, rows + "2,1\n") == "line 4: there are too many rows: 2 rows"


def test_a_file_that_is_too_large_is_refused(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(10**10)

    with pytest.raises(UnsuitableFileError, match="has 10000 MB; allowed: 200 MB"):
        read_recording(path, VOLTS)


@given(st.lists(st.text(alphabet="0123456789.,eopn\"' \n") | st.text(), max_size=8))
def test_any_lines_are_a_recording_or_refused(tmp_path_factory: pytest.TempPathFactory, lines: list[str]) -> None:
    path = tmp_path_factory.getbasetemp() / "any-lines.csv"
    refused = "line"
    try:
        read(path, "\n".join(("seconds,0", *lines)))
    except InvalidValueError as error:
        refused = str(error)

    assert refused.startswith("line")


# --- how much it takes ------------------------------------------------------------------------------------------------

MEASURED = """\
import sys
from resource import RUSAGE_SELF, getrusage
from i7000 import Unit
from i7000.simulator.recordings import read_recording
before = getrusage(RUSAGE_SELF)
rows = len(read_recording(sys.argv[1], {"0": Unit.VOLT})["0"].seconds)
after = getrusage(RUSAGE_SELF)
sum(1 for _ in range(10_000_000))
counted = getrusage(RUSAGE_SELF)
time = (after.ru_utime - before.ru_utime) / (counted.ru_utime - after.ru_utime)
print(rows, time, (after.ru_maxrss - before.ru_maxrss) / 1024)
"""


@pytest.mark.no_cover
def test_a_million_rows_take_little_time_and_memory(path: Path) -> None:
    """As much as counting to 40 million, and 40 MB: a start in 3 s within 100 MB, on any machine."""
    with path.open("w") as file:
        csv.writer(file).writerows([("seconds", "0"), *((row / 10, row % 997 / 100) for row in range(1_000_000))])

    told = subprocess.run([sys.executable, "-c", MEASURED, path], capture_output=True, text=True, check=True)  # noqa: S603
    rows, time, megabytes = map(float, told.stdout.split())

    assert rows == 1_000_000
    assert time < 4
    assert megabytes < 40
