"""The module under test, as checks see it: what they send to it, and which of its answers are allowed.

Laws: every method of a check ends, on every line. What the module should not answer is always followed by a sentinel, a
plain read that it answered when the run began: only its answer shows that the module was there and chose to be silent.
"""

from collections.abc import Iterable
from random import Random
from typing import TYPE_CHECKING, Any, TypeVar

from attrs import define, evolve, field

from i7000 import dcon, modbus
from i7000.conformance.allowed import LINE_END, SILENCE
from i7000.conformance.guard import Guard, GuardError, hazards_of
from i7000.conformance.hazard import DEFAULT_ALLOWED, STORED, Hazard
from i7000.conformance.oracle import Answer, Twin, difference, is_exact, rows_of
from i7000.conformance.verdict import Difference, Lost, Skipped, SkipReason
from i7000.frozen import frozen
from i7000.host.procedures import BytesHeard, PowerCycle, Procedure, SendBytes, Tune, Wait
from i7000.message import Query, Response
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import LineSettings, Protocol

if TYPE_CHECKING:
    from i7000.conformance.claims import Claims

__all__ = ["Sentinel", "Subject"]

R = TypeVar("R", bound=Response)

_TURNAROUND = 0.5
"""The longest time in seconds that an answer may take to begin."""
_REFUSAL = 0.15
"""How long a module that should be silent is listened to before the sentinel."""
_MORE_TRIES = 2
_PAUSE = 0.3
"""How often a module that answers no more is looked for, and the pause in seconds before that."""
_QUIET = {Protocol.DCON: 0.02, Protocol.MODBUS_RTU: 0.05}
"""The silence in seconds that ends an answer."""


@frozen
class Sentinel:
    """A plain read that the module answered when the run began: the place of it among those that were tried."""

    protocol: Protocol
    place: int
    right: bytes | None
    """What the twin answered to it then."""
    heard: bytes
    """What the module answered to it then."""


@define
class Subject:
    """A module under test and its twin.

    Shape: `twin` follows every frame that is sent to it, in the order of the steps.
    Time: `timeout_scale` multiplies every time to listen; slow adapters and networks need more than 1.
    """

    twin: Twin
    line: LineSettings = field(factory=LineSettings)
    timeout_scale: float = 1.0
    chance: Random = field(factory=lambda: Random(0))  # noqa: S311 - repeatable
    now: float = 0.0
    """The time of the line at the end of the last step."""
    guard: Guard = field(factory=lambda: Guard(DEFAULT_ALLOWED))
    """What may be sent; the port has a guard of its own."""
    writes_left: int = 64
    """How many frames may still change the EEPROM; those that a module refuses are not counted."""
    claims: "Claims | None" = None
    """The statement of the module, if one was given."""
    answering: bool = False
    """Whether the module answered what was sent last before the check."""
    sound: dict[Query[Any], bool] = field(factory=dict)
    """Whether the reads of settings, at address 01, were answered right before the first change of the run."""

    known: Sentinel | None = None
    """The sentinel of the run; None for the first of the plain reads."""
    remark: str = ""
    """What a check that passes has to say."""
    exchanges: list[tuple[bytes, bytes]] = field(factory=list)
    """What was sent so far, each with what was heard then."""
    last_write: tuple[bytes, bytes] = (b"", b"")
    """The last exchange that may have changed settings; empty before the first."""

    @property
    def protocol(self) -> Protocol:
        """The protocol that the module uses now."""
        return self.twin.state.ram.protocol

    @property
    def address(self) -> int:
        """The address that the module has now."""
        return self.twin.state.ram.address

    @property
    def profile(self) -> Profile:
        """The profile of the module now."""
        return self.twin.state.profile

    @property
    def model(self) -> Model:
        """The model of the module."""
        return self.profile.model

    @property
    def channels(self) -> range:
        """The channels of the module now."""
        return range(self.profile.channels)

    @property
    def enabled(self) -> list[int]:
        """The channels that are on."""
        return [channel for channel in self.channels if self.twin.state.enabled >> channel & 1]

    @property
    def sentinel(self) -> Query[Any]:
        """The read that shows that the module is there."""
        known = self.known
        if known is None or known.protocol is not self.protocol or not known.place:
            of_dcon = self.protocol is Protocol.DCON
            return dcon.ReadModuleName(self.address) if of_dcon else modbus.ReadModuleName(self.address)
        return self._plain_reads()[known.place]

    def _plain_reads(self) -> tuple[Query[Any], ...]:
        address = self.address
        if self.protocol is Protocol.DCON:
            return dcon.ReadModuleName(address), dcon.ReadConfiguration(address), dcon.ReadFirmwareVersion(address)
        rows = [row for row in rows_of(self.profile) if row.name == "module_address"]  # old firmware has none
        own_address = [modbus.ReadHoldingRegisters(address, row.address, row.count) for row in rows]
        return modbus.ReadModuleName(address), *own_address, modbus.ReadInputRegisters(address, 0, 1)

    def find_sentinel(self) -> Procedure[None]:
        """Choose the first of the plain reads that the module answers right; without one it stays the first."""
        for place, query in enumerate(self._plain_reads()):
            wire = self.wire(query)
            answer = self.hear(wire)
            heard = (yield from self.send(wire)).wire
            if heard and difference(answer, heard) is None:
                self.known = Sentinel(self.protocol, place, answer.wire, heard)
                return

    def hear_sentinel(self) -> Answer:
        """Give the twin the sentinel, and return the answer of the module to expect.

        Special: it is what the module answered when the run began, as long as the twin answers the same as then.
        """
        answer, known = self.hear(self.wire(self.sentinel)), self.known
        if known is None or known.protocol is not self.protocol or known.right != answer.wire:
            return answer
        return evolve(answer, wire=known.heard)

    def wire(self, query: Query[Any]) -> bytes:
        """Return the frame of a command or request, even of one that the module does not have."""
        encode: Any = modbus.encode if isinstance(query, modbus.Request) else dcon.encode
        wire: bytes = encode(query, self.profile, force=True)
        return wire

    def seal(self, body: bytes) -> bytes:
        """Return the frame of a body of any content: with its CRC, or for DCON its checksum and carriage return."""
        return (
            modbus.seal(body)
            if self.protocol is Protocol.MODBUS_RTU
            else dcon.seal(body, checksum=self.profile.checksum)
        )

    # --- on the line --------------------------------------------------------------------------------------------------

    def send(self, *pieces: bytes | tuple[float, bytes], seconds: float = _TURNAROUND) -> Procedure[BytesHeard]:
        """Send bytes as they are, and return all that is heard; the twin does not hear them.

        Shape: pieces of a frame follow each other without a pause, or after one of so many seconds.
        """
        parts = tuple(piece if isinstance(piece, tuple) else (0.0, piece) for piece in pieces)
        before = self.guard
        try:
            writes = self._admit_all(parts)
        except GuardError:
            self.guard = before
            if not all(hazards_of(wire, self.line) <= self.guard.allowed | {Hazard.OBSERVE} for _, wire in parts):
                raise
            yield from self.end_line()
            writes = self._admit_all(parts)
        ends = b"\r" if self.protocol is Protocol.DCON else b""
        quiet = _QUIET[self.protocol] * self.timeout_scale
        delay = self.twin.state.response_delay
        heard: BytesHeard = yield SendBytes(parts, seconds * self.timeout_scale + delay, quiet, ends)
        self.now = heard.now
        self.exchanges.append((b"".join(wire for _, wire in parts), heard.wire))
        if writes:
            self.last_write = self.exchanges[-1]
        return heard

    def exchange(self, query: Query[Any] | None = None) -> tuple[bytes, bytes]:
        """Return the last exchange with a command or request, or the last of all: what was sent, and what was heard."""
        wire = None if query is None else self.wire(query)
        found = (one for one in reversed(self.exchanges) if wire in (None, one[0]))
        return next(found, (wire or b"", b""))

    def end_line(self) -> Procedure[None]:
        """End what modules of either protocol may have heard as the beginning of a command or request.

        Special: DCON has no timeout, so that requests by Modbus may add up to a command; a leading character and a
            carriage return end every such line, and no module carries them out.
        """
        yield from self.wait(SILENCE)
        self.guard = self.guard.after_silence()
        if self.protocol is Protocol.MODBUS_RTU:
            self.guard = self.guard.sending(LINE_END, self.line)
            self.now = (yield SendBytes(((0.0, LINE_END),), SILENCE)).now

    def _admit_all(self, parts: Iterable[tuple[float, bytes]]) -> bool:
        admitted = [self._admit(wire) for _, wire in parts]
        return any(admitted)

    def _admit(self, wire: bytes) -> bool:
        """Pass bytes to the guard, and count those with which a module would change its EEPROM.

        Shape: returns whether they may change settings.
        Errors: `GuardError`; `Skipped` if all writes of the run are used up.
        """
        self.guard, hazards = self.guard.judged(wire, self.line)
        if hazards & STORED:
            self._count(self.twin.hear(wire, self.now)[0])
        return bool(hazards & STORED)

    def _count(self, after: Twin) -> None:
        if after.state.eeprom != self.twin.state.eeprom:
            self.reserve(1)
            self.writes_left -= 1

    def reserve(self, writes: int) -> None:
        """Make sure that a change of settings can be made and taken back.

        Errors: `Skipped` if the run has not so many writes left.
        """
        if self.writes_left < writes:
            raise Skipped(SkipReason.BUDGET, "the EEPROM writes of the run are used up")

    def wait(self, seconds: float) -> Procedure[None]:
        """Wait for so many seconds."""
        yield Wait(seconds)
        self.now += seconds

    def tune(self, line: LineSettings) -> Procedure[None]:
        """Change the line settings of the host."""
        yield Tune(line)
        self.line = line

    def power_cycle(self, *, init_switch: bool = False) -> Procedure[None]:
        """Switch the power off and on, that of the twin too; the host takes the line settings of the module then.

        Errors: `Skipped` if the power has to be switched by hand.
        """
        if not (yield PowerCycle(init_switch)):
            raise Skipped(SkipReason.NEEDS_HARDWARE, "the power would have to be switched off and on by hand")
        self.twin = Twin.of(self.twin.state.eeprom, self.now, init_switch=init_switch)
        yield from self.tune(self.twin.state.ram.line_settings)

    # --- what is right ------------------------------------------------------------------------------------------------

    def expect(self, query: Query[R]) -> Procedure[Any]:
        """Send a command or request, and return the response, which is one that the twin allows.

        Special: the value is None for a broadcast, and for a command that the twin does not answer.
        Errors: `Difference`, `Unclear`.
        """
        wire = self.wire(query)
        return (yield from self.expect_frame(wire))

    def expect_frame(self, wire: bytes) -> Procedure[Any]:
        """Send a whole frame, and return the decoded response, which is one that the twin allows."""
        answer = self.hear(wire)
        if answer.wire is None:
            yield from self._silent((wire,))
            return None
        heard = (yield from self.send(wire)).wire
        if not heard:
            yield from self.alive(wire)
        if found := difference(answer, heard):
            raise self.wrong(found, wire, heard, _words(answer.wire), answer.wire if is_exact(answer) else b"")
        return self.decoded(answer, heard)

    def hear(self, wire: bytes) -> Answer:
        """Give the twin a frame that is sent to the module, and return its answer."""
        after, answer = self.twin.hear(wire, self.now)
        self._count(after)
        self.twin = after
        return answer

    def decoded(self, answer: Answer, heard: bytes) -> Any:  # noqa: ANN401 - any response
        """Return the response to the query of an answer; bytes if the twin does not have the query."""
        if answer.query is None:
            return heard
        decode: Any = modbus.decode_response if isinstance(answer.query, modbus.Request) else dcon.decode_response
        return decode(heard, answer.query, answer.profile)

    def expect_one_of(self, wire: bytes, allowed: Iterable[bytes | None]) -> Procedure[bytes | None]:
        """Send a frame that the twin does not hear; return which of the allowed answers came, None for silence.

        Errors: `Difference`, `Unclear`.
        """
        allowed = tuple(allowed)
        heard = (yield from self.send(wire, seconds=_REFUSAL if None in allowed else _TURNAROUND)).wire
        if not heard:
            yield from self.alive(wire)
            if None in allowed:
                return None
        if heard not in allowed:
            expected = " or ".join("silence" if it is None else _words(it) for it in allowed)
            right = allowed[0] if len(allowed) == 1 else None
            raise self.wrong("no answer" if not heard else "another answer", wire, heard, expected, right or b"")
        return heard

    def silent(self, *pieces: bytes | tuple[float, bytes]) -> Procedure[None]:
        """Send bytes that the module must not answer, then the sentinel: only that is answered.

        Special: the twin does not hear the bytes.
        Errors: `Difference`, `Unclear`.
        """
        yield from self._silent(pieces)

    def _silent(self, pieces: Iterable[bytes | tuple[float, bytes]]) -> Procedure[None]:
        parts = tuple(pieces)
        sent = b"".join(piece[1] if isinstance(piece, tuple) else piece for piece in parts)
        heard = (yield from self.send(*parts, seconds=_REFUSAL)).wire
        if heard:
            raise self.wrong(f"answered {len(heard)} bytes", sent, heard, "silence")
        yield from self.alive(sent)

    def alive(self, after: bytes) -> Procedure[None]:
        """Send the sentinel, whose answer must be right: else nothing can be said about the frame before it.

        Errors: `Unclear` if it is not answered; `Difference` for another answer, and if the module answered when the
            check began, and does not answer any more.
        """
        wire = self.wire(self.sentinel)
        answer = self.hear_sentinel()
        heard = (yield from self.send(wire)).wire
        if not heard:
            yield from self._lost(after + wire)
        if difference(answer, heard):
            text = "the next request has another answer"
            expected = f"silence, then {_words(answer.wire or b'')}"
            raise self.wrong(text, after + wire, heard, expected, answer.wire or b"")

    def _lost(self, sent: bytes) -> Procedure[None]:
        """Look for the module again, and raise what its silence means: it answered before the check, if it did."""
        wire = self.wire(self.sentinel)
        for _ in range(_MORE_TRIES):
            yield from self.wait(_PAUSE)
            if not self.answering or (yield from self.send(wire)).wire:
                raise Lost("the module does not answer a plain read after it", sent=sent)
        raise self.wrong("the module does not answer any more", sent, b"", "an answer to a plain read after it")

    def wrong(self, text: str, sent: bytes, received: bytes, expected: str, right: bytes = b"") -> Difference:
        """Return the error of an answer that is not allowed; `right` are the only bytes that are, if there are such."""
        wrote, answered = (b"", b"") if self.last_write[0] in sent else self.last_write
        return Difference(
            text, sent=sent, received=received, expected=expected, right=right, wrote=wrote, answered=answered
        )

    # --- the frames of refusal ----------------------------------------------------------------------------------------

    @property
    def refused(self) -> bytes:
        """The frame of a refusal by DCON: ``?AA``."""
        return dcon.encode(dcon.Refused(self.address), self.profile)

    def exception(self, function: int, code: int) -> bytes:
        """Return the frame of an exception by Modbus."""
        return modbus.seal(bytes((self.address, function | 0x80, code)))


def _words(wire: bytes) -> str:
    """Return a frame for people: as text if it is one."""
    try:
        text = wire.decode("ascii")
    except UnicodeDecodeError:
        return wire.hex(" ")
    return text.removesuffix("\r") if text.removesuffix("\r").isprintable() else wire.hex(" ")
