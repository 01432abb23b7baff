"""Modbus against hand-written floors and against peers: a floor is `struct` and a table CRC in one tight function."""

import importlib
import random
import struct
from collections.abc import Callable, Iterator
from typing import Any

from i7000 import Model, Profile, modbus
from tests.benchmarks.timing import Result, Task, at_least, at_most, best_times, not_compared

PROFILE = Profile(Model.M_7017)
REQUEST = modbus.ReadHoldingRegisters(0x01, 0, 10)
VALUES = tuple(range(1000, 11000, 1000))
REQUEST_FRAME = modbus.encode(REQUEST)
FRAME = modbus.encode(modbus.HoldingRegisters(0x01, VALUES))


def table_of_bytes() -> list[int]:
    table = []
    for byte in range(256):
        crc = byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xA001 if crc & 1 else 0)
        table.append(crc)
    return table


TABLE = table_of_bytes()


def floor_crc(data: bytes) -> int:
    crc = 0xFFFF
    for byte in data:
        crc = (crc >> 8) ^ TABLE[(crc ^ byte) & 0xFF]
    return crc


def floor_encode(address: int, start: int, count: int) -> bytes:
    body = struct.pack(">BBHH", address, 3, start, count)
    crc = 0xFFFF
    for byte in body:
        crc = (crc >> 8) ^ TABLE[(crc ^ byte) & 0xFF]
    return body + struct.pack("<H", crc)


def floor_decode(frame: bytes) -> tuple[int, ...]:
    crc = 0xFFFF
    for byte in frame[:-2]:
        crc = (crc >> 8) ^ TABLE[(crc ^ byte) & 0xFF]
    if crc != struct.unpack_from("<H", frame, len(frame) - 2)[0]:
        raise ValueError(frame)
    return struct.unpack_from(f">{frame[2] // 2}H", frame, 3)


class FloorSplitter:
    """Responses by function and CRC, and nothing else looked at; noise is dropped."""

    def __init__(self) -> None:
        self.buffer = b""

    def feed(self, data: bytes) -> list[bytes]:
        """The frames that are complete with `data`."""
        buffer = self.buffer + data
        frames = []
        at, size = 0, len(buffer)
        while size - at >= 5:
            function = buffer[at + 1]
            if 1 <= function <= 4:
                length = 5 + buffer[at + 2]
            elif function in (5, 6, 15, 16):
                length = 8
            elif function > 0x80:
                length = 5
            else:
                at += 1
                continue
            if at + length > size:
                break
            frame = buffer[at : at + length]
            crc = 0xFFFF
            for byte in frame:
                crc = (crc >> 8) ^ TABLE[(crc ^ byte) & 0xFF]
            if crc:
                at += 1
            else:
                frames.append(frame)
                at += length
        self.buffer = buffer[at:]
        return frames


# --- peers ------------------------------------------------------------------------------------------------------------


def pymodbus() -> tuple[Task, Task]:
    """Messages and framer of pymodbus."""
    framing, pdu = importlib.import_module("pymodbus.framer"), importlib.import_module("pymodbus.pdu")
    messages = importlib.import_module("pymodbus.pdu.register_message")
    framer = framing.FramerRTU(pdu.DecodePDU(is_server=False))
    return (
        lambda: framer.buildFrame(messages.ReadHoldingRegistersRequest(dev_id=1, address=0, count=10)),
        lambda: tuple(framer.handleFrame(FRAME, 1, 0)[1].registers),
    )


def modbus_tk() -> tuple[Task, Task]:
    """What the master of modbus-tk does to build a request and to read its response, without the line between."""
    rtu = importlib.import_module("modbus_tk.modbus_rtu")
    query = rtu.RtuQuery()
    query.build_request(REQUEST_FRAME[1:-2], 1)

    def decode() -> tuple[int, ...]:
        pdu = query.parse_response(FRAME)
        function, count = struct.unpack(">BB", pdu[0:2])
        data = pdu[2:]
        if function > 0x80 or count != len(data):
            raise ValueError(pdu)
        return struct.unpack(">" + 10 * "H", data)

    return lambda: rtu.RtuQuery().build_request(struct.pack(">BHH", 3, 0, 10), 1), decode


def umodbus() -> tuple[Task, Task]:
    """The RTU client of uModbus, without its port."""
    rtu = importlib.import_module("umodbus.client.serial.rtu")
    return (
        lambda: rtu.read_holding_registers(1, 0, 10),
        lambda: tuple(rtu.parse_response_adu(FRAME, REQUEST_FRAME)),
    )


def minimalmodbus() -> tuple[Task, Task]:
    """What the instrument of minimalmodbus does, without the line."""
    it = importlib.import_module("minimalmodbus")
    registers = it._Payloadformat.REGISTERS  # noqa: SLF001 - it offers nothing without a line
    call = (3, 0, None, 0, 10, 0, False, it.BYTEORDER_BIG, registers)
    return (
        lambda: it._embed_payload(1, "rtu", 3, it._create_payload(*call)),  # noqa: SLF001
        lambda: tuple(it._parse_payload(it._extract_payload(FRAME, 1, "rtu", 3), *call)),  # noqa: SLF001
    )


PEERS: dict[str, Callable[[], tuple[Task, Task]]] = {
    "pymodbus": pymodbus,
    "modbus-tk": modbus_tk,
    "uModbus": umodbus,
    "minimalmodbus": minimalmodbus,
}

# --- results ----------------------------------------------------------------------------------------------------------


def codec_results() -> Iterator[Result]:
    """Encode a request, decode its response; CRC."""
    ours: dict[str, Task] = {
        "encode": lambda: modbus.encode(modbus.ReadHoldingRegisters(0x01, 0, 10)),
        "floor encode": lambda: floor_encode(0x01, 0, 10),
        "decode": lambda: modbus.decode_response(FRAME, REQUEST, PROFILE),
        "floor decode": lambda: floor_decode(FRAME),
    }
    peers: dict[str, Task] = {}
    for name, make in PEERS.items():
        try:
            peers[f"{name} encode"], peers[f"{name} decode"] = make()
        except ImportError:
            yield not_compared(f"{name}, which is not installed")
    for name, task in (ours | peers).items():
        if name.endswith(" encode"):
            assert task() == REQUEST_FRAME, name
        elif name.endswith(" decode"):
            assert task() == VALUES, name
    times = best_times(ours | peers, turns=100, seconds=0.004)
    yield at_least("request from integers -> RTU frame, of the floor", times["encode"], times["floor encode"], 0.6)
    yield at_least("response of 10 registers, of the floor's tuple", times["decode"], times["floor decode"], 0.9)
    for peer in peers:
        name, direction = peer.rsplit(" ", 1)
        what = "request -> RTU frame" if direction == "encode" else "response of 10 registers"
        yield at_least(f"{what}, of {name}", times[direction], times[peer], 1.2)
    yield from crc_results()


def crc_results() -> Iterator[Result]:
    """CRC of a short and of a long frame."""
    noise = random.Random(7000).randbytes(256)
    short = noise[:8]
    times = best_times(
        {
            "8": lambda: modbus.crc16(short),
            "floor 8": lambda: floor_crc(short),
            "256": lambda: modbus.crc16(noise),
            "floor 256": lambda: floor_crc(noise),
        },
        turns=100,
        seconds=0.004,
    )
    yield at_least("CRC of 8 bytes, of the floor", times["8"], times["floor 8"], 1.0)
    yield at_least("CRC of 256 bytes, of the floor", times["256"], times["floor 256"], 2.2)


def split_all(stream: bytes, size: int, side: modbus.Side = modbus.Side.RESPONSES) -> int:
    """Feed a stream in pieces and count the frames."""
    found = 0
    rest = b""
    for at in range(0, len(stream), size):
        frames, rest = modbus.split(rest + stream[at : at + size], side)
        if frames:
            found += len([frame for frame in frames if frame.__class__ is bytes])
    return found


def floor_split_all(stream: bytes, size: int) -> int:
    """The same with the floor."""
    splitter = FloorSplitter()
    found = 0
    for at in range(0, len(stream), size):
        found += len(splitter.feed(stream[at : at + size]))
    return found


def splitter_results() -> Iterator[Result]:
    """Find the frames of a stream however it arrives, and eat noise."""
    count = (1 << 20) // len(FRAME)
    stream = FRAME * count
    noise = random.Random(7000).randbytes(1 << 14)
    tasks: dict[str, Task] = {}
    for size, frames in ((1, 64), (64, 256), (4096, 1024)):  # each takes some milliseconds
        assert count == split_all(stream, size) == floor_split_all(stream, size)
        part = FRAME * frames
        tasks[f"{size}"] = _call(split_all, part, size)
        tasks[f"floor {size}"] = _call(floor_split_all, part, size)
    tasks |= {"noise": _call(split_all, noise, 4096), "floor noise": _call(floor_split_all, noise, 4096)}
    times = best_times(tasks, turns=100, seconds=0.004)
    for size, target in ((64, 0.8), (4096, 0.8), (1, 0.9)):
        what = f"split in chunks of {size} bytes, of the floor"
        yield at_least(what, times[f"{size}"], times[f"floor {size}"], target)
    yield at_least("split noise, of the floor", times["noise"], times["floor noise"], 0.8)
    assert count == split_all(stream, len(stream)) == split_all(stream, 1 << 16)
    times = best_times(
        {"one call": _call(split_all, stream, len(stream)), "64 KB": _call(split_all, stream, 1 << 16)}, turns=9
    )
    yield at_most("split 1 MB in one call, of 64 KB calls", times["one call"], times["64 KB"], 1.3)
    noise = random.Random(7000).randbytes(1 << 18)
    times = best_times({"split": _call(modbus.split, noise), "flush": _call(modbus.flush, noise)}, turns=9)
    yield at_most("flush 256 KB of noise, of splitting it", times["flush"], times["split"], 1.3)


def _call(function: Callable[..., Any], *arguments: Any) -> Task:
    return lambda: function(*arguments)
