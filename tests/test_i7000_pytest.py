"""The pytest plugin: fixtures with simulated modules, as the tests of a driver use them."""

import importlib
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from time import monotonic

import pytest
import serial

import _i7000_pytest
from i7000 import Model, Profile, TypeCode, dcon
from i7000.conformance.settle import Settled
from i7000.device import factory, power_on
from i7000.host import Answered
from i7000.link import Line, VirtualPort
from i7000.simulator import Faults, RunningSimulator

importlib.reload(_i7000_pytest)  # pytest has imported it before coverage began to look

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
KELVIN = "M-7019R,type=K,protocol=dcon"
PROFILE = Profile(Model.M_7019R, type_codes=(TypeCode.K,) * 8)


def values(port: VirtualPort) -> tuple[float | None, ...]:
    with Line(port) as line:
        outcome = line.ask(dcon.ReadAnalogInputs(1), PROFILE)
    assert isinstance(outcome, Answered)
    return tuple(reading.value for reading in dcon.readings(outcome.response, PROFILE))


@pytest.mark.i7000(KELVIN, signals=["all=25degC"])
def test_the_bus_has_the_modules_and_signals_of_the_marker(i7000_bus: VirtualPort) -> None:
    assert values(i7000_bus) == (25.0,) * 8


@pytest.mark.i7000(KELVIN, faults="silent=1")
def test_waiting_for_a_module_that_is_silent_takes_no_real_time(i7000_bus: VirtualPort) -> None:
    began = monotonic()
    i7000_bus.timeout = 3600.0
    i7000_bus.write(b"#01\r")

    assert (i7000_bus.read(), i7000_bus.now() >= 3600.0) == (b"", True)
    assert monotonic() - began < 600.0


@pytest.mark.parametrize("i7000_bus", ["I-7018", ["I-7017", "I-7018"]], indirect=True)
def test_a_parameter_says_which_modules(i7000_bus: VirtualPort) -> None:
    assert i7000_bus.modules[-1].eeprom.model is Model.I_7018
    assert [module.eeprom.address for module in i7000_bus.modules] == [1, 2][: len(i7000_bus.modules)]


@pytest.mark.i7000(KELVIN, signals=["all=25degC"])
def test_the_port_is_a_url_and_operates_the_modules(i7000_port: RunningSimulator) -> None:
    with serial.serial_for_url(i7000_port, timeout=10) as port:
        port.write(b"$01M\r")
        assert port.read_until(b"\r") == b"!017019R\r"
        i7000_port.faults = Faults(refuse=1.0)
        port.write(b"$01M\r")
        assert port.read_until(b"\r") == b"?01\r"


@pytest.mark.i7000(KELVIN, over="socket")
def test_the_port_can_be_one_of_the_network(i7000_port: RunningSimulator) -> None:
    assert i7000_port.startswith("socket://127.0.0.1:")


@pytest.mark.parametrize(
    ("marker", "message"),
    [
        ("", "no modules: write @pytest.mark.i7000"),
        ("@pytest.mark.i7000('M-7019R', signal='0=1V')", "there is no option 'signal': write @pytest.mark.i7000"),
        ("@pytest.mark.i7000('M-9999')", "M-9999"),
        ("@pytest.mark.i7000('M-7019R', faults='rust=1')", "there is no fault 'rust'"),
        ("@pytest.mark.i7000('M-7019R', signals='9=1V')", "9=1V"),
    ],
)
def test_what_is_wrong_with_a_marker_is_said(
    ask_pytest: Callable[[str], pytest.RunResult], marker: str, message: str
) -> None:
    result = ask_pytest(f"import pytest\n\n{marker}\ndef test_it(i7000_bus):\n    pass\n")

    result.assert_outcomes(errors=1)
    assert message in result.stdout.str()


@pytest.fixture
def ask_pytest(pytester: pytest.Pytester) -> Callable[[str], pytest.RunResult]:
    """Run pytest over the text of a test."""

    def ask(text: str) -> pytest.RunResult:
        pytester.makepyfile(text)
        return pytester.runpytest_inprocess("-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:cov")

    return ask


def test_the_marker_is_registered(ask_pytest: Callable[[str], pytest.RunResult], pytester: pytest.Pytester) -> None:
    pytester.makeini("[pytest]\naddopts = --strict-markers\n")

    result = ask_pytest("import pytest\n@pytest.mark.i7000('I-7018')\ndef test_it(i7000_bus):\n    i7000_bus.now()\n")

    result.assert_outcomes(passed=1)


def test_the_example_of_the_readme_passes(ask_pytest: Callable[[str], pytest.RunResult]) -> None:
    (example,) = (it for it in re.findall(r"```python\n(.*?)```", README, re.DOTALL) if "i7000_bus" in it)

    ask_pytest(example).assert_outcomes(passed=1)


def test_loading_the_plugin_imports_nothing_but_pytest() -> None:
    script = "import sys, pytest; known = set(sys.modules); import _i7000_pytest; print(set(sys.modules) - known)"

    told = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)  # noqa: S603

    assert told.stdout.strip() == "{'_i7000_pytest'}"


# --- the checks of a module -------------------------------------------------------------------------------------------


@pytest.fixture
def check(pytester: pytest.Pytester) -> Callable[..., pytest.RunResult]:
    """Run the checks of a module as pytest does."""

    def run(*options: str) -> pytest.RunResult:
        return pytester.runpytest_inprocess("-p", "no:cacheprovider", "-p", "no:cov", *options)

    return run


class Longer(VirtualPort):
    """A module that answers one byte more when it is asked for its configuration."""

    longer = False

    def write(self, data: object) -> int:
        self.longer = bytes(data) == b"$012\r"  # type: ignore[call-overload] # it is bytes
        return super().write(data)

    def read(self, size: int = 1) -> bytes:
        found = super().read(size)
        return found.replace(b"\r", b"0\r") if self.longer else found


def test_the_checks_of_a_module_are_tests(check: Callable[..., pytest.RunResult]) -> None:
    result = check("-p", "no:xdist", "--i7000-target", "sim:I-7018", "-k", "frame")

    counts = result.parseoutcomes()
    assert counts["passed"] > 5
    assert counts["skipped"] == 4  # it has no checksum
    result.stdout.re_match_lines([r"=+ i7000: I-7018 =+", r"\d+ of \d+ checks passed; they prove \d sections"])
    assert result.ret == 0


def test_a_check_that_a_module_does_not_pass_shows_the_bytes(
    check: Callable[..., pytest.RunResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    port = Longer([power_on(factory(Model.I_7018), now=0.0)])
    monkeypatch.setattr("i7000.link.bench.open_target", lambda *_: port)

    result = check("-p", "no:xdist", "--i7000-target", "sim:I-7018", "--i7000-model", "I-7018", "-k", "2.10")

    result.stdout.fnmatch_lines(["required *", "sent * 24 30 31 32 0d", "received *30 0d"])
    assert result.ret == 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--i7000-target", "sim:I-7018", "--i7000-address", "2"), "no module answers at address 02"),
        (("--i7000-target", "sim:nonsense"), "nonsense"),
        (("--i7000-target", "sim:I-7018", "--i7000-model", "I-1"), "give one of I-7017"),
        (("--i7000-target", "sim:I-7018", "-n", "1"), "leave out --numprocesses"),
    ],
)
def test_a_module_that_cannot_be_checked_is_an_error_of_usage(
    options: tuple[str, ...], message: str, check: Callable[..., pytest.RunResult]
) -> None:
    result = check(*options)

    assert message in result.stderr.str() + result.stdout.str()
    assert result.ret != 0


def test_a_module_that_is_left_changed_is_the_exit_code(
    check: Callable[..., pytest.RunResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "i7000.link.bench.Bench.close", lambda _: Settled(restored=("filter",), left=("filter",), silent=False)
    )

    result = check("-p", "no:xdist", "--i7000-target", "sim:I-7018", "-k", "link/alive")

    result.stdout.fnmatch_lines(["the module was left changed: filter"])
    assert result.ret == 6
