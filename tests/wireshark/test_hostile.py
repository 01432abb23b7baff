"""Truncated and hostile frames: they have faults, and never an error of Lua (`dissect` fails on one)."""

from pathlib import Path
from random import Random

import pytest

from i7000.modbus import crc16
from tests.spec.lint import vectors
from tests.wireshark import DCON, ETHERNET, RTU, Frame, dissect, options, write_capture
from tests.wireshark.test_captures import packet

LINKS = {"dcon": DCON, "modbus": RTU}
ALPHABET = b"%#$~@!>?0123456789ABCDEFabcdefCiRMOS+-. \r\x00\xff"
MODELS = ("unknown", "M-7019R", "M-7017Z", "M-7017mC-16")


def wires(protocol: str) -> list[tuple[bytes, bool]]:
    """Return every frame of the vectors once, and whether a host sent it."""
    command = "command_wire" if protocol == "dcon" else "request_wire"
    found = [
        (bytes.fromhex(vector[side]), side == command)
        for _, vector in vectors(protocol)
        for side in (command, "response_wire")
        if vector[side]
    ]
    return list(dict.fromkeys(found))


def damaged(wire: bytes, random: Random) -> bytes:
    """Return a frame with a byte changed, left out or doubled."""
    at = random.randrange(len(wire))
    new = random.choice(ALPHABET)
    return random.choice((
        wire[:at] + bytes([new]) + wire[at + 1 :],
        wire[:at] + wire[at + 1 :],
        wire[:at] + wire[at : at + 1] + wire[at:],
    ))  # fmt: skip


@pytest.mark.parametrize("protocol", LINKS)
def test_no_prefix_of_a_frame_raises_an_error(protocol: str, tmp_path: Path) -> None:
    chosen = wires(protocol)[::4]
    frames = [Frame(wire[:end], sent) for wire, sent in chosen if len(wire) < 100 for end in range(len(wire))]
    capture = tmp_path / "prefixes.pcapng"
    write_capture(capture, [LINKS[protocol]], frames)

    seen = dissect(tmp_path, capture, ("frame.number",), *options(i7000_model="M-7019R"))

    assert len(seen) == len(frames) > 2_000


@pytest.mark.parametrize("protocol", LINKS)
@pytest.mark.parametrize("model", MODELS)
def test_no_damage_raises_an_error(protocol: str, model: str, tmp_path: Path) -> None:
    random = Random(7019)
    frames = []
    for wire, sent in wires(protocol) * 2:
        changed = damaged(damaged(wire, random) or wire, random)
        if protocol == "modbus" and len(changed) > 2:
            changed = changed[:-2] + crc16(changed[:-2]).to_bytes(2, "little")
        frames.append(Frame(changed, random.choice((sent, not sent, None))))
    frames += [Frame(random.randbytes(random.randrange(300)), random.choice((True, False, None))) for _ in range(300)]
    frames += [Frame(bytes(random.choices(ALPHABET, k=random.randrange(30)))) for _ in range(500)]
    random.shuffle(frames)
    capture = tmp_path / "damaged.pcapng"
    write_capture(capture, [LINKS[protocol]], frames)

    seen = dissect(tmp_path, capture, ("frame.number",), "-2", *options(i7000_model=model))

    assert len(seen) == len(frames) > 1_500


@pytest.mark.parametrize("protocol", LINKS)
def test_a_frame_that_the_capture_cuts_off_has_no_fault(protocol: str, tmp_path: Path) -> None:
    frames = [Frame(wire, sent) for wire, sent in wires(protocol) if len(wire) > 6]
    capture = tmp_path / "cut.pcapng"
    write_capture(capture, [LINKS[protocol]], frames, kept=6)
    name = "dcon" if protocol == "dcon" else "i7000"

    seen = dissect(tmp_path, capture, (f"{name}.fault", f"{name}.expert.cut_off"))

    assert len(seen) == len(frames)
    assert all(it[f"{name}.expert.cut_off"] and not it[f"{name}.fault"] for it in seen)


def test_no_stream_over_tcp_raises_an_error(tmp_path: Path) -> None:
    """Segments cut frames anywhere, with noise between; the same bytes as Modbus TCP are no better."""
    random = Random(502)
    frames = []
    for port in (10_001, 502):
        stream = b"".join(
            random.choice((wire, damaged(wire, random), random.randbytes(9))) for wire, _ in wires("dcon")[::3] if wire
        )
        sequence = 1
        while stream:
            size = random.randrange(1, 40)
            part, stream = stream[:size], stream[size:]
            frames.append(Frame(packet(part, to_server=True, sequence=sequence, port=port)))
            sequence += len(part)
    capture = tmp_path / "stream.pcapng"
    write_capture(capture, [ETHERNET], frames)

    seen = dissect(tmp_path, capture, ("dcon.message",), *options(dcon_tcp_port="10001", i7000_model="M-7019R"))

    assert sum(len(it["dcon.message"]) for it in seen) > 30
