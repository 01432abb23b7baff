"""The pytest plugin (extra ``pytest``): fixtures with simulated modules for the tests of drivers.

It is outside the package because pytest imports it in every run where i7000 is installed. It imports nothing but
pytest; the rest is imported by the first test that uses a fixture.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from i7000.device import Eeprom
    from i7000.link import VirtualPort
    from i7000.simulator import Faults, RunningSimulator, Simulated

_MARKER = "i7000"
_USAGE = '@pytest.mark.i7000("M-7019R,type=K", signals=["all=25degC"], faults=["late=0.1"], seed=0, over="pty")'
_OPTIONS = ("signals", "faults", "seed", "over")


def pytest_configure(config: pytest.Config) -> None:
    """Register the marker."""
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
