"""List the animals of the zoo, play one of them on standard input and output, or print the table."""

import argparse
import os
import sys
from queue import Empty, Queue
from threading import Thread
from time import monotonic, sleep

from i7000.link.process import INIT_SWITCH
from tests.conformance.zoo import zoo
from tests.conformance.zoo.animal import Animal, serve
from tests.conformance.zoo.catch import caught_of
from tests.conformance.zoo.species import Species, settings, signals_of
from tests.conformance.zoo.table import page

_CLEAN = "clean"
"""The name of the module without a bug."""


def _played(name: str) -> Species | None:
    if name == _CLEAN:
        from i7000 import Model  # noqa: PLC0415

        eeprom = settings(Model.M_7019R)
        return Species(name, "No bug.", Animal, eeprom, signals_of(eeprom), (), (), 0, ())
    return zoo().get(name)


def _play(animal: Animal) -> None:
    heard: Queue[bytes] = Queue(1024)

    def hear() -> None:
        while data := os.read(sys.stdin.fileno(), 4096):
            heard.put(data)
        heard.put(b"")

    def read(seconds: float) -> bytes | None:
        try:
            return heard.get(timeout=seconds)
        except Empty:
            return None

    def write(data: bytes) -> None:
        os.write(sys.stdout.fileno(), data)

    Thread(target=hear, daemon=True).start()
    serve(animal, read, write, monotonic, sleep)


def main() -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(prog="python -m tests.conformance.zoo", description=__doc__)
    parser.add_argument("name", nargs="?", help="the animal to play; clean is a module without a bug")
    parser.add_argument("--table", action="store_true", help="print docs/zoo.md")
    given = parser.parse_args()
    if given.table:
        animals = zoo()
        sys.stdout.write(page(animals, {name: tuple(caught_of(it).ids) for name, it in animals.items()}))
        return 0
    if given.name is None:
        for name, species in zoo().items():
            sys.stdout.write(f"{name}: {species.bug}\n")
        return 0
    played = _played(given.name)
    if played is None:
        sys.stderr.write(f"there is no {given.name}: python -m tests.conformance.zoo lists all\n")
        return 2
    _play(played.born(init_switch=os.environ.get(INIT_SWITCH) == "1", now=monotonic()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
