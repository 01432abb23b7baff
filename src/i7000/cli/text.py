"""Records on a terminal, or in a file: colours for the one, the same lines without for the other.

A line is made of spans, each a text and its style. Off a terminal they are written as they are: without rich, which
takes most of the time there, and is not even imported.

Laws: a line is as long as what it says, never wrapped and never cut; what a terminal could take for a control sequence
is escaped before rich sees it, which drops some of these characters.
"""

import json
import os
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, TextIO

from i7000 import Model
from i7000.cli.records import Record
from i7000.dissect.words import models_words

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

__all__ = [
    "Line",
    "Printer",
    "command_lines",
    "escaped",
    "printable",
    "register_lines",
    "request_lines",
    "undecodable_as_bytes",
]

Line = list[tuple[str, str]]
"""The spans of a line: texts and their styles; no style is the empty one."""

_INDENT = "     "
_json = json.JSONEncoder(check_circular=False).encode


class Printer:
    """The output: with `json` one object a line, else lines for people.

    Time: records off a terminal are in the buffer of standard output until `flush`: Ctrl-C loses none of them.
    """

    def __init__(self, *, json: bool = False) -> None:
        self.json = json
        self._styled = _is_styled(sys.stdout)

    @cached_property
    def out(self) -> "Console":
        """Standard output, to draw on."""
        from rich.console import Console  # noqa: PLC0415 - it takes time

        return Console(highlight=False)

    @cached_property
    def err(self) -> "Console":
        """Standard error, to draw on."""
        from rich.console import Console  # noqa: PLC0415 - it takes time

        return Console(highlight=False, stderr=True)

    @property
    def is_interactive(self) -> bool:
        """Whether standard error is a terminal, on which progress can be drawn."""
        return sys.stderr is not None and sys.stderr.isatty()

    def record(self, record: Record, lines: Iterable[Line]) -> None:
        """Print a record: as it is, or in lines for people."""
        if self.json:
            self.write(_json(record))
        else:
            self.lines(lines)

    def lines(self, lines: Iterable[Line]) -> None:
        """Print lines for people."""
        if self._styled:
            for line in lines:
                _print(self.out, _text(line))
        else:
            for line in lines:
                self.write(_plain(line, sys.stdout))

    def write(self, line: str) -> None:
        """Print a line as it is."""
        if sys.stdout:
            sys.stdout.write(line + "\n")

    def show(self, lines: Iterable["Text"]) -> None:
        """Print texts for people, at once."""
        self.flush()
        for line in lines:
            _print(self.out, printable(line, self.out.encoding))

    def error(self, message: object) -> None:
        """Print an error."""
        self.note(message, "red")

    def note(self, message: object, style: str = "") -> None:
        """Print a message beside the output, on standard error."""
        with suppress(OSError):  # `program` reports that the output cannot be written.
            self.flush()
        line = [(undecodable_as_bytes(f"i7000: {message}"), style)]
        if _is_styled(sys.stderr):
            _print(self.err, _text(line))
        elif sys.stderr:
            sys.stderr.write(f"{_plain(line, sys.stderr)}\n")

    def flush(self) -> None:
        """Write what was printed, now."""
        if sys.stdout:
            sys.stdout.flush()


def _is_styled(file: TextIO | None) -> bool:
    """Return whether a file is a terminal, or may be one to rich, which looks at more of the environment."""
    return file is not None and (file.isatty() or any(map(os.environ.get, ("FORCE_COLOR", "TTY_COMPATIBLE"))))


def _plain(line: Line, file: TextIO | None) -> str:
    """Return a line without styles, in characters that can be written to a file."""
    text = escaped("".join([text for text, _ in line]))
    if text.isascii() or file is None:
        return text
    encoding = file.encoding or "utf-8"
    return text.encode(encoding, "backslashreplace").decode(encoding)


def _text(line: Line) -> "Text":
    from rich.text import Text  # noqa: PLC0415 - it takes time

    return Text.assemble(*[(escaped(text), style) for text, style in line], end="")


def _print(console: "Console", line: "Text") -> None:
    """Print a line as segments: text would be wrapped, or lose its last blanks."""
    from rich.segment import Segments  # noqa: PLC0415 - it takes time

    console.print(Segments(printable(line, console.encoding).render(console, end="\n")), soft_wrap=True, end="")


# --- characters -------------------------------------------------------------------------------------------------------


class _Escapes(dict[int, str]):
    """What is written for a character: itself, or an escape for what is not seen, or could move a cursor."""

    def __missing__(self, code: int) -> str:
        character = chr(code)
        if character.isprintable() and not _UNSEEN.fullmatch(character):
            return character
        escape = character.encode("unicode_escape").decode()
        return self.setdefault(code, escape) if code <= 0xFF else escape


_UNSEEN = re.compile("[\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u3164\ufe00-\ufe0f\uffa0\U000e0100-\U000e01ef]")
"""Fillers, joiners and selectors that `str.isprintable` takes for characters one can see."""
_ESCAPES = _Escapes()


def escaped(text: str) -> str:
    r"""Escape characters that are invisible or could move the cursor of a terminal.

    >>> escaped("\x1b[2J")
    '\\x1b[2J'
    """
    return text if text.isascii() and text.isprintable() else text.translate(_ESCAPES)


_UNDECODABLE = re.compile(r"(?<!\\)(?P<pairs>(?:\\\\)*)\\udc(?P<byte>[89a-f][0-9a-f])")


def undecodable_as_bytes(text: str) -> str:
    r"""Write bytes that are not UTF-8 as such in a message that has the `repr` of a text with them.

    >>> print(undecodable_as_bytes(f"{chr(0xDCFF)!r} is not a command"))
    '\xff' is not a command
    >>> print(undecodable_as_bytes(r"'\\udcff'"))
    '\\udcff'
    """
    return _UNDECODABLE.sub(r"\g<pairs>\\x\g<byte>", text)


def printable(text: "Text", encoding: str) -> "Text":
    """Escape control characters, and those that the encoding of the output lacks."""
    plain = text.plain
    if plain.isascii() and plain.isprintable():
        return text
    return type(text)(escaped(plain).encode(encoding, "backslashreplace").decode(encoding))


@lru_cache(maxsize=256)
def _scope(models: tuple[str, ...], section: str) -> str:
    return models_words(map(Model, models), section)


# --- commands ---------------------------------------------------------------------------------------------------------


def command_lines(record: Record) -> Iterator[Line]:
    """Yield the line of a command."""
    yield [
        (f"{record['section']:<5} ", ""),
        (f"{record['syntax']:<12} ", "bold"),
        (f"{record['response_syntax'] or 'no response':<12} ", ""),
        (f"{record['name']:<28} ", "cyan"),
        (f"{record['title']:<43} ", ""),
        (_scope(tuple(record["models"]), record["section"]), "dim"),
    ]


def request_lines(record: Record) -> Iterator[Line]:
    """Yield the line of a request by Modbus."""
    yield [
        (f"{record['section']:<7} ", ""),
        (f"{record['syntax']:<47} ", "bold"),
        (f"{record['name']:<26} ", "cyan"),
        (f"{record['title']:<22} ", ""),
        (_scope(tuple(record["models"]), record["section"]), "dim"),
    ]


def register_lines(record: Record) -> Iterator[Line]:
    """Yield the line of a row of an address map."""
    numbers = record["number"] + (f"..{record['last_number']}" if record["count"] > 1 else "")
    unit = f"{record['scale']:g} {record['unit']}" if record["scale"] else ""
    limits = "" if record["minimum"] is None else f"{record['minimum']}..{record['maximum']}"
    yield [
        (f"{numbers:<12} ", "bold"),
        (f"{record['name']:<28} ", "cyan"),
        (f"{record['access']:<3} {record['kind']:<7} {unit:<9} {limits}".rstrip(), ""),
    ]
