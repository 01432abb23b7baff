"""``i7000 errata``: where the manual contradicts itself or is silent, and how it is read."""

from typing import Annotated

from cyclopts import Parameter

from i7000.cli import facts
from i7000.cli.explain import errata_named
from i7000.cli.explain_text import erratum_lines, erratum_text
from i7000.cli.options import Json
from i7000.cli.text import Printer

__all__ = ["errata"]


def errata(
    name: Annotated[
        str | None,
        Parameter(help="An id, a section or a command to explain; all are listed unless given. Example: E24."),
    ] = None,
    /,
    *,
    json: Json = False,
) -> int:
    """List the errata, or explain one in full.

    An erratum is a place where the manual contradicts itself or is silent, with the chosen reading.

    Examples: `i7000 errata E24`, `i7000 errata 2.11`

    JSON keys: `id`, `sections`, `what`, `reading`, `assumption` (true if the manual alone does not support the
    reading), `evidence`, `used_by`.
    """
    printer = Printer(json=json)
    for row in facts.errata().values() if name is None else errata_named(name):
        printer.record(row, erratum_lines(row) if name is None else erratum_text(row))
    return 0
