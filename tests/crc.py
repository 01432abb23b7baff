"""The CRC of Modbus RTU as its specification puts it, bit by bit: what the tests hold ours against."""

__all__ = ["crc"]


def crc(body: bytes) -> bytes:
    """The two bytes behind a body."""
    register = 0xFFFF
    for byte in body:
        register ^= byte
        for _ in range(8):
            register = register >> 1 ^ (0xA001 if register & 1 else 0)
    return register.to_bytes(2, "little")
