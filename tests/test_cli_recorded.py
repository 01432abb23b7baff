"""``--record`` and ``--pcap`` of what simulates: the traffic in files, beside what is shown."""

from pathlib import Path

import pytest

from i7000.cli.recorded import both
from i7000.dissect.capture import Packet, packets
from i7000.recording import Carried, End, Event, Record, Start, read
from i7000.simulator import simulate
from tests.simulation import KELVIN, SAID, free_port, simulated, talk
from tests.simulator.running import I_7018
from tests.terminal import Run
from tests.test_cli_proxy import proxied


def records(path: Path) -> list[Record]:
    found = [read(line) for line in path.read_text().splitlines()]
    return [it for it in found if isinstance(it, Start | Carried | Event | End)]


def test_a_simulation_is_recorded_with_its_faults_and_changes(run: Run, tmp_path: Path) -> None:
    port, path, pcap = free_port(), tmp_path / "run.jsonl", tmp_path / "run.pcapng"

    told = simulated(
        run,
        *("--model", KELVIN, "--signal", "all=25.1degC", "--tcp", str(port), "--fault", "duplicate=1@01"),
        *("--record", str(path), "--pcap", str(pcap)),
        meanwhile=lambda: talk(f"socket://127.0.0.1:{port}", b"#01\r", b"~01OROOM1\r"),
    )

    start, command, response, rename, renamed, changed, end = records(path)
    assert isinstance(start, Start)
    assert (start.program, start.target) == ("i7000 simulate", "M-7019R@B3.7")
    assert isinstance(command, Carried)
    assert (command.wire, command.sent, command.notes) == (b"#01\r", True, ())
    assert command.place
    assert isinstance(response, Carried)
    assert (response.wire, response.sent) == (SAID, False)
    assert response.notes
    assert isinstance(rename, Carried)
    assert isinstance(renamed, Carried)
    assert isinstance(changed, Event)
    assert changed.text.startswith("01 M-7019R: ")
    assert isinstance(end, End)
    captured = [it for it in packets([pcap.read_bytes()]) if isinstance(it, Packet)]
    assert [it.wire for it in captured][:2] == [b"#01\r", SAID]
    assert (told.code, run("decode", "--file", str(path)).code) == (0, 0)


def test_noise_and_silence_are_recorded(run: Run, tmp_path: Path) -> None:
    port, path = free_port(), tmp_path / "run.jsonl"

    simulated(
        run,
        *("--model", KELVIN, "--tcp", str(port), "--record", str(path)),
        meanwhile=lambda: talk(f"socket://127.0.0.1:{port}", b"x\r$05M\r$01M\r"),
    )

    carried = [it for it in records(path) if isinstance(it, Carried)]
    assert [(it.wire, it.sent) for it in carried] == [
        (b"x\r", True),
        (b"$05M\r", True),
        (b"$01M\r", True),
        (b"!017019R\r", False),
    ]


def test_a_proxy_records_both_sides(run: Run, tmp_path: Path) -> None:
    port, path = free_port(), tmp_path / "run.jsonl"

    with simulate(I_7018, over="socket") as target:
        told = proxied(
            run, target, "--tcp", str(port), "--record", str(path), control=tmp_path / "sock",
            meanwhile=lambda: talk(f"socket://127.0.0.1:{port}", b"$01M\r"),
        )  # fmt: skip

    start, *carried, end = records(path)
    assert isinstance(start, Start)
    assert (start.program, start.target) == ("i7000 proxy", target)
    assert isinstance(end, End)
    for sent, wire in ((True, b"$01M\r"), (False, b"!017018\r")):
        assert b"".join(it.wire for it in carried if isinstance(it, Carried) and it.sent is sent) == wire
    assert told.code == 0


def test_a_file_that_exists_is_not_overwritten(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    path.write_text("mine")

    told = run("simulate", "--model", KELVIN, "--tcp", "0", "--record", str(path))

    assert (told.code, told.err) == (2, f"i7000: {path} exists: give the name of a new file\n")
    assert path.read_text() == "mine"


@pytest.mark.parametrize("there", [0, 1])
def test_one_of_two_functions_may_be_missing(there: int) -> None:
    seen: list[int] = []
    functions = [None, None, seen.append][there : there + 2]

    call = both(*functions)
    if call:
        call(5)

    assert (call is None, seen) == ((there == 0), [5][:there])


def test_both_functions_are_called_in_turn() -> None:
    seen: list[str] = []

    call = both(lambda value: seen.append(f"shown {value}"), lambda value: seen.append(f"recorded {value}"))
    assert call
    call(1)

    assert seen == ["recorded 1", "shown 1"]
