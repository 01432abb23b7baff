"""The first inputs of each target, made from ``spec/vectors``: ``python -m fuzz.seeds FOLDER``.

They are not kept in the repository: they follow the vectors. `campaign` makes them anew for every run.
"""

import json
import sys
from collections.abc import Callable, Iterator
from functools import cache
from hashlib import sha1
from pathlib import Path
from typing import Any

from fuzz.codec_targets import COMMANDS, REQUESTS, SEALED
from fuzz.inputs import header
from fuzz.targets import FOLDER, TARGETS
from i7000 import DataFormat, Firmware, ModbusDataFormat, Model, Profile, TypeCode

__all__ = ["main", "seeds", "write"]

SPEC = FOLDER.parent / "spec"
Vector = dict[str, Any]


@cache
def _vectors(folder: str) -> tuple[Vector, ...]:
    paths = sorted((SPEC / "vectors").glob(f"{folder}.json" if "/" in folder else f"{folder}/*.json"))
    return tuple(vector for path in paths for vector in json.loads(path.read_text(encoding="utf-8"))["vectors"])


def _header(record: Vector) -> bytes:
    """Return the bytes that select the profile of a vector."""
    return header(
        Profile(
            Model.find(record["model"]),
            firmware=None if record["firmware"] is None else Firmware(record["firmware"]),
            single_ended=record["single_ended"],
            type_codes=tuple(TypeCode(code) for code in record["type_codes"]),
            data_format=DataFormat[record["data_format"].upper()],
            checksum=record["checksum"],
            modbus_data_format=ModbusDataFormat[record.get("modbus_data_format", "hex").upper()],
        )
    )


def _places(messages: tuple[Any, ...]) -> dict[str, int]:
    """Return the place of the first message of each class in a table."""
    return {type(message).__name__: at for at, message in reversed(list(enumerate(messages)))}


def _frames(protocol: str, asked: str, side: str) -> Iterator[bytes]:
    """Yield the frames of one side as they are, and their bodies to be sealed again."""
    places = _places(COMMANDS if protocol == "dcon" else REQUESTS)
    for vector in _vectors(protocol):
        if not vector[f"{side}_wire"]:
            continue
        wire = bytes.fromhex(vector[f"{side}_wire"])
        end = 2 if protocol == "modbus" else 3 if vector["profile"]["checksum"] else 1
        start = _header(vector["profile"])
        place = places.get(vector[asked]["type"], 0) if vector[asked] else 0
        yield start + bytes((place,)) + wire
        yield start + bytes((place | SEALED,)) + wire[:-end]


_SEEDS: dict[str, Callable[[], Iterator[bytes]]] = {
    "dcon_command": lambda: _frames("dcon", "command", "command"),
    "dcon_response": lambda: _frames("dcon", "command", "response"),
    "modbus_request": lambda: _frames("modbus", "request", "request"),
    "modbus_response": lambda: _frames("modbus", "request", "response"),
}


def seeds(target: str) -> tuple[bytes, ...]:
    """Return the seeds of a target, each once, none longer than the target takes."""
    return tuple(dict.fromkeys(seed for seed in _SEEDS[target]() if len(seed) <= TARGETS[target].longest))


def write(target: str, folder: Path) -> int:
    """Write the seeds of a target as files that are named by their content; return how many there are."""
    folder.mkdir(parents=True, exist_ok=True)
    found = seeds(target)
    for seed in found:
        (folder / sha1(seed, usedforsecurity=False).hexdigest()).write_bytes(seed)
    return len(found)


def main(arguments: list[str]) -> int:
    """Write the seeds of all targets, each into a folder of its own."""
    if len(arguments) != 1:
        print("python -m fuzz.seeds FOLDER", file=sys.stderr)  # noqa: T201
        return 2
    for target in TARGETS:
        print(f"{target}: {write(target, Path(arguments[0]) / target)} seeds")  # noqa: T201
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
