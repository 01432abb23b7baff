"""``i7000_fuzz.c``: a harness for libFuzzer, with the characters of the syntaxes."""

from c.generate.header import filled
from c.generate.spec import Spec
from c.generate.values import quoted

__all__ = ["fuzz_harness"]

_DIGITS = "0123456789ABCDEF+-. \r"


def fuzz_harness(spec: Spec) -> str:
    """Return ``i7000_fuzz.c``."""
    rows = spec.rows("dcon_commands")
    syntaxes = "".join(row["syntax"] + (row["response_syntax"] or "") for row in rows)
    letters = sorted(set(syntaxes + _DIGITS + "?") - set("()"))
    return filled("i7000_fuzz.c", letters=iter([quoted("".join(letters).encode())]))
