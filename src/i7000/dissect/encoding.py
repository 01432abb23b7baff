"""The encoding of a text file, from its first bytes: a byte order mark, or NULs where letters of UTF-16 have them."""

from codecs import (
    BOM_UTF8,
    BOM_UTF16_BE,
    BOM_UTF16_LE,
    BOM_UTF32_BE,
    BOM_UTF32_LE,
    IncrementalDecoder,
    getincrementaldecoder,
)

__all__ = ["decoder_for", "encoding_of"]

_MARKS = (
    (BOM_UTF8, "utf-8-sig"), (BOM_UTF32_LE, "utf-32"), (BOM_UTF32_BE, "utf-32"), (BOM_UTF16_LE, "utf-16"),
    (BOM_UTF16_BE, "utf-16"),
)  # fmt: skip
"""UTF-32 comes before UTF-16, with which its mark begins."""
_LETTERS = 4
"""Bytes of two letters, from which on NULs say UTF-16."""


def encoding_of(beginning: bytes) -> str:
    """Return the encoding of a text that begins with these bytes, by the name that Python has for it.

    Special: UTF-8 where nothing else is certain. Without a mark, UTF-16 is a text whose every other byte is NUL, in the
        first 64 bytes; a text of another alphabet needs its mark.

    >>> encoding_of("TX: $012".encode("utf-16-le")), encoding_of(b"TX: $012")
    ('utf-16-le', 'utf-8')
    """
    for mark, name in _MARKS:
        if beginning.startswith(mark):
            return name
    even, odd = beginning[0:64:2], beginning[1:64:2]
    if len(beginning) >= _LETTERS:
        if not odd.strip(b"\0") and 0 not in even:
            return "utf-16-le"
        if not even.strip(b"\0") and 0 not in odd:
            return "utf-16-be"
    return "utf-8"


def decoder_for(beginning: bytes) -> IncrementalDecoder:
    """Return a decoder for a text that begins with these bytes, which it is to be given first.

    Special: it never raises. Bytes that are not UTF-8 become lone surrogates, as files have them in Python; what is not
        UTF-16 or UTF-32 becomes U+FFFD.

    >>> decoder_for(beginning := "TX: $012".encode("utf-16")).decode(beginning)
    'TX: $012'
    """
    name = encoding_of(beginning)
    return getincrementaldecoder(name)("surrogateescape" if name.startswith("utf-8") else "replace")
