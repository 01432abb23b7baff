"""``i7000 listen``: what is heard at a port, decoded, shown and recorded."""

import errno
import json
import os
import signal
from pathlib import Path
from typing import IO, Any

import pytest
from attrs import define

from i7000 import Model, Profile, modbus
from i7000.cli.outlet import Outlet
from i7000.dissect.capture import Packet, packets
from i7000.link import LinkError
from i7000.recording import Carried, End, Start, read
from i7000.recording.schema import SCHEMA
from tests.terminal import Run, Told, plain, run

__all__ = ["plain", "run"]

PROFILE = Profile(Model.M_7019R)
REQUEST = modbus.encode(modbus.ReadInputRegisters(1, 0, 1), PROFILE)
RESPONSE = modbus.encode(modbus.InputRegisters(1, (5,)), PROFILE)


@define
class Ear:
    """A port and its clock: what comes, and how many seconds after the read before."""

    coming: list[tuple[float, bytes | Exception | signal.Signals]]
    timeout: float | None = None
    now: float = 100.0
    closed: bool = False

    @property
    def in_waiting(self) -> int:
        return 0

    def read(self, size: int) -> bytes:
        if not size:
            return b""
        after, what = self.coming[0] if self.coming else (1e9, b"")
        if after > (self.timeout or 0.0):
            self.now += self.timeout or 0.0
            if self.coming:
                self.coming[0] = (after - (self.timeout or 0.0), what)
            return b""
        self.now += after
        del self.coming[0]
        if isinstance(what, Exception):
            raise what
        if isinstance(what, signal.Signals):
            os.kill(os.getpid(), what)
            return b""
        return what

    def close(self) -> None:
        self.closed = True


def listened(
    run: Run,
    monkeypatch: pytest.MonkeyPatch,
    *coming: tuple[float, bytes | Exception | signal.Signals],
    options: tuple[str, ...] = (),
) -> Told:
    """Listen to a port for ten seconds at most."""
    ear = Ear(list(coming))
    monkeypatch.setattr("i7000.link.open_target", lambda *_: ear)
    monkeypatch.setattr("i7000.cli.listening.monotonic", lambda: ear.now)
    monkeypatch.setattr("i7000.cli.listening.time", lambda: 1_800_000_000.25)
    told = run("listen", "COM3", "--seconds", "10", *options)
    assert ear.closed or told.code == 2
    return told


def test_frames_are_shown_with_their_times_and_directions(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    told = listened(run, monkeypatch, (0.5, b"$012\r"), (0.125, b"!0105"), (0.0625, b"0600\r"), (0.5, b"\xff"))

    heads = [line for line in told.out.splitlines() if line[:1].isdigit()]
    assert heads == [
        "1    08:00:00.750                -> $012",
        "2    08:00:00.875      +0.125 s  <- !01050600",
        "3    08:00:01.437      +0.500 s  -- FF",
    ]
    assert "type_code       05, " in told.out
    assert (told.code, told.err) == (0, "")


def test_broken_rules_of_time_are_notes(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    told = listened(run, monkeypatch, (0.5, b"#**\r"), (0.0005, b"$014\r"), options=("--json",))

    assert [record["notes"] for record in told.records] == [
        [],
        ["0.5 ms after SynchronizedSampling, frame 1: modules need 2 ms"],
    ]
    assert told.records[1]["time"] == "2027-01-15T08:00:00.750500+00:00"


@pytest.mark.parametrize(
    ("options", "names"),
    [
        (("--address", "2"), ["ReadConfiguration"]),
        (("--only", "ReadModuleName", "--only", "ModuleName"), ["ReadModuleName", "ModuleName"]),
        (("--only", "ModuleName", "--address", "1"), ["ModuleName"]),
    ],
)
def test_only_what_is_wanted_is_shown(
    run: Run, monkeypatch: pytest.MonkeyPatch, options: tuple[str, ...], names: list[str]
) -> None:
    coming = ((0.5, b"$01M\r"), (0.1, b"!017018\r"), (0.5, b"$022\r"))

    told = listened(run, monkeypatch, *coming, options=("--json", *options))

    assert [record["name"] for record in told.records] == names


def test_a_silence_completes_a_frame(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    told = listened(run, monkeypatch, (0.5, b"$01"), (2.0, b"2\r"), options=("--json",))

    assert [record["wire"] for record in told.records] == ["243031", "320d"]
    assert told.code == 0


def test_only_the_protocol_that_is_named_is_decoded(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    told = listened(run, monkeypatch, (0.5, b"$012\r"), (0.5, REQUEST), options=("--json", "--protocol", "rtu"))

    assert [it["name"] for it in told.records if it["name"]] == ["ReadInputRegisters"]


def test_what_is_heard_is_recorded(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    files = ("--record", str(tmp_path / "bus.jsonl"), "--pcap", str(tmp_path / "bus.pcapng"))
    told = listened(run, monkeypatch, (0.5, REQUEST), (0.25, RESPONSE), options=(*files, "--only", "ModuleName"))

    start, request, response, end = map(read, (tmp_path / "bus.jsonl").read_text().splitlines())
    assert isinstance(start, Start)
    assert (start.program, start.target) == ("i7000 listen", "COM3")
    assert isinstance(request, Carried)
    assert (request.wire, request.sent, request.seconds) == (REQUEST, True, 0.5)
    assert isinstance(response, Carried)
    assert (response.wire, response.sent, response.notes[0][:5]) == (RESPONSE, False, "late:")
    assert end == End(0.75)
    captured = list(packets([(tmp_path / "bus.pcapng").read_bytes()]))
    assert [(it.wire, it.outbound) for it in captured if isinstance(it, Packet)] == [(REQUEST, True), (RESPONSE, False)]
    assert (told.code, told.out) == (0, "")
    assert run("decode", "--file", str(tmp_path / "bus.jsonl")).code == 0


def test_ctrl_c_ends_it_with_what_was_heard(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    path = tmp_path / "bus.jsonl"

    told = listened(
        run, monkeypatch, (0.5, b"$012\r!01"), (0.125, signal.SIGINT), options=("--json", "--record", str(path))
    )

    assert told.code == 130
    assert [record["wire"] for record in told.records] == ["243031320d", "213031"]
    assert isinstance(read(path.read_text().splitlines()[-1]), End)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_port_that_is_lost_is_one_line_of_error(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    told = listened(run, monkeypatch, (0.5, b"$012\r"), (0.5, LinkError("COM3: the port is lost: gone")))

    assert (told.code, told.err) == (3, "i7000: COM3: the port is lost: gone\n")
    assert "$012" in told.out


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        ((), 2, "give a port or a file, such as i7000 listen /dev/ttyUSB0"),
        (("sim:",), 2, "sim:"),
        (("/dev/nothing",), 3, "/dev/nothing: No such file or directory"),
        (("COM3", "--seconds", "-1"), 2, "--seconds -1: give 0 to 1000000000"),
        (("COM3", "--seconds", "nan"), 2, "--seconds nan: give 0 to 1000000000"),
        (("COM3", "--only", "AnalogInput5"), 2, "did you mean AnalogInput"),
        (("COM3", "--baud", "9601"), 2, "9601 is not a baud rate"),
        (("COM3", "--baud", "2"), 2, "--baud 2: no module has this baud rate"),
        (("COM3", "--address", "256"), 2, "an address is 0..255"),
    ],
)
def test_what_is_wrong_is_said(run: Run, arguments: tuple[str, ...], code: int, message: str) -> None:
    told = run("listen", *arguments)

    assert told.code == code
    assert message in told.err
    assert len(told.err.splitlines()) == 1


def test_a_file_that_exists_is_not_overwritten(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    path = tmp_path / "bus.jsonl"
    path.write_text("mine")

    told = listened(run, monkeypatch, options=("--record", str(path)))

    assert (told.code, told.err) == (2, f"i7000: {path} exists: give the name of a new file\n")
    assert path.read_text() == "mine"


def test_lines_that_nobody_reads_are_counted(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    class Unread(Outlet):
        def close(self) -> int:
            return super().close() + 2

    monkeypatch.setattr("i7000.cli.outlet.Outlet", Unread)

    told = listened(run, monkeypatch, (0.5, b"$012\r"))

    assert (told.code, told.err) == (0, "i7000: 2 lines not shown\n")


def test_output_that_cannot_be_written_is_said_and_the_recording_goes_on(
    run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    class Full(Outlet):
        def __init__(self, file: IO[str], **options: Any) -> None:
            def write(_: str) -> int:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

            monkeypatch.setattr(file, "write", write)
            super().__init__(file, **options)

    monkeypatch.setattr("i7000.cli.outlet.Outlet", Full)
    path = tmp_path / "bus.jsonl"

    told = listened(run, monkeypatch, (0.5, b"$012\r"), (0.5, b"!01050600\r"), options=("--record", str(path)))

    assert (told.code, told.err) == (2, "i7000: the output cannot be written: No space left on device\n")
    assert len(path.read_text().splitlines()) == 4


def test_the_schema_of_a_recording_is_printed(run: Run) -> None:
    assert json.loads(run("listen", "--schema").out) == json.loads(SCHEMA)
