r"""The ways in which people and programs spell bytes, and the runs of bytes that a line of text spells.

A run is bytes that follow one another in one way of spelling, each with its place in the line. Nothing is decided here:
a line usually spells several runs of which few are frames, and the finder keeps those that are.

Laws: every run is in the order of the line; no reader takes the same characters twice.
"""

import re
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from i7000.dissect.patterns import pattern

__all__ = [
    "DIRECTIONS",
    "UNITS",
    "Byte",
    "Run",
    "decimal_runs",
    "hex_runs",
    "in_url",
    "literal_runs",
    "loose_hex_runs",
    "text_of",
    "wire_of",
    "without_numbers",
]


class Byte(NamedTuple):
    """A byte that a line spells."""

    value: int
    start: int
    end: int
    """Where in the line its spelling begins and ends."""
    word: int
    """How many bytes are written in one word with it: 1 in ``01 04``, 2 in ``0104``."""


Run = list[Byte]


def wire_of(run: Run) -> bytes:
    """Return the bytes of a run."""
    return bytes([byte[0] for byte in run])


_DATE = r"\d{3}([-/.])\d\d?\1\d\d?|\d?([/.])\d\d?\2\d{2,4}"
_TIME = r"\d?:\d\d(?::\d\d(?:[.,:]\d+)?)?(?:Z|[-+]\d\d:?\d\d)?"
DIRECTIONS = (
    r"tx|rx|sent|send|recv|received?|writ(?:e|ten)|read|re(?:quest|sponse|ply)|query|answer|command|out|in|host|master"
    r"|slave"
)
"""Words for the direction of a frame."""
UNITS = r"ms|us|s|sec|seconds?|bytes?|chars?|characters?"
_NUMBERS = pattern(
    rf"\d(?:(?<![\w:.\-/].)(?:(?:{_DATE})(?:[T_ ]+\d{_TIME})?|{_TIME}|\d*\.\d+)(?!\w|[:.\-/]\w)"
    rf"|(?<!\w.)\d*(?=\s?(?:{UNITS})\b))",
    re.DOTALL,
)
"""Dates, times, decimal fractions, and numbers with a unit: they look like bytes, and are not.

All begin with a digit, which the search for them is quick to find; the patterns of dates and times are without it.
"""
_OFFSET = pattern(
    r"\s*(?:(?:0x)?[0-9A-Fa-f]{4,16}(?=(?::\s|\s\s)\s*[0-9A-Fa-f]{2})|[0-9A-Fa-f]{6,8}(?=\s[0-9A-Fa-f]{2}(?:\s|$))"
    r"|\d+-\d+(?=\s+[^\W\d]{3}))"
)
"""The offset at the start of a row of a dump, or the samples that a byte takes: ``1000-1009 UART``."""


def without_numbers(text: str) -> str:
    """Cross out dates, times and offsets by letters, so that no run goes through them."""
    offset = _OFFSET.match(text)
    if offset:
        text = "z" * offset.end() + text[offset.end() :]
    return _NUMBERS.sub(lambda found: "z" * len(found[0]), text)


_HEX = pattern(
    r"[0-9A-Fa-f\\&xX](?:(?<=\\)(?:[xX]\{?|u00)([0-9A-Fa-f]{2})\}?"
    r"|(?<![0-9A-Za-z].)(?:(?<=0)[xX]|(?<=&)[hH]|(?<=1)6#)((?:[0-9A-Fa-f]{2})+)[hHuU]?(?![0-9A-Za-z])"
    r"|(?<![0-9A-Za-z].)(?<=0)[xX]([0-9A-Fa-f])[uU]?(?![0-9A-Za-z])"
    r"|(?<=[xX])(?:(?<![0-9A-Za-z\\].)(?=..[xX][0-9A-Fa-f]{2})|(?<=[xX][0-9A-Fa-f]{2}.))([0-9A-Fa-f]{2})"
    r"(?=[xX][0-9A-Fa-f]{2}|(?![0-9A-Za-z]))"
    r"|(?<![0-9A-Za-z].)(?<=[0-9A-Fa-f])[0-9A-Fa-f](?:[0-9A-Fa-f]{2})*[hHuU]?(?![0-9A-Za-z]))",
    re.DOTALL,
)
"""A word of bytes; it begins with a set of characters, which the search then passes over the others for."""
_LOOSE_HEX = pattern(r"(?<![0-9A-Za-z])(?:0[xX])?([0-9A-Fa-f]{1,2})[hH]?(?![0-9A-Za-z])")
_DECIMAL = pattern(r"(?<![0-9A-Za-z])((?:(?<=[\s,;\[{(])-)?\d{1,3})(?![0-9A-Za-z])")
_SHOWN = pattern(r"(?:(?<!\S)[!-~])?\((\d{3})\)(?![0-9A-Za-z(])")
"""A byte as a character and in decimal: ``a(097)``."""
_BETWEEN = pattern(r"[\W_]{0,8}|[\W_]{1,4}(?:CRC|crc)(?:16)?[\W_]{1,4}|\s?\(.\)[\W_]{0,4}|\)\s?\w\s?\(")
"""What can stand between two bytes: a few characters, among them one in brackets that shows a byte as text."""
_USUALLY_BETWEEN = frozenset((" ", "", ":", ", ", "-", ",", "  ", "][", "><"))
_IN_A_ROW = pattern(r"[0-9A-Fa-f][hH]?(?:[\W_]{1,8}(?:0[xX])?[0-9A-Fa-f]{1,3}[hH]?){3}")
"""Numbers enough for a frame."""


def hex_runs(text: str) -> Iterator[Run]:
    r"""Find bytes of two hex digits: ``01 04``, ``0104``, ``0x1``, ``01h``, ``[01]``, ``\x01``, with anything between.

    >>> [[byte.value for byte in run] for run in hex_runs("TX [01][04], then 0x1F")]
    [[1, 4], [31]]
    """
    return _runs(text, _HEX, _pairs)


def loose_hex_runs(text: str) -> Iterator[Run]:
    """Find bytes of one or two hex digits: ``1 4 0 CA``."""
    return _runs(text, _LOOSE_HEX, lambda word: _one(word, 16)) if _IN_A_ROW.search(text) else iter(())


def decimal_runs(text: str) -> Iterator[Run]:
    """Find bytes in decimal: ``1-4-0``, ``[1, 4, 0]``, ``[001][004]``, ``a(097)``; signed bytes too: ``[1, -54]``."""
    if _SHOWN.search(text):
        return _runs(text, _SHOWN, lambda word: _one(word, 10))
    return _runs(text, _DECIMAL, lambda word: _one(word, 10)) if _IN_A_ROW.search(text) else iter(())


def _runs(text: str, words: re.Pattern[str], read: Callable[[re.Match[str]], Run]) -> Iterator[Run]:
    run: Run = []
    end = 0
    for word in words.finditer(text):
        start = word.start()
        if run and text[end:start] not in _USUALLY_BETWEEN and not _BETWEEN.fullmatch(text, end, start):
            yield run
            run = []
        read_bytes = read(word)
        if not read_bytes and run:
            yield run
            run = []
        run += read_bytes
        end = word.end()
    if run:
        yield run


def _pairs(word: re.Match[str]) -> Run:
    start, last = word.span()
    group = word.lastindex
    digits = word[group] if group else word[0].rstrip("hHuU")
    if len(digits) <= len("FF"):
        return [Byte(int(digits, 16), start, last, 1)]
    start = word.start(group or 0)
    count = len(digits) // 2
    ends = [start + 2 * at + 2 for at in range(count - 1)] + [last]
    return [Byte(value, start + 2 * at, ends[at], count) for at, value in enumerate(bytes.fromhex(digits))]


def _one(word: re.Match[str], base: int) -> Run:
    value = int(word[1], base)
    return [Byte(value & 0xFF, *word.span(), 1)] if -0x80 <= value <= 0xFF else []


# --- text with escapes ------------------------------------------------------------------------------------------------

_LETTERS = {
    "a": 7, "b": 8, "t": 9, "n": 10, "v": 11, "f": 12, "r": 13, "e": 27, "s": 32,
    "\\": 0x5C, "'": 0x27, '"': 0x22,
}  # fmt: skip
_C = pattern(
    r"(?s)\\x([0-9A-Fa-f]{1,2})|\\u(?:00(?=[0-9A-Fa-f]{2})|\{(?=[0-9A-Fa-f]{1,2}\}))([0-9A-Fa-f]{1,2})"
    r"(?:(?<=\{.)\}|(?<=\{..)\})?|\\([0-7]{1,3})|\\([abtnvfres\\'\"])|(.)"
)
_LABVIEW = pattern(r"(?s)\\x([0-9A-Fa-f]{2})|\\([0-9A-F]{2})|(?!)()|\\([btnfrs\\])|(.)")
_PERCENT = pattern(r"%[0-9A-Fa-f]{2}(?:%[0-9A-Fa-f]{2}|[0-9A-Za-z_.~*+-])+")
"""Bytes as URLs write them: letters and digits stand for themselves."""
_ESCAPED = pattern(r"(?s)%([0-9A-Fa-f]{2})|(?!)()()()|(.)")
_QUOTES = pattern(r"""(?s)\\.|["'`]""")
_BARE = pattern(r"\\.*\\[^\s\"'`\])}>,;]*")
"""Characters from the first escape to the end of the last."""


def literal_runs(text: str) -> Iterator[tuple[Run, bool]]:
    r"""Find the bytes of strings with escapes, and whether they are in quotes and not those of LabVIEW.

    >>> [bytes(byte.value for byte in run) for run, usual in literal_runs(r'write(3, "\1\4\0b", 4) = 4') if usual]
    [b'\x01\x04\x00b']
    """
    if "%" in text:
        for found in _PERCENT.finditer(text):
            yield [_character(one, 16) for one in _ESCAPED.finditer(text, *found.span())], False
    if "\\" not in text:
        return
    spans = [(start, end) for start, end in _quoted(text) if text.find("\\", start, end) >= 0]
    bare = None if spans else _BARE.search(text)
    if bare:
        spans = [bare.span()]
    for start, end in spans:
        for escapes in (_C, _LABVIEW):
            run = [_character(one, 8 if escapes is _C else 16) for one in escapes.finditer(text, start, end)]
            if run and all(byte.value <= 0xFF for byte in run):
                yield run, escapes is _C and not bare


def _quoted(text: str) -> Iterator[tuple[int, int]]:
    """Find what stands in quotes; one that is never closed is an apostrophe."""
    marks = {"'", '"', "`"}
    at = 0
    while True:
        opened, start = "", at
        for mark in _QUOTES.finditer(text, at):
            if not opened and mark[0] in marks:
                opened, start = mark[0], mark.end()
            elif mark[0] == opened:
                yield start, mark.start()
                opened, at = "", mark.end()
        if not opened:
            return
        marks.discard(opened)


def _character(one: re.Match[str], base: int) -> Byte:
    digits = one[1] or one[2]
    if digits:
        value = int(digits, 16)
    elif one[3]:
        value = int(one[3], base)
    else:
        value = _LETTERS[one[4]] if one[4] else ord(one[5])
    return Byte(value, *one.span(), 1)


_BEHIND = r"""(?: (?<=[0-9A-Za-z*]) | (?<=[0-9A-Z]["']) )"""
"""Where ``#13`` is a carriage return: elsewhere it is a command to module 13h."""
_ENDS = rf"""
    (?: (?<=\S) [ ] )? [(<\[{{] (?: CR | cr | Cr ) [)>\]}}] | [<\[{{(] (?:0x)? 0?[dD] [>\]}})] | \\x0[dD] | \\u000[dD]
    | \\015 | \\13 (?!\d) | \\0D | \\r | \^M | {_BEHIND} \#13 (?!\d) | &\#(?:13|[xX]0?[dD]);
    | %0[dD] (?! [0-9A-F]{{8}} ) | \u240d | \u21b5 | \$(?:0D|[Rr]) (?![0-9A-Za-z]) | \r
"""
_LINE_FEEDS = rf"""
    [(<\[{{] (?: LF | lf | Lf | NL ) [)>\]}}] | [<\[{{(] (?:0x)? 0?[aA] [>\]}})] | \\x0[aA] | \\u000[aA] | \\012
    | \\10 (?!\d) | \\0A | \\n | \^J | {_BEHIND} \#10 (?!\d) | &\#(?:10|[xX]0?[aA]);
    | %0[aA] (?! [0-9A-F]{{8}} ) | \u240a | \$[LlNn] (?![0-9A-Za-z]) | \n
"""
_CHARACTER = rf"""
    (?P<end>{_ENDS}) | (?P<feed>{_LINE_FEEDS})
    | \\x(?P<hex>[0-9A-Fa-f]{{2}}) | \\u00(?P<unicode>[0-9A-Fa-f]{{2}}) | \\(?P<octal>[0-3][0-7]{{2}})
    | &\#(?P<decimal>\d{{2,3}}); | &\#[xX](?P<entity>[0-9A-Fa-f]{{2}});
    | (?P<blank>\\s|\u2420|&nbsp;|\u00b7) | (?P<greater>&gt;)
"""
_ENCODED = r"(?:2[1345]|3[EFef]|40|7[Ee])"
_LEADING_IN_URL = rf"%{_ENCODED} (?: (?<=[=/?&]...) | (?= [^\s%]* %(?:0[Dd]|2[0ABDEabde]|3[Ee]) ) )"
"""A character that begins a frame, as URLs write it: behind what is before a value, or with another one after it."""
_SPELLED = pattern(f"(?sx) {_CHARACTER}")
_SPELLED_IN_URL = pattern(
    rf"(?sx) {_CHARACTER} | (?={_LEADING_IN_URL}) %(?P<lead>{_ENCODED}) | (?<=[0-9A-Za-z]) %(?P<inside>2[0ABDEabde])"
)
_URL = pattern(f"(?x) {_LEADING_IN_URL}")
_MAY_SPELL = pattern(r"[\\\r\n^&%\u00b7\u21b5\u2400-\u2426]|#1|\$[0RrLlNn]|[(<\[{][CcLlN0aAdD]")
"""How all of these begin."""
_CHARACTERS = {"end": "\r", "feed": "\n", "blank": " ", "greater": ">"}
_BASES = {"octal": 8, "decimal": 10}


def in_url(text: str) -> bool:
    """Return whether a line has the first character of a frame as URLs write it: ``cmd=%23012``, ``%23012%0D``."""
    return "%" in text and bool(_URL.search(text))


def text_of(text: str, *, url: bool = False) -> tuple[str, Sequence[int]]:
    r"""Replace every way to write a carriage return, a line feed, a blank and other characters by the character.

    Shape: the characters, and where each begins in `text`; one place more is the end of `text`. With `url`, also the
        characters that URLs encode. Bytes that are not ASCII are as `surrogateescape` decodes them.

    >>> text_of("#01<CR>")[0]
    '#01\r'
    >>> text_of("cmd=%2301%0D", url=True)[0]
    'cmd=#01\r'
    """
    if not _MAY_SPELL.search(text):
        return text, range(len(text) + 1)
    characters: list[str] = []
    places: list[int] = []
    at = 0
    for found in (_SPELLED_IN_URL if url else _SPELLED).finditer(text):
        kind = found.lastgroup or ""
        digits = found[kind]
        plain = _CHARACTERS.get(kind) or _plain(int(digits, _BASES.get(kind, 16)))
        characters += (text[at : found.start()], plain)
        places += range(at, found.start() + 1)
        at = found.end()
    if not at:
        return text, range(len(text) + 1)
    return "".join((*characters, text[at:])), [*places, *range(at, len(text) + 1)]


def _plain(code: int) -> str:
    """Return the character of a code; of a byte that is not ASCII, the one that `surrogateescape` decodes it to."""
    return chr(0xDC00 + code if 0x80 <= code <= 0xFF else code)
