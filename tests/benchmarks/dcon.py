"""DCON against hand-written floors: tight functions of `%`, slices, `float` and `sum`, no objects."""

import random
from collections.abc import Iterator

from i7000 import Model, Profile, TypeCode, dcon
from tests.benchmarks.timing import Result, at_least, at_most, best_times

LINE = b">+025.12+020.45+012.78+018.97+003.24+015.35+008.07+014.79"
FRAME = dcon.seal(LINE, checksum=True)


def floor_encode_read(address: int) -> bytes:
    body = b"#%02X" % address
    return body + b"%02X\r" % (sum(body) & 0xFF)


def floor_encode_offset(address: int, offset: int) -> bytes:
    body = b"$%02X9%c%04X" % (address, 43 if offset >= 0 else 45, abs(offset))
    return body + b"%02X\r" % (sum(body) & 0xFF)


def floor_decode_readings(frame: bytes) -> list[float]:
    if sum(frame[:-3]) & 0xFF != int(frame[-3:-1], 16):
        raise ValueError(frame)
    return [float(frame[at : at + 7]) for at in range(1, 57, 7)]


def codec_results() -> Iterator[Result]:
    """Encode two commands; decode the response to #AA into eight readings."""
    profile = Profile(Model.I_7017, type_codes=(TypeCode.MV_500_0B,) * 8, checksum=True)
    thermocouples = Profile(Model.I_7018, checksum=True)
    read, offset = dcon.ReadAnalogInputs(0x01), dcon.SetCjcOffset(0x01, 16)

    def decode() -> object:
        response = dcon.decode_response(FRAME, read, profile)
        return dcon.readings(response, profile) if isinstance(response, dcon.AnalogInputs) else None

    times = best_times(
        {
            "encode #AA": lambda: dcon.encode(read, profile),
            "floor #AA": lambda: floor_encode_read(0x01),
            "encode $AA9": lambda: dcon.encode(offset, thermocouples),
            "floor $AA9": lambda: floor_encode_offset(0x01, 16),
            "decode": decode,
            "floor decode": lambda: floor_decode_readings(FRAME),
        }
    )
    yield at_least("command #AA -> frame with checksum, of the floor", times["encode #AA"], times["floor #AA"], 0.4)
    yield at_least("command $AA9SNNNN -> frame, of the floor", times["encode $AA9"], times["floor $AA9"], 0.4)
    yield at_least("response -> 8 readings, of the floor's 8 floats", times["decode"], times["floor decode"], 0.4)


def split_all(stream: bytes, size: int) -> int:
    """Feed a stream in pieces and count the frames."""
    found = 0
    rest = b""
    for at in range(0, len(stream), size):
        frames, rest = dcon.split(rest + stream[at : at + size])
        found += sum(isinstance(frame, bytes) for frame in frames)
    return found


def splitter_results() -> Iterator[Result]:
    """Check that the splitter's cost is linear in what it is fed: one large call, small ones, single bytes, noise."""
    count = (1 << 20) // len(FRAME)
    stream = FRAME * count
    noise = random.Random(7000).randbytes(len(stream))
    for size in (len(stream), 1 << 16, 64, 1):
        assert split_all(stream[: 1 << 17], size) == (1 << 17) // len(FRAME)
    times = best_times(
        {
            "one call": lambda: split_all(stream, len(stream)),
            "64 KB": lambda: split_all(stream, 1 << 16),
            "noise": lambda: split_all(noise, len(stream)),
            "noise 64 KB": lambda: split_all(noise, 1 << 16),
            "crs": lambda: split_all(b"\r" * len(stream), len(stream)),
            "crs 64 KB": lambda: split_all(b"\r" * len(stream), 1 << 16),
            "bytes": lambda: split_all(stream[: 1 << 15], 1),
            "bytes, longer": lambda: split_all(stream[: 1 << 17], 1),
        },
        turns=5,
    )
    yield at_most("split 1 MB in one call, of 64 KB calls", times["one call"], times["64 KB"], 1.3)
    yield at_most("split 1 MB of noise in one call, of 64 KB calls", times["noise"], times["noise 64 KB"], 1.3)
    yield at_most("split 1 MB of carriage returns, of 64 KB calls", times["crs"], times["crs 64 KB"], 1.3)
    yield at_most("split 128 KB byte by byte, of 4 x 32 KB", times["bytes, longer"], 4 * times["bytes"], 1.3)
