"""What traffic means, for those who listen: frames found in lines of text, in any spelling.

It does no I/O. The codecs of `i7000.dcon` and `i7000.modbus` say what a frame means; here is what comes before that.
"""

from i7000.dissect.finder import Found, Kind, find

__all__ = ["Found", "Kind", "find"]
