"""``i7000 scan``: modules that are found, what is said if there are none, and how it ends."""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from i7000 import LineSettings, Protocol
from i7000.cli import scanning
from i7000.cli.durations import duration_words
from i7000.cli.scanning import GUIDE, Search, advice
from i7000.host.procedures import EVERY_LINE, SCAN_POLICY, FindingKind
from i7000.link import VirtualPort, open_target
from i7000.simulator.faults import Faults
from tests.simulation import MAIN, free_port, process
from tests.terminal import Run
from tests.waiting import ENOUGH

BUS = "sim:M-7019R,type=K+I-7018,checksum=true,baud=19200+M-7017,address=0x30,protocol=dcon"
READ_ONLY = re.compile(rb"[$~#][0-9A-F]{2}(M|2|F|P|5|6|8C[0-9A-F]|7C|B|3|4|A|D|)")
ROOT = Path(__file__).parents[1]


def test_modules_of_all_kinds_are_found_and_identified(run: Run) -> None:
    told = run("scan", BUS, "--baud", "all", "--addresses", "1-3,0x30")

    *lines, head, first, second, third = told.out.splitlines()
    assert lines == [
        "address 01, 9600 N81, Modbus RTU: M-7019R B4.5",
        "address 30h (48), 9600 N81, DCON without a checksum: M-7017 B4.5",
        "address 02, 19200 N81, DCON with a checksum: I-7018 or M-7018 B4.5",
    ]
    assert head.split() == ["address", "baud", "format", "protocol", "checksum", "name", "firmware", "models"]
    assert re.split("  +", first) == ["01", "9600", "N81", "Modbus RTU", "CRC", "00701900", "B4.5", "M-7019R"]
    assert re.split("  +", second) == ["30h (48)", "9600", "N81", "DCON", "no", "7017", "B4.5", "M-7017"]
    assert re.split("  +", third) == ["02", "19200", "N81", "DCON", "yes", "7018", "B4.5", "I-7018 or M-7018"]
    assert re.fullmatch(r"i7000: 97 places to look at take \d\d s if nothing answers\n", told.err)
    assert told.code == 0


def test_json_has_an_object_for_each_module(run: Run) -> None:
    told = run("scan", "sim:M-7018,address=5,init=true+I-7018,address=6", "--addresses", "6", "--json")

    assert told.records == [
        {"record": "module", "address": 0, "baud_rate": 9600, "character_format": "N81", "protocol": "dcon",
         "checksum": False, "name": "7018", "firmware": "B4.5", "models": ["M-7018"],
         "stored": {"address": 5, "baud_rate": 9600, "character_format": "N81", "protocol": "rtu", "checksum": False}},
        {"record": "module", "address": 6, "baud_rate": 9600, "character_format": "N81", "protocol": "dcon",
         "checksum": False, "name": "7018", "firmware": "B4.5", "models": ["I-7018", "M-7018"],
         "stored": None},
    ]  # fmt: skip
    assert told.code == 0


def test_a_module_in_init_mode_is_found_with_its_stored_address(run: Run) -> None:
    told = run("scan", "sim:M-7018,address=5,init=true", "--addresses", "7")

    assert told.out.startswith(
        "address 00, 9600 N81, DCON without a checksum: M-7018 B4.5; in INIT mode; stored: address 05, 9600 N81, Modbus"
    )


def test_all_character_formats_are_tried_if_wished(run: Run) -> None:
    arguments = ("--character-format", "all", "--protocol", "dcon", "--no-checksum", "--addresses", "1")
    told = run("scan", "sim:I-7018,character_format=E81", *arguments)

    assert told.out.startswith("address 01, 9600 E81, DCON without a checksum: ")
    assert told.err.startswith("i7000: 5 places to look at take ")


def test_another_product_is_found_without_a_model(run: Run) -> None:
    told = run("scan", "sim:I-7018,name=7012D", "--addresses", "1")

    assert "address 01, 9600 N81, DCON without a checksum: unknown model B4.5\n" in told.out
    assert told.out.splitlines()[-1].split()[-1] == "unknown"


def test_if_nothing_answers_it_is_said_what_was_heard_and_what_to_try(run: Run) -> None:
    told = run("scan", "sim:I-7018,baud=1200", "--addresses", "1-2", "--protocol", "dcon")

    first, heard, untried, sure = told.err.splitlines()[1:]
    assert first == "i7000: no module answered"
    assert heard.startswith("i7000: nothing was heard: is the power LED of the module on (10..30 V DC), are DATA+ and")
    assert untried == (
        "i7000: not tried: other baud rates: --baud all; other character formats: --character-format all; other"
        " addresses: leave --addresses out; the other protocol: --protocol auto"
    )
    assert sure == (
        "i7000: the sure way: switch INIT on, the power of the module off and on, and call i7000 read"
        " sim:I-7018,baud=1200 --address 0 --protocol dcon --no-checksum; docs/find_a_module.md has all steps"
    )
    assert (told.code, told.out) == (3, "")


def test_what_was_tried_is_not_advised() -> None:
    search = Search("COM3", EVERY_LINE, tuple(range(0x100)), tuple(Protocol), (False, True), SCAN_POLICY, echo=False)
    heard, sure = advice(search, [])

    assert heard.startswith("nothing was heard: ")
    assert sure.startswith("the sure way: ")


@pytest.mark.parametrize(("seconds", "words"), [(0.0, "1 s"), (59.6, "1 min 0 s"), (3661.0, "1 h 1 min")])
def test_a_duration_is_rounded_to_what_matters(seconds: float, words: str) -> None:
    assert duration_words(seconds) == words


# --- the guide --------------------------------------------------------------------------------------------------------

PAGE = (ROOT / GUIDE).read_text(encoding="utf-8")
FORGOTTEN = "sim:I-7018,type=K,address=5,baud=19200,checksum=true"


@pytest.mark.parametrize("command", re.findall(r"^i7000 (.*)$", PAGE, re.MULTILINE))
def test_the_commands_of_the_guide_find_a_forgotten_module(run: Run, command: str) -> None:
    in_init_mode = re.search(r"address[= ]0\b|--addresses", command)
    target = f"{FORGOTTEN},init=true" if in_init_mode else FORGOTTEN
    yes = ["--yes"] if command.startswith("set ") else []

    assert run(*command.replace("/dev/ttyUSB0", target).split(), *yes).code == 0


def test_the_guide_shows_what_the_module_says(run: Run) -> None:
    (shown,) = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)
    (command,) = re.findall(r"^i7000 (read .*--address 0 .*)$", PAGE, re.MULTILINE)

    assert run(*command.replace("/dev/ttyUSB0", f"{FORGOTTEN},init=true").split()).err == shown


@pytest.mark.parametrize("number", re.findall(r"E\d+", PAGE))
def test_the_errata_of_the_guide_exist(run: Run, number: str) -> None:
    assert run("errata", number).code == 0


def faulty(monkeypatch: pytest.MonkeyPatch, faults: Faults) -> list[Any]:
    """Give the ports that are opened faults; return them."""
    ports: list[Any] = []

    def opened(target: str, line: LineSettings) -> Any:
        ports.append(open_target(target, line, faults=faults))
        return ports[-1]

    monkeypatch.setattr("i7000.link.open_target", opened)
    return ports


@pytest.mark.parametrize(
    ("faults", "words"),
    [
        (Faults(truncate=1.0), "1 time: bytes that are not a frame: devices with other line settings, "),
        (Faults(echo=True, silent=1.0), "2 times: the echo of the requests: give --echo"),
    ],
)
def test_what_was_heard_that_is_no_answer_is_summed_up(
    run: Run, monkeypatch: pytest.MonkeyPatch, faults: Faults, words: str
) -> None:
    faulty(monkeypatch, faults)
    told = run("scan", "sim:I-7018", "--addresses", "1", "--protocol", "dcon", "--no-checksum")

    assert f"i7000: heard at 9600 N81, {words}" in told.err
    assert "nothing was heard" not in told.err
    assert told.code == 3


def test_everything_that_can_be_heard_has_words() -> None:
    assert {*scanning._HEARD} == {*FindingKind} - {FindingKind.NOTHING, FindingKind.ANSWER, FindingKind.REFUSAL}  # noqa: SLF001


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("--baud 02h", "--baud 02h: no module has this baud rate"),
        ("--baud 9601", "9601 is not a baud rate: give one of "),
        ("--addresses 5-1", "--addresses 5-1: 5-1 ends before it begins: write 1-5"),
        ("--addresses 0,0x14-3", "--addresses 0,0x14-3: 0x14-3 ends before it begins: write 3-0x14"),
        ("--addresses 300-1", "--addresses 300-1: 300-1 is not within 0-255, such as 1-20"),
        ("--addresses 1,256", "--addresses 1,256: 256 is not within 0-255, such as 1-20"),
        ("--addresses 1-", "--addresses 1-: '' is not a whole number"),
        ("--timeout -1", "--timeout -1: give more than 0, at most 60 seconds"),
    ],
)
def test_wrong_usage_is_reported(run: Run, arguments: str, message: str) -> None:
    told = run("scan", "sim:I-7018", *arguments.split())

    assert told.err.startswith(f"i7000: {message}")
    assert (told.code, told.out) == (2, "")


def test_the_timeout_and_the_retries_that_are_given_are_used(run: Run) -> None:
    arguments = ("scan", "sim:I-7018", "--addresses", "9", "--protocol", "rtu")

    assert re.search(r"takes 1 s if", run(*arguments).err)
    assert re.search(r"takes [67] s if", run(*arguments, "--timeout", "2", "--retries", "1").err)


# --- what it sends, and how it ends -----------------------------------------------------------------------------------


def test_a_search_only_reads_and_never_sends_a_broadcast(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    sent: list[bytes] = []
    write = VirtualPort.write

    def noted(self: VirtualPort, data: Any) -> int:
        sent.append(data)
        return write(self, data)

    monkeypatch.setattr(VirtualPort, "write", noted)

    assert run("scan", BUS, "--addresses", "1,2,0x30").code == 0
    assert {wire[:3] for wire in sent if wire[:1] in b"#$%~"} >= {b"$01", b"$30"}
    assert not [wire for wire in sent if wire.endswith(b"\r") and not READ_ONLY.match(wire)]
    assert not [wire for wire in sent if wire[:1] in (b"%", b"@") or b"**" in wire]
    assert {wire[1] for wire in sent if not wire.endswith(b"\r")} <= {0x01, 0x02, 0x03, 0x04, 0x46}


def test_ctrl_c_ends_with_a_table_of_what_was_found(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    ports = faulty(monkeypatch, Faults())
    read = VirtualPort.read

    def until_later(self: VirtualPort, size: int = 1) -> bytes:
        if self.now() > 20.0:
            os.kill(os.getpid(), signal.SIGINT)
        return read(self, size)

    monkeypatch.setattr(VirtualPort, "read", until_later)
    told = run("scan", "sim:I-7018", "--baud", "all")

    assert told.out.splitlines()[-1].split()[0] == "01"
    assert told.code == 130
    assert not ports[0].is_open


def test_a_lost_port_is_an_error_after_what_was_found(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    faulty(monkeypatch, Faults())
    read = VirtualPort.read

    def until_later(self: VirtualPort, size: int = 1) -> bytes:
        if self.now() > 20.0:
            self.close()
        return read(self, size)

    monkeypatch.setattr(VirtualPort, "read", until_later)
    told = run("scan", "sim:I-7018")

    assert told.out.splitlines()[-1].split()[0] == "01"
    assert told.err.splitlines()[-1] == "i7000: sim:I-7018: the port is closed"
    assert told.code == 3


def test_a_terminal_shows_how_far_it_is(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in {"TTY_COMPATIBLE": "1", "TERM": "xterm", "COLUMNS": "80"}.items():
        monkeypatch.setenv(name, value)
    told = run("scan", "sim:I-7018", "--addresses", "1-3")

    shown = re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", told.out)
    assert "address 01, 9600 N81, DCON without a checksum: I-7018 or M-7018 B4.5\n" in shown
    assert re.search(r"\d+ %  \d+ s left  9600 N81  address 0\d", shown)


def test_ctrl_c_ends_a_scan_of_a_real_port_cleanly() -> None:
    port = free_port()
    with process("--model", "M-7018,protocol=dcon,checksum=true", "--rfc2217", f"{port}",
                 stdout=subprocess.PIPE, text=True) as simulator:  # fmt: skip
        assert simulator.stdout
        simulator.stdout.readline()
        main = MAIN.replace("main()", "main(sys.argv[1:])")
        command = [sys.executable, "-c", main, "scan", f"rfc2217://127.0.0.1:{port}"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as started:  # noqa: S603
            assert started.stdout
            assert started.stdout.readline().startswith("address 01, 9600 N81, DCON with a checksum: ")
            started.send_signal(signal.SIGINT)
            out, err = started.communicate(timeout=ENOUGH)

    assert out.splitlines()[-1].split()[:5] == ["01", "9600", "N81", "DCON", "yes"]
    assert err.count("\n") == 1
    assert started.returncode == 130
