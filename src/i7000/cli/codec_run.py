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

__all__ = ["MOST_RESTARTS", "OPEN", "Codec"]

OPEN = 64
"""The cases that are sent before the oldest is answered."""
MOST_RESTARTS = 20
"""How often a process that failed is started again."""


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
        try:
            self.implementation = self._started()
        except MessageError as fault:
            raise LineError(f"{command[0]} does not start: {fault}") from None

    def run(self, cases: Sequence[Case]) -> Iterator[Judged]:
        """Yield the verdict of each case."""
        waiting, sent = deque(cases), deque[Case]()
        alone = 0
        while waiting or sent:
            try:
                process = self._process or self._restarted()
                self._fill(process, waiting, sent, 1 if alone else OPEN)
                case = sent[0]
                answer = read_answer(process.receive(self._timeout), self._awaited) if self._has(case) else None
            except MessageError as fault:
                errors = self.kill()
                if fault.reason is Reason.NOT_RUN:
                    yield from (error(it, fault) for it in waiting)
                    return
                if sum(map(self._has, sent)) > 1:
                    alone = len(sent)
                    waiting.extendleft(reversed(sent))
                    sent.clear()
                    continue
                yield error(sent.popleft(), fault, errors)
                waiting.extendleft(reversed(sent))
                sent.clear()
            else:
                sent.popleft()
                self._awaited += answer is not None
                yield skipped(case, Reason.NOT_IMPLEMENTED) if answer is None else judged(case, answer)
            alone = max(0, alone - 1)

    def stop(self) -> None:
        """End the implementation, as the protocol says; `note` has what was wrong with that."""
        if self._process:
            self._process.send(stop_message(self._seq))
            self.note = self._process.finish(self._timeout)
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

    def _fill(self, process: CodecProcess, waiting: deque[Case], sent: deque[Case], most: int) -> None:
        """Send cases until as many are open as may be; those of an unknown operation are not sent."""
        while waiting and len(sent) < most:
            case = waiting.popleft()
            sent.append(case)
            if self._has(case):
                process.send(run_message(self._seq, case))
                self._seq += 1

    def _restarted(self) -> CodecProcess:
        if self.restarts == MOST_RESTARTS:
            raise MessageError(Reason.NOT_RUN, f"the implementation failed {MOST_RESTARTS + 1} times")
        self.restarts += 1
        try:
            self._started()
        except (MessageError, LineError) as fault:
            raise MessageError(Reason.NOT_RUN, f"the implementation does not start again: {fault}") from None
        assert self._process  # noqa: S101 - it was just started
        return self._process

    def _started(self) -> Implementation:
        try:
            self._process = CodecProcess(self._command)
        except (OSError, ValueError) as failure:
            raise LineError(f"{self._command[0]}: {getattr(failure, 'strerror', None) or failure}") from None
        self._process.send(start_message(0))
        try:
            found = read_started(self._process.receive(self._timeout), 0)
        except MessageError as fault:
            errors = self.kill()
            raise MessageError(fault.reason, f"{fault.text}{errors and f'; {errors}'}") from None
        self._seq = self._awaited = 1
        return found
