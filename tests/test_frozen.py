"""`frozen`: after its first use, a class is what `attrs.frozen` makes; an import makes as little of it as it can."""

import copy
import inspect
import pickle
import subprocess
import sys
import weakref
from collections.abc import Callable
from threading import Barrier, Thread
from typing import Any, ClassVar, Generic, TypeVar

import attrs
import pytest
from attrs import field

from i7000.frozen import frozen

T = TypeVar("T")
Decorator = Callable[[type], Any]


@frozen
class Used:
    value: int


@frozen
class Idle:
    value: int


def fresh(decorator: Decorator = frozen) -> Any:
    """A class that nobody has used yet, with everything that a class of ours has."""

    class Plain(Generic[T]):
        """The documentation."""

        kind: ClassVar[str] = "plain"
        low: int
        high: int = 9
        downwards: bool = field(default=False, kw_only=True)
        span: int = field(init=False, eq=False, repr=False)

        def __attrs_post_init__(self) -> None:
            object.__setattr__(self, "span", self.high - self.low)

        def twice(self) -> int:
            return 2 * self.span

    return decorator(Plain)


def made_by_attrs() -> Any:
    return fresh(attrs.frozen)


# What a class can be used for first.
FIRST_USES: dict[str, Callable[[Any], object]] = {
    "constructor": lambda kind: kind(1).span,
    "constructor with names": lambda kind: kind(low=1, high=5, downwards=True).twice(),
    "signature": lambda kind: str(inspect.signature(kind)),
    "signature of the constructor": lambda kind: str(inspect.signature(kind.__init__)),
    "fields": lambda kind: [(it.name, it.type, it.kw_only, it.default) for it in attrs.fields(kind)],
    "has": attrs.has,
    "names of positional patterns": lambda kind: kind.__match_args__,
    "text": lambda kind: repr(kind(1)),
    "hash": lambda kind: hash(kind(1)) == hash(kind(1, 9)),
    "equality": lambda kind: (kind(1) == kind(1), kind(1) == kind(2), kind(1) == 1),
    "evolved": lambda kind: repr(attrs.evolve(kind(1), high=3)),
    "copied": lambda kind: repr(copy.copy(kind(1))),
    "weak reference": lambda kind: weakref.ref(kind(1)) is not None,
    "slots": lambda kind: kind.__slots__,
    "documentation": lambda kind: (kind.__doc__, kind.__module__, kind.__qualname__, kind.kind, kind[int].__args__),
}


@pytest.mark.parametrize("use", FIRST_USES.values(), ids=FIRST_USES)
def test_the_first_use_of_a_class_finds_what_attrs_makes(use: Callable[[Any], object]) -> None:
    assert use(made_by_attrs()) == use(fresh())


def test_a_used_class_has_every_attribute_that_attrs_makes_and_no_other() -> None:
    kind = fresh()
    kind(1)

    assert set(vars(made_by_attrs())) == set(vars(kind))


@pytest.mark.parametrize("name", ["low", "other"])
def test_an_instance_is_frozen_even_before_its_class_was_used(name: str) -> None:
    instance = object.__new__(fresh())

    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        setattr(instance, name, 1)


def test_nothing_can_be_deleted_from_an_instance() -> None:
    instance = object.__new__(fresh())

    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        del instance.low


def test_an_instance_can_be_unpickled_before_its_class_was_used() -> None:
    pickled = pickle.dumps(Used(7)).replace(b"Used", b"Idle")

    assert Idle(7) == pickle.loads(pickled)  # noqa: S301 - our own


def test_options_are_those_of_attrs() -> None:
    @frozen(eq=False, repr=False, kw_only=True)
    class Options:
        value: int

    assert Options(value=1) != Options(value=1)
    assert "value" not in repr(Options(value=1))
    with pytest.raises(TypeError):
        Options(1)  # type: ignore[call-arg] # as a type checker knows


def test_a_method_that_a_class_has_stays_its_own() -> None:
    @frozen
    class Own:
        value: int = field(init=False)

        def __init__(self) -> None:
            object.__setattr__(self, "value", 5)

        def __repr__(self) -> str:
            return "own"

    own = Own()

    assert own.value == 5
    assert repr(own) == "own"


def test_a_frozen_class_inherits_the_fields_of_another() -> None:
    @frozen
    class Base:
        first: int

    @frozen
    class Derived(Base):
        second: int

    assert Base(1).first == 1
    assert Derived(1, 2) == Derived(first=1, second=2)
    assert Derived.__match_args__ == ("first", "second")
    assert not hasattr(Derived(1, 2), "__dict__")


def test_a_class_that_only_inherits_is_made_with_its_base() -> None:
    @frozen
    class Base:
        value: int

    class Heir(Base):
        pass

    assert Heir(3).value == 3
    assert [it.name for it in attrs.fields(Heir)] == ["value"]
    assert Heir(3) != Base(3)


def test_threads_that_use_a_class_first_at_once_agree() -> None:
    for _ in range(20):
        kind, together = fresh(), Barrier(8)
        found: list[Any] = []

        def use(kind: Any = kind, together: Barrier = together, found: list[Any] = found) -> None:
            together.wait()
            found.append((kind(1), hash(kind(1)), attrs.fields(kind)))

        threads = [Thread(target=use) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

        assert [(kind(1), hash(kind(1)), attrs.fields(kind))] * 8 == found


def test_an_import_makes_only_the_classes_that_it_uses() -> None:
    script = (
        "import attrs; made = []; frozen = attrs.frozen\n"
        "def noted(kind, **options):\n    made.append(kind.__name__)\n    return frozen(kind, **options)\n"
        "attrs.frozen = noted; import i7000.dcon, i7000.modbus; print(made)"
    )

    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)  # noqa: S603

    assert found.stdout == "['Firmware']\n"
