"""The example decoder: the vectors of what it implements, the sanitizers, and agreement with the codec in Python."""

import json
import re
import subprocess
from pathlib import Path

import pytest

from i7000.cli.vector_files import all_vectors
from tests.c import STANDARDS, C, compile_c, compilers, output_of
from tests.c.differential import SOURCES, build, disagreements, is_same, main
from tests.interop import program
from tests.terminal import Run

SANITIZED = ("-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
IMPLEMENTED = {
    "frames.checksum", "frames.crc", "frames.split", "readings.read", "readings.read_leniently", "dcon.decode_command",
    "dcon.decode_response", "modbus.decode_request", "modbus.decode_response",
}  # fmt: skip
DECODER = tuple(C / "example" / name for name in ("dcon.c", "readings.c", "rtu.c"))


@pytest.fixture(scope="module")
def runner(tmp_path_factory: pytest.TempPathFactory) -> Path:
    built = tmp_path_factory.mktemp("example") / "runner"
    build("gcc", built, *SANITIZED)
    return built


@compilers
@pytest.mark.parametrize("standard", STANDARDS)
def test_a_compiler_takes_the_example_without_a_warning(compiler: str, standard: str, tmp_path: Path) -> None:
    compile_c(compiler, "-O2", *SOURCES, "-o", tmp_path / "runner", standard=standard)


@pytest.mark.no_cover
def test_the_example_passes_every_vector_of_what_it_implements(run: Run, runner: Path) -> None:
    told = run("vectors", "--json", "--", str(runner))
    vectors = [record for record in told.records if record["record"] == "vector"]
    implemented = {it.id for it in all_vectors() if any(case.operation in IMPLEMENTED for case in it.cases)}

    assert told.code == 0
    assert {record["id"] for record in vectors if record["verdict"] == "PASS"} == implemented
    assert {record["verdict"] for record in vectors} == {"PASS", "SKIP"}


@pytest.mark.no_cover
def test_the_example_decodes_as_the_codec_in_python_does(runner: Path) -> None:
    assert [*disagreements(runner, 4000, 12)] == []


def test_a_disagreement_is_noticed() -> None:
    expected = {"result": {"value": 1.0, "status": "ok"}}

    assert is_same({"result": {"value": 1, "status": "ok"}}, expected)
    assert not is_same({"result": {"value": 1.1, "status": "ok"}}, expected)
    assert not is_same({"error": {"fault": "number"}}, expected)
    assert not is_same({"error": {"fault": "number"}}, {"error": {"fault": "length"}})
    assert not is_same(expected, {"error": {"fault": "length"}})


def test_the_command_says_how_many_frames_agree(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["differential", "--frames", "100", "--seed", "3"])

    assert main() == 0
    assert capsys.readouterr().out == "100 frames with seed 3: no disagreements\n"


def test_the_decoder_neither_allocates_nor_prints(tmp_path: Path) -> None:
    objects = []
    for source in DECODER:
        objects.append(tmp_path / f"{source.stem}.o")
        compile_c("gcc", "-Os", "-c", source, "-o", objects[-1])

    unresolved = set(re.findall(r" U (\w+)", output_of(program("nm"), *objects)))
    assert {name for name in unresolved if not name.startswith(("codec_", "i7000_"))} <= {
        "_GLOBAL_OFFSET_TABLE_", "__stack_chk_fail", "memchr", "memcmp", "memcpy", "memset", "strchr", "strcmp",
        "strlen",
    }  # fmt: skip


def test_a_case_with_an_unknown_name_is_a_crash_and_no_refusal(runner: Path) -> None:
    command = {"type": "ReadNothing", "fields": {"address": 1}}
    case = {
        "id": "x",
        "operation": "dcon.decode_response",
        "profile": None,
        "input": {"wire": "0d", "command": command},
    }
    line = json.dumps({"cmd": "run", "seq": 7, "case": case}) + '\n{"cmd": "stop", "seq": 8}\n'

    done = subprocess.run([runner], input=line, capture_output=True, text=True, check=True)  # noqa: S603 - just compiled
    assert json.loads(done.stdout)["crashed"]
