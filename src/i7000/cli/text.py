"""Records on a terminal, or in a file: colours for the one, the same lines without for the other.

Laws: a line is as long as what it says, never wrapped and never cut; what a terminal could take for a control sequence
is escaped.
"""

import json
from collections.abc import Iterable, Iterator
from itertools import groupby

from rich.console import Console
from rich.segment import Segments
from rich.text import Text

from i7000 import Model
from i7000.cli.dcon import scope
from i7000.cli.records import Record
from i7000.cli.words import type_code_words

__all__ = ["Printer", "command_lines", "escaped", "frame_lines", "printable", "register_lines", "request_lines"]

_INDENT = "     "


class Printer:
    """Where output goes: `json` as one object a line, else for people."""

    def __init__(self, *, json: bool = False) -> None:
        self.json = json
        self.out = Console(highlight=False)
        self.err = Console(highlight=False, stderr=True)

    def record(self, record: Record, lines: Iterable[Text]) -> None:
        """Print a record: as it is, or in lines for people."""
        if self.json:
            self.out.out(json.dumps(record), highlight=False)
        else:
            self.show(lines)

    def show(self, lines: Iterable[Text]) -> None:
        """Print lines for people."""
        for line in lines:
            _print(self.out, line)

    def error(self, message: object) -> None:
        """Say what is wrong."""
        _print(self.err, _styled(f"i7000: {message}", "red"))


def _print(console: Console, line: Text) -> None:
    """Print a line as segments: text would be wrapped, or lose its last blanks."""
    segments = printable(line, console.encoding).render(console, end="\n")
    console.print(Segments(segments), soft_wrap=True, end="")


def escaped(text: str) -> str:
    r"""Escape what is no character of a line, and could move a terminal's cursor.

    >>> escaped("\x1b[2J")
    '\\x1b[2J'
    """
    return "".join(one if one.isprintable() else one.encode("unicode_escape").decode() for one in text)


def printable(text: Text, encoding: str) -> Text:
    """Escape what is no character of a line, or none that can be written."""
    plain = text.plain
    if plain.isascii() and plain.isprintable():
        return text
    return Text(escaped(plain).encode(encoding, "backslashreplace").decode(encoding))


def _styled(words: str, style: str) -> Text:
    return Text().append(words, style)


# --- decode -----------------------------------------------------------------------------------------------------------


def frame_lines(record: Record, *, models: bool) -> Iterator[Text]:
    """What a frame means; `models` tells whether to say which models it fits."""
    yield Text(f"{record['line']:<4} ").append(record["text"], "bold")
    if record["error"]:
        yield _styled(f"{_INDENT}not understood: {record['error']}", "red")
    if record["name"]:
        yield from _meaning(record, models=models, answers=record["answers"])
    for count, candidate in enumerate(record["candidates"]):
        yield Text(_INDENT + ("or" if count else "could be"))
        yield from _meaning(candidate, models=models, answers=record["answers"])


def _meaning(record: Record, *, models: bool, answers: int | None) -> Iterator[Text]:
    source = f"manual {record['section']}" + (f"; {' '.join(record['errata'])}" if record["errata"] else "")
    yield Text(_INDENT).append(record["name"], "cyan").append(f": {record['title']} ({source})")
    if record["command"]:
        yield _row("answers", f"{record['command']}, line {answers}")
    for name, words in record["explained"].items():
        yield _row(name, words)
    yield from _registers(record["registers"])
    yield from _readings(record)
    if record["readings"] and record["data_formats"]:
        yield _row("format", " or ".join(record["data_formats"]))
    if record["checksum"]:
        yield _row("checksum", "right")
    if record["pause"]:
        yield _row("pause", f"{record['pause']:g} s before the next command")
    if record["note"]:
        yield _row("note", record["note"])
    if models:
        yield _row("models", scope(map(Model, record["models"]), record["section"]))


def _row(name: str, words: str) -> Text:
    return _styled(f"{_INDENT}  {name:<15} ", "dim").append(words)


def _readings(record: Record) -> Iterator[Text]:
    for reading in record["readings"]:
        channel = "channel" if reading["channel"] is None else f"channel {reading['channel']}"
        line = _row(channel, f"{reading['text']:7}")
        if reading["status"] == "ok":
            line.append(f"  {reading['value']:.7g} {reading['unit']}", "green")
        elif reading["status"]:
            line.append(f"  {reading['status'].upper()}", "yellow")
        yield line
    for code in sorted({reading["type_code"] for reading in record["readings"]} - {None}):
        yield _row("type", type_code_words(code))
    if any(reading["status"] is reading["type_code"] is None for reading in record["readings"]):
        yield _row("type", "not known: --type tells")
    if record["assumed"]:
        yield _row("assumed", f"the factory default of {' and '.join(record['assumed'])}")


def _registers(registers: list[Record]) -> Iterator[Text]:
    """Registers with their values; those without, or with readings that were told, in ranges."""
    for (name, text, _), group in groupby(registers, _in_range):
        first, *others = group
        number = first["number"] + (f"..{others[-1]['number']}" if others else "")
        channel = "" if others or first["channel"] is None else f" {first['channel']}"
        line = _row(number, "  ".join(filter(None, ((name or "") + channel, text))))
        line.rstrip()
        yield line


def _in_range(register: Record) -> tuple[str | None, str | None, int | None]:
    """What registers of one line have in common."""
    if register["status"]:
        return register["name"], None, None
    return register["name"], register["text"], None if register["value"] is None else int(register["number"])


# --- commands ---------------------------------------------------------------------------------------------------------


def command_lines(record: Record) -> Iterator[Text]:
    """One command, in a line."""
    since = {Model(model): firmware for model, firmware in record["models"].items()}
    yield (
        Text(f"{record['section']:<5} ")
        .append(f"{record['syntax']:<12} ", "bold")
        .append(f"{record['response_syntax'] or 'no response':<12} ")
        .append(f"{record['name']:<28} ", "cyan")
        .append(f"{record['title']:<43} ")
        .append(scope(since, record["section"]), "dim")
    )


def request_lines(record: Record) -> Iterator[Text]:
    """One request by Modbus, in a line."""
    since = {Model(model): firmware for model, firmware in record["models"].items()}
    yield (
        Text(f"{record['section']:<7} ")
        .append(f"{record['syntax']:<47} ", "bold")
        .append(f"{record['name']:<26} ", "cyan")
        .append(f"{record['title']:<22} ")
        .append(scope(since, record["section"]), "dim")
    )


def register_lines(record: Record) -> Iterator[Text]:
    """One row of an address map, in a line."""
    numbers = record["number"] + (f"..{record['last_number']}" if record["count"] > 1 else "")
    unit = f"{record['scale']:g} {record['unit']}" if record["scale"] else ""
    limits = "" if record["minimum"] is None else f"{record['minimum']}..{record['maximum']}"
    yield (
        Text(f"{numbers:<12} ", "bold")
        .append(f"{record['name']:<28} ", "cyan")
        .append(f"{record['access']:<3} {record['kind']:<7} {unit:<9} {limits}".rstrip())
    )
