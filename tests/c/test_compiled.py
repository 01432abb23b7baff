"""The generated files: in step with ``spec/``, and the same to every compiler."""

import re
import subprocess
from pathlib import Path

import pytest

from c.generate.__main__ import main
from c.generate.files import generated
from c.generate.values import WIDTH, lines, quoted, wire
from tests.c import STANDARDS, C, compile_c, compilers, output_of
from tests.spec.lint import SPEC

FILES = generated(SPEC)


@pytest.mark.parametrize("name", FILES)
def test_a_file_is_what_the_generator_makes_of_spec(name: str) -> None:
    """The files are too long for pytest to show how they differ."""
    is_current = (SPEC.parent / name).read_text("utf-8") == FILES[name]

    assert is_current, f"{name} is not what spec/ says; run: python -m c.generate"


def test_the_command_writes_only_what_differs(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("c.generate.__main__.ROOT", tmp_path)
    (tmp_path / "spec").symlink_to(SPEC)
    (tmp_path / "c").mkdir()
    (tmp_path / "c" / "i7000.h").write_text(FILES["c/i7000.h"], "utf-8")

    assert main() == 0
    assert "wrote c/i7000_vectors.h\n" in capsys.readouterr().out
    assert "wrote c/i7000.h" not in capsys.readouterr().out
    assert (tmp_path / "c" / "i7000_vectors.h").read_text("utf-8") == FILES["c/i7000_vectors.h"]
    assert main() == 0
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("name", FILES)
def test_no_line_is_longer_than_a_screen(name: str) -> None:
    assert max(map(len, FILES[name].splitlines())) <= WIDTH


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
    for name, written in FILES.items():
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
