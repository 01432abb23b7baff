"""What ``i7000 decode`` prints for people: a frame in lines."""

from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import groupby
from operator import attrgetter

from i7000 import Protocol, Status, describe
from i7000.cli.readers import Read
from i7000.cli.records import OPTIONS, VALUES, wrong_words
from i7000.cli.text import Line
from i7000.dissect import Item, Meaning, Origin, Place
from i7000.dissect.words import models_words

__all__ = ["frame_lines"]

_INDENT = "     "


def frame_lines(read: Read, *, models: bool) -> Iterator[Line]:
    """Yield the meaning of a frame in lines; with `models`, also the models that it fits."""
    for at, text in enumerate(read.text.split("\n")):
        yield [(f"{read.line + at:<4} ", ""), (text, "bold")]
    heard = read.heard
    if heard is None:
        yield _row("note", read.note or "")
        return
    if heard.error is not None:
        yield [(f"{_INDENT}not understood: {wrong_words(heard)}", "red")]
    known = heard.meanings if len(heard.meanings) == 1 else ()
    short = len(heard.wire) <= _SHORT
    for meaning in known:
        yield from _answering(meaning, heard.answers, models=models, short=short)
    for count, meaning in enumerate((*(() if known else heard.meanings), *heard.candidates)):
        yield [(_INDENT + ("or" if count else "could be"), "")]
        yield from _answering(meaning, heard.answers, models=models, short=short)
    for contradiction in heard.contradictions:
        yield [(f"{_INDENT}  {'contradiction':<15} ", "dim"), (contradiction, "red")]
    for note in heard.notes:
        yield _row("note", note)


_REMEMBERED = 256
"""Meanings of which the lines are kept."""
_SHORT = 128
"""Bytes of a frame up to which they are kept: those of a frame full of coils are many."""


def _answering(meaning: Meaning, answers: Place | None, *, models: bool, short: bool) -> Iterator[Line]:
    head, *rows = (_remembered_lines if short else _meaning_lines)(meaning, models)
    yield head
    if meaning.command is not None:
        yield _row("answers", f"{type(meaning.command).__name__}{f', {answers.where}' if answers else ''}")
    yield from rows


def _meaning_lines(meaning: Meaning, models: bool) -> tuple[Line, ...]:  # noqa: FBT001 - a key of what is remembered
    return tuple(_lines(meaning, models=models))


_remembered_lines = lru_cache(maxsize=_REMEMBERED)(_meaning_lines)


def _lines(meaning: Meaning, *, models: bool) -> Iterator[Line]:
    source = f"manual {meaning.section}" + (f"; {' '.join(meaning.errata)}" if meaning.errata else "")
    yield [(_INDENT, ""), (type(meaning.message).__name__, "cyan"), (f": {meaning.message.title} ({source})", "")]
    elsewhere = VALUES if meaning.items or meaning.protocol is Protocol.DCON else ()
    for name, _, text in meaning.fields:
        if name not in elsewhere:
            yield _row(name, text)
    yield from _items(meaning.items)
    yield from _readings(meaning)
    if meaning.data_formats:
        yield _row("format", " or ".join(it.name.lower() for it in meaning.data_formats))
    if meaning.checksum:
        yield _row("checksum", "right")
    if meaning.pause:
        yield _row("pause", f"{meaning.pause:g} s before the next command")
    if models:
        yield _row("models", models_words(meaning.models, meaning.section))


def _row(name: str, words: str) -> Line:
    return [(f"{_INDENT}  {name:<15} ", "dim"), (words, "")]


def _readings(meaning: Meaning) -> Iterator[Line]:
    readings = meaning.readings
    for channel, text, status, _, value, unit in readings:
        line = _row("channel" if channel is None else f"channel {channel}", f"{text:7}")
        if status is Status.OK:
            line.append((f"  {value:.7g} {unit}", "green"))
        elif status is not None:
            line.append((f"  {status.value.upper()}", "yellow"))
        yield line
    for code in sorted({it.type_code for it in readings if it.type_code is not None}):
        yield _row("type", describe.type_code(code))
    if any(it.status is None and it.type_code is None for it in readings):
        refuted = next((fact.where for fact in meaning.refuted if fact.name == "types"), None)
        yield _row("type", "unknown: give --type" if refuted is None else f"unknown: not the one that {refuted} said")
    assumed = (fact for fact in meaning.facts if fact.origin is Origin.ASSUMED)
    for where, group in groupby(assumed, attrgetter("where")):
        names = " and ".join(OPTIONS[fact.name].replace("_", " ") for fact in group)
        words = f"{names} as the broadcast of {where} set" if where else f"the factory default of {names}"
        yield _row("assumed", words)


def _items(items: Iterable[Item]) -> Iterator[Line]:
    """Yield registers with their values; those without, or with readings that are shown, in ranges."""
    for (name, text, _), group in groupby(items, _in_range):
        first, *others = group
        number = first.number + (f"..{others[-1].number}" if others else "")
        channel = "" if others or first.channel is None else f" {first.channel}"
        words = "  ".join(filter(None, ((name or "") + channel, text)))
        label, style = _row(number, "")[0]
        yield [(label, style), (words, "")] if words else [(label.rstrip(), style)]


def _in_range(item: Item) -> tuple[str | None, str | None, int | None]:
    """Return what registers of one line have in common."""
    if item.reading is not None:
        return item.name, None, None
    return item.name, item.text, None if item.value is None else int(item.number)
