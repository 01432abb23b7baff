"""A run once more: the frames of a report sent again, and their answers compared with those of the report.

Laws: all frames have the pauses of the report, because some answers depend on the time, such as those after soft INIT.
What a module measures may differ, and nothing else: the request decides whether that is what was asked for.
"""

import re
from collections.abc import Sequence
from itertools import pairwise

from i7000 import dcon, modbus
from i7000.conformance.report import Change, Checked, Frame, Report, ReportError
from i7000.errors import DecodeError
from i7000.frozen import frozen
from i7000.host.procedures import BytesHeard, PowerCycle, Procedure, SendBytes, Tell, Tune
from i7000.host.procedures.values import PROTOCOLS
from i7000.modbus import Area, RegisterMap
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import BaudRate, LineSettings, Protocol

__all__ = ["Readings", "Replayed", "replay"]

_LISTEN = 0.5
_QUIET = 0.05
_BITS = 10
"""The bits of a character on the line, at least."""
_LONGEST_PAUSE = 60.0
_READS = re.compile(rb"#[0-9A-F]{2}[0-9A-F]?|\$[0-9A-F]{2}[A34]")
"""The DCON commands that read what is measured: ``#AA``, ``#AAN``, ``$AAA``, ``$AA4`` and ``$AA3``."""
_SYNCHRONIZED = b"4"
_NUMBERS = bytes.maketrans(b"123456789ABCDEF.-", b"0000000000000000+")
"""What makes all digits and points of a reading alike, and all signs."""
_ROWS = frozenset({"analog_input", "temperature", "cjc_temperature"})
"""The rows of the address maps that have what is measured."""
_AREAS = {3: Area.HOLDING_REGISTER, 4: Area.INPUT_REGISTER}
_REQUEST = 8
"""The bytes of a request to read registers."""
_HEAD = 3
"""The bytes before the values: of Modbus the unit, the function and the byte count, of ``$AA4`` ``>AA``."""


@frozen
class Replayed:
    """What came of a check of a report, sent again.

    Shape: `sent` are the frames of one exchange, `recorded` and `received` what was heard then and now. `is_same` is
        whether the module answered as in the report, apart from the values of readings.
    """

    check: str
    sent: tuple[bytes, ...]
    recorded: bytes
    received: bytes
    is_same: bool


def replay(report: Report, *, timeout_scale: float = 1.0) -> Procedure[tuple[Replayed, ...]]:
    """Make the procedure that sends the frames of a report again, check by check; it tells each `Replayed`.

    Special: where the line settings of the host or the power changed, they change again.
    Errors: `ReportError` if the port cannot switch the power.
    """
    dcon_ends = b"" if _protocol(report) is Protocol.MODBUS_RTU else b"\r"
    line, readings = report.line, Readings.of(report)
    listen, quiet = _LISTEN * timeout_scale, _QUIET * timeout_scale
    results = []
    free: float | None = None
    for check in report.checks:
        for change, sent, answer in _exchanges(check.traffic):
            if change is not None:
                line = yield from _changed(check, change, line)
                free = change.seconds
            if not sent:
                continue
            pause = 0.0 if free is None else sent[0].seconds - free
            heard: BytesHeard = yield SendBytes(_pieces(sent, line, pause), listen, quiet, dcon_ends)
            free = sent[-1].seconds + listen if answer is None else answer.seconds + quiet
            recorded = b"" if answer is None else answer.wire
            wires = tuple(frame.wire for frame in sent)
            same = recorded == heard.wire or readings.are_alike(b"".join(wires), recorded, heard.wire)
            result = Replayed(check.id, wires, recorded, heard.wire, same)
            yield Tell(result)
            results.append(result)
    return tuple(results)


def _protocol(report: Report) -> Protocol:
    return PROTOCOLS.get(str(report.module.get("protocol")), Protocol.DCON)


def _changed(check: Checked, change: Change, line: LineSettings) -> Procedure[LineSettings]:
    """Change what a run changed, and return the line settings from then on."""
    if change.line is not None:
        yield Tune(change.line)
        return change.line
    if not (yield PowerCycle(change.init_switch)):
        what = f"{check.id}, {change.seconds:.3f} s after the start"
        raise ReportError(f"{what}: the power was switched off and on then, and this port cannot do that")
    return line


def _pieces(sent: Sequence[Frame], line: LineSettings, pause: float) -> tuple[tuple[float, bytes], ...]:
    """Return frames, each with the pause before it, which is over when the last one is sent; `pause` is the first."""
    character = _BITS / BaudRate(line.baud_rate).bits_per_second
    pieces = [(_bounded(pause), sent[0].wire)]
    for before, frame in pairwise(sent):
        pause = frame.seconds - before.seconds - len(before.wire) * character
        pieces.append((_bounded(pause), frame.wire))
    return tuple(pieces)


def _bounded(pause: float) -> float:
    return min(max(0.0, pause), _LONGEST_PAUSE)


def _exchanges(traffic: Sequence[Frame | Change]) -> list[tuple[Change | None, tuple[Frame, ...], Frame | None]]:
    """Return what was sent until something was heard or changed, with what was heard, and the change before it."""
    found: list[tuple[Change | None, tuple[Frame, ...], Frame | None]] = []
    sent: list[Frame] = []
    change: Change | None = None
    for it in (*traffic, None):
        if isinstance(it, Frame) and it.sent:
            sent.append(it)
        elif sent:
            found.append((change, tuple(sent), it if isinstance(it, Frame) else None))
            sent, change = [], None
        if isinstance(it, Change):
            if change is not None:
                found.append((change, (), None))
            change = it
    return found if change is None else [*found, (change, (), None)]


@frozen
class Readings:
    """What a module measures, in its answers.

    Shape: `checksum` is whether DCON frames have one; `registers` are the areas and addresses of what is measured.
    """

    protocol: Protocol
    checksum: bool
    registers: frozenset[tuple[Area, int]]

    @classmethod
    def of(cls, report: Report) -> "Readings":
        """Return what the module of a report measures; nothing by Modbus for an unknown model."""
        module = report.module
        protocol = _protocol(report)
        model = next((it for it in Model if it.value == module.get("model")), None)
        rows = (
            RegisterMap(Profile(model, type_codes=())) if protocol is Protocol.MODBUS_RTU and model is not None else ()
        )
        places = {(row.area, row.address + at) for row in rows if row.name in _ROWS for at in range(row.count)}
        return cls(protocol, module.get("checksum") is True, frozenset(places))

    def are_alike(self, sent: bytes, one: bytes, other: bytes) -> bool:
        """Return whether two answers to a read of what is measured differ in the values only.

        Shape: `sent` is everything since the last answer; what was sent last is the request.
        """
        try:
            if self.protocol is Protocol.MODBUS_RTU:
                return self._registers_alike(sent, one, other)
            return self._texts_alike(sent, one, other)
        except DecodeError:
            return False

    def _registers_alike(self, sent: bytes, one: bytes, other: bytes) -> bool:
        request = modbus.unseal(sent[-_REQUEST:])
        area = _AREAS.get(request[1])
        first, count = int.from_bytes(request[2:4], "big"), int.from_bytes(request[4:6], "big")
        if area is None or not all((area, first + at) in self.registers for at in range(count)):
            return False
        right = bytes((*request[:2], 2 * count))
        return all(
            len(body) == _HEAD + 2 * count and body[:_HEAD] == right for body in map(modbus.unseal, (one, other))
        )

    def _texts_alike(self, sent: bytes, one: bytes, other: bytes) -> bool:
        line = sent.removesuffix(b"\r").rpartition(b"\r")[2]
        start = max(map(line.rfind, (b"#", b"$", b"%", b"~", b"@", b"^")), default=0)
        command = dcon.unseal(line[max(start, 0) :] + b"\r", checksum=self.checksum)
        if _READS.fullmatch(command) is None or not sent.endswith(b"\r"):
            return False
        answers = [dcon.unseal(answer, checksum=self.checksum, leads=b">") for answer in (one, other)]
        head = _HEAD if command[:1] == b"$" and command[3:] == _SYNCHRONIZED else 1
        first, second = (answer[:head] + answer[head:].translate(_NUMBERS) for answer in answers)
        return first == second
