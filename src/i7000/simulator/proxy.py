"""A proxy of a real line: hosts talk to its modules through the faults of `i7000.simulator.faults`.

Laws: without faults every byte passes unchanged, in order. An answer is what the target sends until it is a complete
frame, or until the line is silent; it goes to the host that asked last. Memory is limited, as in the simulator.
"""

import asyncio
from collections import Counter
from collections.abc import Callable
from random import Random
from time import monotonic

from i7000 import dcon, modbus
from i7000.device import Uart
from i7000.errors import DecodeError
from i7000.recording.records import Carried
from i7000.settings import Protocol
from i7000.simulator.deliveries import Deliveries
from i7000.simulator.faults import Exchange, Faults

__all__ = ["UNSENT", "Proxy", "ProxyHost"]

UNSENT = "a request was lost: the target does not take it"
"""The text of a notice."""
_SILENCE = 0.05
"""The silence in seconds that ends an answer, or a request that is not a frame: longer than USB adapters pause."""
_PATIENCE = 1.0
"""The seconds that a host which sends nothing more waits for its answer."""
_MOST = max(dcon.LONGEST_FRAME, modbus.LONGEST_FRAME)
_COMMANDS = b"#$%~@^"
"""The first characters of DCON commands."""


class Proxy:
    """The line between hosts and a target."""

    def __init__(  # noqa: PLR0913 - most are options
        self,
        write: Callable[[bytes], bool],
        tune: Callable[[Uart], bool],
        *,
        uart: Uart,
        faults: Faults | None = None,
        seed: int = 0,
        observe: Callable[[Carried], None] | None = None,
        report: Callable[[str], None] | None = None,
    ) -> None:
        """Make one without hosts.

        Shape: `write` and `tune` are called with bytes and line settings for the target, and return False if it does
            not take them; `observe` with all that arrives on either side; `report` with each new notice.
        """
        self.write = write
        self.tune = tune
        self.uart = uart
        self.faults = faults or Faults()
        self.chance = Random(seed)  # noqa: S311 - repeatable
        self.observe = observe
        self.report = report
        self.notices: Counter[str] = Counter()
        self.loop = asyncio.get_running_loop()
        self._ended: asyncio.Future[None] = self.loop.create_future()
        self._began = monotonic()
        self._asking: ProxyHost | None = None

    def host(self, name: str, write: Callable[[bytes], None]) -> "ProxyHost":
        """Connect a host; `write` is called with the bytes that it receives."""
        return ProxyHost(self, name, write)

    def receive(self, data: bytes) -> None:
        """Process bytes of the target: they are for the host that asked last."""
        if self._asking is None:
            self.carried(data, "", ("nobody has asked",), sent=False)
        else:
            self._asking.answered(data)

    def asks(self, host: "ProxyHost") -> None:
        """Make a host the one that the target answers."""
        if self._asking not in (None, host):
            self._asking.end_answer()
        self._asking = host

    def forget(self, host: "ProxyHost") -> None:
        """Disconnect a host."""
        if self._asking is host:
            self._asking = None

    def carried(self, wire: bytes, place: str, faults: tuple[str, ...], *, sent: bool) -> None:
        """Report bytes that arrived to the observer of the line."""
        if self.observe:
            self.observe(Carried(monotonic() - self._began, wire, sent, None, place or None, faults))

    def notice(self, text: str) -> None:
        """Count a notice, and report it the first time."""
        self.notices[text] += 1
        if self.report and self.notices[text] == 1:
            self.report(text)

    async def run(self) -> None:
        """Wait until `end` or `fail` is called.

        Errors: the error of `fail`.
        """
        await self._ended

    def end(self) -> None:
        """Make `run` return."""
        if not self._ended.done():
            self._ended.set_result(None)

    def fail(self, error: Exception) -> None:
        """Make `run` raise an error."""
        if not self._ended.done():
            self._ended.set_exception(error)


class ProxyHost:
    """The end of the line of one host."""

    def __init__(self, proxy: Proxy, name: str, write: Callable[[bytes], None]) -> None:
        """Connect a host to a proxy."""
        self.proxy = proxy
        self.name = name
        self._write = write
        self._deliveries = Deliveries(write, proxy.notice)
        self._request, self._last_request, self._earlier, self._last_answer = b"", b"", b"", b""
        self._heard_at = 0.0
        self._answered = True
        self._answer = b""
        self._silence: asyncio.TimerHandle | None = None
        self._finishing: asyncio.TimerHandle | None = None

    @property
    def uart(self) -> Uart | None:
        """The line settings of the target; those that a host sets are set there."""
        return self.proxy.uart

    @uart.setter
    def uart(self, uart: Uart) -> None:
        if uart != self.proxy.uart:
            self.proxy.uart = uart
            if not self.proxy.tune(uart):
                self.proxy.notice(UNSENT)

    def receive(self, data: bytes) -> None:
        """Send the bytes of the host to the target."""
        proxy, now = self.proxy, self.proxy.loop.time()
        proxy.asks(self)
        if proxy.faults.echo:
            self._write(data)
        if self._answer:
            self.end_answer()
        if self._answered or now - self._heard_at > _SILENCE:
            self._request = b""
        self._answered, self._heard_at = False, now
        self._request = (self._request + data)[-_MOST:]
        carried, faults = proxy.faults.requests.carried(data, proxy.chance)
        if carried and not proxy.write(carried):
            proxy.notice(UNSENT)
            faults = (*faults, UNSENT)
        proxy.carried(carried, self.name, faults, sent=True)

    def answered(self, data: bytes) -> None:
        """Process bytes of the target, and deliver the answers that are complete."""
        self._stop_waiting()
        self._answer += data
        if _protocol(self._request) is Protocol.DCON:
            *frames, self._answer = self._answer.split(b"\r")
            for frame in frames:
                self._deliver(frame + b"\r")
        if len(self._answer) > _MOST or _is_rtu(self._answer):
            self.end_answer()
        if self._answer:
            self._silence = self.proxy.loop.call_later(_SILENCE, self.end_answer)

    def end_answer(self) -> None:
        """Deliver what the target has sent so far: nothing more belongs to it."""
        self._stop_waiting()
        answer, self._answer = self._answer, b""
        if answer:
            self._deliver(answer)

    def finish(self, finished: Callable[[], None]) -> None:
        """Call `finished` once the answer to the last request had its time, and no response is delayed."""

        def look() -> None:
            if self._deliveries or self._answer:
                self._finishing = self.proxy.loop.call_later(_SILENCE, look)
            else:
                finished()

        self._finishing = self.proxy.loop.call_later(_PATIENCE, look)

    def close(self) -> None:
        """Disconnect the host: it receives nothing more."""
        self._stop_waiting()
        if self._finishing:
            self._finishing.cancel()
        self._deliveries.close()
        self.proxy.forget(self)

    def _stop_waiting(self) -> None:
        if self._silence:
            self._silence.cancel()
            self._silence = None

    def _deliver(self, answer: bytes) -> None:
        proxy = self.proxy
        self._answered = True
        exchange = self._exchange(answer)
        faults = proxy.faults.answers(None if exchange is None else exchange.address)
        transfer = faults.delivered(answer, proxy.uart.character_time, proxy.chance, exchange)
        sent = self._deliveries.send(transfer)
        proxy.carried(b"".join(piece.wire for piece in transfer.pieces), self.name, sent.faults, sent=False)

    def _exchange(self, answer: bytes) -> Exchange | None:
        """Return the exchange of an answer, and remember the answer; None if the request is not a frame."""
        protocol = _protocol(self._request)
        if protocol is None:
            return None
        request = self._request
        if protocol is Protocol.DCON:
            request = request[:-1].rpartition(b"\r")[2] + b"\r"
        if request != self._last_request:
            self._last_request, self._earlier = request, self._last_answer
        self._last_answer = answer
        checksum = protocol is Protocol.DCON and _has_checksum(request) and _has_checksum(answer)
        return Exchange(request, protocol, checksum, self._earlier or None)


def _protocol(request: bytes) -> Protocol | None:
    """Return the protocol of the last frame of a host; None if it is not a frame."""
    if _is_rtu(request):
        return Protocol.MODBUS_RTU
    last = request[:-1].rpartition(b"\r")[2]
    return Protocol.DCON if request.endswith(b"\r") and last[:1] in _LEADS else None


_LEADS = {bytes((lead,)) for lead in _COMMANDS}


def _is_rtu(wire: bytes) -> bool:
    return 4 <= len(wire) <= modbus.LONGEST_FRAME and not modbus.crc16(wire)


def _has_checksum(frame: bytes) -> bool:
    try:
        dcon.unseal(frame, checksum=True)
    except DecodeError:
        return False
    return True
