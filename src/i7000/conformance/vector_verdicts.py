"""What an implementation answers to cases of vectors, read and judged; the messages of the protocol for that.

An implementation and the kit speak JSON, one object a line: `start`, `run` and `stop` are the requests, and every
answer repeats the `seq` of its request.

Laws: an answer is compared by value: 1 and 1.0 are equal, 1 and true are not; bytes in hex have no case. `MessageError`
is the only error, whatever the bytes.
"""

import json
from collections.abc import Iterable, Sequence
from enum import Enum
from math import isclose
from typing import Any

from attrs import field

from i7000.conformance.vectors import OPERATIONS, Case, Record
from i7000.errors import I7000Error
from i7000.frozen import frozen

__all__ = [
    "LONGEST_LINE",
    "PROTOCOL",
    "Implementation",
    "Judged",
    "MessageError",
    "Reason",
    "Verdict",
    "difference",
    "error",
    "judged",
    "read_answer",
    "read_started",
    "run_message",
    "skipped",
    "start_message",
    "stop_message",
    "verdict_of",
]

PROTOCOL = 1
"""The version of the protocol."""
LONGEST_LINE = 1 << 16
"""The bytes that a line of an implementation may have, its end included."""


class Verdict(Enum):
    """What came of a case or a vector."""

    PASS = "PASS"  # noqa: S105 - not a password
    FAIL = "FAIL"
    """The implementation answered, and the answer is wrong."""
    SKIP = "SKIP"
    ERROR = "ERROR"
    """There is no answer that could be judged."""


class Reason(Enum):
    """Why a case was skipped, or ended in an error."""

    NOT_IMPLEMENTED = "not-implemented"
    """The implementation does not have the operation, or not for this case."""
    MAX_FAILURES = "max-failures"
    """The run had ended before."""
    DIED = "died"
    TIMEOUT = "timeout"
    NOT_JSON = "not-json"
    """A line that is not one JSON object in UTF-8."""
    BAD_MESSAGE = "bad-message"
    """An object that is not an answer of the protocol."""
    WRONG_SEQUENCE = "wrong-sequence"
    """The answer to another request than the oldest that is open."""
    TOO_LONG = "too-long"
    """A line of more than `LONGEST_LINE` bytes."""
    CRASHED = "crashed"
    """The wrapper reports that the implementation failed in an unforeseen way."""
    NOT_RUN = "not-run"
    """The implementation could not be started again, or failed too often."""


class MessageError(I7000Error):
    """No message, or one that is invalid; `reason` and `text` are for people and reports."""

    def __init__(self, reason: Reason, text: str) -> None:
        super().__init__(reason, text)
        self.reason = reason
        self.text = text

    def __str__(self) -> str:
        return f"{self.reason.value}: {self.text}"


@frozen
class Implementation:
    """What an implementation says about itself."""

    name: str
    version: str
    language: str
    operations: frozenset[str]


@frozen
class Judged:
    """A case with its verdict."""

    case: Case
    verdict: Verdict
    reason: Reason | None = None
    """Of a skip or an error."""
    text: str = ""
    """What is wrong."""
    answer: Record | None = field(default=None, kw_only=True)
    """What the implementation answered."""
    stderr: str = field(default="", kw_only=True)
    """The end of its standard error, if it failed."""


# --- messages ---------------------------------------------------------------------------------------------------------


def start_message(seq: int) -> bytes:
    """Return the line that begins a run."""
    return _line({"cmd": "start", "seq": seq, "protocol": PROTOCOL})


def run_message(seq: int, case: Case) -> bytes:
    """Return the line with a case."""
    return _line({"cmd": "run", "seq": seq, "case": case.record})


def stop_message(seq: int) -> bytes:
    """Return the line after which the implementation ends."""
    return _line({"cmd": "stop", "seq": seq})


def _line(message: Record) -> bytes:
    return json.dumps(message, separators=(",", ":")).encode() + b"\n"


def read_started(line: bytes, seq: int) -> Implementation:
    """Read the answer to a start.

    Errors: `MessageError`, also for another version of the protocol and for operations that do not exist.
    """
    message = _read(line, seq)
    _check_keys(message, ("seq", "protocol", "implementation", "operations"))
    if message["protocol"] != PROTOCOL or isinstance(message["protocol"], bool):
        raise _bad(f"protocol {_shown(message['protocol'])}: this is protocol {PROTOCOL}")
    facts, operations = message["implementation"], message["operations"]
    if not isinstance(facts, dict):
        raise _bad(f"implementation is not an object: {_shown(facts)}")
    _check_keys(facts, ("name", "version", "language"))
    for key, value in facts.items():
        if not isinstance(value, str) or not value:
            raise _bad(f"{key} of the implementation is not a text: {_shown(value)}")
    if not isinstance(operations, list):
        raise _bad(f"operations is not an array: {_shown(operations)}")
    unknown = [it for it in operations if not isinstance(it, str) or it not in OPERATIONS]
    if unknown:
        raise _bad(f"there is no operation {_shown(unknown[0])}: {', '.join(OPERATIONS)}")
    return Implementation(facts["name"], facts["version"], facts["language"], frozenset(operations))


def read_answer(line: bytes, seq: int) -> Record:
    """Read the answer to a case: an object with one key, and its value.

    Errors: `MessageError`.
    """
    message = _read(line, seq)
    del message["seq"]
    if len(message) != 1 or not _ANSWERS.issuperset(message):
        raise _bad(f"beside seq, exactly one of {', '.join(sorted(_ANSWERS))}, not {_shown(sorted(message))}")
    ((kind, value),) = message.items()
    if kind in _TEXTS and not isinstance(value, str):
        raise _bad(f"{kind} is not a text: {_shown(value)}")
    if kind not in _TEXTS and not isinstance(value, dict):
        raise _bad(f"{kind} is not an object: {_shown(value)}")
    if kind == "error":
        _check_keys(value, ("fault",), ("message",))
        for key, text in value.items():
            if not isinstance(text, str) and (key, text) != ("fault", None):
                raise _bad(f"{key} of the error is not a text: {_shown(text)}")
    return message


_TEXTS = frozenset({"skipped", "crashed"})
_ANSWERS = _TEXTS | {"result", "error"}


def _read(line: bytes, seq: int) -> dict[str, Any]:
    """Read an object, and check that it answers a request."""
    try:
        message = json.loads(line.decode(), object_pairs_hook=_unique, parse_constant=_no_constant)
    except (ValueError, RecursionError) as error:
        what = f"more than {_DEEPEST} levels" if isinstance(error, RecursionError) else error
        raise MessageError(Reason.NOT_JSON, f"{_bytes_shown(line)}: {what}") from None
    if not isinstance(message, dict):
        raise MessageError(Reason.NOT_JSON, f"{_bytes_shown(line)} is not an object")
    if _is_deep(message):
        raise MessageError(Reason.NOT_JSON, f"{_bytes_shown(line)}: more than {_DEEPEST} levels")
    if type(message.get("seq")) is not int:
        raise _bad(f"seq is missing or not an integer: {_bytes_shown(line)}")
    if message["seq"] != seq:
        raise MessageError(Reason.WRONG_SEQUENCE, f"seq {_shown(message['seq'])} instead of {seq}")
    return message


_DEEPEST = 32
"""Levels of arrays and objects in a message."""


def _is_deep(message: object) -> bool:
    level: list[Any] = [message]
    for _ in range(_DEEPEST):
        inner = [it.values() if isinstance(it, dict) else it for it in level if isinstance(it, dict | list)]
        level = [value for values in inner for value in values]
    return any(isinstance(it, dict | list) for it in level)


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise ValueError("an object with the same key twice")
    return found


def _no_constant(name: str) -> None:
    raise ValueError(f"{name} is not JSON")


def _check_keys(found: Record, required: tuple[str, ...], optional: tuple[str, ...] = ()) -> None:
    missing = [key for key in required if key not in found]
    if missing:
        raise _bad(f"{missing[0]} is missing; the keys are {', '.join((*required, *optional))}")
    unknown = [key for key in found if key not in required and key not in optional]
    if unknown:
        raise _bad(f"unknown key {_shown(unknown[0])}; the keys are {', '.join((*required, *optional))}")


def _bad(text: str) -> MessageError:
    return MessageError(Reason.BAD_MESSAGE, text)


_MOST_SHOWN = 160


def _shown(value: object) -> str:
    """Return a value as short JSON."""
    text = json.dumps(value)
    return text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}..."


def _bytes_shown(line: bytes) -> str:
    return _shown(line[: _MOST_SHOWN + 1].decode("utf-8", "backslashreplace"))


# --- verdicts ---------------------------------------------------------------------------------------------------------


def skipped(case: Case, reason: Reason) -> Judged:
    """Return a case that was not run, with the reason."""
    return Judged(case, Verdict.SKIP, reason)


def error(case: Case, found: MessageError, stderr: str = "") -> Judged:
    """Return a case without an answer."""
    return Judged(case, Verdict.ERROR, found.reason, found.text, stderr=stderr)


def judged(case: Case, answer: Record) -> Judged:
    """Judge the answer to a case."""
    if "skipped" in answer:
        return Judged(case, Verdict.SKIP, Reason.NOT_IMPLEMENTED, answer["skipped"], answer=answer)
    if "crashed" in answer:
        return Judged(case, Verdict.ERROR, Reason.CRASHED, answer["crashed"], answer=answer)
    text = _error_fault(case, answer["error"]) if "error" in answer else _result_fault(case, answer["result"])
    return Judged(case, Verdict.FAIL if text else Verdict.PASS, None, text, answer=answer)


def _error_fault(case: Case, found: Record) -> str:
    """Return what is wrong with an error."""
    expected = case.expected
    if expected.may_fail or (expected.result is None and expected.fault is None):
        return ""
    if expected.result is not None:
        return f"an error ({found.get('message') or found['fault']}) instead of a result"
    return "" if expected.fault == found["fault"] else f"fault: {_shown(found['fault'])} instead of {expected.fault}"


def _result_fault(case: Case, found: Record) -> str:
    """Return what is wrong with a result."""
    wanted = case.expected.result
    if wanted is None:
        fault = case.expected.fault
        return f"a result instead of an error{f' with the fault {fault}' if fault else ''}"
    if case.expected.partial:
        found = {key: value for key, value in found.items() if key in wanted}
    merged = [{key: _joined(value) if key in _EVENTS else value for key, value in it.items()} for it in (wanted, found)]
    return difference(*merged, near=case.operation in _NUMERIC)


_EVENTS = frozenset({"events", "flushed"})
_NUMERIC = frozenset({"readings.read", "readings.read_leniently", "readings.read_response", "registers.read_items"})
"""The operations whose numbers are computed."""
_HEX = frozenset({"wire", "crc", "rest", "frame", "noise"})
"""The keys of bytes in hex."""
_TOLERANCE = 1e-12


def _joined(events: Any) -> Any:  # noqa: ANN401 - whatever the implementation answers
    """Return events with adjacent noise as one run, with its first fault; what is not events stays as it is."""
    if not isinstance(events, list) or not all(map(_is_event, events)):
        return events
    found: list[dict[str, str]] = []
    for event in events:
        if found and "noise" in event and "noise" in found[-1]:
            found[-1] = found[-1] | {"noise": found[-1]["noise"] + event["noise"]}
        else:
            found.append(event)
    return found


def _is_event(event: object) -> bool:
    if not isinstance(event, dict) or event.keys() not in ({"frame"}, {"noise", "fault"}):
        return False
    return all(isinstance(text, str) for text in event.values())


def difference(expected: Any, found: Any, *, near: bool = False, at: str = "") -> str:  # noqa: ANN401 - of any JSON
    """Return the first difference of two values of JSON, with its place; empty if they are equal.

    Special: with `near`, numbers may differ by one part in 10^12. Texts under the keys of bytes are compared as hex.

    >>> difference({"values": [1.0, 2]}, {"values": [1, 3]})
    'values[1]: 3 instead of 2'
    """
    if isinstance(expected, dict) and isinstance(found, dict):
        for key, value in expected.items():
            if key not in found:
                return f"{at or 'result'}: {key} is missing"
            if text := difference(value, found[key], near=near, at=f"{at}.{key}" if at else key):
                return text
        unknown = [key for key in found if key not in expected]
        return f"{at or 'result'}: unknown key {_shown(unknown[0])}" if unknown else ""
    if isinstance(expected, list) and isinstance(found, list):
        for place, (one, other) in enumerate(zip(expected, found, strict=False)):
            if text := difference(one, other, near=near, at=f"{at}[{place}]"):
                return text
        return "" if len(expected) == len(found) else f"{at}: {len(found)} items instead of {len(expected)}"
    equal = _equal(expected, found, near=near, is_hex=at.rpartition(".")[2] in _HEX)
    return "" if equal else f"{at}: {_shown(found)} instead of {_shown(expected)}"


def _equal(expected: object, found: object, *, near: bool, is_hex: bool) -> bool:
    if isinstance(expected, bool | None) or isinstance(found, bool):
        return expected is found
    if isinstance(expected, int | float) and isinstance(found, int | float):
        return expected == found or (near and _is_near(expected, found))
    if isinstance(expected, str) and isinstance(found, str) and is_hex:
        return expected.lower() == found.lower()
    return expected == found


def _is_near(expected: float, found: float) -> bool:
    try:
        return isclose(expected, found, rel_tol=_TOLERANCE)
    except OverflowError:  # an int beyond floats
        return False


def verdict_of(cases: Sequence[Judged]) -> Verdict:
    """Return the verdict of a vector: the worst of its cases; it passes if what was run of it passed."""
    return next(verdict for verdict in _WORST_FIRST if verdict in {case.verdict for case in cases})


_WORST_FIRST: Iterable[Verdict] = (Verdict.ERROR, Verdict.FAIL, Verdict.PASS, Verdict.SKIP)
