"""The generated files are the same to every compiler."""

import re
import subprocess
from pathlib import Path

import pytest

from c.generate.values import WIDTH, lines, quoted, wire
from tests.c import STANDARDS, C, compile_c, compilers, output_of
from tests.generated import files_of


def test_no_line_is_longer_than_a_screen() -> None:
    longest = {name: max(map(len, written.splitlines())) for name, written in files_of("c").items()}

    assert {name: length for name, length in longest.items() if length > WIDTH} == {}


@compilers
@pytest.mark.parametrize("standard", STANDARDS)
def test_a_compiler_takes_the_tables_and_every_vector_and_finds_the_values_of_spec(
    compiler: str, standard: str, tmp_path: Path
) -> None:
    proof = tmp_path / "selftest"
    compile_c(compiler, C / "i7000_selftest.c", "-o", proof, standard=standard)

    assert output_of(proof) == "0 arrays differ from spec/\n"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"+100.00"', '"+100.01"'),
        ("I7000_STATUS_OVER_RANGE,", "I7000_STATUS_OK,"),
        ('"I-7017F", 7017, 0, 8', '"I-7017F", 7017, 0, 9'),
        ("$012B7", "$012B8"),
    ],
)
def test_the_proof_notices_a_changed_value(old: str, new: str, tmp_path: Path) -> None:
    for name, written in files_of("c").items():
        (tmp_path / Path(name).name).write_text(written.replace(old, new, 1), "utf-8")
    proof = tmp_path / "selftest"
    compile_c("gcc", tmp_path / "i7000_selftest.c", "-o", proof)

    done = subprocess.run([proof], capture_output=True, text=True, check=False)  # noqa: S603 - just compiled
    assert done.returncode == 1
    assert re.search(r" rows with CRC [0-9A-F]{8}, expected ", done.stdout)


@compilers
@pytest.mark.parametrize("section", ["DCON_2_10", "MODBUS_46_2C", "READINGS_HEX", "FRAMES"])
def test_a_section_compiles_alone(compiler: str, section: str, tmp_path: Path) -> None:
    source = tmp_path / "test.c"
    source.write_text(f'#define I7000_VECTORS_{section}\n#include "i7000_vectors.h"\nint main(void) {{ return 0; }}\n')
    compile_c(compiler, source, "-o", tmp_path / "test")


@pytest.mark.parametrize(
    ("data", "literal"), [(b'a"?\\\r', r'"a\"\?\\\r"'), (b"\xffA\xffg", r'"\xff" "A\xffg"'), (b"\x00\r0", r'"\x00\r0"')]
)
def test_a_literal_is_no_escape_or_trigraph_that_was_not_meant(data: bytes, literal: str) -> None:
    assert quoted(data) == literal


def test_a_long_wire_is_broken_into_lines() -> None:
    long = wire("41" * 100, readable=True)

    assert [*lines(f"{{1, {long.source}, 2}}", 4, ",")] == [
        "    {",
        "        1,",
        *(f'        {"I7000_WIRE(" if not at else ""}"{"A" * 22}"' for at in range(4)),
        f'        "{"A" * 12}"), 2,',
        "    },",
    ]
