"""The envelope of every DCON message: leading character, checksum, carriage return; streams (manual 2).

Laws: `seal` and `unseal` are each other's inverse. `split` never raises, never loses a byte, keeps less than one frame,
and takes time in proportion to what it is given, whatever that is.
"""

from i7000.arguments import as_bytes, check_type
from i7000.errors import DecodeError, Fault, Noise

__all__ = ["LONGEST_FRAME", "checksum", "seal", "split", "unseal"]

LONGEST_FRAME = 256
"""Bytes of a frame, carriage return included, beyond which it is noise. The longest of the manual has 144."""

COMMAND_LEADS = b"%#$~@"
RESPONSE_LEADS = b"!>?"
_LEADS = COMMAND_LEADS + RESPONSE_LEADS
_PRINTABLE = bytes(range(0x20, 0x7F))
_PLAIN = bytes(set(_PRINTABLE) - set(_LEADS))
_LEADS_AS_ONE = bytes.maketrans(_LEADS, b"!" * len(_LEADS))
_CR = 0x0D
_CHECKSUMS = tuple(b"%02X" % value for value in range(256))


def checksum(body: bytes) -> int:
    """Sum up the characters before the checksum, modulo 256.

    Special: the sum does not see characters change places: ``>+025.12`` and ``>+052.12`` have the same.
    Manual: 2.

    >>> f"{checksum(b'$012'):02X}"
    'B7'
    """
    return sum(as_bytes("body", body)) & 0xFF


def seal(body: bytes, *, checksum: bool) -> bytes:
    r"""Make a frame of a body: the checksum, if it is enabled, and a carriage return.

    >>> seal(b"$012", checksum=True)
    b'$012B7\r'
    """
    if checksum is not True:
        check_type("checksum", checksum, bool)
    return sealed(body if body.__class__ is bytes else as_bytes("body", body), checksum)


def sealed(body: bytes, checksum: bool) -> bytes:  # noqa: FBT001 - positional for speed
    """Make a frame of a body, as `seal` does, without a look at the arguments."""
    return body + _CHECKSUMS[sum(body) & 0xFF] + b"\r" if checksum else body + b"\r"


def unseal(frame: bytes, *, checksum: bool, leads: bytes = _LEADS) -> bytes:
    r"""Take the body out of exactly one frame, the checksum verified and removed if it is enabled.

    Errors: `DecodeError` with `Fault.LENGTH`, `TERMINATOR`, `CHARACTER`, `LEADING` (not one of `leads`) or `CHECKSUM`.

    >>> unseal(b"!0105060077\r", checksum=False)
    b'!0105060077'
    """
    if frame.__class__ is not bytes:
        frame = as_bytes("frame", frame)
    if leads.__class__ is not bytes:
        leads = as_bytes("leads", leads)
    if (
        frame.translate(None, _PRINTABLE) != b"\r"
        or frame[-1] != _CR
        or frame[0] not in leads
        or len(frame) > LONGEST_FRAME
    ):
        raise _damage(frame, leads)
    if checksum is not True:
        check_type("checksum", checksum, bool)
        return frame[:-1]
    body = frame[:-3]
    if _CHECKSUMS[sum(body) & 0xFF] != frame[-3:-1] or not body:
        if len(frame) <= len("!FF"):
            raise DecodeError(
                Fault.LENGTH, frame, len(frame) - 1, allowed="a leading character and a checksum at least", section="2"
            )
        raise DecodeError(
            Fault.CHECKSUM, frame, len(body), field="checksum", allowed=f"{sum(body) & 0xFF:02X}", section="2"
        )
    return body


def _damage(frame: bytes, leads: bytes) -> DecodeError:
    if not frame or len(frame) > LONGEST_FRAME:
        offset = min(len(frame), LONGEST_FRAME)
        return DecodeError(Fault.LENGTH, frame, offset, allowed=f"1 to {LONGEST_FRAME} bytes", section="2")
    end = frame.find(b"\r")
    if end != len(frame) - 1:
        offset = len(frame) if end < 0 else end
        return DecodeError(Fault.TERMINATOR, frame, offset, allowed="one carriage return, at the end", section="2")
    strange = frame.translate(None, _PRINTABLE)[:1]
    offset = frame.index(strange)
    if offset != end:
        return DecodeError(Fault.CHARACTER, frame, offset, allowed="characters 20h..7Eh", section="2")
    return DecodeError(Fault.LEADING, frame, 0, allowed=" ".join(leads.decode()), section="2")


def split(buffer: bytes, *, checksum: bool = False) -> tuple[tuple[bytes | Noise, ...], bytes]:
    r"""Split what a line delivered into whole frames, noise and the rest that may still become a frame.

    Shape: a frame runs from a leading character to the next carriage return, all printable and no second leading
        character between, in at most `LONGEST_FRAME` bytes. The rest is shorter than that; call again with the rest
        and what came next. Any chunking gives the same frames and the same bytes of noise between them.
    Special: with `checksum`, a frame whose checksum is wrong is noise.
    Manual: 2; E102.

    >>> split(b"\xff!01\r>+02")
    ((Noise(wire=b'\xff', fault=<Fault.LEADING: 'leading'>), b'!01\r'), b'>+02')
    """
    if buffer.__class__ is not bytes:
        buffer = as_bytes("buffer", buffer)
    if checksum is not True:
        check_type("checksum", checksum, bool)
    *lines, rest = buffer.split(b"\r")
    found: list[bytes | Noise] = []
    line_at = noise_at = 0
    for line in lines:
        # A frame and nothing else: one leading character, the first, is all that is left without the plain ones.
        if line.translate(None, _PLAIN) == line[:1] != b"" and line[0] in _LEADS and len(line) < LONGEST_FRAME:
            start = line_at
        else:
            start = line_at + _start(line)
        line_at += len(line) + 1
        if start == line_at - 1:
            continue
        if noise_at < start:
            found.append(_noise(buffer[noise_at:start]))
        frame = buffer[start:line_at]
        if checksum and _CHECKSUMS[sum(frame[:-3]) & 0xFF] != frame[-3:-1]:
            found.append(Noise(frame, Fault.CHECKSUM))
        else:
            found.append(frame)
        noise_at = line_at
    start = line_at + _start(rest)
    if noise_at < start:
        found.append(_noise(buffer[noise_at:start]))
    return tuple(found), buffer[start:]


def _start(line: bytes) -> int:
    """Where in a line without a carriage return the frame that may end it starts: at its end if there is none."""
    start = line.translate(_LEADS_AS_ONE).rfind(b"!")
    frame = line[start:]
    return len(line) if start < 0 or len(frame) >= LONGEST_FRAME or frame.translate(None, _PRINTABLE) else start


def _noise(wire: bytes) -> Noise:
    """Name what is wrong with the first of the bytes that are no frame."""
    if wire[0] not in _LEADS:
        return Noise(wire, Fault.LEADING)
    damage = wire.translate(None, _PLAIN)[1:2]
    if (wire.index(damage, 1) if damage else len(wire)) >= LONGEST_FRAME:
        return Noise(wire, Fault.LENGTH)
    return Noise(wire, Fault.TERMINATOR if damage in _LEADS else Fault.CHARACTER)
