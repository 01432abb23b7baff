"""The checks that a user selects, by their ids, groups, patterns and sections.

Laws: what a selected check needs, and its negative halves, are selected with it.
"""

import re
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from fnmatch import fnmatchcase

from i7000.conformance.statement import Statement
from i7000.errors import InvalidValueError

__all__ = ["asked_for", "by_positive", "selected"]


def selected(known: Mapping[str, Statement], selection: Iterable[str] = ()) -> frozenset[str]:
    """Return the ids that texts select: ids, beginnings of them, patterns with ``*``, and sections of the manual.

    Special: no text selects everything. What a selected check needs, and its negative half, are selected too.
    Errors: `InvalidValueError` for a text that selects nothing; it names the nearest id.

    >>> from i7000 import spec
    >>> sorted(selected(spec.statements(), ["link"]))[0]
    'link/alive'
    """
    return frozenset(_completed(set(asked_for(known, selection)), known))


def asked_for(known: Mapping[str, Statement], selection: Iterable[str] = ()) -> frozenset[str]:
    """Return the ids that texts name, without what those need.

    Errors: as for `selected`.
    """
    texts = tuple(selection)
    found = set() if texts else set(known)
    for text in texts:
        matching = {it.id for it in known.values() if _matches(it, text)}
        if not matching:
            near = ", ".join(get_close_matches(text, known, n=3, cutoff=0.4))
            allowed = "the id of a check, a group, a pattern such as dcon/2.1*, or a section of the manual"
            allowed = f"{allowed}; near it: {near}" if near else allowed
            raise InvalidValueError("select", text, allowed, "", f"there is no check {text!r}")
        found |= matching
    return frozenset(found)


def _matches(statement: Statement, text: str) -> bool:
    return (
        statement.id == text
        or statement.id.startswith(text.rstrip("/") + "/")
        or statement.id.startswith(text + "-n")
        or fnmatchcase(statement.id, text)
        or (re.fullmatch(r"[1-3A](\.\d+)*", text) is not None and text in statement.sections)
    )


def _completed(found: set[str], known: Mapping[str, Statement]) -> set[str]:
    """Add what is needed, and the negative halves."""
    left = list(found)
    halves = by_positive(known.values())
    while left:
        one = left.pop()
        for other in (*known[one].needs, *(it.id for it in halves.get(one, ()))):
            if other not in found:
                found.add(other)
                left.append(other)
    return found


def by_positive(statements: Iterable[Statement]) -> dict[str | None, list[Statement]]:
    """Return the negative halves of checks, by the ids of those."""
    found: dict[str | None, list[Statement]] = {}
    for one in statements:
        found.setdefault(one.positive, []).append(one)
    return found
