"""Capture files that text2pcap and editcap write are read, with their directions."""

import subprocess
from pathlib import Path

import pytest

from i7000.dissect.capture import Packet, packets
from tests.dissect.frames import REQUEST, RESPONSE
from tests.interop import program


@pytest.fixture
def capture(tmp_path: Path) -> Path:
    """A pcapng file with a request that went out and a response that came in."""
    dump, path = tmp_path / "frames.txt", tmp_path / "frames.pcapng"
    dump.write_text(f"O 12:00:01.25\n0000 {REQUEST.hex(' ')}\nI 12:00:01.50\n0000 {RESPONSE.hex(' ')}\n")
    command = [program("text2pcap"), "-q", "-D", "-t", "%H:%M:%S.%f", "-l", "147", str(dump), str(path)]
    subprocess.run(command, check=True, capture_output=True)  # noqa: S603 - our arguments
    return path


def read(path: Path) -> list[Packet]:
    found = list(packets([path.read_bytes()]))
    assert all(isinstance(it, Packet) for it in found)
    return [it for it in found if isinstance(it, Packet)]


def test_a_capture_of_text2pcap_has_frames_times_and_directions(capture: Path) -> None:
    request, response = read(capture)

    assert (request.wire, request.outbound, response.wire, response.outbound) == (REQUEST, True, RESPONSE, False)
    assert request.time is not None
    assert response.time == request.time + 0.25


@pytest.mark.parametrize("kind", ["pcap", "nsecpcap", "pcapng"])
def test_a_capture_that_editcap_converts_has_the_same_frames(capture: Path, kind: str) -> None:
    path = capture.with_suffix(f".{kind}.out")
    subprocess.run([program("editcap"), "-F", kind, str(capture), str(path)], check=True, capture_output=True)  # noqa: S603 - our arguments

    assert [(it.number, it.time, it.wire) for it in read(path)] == [
        (it.number, it.time, it.wire) for it in read(capture)
    ]
