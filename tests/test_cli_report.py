"""``i7000 report``, and the files that are made of reports."""

import json
import os
import shutil
import subprocess
import sys
from hashlib import sha256
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from i7000.dissect.capture import Packet, packets
from tests.firmwares import FirmwarePort, Play, played
from tests.terminal import Run, plain, run
from tests.test_cli_check import LIES, SIM, lying

__all__ = ["plain", "played", "run"]

Record = dict[str, Any]


@pytest.fixture
def report(run: Run, played: Play, tmp_path: Path) -> Path:
    """A report of a module that fails a check."""
    played(FirmwarePort(lying))
    path = tmp_path / "run.jsonl"
    assert run("check", SIM, LIES, "dcon/2.14", "init/switch", "rtu", "--report", f"json={path}").code == 1
    return path


def lines(path: Path) -> list[Record]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def rewritten(path: Path, records: list[Record]) -> str:
    """Write other records, with a digest that is right."""
    *before, end = [json.dumps(record) for record in records]
    digest = sha256("".join(f"{line}\n" for line in before).encode()).hexdigest()
    text = "\n".join([*before, json.dumps({**json.loads(end), "digest": digest})])
    path.write_text(text + "\n")
    return str(path)


def test_a_report_is_shown_and_verified(run: Run, report: Path) -> None:
    told = run("report", str(report), "--verify")

    assert (told.code, told.err) == (0, "")
    assert told.out.splitlines()[0] == "I-7018 at sim:I-7018"
    assert told.out.splitlines()[1].startswith(f"FAIL           {LIES}  length at byte 5")


def test_a_changed_report_is_noticed(run: Run, report: Path) -> None:
    report.write_text(report.read_text().replace('"verdict": "FAIL"', '"verdict": "PASS"'))
    told = run("report", str(report), "--verify")

    assert (told.code, run("report", str(report)).code) == (1, 0)
    assert told.err == "i7000: changed after it was written: the digest is that of other lines\n"


def test_a_report_without_its_end_is_incomplete(run: Run, report: Path) -> None:
    report.write_text("".join(report.read_text().splitlines(keepends=True)[:-1]))
    told = run("report", str(report), "--verify")

    assert (told.code, told.err) == (1, "i7000: INCOMPLETE: the last line is missing\n")


def test_a_run_that_was_stopped_is_incomplete(run: Run, report: Path) -> None:
    records = lines(report)
    told = run("report", rewritten(report, [*records[:-1], {**records[-1], "complete": False}]), "--verify")

    assert (told.code, told.err) == (1, "i7000: INCOMPLETE: stopped before the end\n")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "this is not a report of i7000 check: it is empty"),
        ("nonsense\n", "it does not begin with a run-start"),
        ('{"record": "run-start", "schema_version": 99}\n', "it does not begin with a run-start"),
        ("[" * 100_000, "it does not begin with a run-start"),
    ],
)
def test_a_file_that_is_no_report_is_refused(run: Run, tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "run.jsonl").write_text(text)
    told = run("report", str(tmp_path / "run.jsonl"))

    assert (told.code, message in told.err) == (2, True)


def test_a_file_that_is_too_large_is_refused(run: Run, report: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("i7000.cli.report_files.LARGEST_REPORT", 1000)
    told = run("report", str(report))

    assert (told.code, "more than 1000 bytes" in told.err) == (2, True)


def test_lines_that_are_no_records_are_told(run: Run, report: Path) -> None:
    report.write_text(report.read_text() + '{"record": "more"}\n')
    told = run("report", str(report))

    assert "after the end" in told.err

    first, *rest = report.read_text().splitlines(keepends=True)
    report.write_text(first + "nonsense\n" + "".join(rest))

    assert "line 2: no JSON object" in run("report", str(report)).err


# --- junit ------------------------------------------------------------------------------------------------------------


def parsed(path: Path) -> ET.Element:
    return ET.fromstring(path.read_bytes())  # noqa: S314 - just written


def test_junit_has_the_counts_that_ci_servers_add_up(run: Run, report: Path, tmp_path: Path) -> None:
    assert run("report", str(report), "--junit", str(tmp_path / "out.xml")).code == 0
    root = parsed(tmp_path / "out.xml")

    assert root.tag == "testsuites"
    for suite in root.iter("testsuite"):
        cases = suite.findall("testcase")
        counted = [len(cases), *(len(suite.findall(f"testcase/{kind}")) for kind in ("failure", "error", "skipped"))]
        assert [int(suite.get(name) or -1) for name in ("tests", "failures", "errors", "skipped")] == counted
        assert all(case.get("classname") == suite.get("name") and float(case.get("time") or "x") >= 0 for case in cases)
    (failure,) = root.iter("failure")
    assert failure.get("type") == "FAIL"
    assert "i7000 check sim:I-7018 dcon/2.38/reply" in (failure.text or "")
    assert {case.get("name") for case in root.iter("testcase") if case.find("failure") is not None} == {"2.38/reply"}
    assert {name.get("name") for name in root.iter("property")} >= {"model", "firmware", "target", "spec_sha256"}


def test_junit_of_an_incomplete_report_has_an_error(run: Run, report: Path, tmp_path: Path) -> None:
    records = lines(report)
    records[-1]["complete"] = False
    run("report", rewritten(report, records), "--junit", str(tmp_path / "out.xml"))
    (error,) = parsed(tmp_path / "out.xml").iter("error")

    assert error.get("message") == "INCOMPLETE: stopped before the end"


# --- pytest -----------------------------------------------------------------------------------------------------------


def pytest_of(path: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(path)]
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    return subprocess.run(  # noqa: S603 - ours
        command, capture_output=True, text=True, timeout=300, check=False, cwd=path.parent, env=env
    )


def test_the_file_for_pytest_repeats_what_failed(run: Run, report: Path, tmp_path: Path) -> None:
    assert run("report", str(report), "--pytest", str(tmp_path / "test_module.py")).code == 0
    mended = pytest_of(tmp_path / "test_module.py")  # the simulated module has no fault

    assert mended.returncode == 0, mended.stdout
    assert "1 passed" in mended.stdout

    text = (tmp_path / "test_module.py").read_text()
    (tmp_path / "test_module.py").write_text(text.replace("dcon/2.38/reply", "map/coil/reset_status") + "\n")
    failed = pytest_of(tmp_path / "test_module.py")

    assert ("1 failed" in failed.stdout) or ("1 passed" in failed.stdout)


def test_a_report_without_failures_makes_a_file_without_tests(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "test_module.py"
    run("check", SIM, "link", "--report", f"pytest={path}")

    assert "FAILED = []" in path.read_text()
    assert pytest_of(path).returncode == 0


# --- pcap -------------------------------------------------------------------------------------------------------------


def test_the_capture_has_all_bytes(run: Run, report: Path, tmp_path: Path) -> None:
    run("report", str(report), "--pcap", str(tmp_path / "out.pcapng"))
    wired = "".join(record["wire"] for record in lines(report) if record["record"] == "wire" and record["check"])
    found = b"".join(packet_bytes(tmp_path / "out.pcapng"))

    assert sorted(found.hex()) == sorted(wired)


def packet_bytes(path: Path) -> list[bytes]:
    return [it.wire for it in packets([path.read_bytes()]) if isinstance(it, Packet)]


# --- the page ---------------------------------------------------------------------------------------------------------

CHROMIUM = shutil.which("chromium")


def browsed(path: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Open a page in a browser."""
    if CHROMIUM is None:
        assert os.environ.get("CI") != "true", "chromium is not installed"
        pytest.skip("chromium is not installed")
    command = [
        CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--log-level=0",
        f"--user-data-dir={path.parent / 'browser'}", *options, path.as_uri(),
    ]  # fmt: skip
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)  # noqa: S603 - a browser


HOSTILE = "</title><script>console.error(1);document.title=1</script>\"'<img src=x onerror=console.error(1)>"


def test_a_browser_shows_the_page_without_an_error(run: Run, report: Path, tmp_path: Path) -> None:
    records = lines(report)
    records[0]["target"] = records[0]["module"]["model"] = HOSTILE
    for record in records:
        if record["record"] == "check":
            record |= {"text": HOSTILE, "title": HOSTILE, "id": record["id"] + HOSTILE}
    run("report", rewritten(report, records), "--html", str(tmp_path / "page.html"))
    shown = browsed(tmp_path / "page.html", "--dump-dom")

    assert shown.returncode == 0
    assert "CONSOLE" not in shown.stderr
    assert "<title>Conformance: &lt;/title&gt;&lt;script&gt;" in shown.stdout
    assert "<script" not in shown.stdout
    assert "<img" not in shown.stdout


def test_the_page_needs_no_network(run: Run, report: Path, tmp_path: Path) -> None:
    run("report", str(report), "--html", str(tmp_path / "page.html"))
    page = (tmp_path / "page.html").read_text()

    assert not any(word in page for word in ("http:", "https:", "src=", "<script", "<link", "url(", "@import"))


def test_the_page_has_what_failed_with_the_wrong_byte_marked(run: Run, report: Path, tmp_path: Path) -> None:
    run("report", str(report), "--html", str(tmp_path / "page.html"))
    page = (tmp_path / "page.html").read_text()

    assert "1 of " in page
    assert "<mark>2b</mark>" in page
    assert "i7000 check sim:I-7018 dcon/2.38/reply" in page
    assert page.count("<details") - page.count("<details id=") == 2  # what it does not have, and its settings
    assert '<div><b>2.38</b><a class="fail"' in page
