"""``i7000 read``: readings once and steadily, on simulated buses, simulators in other processes, and lost ports."""

import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from attrs import evolve

from i7000 import LineSettings, Model, Protocol, dcon
from i7000.cli import reading, reading_text, station
from i7000.cli.durations import seconds
from i7000.cli.port import BreakingEnding, broken_off_by_signals
from i7000.cli.reading import Schedule
from i7000.cli.silence import silence_cause
from i7000.cli.stored import Stored, line_words, stored_settings
from i7000.cli.words import UsageError
from i7000.device import factory, power_on
from i7000.host import Answered, Policy, TimedOut
from i7000.host.procedures import Candidate, Identified, Result, Unknown, identify, read
from i7000.link import Line, LinkError, VirtualPort, open_target
from i7000.simulator.faults import Faults
from tests.simulation import MAIN, free_port, process
from tests.terminal import Run
from tests.waiting import ENOUGH

KELVIN = "sim:M-7019R,type=K"
TWO = "sim:M-7019R,type=K+I-7018,channels=0-3"


@pytest.fixture(autouse=True)
def clock(monkeypatch: pytest.MonkeyPatch) -> "Clock":
    """A clock that only `sleep` moves."""
    found = Clock()
    monkeypatch.setattr(reading, "monotonic", found.now)
    monkeypatch.setattr(reading, "sleep", found.sleep)
    monkeypatch.setattr(station, "monotonic", found.now)
    return found


class Clock:
    def __init__(self) -> None:
        self.at = 1000.0
        self.slept: list[float] = []

    def now(self) -> float:
        return self.at

    def sleep(self, some: float) -> None:
        self.slept.append(round(some, 3))
        self.at += some


# --- once -------------------------------------------------------------------------------------------------------------


def test_the_channels_of_a_module_are_a_table(run: Run) -> None:
    told = run("read", "sim:I-7018,type=K,channels=0-1")

    lines = [re.split("  +", line) for line in told.out.splitlines()]
    assert lines[0] == ["channel", "value", "unit", "status", "type"]
    assert lines[1] == ["0", "152.4", "degC", "ok", "0F thermocouple K"]
    assert lines[3] == ["2", "degC", "disabled", "0F thermocouple K"]
    assert (len(lines), told.code) == (9, 0)


def test_what_the_module_is_stands_on_standard_error_with_the_models_it_can_be(run: Run) -> None:
    told = run("read", "sim:I-7018,type=K")

    assert told.err == (
        "i7000: address 01: I-7018 or M-7018 B4.5, read as I-7018, DCON without a checksum"
        " (7018 is the factory name of I-7018 and M-7018)\n"
    )


def test_the_only_model_that_fits_a_module_with_a_name_of_its_own_is_only_probable(run: Run) -> None:
    told = run("read", "sim:M-7017R-A5,protocol=dcon,name=OVEN")

    assert told.err.startswith("i7000: address 01: probably M-7017R-A5 B4.5, DCON without a checksum (OVEN is not a")


def test_it_is_said_if_modules_of_both_protocols_have_the_same_address(run: Run) -> None:
    told = run("read", "sim:I-7018+M-7019R,address=1", "--json")

    assert [it["protocol"] for it in told.records] == ["dcon"]
    assert told.err.splitlines()[1] == (
        "i7000: address 01: another module answers there by Modbus RTU; --protocol chooses one"
    )


def test_modules_of_both_protocols_are_read_in_one_call(run: Run) -> None:
    told = run("read", TWO, "--address", "1", "--address", "2", "--json")

    assert [(it["address"], it["model"], it["protocol"]) for it in told.records] == [
        (1, "M-7019R", "rtu"),
        (2, "I-7018", "dcon"),
    ]
    assert told.records[0]["channels"][0] == {
        "channel": 0, "value": pytest.approx(152.41, abs=0.01), "unit": "degC", "status": "ok", "type": "0F",
    }  # fmt: skip
    assert told.records[1]["channels"][7]["status"] == "disabled"
    assert told.code == 0


def test_a_table_of_several_modules_has_their_addresses(run: Run) -> None:
    told = run("read", TWO, "--model", "1=M-7019R", "--model", "2=I-7018,type=05")

    lines = told.out.splitlines()
    assert lines[0].startswith("address  channel  value ")
    assert [line.split()[0] for line in lines[1:]] == ["01"] * 8 + ["02"] * 8


def test_one_line_of_csv_has_the_units_in_its_head(run: Run) -> None:
    told = run("read", "sim:I-7018,type=K,channels=0", "--csv")

    head, line = csv.reader(told.out.splitlines())
    assert head == ["time", *(f"{channel} (degC)" for channel in range(8))]
    assert re.fullmatch(r"20\d\d-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}\+00:00", line[0])
    assert line[1:] == ["152.4", *["disabled"] * 7]


def test_a_file_is_written_if_it_is_new(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "readings"
    first = run("read", KELVIN, "--output", f"{path}")
    second = run("read", KELVIN, "--output", f"{path}")

    assert (first.code, first.out) == (0, "")
    assert len(path.read_text().splitlines()) == 9
    assert second.code == 2
    assert second.err == f"i7000: --output {path}: the file exists; give the name of a new one\n"


def test_a_full_disk_is_named_with_the_file(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "readings.csv"
    monkeypatch.setattr(reading_text, "FileIO", lambda *_: io.FileIO("/dev/full", "w"))
    told = run("read", KELVIN, "--csv", "--output", f"{path}")

    assert (told.code, told.err.splitlines()[-1]) == (2, f"i7000: {path}: No space left on device")


def test_what_is_given_is_used_in_place_of_what_the_module_says(run: Run) -> None:
    told = run("read", "sim:M-7018,type=K,modbus_format=engineering", "--type", "J")

    assert "address 01: type 0E (J) is given, but the module says type 0F (K)" in told.err
    assert "0E thermocouple J" in told.out
    assert told.code == 0


def test_a_type_that_does_not_fit_the_readings_is_reported(run: Run) -> None:
    told = run("read", "sim:I-7018,type=K", "--type", "MV_15")

    assert told.out.count("not_understood  00 -15..15 mV") == 8
    assert "i7000: address 01: channel 0: number in value at byte 0 of +0152.4; allowed: " in told.err
    assert told.err.endswith("; do --model, --type and --format fit the module?\n")
    assert told.code == 1


def test_a_channel_that_is_not_understood_is_said_in_csv_and_json(run: Run) -> None:
    arguments = ("read", "sim:I-7018,type=K", "--type", "MV_15")

    assert run(*arguments, "--csv").out.splitlines()[1].split(",")[1:] == ["not_understood"] * 8
    channel = run(*arguments, "--json").records[0]["channels"][0]
    assert (channel["value"], channel["status"]) == (None, "not_understood")


def test_what_the_module_says_too_is_no_contradiction(run: Run) -> None:
    told = run("read", "sim:I-7018,type=K", "--model", "I-7018,type=K,format=engineering")

    assert told.err.count("\n") == 1
    assert told.code == 0


def test_a_module_that_does_not_say_what_it_is_is_read_as_given(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def nothing(address: int, **_: object) -> Any:
        yield from ()
        return Identified(address)

    monkeypatch.setattr(station, "identify", nothing)
    told = run("read", "sim:I-7018", "--model", "I-7018")

    assert told.out.count("05 -2.5..2.5 V") == 8
    assert (told.code, told.err) == (0, "")


def test_it_is_said_if_disabled_channels_are_unknown(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def without_mask(*arguments: Any, **others: Any) -> Any:
        report = yield from read(*arguments, **others)
        return evolve(report, mask=None, unknown=(Unknown("mask", "no answer to $016"),))

    monkeypatch.setattr(station, "read", without_mask)
    told = run("read", "sim:I-7018")

    assert told.err.endswith("address 01: disabled channels are unknown, and can read as 0: no answer to $016\n")
    assert told.code == 0


def test_a_module_of_no_modbus_address_is_asked_by_dcon(run: Run) -> None:
    assert run("read", "sim:M-7018,address=250,protocol=dcon", "--address", "250", "--model", "M-7018").code == 0


def test_a_given_model_that_does_not_answer_has_a_likely_cause(run: Run) -> None:
    told = run("read", "sim:I-7018", "--address", "9", "--model", "I-7018,checksum=false")

    assert told.err.startswith("i7000: address 09 does not answer: nothing came: ")
    assert told.code == 3


def test_a_model_that_the_module_is_not_is_reported(run: Run) -> None:
    told = run("read", "sim:I-7018,type=K", "--model", "I-7018Z,type=K/K/K/K/K/K/K/K/K/K")

    assert "address 01: it is read as I-7018Z, as given, but it answers as I-7018 or M-7018\n" in told.err
    assert told.code == 1


def test_a_model_whose_types_are_not_those_of_the_module_is_reported(run: Run) -> None:
    told = run("read", "sim:M-7019R,type=K,protocol=dcon", "--model", "I-7017")

    assert told.err.splitlines() == [
        "i7000: address 01: --model I-7017 is given, but it answers as M-7019R: leave out --model, or give --type too"
    ]
    assert told.code == 1


def test_facts_that_no_module_has_together_are_reported(run: Run) -> None:
    told = run("read", "sim:I-7018,type=K", "--type", "V_10")

    assert "address 01: what is given does not fit the module: type_codes cannot be " in told.err
    assert (told.code, told.out.split()[-2:]) == (1, ["not", "read"])


def test_another_product_is_reported(run: Run) -> None:
    told = run("read", "sim:I-7018,name=7012D")

    assert "address 01: 7012D is the name of another product: give --model\n" in told.err
    assert told.code == 1


@pytest.mark.parametrize(
    ("module", "words"),
    [
        ("M-7018,address=5", "address 05, 9600 N81, Modbus RTU"),
        ("M-7018,address=5,protocol=dcon,baud=19200", "address 05, 19200 N81, DCON without a checksum"),
        ("I-7018,address=0x20,character_format=E81,checksum=true", "address 20h (32), 9600 E81, DCON with a checksum"),
        ("I-7018Z,address=3", "address 03, 9600 N81, DCON without a checksum"),
    ],
)
def test_a_module_in_init_mode_says_what_it_has_stored(run: Run, module: str, words: str) -> None:
    told = run("read", f"sim:{module},init=true", "--address", "0")

    assert f"i7000: address 00: it is in INIT mode; stored: {words}\n" in told.err
    assert told.code == 0


def stored(models: tuple[Model, ...], protocol: Any, line: LineSettings | None = None) -> Stored | None:
    """What is stored, of a module that answers only the question for its protocol, if at all."""
    found = Identified(0x00, stored_address=0x05, candidates=tuple(map(Candidate, models)), line_settings=line)
    procedure, answer = stored_settings(found), None
    while True:
        try:
            command = procedure.send(answer).command  # type: ignore[union-attr]
        except StopIteration as end:
            return end.value  # type: ignore[no-any-return]
        asked = isinstance(command, dcon.ReadProtocol) and protocol is not None
        answer = Result(Answered(command, protocol) if asked else TimedOut(command))


def test_what_a_module_in_init_mode_does_not_say_is_left_out() -> None:
    found = stored((Model.M_7018,), None)

    assert found == Stored(0x05, None, None, None)
    assert found.words() == "in INIT mode; stored: address 05"


@pytest.mark.parametrize(
    ("models", "answer", "protocol"),
    [
        ((Model.I_7018,), None, Protocol.DCON),
        ((Model.I_7018, Model.M_7018), None, Protocol.DCON),
        ((Model.I_7018, Model.M_7018), Protocol.MODBUS_RTU, Protocol.MODBUS_RTU),
        ((Model.M_7018,), Protocol.DCON, Protocol.DCON),
    ],
)
def test_only_m_models_are_asked_for_the_stored_protocol(
    models: tuple[Model, ...], answer: Protocol | None, protocol: Protocol
) -> None:
    said = None if answer is None else dcon.ProtocolSetting(0x00, modbus_supported=True, protocol=answer)

    assert stored(models, said) == Stored(0x05, None, None, protocol)


def test_settings_without_a_known_baud_rate_have_its_code() -> None:
    assert line_words(LineSettings(0x0B)) == "0Bh N81"


@pytest.mark.parametrize(
    ("target", "arguments", "cause"),
    [
        ("sim:I-7018", "--address 9", "nothing came: check the address, --baud, the power and the wires (swap A and"),
        ("sim:I-7018,checksum=true", "--no-checksum", "it answers DCON with a checksum: give --protocol dcon --check"),
        ("sim:I-7018", "--checksum", "it answers DCON without a checksum: give --protocol dcon --no-checksum"),
        ("sim:M-7018", "--protocol dcon", "it answers Modbus RTU: give --protocol rtu"),
        ("sim:M-7019R", "--model I-7017",
         "it answers Modbus RTU, and I-7017 does not: leave out --model, or give another one"),
        ("sim:M-7018,protocol=dcon", "--protocol rtu",
         "it answers DCON without a checksum: give --protocol dcon --no-checksum"),
        ("sim:I-7018,init=true", "", "a module in INIT mode answers at address 00: give --address 0, or "),
    ],
)  # fmt: skip
def test_a_module_that_does_not_answer_has_a_likely_cause(run: Run, target: str, arguments: str, cause: str) -> None:
    told = run("read", target, *arguments.split())

    assert f" does not answer: {cause}" in told.err
    assert told.code == 3


def silence(faults: Faults, line: LineSettings = LineSettings()) -> str:  # noqa: B008 - frozen
    module = power_on(evolve(factory(Model.I_7018)), now=0.0)
    with Line(VirtualPort([module], faults=faults, line=line), line) as on:
        return silence_cause(on, 0x01, [(Protocol.DCON, False)])


@pytest.mark.parametrize(
    ("faults", "cause"),
    [
        (Faults(), "it does answer DCON without a checksum now: an unreliable line or a slow module"),
        (Faults(echo=True, silent=1.0), "only the echo of the request came: give --echo"),
        (Faults(truncate=1.0), "bytes came that are not a frame: another --baud or --character-format"),
        (Faults(misaddress=1.0), "a frame came that is not the response"),
        (Faults(late=1.0, late_by=0.4), "its responses are late: give --timeout 1"),
        (Faults(late=1.0, late_by=0.6), "its responses are late: give --timeout 1"),
    ],
)
def test_what_was_heard_in_place_of_a_response_tells_the_cause(faults: Faults, cause: str) -> None:
    assert silence(faults).startswith(cause)


def test_a_line_with_a_long_timeout_is_not_asked_again_for_late_responses() -> None:
    module = power_on(factory(Model.I_7018), now=0.0)
    faults = Faults(late=1.0, late_by=2.7)
    with Line(VirtualPort([module], faults=faults), policy=Policy(turnaround=1.0)) as on:
        assert "late (a longer --timeout)" in silence_cause(on, 0x01, [(Protocol.DCON, False)])


def test_late_responses_that_leave_the_types_unknown_are_named(run: Run, scene: Any) -> None:
    scene(SLOW, faults=Faults(late=1.0, late_by=0.6))
    told = run("read", "COM3", "--protocol", "dcon", "--no-checksum")

    assert told.err.splitlines()[-1] == (
        "i7000: address 01: frames came after their time: if responses are late, give --timeout 1"
    )
    assert told.code == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("--every 10ms", "--every 10ms: give 50ms to 24h"),
        ("--every 25h", "--every 25h: give 50ms to 24h"),
        ("--every soon", "--every soon: 'soon' is not a duration: write 500ms, 1s, 2 (seconds), 1min or 1h"),
        ("--count 2", "--count is for --every, such as --every 1s --count 10"),
        ("--every 1s --count 0", "--count 0: give 1 or more"),
        ("--csv --json", "give --csv or --json, not both"),
        ("--timeout 0", "--timeout 0: give more than 0, at most 60 seconds"),
        ("--retries 101", "--retries 101: give 0 to 100"),
        ("--baud 02h", "--baud 02h: no module has this baud rate"),
        ("--protocol rtu --model I-7018", "I-7018 does not speak Modbus: M-7000 series only"),
        (
            "--protocol rtu --model 1=M-7018,protocol=dcon",
            "--protocol rtu: --model says another protocol for address 1",
        ),
        ("--address 0 --protocol rtu", "address 00: by Modbus, an address is 1..247"),
        ("--model 250=M-7018,protocol=rtu", "address FAh (250): by Modbus, an address is 1..247"),
        ("--address 300", "--address 300: an address is 0..255 or 00h..FFh"),
    ],
)
def test_wrong_usage_is_reported(run: Run, arguments: str, message: str) -> None:
    told = run("read", KELVIN, *arguments.split())

    assert (told.err, told.out, told.code) == (f"i7000: {message}\n", "", 2)


@pytest.mark.parametrize(
    ("target", "code"), [("sim:I-9999", 2), ("exec:", 2), ("/dev/nowhere", 3), ("socket://127.0.0.1:1", 3)]
)
def test_a_port_that_cannot_be_opened_is_an_error(run: Run, target: str, code: int) -> None:
    told = run("read", target)

    assert (told.code, told.out, told.err.count("\n")) == (code, "", 1)


# --- steadily ---------------------------------------------------------------------------------------------------------


def test_a_steady_reading_has_a_line_for_each_module_and_time(run: Run, clock: Clock) -> None:
    told = run("read", "sim:I-7018,type=K,channels=0-1+I-7017", "--address", "1", "--address", "9", "--every", "500ms",
               "--count", "3")  # fmt: skip

    lines = [re.split("  +", line)[1:] for line in told.out.splitlines()]
    assert lines == [["01", "152.4 degC", "304.9 degC", *["disabled"] * 6], ["09", "no answer"]] * 3
    assert clock.slept == [0.0, 0.5, 0.5]
    assert told.code == 0


def test_the_lines_of_csv_are_as_many_as_the_times(run: Run) -> None:
    told = run("read", TWO, "--address", "1", "--address", "2", "--every", "1s", "--count", "4", "--csv")

    head, *lines = csv.reader(told.out.splitlines())
    assert head[1] == "01:0 (degC)"
    assert head[-1] == "02:7 (V)"
    assert [len(line) for line in lines] == [len(head)] * 4


def test_csv_of_a_module_that_does_not_answer_at_first_is_refused(run: Run) -> None:
    told = run("read", TWO, "--address", "7", "--every", "1s", "--csv")

    assert told.err == "i7000: address 07: no answer; CSV needs the channels of all modules at its start\n"
    assert (told.code, told.out) == (3, "")


def test_a_reading_that_takes_longer_than_its_period_misses_some(run: Run, clock: Clock) -> None:
    slow = count()

    def poll(self: station.Station, line: Line) -> station.Polled:
        clock.at += 2.5 if next(slow) == 0 else 0.0
        return polled(self, line)

    polled = station.Station.poll
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(station.Station, "poll", poll)
        run("read", KELVIN, "--every", "1s", "--count", "3")

    assert clock.slept == [0.0, 0.5, 1.0]


def test_periods_do_not_drift() -> None:
    schedule = Schedule(100.0, 0.1)

    assert [schedule.next(number, schedule.begins(number) + 0.03) for number in range(1000)] == [*range(1, 1001)]


@pytest.mark.parametrize(("text", "found"), [("1s", 1.0), ("500ms", 0.5), ("2", 2.0), (".5", 0.5), ("1min", 60.0),
                                             ("1h", 3600.0), ("0.25 s", 0.25)])  # fmt: skip
def test_a_duration_has_a_unit_or_is_in_seconds(text: str, found: float) -> None:
    assert seconds(text) == found


@pytest.mark.parametrize("text", ["", "s", "-1s", "1 day", "1,5s", "1e3", "inf"])
def test_another_text_is_no_duration(text: str) -> None:
    with pytest.raises(UsageError, match="is not a duration"):
        seconds(text)


# --- what a module does meanwhile -------------------------------------------------------------------------------------


class Scene:
    """The ports that a reading opens: a simulated bus that can be changed, and lost, while it is read."""

    def __init__(self, targets: tuple[str, ...], faults: Faults, clock: Clock) -> None:
        self.clock = clock
        self.targets = iter(targets)
        self.at_first = faults
        self.ports: list[Any] = []

    def become(self, target: str) -> None:
        """Put other modules on the line."""
        self.ports[-1]._bus = open_target(target)._bus  # type: ignore[attr-defined] # noqa: SLF001

    def lose(self) -> None:
        self.ports[-1].close()

    def faults(self, faults: Faults) -> None:
        self.ports[-1].faults = faults

    def open(self, _: str, line: LineSettings) -> Any:
        target = next(self.targets)
        if target == "lost":
            raise LinkError("/dev/ttyUSB0: there is no such port")
        self.ports.append(open_target(target, line))
        self.faults(self.at_first)
        return self.ports[-1]


@pytest.fixture
def scene(clock: "Clock", monkeypatch: pytest.MonkeyPatch) -> Callable[..., Scene]:
    def of(*targets: str, faults: Faults = Faults()) -> Scene:  # noqa: B008 - frozen
        found = Scene(targets, faults, clock)
        monkeypatch.setattr("i7000.link.open_target", found.open)
        return found

    return of


def meanwhile(clock: Clock, **happenings: Any) -> None:
    """Do something when the reading waits for the n-th time: ``after_2=...``."""
    before, waits = clock.sleep, count()

    def sleep(some: float) -> None:
        happenings.get(f"after_{next(waits)}", lambda: None)()
        before(some)

    reading_: Any = reading
    reading_.sleep = sleep  # the fixture puts it back


SLOW = "sim:I-7018,type=K,channels=0"


def test_a_module_that_falls_silent_is_a_line_and_is_read_again_when_it_answers(
    run: Run, scene: Any, clock: Clock
) -> None:
    made = scene(SLOW)
    meanwhile(clock, after_1=lambda: made.faults(Faults(silent=1.0)), after_3=lambda: made.faults(Faults()))
    told = run("read", "COM3", "--every", "10s", "--count", "5")

    lines = [line.split("  ")[2] for line in told.out.splitlines()]
    assert lines == ["152.4 degC", "no answer to #01", "no answer to #01", "152.4 degC", "152.4 degC"]
    assert told.code == 0


def test_a_module_that_answers_later_is_identified_then(run: Run, scene: Any, clock: Clock) -> None:
    made = scene(SLOW, faults=Faults(silent=1.0))
    meanwhile(clock, after_2=lambda: made.faults(Faults()))
    told = run("read", "COM3", "--every", "30s", "--count", "5")

    words = [line.split("  ")[2] for line in told.out.splitlines()]
    assert words[:2] == ["no answer"] * 2
    assert words[-1] == "152.4 degC"
    assert "address 01: I-7018 or M-7018" in told.err


def test_a_module_that_gets_other_settings_is_identified_again(run: Run, scene: Any, clock: Clock) -> None:
    made = scene(SLOW)
    meanwhile(clock, after_1=lambda: made.become("sim:I-7018,type=J,channels=0,checksum=true"))
    told = run("read", "COM3", "--every", "1s", "--count", "5")

    words = [line.split("  ")[2] for line in told.out.splitlines()]
    assert words[:2] == ["152.4 degC", "no answer to #01"]
    assert words[-1] == "152.4 degC"
    assert told.err.splitlines()[1].startswith("i7000: address 01: I-7018 or M-7018 B4.5, read as I-7018, DCON with a ")


def test_a_doubted_module_that_cannot_be_found_is_left_as_it_was(run: Run, scene: Any, clock: Clock) -> None:
    made = scene(SLOW)
    meanwhile(clock, after_1=lambda: made.become("sim:I-7018,address=2"), after_8=lambda: made.become(SLOW))
    told = run("read", "COM3", "--every", "10s", "--count", "10")

    words = [line.split("  ")[2] for line in told.out.splitlines()]
    assert words == ["152.4 degC", *["no answer to #01"] * 7, "152.4 degC", "152.4 degC"]
    assert told.err.count("\n") == 1


def test_csv_keeps_its_columns_if_a_module_gets_other_units(run: Run, scene: Any, clock: Clock) -> None:
    made = scene(SLOW)
    meanwhile(clock, after_1=lambda: made.become("sim:I-7018,type=05,channels=0"))
    told = run("read", "COM3", "--every", "10s", "--count", "4", "--csv")

    lines = [*csv.reader(told.out.splitlines())]
    assert {len(line) for line in lines} == {9}
    assert lines[-1][1:] == ["not_understood"] * 8


def identified(monkeypatch: pytest.MonkeyPatch, change: Callable[[Identified], Identified]) -> None:
    """Change what modules say that they are."""

    def changed(*arguments: Any, **others: Any) -> Any:
        found = yield from identify(*arguments, **others)
        return change(found)

    monkeypatch.setattr(station, "identify", changed)


def test_a_module_of_unknown_types_is_not_read(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    unknown = (Unknown("types", "no answer to $018C0"),)
    identified(monkeypatch, lambda it: evolve(it, known=evolve(it.known, types=None), unknown=unknown))
    told = run("read", "sim:I-7018")

    assert told.err == ("i7000: address 01: the types of its channels are unknown (no answer to $018C0): give --type\n")
    assert told.code == 1


def test_unknown_types_without_a_reason_have_no_empty_parentheses(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    identified(monkeypatch, lambda it: evolve(it, known=evolve(it.known, types=None), unknown=()))
    told = run("read", "sim:I-7018")

    assert told.err == "i7000: address 01: the types of its channels are unknown: give --type\n"


def test_a_module_that_is_lost_again_while_it_is_identified_stays_as_it_was(
    run: Run, scene: Any, clock: Clock, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = scene(SLOW)

    def change() -> None:
        made.become("sim:I-7018,type=05")
        identified(monkeypatch, lambda _: Identified(0x01))

    meanwhile(clock, after_1=change)
    told = run("read", "COM3", "--every", "10s", "--count", "4")

    assert len(told.out.splitlines()) == 4
    assert told.err.count("\n") == 1


def test_a_port_that_is_lost_is_opened_again_when_it_is_back(run: Run, scene: Any, clock: Clock) -> None:
    made = scene(SLOW, "lost", "lost", "lost", SLOW)
    meanwhile(clock, after_1=made.lose)
    told = run("read", "COM3", "--every", "1s", "--count", "3")

    assert len(told.out.splitlines()) == 3
    assert told.err.splitlines()[1:] == [
        f"i7000: {SLOW}: the port is closed; waiting until it is back",
        "i7000: the port is back",
    ]
    assert clock.slept[1:6] == [1.0, 0.5, 1.0, 2.0, 4.0]
    assert told.code == 0


@pytest.mark.parametrize("every", [(), ("--every", "1s")])
def test_a_port_that_is_lost_at_first_is_an_error(run: Run, scene: Any, every: tuple[str, ...]) -> None:
    made = scene(SLOW)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(VirtualPort, "write", lambda self, _: self.close() or self.read())
        told = run("read", "COM3", *every)

    assert made.ports
    assert told.err == f"i7000: {SLOW}: the port is closed\n"
    assert (told.code, told.out) == (3, "")


def test_a_port_that_refuses_the_line_settings_is_an_error(run: Run, scene: Any) -> None:
    scene(SLOW)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(VirtualPort, "parity", property(lambda _: 1 / 0, lambda *_: None))
        told = run("read", "COM3")

    assert "the port cannot be set to 9600 N81" in told.err
    assert told.code == 3


# --- Ctrl-C -----------------------------------------------------------------------------------------------------------


def test_ctrl_c_during_a_wait_ends_with_what_was_read(run: Run, clock: Clock) -> None:
    meanwhile(clock, after_2=lambda: os.kill(os.getpid(), signal.SIGINT))
    told = run("read", SLOW, "--every", "1s", "--csv")

    assert (told.code, len(told.out.splitlines())) == (130, 3)


def test_sigterm_ends_with_its_own_exit_code(run: Run, clock: Clock) -> None:
    meanwhile(clock, after_1=lambda: os.kill(os.getpid(), signal.SIGTERM))

    assert run("read", SLOW, "--every", "1s").code == 143


def test_a_signal_waits_until_a_line_is_written(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    written: list[str] = []

    def slowly(line: str) -> None:
        os.kill(os.getpid(), signal.SIGINT)
        written.append(line)

    monkeypatch.setattr(reading_text, "printed", slowly)
    told = run("read", SLOW, "--json")

    assert json.loads(written[0])["answered"] is True
    assert told.code == 0  # it was the end anyway


def test_a_signal_before_a_wait_breaks_it_off_and_a_second_one_breaks_off_anything() -> None:
    ending = BreakingEnding()
    ending.ask(signal.SIGINT, None)

    with pytest.raises(KeyboardInterrupt), ending.breakable():
        pytest.fail("it waits")
    with pytest.raises(KeyboardInterrupt):
        ending.ask(signal.SIGINT, None)


def test_csv_has_empty_cells_while_a_module_does_not_answer(run: Run, scene: Any, clock: Clock) -> None:
    made = scene(SLOW)
    meanwhile(clock, after_1=lambda: made.faults(Faults(silent=1.0)))
    told = run("read", "COM3", "--every", "10s", "--count", "2", "--csv")

    _, first, second = csv.reader(told.out.splitlines())
    assert (first[1], second[1:]) == ("152.4", [""] * 8)


# --- the live view ----------------------------------------------------------------------------------------------------


def live(run: Run, monkeypatch: pytest.MonkeyPatch, *arguments: str, columns: int = 120) -> str:
    """What a terminal shows at the end, and all that was drawn before."""
    monkeypatch.setenv("TTY_COMPATIBLE", "1")
    monkeypatch.setenv("COLUMNS", f"{columns}")
    monkeypatch.setenv("TERM", "xterm")
    told = run("read", *arguments)

    assert told.code == 0
    return re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", told.out).replace("\r", "")


def test_a_terminal_shows_values_their_age_and_extremes_and_the_counters(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = live(run, monkeypatch, "sim:I-7018,type=K,channels=0+I-7017", "--address", "1", "--address", "5",
                 "--every", "1s", "--count", "2")  # fmt: skip

    assert "requests " in shown
    assert "missed periods 0" in shown
    last = shown.split("address  channel")[-1].splitlines()
    assert last[0].split() == ["value", "unit", "status", "age", "min", "max", "type"]
    assert re.fullmatch(r"01 +0 +152\.4 +degC +ok +\d+\.\d s +152\.4 +152\.4 +0F thermocouple K *", last[1])
    assert re.fullmatch(r"01 +7 +degC +disabled +0F thermocouple K *", last[8])
    assert re.fullmatch(r"05 +all +no answer *", last[9])


@pytest.mark.parametrize(
    ("module", "address", "unanswered"),
    [("M-7019R", "1", "0"), ("I-7018,checksum=true", "1", "0"), ("I-7018", "9", "[1-9]")],
)
def test_the_search_for_the_protocol_of_a_module_that_answers_is_not_counted_as_unanswered(
    run: Run, monkeypatch: pytest.MonkeyPatch, module: str, address: str, unanswered: str
) -> None:
    shown = live(run, monkeypatch, f"sim:{module}", "--address", address, "--every", "1s", "--count", "2")

    assert re.search(f"no answer {unanswered}", shown.split("Ctrl-C ends")[-1])


def test_a_narrow_terminal_has_no_types(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    shown = live(run, monkeypatch, "sim:I-7018,type=K", "--every", "1s", "--count", "1", columns=80)

    assert "thermocouple" not in shown
    assert max(map(len, shown.splitlines()[-8:])) <= 80


def test_a_file_is_written_beside_the_live_view(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    shown = live(run, monkeypatch, SLOW, "--every", "1s", "--count", "2", "--csv", "--output", f"{path}")

    assert len(path.read_text().splitlines()) == 3
    assert "152.4" in shown


def test_the_live_view_keeps_the_last_values_of_a_module_that_falls_silent(
    run: Run, scene: Any, clock: Clock, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = scene(SLOW)
    meanwhile(clock, after_1=lambda: made.faults(Faults(silent=1.0)))
    shown = live(run, monkeypatch, "COM3", "--every", "1s", "--count", "2")

    assert re.search(r"0 +152\.4 +degC +no answer +\d+\.\d s +152\.4 +152\.4", shown.split("channel")[-1])


def test_the_live_view_says_why_a_module_is_not_read(run: Run, scene: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    scene(SLOW, faults=Faults(refuse=1.0))
    shown = live(run, monkeypatch, "COM3", "--every", "1s", "--count", "2", "--model", "I-7018,type=K")

    assert shown.count("i7000: address 01: #01 is refused") == 1


# --- real ports -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("module", "line"),
    [
        ("I-7018,type=K,checksum=true,baud=1200", ("--baud", "1200")),
        ("M-7019R,type=K,baud=115200", ("--baud", "115200")),
        ("M-7018,type=K,protocol=dcon,baud=38400,character_format=E81",
         ("--baud", "38400", "--character-format", "E81")),
    ],
)  # fmt: skip
def test_modules_are_read_over_rfc_2217(run: Run, module: str, line: tuple[str, ...]) -> None:
    port = free_port()
    with process("--model", module, "--rfc2217", f"{port}", stdout=subprocess.PIPE, text=True) as simulator:
        assert simulator.stdout
        simulator.stdout.readline()
        told = run("read", f"rfc2217://127.0.0.1:{port}", *line, "--json", "--every", "50ms", "--count", "2")

    assert [it["type"] for record in told.records for it in record["channels"]] == ["0F"] * 16
    assert told.code == 0


READ = MAIN.replace("main()", "main(sys.argv[1:])")


def test_ctrl_c_loses_no_line_of_a_process_that_reads_a_terminal_device(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    with process("--model", "M-7019R,type=K", "--pty", stdout=subprocess.PIPE, text=True) as simulator:
        assert simulator.stdout
        device = simulator.stdout.readline().strip()
        command = [sys.executable, "-c", READ, "read", device, "--every", "50ms", "--csv"]
        with path.open("wb") as file, subprocess.Popen(command, stdout=subprocess.PIPE) as started:  # noqa: S603
            assert started.stdout
            for _ in range(4):
                file.write(started.stdout.readline())
            started.send_signal(signal.SIGINT)
            file.write(started.stdout.read())
            code = started.wait(timeout=ENOUGH)

    head, *lines = path.read_text().splitlines(keepends=True)
    assert code == 130
    assert len(lines) >= 3
    assert {line.count(",") for line in lines} == {head.count(",")}
    assert all(line.endswith("\n") for line in lines)


def test_a_signal_that_is_ignored_stays_ignored() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with broken_off_by_signals() as ending:
        os.kill(os.getpid(), signal.SIGINT)

    assert ending.number == 0


def test_without_a_standard_output_nothing_is_written(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdout", None)

    assert run("read", SLOW, "--csv").code == 0


# --- bad lines --------------------------------------------------------------------------------------------------------

BAD = [
    Faults(flip=0.01),
    Faults(drop=0.02),
    Faults(noise=0.5),
    Faults(late=0.5, duplicate=0.5),
    Faults(replay=0.3, misaddress=0.3),
    Faults(truncate=0.3, silent=0.2, refuse=0.2),
    Faults(echo=True, lumps=True),
]


@pytest.mark.parametrize("form", ["--csv", "--json", ""])
@pytest.mark.parametrize("faults", BAD)
def test_on_a_bad_line_each_time_has_its_lines_with_true_values_or_none(
    run: Run, scene: Any, faults: Faults, form: str
) -> None:
    made = scene("sim:M-7019R,type=K,channels=0+I-7018,type=K,checksum=true,channels=0")
    meanwhile(made.clock, after_1=lambda: made.faults(faults))
    told = run("read", "COM3", "--address", "1", "--address", "2", "--every", "1s", "--count", "12", *form.split())

    assert told.code == 0
    if form == "--json":
        assert [it["address"] for it in told.records] == [1, 2] * 12
        values = {it["channels"][0]["value"] for it in told.records if it["channels"]}
    elif form == "--csv":
        lines = [*csv.reader(told.out.splitlines())][1:]
        assert [len(line) for line in lines] == [17] * 12
        values = {float(cell) for line in lines for cell in (line[1], line[9]) if cell[:1].isdigit()}
    else:
        words = [line.split("  ") for line in told.out.splitlines()]
        assert [line[1] for line in words] == ["01", "02"] * 12
        values = {float(line[2].split()[0]) for line in words if line[2][:1].isdigit()}
    assert {round(value, 1) for value in values if value is not None} == {152.4}
