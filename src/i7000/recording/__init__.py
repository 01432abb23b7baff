"""Recordings of a line: a file of JSON lines, and a capture that Wireshark reads.

`Recorder` writes the file, `records` has what is in its lines, `pcapng` makes the bytes of a capture, `schema` is the
JSON Schema of a line. Everything that records a line writes this format. ``i7000 decode --file`` reads both.
"""

from i7000.recording.recorder import Capture, Recorder
from i7000.recording.records import (
    SCHEMA_VERSION,
    Carried,
    Damaged,
    End,
    Event,
    Record,
    Start,
    is_recording,
    read,
    text,
)

__all__ = [
    "SCHEMA_VERSION",
    "Capture",
    "Carried",
    "Damaged",
    "End",
    "Event",
    "Record",
    "Recorder",
    "Start",
    "is_recording",
    "read",
    "text",
]
