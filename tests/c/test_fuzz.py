"""The harness ``i7000_fuzz.c``: it calls a decoder, finds what is wrong with it, and nothing in the example."""

import subprocess
from pathlib import Path

import pytest

from tests.c import C, compile_c, compilers, output_of
from tests.c.test_example import DECODER, SANITIZED
from tests.interop import not_installed, program

HARNESS = C / "i7000_fuzz.c"
EXAMPLE = (*DECODER, C / "example" / "fuzzed.c")
HOOK = """
#include "i7000_vectors.h"
int i7000_fuzz_decode(const i7000_exchange *vector, int is_modbus, int is_response, const uint8_t *frame, size_t size);
int i7000_fuzz_decode(const i7000_exchange *vector, int is_modbus, int is_response, const uint8_t *frame, size_t size)
{
    static int calls;
    (void)vector, (void)is_modbus, (void)is_response, (void)frame, (void)size, (void)calls;
    %s
}
"""


@compilers
def test_the_example_survives_frames_that_are_nearly_right(compiler: str, tmp_path: Path) -> None:
    fuzzed = tmp_path / "fuzz"
    options = SANITIZED if compiler == "gcc" else ("-O1",)
    compile_c(compiler, *options, "-DI7000_FUZZ_MAIN", HARNESS, *EXAMPLE, "-o", fuzzed)

    assert output_of(fuzzed, "30000", "7") == "30000 frames, no finding\n"


def test_libfuzzer_runs_the_harness(tmp_path: Path) -> None:
    probe = tmp_path / "probe.c"
    probe.write_text("int LLVMFuzzerTestOneInput(void);\nint LLVMFuzzerTestOneInput(void) { return 0; }\n")
    command = [program("clang"), "-fsanitize=fuzzer", str(probe), "-o", str(tmp_path / "probe")]
    if subprocess.run(command, capture_output=True, check=False).returncode:  # noqa: S603 - compiles
        not_installed("libclang-rt-dev")
    fuzzed = tmp_path / "fuzz"
    compile_c("clang", *SANITIZED, "-fsanitize=fuzzer", HARNESS, *EXAMPLE, "-o", fuzzed)

    done = subprocess.run([fuzzed, "-runs=20000", "-seed=1"], capture_output=True, text=True, check=False)  # noqa: S603 - just compiled
    assert done.returncode == 0, done.stderr
    assert "Done 20000 runs" in done.stderr


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("return frame[size] == 0 ? -1 : -2;", "heap-buffer-overflow"),
        ("return I7000_FAULT_NONE;", "has fault 0"),
        ("return I7000_FAULT_CRC;", "has fault"),
        ("return ++calls;", "decoded in two ways"),
    ],
)
def test_the_harness_finds_what_is_wrong_with_a_decoder(body: str, said: str, tmp_path: Path) -> None:
    hook, fuzzed = tmp_path / "hook.c", tmp_path / "fuzz"
    hook.write_text(HOOK % body)
    compile_c("gcc", *SANITIZED, "-DI7000_FUZZ_MAIN", HARNESS, hook, "-o", fuzzed)

    done = subprocess.run([fuzzed, "5000"], capture_output=True, text=True, check=False)  # noqa: S603 - just compiled
    assert done.returncode
    assert said in done.stderr


@pytest.mark.parametrize(
    "body",
    ["return -1;", "return vector->source == I7000_SOURCE_ASSUMED ? I7000_FAULT_LENGTH : -1;"],
    ids=["nothing is implemented", "another reading where the manual says nothing"],
)
def test_a_decoder_may_differ_in_what_is_not_required(body: str, tmp_path: Path) -> None:
    hook, fuzzed = tmp_path / "hook.c", tmp_path / "fuzz"
    hook.write_text(HOOK % body)
    compile_c("gcc", "-DI7000_FUZZ_MAIN", HARNESS, hook, "-o", fuzzed)

    assert output_of(fuzzed, "1000") == "1000 frames, no finding\n"
