"""``i7000 decode`` of a log, against the codecs alone: both directions of each exchange and its readings, in a loop."""

import os
import random
import sys
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from pathlib import Path
from tempfile import TemporaryDirectory

from i7000 import Model, Profile, dcon, modbus
from i7000.cli import main
from tests.benchmarks.timing import Result, at_most, best_times

EXCHANGES = 1000
PROFILE = Profile(Model.M_7017)
READ = dcon.ReadAnalogInputs(0x01)
ASK = modbus.ReadInputRegisters(0x01, 0, 8)

Exchange = tuple[bytes, bytes]
LIMITS = {"differing": 30.0, "equal": 15.0}
"""How often the time of the codecs a log may take, which alone make no words of what they read."""


def exchanges(protocol: str, *, differing: bool) -> list[Exchange]:
    """Polls of a module with eight channels, every response another one or all the same."""
    chance = random.Random(7000)
    found = []
    for _ in range(EXCHANGES):
        if not differing:
            chance.seed(7000)
        if protocol == "dcon":
            report = "".join(f"{chance.uniform(-9.999, 9.999):+07.3f}" for _ in range(8))
            found.append((dcon.encode(READ, PROFILE), f">{report}\r".encode()))
        else:
            words = tuple(chance.randrange(0x10000) for _ in range(8))
            found.append((modbus.encode(ASK), modbus.encode(modbus.InputRegisters(0x01, words))))
    return found


def written(protocol: str, found: list[Exchange]) -> str:
    """A log of exchanges, as a driver writes it."""
    lines = []
    for at, (asked, answered) in enumerate(found):
        when = f"2024-03-07 08:{at // 60 % 60:02}:{at % 60:02}.120"
        for arrow, frame in (("->", asked), ("<-", answered)):
            text = frame[:-1].decode() if protocol == "dcon" else frame.hex(" ").upper()
            lines.append(f"{when} {arrow} {text}\n")
    return "".join(lines)


def codecs_alone(protocol: str, found: list[Exchange]) -> Callable[[], None]:
    """Decode and read, and do nothing with it."""

    def decode_dcon() -> None:
        for asked, answered in found:
            dcon.decode_command(asked, PROFILE)
            response = dcon.decode_response(answered, READ, PROFILE)
            if isinstance(response, dcon.AnalogInputs):
                dcon.readings(response, PROFILE)

    def decode_modbus() -> None:
        for asked, answered in found:
            modbus.decode_request(asked, PROFILE)
            response = modbus.decode_response(answered, ASK, PROFILE)
            if isinstance(response, modbus.InputRegisters):
                modbus.readings(response.values, PROFILE)

    return decode_dcon if protocol == "dcon" else decode_modbus


def decoding(log: Path, protocol: str, *options: str) -> Callable[[], None]:
    """Decode a log with the command line, in this process."""

    def decode() -> None:
        code = main(["decode", "--file", str(log), "--protocol", protocol, "--model", "M-7017", *options])
        assert code == 0

    return decode


def decode_results() -> Iterator[Result]:
    """Compare the command line with the codecs, for text and JSON, differing lines and equal ones."""
    with TemporaryDirectory() as place, Path(os.devnull).open("w", encoding="utf-8") as nowhere:
        for protocol in ("dcon", "rtu"):
            for kind in ("differing", "equal"):
                found = exchanges(protocol, differing=kind == "differing")
                log = Path(place) / f"{protocol}-{kind}.log"
                log.write_text(written(protocol, found), encoding="utf-8")
                with redirect_stdout(nowhere):
                    times = best_times(
                        {
                            "text": decoding(log, protocol),
                            "json": decoding(log, protocol, "--json"),
                            "codecs": codecs_alone(protocol, found),
                        },
                        turns=5,
                    )
                for form in ("text", "json"):
                    what = f"i7000 decode to {form}, {protocol}, {kind} lines, of the codecs alone"
                    yield at_most(what, times[form], times["codecs"], LIMITS[kind])


if __name__ == "__main__":
    for result in decode_results():
        sys.stdout.write(f"{result}\n")
