"""The mechanical rules of the language: how docstrings begin, phrases that nobody searches for, long sentences."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

SRC = Path(__file__).parents[1] / "src"
FILES = sorted(SRC.rglob("*.py"))

BANNED_VERBS = re.compile(r"(Ask|Hear|Hold|Know|Let|Say|Tell)\b")
"""Verbs with which no docstring begins."""
NOT_A_VERB = re.compile(r"[^A-Z]|(A|All|An|As|At|From|If|Of|On|One|That|The|There|This|What|When|Where|Whether|Who)\b")
"""Words with which the docstring of a function does not begin: it begins with a verb."""
VERBS = re.compile(r"(Check|Compute|Decode|Encode|Find|Make|Parse|Read|Return|Set|Split|Switch|Write|Yield)\b")
"""Words with which the docstring of a class does not begin: it begins with a noun phrase."""
PHRASES = re.compile(
    r"\b((?<!there )(is|are) none|(is|are|be) told|tells (the|what|whether|how|which)|whom|who has it"
    r"|(is|are) asked for|what is not given|told apart|time-out"
    r"|(?<![Tt]here )(is|are|was|were) no (?!longer|more)\w+|never holds up"
    r"|nothing else is (to be )?said|the whole of it)\b"
)
"""Phrases for which there is a plain one: unknown, invalid, returns, requested, timeout."""
LONGEST_SENTENCE = 40
"""Words of a sentence, or of a part of it before a colon or semicolon."""

Documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def _documented(tree: ast.Module) -> Iterator[tuple[Documented, str]]:
    for node in ast.walk(tree):
        if isinstance(node, Documented) and (text := ast.get_docstring(node)):
            yield node, text


def _texts(tree: ast.Module) -> Iterator[str]:
    """Yield docstrings, help texts and messages: the strings of several words."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value:
            yield node.value


def _is_property(node: Documented) -> bool:
    decorators = getattr(node, "decorator_list", [])
    return any("property" in ast.unparse(it) for it in decorators)


def _sentences(text: str) -> Iterator[str]:
    """Yield the sentences of a docstring, without its doctests and labels."""
    prose = re.sub(r"^ *>>>.*?(?=^ *$|\Z)", "", text, flags=re.MULTILINE | re.DOTALL)
    for paragraph in re.split(r"\n *\n|\n(?=[A-Z][a-z]+: )|\n(?=\* )", prose):
        yield from re.split(r"[.;:](?:\s+|$)", " ".join(paragraph.split()))


def _faults(source: str) -> Iterator[str]:
    """Yield what is against the rules in a source file."""
    tree = ast.parse(source)
    for node, text in _documented(tree):
        where = f"{getattr(node, 'name', 'module')}: {text.splitlines()[0]}"
        is_function = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and not _is_property(node)
        if BANNED_VERBS.match(text) or (is_function and NOT_A_VERB.match(text)):
            yield f"begin with another verb: {where}"
        if isinstance(node, ast.ClassDef) and VERBS.match(text):
            yield f"begin with a noun phrase: {where}"
        for sentence in _sentences(text):
            if len(sentence.split()) > LONGEST_SENTENCE:
                yield f"a sentence of {len(sentence.split())} words: {sentence}"
    for text in _texts(tree):
        if found := PHRASES.search(text):
            yield f"write {found[0]!r} in plain words: {' '.join(text.split())[:200]}"


@pytest.mark.parametrize("name", [path.relative_to(SRC).as_posix() for path in FILES])
def test_the_texts_of_a_source_file_are_in_plain_english(name: str) -> None:
    path = SRC / name

    assert not list(_faults(path.read_text(encoding="utf-8")))


@pytest.mark.parametrize(
    ("source", "fault"),
    [
        ('def f():\n    """Tell the time."""', "another verb"),
        ('def f():\n    """The time."""', "another verb"),
        ('class C:\n    """Tell the time."""', "another verb"),
        ('class C:\n    """Read the time."""', "a noun phrase"),
        ('"""A module whose firmware is none."""', "in plain words"),
        ('raise ValueError(f"{name} is none of {names}")', "in plain words"),
        ('raise ValueError(f"{name} is no frame")', "in plain words"),
        (f'"""A {"long " * 40}sentence."""', "a sentence of 42 words"),
    ],
)
def test_a_text_against_the_rules_is_found(source: str, fault: str) -> None:
    (found,) = _faults(source)

    assert fault in found


@pytest.mark.parametrize(
    "source",
    [
        'raise ValueError("there is no frame, and it is no longer one")',
        'class C:\n    """The time."""\n\n    @property\n    def f(self):\n        """The time."""',
        f'"""The module.\n\nLaws: {"word " * 30}. {"word " * 30}\n"""',
        f'def f():\n    """Return it.\n\n    >>> f({"1, " * 99})\n    3\n    """',
    ],
    ids=["no", "property", "two sentences", "doctest"],
)
def test_a_text_within_the_rules_is_accepted(source: str) -> None:
    assert not list(_faults(source))
