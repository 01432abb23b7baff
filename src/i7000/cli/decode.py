"""``i7000 decode``: what the frames of a log mean."""

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from i7000.cli.options import UNKNOWN, Json, Module
from i7000.cli.records import Record, frameless_record, heard_record
from i7000.cli.source import LONGEST_LINE, Counted, Lines
from i7000.cli.text import Printer, frame_lines
from i7000.cli.words import UsageError
from i7000.dissect import Heard, Kind, Knowledge, Piece, Place, hear_frame, pieces
from i7000.dissect import Line as Listener
from i7000.dissect.stream import looks_like
from i7000.settings import Protocol

__all__ = ["decode", "records"]

_PROTOCOLS: dict[str, Protocol | None] = {"auto": None, "dcon": Protocol.DCON, "rtu": Protocol.MODBUS_RTU}


def decode(
    *frames: Annotated[str, Parameter(help="Frames; without any, the lines of --file or of standard input.")],
    file: Annotated[Path | None, Parameter(help="A log; - is standard input.", allow_leading_hyphen=True)] = None,
    protocol: Annotated[Literal["auto", "dcon", "rtu"], Parameter(help="DCON, Modbus RTU, or both.")] = "auto",
    strict: Annotated[bool, Parameter(help="Lines without a frame are not understood either.", negative="")] = False,
    json: Json = False,
    module: Module = UNKNOWN,
) -> int:
    r"""Decode frames: those given, or those of a log.

    A DCON frame is text (`$012`, with or without `\r` or `(CR)` at its end), or pairs of hex digits up to the final
    `0d`. Quote it: the shell knows `$`, `#` and `>` too; and put `--` before frames of which one begins with `->`. A
    Modbus frame is in hex: `010400000008F1CC`, `01 04 ...`, `0x01,0x04,...`, `\x01\x04...`; one argument a frame, or
    more that follow one another. Lines of a log can have dates, words (`TX:`), brackets and arrows before the frame;
    what cannot be understood is printed too, and named at the end.

    A response is read together with the command before it. Without `--model` all that it could be is told. With
    `--model`, what is not given has its factory default if the frame fits that, and is left open if not. By Modbus the
    model gives registers their names, and readings their values.

    Exit code: 0 if all was understood (also if in more ways than one), 1 if not, 2 for wrong usage.

    JSON has the same keys always, null or empty where there is nothing to tell:

    * the frame: `line`, `direction` (command or response; request, response or echo), `text` (the line), `frame`,
      `wire` (hex), `answers` (line of the command), `error`, `fault`;
    * its meaning, if it has one: `name`, `title`, `section`, `syntax`, `command` (that it answers), `fields` (numbers,
      as in the vectors of spec), `explained` (the same in words), `readings` (`channel`, `text`, `status`, `type_code`,
      `value`, `unit`), `registers` (`number`, `name`, `channel`, `value`, `unit`, `status`, `text`), `errata`, `pause`
      (seconds to leave the module alone), `models`, `checksum` (null: fits both), `data_formats`, `assumed` (what has
      its factory default), `note` (what else is to be known);
    * if it has more: `candidates`, objects with the keys of a meaning.
    """
    knowledge = Knowledge.given(module.known(protocol))
    count = framed = 0
    wrong = Counted()
    printer = Printer(json=json)
    with _source(frames, file, printer) as lines:
        texts = ((number, text.decode("utf-8", "surrogateescape")) for number, text in lines)
        for record, heard in records(texts, knowledge, _PROTOCOLS[protocol]):
            count += 1
            framed += heard is not None
            if strict if heard is None else not heard.understood:
                wrong.add(record["line"])
            unknown = heard is not None and knowledge.of(heard.address).known.model is None
            printer.record(record, frame_lines(record, None if heard is None else heard.answers, models=unknown))
    long = lines.long if isinstance(lines, Lines) else Counted()
    if not count:
        printer.error("there was nothing to decode")
    elif not framed:
        printer.error("there is no frame in it")
    if long.count:
        printer.error(f"{long.count} too long, read in pieces of {LONGEST_LINE} bytes that may cut frames: line {long}")
    if wrong.count:
        printer.error(f"{wrong.count} not understood: line {wrong}")
    return 1 if wrong.count or long.count or (count and not framed) else 0


def records(
    lines: Iterable[tuple[int, str]], knowledge: Knowledge, protocol: Protocol | None
) -> Iterator[tuple[Record, Heard | None]]:
    """Yield a record for each frame of a log, and for each line without one."""
    line = Listener(knowledge, protocol)
    for number, piece in enumerate(pieces(lines, protocol), 1):
        if piece.kind is None:
            yield frameless_record(number, piece), None
            continue
        place = Place(number, f"line {piece.number}")
        line, heard = hear_frame(line, piece.wire, _protocol_of(piece) if protocol is None else protocol, place)
        yield heard_record(piece, heard), heard


def _protocol_of(piece: Piece) -> Protocol:
    if piece.kind is Kind.DAMAGED:
        return looks_like(piece.wire)
    return Protocol.DCON if piece.kind is Kind.DCON else Protocol.MODBUS_RTU


@contextmanager
def _source(frames: tuple[str, ...], file: Path | None, printer: Printer) -> Iterator[Iterable[tuple[int, bytes]]]:
    """The numbered lines to decode; what was decoded is printed before waiting for more."""
    if frames and file:
        raise UsageError("frames are given, and a file too: give one of them")
    if frames:
        yield enumerate(map(_argument, frames), 1)
    elif file and file != Path("-"):
        with file.open("rb") as log:
            yield Lines(log, printer.flush)
    elif sys.stdin is None or (file is None and sys.stdin.isatty()):
        raise UsageError("no frames: give some, or --file, or a log on standard input; see i7000 decode --help")
    else:
        yield Lines(sys.stdin.buffer, printer.flush)  # type: ignore[arg-type] # it is buffered


def _argument(text: str) -> bytes:
    """The bytes that an argument was made of, UTF-8 or not."""
    try:
        return os.fsencode(text)
    except UnicodeEncodeError:
        return text.encode("utf-8", "surrogatepass")
