"""Frames of both protocols, of every kind that has a shape or length of its own."""

from typing import Final

from i7000 import modbus

REQUEST: Final = modbus.seal(bytes.fromhex("010400000001"))
RESPONSE: Final = modbus.seal(bytes.fromhex("0104020b61"))
MODBUS: Final = [
    modbus.seal(bytes.fromhex(body))
    for body in (
        "010400000008", "01041007d007d1000000ff80007fff0a0d1c25", "010601e80064", "010f00310005011f",
        "11100000000204000a0102", "018302", "0a030d0a0002", "20040000000d",
    )
]  # fmt: skip
DCON: Final = [
    f"{body}\r".encode()
    for body in (
        "$012", "!01050600", "#01", "#010", ">+0025.1+0025.3+0024.9+9999.9-0003.2+0101.7       +0025.0", ">+025.12",
        "!017018R", "!01B3.7", "?01", "!01", "%0101050600", "$017C0R20", "~01O7019A", "#**", "$019+0032", "!01+0010",
        "~01EO", "@01S1", "#10", "#13", "#0D", "$0D2", "%0D0D050600", "%0A0A050600",
        ">0000012301257FFF1802744F98238124", "$012B7", "~0131FF",
    )
]  # fmt: skip
