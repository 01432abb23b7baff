"""What the first bytes of an input select: a profile, a command, the cuts of a stream.

Laws: the meaning of an input never changes, because regressions are kept as inputs. New choices go to the end of a
table, or into unused bits.
"""

from collections.abc import Iterator
from functools import lru_cache

from i7000 import (
    DataFormat,
    EncodeError,
    Firmware,
    ModbusDataFormat,
    Model,
    Profile,
    TypeCode,
)

__all__ = ["FIRMWARES", "HEADER", "MODELS", "header", "pieces", "profile_of"]

MODELS = tuple(Model)
FIRMWARES = (None, Firmware("B1.4"), Firmware("B2.6"), Firmware("B3.6"))
HEADER = 3
"""The bytes that select a profile."""
_FORMATS = tuple(DataFormat)
_TYPES = tuple(TypeCode)


def profile_of(data: bytes) -> Profile:
    """Return the profile that the first three bytes select; missing bytes count as zero."""
    model, settings, types = (*data[:HEADER], 0, 0, 0)[:HEADER]
    return _profile(model % len(MODELS), settings, types % len(_TYPES))


@lru_cache(maxsize=1 << 17)  # nearly all there are: making one takes longer than a target
def _profile(model: int, settings: int, types: int) -> Profile:
    """Return a profile; what its model does not have is left out, type codes first."""
    common = {
        "firmware": FIRMWARES[settings >> 4 & 3],
        "data_format": _FORMATS[(settings & 3) % len(_FORMATS)],
        "checksum": bool(settings & 4),
    }
    modbus_format = ModbusDataFormat(settings >> 6 & 1)
    kind = MODELS[model]
    for single_ended in ({"single_ended": True}, {}) if settings & 8 else ({},):
        for engineering in ({"modbus_data_format": modbus_format}, {}):
            base = common | single_ended | engineering
            try:
                plain = Profile(kind, **base)  # type: ignore[arg-type] # a table of keywords
            except EncodeError:
                continue
            one = _TYPES[types]
            other = next((code for code in _TYPES if plain.supports(code)), one)
            mixed = (one, *[other] * (plain.channels - 1)) if settings & 0x80 else (one,) * plain.channels
            try:
                return Profile(kind, type_codes=mixed, **base)  # type: ignore[arg-type]
            except EncodeError:
                return plain
    raise AssertionError(f"{kind} has no profile")


def header(profile: Profile) -> bytes:
    """Return the bytes that select the profile that is most like this one: what the seeds begin with."""
    firmware = FIRMWARES.index(profile.firmware) if profile.firmware in FIRMWARES else 0
    settings = _FORMATS.index(profile.data_format) | profile.checksum << 2 | profile.single_ended << 3
    settings |= firmware << 4 | profile.modbus_data_format.value << 6 | (len(set(profile.type_codes)) > 1) << 7
    types = _TYPES.index(profile.type_codes[0]) if profile.type_codes else 0
    return bytes((MODELS.index(profile.model), settings, types))


_MOST_PIECES = 16


def pieces(data: bytes, cut: int) -> Iterator[bytes]:
    """Cut data into pieces of `cut` bytes, the first one shorter by a half; long data into larger pieces."""
    size = max(1, cut, len(data) // _MOST_PIECES)
    first = max(1, size // 2)
    yield data[:first]
    for at in range(first, len(data), size):
        yield data[at : at + size]
