"""The proof of the guard for as many strings as there is time for: ``python -m tests.conformance.guard_campaign``.

It draws strings, and goes through all strings of some bytes; the numbers it prints are those of what it has done.
"""

import argparse
import json
import sys
import time
from collections import Counter
from collections.abc import Iterator
from itertools import islice, product
from random import Random

from tests.conformance.acting import COMBINATIONS, Case, combination_of, drawn, outcome_of


def strings_up_to(length: int) -> Iterator[bytes]:
    """All byte strings up to a length, the shortest first."""
    for size in range(length + 1):
        yield from map(bytes, product(range(0x100), repeat=size))


def strings_of(length: int) -> Iterator[bytes]:
    """All byte strings of a length."""
    return map(bytes, product(range(0x100), repeat=length))


def campaign(
    wires: Iterator[bytes | None], seed: int, first: int, until: float
) -> tuple[dict[str, object], list[Case]]:
    """Send strings, drawn ones for None, until a time; return the numbers, and the cases that were not covered."""
    chance = Random(seed)
    acted, combinations, missed, number = Counter[str](), Counter[object](), [], first
    began = time.process_time()
    for number, wire in enumerate(wires, first):
        case = drawn(chance, number, wire)
        outcome = outcome_of(case)
        acted.update(hazard.value for hazard in outcome.acted)
        combinations[combination_of(number)] += 1
        if not outcome.is_covered:
            missed.append(case)
            print(case, outcome, file=sys.stderr)  # noqa: T201 - a program
        if not number % 1000 and time.time() > until:
            break
    numbers: dict[str, object] = {
        "strings": combinations.total(),
        "from": first,
        "to": number,
        "seed": seed,
        "combinations": f"{len(combinations)} of {len(COMBINATIONS)}",
        "acted": dict(sorted(acted.items())),
        "not covered": len(missed),
        "cpu_seconds": round(time.process_time() - began, 1),
    }
    return numbers, missed


def main(arguments: list[str] | None = None) -> int:
    """Run a campaign; exit code 1 if a string was not covered."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--strings", type=int, default=10_000_000, help="how many strings are drawn")
    parser.add_argument("--bytes", type=int, default=3, help="go through all strings of so many bytes; 0 for none")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--part", default="1/1", help="which part of all strings: 2/4 is the second of four")
    parser.add_argument("--minutes", type=float, default=1e6, help="end after this time")
    asked = parser.parse_args(arguments)
    until = time.time() + asked.minutes * 60
    part, parts = map(int, asked.part.split("/"))
    count, every = asked.strings // parts, 0x100**asked.bytes // parts if asked.bytes else 0
    runs: tuple[tuple[str, int, Iterator[bytes | None]], ...] = (
        (f"all of {asked.bytes} bytes", every, islice(strings_of(asked.bytes), (part - 1) * every, part * every)),
        ("drawn", count, (None for _ in range(count))),
    )
    failures = 0
    for name, size, wires in runs:
        if size:
            numbers, missed = campaign(wires, asked.seed + part, (part - 1) * size, until)
            failures += len(missed)
            print(json.dumps({"what": name, **numbers}), flush=True)  # noqa: T201
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
