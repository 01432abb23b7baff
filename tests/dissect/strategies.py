"""What listeners are given in the tests: knowledge of every kind, and frames, good and bad, of both protocols."""

from collections.abc import Sequence
from typing import TypeVar

from hypothesis import strategies as st

from i7000 import DataFormat, EncodeError, Firmware, ModbusDataFormat, Model, Protocol, TypeCode, modbus
from i7000.dissect import Known
from tests.dissect.frames import DCON, MODBUS

__all__ = ["frames", "is_possible", "knowns", "protocol_of", "protocols"]

T = TypeVar("T")

protocols = st.sampled_from([None, *Protocol])
_TYPES = st.lists(st.none() | st.sampled_from(TypeCode), min_size=1, max_size=9).map(tuple)


def _optional(values: Sequence[T]) -> st.SearchStrategy[T | None]:
    return st.none() | st.sampled_from(values)


def is_possible(known: Known) -> bool:
    """Whether a module can be like that."""
    try:
        _ = known.all, known.default
    except EncodeError:
        return False
    return True


knowns: st.SearchStrategy[Known] = st.builds(
    Known,
    model=_optional(tuple(Model)),
    firmware=_optional((Firmware("B1.2"), Firmware("B2.6"), Firmware("B3.7"))),
    types=st.none() | _TYPES | st.sampled_from(TypeCode).map(lambda code: (code,)),
    data_format=_optional(tuple(DataFormat)),
    checksum=_optional((False, True)),
    single_ended=_optional((False, True)),
    modbus_data_format=_optional(tuple(ModbusDataFormat)),
).filter(is_possible)

_MODBUS_BODIES = st.builds(
    lambda head, rest: modbus.seal(head + rest),
    st.sampled_from([bytes((1, function)) for function in (1, 2, 3, 4, 5, 6, 15, 16, 0x46, 0x81, 0x84)]),
    st.binary(max_size=12),
)
_SETTINGS = st.integers(256, 263) | st.integers(352, 359) | st.integers(480, 499)


def _read(register: int, word: int) -> list[bytes]:
    request, response = modbus.ReadHoldingRegisters(1, register, 1), modbus.HoldingRegisters(1, (word,))
    return [modbus.encode(request), modbus.encode(response)]


_EXCHANGES = st.builds(_read, _SETTINGS, st.integers(0, 0xFFFF) | st.integers(0, 30)) | st.builds(
    lambda register, word: [modbus.encode(modbus.WriteSingleRegister(1, register, word))] * 2,
    _SETTINGS,
    st.integers(0, 0xFFFF) | st.integers(0, 30),
)
_TEXTS = st.text("%#$~@!>?0123456789ABCDEF+-. *OETMCSR", max_size=14).map(lambda text: [text.encode() + b"\r"])
_SINGLE = st.sampled_from([*MODBUS, *DCON]) | _MODBUS_BODIES | st.binary(max_size=12)
frames: st.SearchStrategy[list[bytes]] = st.lists(
    _SINGLE.map(lambda frame: [frame]) | _EXCHANGES | _TEXTS, max_size=8
).map(lambda lists: [frame for those in lists for frame in those])
"""What stands on a line, one after the other."""


def protocol_of(frame: bytes) -> Protocol:
    """What a frame looks like by its first byte."""
    return Protocol.DCON if frame[:1] and frame[:1] in b"%#$~@!?>" else Protocol.MODBUS_RTU
