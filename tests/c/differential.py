"""The example in C against the codec in Python: the same frames to both, most of them nearly right.

``python -m tests.c.differential --frames 1000000`` compiles the example with the sanitizers and runs a million frames.
Frames are those of the vectors, changed at a few places, most of them with a new checksum or CRC; profiles are those of
the vectors too. The seed repeats a run.
"""

import argparse
import json
import subprocess
import sys
from collections.abc import Iterator
from math import isclose
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

from i7000 import dcon, modbus
from i7000.cli.vector_files import all_vectors
from i7000.examples.vector_runner import OPERATIONS, answered
from tests.c import C, compile_c

__all__ = ["SOURCES", "build", "disagreements"]

SOURCES = tuple((C / "example").glob("*.c"))
COMPARED = (
    "dcon.decode_command",
    "dcon.decode_response",
    "modbus.decode_request",
    "modbus.decode_response",
    "readings.read",
)
BATCH = 60
"""The cases that are sent before the first answer is read; more could fill the pipes of both sides."""
LETTERS = b"0123456789ABCDEF+-. $#%~@!>?*CRPMSaf\r\n\x00\x7f\xff"

Record = dict[str, Any]


def build(compiler: str, program: Path, *options: str) -> None:
    """Compile the example."""
    compile_c(compiler, *options, *SOURCES, "-o", program)


def disagreements(program: Path, frames: int, seed: int) -> Iterator[tuple[Record, Record, Record]]:
    """Yield the cases that the program does not answer as the codec in Python does, with both answers."""
    drawn = cases(Random(seed))
    with subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as running:  # noqa: S603 - just compiled
        assert running.stdin
        assert running.stdout
        for start in range(0, frames, BATCH):
            sent: list[Record] = [
                {"cmd": "run", "seq": seq, "case": next(drawn)} for seq in range(start, min(start + BATCH, frames))
            ]
            running.stdin.writelines(json.dumps(message, separators=(",", ":")) + "\n" for message in sent)
            running.stdin.flush()
            for message in sent:
                found = json.loads(running.stdout.readline() or '{"died": true}')
                expected = answered(message, OPERATIONS)
                assert expected
                if not is_same(found, expected):
                    yield message["case"], found, expected


def is_same(found: Record, expected: Record) -> bool:
    """Whether two answers have the same result, or the same fault."""
    if "error" in expected:
        return bool(found.get("error", {}).get("fault") == expected["error"]["fault"])
    return is_equal(found.get("result"), expected.get("result"))


def is_equal(found: Any, expected: Any) -> bool:
    if isinstance(expected, dict):
        return (
            isinstance(found, dict)
            and found.keys() == expected.keys()
            and all(is_equal(found[key], expected[key]) for key in expected)
        )
    if isinstance(expected, tuple):
        return bool(found == list(expected))
    if isinstance(expected, float) and isinstance(found, int | float):
        return isclose(found, expected, rel_tol=1e-12)
    return bool(found == expected)


def cases(random: Random) -> Iterator[Record]:
    """Yield cases without end."""
    known: list[Record] = [
        dict(case.record) for vector in all_vectors() for case in vector.cases if case.operation in COMPARED
    ]
    by_operation = {name: [case for case in known if case["operation"] == name] for name in COMPARED}
    while True:
        operation = random.choice(COMPARED)
        case = random.choice(by_operation[operation])
        given = dict(case["input"])
        profile = case["profile"]
        if operation == "readings.read":
            given["text"] = changed(random, given["text"].encode()).decode("latin1").encode("ascii", "replace").decode()
            if random.random() < 0.2:
                given |= {"type_code": f"{random.randrange(0x1D):02X}"}
        else:
            if random.random() < 0.3:
                other = random.choice(by_operation[operation])
                profile = other["profile"] if is_alike(case, other) else profile
            given["wire"] = sealed(random, bytes.fromhex(given["wire"]), operation, profile).hex()
        yield {"id": case["id"], "operation": operation, "profile": profile, "input": given}


def is_alike(case: Record, other: Record) -> bool:
    """Whether two cases have the same message that was sent, so that the profile of one suits the other."""
    sent = [case["input"].get("command", case["input"].get("request", {})) for case in (case, other)]
    return bool(sent[0].get("type") == sent[1].get("type"))


def sealed(random: Random, wire: bytes, operation: str, profile: Record) -> bytes:
    """Return a frame that is changed within, nearly always with the right checksum or CRC."""
    if random.random() < 0.1:
        return changed(random, wire)
    if operation.startswith("modbus"):
        body = changed(random, wire[:-2])
        return body + modbus.crc16(body).to_bytes(2, "little")
    body = changed(random, wire.removesuffix(b"\r"))
    return dcon.seal(body, checksum=profile["checksum"])


def changed(random: Random, data: bytes) -> bytes:
    """Return bytes with up to three of them changed, dropped, doubled or swapped."""
    found = bytearray(data)
    for _ in range(random.choice((0, 1, 1, 1, 2, 3))):
        at = random.randrange(len(found) + 1)
        byte = random.choice(LETTERS) if random.random() < 0.7 else random.randrange(0x100)
        match random.randrange(6):
            case 0:
                found.insert(at, byte)
            case 1:
                del found[at : at + random.choice((1, 1, 7))]
            case 2 if found:
                end = random.randrange(len(found))
                found[at:at] = found[min(at, end) : max(at, end)]
            case 3 if at + 1 < len(found):
                found[at], found[at + 1] = found[at + 1], found[at]
            case _ if at < len(found):
                found[at] = byte
            case _:
                pass
    return bytes(found[:300])


def main() -> int:
    """Compile the example, compare, and print the first disagreements."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--frames", type=int, default=1_000_000, help="How many frames. Example: --frames 5000")
    parser.add_argument("--seed", type=int, default=0, help="Random seed; the same seed repeats the run.")
    asked = parser.parse_args()
    with TemporaryDirectory() as folder:
        program = Path(folder, "runner")
        build("gcc", program, "-O2", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
        count = 0
        for count, (case, found, expected) in enumerate(disagreements(program, asked.frames, asked.seed), 1):
            print(json.dumps(case), "C:", found, "Python:", expected, sep="\n  ")  # noqa: T201
            if count == 10:
                break
    print(f"{asked.frames} frames with seed {asked.seed}: {count or 'no'} disagreements")  # noqa: T201
    return int(count > 0)


if __name__ == "__main__":
    sys.exit(main())
