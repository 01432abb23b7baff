"""A proxy at the terminal: how it runs and how it ends."""

import asyncio
import signal
from contextlib import AsyncExitStack
from functools import partial
from pathlib import Path
from time import time

from attrs import frozen
from rich.text import Text

from i7000.cli.control import Control, follow_input, listening
from i7000.cli.outlet import Outlet
from i7000.cli.port import opened as opened_port
from i7000.cli.recorded import RecordOptions, both, recorded
from i7000.cli.serving import Place, ended_by_signals, handlers_kept, never_held_up, open_places, show_answer
from i7000.cli.text import Printer, escaped
from i7000.cli.words import LineError
from i7000.device import Uart
from i7000.link import LinkError, Port
from i7000.recording.records import Carried
from i7000.settings import LineSettings
from i7000.simulator.faults import Faults
from i7000.simulator.proxy import Proxy
from i7000.simulator.target import Target
from i7000_cli import FAILED, INTERRUPTED

__all__ = ["Proxied", "carried_line", "run"]


@frozen
class Proxied:
    """What a proxy does, and the ports to it."""

    target: str
    line: LineSettings
    faults: Faults
    seed: int
    pty: bool
    places: tuple[Place, ...]
    view: str
    control: str | None
    """Where commands come from: ``-`` is standard input, else the path of a socket; None is nowhere."""
    recording: RecordOptions


def run(proxied: Proxied, printer: Printer) -> int:
    """Serve hosts until a signal or ``quit``; the ports are printed first.

    Errors: `OSError` or `UsageError` if a port cannot be opened; `LineError` if the target cannot, or is lost.
    """
    with (
        opened_port(proxied.target, proxied.line) as port,
        handlers_kept(),
        never_held_up(printer, proxied.view) as out,
    ):
        try:
            came = asyncio.run(_run(proxied, port, printer, out))
        except LinkError as error:
            raise LineError(error) from None
    if out.failed:
        return FAILED
    return INTERRUPTED if signal.SIGINT in came else 0


async def _run(proxied: Proxied, port: Port, printer: Printer, out: Outlet) -> set[int]:
    """Return the signals that ended the proxy."""
    async with AsyncExitStack() as opened:
        target = Target(port)
        opened.push_async_callback(target.close)
        proxy = Proxy(
            target.write,
            target.tune,
            uart=Uart.of(proxied.line),
            faults=proxied.faults,
            seed=proxied.seed,
            report=printer.error,
        )
        show = partial(_show, printer, out) if proxied.view == "lines" else None
        write = opened.enter_context(
            recorded(
                proxied.recording, program="i7000 proxy", target=proxied.target, began=time(), report=printer.error
            )
        )
        proxy.observe = both(show, write)
        came = opened.enter_context(ended_by_signals(proxy))
        places = await open_places(proxied.places, proxy, opened, pseudo_terminal=proxied.pty)
        for place in places:
            printer.out.out(place, highlight=False)
        printer.out.file.flush()
        control = Control(proxy)
        if proxied.control == "-":
            follow_input(control, partial(show_answer, printer))
        elif proxied.control is not None:
            await opened.enter_async_context(listening(control, Path(proxied.control)))
        target.start(proxy.receive, proxy.fail)
        await proxy.run()
    return came


def _show(printer: Printer, out: Outlet, carried: Carried) -> None:
    """Print what arrived on a side, unless nobody reads the output."""
    if not out.skip(1):
        printer.show([carried_line(carried)])


def carried_line(carried: Carried) -> Text:
    """Return the line of bytes that arrived: DCON as text, other bytes in hex."""
    line = Text(f"{carried.seconds:10.3f}  ").append("-> " if carried.sent else "<- ", "blue")
    line.append(_wire_words(carried.wire), "bold")
    if carried.notes:
        line.append(f"  [{escaped(', '.join(carried.notes))}]", "magenta")
    return line


def _wire_words(wire: bytes) -> str:
    text = wire.removesuffix(b"\r").decode("latin-1")
    is_text = wire.endswith(b"\r") and text.isascii() and text.replace("\r", "").isprintable()
    return escaped(text) if is_text else wire.hex(" ").upper()
