"""A simulation: its options, how it runs and how it ends.

Laws: what only some options need is imported when one of them is used.
"""

import asyncio
import signal
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AsyncExitStack, contextmanager
from functools import partial
from importlib.util import find_spec
from pathlib import Path

from attrs import frozen

from i7000.cli.control import Control, follow_input, listening
from i7000.cli.keys import Prompt, pressed
from i7000.cli.module import read_module
from i7000.cli.operating import module_commands
from i7000.cli.outlet import Outlet
from i7000.cli.recorded import RecordOptions, both, recorded
from i7000.cli.serving import Place, ended_by_signals, handlers_kept, never_held_up, open_places, show_answer
from i7000.cli.signals import read_signals
from i7000.cli.text import Printer
from i7000.cli.traffic import change_line, lines
from i7000.cli.view import View
from i7000.cli.words import UsageError
from i7000.device import Eeprom, State
from i7000.errors import I7000Error, Noise
from i7000.recording import Carried, Event
from i7000.settings import Protocol
from i7000.simulator.faults import Faults
from i7000.simulator.observed import Change, Observed
from i7000.simulator.simulator import Simulated, Simulator
from i7000_cli import FAILED, INTERRUPTED

__all__ = ["Simulation", "held", "read_modules", "run"]


@frozen
class Simulation:
    """Everything that is simulated, and the ports to it."""

    modules: tuple[Simulated, ...]
    faults: Faults
    seed: int
    memory: Path | None
    pty: bool
    places: tuple[Place, ...]
    view: str
    control: str | None
    """Where commands come from: ``-`` is standard input, else the path of a socket; None is nowhere."""
    recording: RecordOptions


@contextmanager
def held(memory: Path | None) -> Iterator[None]:
    """Lock the file of the settings, if there is one, against other simulators.

    Errors: `UsageError` if another one uses it; that or `OSError` if it cannot be written.
    """
    if memory is None:
        yield
        return
    from i7000.simulator.memory import MemoryFileError  # noqa: PLC0415
    from i7000.simulator.memory import held as held_file  # noqa: PLC0415

    try:
        with held_file(memory):
            yield
    except MemoryFileError as error:
        raise UsageError(error) from None


def read_modules(
    texts: Sequence[str], signals: Sequence[str], *, seed: int, memory: Path | None
) -> tuple[Simulated, ...]:
    """Return the modules, with the signals at their inputs.

    Special: an existing file decides the settings; otherwise `texts` do.
    Errors: `UsageError`, also for a file that is damaged; `OSError`.
    """
    described = [read_module(text, address) for address, text in enumerate(texts, 1)]
    eeproms = tuple(it.eeprom for it in described)
    switches = tuple(it.init_switch for it in described)
    if memory is not None and memory.exists():
        from i7000.simulator.memory import load  # noqa: PLC0415

        try:
            stored = load(memory)
        except I7000Error as error:
            raise UsageError(error) from None
        if described and list(map(_kind, stored)) != list(map(_kind, eeproms)):
            raise UsageError(f"{memory} holds {_kinds(stored)}, not {_kinds(eeproms)}")
        eeproms, switches = stored, switches or (False,) * len(stored)
    if not eeproms:
        raise UsageError("no modules: give --model once for each, such as --model M-7019R")
    return tuple(map(Simulated, eeproms, read_signals(signals, eeproms, seed), switches))


def _kind(eeprom: Eeprom) -> str:
    return f"{eeprom.model.value}@{eeprom.firmware}"


def _kinds(eeproms: Sequence[Eeprom]) -> str:
    return " ".join(map(_kind, eeproms))


def run(simulated: Simulation, printer: Printer) -> int:
    """Simulate until Ctrl-C or another signal; the ports are printed first.

    Errors: `OSError` if there is no such place; that or `UsageError` if the memory cannot be written.
    """
    with handlers_kept(), never_held_up(printer, simulated.view) as out:
        try:
            came = asyncio.run(_run(simulated, printer, out))
        except I7000Error as error:
            raise UsageError(error) from None
    if out.failed:
        return FAILED
    return INTERRUPTED if signal.SIGINT in came else 0


async def _run(simulated: Simulation, printer: Printer, out: Outlet) -> set[int]:
    """Return the signals that ended the simulation."""
    simulator = Simulator(simulated.modules, faults=simulated.faults, seed=simulated.seed, report=printer.error)
    with ended_by_signals(simulator) as came:
        if simulated.memory is not None:
            from i7000.simulator.memory import save  # noqa: PLC0415

            simulator.store = partial(save, simulated.memory)
            simulator.store([module.eeprom for module in simulated.modules])
        for address, protocol in _shared(simulator.bus.modules):
            name = protocol.name.replace("_", " ")
            printer.error(f"several modules have address {address:02X} and speak {name}: their responses collide")
        async with AsyncExitStack() as opened:
            places = await open_places(simulated.places, simulator, opened, pseudo_terminal=simulated.pty)
            for place in places:
                printer.out.out(place, highlight=False)
            printer.out.file.flush()
            control = Control(simulator, module_commands(simulator, simulated.seed))
            if simulated.view == "lines":
                simulator.observe = partial(_show_lines, printer, out)
                simulator.watch = partial(_show_change, printer, out)
            elif simulated.view == "live":
                _show_live(simulator, control, printer, places, opened)
            _record(simulated, simulator, printer, opened)
            if simulated.control == "-":
                follow_input(control, partial(show_answer, printer))
            elif simulated.control is not None:
                await opened.enter_async_context(listening(control, Path(simulated.control)))
            await simulator.run()
    return came


def _show_live(
    simulator: Simulator, control: Control, printer: Printer, places: Sequence[str], opened: AsyncExitStack
) -> None:
    """Show the live view until `opened` is closed, with keys if there is a terminal to press them on."""
    simulator.report = None
    prompt = Prompt(control) if _has_keys() else None
    line = None if prompt is None else prompt.line
    view = View(simulator.modules, printer.out, places, simulator.notices, line)
    opened.enter_context(view)
    simulator.observe, simulator.watch = view.show, view.change
    if prompt is not None:
        prompt.changed = lambda: simulator.loop.run_in_executor(None, view.refresh)
        opened.enter_context(pressed(prompt))


def _record(simulated: Simulation, simulator: Simulator, printer: Printer, opened: AsyncExitStack) -> None:
    """Record what is observed, beside what is shown, until `opened` is closed."""
    write = opened.enter_context(
        recorded(
            simulated.recording,
            program="i7000 simulate",
            target=" ".join(_kind(it.eeprom) for it in simulated.modules),
            began=simulator.began,
            report=printer.error,
        )
    )
    if write is None:
        return

    def carry(observed: Observed) -> None:
        for carried in carried_of(observed):
            write(carried)

    def tell(change: Change) -> None:
        write(Event(change.at, f"{change.address:02X} {change.model.value}: {', '.join(change.what)}"))

    simulator.observe, simulator.watch = both(simulator.observe, carry), both(simulator.watch, tell)


def carried_of(observed: Observed) -> Iterator[Carried]:
    """Yield what an exchange has of a recording: the response is as the module sent it, with the faults of the line."""
    at, protocol, client = observed.at, observed.protocol, observed.client
    wire = observed.heard.wire if isinstance(observed.heard, Noise) else observed.heard
    answer = observed.answer
    yield Carried(at, wire, sent=True, protocol=protocol, place=client, notes=() if answer else observed.faults)
    if answer is not None:
        yield Carried(at, answer, sent=False, protocol=protocol, place=client, notes=observed.faults)


def _has_keys() -> bool:
    """Return whether standard input is a terminal whose keys can be read one by one: not on Windows."""
    return sys.stdin is not None and sys.stdin.isatty() and find_spec("termios") is not None


def _shared(modules: Iterable[State]) -> list[tuple[int, Protocol]]:
    """Return the addresses that several modules of one protocol have."""
    counted = Counter((module.ram.address, module.ram.protocol) for module in modules)
    return [key for key, count in counted.items() if count > 1]


def _show_change(printer: Printer, out: Outlet, change: Change) -> None:
    if not out.skip(1):
        printer.show([change_line(change)])


def _show_lines(printer: Printer, out: Outlet, observed: Observed) -> None:
    """Print the traffic, unless nobody reads the output."""
    if not out.skip(1 if observed.answer is None else 2):
        printer.show(lines(observed))
