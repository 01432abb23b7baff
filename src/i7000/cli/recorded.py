"""The options of the commands that can record, and what they record to."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Annotated, TypeVar

from attrs import frozen
from cyclopts import Parameter

from i7000.recording import Capture, Carried, Record, Recorder

__all__ = ["NOWHERE", "RecordOptions", "Write", "both", "recorded"]

T = TypeVar("T")
Write = Callable[[Record], None]


@Parameter(name="*")
@frozen
class RecordOptions:
    """Where the traffic is recorded."""

    record: Annotated[Path | None, Parameter(help="Record all traffic, as JSON lines, to a new file.")] = None
    pcap: Annotated[Path | None, Parameter(help="Record all traffic for Wireshark (pcapng), to a new file.")] = None


NOWHERE = RecordOptions()


@contextmanager
def recorded(
    options: RecordOptions, *, program: str, target: str, began: float, report: Callable[[str], object]
) -> Iterator[Write | None]:
    """Create the files of a recording, and close them at the end; yield what writes a record, or None without files.

    Shape: as for `i7000.recording.Recorder`.
    Errors: `OSError` for a file that cannot be created, and `FileExistsError` for one that exists.
    """
    with ExitStack() as files:
        writers: list[Write] = []
        if options.record:
            recorder = Recorder(options.record, program=program, target=target, began=began, report=report)
            writers.append(files.enter_context(recorder).write)
        if options.pcap:
            capture = files.enter_context(Capture(options.pcap, began=began, report=report))
            writers.append(lambda record: capture.write(record) if isinstance(record, Carried) else None)

        def write(record: Record) -> None:
            for one in writers:
                one(record)

        yield write if writers else None


def both(one: Callable[[T], None] | None, other: Callable[[T], None] | None) -> Callable[[T], None] | None:
    """Return a function that calls two others, if there are two; or the one that there is."""
    if one is None or other is None:
        return one or other

    def call(value: T) -> None:
        other(value)
        one(value)

    return call
