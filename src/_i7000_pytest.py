"""The pytest plugin (extra ``pytest``): fixtures with simulated modules for drivers, and checks of modules.

With ``--i7000-target TARGET`` every check of the conformance kit is a test of the module at that port.

It is outside the package because pytest imports it in every run where i7000 is installed. It imports nothing but
pytest; the rest is imported by the first test that uses a fixture.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from i7000.device import Eeprom
    from i7000.link import Bench, VirtualPort
    from i7000.simulator import Faults, RunningSimulator, Simulated

_MARKER = "i7000"
_USAGE = '@pytest.mark.i7000("M-7019R,type=K", signals=["all=25degC"], faults=["late=0.1"], seed=0, over="pty")'
_OPTIONS = ("signals", "faults", "seed", "over")


_BENCH = pytest.StashKey["Bench"]()
_VERDICTS = pytest.StashKey["list[str]"]()
"""The verdicts of the checks that were tests."""
_PASSED = "PASS", "INFO"
_UNDECIDED = "SKIP", "INCONCLUSIVE"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options for the checks of a module."""
    group = parser.getgroup("i7000", "checks of ICP DAS I-7000/M-7000 modules")
    group.addoption(
        "--i7000-target",
        metavar="TARGET",
        help="check the module at this port: a device, socket://HOST:PORT, sim:MODEL or exec:COMMAND;"
        " -k and --deselect select among the checks; with --collect-only, identity and settings are read, nothing more",
    )
    group.addoption("--i7000-address", metavar="ADDRESS", type=int, default=1, help="its address, 1 unless given")
    group.addoption("--i7000-model", metavar="MODEL", help="its model, such as M-7019R; read from it unless given")
    group.addoption(
        "--i7000-allow",
        metavar="HAZARD",
        action="append",
        default=[],
        choices=["write", "broadcast"],
        help="also send what changes settings, which are restored (write), or what every module hears (broadcast)",
    )
    group.addoption(
        "--i7000-snapshot",
        metavar="FILE",
        help="the new file for the settings before the first check that changes any;"
        " i7000-MODEL-ADDRESS-TIME.json in the root directory unless given",
    )


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(session: pytest.Session, config: pytest.Config, items: list[pytest.Item]) -> None:
    """Add the checks of the module at ``--i7000-target``, before any are deselected."""
    target = config.getoption("--i7000-target")
    if target is None:
        return
    bench = config.stash[_BENCH] = _bench(target, config)
    config.stash[_VERDICTS] = []
    checks = _Checks.from_parent(session, name=target, nodeid="i7000")
    applicable = [it for it in bench.planned if not (it.skip and it.skip.reason.value == "not-applicable")]
    items += [_Check.from_parent(checks, name=it.statement.id) for it in applicable]


def _bench(target: str, config: pytest.Config) -> Bench:
    """Open the port, and ask the module what it is."""
    from i7000 import I7000Error, Model  # noqa: PLC0415 - see above
    from i7000.conformance.hazard import Hazard  # noqa: PLC0415
    from i7000.link import Bench  # noqa: PLC0415

    name = config.getoption("--i7000-model")
    models = {model.value: model for model in Model}
    if name is not None and name not in models:
        raise pytest.UsageError(f"--i7000-model {name}: give one of {', '.join(models)}")
    allow = () if config.getoption("--collect-only") else map(Hazard, config.getoption("--i7000-allow"))
    address, file = config.getoption("--i7000-address"), config.getoption("--i7000-snapshot")
    try:
        return Bench(
            target,
            address=address,
            model=models.get(name),
            allow=allow,
            snapshot=config.rootpath if file is None else file,
        )
    except I7000Error as error:
        raise pytest.UsageError(f"--i7000-target: {error}") from None


class _Checks(pytest.Collector):
    """The checks of a module."""

    def collect(self) -> list[pytest.Item]:
        """Return nothing: the checks are made when all tests are collected."""
        return []


class _FailedError(Exception):
    """A check that the module did not pass."""


class _Check(pytest.Item):
    """A check as a test."""

    def runtest(self) -> None:
        """Carry out the check."""
        result = self.config.stash[_BENCH].result(self.name)
        verdict = result.verdict.value
        self.config.stash[_VERDICTS].append(verdict)
        if verdict == "SKIP":
            pytest.skip(f"{verdict}: {result.text}")
        if verdict == "WARN":
            warnings.warn(pytest.PytestWarning(f"{self.name}: {result.text}"), stacklevel=1)
        elif verdict not in _PASSED:
            raise _FailedError(result)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:  # noqa: ANN401
        """Return why the check failed, in lines."""
        if not isinstance(excinfo.value, _FailedError):
            return super().repr_failure(excinfo, style)
        result = excinfo.value.args[0]
        statement = result.statement
        rows = (
            (result.verdict.value, result.text),
            ("required", f"{statement.requirement} (manual {', '.join(statement.sections)})"),
            ("wrote", result.wrote.hex(" ")),
            ("answered", result.wrote and (result.answered.hex(" ") or "nothing")),
            ("sent", result.sent.hex(" ")),
            ("received", result.received.hex(" ") or "nothing"),
            ("expected", result.expected),
        )
        return "\n".join(f"{name:9} {text}" for name, text in rows if text)

    def reportinfo(self) -> tuple[str, None, str]:
        """Return the name of the check for reports."""
        return "i7000", None, self.name


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:  # noqa: ANN401 - it has no public type
    """Write what the checks proved, and how the module was left."""
    bench = config.stash.get(_BENCH, None)
    if bench is None:
        return
    proved = {section for it in bench.results if it.verdict.value == "PASS" for section in it.statement.sections}
    passed = sum(it.verdict.value == "PASS" for it in bench.results)
    terminalreporter.section(f"i7000: {bench.model.value}")
    terminalreporter.write_line(f"{passed} of {len(bench.results)} checks passed; they prove {len(proved)} sections")
    if bench.kept is not None:
        terminalreporter.write_line(f"the settings of before are in {bench.kept}")
    for words in config.stash.get(_LEFT, ()):
        terminalreporter.write_line(words, red=True)


_LEFT = pytest.StashKey["tuple[str, ...]"]()
_LEFT_CHANGED = 6
_DONE = pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED
_NOTHING = pytest.ExitCode.NO_TESTS_COLLECTED


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Restore the module, and close the port; change the exit code if nothing was decided, or something left."""
    from i7000 import I7000Error  # noqa: PLC0415 - see above

    bench = session.config.stash.get(_BENCH, None)
    if bench is None:
        return
    try:
        settled = bench.close()
    except I7000Error as error:
        words: tuple[str, ...] = (f"the module could not be restored: {error}",)
    else:
        silent = ("the module does not answer any more",) if settled.silent else ()
        left = (f"the module was left changed: {', '.join(settled.left)}",) if settled.left else ()
        words = (*silent, *left)
    session.config.stash[_LEFT] = words
    verdicts = session.config.stash[_VERDICTS]
    undecided = verdicts and all(verdict in _UNDECIDED for verdict in verdicts)
    if undecided and session.exitstatus in _DONE and session.testsfailed == verdicts.count("INCONCLUSIVE"):
        session.exitstatus = _NOTHING
    if words:
        session.exitstatus = _LEFT_CHANGED


def pytest_configure(config: pytest.Config) -> None:
    """Register the marker, and refuse to check a module in several processes."""
    if config.getoption("--i7000-target") and getattr(config.option, "numprocesses", None):
        raise pytest.UsageError("--i7000-target: one process has the port: leave out --numprocesses")
    config.addinivalue_line(
        "markers",
        f"{_MARKER}(*models, signals=(), faults=(), seed=0, over=None): the modules of i7000_bus and i7000_port,"
        " as i7000 simulate describes them",
    )


@pytest.fixture
def i7000_bus(request: pytest.FixtureRequest) -> Iterator[VirtualPort]:
    """Return a port with simulated modules in virtual time, with the methods of `serial.Serial`.

    The marker ``i7000`` says which modules, or the parameter of an indirect parametrization: a model or a list. A read
    that waits takes no real time. `now()` is the clock, `sleep(seconds)` lets time pass, `power_cycle()` switches the
    power off and on; `faults` and `signals` can be changed.
    """
    from i7000.link import VirtualPort  # noqa: PLC0415 - see above

    modules, faults, options = _scene(request)
    port = VirtualPort(modules, faults=faults, seed=options.get("seed", 0))
    yield port
    port.close()


@pytest.fixture
def i7000_port(request: pytest.FixtureRequest) -> Iterator[RunningSimulator]:
    """Return the URL of a port with simulated modules in real time, for `serial.serial_for_url`.

    The marker ``i7000`` says which modules, as for ``i7000_bus``, and ``over`` what the port is: ``"pty"``,
    ``"socket"`` or ``"rfc2217"``. The URL is a `i7000.simulator.RunningSimulator`, whose methods operate the modules.
    """
    from i7000.simulator import simulate  # noqa: PLC0415 - see above

    modules, faults, options = _scene(request)
    with simulate(*modules, faults=faults, **options) as running:
        yield running


def _scene(request: pytest.FixtureRequest) -> tuple[tuple[Simulated, ...], Faults, dict[str, Any]]:
    """Read what the marker and the parameter of a test say."""
    from i7000.cli.faults import read_faults  # noqa: PLC0415 - see above
    from i7000.cli.module import read_module  # noqa: PLC0415
    from i7000.cli.signals import read_signals  # noqa: PLC0415
    from i7000.cli.words import UsageError  # noqa: PLC0415
    from i7000.simulator import Simulated  # noqa: PLC0415

    marker = request.node.get_closest_marker(_MARKER)
    given: dict[str, Any] = dict(marker.kwargs) if marker else {}
    models = _texts(getattr(request, "param", marker.args if marker else ()))
    unknown = [name for name in given if name not in _OPTIONS]
    if unknown or not models:
        wrong = f"there is no option {unknown[0]!r}" if unknown else "no modules"
        raise pytest.UsageError(f"{request.node.nodeid}: {wrong}: write {_USAGE}")
    try:
        described = [read_module(text, address) for address, text in enumerate(models, 1)]
        eeproms: list[Eeprom] = [it.eeprom for it in described]
        sources = read_signals(_texts(given.pop("signals", ())), eeproms, given.get("seed", 0))
        faults = read_faults(_texts(given.pop("faults", ())))
    except UsageError as error:
        raise pytest.UsageError(f"{request.node.nodeid}: {error}") from None
    switches = [it.init_switch for it in described]
    return tuple(map(Simulated, eeproms, sources, switches)), faults, given


def _texts(given: Any) -> tuple[str, ...]:  # noqa: ANN401 - whatever a test says
    """Return texts that are given alone or in a list."""
    return (given,) if isinstance(given, str) else tuple(given)
