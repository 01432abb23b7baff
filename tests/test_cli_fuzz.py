"""``i7000 fuzz``: near misses through the guard, until a module does not answer as before."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from i7000 import LineSettings, Model, TypeCode
from i7000.conformance import DEFAULT_ALLOWED, GuardError, Hazard, hazards_of
from i7000.device import Bus, factory, power_on
from i7000.link import VirtualPort
from tests.each import each
from tests.terminal import Run

QUICK = ("--timeout", "0.05", "--retries", "0")


class Fragile(VirtualPort):
    """A module that stops answering at a frame, until it is restarted; or that stores something else."""

    def __init__(self, breaks: Callable[[bytes], bool], *, stores: bool = False) -> None:
        super().__init__([power_on(factory(Model.I_7018), now=0.0)])
        self.breaks = breaks
        self.stores = stores
        self.broken = False
        self.written: list[bytes] = []

    def write(self, data: Any) -> int:
        self.written.append(data)
        if self.breaks(data):
            self.broken = not self.stores
            if self.stores:
                self._bus = Bus(tuple(it.store(type_codes=(TypeCode.K,) * 8) for it in self._bus.modules))
        return len(data) if self.broken else super().write(data)

    def rename(self, name: str) -> None:
        """Store another name."""
        self._bus = Bus(tuple(it.store(name=name) for it in self._bus.modules))

    def power_cycle(self, *, init_switch: bool | None = None) -> None:
        self.broken = False
        super().power_cycle(init_switch=init_switch)


@pytest.fixture
def fragile(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Fragile]:
    def make(breaks: Callable[[bytes], bool], *, stores: bool = False) -> Fragile:
        port = Fragile(breaks, stores=stores)
        monkeypatch.setattr("i7000.link.open_target", lambda *_, **__: port)
        return port

    return make


@each("target", ["sim:I-7017", "sim:M-7019R,protocol=rtu", "sim:M-7017Z,protocol=dcon,checksum=yes"])
def test_a_module_that_answers_to_the_end_passes(target: str, run: Run) -> None:
    told = run("fuzz", target, "--frames", "60", *QUICK)

    assert told.code == 0
    assert "all answered" in told.out


def test_the_same_seed_sends_the_same_frames_and_nothing_that_is_not_allowed(run: Run, fragile: Any) -> None:
    sent = []
    for seed in ("1", "1", "2"):
        port = fragile(lambda _: False)
        assert run("fuzz", "sim:I-7018", "--frames", "100", "--seed", seed, *QUICK).code == 0
        sent.append(port.written)

    assert sent[0] == sent[1] != sent[2]
    assert all(hazards_of(wire) <= DEFAULT_ALLOWED for wire in sent[2])


def test_the_first_lost_sentinel_ends_the_run_and_the_fewest_frames_are_found(
    run: Run, fragile: Any, tmp_path: Path
) -> None:
    fragile(lambda wire: b"#" in wire and len(wire) > 30)
    file = tmp_path / "case.json"

    told = run("fuzz", "sim:I-7018", "--frames", "2000", "--report", str(file), *QUICK)

    assert told.code == 1
    assert "is silent after" in told.err
    case = json.loads(file.read_text(encoding="utf-8"))
    assert json.loads(told.out) == case
    assert (case["protocol"], case["outcome"], case["reproduced"]) == ("dcon", "silent", True)
    assert 0 < case["tries"] <= 200
    (wire,) = map(bytes.fromhex, case["frames"])
    assert b"#" in wire
    assert 30 < len(wire) < 80


def test_a_module_whose_settings_changed_is_reported_as_left_changed(run: Run, fragile: Any) -> None:
    fragile(lambda wire: wire.startswith(b"#01") and len(wire) > 8, stores=True)

    told = run("fuzz", "sim:I-7018", "--frames", "2000", *QUICK)

    assert told.code == 6
    assert json.loads(told.out)["outcome"] == "changed"
    assert json.loads(told.out)["reproduced"] is False


def test_a_port_that_cannot_be_restarted_gives_all_frames_since_the_last_answer(
    run: Run, fragile: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    fragile(lambda wire: len(wire) > 60)
    monkeypatch.setattr("i7000.link.guarded._OPTIONAL", {"now", "sleep"})

    told = run("fuzz", "sim:I-7018", "--frames", "2000", *QUICK)

    case = json.loads(told.out)
    assert told.code == 1
    assert (case["reproduced"], case["tries"]) == (False, 0)
    assert 1 < len(case["frames"]) <= 20


@pytest.mark.parametrize(("kept", "code"), [(True, 6), (False, 1)])
def test_a_setting_that_the_sentinel_does_not_show_is_reported(
    run: Run, fragile: Any, monkeypatch: pytest.MonkeyPatch, *, kept: bool, code: int
) -> None:
    port = fragile(lambda _: False)
    sent: list[bool] = []

    def renamed(*_: Any) -> bytes:
        if not sent:
            port.rename("OTHER")
        sent.append(True)
        return b"!02\r"

    def restarted(**_: Any) -> None:
        port.rename("7018")

    monkeypatch.setattr("i7000.cli.fuzzing.near_miss", renamed)
    if not kept:
        monkeypatch.setattr(port, "power_cycle", restarted)

    told = run("fuzz", "sim:I-7018", "--frames", "20", *QUICK)

    assert told.code == code
    assert "name was 7018, is OTHER" in told.err


def test_settings_that_differ_after_a_lost_sentinel_are_reported_too(run: Run, fragile: Any) -> None:
    fragile(lambda wire: wire.startswith(b"#01") and len(wire) > 8, stores=True)

    told = run("fuzz", "sim:I-7018", "--frames", "2000", *QUICK)

    assert told.code == 6
    assert "has other settings now: " in told.err


def test_a_module_that_does_not_answer_the_sentinel_at_the_start_is_not_fuzzed(
    run: Run, fragile: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    port = fragile(lambda _: False)
    with monkeypatch.context() as patched:
        patched.setattr("i7000.cli.fuzzing.near_miss", lambda *_: b"!marker\r")
        assert run("fuzz", "sim:I-7018", "--frames", "1", *QUICK).code == 0
    asked = port.written.index(b"!marker\r")
    port = fragile(lambda _: len(port.written) == asked)

    told = run("fuzz", "sim:I-7018", *QUICK)

    assert told.code == 3
    assert "does not answer ReadConfiguration" in told.err


def test_a_time_limit_ends_the_run(run: Run) -> None:
    told = run("fuzz", "sim:I-7018", "--max-time", "1", *QUICK)

    assert told.code == 0
    assert int(told.out.split(": ")[1].split()[0]) < 100


def test_a_run_in_which_the_guard_leaves_everything_out_did_not_pass(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("i7000.cli.fuzzing.near_miss", lambda *_: b"#**\r")

    told = run("fuzz", "sim:I-7018", "--frames", "3", *QUICK)

    assert told.code == 5
    assert "0 frames sent, 3 left out by the guard" in told.out


@each("options", [("--frames", "100", "--max-time", "4"), ("--frames", "100")])
def test_the_time_of_a_run_is_estimated_at_a_real_port(options: tuple[str, ...], run: Run, fragile: Any) -> None:
    port = fragile(lambda _: False)
    told = run("fuzz", "exec:./firmware", *options, *QUICK)

    assert told.code == 0
    estimate = re.search(r"this takes about (\d+) s\n", told.err)
    assert estimate
    assert int(estimate[1]) == 4 if "--max-time" in options else 0.5 < int(estimate[1]) / port.now() < 1.5


def test_no_time_is_estimated_for_a_simulated_module(run: Run) -> None:
    assert "this takes about" not in run("fuzz", "sim:I-7018", "--frames", "5", *QUICK).err


def test_progress_is_drawn_on_a_terminal(run: Run, fragile: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    fragile(lambda wire: len(wire) > 60)
    monkeypatch.setattr("i7000.cli.text.Printer.is_interactive", property(lambda _: True))
    monkeypatch.setenv("FORCE_COLOR", "1")
    told = run("fuzz", "sim:I-7018", "--frames", "2000", *QUICK)

    assert told.code == 1
    assert "/2000" in told.out
    assert "left out by the guard" in told.out
    assert "looking for the fewest frames that make it fail: at most 200 tries" in told.err
    assert "/200 " in told.out


WRONG = (
    ("--frames", "0"), ("--max-time", "0"), ("--max-time", "nan"),
    ("--report", "no/folder.json"), ("--report", __file__),
)  # fmt: skip


@each("arguments", WRONG)
def test_wrong_usage_is_said_before_the_port_is_opened(arguments: tuple[str, str], run: Run) -> None:
    told = run("fuzz", "/dev/not-there", *arguments)

    assert told.code == 2
    assert arguments[0] in told.err


def test_a_module_that_is_not_there_is_an_error_of_the_line(run: Run) -> None:
    assert run("fuzz", "sim:I-7018,address=9", *QUICK).code == 3
    assert run("fuzz", "/dev/not-there").code == 3


def test_a_module_is_identified_without_a_question_that_is_refused(run: Run) -> None:
    told = run(
        "fuzz", "sim:M-7018,address=255,protocol=dcon,checksum=yes", "--address", "255", "--frames", "60", *QUICK
    )

    assert told.code == 0
    assert "not asked: $FFP00" in told.err


def test_a_module_that_cannot_be_identified_within_what_is_allowed_is_said(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def cause(*_: Any) -> str:
        raise GuardError(b"~01I\r", frozenset({Hazard.COMM}), b"", LineSettings(), own=True)

    monkeypatch.setattr("i7000.cli.reached.silence_cause", cause)

    told = run("fuzz", "sim:I-7018,address=9", *QUICK)

    assert told.code == 2
    assert "~01I" in told.err
    assert "--allow comm" in told.err


def test_text_that_frames_by_modbus_leave_does_not_prevent_the_sentinel(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("i7000.cli.fuzzing.near_miss", lambda *_: b"$01")

    told = run("fuzz", "sim:M-7019R,address=48,protocol=rtu", "--address", "48", "--frames", "40", *QUICK)

    assert told.code == 0
    assert "40 frames sent" in told.out
