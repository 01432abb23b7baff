"""The dissector for Wireshark, asked through tshark: frames go in as a capture, what tshark says of each comes out."""

import os
import struct
import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from tests.interop import program
from tests.spec.lint import vectors
from tests.waiting import ENOUGH

ROOT = Path(__file__).parents[2]
DISSECTOR = ROOT / "wireshark" / "i7000.lua"
RTU, DCON, ETHERNET = 147, 148, 1
"""Link types."""
_SEPARATOR = "\x1f"
_SECTION, _INTERFACE, _PACKET, _FLAGS = 0x0A0D0D0A, 1, 6, 2


class Frame(NamedTuple):
    """A packet of a capture."""

    data: bytes
    sent: bool | None = None
    """Whether a host sent it; None writes no direction."""
    interface: int = 0


Seen = dict[str, list[str]]
"""The values of the fields that were asked for; none for a field that a packet does not have."""


def _block(kind: int, body: bytes) -> bytes:
    length = struct.pack("<I", len(body) + 12)
    return struct.pack("<I", kind) + length + body + length


def write_capture(path: Path, link_types: Iterable[int], frames: Iterable[Frame], *, kept: int | None = None) -> None:
    """Write a capture (pcapng), one frame a second; of each, `kept` bytes at most."""
    blocks = [_block(_SECTION, struct.pack("<IHHQ", 0x1A2B3C4D, 1, 0, 0xFFFF_FFFF_FFFF_FFFF))]
    blocks += [_block(_INTERFACE, struct.pack("<HHI", link_type, 0, 0)) for link_type in link_types]
    for second, (data, sent, interface) in enumerate(frames):
        high, low = divmod(second * 1_000_000, 1 << 32)
        part = data[:kept]
        head = struct.pack("<IIIII", interface, high, low, len(part), len(data))
        flags = b"" if sent is None else struct.pack("<HHII", _FLAGS, 4, 2 if sent else 1, 0)
        blocks.append(_block(_PACKET, head + part + bytes(-len(part) % 4) + flags))
    path.write_bytes(b"".join(blocks))


def tshark(folder: Path, capture: Path, *arguments: str, script: bool = True) -> str:
    """Run tshark with no settings but these, and return what it prints; an error of the dissector fails the test."""
    command = [
        program("tshark"),
        "-r",
        str(capture),
        *(("-X", f"lua_script:{DISSECTOR}") if script else ()),
        *arguments,
    ]
    done = subprocess.run(  # noqa: S603 - our arguments
        command,
        capture_output=True,
        check=False,
        timeout=ENOUGH,
        env={**os.environ, "HOME": str(folder), "XDG_CONFIG_HOME": str(folder)},
    )
    output, complaints = done.stdout.decode("utf-8", "replace"), done.stderr.decode("utf-8", "replace")
    assert not done.returncode, complaints
    assert "Lua" not in complaints, complaints
    return output


def options(**preferences: str) -> list[str]:
    """Return preferences as arguments: ``i7000_types="K"`` is ``-o i7000.types:K``."""
    pairs = ((name.replace("_", ".", 1), value) for name, value in preferences.items())
    return [argument for name, value in pairs for argument in ("-o", f"{name}:{value}")]


def dissect(folder: Path, capture: Path, fields: Sequence[str], *arguments: str) -> list[Seen]:
    """Return the fields of every packet of a capture."""
    asked = [*fields, "_ws.lua.error", "_ws.malformed"]
    columns = [argument for field in asked for argument in ("-e", field)]
    form = ("-T", "fields", "-E", f"aggregator={_SEPARATOR}", "-E", "occurrence=a", *columns)
    lines = tshark(folder, capture, *form, *arguments).split("\n")[:-1]
    seen = [
        {field: text.split(_SEPARATOR) if text else [] for field, text in zip(asked, line.split("\t"), strict=True)}
        for line in lines
    ]
    assert not [it for it in seen if it["_ws.lua.error"]]
    return seen


def described(profile: dict[str, Any]) -> str:
    """Return a profile of a vector as the preference for modules has it."""
    firmware = f"@{profile['firmware']}" if profile["firmware"] else ""
    settings = {
        "type": "/".join(f"{code:02X}" for code in profile["type_codes"]),
        "format": profile["data_format"],
        "modbus_format": profile.get("modbus_data_format", "hex"),
        "checksum": str(profile["checksum"]).lower(),
        "single_ended": str(profile["single_ended"]).lower(),
    }
    return ",".join([f"{profile['model']}{firmware}", *(f"{name}={value}" for name, value in settings.items())])


class Lines:
    """Vectors as one capture: each profile has an interface of its own."""

    def __init__(self, link_type: int) -> None:
        self._link_type = link_type
        self._profiles: dict[str, int] = {}
        self.frames: list[Frame] = []

    def add(self, profile: dict[str, Any], wire: str, *, sent: bool | None) -> int:
        """Add a frame, and return its place."""
        interface = self._profiles.setdefault(described(profile), len(self._profiles))
        self.frames.append(Frame(bytes.fromhex(wire), sent, interface))
        return len(self.frames) - 1

    def dissect(self, folder: Path, fields: Sequence[str], *arguments: str) -> list[Seen]:
        """Return what tshark says of each frame."""
        capture = folder / "vectors.pcapng"
        write_capture(capture, [self._link_type] * len(self._profiles), self.frames)
        modules = " ".join(f"{number}:{module}" for module, number in self._profiles.items())
        seen = dissect(folder, capture, fields, *options(i7000_modules=modules), *arguments)
        assert len(self.frames) == len(seen)
        return seen


class Dissected(NamedTuple):
    """A vector, and what tshark says of its frames."""

    vector: dict[str, Any]
    sent: Seen | None
    received: Seen | None


def vectors_seen(folder: Path, link_type: int, protocol: str, sent: str, fields: Sequence[str]) -> list[Dissected]:
    """Return every vector of a protocol, dissected in one run; `sent` is what hosts send: command or request."""
    lines = Lines(link_type)
    places = []
    for _, vector in vectors(protocol):
        sides = ((f"{sent}_wire", True), ("response_wire", False))
        both = [lines.add(vector["profile"], vector[side], sent=out) if vector[side] else None for side, out in sides]
        places.append((vector, both))
    found = lines.dissect(folder, fields)
    return [Dissected(vector, *(None if at is None else found[at] for at in both)) for vector, both in places]


def close(values: Iterable[float | None]) -> list[Any]:
    """Return what numbers have to equal, within rounding; None stands for no number."""
    return [pytest.approx(float(value), rel=1e-12) for value in values if value is not None]


def as_written(value: Any, texts: list[str]) -> Any:
    """Return the text of a field as the kind of value that is expected."""
    if len(texts) != 1:
        return texts
    (text,) = texts
    if isinstance(value, bool):
        return text in ("1", "True")
    if isinstance(value, int):
        return int(text, 0)
    return pytest.approx(float(text)) if isinstance(value, float) else text
