"""Strategies for DCON: messages and whole exchanges, damaged frames, streams of frames and noise."""

from i7000.strategies.dcon.frames import DAMAGES, Damage, Stream, chunkings, damaged, frames, near_misses, streams
from i7000.strategies.dcon.messages import (
    Exchange,
    any_commands,
    channel_fields,
    commands,
    exchanges,
    messages,
    names,
    profiles_with,
    responses,
)

__all__ = [
    "DAMAGES",
    "Damage",
    "Exchange",
    "Stream",
    "any_commands",
    "channel_fields",
    "chunkings",
    "commands",
    "damaged",
    "exchanges",
    "frames",
    "messages",
    "names",
    "near_misses",
    "profiles_with",
    "responses",
    "streams",
]
