"""The rule for the gaps of a map (E94, E99), and every exception of ``spec/`` to a standard function against it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.each import each
from tests.spec import lint
from tests.spec.test_modbus import FUNCTIONS, MAPS, READ, WRITE, WRITE_MORE, has, touched

if TYPE_CHECKING:
    from tests.spec.lint import Record

STANDARD = READ | WRITE | WRITE_MORE
"""The area of each request that touches a map."""
EXCEPTIONS = [
    vector
    for _, vector in lint.vectors("modbus")
    if vector["outcome"] == "exception" and vector["request"]["type"] in STANDARD
]
SPANNED = {code for code, row in FUNCTIONS.items() if row["minimum_count"] is not None}
"""The functions with a count."""


def places(profile: Record, area: str, way: str) -> set[int]:
    """The addresses that a map has for reading or for writing."""
    (chart,) = (chart for chart in MAPS.values() if profile["model"] in chart["models"])
    found = (
        range(row["address"], row["address"] + row["count"])
        for row in chart["rows"]
        if row["area"] == area and way in row["access"]
        if has(dict.fromkeys(row["models"] or chart["models"], row["firmware"]), profile)
    )
    return {address for addresses in found for address in addresses}


def code_of(vector: Record) -> int:
    """The exception code of a request that gets one."""
    profile = vector["profile"]
    (function,) = (row for row in FUNCTIONS.values() if row["name"] == vector["request"]["type"])
    if not has(function["models"], profile):
        return 1
    way, area, start, count = touched(vector)
    (chart,) = (chart for chart in MAPS.values() if profile["model"] in chart["models"])
    most = chart["maximum_write_count"] if area == "holding_register" and way == "W" else None
    return 3 if start in places(profile, area, way) or count > (most or count) else 2


@each("vector", [pytest.param(vector, id=vector["id"]) for vector in EXCEPTIONS])
def test_the_start_decides_between_02_and_03(vector: Record) -> None:
    assert vector["response"]["fields"]["exception_code"] == code_of(vector)


def test_the_gaps_of_every_function_with_a_count_are_shown() -> None:
    """Discrete inputs are one row, so that nothing can go over a gap."""
    shown: set[tuple[str, str]] = set()
    for vector in EXCEPTIONS:
        way, area, start, count = touched(vector)
        there = places(vector["profile"], area, way)
        if count > 1 and any(address in there for address in range(start, start + count)):
            first, last = start in there, start + count - 1 in there
            kind = {(False, True): "from", (True, False): "into", (True, True): "over"}.get((first, last))
            shown |= {(vector["request_wire"][2:4].upper(), kind)} if kind else set()

    assert shown == {(code, kind) for code in SPANNED for kind in ("from", "into", "over")} - {("02", "over")}
