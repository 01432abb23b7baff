"""What Hypothesis calls when it is imported."""

import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import hypothesis.version
import pytest
from hypothesis import strategies as st
from hypothesis.strategies._internal import types

import _i7000_hypothesis
from i7000 import Model, Profile, dcon, modbus, strategies
from i7000.dcon.parts import Part

LATE = "_global_extra_lookup"
"""Where Hypothesis looks for those who resolve classes of their own."""


@pytest.fixture
def registered(monkeypatch: pytest.MonkeyPatch) -> Iterator[dict[str, Any]]:
    """What is registered with Hypothesis by name, empty; what is registered by class is put back afterwards."""
    by_name: dict[str, Any] = {}
    monkeypatch.setattr(types, LATE, by_name)
    monkeypatch.setattr(types, "_global_type_lookup", dict(types._global_type_lookup))  # noqa: SLF001
    yield by_name
    st.from_type.__clear_cache()  # type: ignore[attr-defined] # noqa: SLF001 - of this


def test_an_import_of_hypothesis_imports_neither_the_package_nor_attrs() -> None:
    script = "import sys, hypothesis; print([name for name in sys.modules if name.split('.')[0] in ('i7000', 'attr')])"

    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)  # noqa: S603

    assert found.stdout == "[]\n"


def test_hypothesis_asks_for_the_classes_of_the_package(registered: dict[str, Any]) -> None:
    _i7000_hypothesis.register()

    assert registered == {"i7000": _i7000_hypothesis.resolve}


@pytest.mark.parametrize("kind", [Profile, dcon.Command, dcon.Command[Any], dcon.Refused, modbus.Coils], ids=str)
def test_a_class_of_the_package_is_resolved(kind: object) -> None:
    assert isinstance(_i7000_hypothesis.resolve(kind), st.SearchStrategy)


@pytest.mark.parametrize(
    "thing", [int, list[Profile], int | Profile, Annotated[int, 1], "Profile", None, Path, Model, Part], ids=str
)
def test_anything_else_is_left_to_hypothesis(thing: object) -> None:
    assert _i7000_hypothesis.resolve(thing) is None


@pytest.mark.parametrize("version", [(6, 60, 0), (6, 84, 3), (6, 119, 4)], ids=str)
def test_an_old_hypothesis_gets_one_warning_that_names_the_version_needed(
    version: tuple[int, ...], registered: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hypothesis.version, "__version_info__", version)
    monkeypatch.setattr(hypothesis.version, "__version__", "the old one")

    with pytest.warns(UserWarning, match="6.120") as warned:
        _i7000_hypothesis.register()

    text = "st.from_type has no strategies for i7000: Hypothesis 6.120 or later is needed, this is the old one"
    assert [text] == [str(it.message) for it in warned]
    assert registered == {}


def test_an_old_hypothesis_can_be_imported_where_warnings_are_errors(
    registered: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hypothesis.version, "__version_info__", (6, 60, 0))

    _i7000_hypothesis.register()  # pytest makes errors of warnings

    assert registered == {}


@pytest.mark.usefixtures("registered")
def test_a_hypothesis_that_asks_nobody_is_given_the_classes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(types, LATE)

    _i7000_hypothesis.register()

    assert {Profile, dcon.Command, dcon.Refused} <= set(types._global_type_lookup)  # noqa: SLF001
    assert Model not in types._global_type_lookup  # noqa: SLF001


@pytest.mark.usefixtures("registered")
def test_what_goes_wrong_is_a_warning(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail() -> None:
        raise RuntimeError("as it were")

    monkeypatch.delattr(types, LATE)
    monkeypatch.setattr(strategies, "register", fail)

    with pytest.warns(UserWarning, match=r"strategies for i7000: RuntimeError\('as it were'\)$"):
        _i7000_hypothesis.register()


def test_the_version_needed_is_that_of_the_extra() -> None:
    project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8"))["project"]

    needed = ".".join(map(str, _i7000_hypothesis.NEEDED))

    assert [f"hypothesis>={needed}"] == project["optional-dependencies"]["hypothesis"]
