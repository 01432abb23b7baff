"""How tshark is asked about RTU frames: they are given as a capture of a user-defined link type."""

import struct
import subprocess
from collections.abc import Iterable
from pathlib import Path

from attrs import frozen

LINK_TYPE = 147
OPTIONS = (
    "-o", f'uat:user_dlts:"User 0 (DLT={LINK_TYPE})","mbrtu","0","","0",""',
    "-o", "mbrtu.crc_verification:TRUE",
)  # fmt: skip
FIELDS = (
    "frame.len",
    "mbrtu.unit_id",
    "modbus.func_code",
    "mbrtu.crc16.status",
    "modbus.reference_num",
    "modbus.word_cnt",
    "modbus.bit_cnt",
    "modbus.bitval",
    "modbus.regval_uint16",
    "modbus.data",
    "modbus.exception_code",
)

MISSING = "<MISSING>"
"""What tshark says of data that a frame should have and has not."""


@frozen
class Dissected:
    """What tshark says of one frame; None or nothing for what it does not name."""

    length: int
    address: int | None
    function: int | None
    good_crc: bool | None
    start: int | None
    count: int | None
    bits: tuple[int, ...]
    words: tuple[int, ...]
    data: bytes
    exception_code: int | None


def write_capture(path: Path, frames: Iterable[bytes]) -> None:
    """Write a pcap file, one frame a second."""
    header = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 0xFFFF, LINK_TYPE)
    packets = (struct.pack("<IIII", at, 0, len(it), len(it)) + it for at, it in enumerate(frames))
    path.write_bytes(header + b"".join(packets))


def dissect(tshark: str, capture: Path) -> list[Dissected]:
    """Dissect every frame of a capture with tshark."""
    columns = [argument for field in FIELDS for argument in ("-e", field)]
    command = [tshark, "-r", str(capture), *OPTIONS, "-T", "fields", *columns]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout  # noqa: S603 - our arguments
    return [_dissected(line.split("\t")) for line in output.splitlines()]


def _dissected(columns: list[str]) -> Dissected:
    length, address, function, crc, start, words, bits, bit_values, word_values, data, exception = columns
    return Dissected(
        length=int(length),
        address=_number(address),
        function=_number(function),
        good_crc={"1": True, "0": False}.get(crc[:1]),
        start=_number(start),
        count=_number(words or bits),
        bits=_numbers(bit_values),
        words=_numbers(word_values),
        data=b"" if data == MISSING else bytes.fromhex(data),
        exception_code=_number(exception),
    )


def _number(text: str) -> int | None:
    """Read a number: the first where it takes what follows the length it expects for another frame."""
    return int(text.partition(",")[0]) if text else None


def _numbers(text: str) -> tuple[int, ...]:
    return tuple(map(int, text.split(","))) if text else ()
