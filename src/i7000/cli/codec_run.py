"""Cases of vectors, run by an implementation in another process.

Laws: every case has one verdict, in the order of the cases. Some cases are open at once; if the process fails then,
those that are open are run again one by one, so that the error belongs to the case that causes it.
"""

from collections import deque
from collections.abc import Iterator, Sequence

from i7000.cli.codec_process import CodecProcess
from i7000.cli.words import LineError
from i7000.conformance.vector_verdicts import (
    Implementation,
    Judged,
    MessageError,
    Reason,
    error,
    judged,
    read_answer,
    read_started,
    run_message,
    skipped,
    start_message,
    stop_message,
)
from i7000.conformance.vectors import Case

__all__ = ["FINISHING", "MOST_RESTARTS", "OPEN", "STARTING", "Codec"]

OPEN = 64
"""The cases that are sent before the oldest is answered."""
MOST_RESTARTS = 20
"""How often a process that failed is started again."""

STARTING = 30.0
"""The seconds that a program may take to start, if an answer may not take longer."""

FINISHING = 5.0
"""The seconds that a program may take to end."""


class _FailedError(Exception):
    """A process that failed: why, the end of its standard error, and the cases that were open."""

    def __init__(self, fault: MessageError, stderr: str, cases: tuple[Case, ...]) -> None:
        super().__init__(fault)
        self.fault, self.stderr, self.cases = fault, stderr, cases

    def errors(self, waiting: deque[Case]) -> Iterator[Judged]:
        """Yield an error for the case that was open; if none was, since no process can be started, for all others."""
        yield from (error(case, self.fault, self.stderr) for case in self.cases)
        while waiting and not self.cases:
            yield error(waiting.popleft(), self.fault)


class Codec:
    """An implementation under test: a process, and another one whenever it fails.

    Shape: `timeout` is how many seconds each answer may take.
    Errors: `LineError` if it cannot be started.
    """

    def __init__(self, command: Sequence[str], timeout: float) -> None:
        self._command, self._timeout = command, timeout
        self.restarts = 0
        self.note = ""
        """What was remarkable about its end."""
        self._seq = 0
        self._awaited = 0
        self._process: CodecProcess | None = None
        self._given_up: MessageError | None = None
        try:
            self.implementation = self._started()
        except MessageError as fault:
            raise LineError(f"{command[0]} does not start: {fault}") from None

    def run(self, cases: Sequence[Case]) -> Iterator[Judged]:
        """Yield the verdict of each case."""
        waiting = deque(cases)
        while waiting:
            try:
                yield from self._together(waiting)
            except _FailedError as failure:
                yield from self._one_by_one(failure) if len(failure.cases) > 1 else failure.errors(waiting)

    def _together(self, waiting: deque[Case]) -> Iterator[Judged]:
        """Yield the verdicts of cases of which some are open at once.

        Errors: `_FailedError` if the process fails.
        """
        sent: deque[Case] = deque()
        while waiting or sent:
            try:
                self._fill(waiting, sent)
                found = self._judged(sent[0])
            except MessageError as fault:
                raise _FailedError(fault, self.kill(), tuple(sent)) from None
            sent.popleft()
            yield found

    def _one_by_one(self, failure: "_FailedError") -> list[Judged]:
        """Return the verdicts of the cases that were open at a failure; at least one of them is an error."""
        found = []
        is_repeated = False
        for case in failure.cases:
            try:
                self._fill(deque([case]), deque())
                found.append(self._judged(case))
            except MessageError as fault:
                is_repeated = True
                found.append(error(case, fault, self.kill()))
        if not is_repeated:
            cause = MessageError(failure.fault.reason, f"{failure.fault.text}; not when it was run again alone")
            found[0] = error(failure.cases[0], cause, failure.stderr)
        return found

    def stop(self) -> None:
        """End the implementation, as the protocol says; `note` has what was wrong with that."""
        if self._process:
            self._process.send(stop_message(self._seq))
            self.note = self._process.finish(FINISHING)
        self.kill()

    def kill(self) -> str:
        """Kill the process, if there is one; return the end of its standard error."""
        process, self._process = self._process, None
        if process is None:
            return ""
        process.kill()
        return process.errors()

    def _has(self, case: Case) -> bool:
        return case.operation in self.implementation.operations

    def _fill(self, waiting: deque[Case], sent: deque[Case]) -> None:
        """Send cases until as many are open as may be; those of an unknown operation are not sent."""
        process = self._process or self._restarted()
        while waiting and len(sent) < OPEN:
            case = waiting.popleft()
            sent.append(case)
            if self._has(case):
                process.send(run_message(self._seq, case))
                self._seq += 1

    def _judged(self, case: Case) -> Judged:
        """Return the verdict of the oldest open case."""
        if not self._has(case):
            return skipped(case, Reason.NOT_IMPLEMENTED)
        assert self._process  # noqa: S101 - the case was sent to it
        answer = read_answer(self._process.receive(self._timeout), self._awaited)
        self._awaited += 1
        return judged(case, answer)

    def _restarted(self) -> CodecProcess:
        """Start another process, if that still makes sense.

        Errors: `MessageError` with `Reason.NOT_RUN`, from the first time on that it does not start.
        """
        if self._given_up is None and self.restarts == MOST_RESTARTS:
            self._given_up = MessageError(Reason.NOT_RUN, f"the implementation failed {MOST_RESTARTS + 1} times")
        if self._given_up is not None:
            raise self._given_up
        self.restarts += 1
        try:
            self._started()
        except (MessageError, LineError) as fault:
            self._given_up = MessageError(Reason.NOT_RUN, f"the implementation does not start again: {fault}")
            raise self._given_up from None
        assert self._process  # noqa: S101 - it was just started
        return self._process

    def _started(self) -> Implementation:
        try:
            self._process = CodecProcess(self._command)
        except (OSError, ValueError) as failure:
            raise LineError(f"{self._command[0]}: {getattr(failure, 'strerror', None) or failure}") from None
        self._process.send(start_message(0))
        try:
            found = read_started(self._process.receive(max(self._timeout, STARTING)), 0)
        except MessageError as fault:
            errors = self.kill()
            raise MessageError(fault.reason, f"{fault.text}{errors and f'; {errors}'}") from None
        self._seq = self._awaited = 1
        return found
