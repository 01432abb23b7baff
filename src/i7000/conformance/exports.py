"""A report for other programs: JUnit for CI servers, a test file for pytest."""

import re
from collections.abc import Iterator, Mapping
from shlex import quote
from typing import Any
from xml.etree import ElementTree as ET

from i7000.conformance.report import Checked, Report, texts
from i7000.conformance.verdict import Verdict
from i7000.models import Model

__all__ = ["junit", "pytest_file", "reproduction"]

_MODELS = frozenset(model.value for model in Model)
_FAILURES = frozenset({Verdict.FAIL.value, Verdict.FLAKY.value, Verdict.PASS_GOOD_ONLY.value})
_SKIPPED = frozenset({Verdict.SKIP.value, Verdict.INCONCLUSIVE.value, Verdict.INFO.value})
_UNPRINTABLE = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""The characters that XML cannot have."""


def reproduction(report: Report, check_id: str) -> str:
    """Return the command that repeats a check of a report."""
    module = report.module
    words = ["i7000 check", quote(str(report.start.get("target"))), check_id]
    address, baud, form = module.get("address"), module.get("baud_rate"), module.get("character_format")
    if isinstance(address, int) and address != 1:
        words.append(f"--address {address}")
    if isinstance(baud, int) and baud != 9600:
        words.append(f"--baud {baud}")
    if isinstance(form, str) and form != "N81":
        words.append(f"--character-format {form}")
    allowed = texts(report.start, "allowed")
    harmful = [name for name in allowed if name not in ("observe", "memory", *(["write"] if "comm" in allowed else []))]
    words += [f"--allow {quote(name)}" for name in harmful]
    if "comm" in harmful:
        words.append("--i-can-power-cycle")
    if "calibration" in harmful:
        words.append(f"--confirm {quote(str(module.get('name')))}")
    words += _repeated(report.start)
    if report.start.get("echo") is True:
        words.append("--echo")
    return " ".join(words)


def _repeated(start: Mapping[str, Any]) -> Iterator[str]:
    """Yield the options of a run that say how it was carried out, and what the module is."""
    seed, scale = start.get("seed"), start.get("timeout_scale")
    if isinstance(seed, int) and seed:
        yield f"--seed {seed}"
    if isinstance(scale, int | float) and scale != 1:
        yield f"--timeout-scale {scale:g}"
    for option, name in (("--model", "given_model"), ("--statement", "statement")):
        text = start.get(name)
        if isinstance(text, str):
            yield f"{option} {quote(text)}"


# --- JUnit ------------------------------------------------------------------------------------------------------------


def junit(report: Report) -> str:
    """Return the report as XML for JUnit: a suite for each group, a case for each check.

    Special: what no CI server knows, INFO and INCONCLUSIVE, is skipped there, with its text, and so is a failure that
        the baseline of the run has. WARN fails if the run was strict. A report that is incomplete, or was changed, has
        a case of its own that says so.
    """
    suites = ET.Element("testsuites", name="i7000")
    by_group: dict[str, list[Checked]] = {}
    for check in report.checks:
        by_group.setdefault(check.id.partition("/")[0], []).append(check)
    for group, checks in by_group.items():
        suite = ET.SubElement(suites, "testsuite", {"name": _printable(f"i7000.{group}"), **_counts(checks, report)})
        properties = ET.SubElement(suite, "properties")
        for name, value in _properties(report):
            ET.SubElement(properties, "property", name=name, value=_printable(value))
        for check in checks:
            _case(suite, check, report)
    if report.problems:
        text = "; ".join(report.problems)
        suite = ET.SubElement(suites, "testsuite", name="i7000.report", tests="1", errors="1")
        case = ET.SubElement(suite, "testcase", classname="i7000.report", name="report")
        ET.SubElement(case, "error", message=_printable(text))
    ET.indent(suites)
    return ET.tostring(suites, encoding="unicode", xml_declaration=True) + "\n"


def _counts(checks: list[Checked], report: Report) -> dict[str, str]:
    kinds = [_kind(check, report) for check in checks]
    names = {"failures": "failure", "errors": "error", "skipped": "skipped"}
    return {"tests": str(len(kinds)), **{name: str(kinds.count(kind)) for name, kind in names.items()}}


def _kind(check: Checked, report: Report) -> str | None:
    """Return the element that says what became of a check; None if it passed."""
    if check.verdict == Verdict.ERROR.value:
        return "error"
    if check.verdict in _FAILURES or (check.verdict == Verdict.WARN.value and report.start.get("strict") is True):
        return "skipped" if check["known"] is True else "failure"
    return "skipped" if check.verdict in _SKIPPED else None


def _properties(report: Report) -> Iterator[tuple[str, str]]:
    for name in ("model", "firmware", "name", "protocol", "address"):
        yield name, str(report.module.get(name))
    for name in ("target", "version", "manual", "spec_sha256"):
        yield name, str(report.start.get(name))


def _case(suite: ET.Element, check: Checked, report: Report) -> None:
    seconds = check["seconds"]
    group, _, name = check.id.partition("/")
    case = ET.SubElement(
        suite,
        "testcase",
        classname=_printable(f"i7000.{group}"),
        name=_printable(name),
        time=f"{seconds:.3f}" if isinstance(seconds, int | float) else "0",
    )
    kind = _kind(check, report)
    if kind in ("error", "failure"):
        found = ET.SubElement(case, kind, type=check.verdict, message=_printable(str(check["text"])))
        found.text = _printable("\n".join(_words(check, report)))
    elif kind == "skipped":
        reason = check["reason"] or check.verdict
        message = f"{reason}: {check['text']}" if check.verdict in _SKIPPED else "known failure"
        ET.SubElement(case, "skipped", message=_printable(message))


def _words(check: Checked, report: Report) -> Iterator[str]:
    yield f"required: {check['requirement']} (manual {', '.join(check.texts('sections'))})"
    for name in ("wrote", "answered", "sent", "received", "expected"):
        if check[name] is not None:
            yield f"{name}: {check[name]}"
    yield reproduction(report, check.id)


def _printable(text: str) -> str:
    """Return a text in characters that XML can have."""
    return _UNPRINTABLE.sub("?", text)


# --- pytest -----------------------------------------------------------------------------------------------------------

_HEAD = '''"""The checks that {what} did not pass, as tests for pytest.

They need the module at `TARGET`; the environment variable I7000_TARGET names another one.
"""

import os
import shlex
import subprocess
import sys

import pytest

TARGET = os.environ.get("I7000_TARGET", {target!r})
OPTIONS = {options!r}
FAILED = {failed}


@pytest.mark.parametrize("check", FAILED)
def test_the_module_passes(check: str) -> None:
    command = [sys.executable, "-m", "i7000", "check", TARGET, check, *shlex.split(OPTIONS)]
    found = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)
    assert found.returncode == 0, found.stdout + found.stderr
'''


def pytest_file(report: Report) -> str:
    """Return a file for pytest that repeats what did not pass."""
    failed = [check.id for check in report.checks if check.verdict in _FAILURES]
    target = str(report.start.get("target"))
    options = reproduction(report, "").removeprefix(f"i7000 check {quote(target)} ").strip()
    model = str(report.module.get("model"))
    rows = "".join(f"    {check!r},\n" for check in failed)
    return _HEAD.format(
        what=model if model in _MODELS else "the module",
        target=target,
        options=options,
        failed=f"[\n{rows}]" if rows else "[]",
    )
