"""Explained commands, registers and errata for people: a heading, then labelled rows with wrapped text."""

from collections.abc import Iterable, Iterator
from shutil import get_terminal_size
from textwrap import wrap

from i7000 import Model
from i7000.cli.records import Record
from i7000.cli.text import Line
from i7000.dissect.words import models_words

__all__ = ["command_text", "erratum_lines", "erratum_text", "register_text"]

_INDENT = "  "
_LABEL = 14
_WIDEST = 100
"""The width of a line in characters; less on a narrower terminal."""


def _labelled(label: str, text: str, style: str = "") -> Iterator[Line]:
    """Yield a label and a text beside it, in as many lines as it needs."""
    width = min(get_terminal_size((_WIDEST, 24)).columns, _WIDEST) - len(_INDENT) - _LABEL - 1
    for part in wrap(text, max(width, 20), break_long_words=False, break_on_hyphens=False) or [""]:
        yield [(f"{_INDENT}{label:<{_LABEL}} ", "dim"), (part, style)]
        label = ""


def _heading(name: str, text: str, sections: Iterable[str]) -> Line:
    return [(name, "cyan"), (f"{text} (manual {', '.join(sections)})", "")]


def _errata(record: Record, shown: set[str]) -> Iterator[Line]:
    """Yield the errata of a record, those that are in `shown` by their ids only."""
    for erratum in record["errata_explained"]:
        assumed = " (assumption)" if erratum["assumption"] else ""
        text = f"{erratum['what']} Read here: {erratum['reading']}{assumed}"
        yield from _labelled(erratum["id"], "see above" if erratum["id"] in shown else text)
        shown.add(erratum["id"])


# --- commands ---------------------------------------------------------------------------------------------------------


def command_text(record: Record, shown: set[str]) -> Iterator[Line]:
    """Yield a command or request in full; errata in `shown` were printed before, and those printed here are added."""
    dcon = record["protocol"] == "dcon"
    if shown:
        yield []
    shown.add(record["name"])
    yield _heading(record["name"], f": {record['title']}, {'DCON' if dcon else 'Modbus RTU'}", [record["section"]])
    yield from _labelled("", record["description"])
    yield from _labelled("command" if dcon else "request", record["syntax"], "bold")
    yield from _parameters(record["parameters"])
    response = record["response_syntax"]
    yield from _labelled("response", f"{response}  {record['response']}" if response else "none: it is for all modules")
    yield from _parameters(record["response_parameters"])
    if response:
        yield from _labelled("or", "?AA  Refused" if dcon else "an exception:")
    for exception in record["exceptions"]:
        yield from _labelled("", f"{exception['code']:02X}: {'; '.join(exception['when'])}")
    if record["broadcast"] and response:
        yield from _labelled("broadcast", "to address 0: all modules do it, none answers")
    yield from _labelled("models", _models(record))
    if record["pause"]:
        yield from _labelled("pause", _pause(record["pause"]))
    for example in record["examples"]:
        yield from _example("example", example, dcon=dcon)
    for example in record["refused"]:
        yield from _example("refused", example, dcon=dcon)
    yield from _errata(record, shown)


def _parameters(parameters: list[Record]) -> Iterator[Line]:
    for parameter in parameters:
        notation = f"  {parameter['notation']:<7} " if parameter["notation"] else "  "
        values = ", ".join(f"{value} {words}" for value, words in parameter["values"].items())
        meaning = (parameter["meaning"] or "").removesuffix(", see settings.json")  # which `values` have
        facts = (f"{parameter['name']}: {_range(parameter)}", meaning, values)
        yield from _labelled(notation, "; ".join(filter(None, facts)))


def _range(parameter: Record) -> str:
    if parameter["minimum"] is None:
        return f"{parameter['allowed']}"
    unit = parameter["unit"] or ""
    counts = " counts" if isinstance(parameter["scale"], list) else f" counts of {unit}"
    suffix = counts if unit[:1].isdigit() or parameter["scale"] else f" {unit}"
    return f"{parameter['minimum']}..{parameter['maximum']}{suffix}".rstrip()


def _models(record: Record) -> str:
    """Return the models that have a command, each with the firmware that it needs if older firmware lacks it."""
    since = [f"{model} from {firmware}" for model, firmware in record["models"].items() if firmware]
    named = models_words(map(Model, record["models"]), record["section"])
    return f"{named}: {', '.join(since)}" if since and " from " not in named else named


def _pause(pause: Record) -> str:
    limits = [
        f"{word} {pause[key]}" for key, word in (("firmware_from", "from"), ("firmware_to", "up to")) if pause[key]
    ]
    firmware = f", firmware {' '.join(limits)}" if limits else ""
    return f"{pause['seconds']:g} s {pause['what']}{firmware}"


def _example(label: str, example: Record, *, dcon: bool) -> Iterator[Line]:
    sent, answered = (example[key] for key in ("command_wire" if dcon else "request_wire", "response_wire"))
    text = f"{_frame(sent, dcon=dcon)} -> {_frame(answered, dcon=dcon) if answered else 'no response'}"
    checksum = ", with checksum" if example["checksum"] else ""
    yield from _labelled(label, text, "bold")
    yield from _labelled("", f"{example['comment']} ({example['model']}{checksum}; {example['source']})")


def _frame(wire: str, *, dcon: bool) -> str:
    data = bytes.fromhex(wire)
    return data[:-1].decode("ascii", "backslashreplace") if dcon else data.hex(" ").upper()


# --- registers --------------------------------------------------------------------------------------------------------


def register_text(record: Record, shown: set[str]) -> Iterator[Line]:
    """Yield a row of the maps in full; `shown` as for `command_text`."""
    if shown:
        yield []
    shown.add(record["name"])
    many = record["count"] > 1
    numbers = record["number"] + (f"..{record['last_number']}" if many else "")
    last = record["address"] + record["count"] - 1
    yield _heading(record["name"], f": {numbers}", record["sections"])
    yield from _labelled("", record["meaning"])
    yield from _labelled("address", f"{record['address']}" + (f"..{last}" if many else ""), "bold")
    yield from _labelled("access", f"{record['access']}, by function {' '.join(record['functions'])}")
    yield from _labelled("kind", record["kind"])
    if record["unit"]:
        yield from _labelled("unit", f"{record['scale']:g} {record['unit']} a count")
    if record["minimum"] is not None:
        yield from _labelled("range", _limits(record))
    for value, words in (record["values"] or {}).items():
        yield from _labelled("", f"{value}: {words}")
    if record["cleared_by"] is not None:
        yield from _labelled("writing", f"only {record['cleared_by']}, which clears it")
    yield from _labelled("models", ", ".join(record["models"]))
    yield from _errata(record, shown)


def _limits(record: Record) -> str:
    low, high = record["minimum"], record["maximum"]
    if record["scale"] in (None, 1):
        return f"{low}..{high}"
    return f"{low * record['scale']:g}..{high * record['scale']:g} {record['unit']}, counts {low}..{high}"


# --- errata -----------------------------------------------------------------------------------------------------------


def erratum_lines(record: Record) -> Iterator[Line]:
    """Yield the line of an erratum in a list: its id and subject."""
    yield from _labelled(f"{record['id']:<4} {record['sections'][0] if record['sections'] else ''}", record["what"])


def erratum_text(record: Record) -> Iterator[Line]:
    """Yield an erratum in full."""
    yield _heading(record["id"], "", record["sections"])
    yield from _labelled("what", record["what"])
    yield from _labelled("reading", record["reading"])
    yield from _labelled("evidence", record["evidence"])
    if record["assumption"]:
        yield from _labelled("assumption", "the manual does not support the reading, or a part of it, by itself")
    yield from _labelled("used by", ", ".join(record["used_by"]))
