"""The listener: what DCON and Modbus RTU traffic between a host and modules means.

`find` finds the frames in a line of text, in any spelling; `pieces` those of a log. `hear` decodes bytes of a stream,
`hear_frame` one frame. Both use what is `Known` about each module: what you give, and what the traffic showed before.

This package does no I/O. Your program reads the file or the port, and passes lines or bytes.
"""

from i7000.dissect.dcon import meanings
from i7000.dissect.finder import find
from i7000.dissect.found import Found, Kind
from i7000.dissect.heard import Direction, Heard, Line, Place
from i7000.dissect.known import Fact, Knowledge, Known, Module, Origin
from i7000.dissect.line import flush, hear, hear_frame
from i7000.dissect.meaning import ChannelReading, Field, Fit, Item, Meaning
from i7000.dissect.transcript import Piece, pieces

__all__ = [
    "ChannelReading",
    "Direction",
    "Fact",
    "Field",
    "Fit",
    "Found",
    "Heard",
    "Item",
    "Kind",
    "Knowledge",
    "Known",
    "Line",
    "Meaning",
    "Module",
    "Origin",
    "Piece",
    "Place",
    "find",
    "flush",
    "hear",
    "hear_frame",
    "meanings",
    "pieces",
]
