"""How a target is given to Atheris: held against a stand-in, so that Atheris is not needed."""

import json
import subprocess
import sys
from pathlib import Path

from fuzz.targets import FOLDER

STAND_IN = """
import json, sys
from contextlib import nullcontext
from types import SimpleNamespace

def setup(arguments, target):
    print(json.dumps([arguments, target.__name__, instrumented, options]))

options, instrumented = {}, []
sys.modules["atheris"] = SimpleNamespace(
    instrument_imports=lambda **given: options.update(given) or nullcontext(),
    instrument_func=lambda function: instrumented.append(function.__code__.co_filename),
    Setup=setup,
    Fuzz=lambda: None,
)
"""


def run(*command: str, path: Path) -> tuple[list[str], str, list[str], dict[str, list[str]]]:
    """Run a program in which the stand-in is there; return what Atheris was given."""
    (path / "stand_in.py").write_text(STAND_IN, encoding="utf-8")
    program = f"import sys; sys.path.insert(0, {str(path)!r}); import stand_in; {command[0]}"
    done = subprocess.run(  # noqa: S603
        [sys.executable, "-c", program, *command[1:]],
        cwd=FOLDER.parent, check=True, capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    arguments, name, instrumented, options = json.loads(done.stdout)
    return arguments, name, instrumented, options


def test_a_target_is_set_up_with_the_arguments_and_what_is_generated_is_instrumented(tmp_path: Path) -> None:
    program = "from fuzz.engine import main; main('dcon_command')"

    arguments, name, instrumented, options = run(program, "-runs=1", "corpus", path=tmp_path)

    assert (arguments[1:], name) == (["-runs=1", "corpus"], "dcon_command")
    assert options["include"] == ["i7000"]
    assert instrumented
    assert all(file.startswith("<i7000: ") for file in instrumented)


def test_libfuzzer_is_told_how_the_shell_starts_the_program(tmp_path: Path) -> None:
    program = "import runpy; runpy.run_module('fuzz.fuzzers.dcon_split_fuzzer', run_name='__main__', alter_sys=True)"

    arguments, name, _, _ = run(program, "-merge=1", path=tmp_path)

    assert arguments == [f"{sys.executable} -m fuzz.fuzzers.dcon_split_fuzzer", "-merge=1"]
    assert name == "dcon_split"
