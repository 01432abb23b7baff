"""A pattern is compiled when it is first used, and has the methods of a compiled one that the package needs."""

import pytest

from i7000.dissect.patterns import pattern


def test_a_wrong_pattern_is_noticed_at_its_first_use() -> None:
    wrong = pattern("(")

    with pytest.raises(Exception, match="unterminated"):
        wrong.search("")


def test_a_pattern_has_no_other_attributes() -> None:
    with pytest.raises(AttributeError):
        _ = pattern("a").groups
