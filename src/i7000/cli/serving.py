"""A program that serves hosts until it is ended: its places, its output, and the signals that end it.

Laws: output that nobody reads holds up nothing. What only some options need is imported when one of them is used.
"""

import asyncio
import logging
import signal
from collections.abc import Iterable, Iterator
from contextlib import AsyncExitStack, contextmanager, redirect_stderr, suppress
from ipaddress import IPv6Address
from typing import IO, Any, Protocol, cast

from attrs import frozen

from i7000.cli.outlet import Outlet, shown_by
from i7000.cli.text import Printer
from i7000.cli.words import UsageError
from i7000.simulator.served import Served
from i7000.simulator.tcp import LOOPBACK, Connection, listen

__all__ = [
    "Place", "ended_by_signals", "handlers_kept", "never_held_up", "open_places", "read_place", "show_answer",
]  # fmt: skip


class Ending(Protocol):
    """What can be ended."""

    def end(self) -> None:
        """End it."""


# --- places -----------------------------------------------------------------------------------------------------------


@frozen
class Place:
    """A place on the network to listen at."""

    scheme: str
    """``socket`` or ``rfc2217``, as in the URLs of pyserial."""
    host: str
    port: int


def read_place(scheme: str, text: str) -> Place:
    """Read ``[HOST:]PORT``; without a host, only this machine can connect.

    Errors: `UsageError`.

    >>> read_place("socket", "5020"), read_place("rfc2217", "[::1]:0").host
    (Place(scheme='socket', host='127.0.0.1', port=5020), '::1')
    """
    host, _, port = text.rpartition(":")
    if not (port.isascii() and port.isdecimal() and len(port) <= 5 and int(port) <= 0xFFFF):
        raise UsageError(f"{text!r} is not [HOST:]PORT: a port is 0..65535; 0 takes any free one")
    return Place(scheme, _host(host, text) or LOOPBACK, int(port))


def _host(host: str, text: str) -> str:
    """Return a host without the brackets that an address of IPv6 has, which has colons."""
    if host.startswith("[") and host.endswith("]"):
        with suppress(ValueError):
            IPv6Address(host[1:-1])
            return host[1:-1]
    elif not set(host) & set("[]:"):
        return host
    raise UsageError(f"{text!r} is not [HOST:]PORT: write an IPv6 address in brackets, such as [::1]:5020")


async def open_places(
    places: Iterable[Place], line: Served, opened: AsyncExitStack, *, pseudo_terminal: bool
) -> list[str]:
    """Open all ports of a line, and return their names."""
    found = []
    if pseudo_terminal:
        try:
            from i7000.simulator.pseudo_terminal import open_pty  # noqa: PLC0415 - POSIX only
        except ModuleNotFoundError:
            raise UsageError("this system has no pseudo-terminals: give --tcp or --rfc2217") from None

        found.append(await opened.enter_async_context(open_pty(line)))
    for place in places:
        connection = Connection
        if place.scheme == "rfc2217":
            from i7000.simulator.rfc2217 import Rfc2217Connection  # noqa: PLC0415

            connection = Rfc2217Connection
        listening = listen(line, place.host, place.port, connection=connection)
        found.append(f"{place.scheme}://{await opened.enter_async_context(listening)}")
    return found


# --- output and end ---------------------------------------------------------------------------------------------------


_ENDING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
"""The signals that end a simulation: Ctrl-C, and those that come when it is terminated or its terminal hangs up."""


@contextmanager
def handlers_kept() -> Iterator[None]:
    """Put back what handled the signals before."""
    handlers = {number: signal.getsignal(number) for number in _ENDING}
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


@contextmanager
def never_held_up(printer: Printer, view: str) -> Iterator[Outlet]:
    """Print so that the program goes on, and ends, even if nobody reads what is printed; the value is the output."""
    limits: dict[str, Any] = {"most": 0, "counted": False} if view == "live" else {}
    err = Outlet(printer.err.file)
    complaints = logging.StreamHandler(err)
    logging.getLogger("asyncio").addHandler(complaints)
    with redirect_stderr(cast(IO[str], err)):
        try:
            with shown_by(printer, says_missed=view == "lines", **limits) as out:
                yield out
        finally:
            logging.getLogger("asyncio").removeHandler(complaints)
            err.close()


@contextmanager
def ended_by_signals(line: Ending) -> Iterator[set[int]]:
    """End a line at a signal; once it has ended, ignore others, so that what was shown can still be written.

    Special: the value has the signals that came.
    """
    came: set[int] = set()

    def end(number: int) -> None:
        came.add(number)
        line.end()

    loop = asyncio.get_running_loop()
    hung_up = getattr(signal, "SIGHUP", None)
    numbers = [it for it in _ENDING if it != hung_up or signal.getsignal(it) is not signal.SIG_IGN]  # as nohup has it
    try:
        for number in numbers:
            loop.add_signal_handler(number, end, number)
    except NotImplementedError:  # pragma: no cover - Windows: Ctrl-C is an exception there; tested in its own process
        signal.signal(signal.SIGINT, signal.default_int_handler)
        numbers = []
    try:
        yield came
    finally:
        for number in numbers:
            loop.remove_signal_handler(number)
            signal.signal(number, signal.SIG_IGN)


def show_answer(printer: Printer, answer: str) -> None:
    """Print the answer to a command of standard input."""
    printer.out.out(answer, highlight=False)
    printer.out.file.flush()
