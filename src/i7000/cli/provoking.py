"""A provoked driver at the terminal: how a scenario runs, and when it is over."""

import asyncio
import shlex
from collections.abc import Sequence
from contextlib import AbstractAsyncContextManager, AsyncExitStack
from functools import partial
from pathlib import Path
from time import monotonic

from attrs import evolve, frozen

from i7000.cli.drivers import Driver, followed, started
from i7000.cli.faults import read_faults
from i7000.cli.module import read_module
from i7000.cli.provoke_report import Report, Result, result_lines, summary
from i7000.cli.serving import Place, open_places
from i7000.cli.text import Printer
from i7000.cli.words import LineError
from i7000.conformance.believed import Unreadable
from i7000.conformance.provoked import Judgement, Session, Verdict, is_decided, judge
from i7000.conformance.scenarios import Bus, Scenario, refusal
from i7000.device import Eeprom
from i7000.simulator.provoking import Player
from i7000.simulator.simulator import Simulated, Simulator
from i7000.simulator.sources import default_sources
from i7000.spec import digest

__all__ = ["Provoking", "run"]

DEFAULT_MODELS = ("I-7018,type=K", "I-7018,type=K")
_LOOK = 0.05
"""The seconds between two looks at what the driver has said."""
_SETTLE = 0.5
"""The seconds after the last step in which a driver can still report a wrong value."""
_ATTEMPTS = 3
"""How often a scenario is played whose failure is doubtful: this machine was too busy."""
_FAILED, _NOTHING = 1, 5
"""Exit codes: a failure; nothing ran, or not all was conclusive."""


@frozen
class Provoking:
    """What a driver is provoked with, and where."""

    scenarios: tuple[Scenario, ...]
    models: tuple[str, ...]
    """The modules; empty for the default ones."""
    pty: bool
    places: tuple[Place, ...]
    command: tuple[str, ...]
    """The driver, with ``{target}`` where its port stands; empty if somebody else runs it."""
    output: str
    """The file that somebody else's driver writes to."""
    seed: int
    longest: float
    """The longest time of all scenarios, in seconds."""
    each: float
    """The longest time of a scenario, in seconds."""
    patience: float
    """The longest time without a line of the driver, in seconds."""
    report: Path | None
    options: tuple[str, ...]
    """What else was given, to be given again."""

    def again(self, scenario: Scenario) -> str:
        """Return the command that plays a scenario again."""
        words = ["i7000", "provoke", "--scenario", scenario.name, "--seed", str(self.seed), *self.options]
        return shlex.join([*words, "--", *self.command] if self.command else words)


def run(provoking: Provoking, printer: Printer) -> int:
    """Play all scenarios, and return the exit code.

    Errors: `UsageError` for modules that cannot be; `OSError` for a report or a port that cannot be opened.
    """
    for scenario in provoking.scenarios:
        _eeproms(provoking.models, scenario, changed=False)
    until = monotonic() + provoking.longest
    results: list[Result] = []
    with Report(provoking.report) as report:
        report.start(
            spec=digest(),
            seed=provoking.seed,
            modules=list(provoking.models or DEFAULT_MODELS),
            command=list(provoking.command),
            scenarios=[it.name for it in provoking.scenarios],
        )
        for scenario in provoking.scenarios:
            result = _result(provoking, scenario, until, printer)
            results.append(result)
            report.scenario(result)
            printer.lines(result_lines(result, provoking.again(scenario)))
            printer.flush()
        code = _code(results)
        report.end(results, code)
    printer.lines(summary(results))
    return code


def _code(results: Sequence[Result]) -> int:
    verdicts = {it.judgement.verdict for it in results} - {Verdict.SKIP}
    if Verdict.ERROR in verdicts:
        return LineError.code
    if Verdict.FAIL in verdicts:
        return _FAILED
    return 0 if verdicts == {Verdict.PASS} else _NOTHING


# --- a scenario -------------------------------------------------------------------------------------------------------


def _result(provoking: Provoking, scenario: Scenario, until: float, printer: Printer) -> Result:
    reason = refusal(scenario, _bus(_eeproms(provoking.models, scenario, changed=False)))
    if reason is not None:
        return Result(scenario, Judgement(Verdict.SKIP, reason=reason))
    result = Result(scenario, Judgement(Verdict.INCONCLUSIVE, reason="no time was left: give a longer --max-time"))
    for _ in range(_ATTEMPTS if provoking.command else 1):
        left = min(provoking.each, until - monotonic())
        if left <= 0:
            break
        result = asyncio.run(_provoke(provoking, scenario, left, printer))
        if result.judgement.verdict is not Verdict.FAIL or not result.judgement.reason:
            break
    return result


def _bus(eeproms: Sequence[Eeprom]) -> Bus:
    return Bus(
        frozenset(it.protocol for it in eeproms),
        all(it.report_settings.checksum for it in eeproms),
        tuple(it.model.value for it in eeproms),
    )


def _eeproms(models: Sequence[str], scenario: Scenario, *, changed: bool) -> tuple[Eeprom, ...]:
    """Return the settings of the modules; with `changed`, as the scenario changes them.

    Errors: `UsageError` for modules that cannot be.
    """
    found = []
    for address, text in enumerate(models or DEFAULT_MODELS, 1):
        head, comma, settings = text.partition(",")
        if scenario.model and not models:
            head = scenario.model
        if changed and scenario.firmware is not None:
            head = f"{head.partition('@')[0]}@{scenario.firmware}"
        eeprom = read_module(f"{head}{comma}{settings}", address).eeprom
        found.append(_blanked(eeprom, scenario.blank) if changed else eeprom)
    return tuple(found)


def _blanked(eeprom: Eeprom, channels: Sequence[int]) -> Eeprom:
    mask = eeprom.channel_mask
    for channel in channels:
        mask &= ~(1 << channel)
    return evolve(eeprom, channel_mask=mask)


async def _provoke(provoking: Provoking, scenario: Scenario, seconds: float, printer: Printer) -> Result:
    """Play a scenario until it is over, or for so many seconds."""
    eeproms = _eeproms(provoking.models, scenario, changed=True)
    simulator = Simulator([Simulated(it, default_sources(it)) for it in eeproms], seed=provoking.seed)
    player = Player(scenario, simulator, simulator.connect, eeproms, lambda text: read_faults(text.split()))
    simulator.observe = player.observe
    async with AsyncExitStack() as opened:
        places = await open_places(provoking.places, simulator, opened, pseudo_terminal=provoking.pty)
        running = asyncio.create_task(simulator.run())
        opened.callback(running.cancel)
        clock = partial(_elapsed, simulator)
        if not provoking.command:
            printer.note(f"{scenario.name}: start your driver at {' or '.join(places)}")
        try:
            driver = await opened.enter_async_context(_driver(provoking, places[0], clock))
        except OSError as error:
            reason = f"the driver cannot be started: {error.strerror}: {error.filename}"
            return Result(scenario, Judgement(Verdict.ERROR, reason=reason))
        session = await _watch(provoking, player, driver, clock, seconds)
    return Result(
        scenario, judge(session), session.now, tuple(player.exchanges), driver.complaints.decode(errors="replace")
    )


def _elapsed(simulator: Simulator) -> float:
    return simulator.now - simulator.began


def _driver(provoking: Provoking, place: str, clock: "partial[float]") -> AbstractAsyncContextManager[Driver]:
    if not provoking.command:
        return followed(provoking.output, clock)
    return started([part.replace("{target}", place) for part in provoking.command], clock)


async def _watch(
    provoking: Provoking, player: Player, driver: Driver, clock: "partial[float]", seconds: float
) -> Session:
    """Wait until a scenario is over, and return what happened."""
    began = clock()
    over: float | None = None
    held_up, looked = 0.0, began
    while True:
        now = clock()
        held_up, looked = max(held_up, now - looked - _LOOK), now
        lines = tuple(driver.lines)
        session = player.session(
            Session(
                lines=lines,
                began=began,
                now=now,
                ended=driver.ended,
                patience=provoking.patience,
                held_up=held_up,
            )
        )
        last = lines[-1].at if lines else began
        if player.finished:
            over = now if over is None else over
            is_late = now - over > provoking.patience
            if driver.ended or is_late or (now - over > _SETTLE and is_decided(session)):
                return session
        elif driver.ended or now - last > provoking.patience:
            return session
        if now - began > seconds or any(isinstance(line.said, Unreadable) for line in lines):
            return session
        await asyncio.sleep(_LOOK)
