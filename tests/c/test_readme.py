"""What ``c/README.md`` says: sizes, lines and code."""

import re
from pathlib import Path

import pytest

from i7000.cli.vector_files import all_vectors
from tests.c import C, compile_c, output_of
from tests.c.test_example import DECODER, IMPLEMENTED
from tests.interop import program

README = (C / "README.md").read_text("utf-8")


def size(source: Path, folder: Path) -> int:
    """The bytes of a source file when it is compiled for little room."""
    built = folder / f"{source.stem}.o"
    compile_c("gcc", "-Os", "-fno-pie", "-c", source, "-o", built)
    return int(output_of(program("size"), built).splitlines()[1].split()[3])


def test_the_sizes_are_those_that_gcc_makes(tmp_path: Path) -> None:
    """Compilers differ; a table that is doubled, or a decoder that takes another page, does not fit into this."""
    found = re.search(r"^\| gcc 12, x86-64 \| ([\d,]+) \| ([\d,]+) \|$", README, re.MULTILINE)
    assert found
    tables, decoder = (int(number.replace(",", "")) for number in found.groups())

    assert size(C / "example" / "tables.c", tmp_path) == pytest.approx(tables, rel=0.1)
    assert sum(size(source, tmp_path) for source in DECODER) == pytest.approx(decoder, rel=0.25)


def test_the_lines_of_the_example_are_as_many_as_it_says() -> None:
    stated = dict(re.findall(r"^\| `(\w+\.[ch])` \| (\d+) \|", README, re.MULTILINE))

    assert len(stated) == 7
    assert stated == {name: str(len((C / "example" / name).read_text("utf-8").splitlines())) for name in stated}


def test_the_numbers_of_vectors_are_those_of_the_example() -> None:
    vectors = all_vectors()
    passed = [it for it in vectors if any(case.operation in IMPLEMENTED for case in it.cases)]

    assert f"{len(passed):,} of {len(vectors):,}," in README


def test_its_snippets_compile(tmp_path: Path) -> None:
    tables, use, vectors = re.findall(r"```c\n(.*?)```", README, re.DOTALL)
    includes, loop = vectors.split("\n\n", 1)
    source = tmp_path / "snippets.c"
    source.write_text(
        f"{tables}{includes}\nextern void send(const char *body);\nvoid use(void);\nint main(void);\n"
        f"void send(const char *body) {{ (void)body; }}\nvoid use(void)\n{{\n{use}(void)type;\n}}\n"
        f"int main(void)\n{{\n{loop}    return 0;\n}}\n".replace("/* your_decode", "(void)vector; /* your_decode")
    )
    compile_c("gcc", source, "-o", tmp_path / "snippets")


def test_a_program_has_only_the_tables_that_it_uses(tmp_path: Path) -> None:
    source, built = tmp_path / "one.c", tmp_path / "one"
    source.write_text('#include "i7000.h"\nint main(void) { return i7000_types[I7000_TYPE_K].decimals; }\n')
    options = ("-Os", "-fno-pie", "-no-pie", "-fdata-sections", "-Wl,--gc-sections")
    compile_c("gcc", *options, source, C / "example" / "tables.c", "-o", built)

    symbols = output_of(program("nm"), built)
    assert "i7000_types" in symbols
    assert "i7000_maps" not in symbols
