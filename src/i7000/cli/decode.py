"""``i7000 decode``: what the frames of a log, a capture or a stream mean."""

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from io import BufferedReader
from pathlib import Path
from typing import Annotated, Literal

from attrs import frozen
from cyclopts import Parameter

from i7000.cli.frame_text import frame_lines
from i7000.cli.options import PROTOCOLS, UNKNOWN, Json, Module, Texts, address_of
from i7000.cli.readers import Missing, Read, hinted, of_capture, of_lines, of_recording, of_stream
from i7000.cli.records import json_of
from i7000.cli.schema import SCHEMA
from i7000.cli.source import LONGEST_LINE, Counted, Lines, chunks
from i7000.cli.text import Printer
from i7000.cli.words import UsageError
from i7000.dissect import Knowledge
from i7000.dissect.capture import is_capture
from i7000.recording import is_recording
from i7000.settings import Protocol

__all__ = ["Input", "decode", "reads_of"]


def decode(  # noqa: PLR0913 - each of them is an option
    *frames: Annotated[str, Parameter(help="Frames to decode. Without any, --file or standard input is read.")],
    file: Annotated[
        Path | None,
        Parameter(help="A log, a recording, or a pcap or pcapng file; - is standard input.", allow_leading_hyphen=True),
    ] = None,
    raw: Annotated[bool, Parameter(help="The input is the bytes of the line, not a log of them.", negative="")] = False,
    protocol: Annotated[
        Literal["auto", "dcon", "rtu"], Parameter(help="The protocol on the line; auto recognizes both, even mixed.")
    ] = "auto",
    address: Annotated[Texts, Parameter(help="Show only the module at this address. Example: --address 2.")] = (),
    strict: Annotated[bool, Parameter(help="Exit with 1 if a line has no frame.", negative="")] = False,
    json: Json = False,
    schema: Annotated[bool, Parameter(help="Print the JSON Schema of --json and exit.", negative="")] = False,
    module: Module = UNKNOWN,
) -> int:
    r"""Decode frames, a log, a capture file or a stream.

    Frames are found in any line of text, in the usual spellings: text (`$012`, `$012\r`, `$012<CR>`), hex
    (`01 04 00 00 00 08 F1 CC`, `0x01,0x04,...`, `\x01\x04...`), decimal numbers, dumps. Dates, words and arrows may
    stand around them. Quote frames in a shell, since it has its own use for `$`, `#` and `>`. Put `--` before a frame
    that begins with `-`.

    Each response is decoded together with its command. What the traffic shows about a module is used from then on: its
    name, firmware, types, data format, checksum. Without `--model`, every possible meaning is listed. With `--model`,
    what is neither given nor shown has its factory default, if the frame fits it. For several modules, give each with
    its address: `--model 1=M-7019R --model 2=I-7018`.

    Examples: `i7000 decode '$012' '!01050600'`, `i7000 decode --model M-7019R --type K --file bus.log`,
    `i7000 decode --model 1=M-7019R@B3.7,type=K --model 2=I-7018,checksum=true --file bus.pcapng`

    Exit code: 0 if every frame is understood, even in several ways; 1 if a frame is damaged, unknown or contradicts
    what is known; 2 for wrong usage. With `--strict`, lines without a frame count too.
    """
    if schema:
        sys.stdout.write(f"{SCHEMA}\n")
        return 0
    knowledge = module.knowledge(protocol)
    shown = frozenset(map(address_of, address))
    printer = Printer(json=json)
    with reads_of(Input(frames, file, raw), knowledge, PROTOCOLS[protocol], printer) as (reads, word, lines):
        tally = _print(hinted(reads, PROTOCOLS[protocol]), knowledge, shown, printer)
    return tally.code(printer, word, lines.long if lines else Counted(), strict=strict)


# --- what is decoded --------------------------------------------------------------------------------------------------


@frozen
class Input:
    """What is decoded: frames, or a file, or else standard input."""

    frames: tuple[str, ...]
    file: Path | None
    raw: bool
    """Whether the input is the bytes of the line."""


@contextmanager
def reads_of(
    given: Input, knowledge: Knowledge, protocol: Protocol | None, printer: Printer
) -> Iterator[tuple[Iterable[Read], str, Lines | None]]:
    """Yield the input in pieces, and what their numbers count; what is decoded is printed before waiting for more."""
    if given.frames:
        if given.file or given.raw:
            raise UsageError("give either frames, or --file or --raw")
        yield of_lines(enumerate(map(_argument, given.frames), 1), knowledge, protocol), "line", None
        return
    with _opened(given.file) as stream:
        if given.raw:
            yield of_stream(chunks(stream, printer.flush), knowledge, protocol), "frame", None
        elif is_capture(stream.peek(4)[:4]):
            yield of_capture(chunks(stream, printer.flush), knowledge, protocol), "packet", None
        else:
            lines = Lines(stream, printer.flush)
            of = of_recording if is_recording(stream.peek(32)) else of_lines
            yield of(((number, _text(line)) for number, line in lines), knowledge, protocol), "line", lines


@contextmanager
def _opened(file: Path | None) -> Iterator[BufferedReader]:
    if file and file != Path("-"):
        with file.open("rb") as stream:
            yield stream
    elif sys.stdin is None or (file is None and sys.stdin.isatty()):
        raise UsageError("no frames: give some, or --file, or a log on standard input; see i7000 decode --help")
    else:
        yield sys.stdin.buffer  # type: ignore[misc] # it is a reader


def _text(line: bytes) -> str:
    return line.decode("utf-8", "surrogateescape")


def _argument(text: str) -> str:
    """Return an argument as it would stand in a file, whatever the encoding of arguments is."""
    try:
        return _text(os.fsencode(text))
    except UnicodeEncodeError:
        return _text(text.encode("utf-8", "surrogatepass"))


# --- what is printed --------------------------------------------------------------------------------------------------


class _Tally:
    """The number of frames, and which of them are not understood."""

    def __init__(self) -> None:
        self.records = self.frames = self.hidden = 0
        self.wrong, self.contradictory, self.frameless = Counted(), Counted(), Counted()

    def add(self, read: Read) -> None:
        """Count what was read."""
        self.records += 1
        self.frames += read.heard is not None
        if read.missing is Missing.NOTHING:
            self.frameless.add(read.line)
        if not read.understood:
            contradictory = read.heard is not None and read.heard.error is None
            (self.contradictory if contradictory else self.wrong).add(read.line)

    def code(self, printer: Printer, word: str, long: Counted, *, strict: bool) -> int:
        """Print what was wrong, and return the exit code; `word` is what the numbers count."""
        if not self.records and self.hidden:
            printer.error("no frame of this address")
        elif not self.records:
            printer.error("nothing to decode: the input is empty")
        elif not self.frames:
            printer.error("no frame in the input")
        if long.count:
            cut = f"read in pieces of {LONGEST_LINE} bytes that may cut frames"
            printer.error(f"{long.count} too long, {cut}: line {long}")
        if self.wrong.count:
            printer.error(f"{self.wrong.count} not understood: {word} {self.wrong}")
        if strict and self.frameless.count:
            printer.error(f"{self.frameless.count} without a frame: {word} {self.frameless}")
            return 1
        if self.contradictory.count:
            printer.error(f"{self.contradictory.count} contradicting what is known: {word} {self.contradictory}")
        return 1 if self.wrong.count or self.contradictory.count or long.count else 0


def _print(reads: Iterable[Read], knowledge: Knowledge, shown: frozenset[int], printer: Printer) -> _Tally:
    tally = _Tally()
    for read in reads:
        heard = read.heard
        if shown and (heard is None or heard.address not in shown):
            tally.hidden += 1
            continue
        tally.add(read)
        if printer.json:
            printer.write(json_of(read))
        else:
            unknown = heard is not None and knowledge.of(heard.address).known.model is None
            printer.lines(frame_lines(read, models=unknown))
    return tally
