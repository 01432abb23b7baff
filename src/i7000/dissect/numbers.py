"""Numbers as people read them: addresses, which manuals write in hex and programs often in decimal."""

__all__ = ["address_words"]


def address_words(address: int) -> str:
    """Return an address so that nobody can take it for another one.

    Shape: two digits for 0 to 9, which are the same in both bases; else hex, and decimal in brackets.

    >>> address_words(0x01), address_words(0x0A), address_words(0x10)
    ('01', '0Ah (10)', '10h (16)')
    """
    return f"{address:02X}" if address <= 9 else f"{address:02X}h ({address})"
