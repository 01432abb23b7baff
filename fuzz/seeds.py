"""The first inputs of each target, made from ``spec/vectors``: ``python -m fuzz.seeds FOLDER``.

They are not kept in the repository: they follow the vectors. `campaign` makes them anew for every run.
"""

import json
import struct
import sys
from collections.abc import Callable, Iterator
from functools import cache
from hashlib import sha1
from pathlib import Path
from typing import Any

from fuzz.behaviour_targets import BY_MODBUS, OTHER_PROTOCOL
from fuzz.codec_targets import COMMANDS, REQUESTS, SEALED
from fuzz.inputs import header
from fuzz.stream_targets import WITH_PROFILE
from fuzz.targets import FOLDER, TARGETS
from fuzz.value_targets import FORMATS, LEGACY, TYPES
from i7000 import (
    DataFormat,
    Firmware,
    InvalidValueError,
    ModbusDataFormat,
    Model,
    Profile,
    Protocol,
    TypeCode,
    modbus,
)
from i7000.host.procedures import Snapshot
from i7000.host.procedures.settings import known_settings
from i7000.recording import Carried, End, Event, Start, pcapng, text

__all__ = ["main", "seeds", "write"]

SPEC = FOLDER.parent / "spec"
Vector = dict[str, Any]
_CUT = b"\x05"
_LOG_FRAMES = 60
"""The number of vectors whose frames become lines of logs; all of them would be too many of one kind."""


@cache
def _vectors(pattern: str) -> tuple[Vector, ...]:
    paths = sorted((SPEC / "vectors").glob(f"{pattern}.json"))
    return tuple(vector for path in paths for vector in json.loads(path.read_text(encoding="utf-8"))["vectors"])


def _profile(record: Vector) -> Profile:
    return Profile(
        Model.find(record["model"]),
        firmware=None if record["firmware"] is None else Firmware(record["firmware"]),
        single_ended=record["single_ended"],
        type_codes=tuple(TypeCode(code) for code in record["type_codes"]),
        data_format=DataFormat[record["data_format"].upper()],
        checksum=record["checksum"],
        modbus_data_format=ModbusDataFormat[record.get("modbus_data_format", "hex").upper()],
    )


def _header(record: Vector) -> bytes:
    """Return the bytes that select the profile of a vector."""
    return header(_profile(record))


def _places(messages: tuple[Any, ...]) -> dict[str, int]:
    """Return the place of the first message of each class in a table."""
    return {type(message).__name__: at for at, message in reversed(list(enumerate(messages)))}


class _Exchange:
    """The two frames of a vector."""

    def __init__(self, protocol: str, vector: Vector) -> None:
        self.protocol = protocol
        asked = "command" if protocol == "dcon" else "request"
        self.start = _header(vector["profile"])
        self.sent = bytes.fromhex(vector[f"{asked}_wire"] or "")
        self.answer = bytes.fromhex(vector["response_wire"] or "")
        self.end = 2 if protocol == "modbus" else 3 if vector["profile"]["checksum"] else 1
        """The bytes of a frame that are not its body."""
        places = _places(COMMANDS if protocol == "dcon" else REQUESTS)
        self.place = places.get(vector[asked]["type"], 0) if vector[asked] else 0


@cache
def _exchanges(protocol: str) -> tuple[_Exchange, ...]:
    return tuple(_Exchange(protocol, vector) for vector in _vectors(f"{protocol}/*"))


def _frames(protocol: str, side: str) -> Iterator[bytes]:
    """Yield the frames of one side as they are, and their bodies to be sealed again."""
    for it in _exchanges(protocol):
        wire: bytes = getattr(it, side)
        if wire:
            yield it.start + bytes((it.place,)) + wire
            yield it.start + bytes((it.place | SEALED,)) + wire[: -it.end]


def _fields() -> Iterator[bytes]:
    for name in ("engineering", "percent", "hex", "rejected"):
        for vector in _vectors(f"readings/{name}"):
            place = TYPES.index(TypeCode(int(vector["type_code"], 16)))
            data_format = FORMATS.index(DataFormat[vector["format"].upper()])
            yield bytes((place, data_format)) + vector["text"].encode()
    for vector in _vectors("readings/legacy"):
        profile = _profile(vector["profile"])
        for field in vector["values"]:
            place = TYPES.index(profile.type_codes[0])
            yield bytes((place, FORMATS.index(profile.data_format) | LEGACY)) + field.encode()


def _words(items: list[int]) -> bytes:
    return struct.pack(f">{len(items)}H", *(item & 0xFFFF for item in items if isinstance(item, int)))


def _reading_words() -> Iterator[bytes]:
    for vector in _vectors("registers/readings"):
        yield _header(vector["profile"]) + bytes((vector["first"],)) + _words(vector["items"])


def _registers() -> Iterator[bytes]:
    for vector in _vectors("registers/*"):
        rows = modbus.RegisterMap(_profile(vector["profile"])).rows
        place = [row.name for row in rows].index(vector["name"])
        yield _header(vector["profile"]) + bytes((place, bool(vector["big_endian"]))) + _words(vector["items"])


def _dcon_streams() -> Iterator[bytes]:
    for vector in _vectors("frames/split"):
        yield bytes((vector["checksum"],)) + _CUT + bytes.fromhex(vector["stream"])


def _modbus_streams() -> Iterator[bytes]:
    sides = [side.value for side in modbus.Side]
    for vector in _vectors("frames/rtu_split"):
        profile = vector["profile"]
        options = sides.index(vector["side"]) | (WITH_PROFILE if profile else 0)
        start = _header(profile) if profile else bytes(3)
        yield start + bytes((options, 0)) + _CUT + bytes.fromhex(vector["stream"])


def _both() -> Iterator[_Exchange]:
    for protocol in ("dcon", "modbus"):
        yield from (it for it in _exchanges(protocol) if it.sent)


def _device() -> Iterator[bytes]:
    for it in _both():
        body = it.sent[: -it.end]
        options = OTHER_PROTOCOL if it.protocol == "dcon" else 0
        if 0 < len(body) < SEALED:
            yield it.start + bytes((options, len(body) | SEALED)) + body + bytes((len(it.sent),)) + it.sent


def _bus() -> Iterator[bytes]:
    for it in _both():
        options = (OTHER_PROTOCOL if it.protocol == "dcon" else 0) | 0x10
        yield it.start + bytes((options,)) + _CUT + it.sent * 2


def _host() -> Iterator[bytes]:
    for it in _both():
        options = 0 if it.protocol == "dcon" else BY_MODBUS
        if 0 < len(it.answer) < SEALED:
            half = len(it.answer) // 2
            parts = (it.answer[:half], it.answer[half:])
            pieces = b"".join(bytes((len(part),)) + part for part in parts)
            yield it.start + bytes((options, it.place)) + pieces


def _spelled() -> Iterator[tuple[str, str]]:
    """Yield frames as people and programs write them, of a command and of its response."""
    exchanges = list(_both())
    for at, it in enumerate(exchanges[:: max(1, len(exchanges) // _LOG_FRAMES)]):
        spell: Callable[[bytes], str] = (
            lambda wire: wire.hex(" "),
            lambda wire: " ".join(f"0x{byte:x}" for byte in wire),
            repr,
            lambda wire: wire.hex().upper(),
            lambda wire: wire.decode("latin-1").strip("\r"),
            lambda wire: str(list(wire)),
        )[at % 6]
        yield f"12:00:0{at % 10}.125 TX {spell(it.sent)}", f"12:00:0{at % 10}.130 RX {spell(it.answer)}"


def _logs() -> Iterator[bytes]:
    for at, (sent, answer) in enumerate(_spelled()):
        yield bytes((at % 3,)) + f"{sent}\n{answer}\n".encode()
    for it in list(_both())[::97]:
        rows = (f"{at:08x}  {it.sent[at : at + 8].hex(' ')}  |x|\n" for at in range(0, len(it.sent), 8))
        yield b"\0" + "".join(rows).encode()


def _streams() -> Iterator[bytes]:
    for at, it in enumerate(list(_both())[::7]):  # the target is too slow for all of them
        yield it.start + bytes((at % 8,)) + _CUT + it.sent + it.answer


def _captures() -> Iterator[bytes]:
    for it in list(_both())[::37]:
        protocol = Protocol.DCON if it.protocol == "dcon" else Protocol.MODBUS_RTU
        packets = [
            pcapng.packet(1.5, wire, protocol, sent=sent, notes=("late",))
            for wire, sent in ((it.sent, True), (it.answer, False))
        ]
        yield _CUT + pcapng.header("i7000") + b"".join(packets)
        record = struct.pack("<IIII", 1, 2, len(it.sent), len(it.sent)) + it.sent
        for link_type, head in ((147, b""), (250, bytes(12))):
            pcap = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, link_type)
            yield _CUT + pcap + (record if not head else struct.pack("<IIII", 1, 2, 12, 12) + head)


def _recordings() -> Iterator[bytes]:
    start = Start("2026-11-30T16:30:00.000000+00:00", "i7000 listen", "0.1.0", "COM3")
    for it in list(_both())[::37]:
        protocol = Protocol.DCON if it.protocol == "dcon" else Protocol.MODBUS_RTU
        carried = Carried(0.25, it.sent, sent=True, protocol=protocol, place="1", notes=("late",))
        records = (start, carried, Carried(0.5, it.answer), Event(1.0, "power cycle"), End(1.5))
        yield "".join(f"{text(record)}\n" for record in records).encode()


_VALUES = (1, 0, 0.5, True, "K", "V 2.5", "hex", "dcon", "N81", 9600, "7018", (0, 1), "reject 50 Hz", "started")


def _snapshots() -> Iterator[bytes]:
    for model in Model:
        settings: dict[str, Any] = {}
        for name in known_settings(model):
            for value in _VALUES:
                try:
                    Snapshot(model, settings={name: value})
                except InvalidValueError:
                    continue
                settings[name] = value
                break
        yield Snapshot(model, settings=settings).to_json().encode()
        few = dict(list(settings.items())[:3])
        yield Snapshot(model, "B3.6", "7018", settings=few, unread={"filter": "no answer"}).to_json().encode()


_SEEDS: dict[str, Callable[[], Iterator[bytes]]] = {
    "dcon_command": lambda: _frames("dcon", "sent"),
    "dcon_response": lambda: _frames("dcon", "answer"),
    "modbus_request": lambda: _frames("modbus", "sent"),
    "modbus_response": lambda: _frames("modbus", "answer"),
    "reading_text": _fields,
    "reading_words": _reading_words,
    "registers": _registers,
    "dcon_split": _dcon_streams,
    "modbus_split": _modbus_streams,
    "device_step": _device,
    "bus_hear": _bus,
    "host_receive": _host,
    "log_find": lambda: (line.encode() for pair in _spelled() for line in pair),
    "log_pieces": _logs,
    "stream_hear": _streams,
    "capture": _captures,
    "recording": _recordings,
    "snapshot": _snapshots,
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
