"""What traffic means, for those who listen: frames found in lines of text, in any spelling.

It does no I/O. `i7000.dcon` and `i7000.modbus` decode what is found here.
"""

from i7000.dissect.finder import find
from i7000.dissect.found import Found, Kind
from i7000.dissect.transcript import Piece, pieces

__all__ = ["Found", "Kind", "Piece", "find", "pieces"]
