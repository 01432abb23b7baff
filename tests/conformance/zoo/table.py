"""The page of the zoo: which check catches which animal."""

import re
from collections.abc import Mapping
from pathlib import Path

from tests.conformance.zoo.species import Species

PAGE = Path(__file__).parents[3] / "docs" / "zoo.md"

_HEAD = """# The zoo: firmware at fault

The checks of `i7000 check` are tested with firmware that has one bug each: models of modules, changed in one place.
A check that finds no bug proves nothing, so each has to find one. `python -m tests.conformance.zoo` lists the animals,
and `python -m tests.conformance.zoo NAME` plays one on standard input and output:

```sh
i7000 check 'exec:python -m tests.conformance.zoo dcon/answers-foreign-addresses' --address 1
```

This page is made by `python -m tests.conformance.zoo --table`. A run is allowed what the second last column says,
beside reads. In the last column are the checks that fail: first, in bold type, those that have to.

| Animal | Module | Bug | Allowed | Checks that fail |
|---|---|---|---|---|
"""


def page(zoo: Mapping[str, Species], found: Mapping[str, tuple[str, ...]]) -> str:
    """Return the page, for animals and the checks that each of them fails."""
    return _HEAD + "".join(_row(name, zoo[name], found[name]) for name in sorted(zoo))


def _row(name: str, species: Species, found: tuple[str, ...]) -> str:
    allowed = ", ".join(hazard.value for hazard in species.allow)
    checks = [f"**{it}**" for it in species.caught if it in found]
    checks += [it for it in sorted(found) if it not in species.caught]
    return f"| {name} | {species.eeprom.model.value} | {_plain(species.bug)} | {allowed} | {', '.join(checks)} |\n"


def _plain(text: str) -> str:
    return text.replace("``", "`").replace("|", "\\|")


def told() -> dict[str, tuple[str, ...]]:
    """Return the checks that each animal fails, as the page has them."""
    rows = re.findall(r"^\| ([a-z]\S*/\S+) \|.*\| ([^|]*) \|$", PAGE.read_text("utf-8"), re.MULTILINE)
    return {name: tuple(sorted(it.strip("*") for it in checks.split(", ") if it)) for name, checks in rows}
