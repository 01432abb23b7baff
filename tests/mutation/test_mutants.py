import json
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.mutation import equivalent
from tests.mutation.cells import CellMutant, cell_mutants, other_wires
from tests.mutation.code import code_mutants, is_different
from tests.mutation.covering import GOALS, ROWS, Row, row_of
from tests.mutation.mutant import Mutant
from tests.mutation.report import Judged, as_json, as_text, described, scores
from tests.mutation.results import Result, Results, digest_of_tests
from tests.mutation.runner import BrokenTestsError, Runner, chosen, files, is_mutant, mutants_of, sampled
from tests.mutation.scratch import ROOT, Scratch, files_of_git
from tests.spec.lint import canonical

CODE = '''from typing import TypeVar, cast

__all__ = ["larger"]
T = TypeVar("T")


def larger(left: int | None, right: int) -> int:
    """The larger one."""
    if left is not None and left > right:
        return cast("int", left)
    return right + len("")


class Limits:
    least: "int" = 0
'''

FIRST = {"id": "one", "comment": "The first.", "wire": "24303132", "text": "$012", "fields": {"count": 5}}
LAST = {"id": "two", "comment": "The last.", "wire": None, "text": None, "fields": {"ok": True}}
SPEC = canonical({
    "title": "A few",
    "notes": {"id": "name"},
    "vectors": [FIRST | {"errata": ["E01"]}, LAST | {"errata": ["E01", "E02"]}],
})  # fmt: skip


def changed(mutants: list[CellMutant]) -> list[dict[str, object]]:
    """The record that differs, of each mutant."""
    before = json.loads(SPEC)["vectors"]
    found = []
    for mutant in mutants:
        records = json.loads(mutant.after)["vectors"]
        found.append(next(new for new, old in zip(records, before, strict=True) if new != old))
    return found


def test_a_change_of_code_is_another_program_at_one_place() -> None:
    mutants = [mutant for mutant in code_mutants("a.py", CODE) if is_mutant(mutant)]

    assert len({mutant.after for mutant in mutants}) == len(mutants)
    assert {mutant.changes for mutant in mutants} == {
        ("-    if left is not None and left > right:", "+    if left is None and left > right:"),
        ("-    if left is not None and left > right:", "+    if left is not None or left > right:"),
        ("-    if left is not None and left > right:", "+    if left is not None and left >= right:"),
        ('-    return right + len("")', '+    return right - len("")'),
        ('-    least: "int" = 0', '+    least: "int" = None'),
        ('-    least: "int" = 0', '+    least: "int" = 1'),
        ('-    least: "int" = 0', '+    least: "XXintXX" = 0'),
        ('-    least: "int" = 0', '+    least: "INT" = 0'),
    }
    assert {mutant.line for mutant in mutants} == {9, 11, 15}


def test_most_changes_of_a_module_are_programs() -> None:
    file = "src/i7000/modbus/frame.py"
    mutants = code_mutants(file, (ROOT / file).read_text(encoding="utf-8"))[::20]

    assert sum(map(is_different, mutants)) > 0.9 * len(mutants)


def test_what_python_reads_alike_is_no_mutant() -> None:
    class Respelled(Mutant):
        after = "x = 0x10\n"

    class Unreadable(Mutant):
        after = "x = = 16\n"

    assert not is_mutant(Respelled("a.py", "x = 16\n"))
    assert not is_mutant(Unreadable("a.py", "x = 16\n"))


def test_a_change_of_a_cell_leaves_canonical_text() -> None:
    mutants = cell_mutants("spec/vectors/a.json", SPEC)

    assert [mutant.after for mutant in mutants] == [canonical(json.loads(mutant.after)) for mutant in mutants]
    assert len({mutant.after for mutant in mutants}) == len(mutants)
    assert all(is_mutant(mutant) for mutant in mutants)


def test_a_wire_and_its_text_change_together() -> None:
    records = changed(cell_mutants("spec/vectors/a.json", SPEC))

    assert [(record["wire"], record["text"]) for record in records if record["wire"] not in ("24303132", None)] == [
        ("24304132", "$0A2"),
        ("24303133", "$013"),
        ("24303231", "$021"),
    ]


def test_numbers_truth_values_and_lists_change() -> None:
    records = changed(cell_mutants("spec/vectors/a.json", SPEC))

    assert [record["fields"] for record in records if record["fields"] not in ({"count": 5}, {"ok": True})] == [
        {"count": 6}, {"count": 4}, {"ok": False},
    ]  # fmt: skip
    assert [record["errata"] for record in records if record["errata"] != ["E01"] and record["id"] == "one"] == [
        [], ["E02"],
    ]  # fmt: skip
    assert [record["errata"] for record in records if record["errata"] != ["E01", "E02"] and record["id"] == "two"] == [
        ["E02"], ["E01"], ["E02", "E01"], ["E02", "E02"], ["E01", "E01"],
    ]  # fmt: skip


def test_prose_and_names_of_vectors_stay() -> None:
    for record in changed(cell_mutants("spec/vectors/a.json", SPEC)):
        assert record["id"] in ("one", "two")
        assert record["comment"] in ("The first.", "The last.")


def test_an_erratum_is_dropped() -> None:
    text = canonical({"title": "Slips", "notes": {}, "rows": [{"id": "E01"}, {"id": "E02"}, {"id": "E03"}]})
    found = [
        [row["id"] for row in json.loads(mutant.after)["rows"]] for mutant in cell_mutants("spec/errata.json", text)
    ]

    assert [ids for ids in found if len(ids) == 2] == [["E02", "E03"], ["E01", "E03"], ["E01", "E02"]]


def test_files_of_data_have_mutants() -> None:
    names = chosen(files(ROOT), ["spec"])

    assert names
    for name in names[::10]:
        assert len(mutants_of(name, (ROOT / name).read_text(encoding="utf-8"))) > 5, name


def test_a_short_wire_has_no_bytes_to_swap() -> None:
    assert list(other_wires("24")) == ["25"]
    assert list(other_wires("")) == ["00"]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.pattern)
def test_a_row_of_files_that_are_there_names_tests_that_are_there(row: Row) -> None:
    assert row.target in GOALS
    if any(row_of(name) is row for name in files(ROOT)):
        for pattern in (pattern for stage in row.stages for pattern in stage):
            assert list(ROOT.glob(pattern)), pattern


def test_every_module_with_a_goal_has_a_row() -> None:
    names = {
        path.relative_to(ROOT).as_posix()
        for folder in ("dcon", "modbus", "host", "device") for path in (ROOT / "src/i7000" / folder).rglob("*.py")
    }  # fmt: skip

    assert names <= set(files(ROOT))


def test_files_are_chosen_by_path_and_by_target() -> None:
    names = ["spec/errata.json", "src/i7000/dcon/frame.py", "src/i7000/dcon/codec.py", "src/i7000/readings.py"]

    assert chosen(names, []) == names
    assert chosen(names, ["spec"]) == names[:1]
    assert chosen(names, ["src/i7000/dcon/"]) == names[1:3]
    assert chosen(names, ["checksum", "src/i7000/readings.py"]) == [names[1], names[3]]
    assert chosen(names, ["src/i7000/dc"]) == []


def test_a_sample_is_repeated_by_its_seed() -> None:
    mutants = code_mutants("a.py", CODE)
    drawn = [mutant.after for mutant in sampled(mutants, 7, 5)]

    assert len(drawn) == 5
    assert drawn == [mutant.after for mutant in sampled(mutants, 7, 5)]
    assert drawn != [mutant.after for mutant in sampled(mutants, 8, 5)]
    assert list(sampled(mutants, 7, None)) == [mutant for mutant in mutants if is_mutant(mutant)]


TESTS = """from large import larger
from time import sleep


def test_a_larger_one():
    assert larger(1, 2) == 2
    assert larger(2, 1) == 2
    if larger(1, 1) != 1:
        sleep(600)
"""

CONFTEST = """from hypothesis import settings

settings.register_profile("mutation")
"""


@pytest.fixture
def small(tmp_path: Path) -> Iterator[Scratch]:
    """A scratch copy of a checkout with one module and one test."""
    root = tmp_path / "root"
    for name, text in {
        "src/large.py": CODE.partition("class")[0],
        "tests/test_large.py": TESTS,
        "tests/conftest.py": CONFTEST,
        ".gitignore": "__pycache__/\n",
    }.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text, encoding="utf-8")
    shutil.copytree(ROOT / "tests" / "mutation", root / "tests" / "mutation", ignore=shutil.ignore_patterns("test_*"))
    (root / "tests" / "__init__.py").touch()
    scratch = Scratch(tmp_path / "scratch", root, [path.relative_to(root).as_posix() for path in root.rglob("*.*")])
    yield scratch
    scratch.close()


class Replaced(Mutant):
    """The small module with one piece of text replaced."""

    after = ""

    def __init__(self, old: str, new: str) -> None:
        before = CODE.partition("class")[0]
        super().__init__("src/large.py", before)
        self.after = before.replace(old, new)


ROW = Row("host", "src/*.py", (("tests/nowhere.py",), ("tests/test_large.py",)))


def test_a_bad_mutant_is_killed_and_one_that_changes_nothing_survives(small: Scratch) -> None:
    runner = Runner(small, 60)
    before = small.text("src/large.py")

    assert runner.run(Replaced("left > right", "left < right"), ROW).outcome == "killed"
    assert runner.run(Replaced("left > right", "left >= right"), ROW).outcome == "survived"
    assert runner.run(Replaced("left > right", "right < left"), ROW).outcome == "survived"
    assert runner.run(Replaced("def larger", "def smaller"), ROW).outcome == "killed"
    assert small.text("src/large.py") == before


def test_a_mutant_that_does_not_end_is_ended(small: Scratch) -> None:
    runner = Runner(small, 60)
    usual = runner.usual(("tests/test_large.py",))
    mutant = Replaced('right + len("")', "right + (left == right)")

    with small.changed(mutant.file, mutant.after):
        assert small.run(("tests/test_large.py",), usual + 2).outcome == "timeout"


def test_tests_that_fail_without_a_mutant_are_no_measure(small: Scratch) -> None:
    (small.folder / "tests" / "test_large.py").write_text("def test_nothing():\n    assert 1 == 2\n")

    with pytest.raises(BrokenTestsError, match=r"tests/test_large.py: failed without a mutant(.|\n)*assert 1 == 2"):
        Runner(small, 60).usual(("tests/test_large.py",))


def test_the_copy_has_what_git_knows_or_could_add(tmp_path: Path) -> None:
    for name, text in {"a.py": "", "folder/b.py": "", "cache/c": "", ".gitignore": "cache/\n", "gone.py": ""}.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    for words in (["init", "--quiet"], ["add", "a.py", "gone.py"]):
        subprocess.run(["git", *words], cwd=tmp_path, check=True)  # noqa: S603, S607
    (tmp_path / "gone.py").unlink()

    assert sorted(files_of_git(tmp_path)) == [".gitignore", "a.py", "folder/b.py"]


def mutant() -> Mutant:
    """A mutant that survives."""
    return Replaced("left > right", "left >= right")


def test_results_are_found_again_and_a_survivor_only_with_the_same_tests(tmp_path: Path) -> None:
    path = tmp_path / "cache" / "results.jsonl"
    killed = Replaced("left > right", "left < right")
    results = Results(path, "tests 1")
    results.add(mutant(), Result("survived", 2, 1.5))
    results.add(killed, Result("killed", 1, 0.5))
    with path.open("a") as file:
        file.write('{"key": "cut o')

    assert results.find(mutant(), 2) == Result("survived", 2, 1.5)
    assert Results(path, "tests 1").find(mutant(), 2) == Result("survived", 2, 1.5)
    assert Results(path, "tests 1").find(mutant(), 3) is None
    assert Results(path, "tests 2").find(mutant(), 2) is None
    assert Results(path, "tests 2").find(killed, 3) == Result("killed", 1, 0.5)


def test_the_digest_of_the_tests_does_not_depend_on_this_package(tmp_path: Path) -> None:
    (tmp_path / "mutation").mkdir()
    (tmp_path / "test_a.py").write_text("1")
    first = digest_of_tests(tmp_path)
    (tmp_path / "mutation" / "code.py").write_text("2")

    assert digest_of_tests(tmp_path) == first
    (tmp_path / "test_a.py").write_text("3")
    assert digest_of_tests(tmp_path) != first


def test_an_equivalent_mutant_is_known_by_its_file_and_its_changed_lines(tmp_path: Path) -> None:
    path = tmp_path / "equivalent.json"
    changes = ["-if left is not None and left > right:", "+if left is not None and left >= right:"]
    path.write_text(json.dumps([{"file": "src/large.py", "changes": changes, "reason": "Equal numbers are equal."}]))

    assert equivalent.reason_of(mutant(), equivalent.read(path)) == "Equal numbers are equal."
    assert equivalent.reason_of(Replaced("left > right", "left < right"), equivalent.read(path)) is None


def test_every_entry_of_the_list_changes_a_line_that_is_there() -> None:
    for entry in equivalent.read():
        lines = {line.strip() for line in (ROOT / entry.file).read_text(encoding="utf-8").splitlines()}
        gone = {change[1:] for change in entry.changes if change.startswith("-")}

        assert gone, entry
        assert gone <= lines, entry
        assert entry.changes == equivalent.bare(entry.changes)
        assert entry.reason.endswith("."), entry


def test_a_report_counts_and_shows_survivors() -> None:
    judged = [
        Judged("host", Replaced("left > right", "left < right"), "killed"),
        Judged("host", Replaced("def", "while True or def"), "timeout"),
        Judged("host", mutant(), "survived"),
        Judged("CRC", mutant(), "equivalent", "Equal numbers are equal."),
    ]
    text = as_text(judged, is_complete=False)

    assert [(score.target, score.rate, score.is_met) for score in scores(judged)] == [
        ("host", 2 / 3, False), ("CRC", 1.0, True),
    ]  # fmt: skip
    assert "src/large.py:9\n  -    if left is not None and left > right:\n  +    if" in text
    assert text.endswith("INCOMPLETE: the run was stopped\n")
    assert "INCOMPLETE" not in as_text(judged, is_complete=True)
    data = as_json(judged, {"seed": 1}, is_complete=True)
    assert [found["line"] for found in data["survivors"]] == [9]
    assert [found["reason"] for found in data["equivalent"]] == ["Equal numbers are equal."]


def test_a_long_line_is_cut_around_the_change() -> None:
    long = Replaced("def larger", f"x = '{'a' * 900}'\ndef larger")
    long.before = long.after
    long.after = long.before.replace("a'\n", "b'\n")

    head, *lines = described(long)
    assert head == "src/large.py:7"
    assert [line[-2:] for line in lines] == ["a'", "b'"]
    assert all(len(line) < 300 for line in lines)
