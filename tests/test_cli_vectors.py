"""``i7000 vectors``: an implementation in another process, its verdicts and reports."""

import json
import re
import signal
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from jsonschema import Draft202012Validator

from i7000 import spec
from i7000.cli import codec_process, codec_run
from i7000.cli.codec_process import CodecProcess
from i7000.cli.vector_files import all_vectors
from i7000.conformance.vector_verdicts import MessageError, Reason, Verdict
from tests.interop import program
from tests.spec.lint import SPEC, Record
from tests.terminal import Run, Told
from tests.waiting import ENOUGH

HOSTILE = str(Path(__file__).parent / "conformance" / "hostile.py")
NODE = str(Path(__file__).parents[1] / "docs" / "examples" / "vectors.js")
OURS = (sys.executable, "-m", "i7000.examples.vector_runner")
CASE = "checksum-manual-2"
BOTH = ("checksums", "crc")
COUNT = 38
"""The vectors of `BOTH`."""

Hostile = Callable[..., Told]


@pytest.fixture
def hostile(run: Run) -> Hostile:
    """Run vectors of frames against a codec with a certain behaviour."""

    def call(behaviour: str, *options: str, case: str = CASE, select: tuple[str, ...] = BOTH) -> Told:
        return run("vectors", *select, "--json", *options, "--", sys.executable, HOSTILE, behaviour, case)

    return call


def verdicts(told: Told) -> Counter[str]:
    return Counter(record["verdict"] for record in told.records if record["record"] == "vector")


def the_only(told: Told, verdict: str) -> Record:
    """The vector with a verdict that no other has; all the others have passed."""
    (found,) = (record for record in told.records if record.get("verdict") == verdict)
    assert verdicts(told) == {verdict: 1, "PASS": COUNT - 1}
    return found


# --- implementations --------------------------------------------------------------------------------------------------


@pytest.mark.no_cover
def test_our_codec_passes_every_vector_of_every_file(run: Run) -> None:
    told = run("vectors", "--json", "--", *OURS)
    start, *found, end = told.records

    assert told.code == 0
    assert verdicts(told) == {"PASS": len(all_vectors())}
    assert [vector.id for vector in all_vectors()] == [record["id"] for record in found]
    assert start["record"] == "run-start"
    assert start["spec"] == spec.digest()
    assert end["vectors"] == {"PASS": len(found), "FAIL": 0, "SKIP": 0, "ERROR": 0, "partial": 0}
    assert (end["restarts"], end["note"], end["code"]) == (0, "", 0)


@pytest.mark.no_cover
def test_node_passes_what_it_implements_and_skips_the_rest(run: Run) -> None:
    told = run("vectors", "--json", "--", program("node"), NODE)
    end = told.records[-1]

    assert told.code == 0
    assert set(verdicts(told)) == {"PASS", "SKIP"}
    passed = {name: counts["PASS"] for name, counts in end["operations"].items() if counts["PASS"]}
    assert passed == {"frames.checksum": 19, "frames.crc": 19, "frames.split": 112, "readings.read": 543}
    assert {record["reason"] for record in told.records[1:-1]} == {None, "not-implemented"}
    assert 0 < end["vectors"]["partial"] < end["vectors"]["PASS"]


def test_a_wrong_answer_fails_the_vector_of_it_and_no_other(hostile: Hostile) -> None:
    told = hostile("is wrong")
    (case,) = the_only(told, "FAIL")["cases"]

    assert told.code == 1
    assert the_only(told, "FAIL")["id"] == CASE
    assert case["text"] == 'checksum: "0000" instead of "AA"'
    assert case["answer"] == {"result": {"checksum": "0000"}}
    assert case["expected"] == {"result": {"checksum": "AA"}}


def test_a_refusal_of_what_is_right_fails(hostile: Hostile) -> None:
    told = hostile("refuses")

    assert the_only(told, "FAIL")["cases"][0]["text"] == "an error (length) instead of a result"


def test_what_an_implementation_skips_is_not_passed(hostile: Hostile) -> None:
    told = hostile("skips")

    assert told.code == 0
    assert the_only(told, "SKIP")["reason"] == "not-implemented"


@pytest.mark.parametrize(
    ("behaviour", "reason", "restarts"),
    [
        ("dies", "died", 2),
        ("dies in half a line", "died", 2),
        ("says hello", "not-json", 2),
        ("says nothing of it", "bad-message", 2),
        ("says another number", "wrong-sequence", 2),
        ("is long", "too-long", 2),
        ("is long without an end", "too-long", 2),
        ("floods", "not-json", 2),
        ("crashes", "crashed", 0),
    ],
)
def test_an_error_belongs_to_the_case_that_causes_it(
    hostile: Hostile, behaviour: str, reason: str, restarts: int
) -> None:
    told = hostile(behaviour)
    found = the_only(told, "ERROR")

    assert told.code == 3
    assert (found["id"], found["reason"]) == (CASE, reason)
    assert told.records[-1]["restarts"] == restarts


@pytest.mark.parametrize("behaviour", ["is silent", "is deaf"])
def test_an_implementation_that_does_not_answer_is_ended(hostile: Hostile, behaviour: str) -> None:
    told = hostile(behaviour, "--timeout", "0.2", select=(CASE,))
    (case,) = told.records[1]["cases"]

    assert told.code == 3
    assert case["text"] == "no answer in 0.2 s: is each line flushed?"
    assert case["reason"] == "timeout"


def test_an_answer_too_many_is_an_error_of_the_next_case(hostile: Hostile) -> None:
    told = hostile("answers twice")
    found = the_only(told, "ERROR")

    assert told.code == 3
    assert (found["id"], found["reason"]) == ("checksum-synchronized-sampling", "wrong-sequence")
    assert found["cases"][0]["text"].endswith("; not when it was run again alone")


def test_the_end_of_standard_error_is_kept(hostile: Hostile) -> None:
    (case,) = the_only(hostile("dies"), "ERROR")["cases"]

    assert case["stderr"].endswith("x\nSegmentation fault")
    assert len(case["stderr"]) < codec_process.KEPT_ERRORS
    assert case["text"] == "the process has closed its output"


def test_an_implementation_that_fails_again_and_again_is_given_up(
    hostile: Hostile, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(codec_run, "MOST_RESTARTS", 2)
    monkeypatch.setattr(codec_run, "OPEN", 1)
    told = hostile("dies", case="")

    assert told.code == 3
    assert [record["reason"] for record in told.records[1:6]] == ["died"] * 3 + ["not-run"] * 2
    assert verdicts(told) == {"ERROR": COUNT}
    assert told.records[4]["cases"][0]["text"] == "the implementation failed 3 times"


def test_an_implementation_that_does_not_start_again_is_given_up(
    hostile: Hostile, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[object] = []

    class Once(CodecProcess):
        def __init__(self, command: Any) -> None:
            if started:
                raise OSError(2, "No such file or directory")
            started.append(self)
            super().__init__(command)

    monkeypatch.setattr(codec_run, "CodecProcess", Once)
    told = hostile("dies", select=(CASE, "crc-check"))

    assert told.code == 3
    assert [record["reason"] for record in told.records[1:-1]] == ["not-run", "not-run"]
    assert "does not start again: " in told.records[1]["cases"][0]["text"]
    assert "No such file or directory" in told.records[1]["cases"][0]["text"]


@pytest.mark.parametrize(
    ("behaviour", "note"),
    [
        ("talks after stop", "it writes more after the last answer"),
        ("fails after stop", "it ends with exit code 1 after stop"),
    ],
)
def test_an_end_that_is_not_as_it_should_be_is_noted(hostile: Hostile, behaviour: str, note: str) -> None:
    told = hostile(behaviour)

    assert told.code == 0
    assert told.records[-1]["note"] == note
    assert told.err == f"i7000: hostile: {note}\n"


def test_an_implementation_that_goes_on_after_its_end_is_killed(
    hostile: Hostile, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(codec_run, "FINISHING", 0.1)
    told = hostile("goes on after stop")

    assert told.code == 0
    assert told.records[-1]["note"] == "it does not end within 0.1 s after stop"


def test_after_enough_failures_the_rest_is_skipped(hostile: Hostile) -> None:
    told = hostile("is wrong", "--max-failures", "3", case="")

    assert told.code == 1
    assert verdicts(told) == {"FAIL": 3, "SKIP": COUNT - 3}
    assert {record["reason"] for record in told.records[4:-1]} == {"max-failures"}


def test_a_run_in_which_nothing_ran_is_not_a_success(run: Run) -> None:
    told = run("vectors", "modbus", "--json", "--", sys.executable, HOSTILE, "is wrong")

    assert told.code == 5
    assert set(verdicts(told)) == {"SKIP"}


def test_a_skipped_vector_alone_is_not_a_success(hostile: Hostile) -> None:
    assert hostile("skips", select=(CASE,)).code == 5


@pytest.mark.parametrize(
    ("command", "text"),
    [
        (("/no/such/program",), "/no/such/program: No such file or directory"),
        ((sys.executable, "-c", ""), "does not start: died: the process has closed its output"),
        ((sys.executable, "-c", "print('hello')"), 'does not start: not-json: "hello": Expecting value'),
        ((sys.executable, "-c", "raise SystemExit('no licence')"), "has closed its output; no licence"),
    ],
)
def test_a_program_that_does_not_start_is_reported(run: Run, command: tuple[str, ...], text: str) -> None:
    told = run("vectors", "crc", "--", *command)

    assert told.code == 3
    assert text in told.err
    assert told.out == ""


def test_a_program_that_never_answers_the_start_is_ended(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(codec_run, "STARTING", 0.1)
    told = run("vectors", "crc", "--timeout", "0.1", "--", sys.executable, HOSTILE, "never starts")

    assert told.code == 3
    assert "does not start: timeout: no answer in 0.1 s" in told.err


def test_ctrl_c_ends_the_run_and_the_implementation(
    hostile: Hostile, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    processes: list[Any] = []
    receive = CodecProcess.receive

    def interrupted(self: CodecProcess, seconds: float) -> bytes:
        if processes:
            signal.raise_signal(signal.SIGINT)
        processes.append(self)
        return receive(self, seconds)

    monkeypatch.setattr(CodecProcess, "receive", interrupted)
    file = tmp_path / "run.jsonl"
    told = hostile("is silent", "--report", f"json={file}")

    assert told.code == 130
    assert told.err == "i7000: broken off: the run is incomplete\n"
    assert "run-end" not in file.read_text(encoding="utf-8")
    assert processes[0]._process.wait(ENOUGH) == -signal.SIGKILL  # noqa: SLF001 - its end is what this is about


# --- processes --------------------------------------------------------------------------------------------------------


def test_what_a_process_does_not_read_holds_nothing_up() -> None:
    process = CodecProcess([sys.executable, "-c", "import time; time.sleep(3600)"])
    process.send(b"x" * (1 << 20))

    with pytest.raises(MessageError) as caught:
        process.receive(0.01)
    process.kill()

    assert caught.value.reason is Reason.TIMEOUT


def test_a_flood_of_lines_does_not_fill_the_memory() -> None:
    script = "import sys\nfor at in range(100000): print(at)\n"
    process = CodecProcess([sys.executable, "-c", script])

    found = [process.receive(ENOUGH) for _ in range(codec_process.MOST_LINES * 2)]
    waiting = len(process._lines)  # noqa: SLF001 - what is kept is what this is about
    process.kill()

    assert found == [str(at).encode() for at in range(len(found))]
    assert waiting <= codec_process.MOST_LINES


def test_what_was_read_before_the_end_is_received_first() -> None:
    process = CodecProcess([sys.executable, "-c", "print(1); print(2, end='')"])

    assert process.receive(ENOUGH).strip() == b"1"
    with pytest.raises(MessageError, match="after half a line of 1 bytes"):
        process.receive(ENOUGH)
    process.kill()


# --- usage ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ((), "give the command of the implementation after --"),
        (("--",), "give the command of the implementation after --"),
        (("crc-chek", "--", "x"), "there is no vector, file or operation 'crc-chek'; did you mean crc-check"),
        (("frames.crk", "--", "x"), "frames.crc"),
        (("--timeout", "0", "--", "x"), "--timeout 0: give 0.01 to 600 seconds"),
        (("--timeout", "nan", "--", "x"), "--timeout nan: give 0.01 to 600 seconds"),
        (("--timeout", "601", "--", "x"), "--timeout 601: give 0.01 to 600 seconds"),
        (("--max-failures", "0", "--", "x"), "--max-failures 0: give 1 or more"),
        (("--report", "xml=a", "--", "x"), "--report xml=a: write json=FILE or junit=FILE"),
        (("--report", "json", "--", "x"), "--report json: write json=FILE or junit=FILE"),
        (("--report", "json=", "--", "x"), "--report json=: write json=FILE or junit=FILE"),
        (("--report", "json=/dev/null,json=b", "--", "x"), "--report json is given twice"),
        (("--report", "json=a,junit=./a", "--", "x"), "--report junit=./a: give another file than for json"),
        (("--report", "json=/no/such/folder/a", "--", "x"), "/no/such/folder/a: No such file or directory"),
    ],
)
def test_wrong_usage_is_refused_before_anything_starts(run: Run, arguments: tuple[str, ...], text: str) -> None:
    told = run("vectors", *arguments)

    assert told.code == 2
    assert text in told.err


def test_what_is_selected_is_listed(run: Run) -> None:
    told = run("vectors", "--list", "crc-check", "dcon-2.10-manual-1", "checksum-manual-1")

    assert told.code == 0
    assert [line.split()[0] for line in told.out.splitlines()] == [
        "dcon-2.10-manual-1", "checksum-manual-1", "crc-check",
    ]  # fmt: skip


def test_what_is_selected_is_listed_as_json(run: Run) -> None:
    (record,) = run("vectors", "--list", "--json", "crc-check").records

    assert record["file"] == "frames/crc.json"
    assert record["operations"] == ["frames.crc"]


def test_several_selections_are_joined(run: Run) -> None:
    told = run("vectors", "--list", "--json", "dcon-2.10-manual-1", "dcon.encode_command", "dcon.decode_command")
    found = {record["id"]: record["operations"] for record in told.records}

    assert len(found["dcon-2.10-manual-1"]) == 5
    assert {"dcon.encode_command", "dcon.decode_command"} == {it for key in found for it in found[key][:2]}


def test_options_of_the_implementation_are_its_own(run: Run) -> None:
    script = "import sys; sys.exit(' '.join(sys.argv[1:]))"
    told = run("vectors", "crc", "--", sys.executable, "-c", script, "--list", "--", "--timeout", "7")

    assert "--list -- --timeout 7" in told.err


# --- output -----------------------------------------------------------------------------------------------------------


def test_failures_and_tables_are_printed_for_people(run: Run) -> None:
    told = run("vectors", *BOTH, "--", sys.executable, HOSTILE, "is wrong", CASE)

    assert f"FAIL  {CASE} frames.checksum\n" in told.out
    assert '      checksum: "0000" instead of "AA"\n' in told.out
    assert re.search(r"^frames/checksums.json +18 +1 +- +-$", told.out, re.MULTILINE)
    assert re.search(r"^frames.crc +19 +- +- +-$", told.out, re.MULTILINE)
    assert told.out.endswith(f"hostile 1 (Python): {COUNT} vectors: {COUNT - 1} PASS, 1 FAIL\n")


def test_errors_are_printed_with_the_end_of_standard_error(run: Run) -> None:
    told = run("vectors", *BOTH, "--", sys.executable, HOSTILE, "dies", CASE)

    assert f"ERROR {CASE} frames.checksum\n      died: the process has closed its output\n" in told.out
    assert "      stderr   Segmentation fault\n" in told.out
    assert "skipped cases and errors: 1 died\n" in told.out


def test_what_was_not_run_is_counted_and_not_listed(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(codec_run, "MOST_RESTARTS", 0)
    told = run("vectors", CASE, "crc", "--", sys.executable, HOSTILE, "dies", CASE)

    assert "crc-check" not in told.out
    assert "skipped cases and errors: 20 not-run\n" in told.out


def test_control_characters_of_an_implementation_are_escaped(run: Run) -> None:
    told = run("vectors", CASE, "--", sys.executable, HOSTILE, "crashes", CASE)

    assert r"crashed: ZeroDivisionError \x1b[2J \ud800" in told.out


def test_a_partly_skipped_vector_is_counted_as_such(run: Run) -> None:
    told = run("vectors", "reading-engineering-08-maximum", "--", program("node"), NODE)

    assert told.out.endswith("vectors.js 1 (JavaScript): 1 vectors: 1 PASS (1 of them in part)\n")


EMPTY = """\
import json, sys
for line in sys.stdin:
    message = json.loads(line)
    answer = {"protocol": 1, "implementation": {"name": "empty", "version": "1", "language": "Python"},
              "operations": ["dcon.encode_command", "frames.split"]}
    if message["cmd"] != "stop":
        print(json.dumps({"seq": message["seq"]} | ({"result": {}} if "case" in message else answer)), flush=True)
"""
"""A codec with empty results."""


def test_the_profile_of_what_failed_is_printed(run: Run) -> None:
    told = run("vectors", "dcon-2.10-manual-1", "--", sys.executable, "-c", EMPTY)

    assert told.code == 1
    assert '      profile  {"model": "I-7018", "firmware": null,' in told.out
    assert "      result: wire is missing\n" in told.out


def test_long_inputs_are_cut_for_people(run: Run) -> None:
    told = run("vectors", "frames.split", "--", sys.executable, "-c", EMPTY)
    inputs = [line for line in told.out.splitlines() if line.startswith("      input ")]

    assert max(map(len, inputs)) == min(len(line) for line in inputs if line.endswith("...")) == 618


def test_a_codec_runs_no_more_cases_than_it_is_given() -> None:
    cases = [case for vector in all_vectors() if vector.file == "frames/crc.json" for case in vector.cases]
    codec = codec_run.Codec((sys.executable, HOSTILE, "is wrong", cases[3].id), ENOUGH)

    found = list(codec.run(cases))
    codec.stop()
    nothing = codec.kill()

    assert [it.case for it in found] == cases
    assert [it.case.id for it in found if it.verdict is Verdict.FAIL] == [cases[3].id]
    assert (nothing, codec.note, codec.restarts) == ("", "", 0)


def test_a_codec_that_cannot_be_started_again_ends_with_an_error_for_each_case(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(codec_run, "MOST_RESTARTS", 0)
    cases = [case for vector in all_vectors() if vector.file == "frames/crc.json" for case in vector.cases]
    codec = codec_run.Codec((sys.executable, HOSTILE, "dies", cases[-1].id), ENOUGH)

    found = list(codec.run(cases[:3])) + list(codec.run(cases[-1:])) + list(codec.run(cases))
    codec.stop()

    assert [it.reason for it in found] == [None] * 3 + [Reason.DIED] + [Reason.NOT_RUN] * len(cases)
    assert codec.note == ""


@pytest.mark.parametrize("behaviour", ["is wrong", "dies", "skips", "crashes"])
def test_records_are_as_their_schema_says(hostile: Hostile, run: Run, behaviour: str) -> None:
    schema = json.loads(run("vectors", "--report-schema").out)
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)

    for record in hostile(behaviour).records:
        validator.validate(record)
        assert not validator.is_valid(record | {"other": 1})


def test_two_runs_differ_in_times_only(hostile: Hostile) -> None:
    first, second = (hostile("dies").out for _ in range(2))
    times = r'"(time|seconds)": [^,}]+'

    assert re.sub(times, "", first) == re.sub(times, "", second)


def test_the_report_has_the_records(hostile: Hostile, tmp_path: Path) -> None:
    file = tmp_path / "run.jsonl"
    told = hostile("is wrong", "--report", f"json={file}")

    assert file.read_text(encoding="utf-8") == told.out


def test_the_report_for_junit_has_a_suite_for_each_file(hostile: Hostile, tmp_path: Path) -> None:
    hostile("is wrong", "--report", f"json={tmp_path / 'a'},junit={tmp_path / 'wrong.xml'}")
    hostile("crashes", "--report", f"junit={tmp_path / 'crashed.xml'}")
    hostile("skips", "--report", f"junit={tmp_path / 'skipped.xml'}")
    wrong, crashed, left = (
        ET.fromstring((tmp_path / f"{name}.xml").read_bytes())  # noqa: S314 - just written
        for name in ("wrong", "crashed", "skipped")
    )

    assert [suite.get("name") for suite in wrong] == ["vectors.frames.checksums", "vectors.frames.crc"]
    assert [(suite.get("tests"), suite.get("failures")) for suite in wrong] == [("19", "1"), ("19", "0")]
    (failure,) = wrong.iter("failure")
    assert failure.get("message") == 'frames.checksum: checksum: "0000" instead of "AA"'
    (error,) = crashed.iter("error")
    assert error.get("message") == r"frames.checksum: crashed: ZeroDivisionError \x1b[2J \ud800"
    (skip,) = left.iter("skipped")
    assert skip.get("message") == "not-implemented"
    assert [test.get("name") for test in left.iter("testcase") if len(test)] == [CASE]
    assert {it.get("value") for it in wrong.iter("property")} == {"hostile", "1", "Python"}


def test_the_digest_is_of_all_files_of_spec(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "vectors").mkdir()
    (tmp_path / "vectors" / "a.json").write_bytes((SPEC / "errata.json").read_bytes())
    (tmp_path / "__pycache__").mkdir()
    monkeypatch.setattr("i7000.spec.files", lambda: tmp_path)
    digest = spec.digest.__wrapped__  # of now, not the one that is remembered
    before = digest()
    (tmp_path / "__pycache__" / "b.json").write_text("{}", encoding="utf-8")
    (tmp_path / "__init__.py").write_text("", encoding="utf-8")
    same = digest()
    (tmp_path / "vectors" / "a.json").rename(tmp_path / "vectors" / "b.json")

    assert (len(before), before) == (64, same)
    assert digest() != before
