"""The frame around every DCON message: leading character, checksum, carriage return; streams (manual 2).

Laws: `unseal` is the inverse of `seal`. `split` never raises and never loses a byte. It keeps less than one frame, and
its time is proportional to the input.
"""

from i7000.arguments import as_bytes, check_type
from i7000.errors import DecodeError, Fault, Noise

__all__ = ["LONGEST_FRAME", "checksum", "seal", "split", "unseal"]

LONGEST_FRAME = 256
"""The maximum length of a frame in bytes, carriage return included; the longest in the manual has 144."""

COMMAND_LEADS = b"%#$~@"
RESPONSE_LEADS = b"!>?"
_LEADS = COMMAND_LEADS + RESPONSE_LEADS
_PRINTABLE = bytes(range(0x20, 0x7F))
_PLAIN = bytes(set(_PRINTABLE) - set(_LEADS))
_LEADS_AS_ONE = bytes.maketrans(_LEADS, b"!" * len(_LEADS))
_CR = 0x0D
_CHECKSUMS = tuple(b"%02X" % value for value in range(256))


def checksum(body: bytes) -> int:
    """Compute the checksum: the sum of the characters before it, modulo 256.

    Special: swapped characters do not change the sum: ``>+025.12`` and ``>+052.12`` have the same.
    Manual: 2.

    >>> f"{checksum(b'$012'):02X}"
    'B7'
    """
    return sum(as_bytes("body", body)) & 0xFF


def seal(body: bytes, *, checksum: bool) -> bytes:
    r"""Make a frame from a body: append the checksum, if enabled, and a carriage return.

    >>> seal(b"$012", checksum=True)
    b'$012B7\r'
    """
    if checksum is not True:
        check_type("checksum", checksum, bool)
    return sealed(body if body.__class__ is bytes else as_bytes("body", body), checksum)


def sealed(body: bytes, checksum: bool) -> bytes:  # noqa: FBT001 - positional for speed
    """Make a frame from a body, as `seal` does, without checking the arguments."""
    return body + _CHECKSUMS[sum(body) & 0xFF] + b"\r" if checksum else body + b"\r"


def unseal(frame: bytes, *, checksum: bool, leads: bytes = _LEADS) -> bytes:
    r"""Return the body of exactly one frame; verify and remove the checksum, if enabled.

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
                Fault.LENGTH, frame, len(frame) - 1, allowed="at least a leading character and a checksum", section="2"
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
    return DecodeError(Fault.LEADING, frame, allowed=" ".join(leads.decode()), section="2")


def split(buffer: bytes, *, checksum: bool = False) -> tuple[tuple[bytes | Noise, ...], bytes]:
    r"""Split received bytes into complete frames, noise, and the rest that may still become a frame.

    Shape: a frame runs from a leading character to the next carriage return, all printable and no second leading
        character between, in at most `LONGEST_FRAME` bytes. The rest is shorter than that. Call again with the rest
        followed by the next bytes. Any chunking gives the same frames and the same noise bytes between them.
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
    """Return the start of a frame that may still be incomplete, in a line without a carriage return; else the end."""
    start = line.translate(_LEADS_AS_ONE).rfind(b"!")
    frame = line[start:]
    return len(line) if start < 0 or len(frame) >= LONGEST_FRAME or frame.translate(None, _PRINTABLE) else start


def _noise(wire: bytes) -> Noise:
    """Return the noise at the beginning, with its fault."""
    if wire[0] not in _LEADS:
        return Noise(wire, Fault.LEADING)
    damage = wire.translate(None, _PLAIN)[1:2]
    if (wire.index(damage, 1) if damage else len(wire)) >= LONGEST_FRAME:
        return Noise(wire, Fault.LENGTH)
    return Noise(wire, Fault.TERMINATOR if damage in _LEADS else Fault.CHARACTER)
