"""Files that a recording goes to."""

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Protocol
from i7000.dissect.capture import Packet, packets
from i7000.recording import Capture, Carried, Damaged, End, Event, Recorder, Start, pcapng, read

BEGAN = 1_800_000_000.25
FULL = Path("/dev/full")


def test_a_recording_has_a_start_what_happened_and_an_end(tmp_path: Path) -> None:
    path, said = tmp_path / "run.jsonl", list[str]()

    with Recorder(path, program="i7000 listen", target="COM3", began=BEGAN, report=said.append) as recorder:
        recorder.write(Carried(0.5, b"$012\r", sent=True, protocol=Protocol.DCON))
        assert len(path.read_bytes().splitlines()) == 2
        recorder.write(Event(1.5, "power cycle"))

    start, *others = map(read, path.read_text().splitlines())
    assert isinstance(start, Start)
    assert (start.time, start.program, start.target) == ("2027-01-15T08:00:00.250000+00:00", "i7000 listen", "COM3")
    assert others == [Carried(0.5, b"$012\r", sent=True, protocol=Protocol.DCON), Event(1.5, "power cycle"), End(1.5)]
    assert said == []


def test_a_file_that_exists_is_not_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    path.write_text("mine")

    with pytest.raises(FileExistsError):
        Recorder(path, program="", target="", began=0, report=print)
    with pytest.raises(FileExistsError):
        Capture(path, began=0, report=print)

    assert path.read_text() == "mine"


@pytest.mark.skipif(not FULL.exists(), reason="needs /dev/full")
def test_a_full_disk_is_reported_once_and_raises_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    said = list[str]()
    monkeypatch.setattr(Path, "open", lambda *_, **__: os.fdopen(os.open(FULL, os.O_WRONLY), "wb", 0))

    with Recorder(tmp_path / "x", program="", target="", began=0, report=said.append) as recorder:
        recorder.write(Event(1.0, "power cycle"))
        recorder.write(Event(2.0, "power cycle"))

    assert said == [f"{tmp_path / 'x'}: No space left on device: nothing more is recorded"]


def test_what_comes_after_the_end_is_not_recorded(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    with Recorder(path, program="", target="", began=0, report=print) as recorder:
        pass

    recorder.write(Event(1.0, "power cycle"))

    assert [type(read(line)) for line in path.read_text().splitlines()] == [Start, End]


CARRIED = st.builds(
    Carried,
    st.floats(0, 10**6).map(lambda it: round(it, 6)),
    st.binary(min_size=1, max_size=80),
    st.none() | st.booleans(),
    st.sampled_from(Protocol),
    st.none(),
    st.lists(st.text(max_size=9), max_size=2).map(tuple),
)


@given(st.lists(CARRIED, max_size=5))
def test_a_capture_is_read_as_it_was_written(carried: list[Carried]) -> None:
    data = pcapng.header("i7000") + b"".join(
        pcapng.packet(BEGAN + it.seconds, it.wire, it.protocol or Protocol.DCON, sent=it.sent, notes=it.notes)
        for it in carried
    )

    found = list(packets([data]))

    assert [it for it in found if not isinstance(it, Packet)] == []
    assert [(it.wire, it.outbound) for it in found if isinstance(it, Packet)] == [(it.wire, it.sent) for it in carried]
    for packet, it in zip(found, carried, strict=True):
        assert isinstance(packet, Packet)
        assert packet.time == pytest.approx(BEGAN + it.seconds, abs=1e-6)


def test_a_capture_file_holds_both_protocols_and_bytes_of_neither(tmp_path: Path) -> None:
    path = tmp_path / "bus.pcapng"
    with Capture(path, began=BEGAN, report=print) as capture:
        capture.write(Carried(0.0, b"$012\r"))
        capture.write(Carried(1.0, b"\x01\x04", sent=False))

    first, second = packets([path.read_bytes()])

    assert isinstance(first, Packet)
    assert isinstance(second, Packet)
    assert (first.wire, first.outbound, second.wire, second.outbound) == (b"$012\r", None, b"\x01\x04", False)
    assert b"DCON" in path.read_bytes()
    assert not isinstance(first, Damaged)
