"""Reports of odd content: they are read, and made into other files, without an error."""

import ast
import json
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import dcon, modbus
from i7000.conformance.exports import junit, pytest_file, reproduction
from i7000.conformance.html import page
from i7000.conformance.replay import Readings
from i7000.conformance.report import ReportError, read_report

PARTS = ["Expr", "Import", "Import", "Import", "Import", "Import", "Assign", "Assign", "Assign", "FunctionDef"]
"""What a file for pytest has, and nothing else, whatever the report holds."""
START: dict[str, Any] = {"record": "run-start", "schema_version": 1}
PLAIN = st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(max_size=8)
ANYTHING = st.recursive(
    PLAIN, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner, max_size=3)
)
NAMES = st.sampled_from(
    ("record", "id", "verdict", "seconds", "title", "sections", "errata", "reason", "text", "sent", "received", "right",
     "repeats", "expected", "check", "from", "wire", "target", "allowed", "seed", "module", "counts", "restored",
     "left_changed", "silent", "complete", "given_model", "statement", "echo", "timeout_scale",
     "time")
)  # fmt: skip
KINDS = st.sampled_from(("wire", "check", "run-end"))
RECORDS = st.builds(
    lambda kind, fields: {**fields, "record": kind, "id": "link/a"}, KINDS, st.dictionaries(NAMES, ANYTHING, max_size=6)
)


def made(start: dict[str, Any], *records: dict[str, Any]) -> str:
    report = read_report(json.dumps(it) for it in ({**start, **START}, *records))
    ET.fromstring(junit(report).encode("utf-8", "backslashreplace"))  # noqa: S314 - just made
    assert [type(node).__name__ for node in ast.parse(pytest_file(report)).body] == PARTS
    return page(report) + reproduction(report, "link/a")


@given(st.dictionaries(NAMES, ANYTHING, max_size=6), st.lists(RECORDS, max_size=4))
def test_whatever_a_report_holds_it_is_shown(start: dict[str, Any], records: list[dict[str, Any]]) -> None:
    assert "</html>" in made(start, *records)


@given(st.lists(st.text(max_size=20), max_size=3))
def test_whatever_a_file_holds_it_is_a_report_or_none(lines: list[str]) -> None:
    with pytest.raises(ReportError):
        read_report(lines)


HOSTILE = '"""\nimport os\nos.abort()\n"""\x00\x1b\ud800{}'


def test_hostile_text_stays_text() -> None:
    start = {"target": HOSTILE, "module": {"model": HOSTILE, "name": HOSTILE}, "allowed": [HOSTILE]}
    record = {"record": "check", "id": HOSTILE, "verdict": "FAIL", "text": HOSTILE, "reason": HOSTILE}

    assert "</html>" in made(start, record, {**record, "verdict": "SKIP"}, {**record, "verdict": HOSTILE})


def check(verdict: str, **more: Any) -> dict[str, Any]:
    return {"record": "check", "id": f"link/{verdict.lower()}", "verdict": verdict, **more}


def end(**more: Any) -> dict[str, Any]:
    return {"record": "run-end", "complete": True, **more}


@pytest.mark.parametrize(
    ("records", "words"),
    [
        ([end()], "nothing was decided"),
        ([check("PASS"), end()], "all that ran passed"),
        ([check("PASS")], "INCOMPLETE: all that ran passed"),
        ([check("FAIL"), end()], "1 of 1 checks did not pass"),
        ([check("PASS"), end(left_changed=["name"])], "the module was left changed: name"),
        ([check("PASS"), end(silent=True)], "the module does not answer any more"),
        ([check("PASS"), end(restored=["name"])], "restored: name"),
        ([check("INFO", text="it is so", errata=["E27"]), end()], "Open points of the manual"),
        ([check("FLAKY", repeats=["PASS"]), end()], "<th>repeated</th><td>PASS</td>"),
        ([check("FAIL", text="x", sent="zz", received="21ff", right="21ff"), end()], "<code>21 ff</code>"),
        ([check("FAIL", received="213132", right="213232"), end()], "<code>21 <mark>31</mark> 32  !12</code>"),
    ],
)
def test_the_page_says_what_became_of_the_run(records: list[dict[str, Any]], words: str) -> None:
    assert words in page(read_report(json.dumps(it) for it in (START, *records)))


def test_a_long_log_is_cut() -> None:
    wires = [
        {"record": "wire", "check": "link/pass", "seconds": at, "from": ("host", "module")[at % 2], "wire": "24"}
        for at in range(300)
    ]

    assert "<p class=soft>and 100 more</p>" in page(read_report(map(json.dumps, (START, *wires, check("PASS")))))


def test_the_command_that_repeats_a_check_has_all_options() -> None:
    start = {
        **START, "target": "/dev/tty USB", "seed": 5, "timeout_scale": 2.5, "given_model": "M-7018", "echo": True,
        "statement": "my module.json",
        "allowed": ["observe", "memory", "broadcast", "write", "comm", "calibration"],
        "module": {"address": 2, "baud_rate": 115200, "character_format": "E81", "name": "my name"},
    }  # fmt: skip
    command = reproduction(read_report([json.dumps(start)]), "link/alive")

    assert command == (
        "i7000 check '/dev/tty USB' link/alive --address 2 --baud 115200 --character-format E81 --allow broadcast"
        " --allow comm --allow calibration --i-can-power-cycle --confirm 'my name' --seed 5 --timeout-scale 2.5"
        " --model M-7018 --statement 'my module.json' --echo"
    )


@pytest.mark.parametrize(
    ("sent", "recorded", "received", "same"),
    [
        (b"#01\r", b">+1.0\r", b">-2.0\r", True),
        (b"#013\r", b">+1.0\r", b">+10.\r", True),
        (b"$01A\r", b">7FFF\r", b">0000\r", True),
        (b"$014\r", b">010+1.0\r", b">011+2.0\r", True),
        (b"$014\r", b">010+1.0\r", b">020+1.0\r", False),
        (b"$013\r", b">+0025.0\r", b">+0026.1\r", True),
        (b"~02\r\x00x#01\r", b">+1.0\r", b">+2.0\r", True),
        (b"#01\r", b">+1.0\r", b">+2\r", False),
        (b"#01\r", b">+1.0   \r", b">+1.0+1.\r", False),
        (b"#01\r", b">+1.0\r", b"", False),
        (b"#01\r", b">+1.0\r", b"!+1.0\r", False),
        (b"#01\r", b">+1.0\r", b">X1.0\r", False),
        (b"#01", b">+1.0\r", b">+2.0\r", False),
        (b"01\r", b">+1.0\r", b">+2.0\r", False),
        (b"$012\r", b">0506\r", b">0507\r", False),
        (b"~012\r", b">+1.0\r", b">+2.0\r", False),
        (b"", b">+1.0\r", b">+2.0\r", False),
    ],
)
def test_only_readings_may_differ_in_a_replay(sent: bytes, recorded: bytes, received: bytes, *, same: bool) -> None:
    readings = Readings.of(read_report([json.dumps({**START, "module": {"protocol": "dcon"}})]))

    assert readings.are_alike(sent, recorded, received) is same


def test_the_checksum_of_a_reading_may_differ_but_must_be_right() -> None:
    readings = Readings.of(read_report([json.dumps({**START, "module": {"protocol": "dcon", "checksum": True}})]))
    sent, one, other = (dcon.seal(body, checksum=True) for body in (b"#01", b">+1.0", b">+2.0"))

    assert readings.are_alike(sent, one, other)
    assert not readings.are_alike(sent, one, other[:-3] + one[-3:])


@pytest.mark.parametrize(
    ("request_body", "recorded", "received", "same"),
    [
        ("01 04 0000 0001", "01 04 02 0001", "01 04 02 0002", True),
        ("01 03 0000 0002", "01 03 04 0001 0001", "01 03 04 0001 0002", True),
        ("01 04 0080 0001", "01 04 02 0001", "01 04 02 0002", True),
        ("01 04 0000 0001", "01 04 02 0001", "01 84 02", False),
        ("01 04 0000 0001", "01 04 02 0001", "02 04 02 0001", False),
        ("01 04 0000 0001", "01 04 02 0001", "01 04 04 0001 0001", False),
        ("01 03 01E5 0001", "01 03 02 0001", "01 03 02 0002", False),
        ("01 03 0007 0005", "01 03 0a 0001 0001 0001 0001 0001", "01 03 0a 0001 0001 0001 0001 0002", False),
        ("01 01 0000 0001", "01 01 01 01", "01 01 01 00", False),
        ("01 46 00 00 00 00", "01 46 00 00 00 00", "01 46 00 00 00 01", False),
    ],
)
def test_only_registers_that_are_measured_may_differ(
    request_body: str, recorded: str, received: str, *, same: bool
) -> None:
    module = {"protocol": "rtu", "model": "M-7018"}
    readings = Readings.of(read_report([json.dumps({**START, "module": module})]))
    sent, one, other = (modbus.seal(bytes.fromhex(text)) for text in (request_body, recorded, received))

    assert readings.are_alike(b"\x01\x04" + sent, one, other) is same
    assert not readings.are_alike(sent, one, other[:-1] + bytes((other[-1] ^ 1,)))
    assert not Readings.of(read_report([json.dumps({**START, "module": {"protocol": "rtu"}})])).are_alike(
        sent, one, other
    )
