"""Strategies for Modbus: messages and whole exchanges, damaged frames, streams of frames and noise, registers."""

from i7000.strategies.modbus.frames import DAMAGES, Damage, Stream, chunkings, damaged, frames, streams
from i7000.strategies.modbus.maps import plans, register_items, register_maps, register_values, registers
from i7000.strategies.modbus.messages import (
    Exchange,
    any_requests,
    exception_responses,
    exchanges,
    messages,
    profiles,
    profiles_with,
    requests,
    responses,
)

__all__ = [
    "DAMAGES",
    "Damage",
    "Exchange",
    "Stream",
    "any_requests",
    "chunkings",
    "damaged",
    "exception_responses",
    "exchanges",
    "frames",
    "messages",
    "plans",
    "profiles",
    "profiles_with",
    "register_items",
    "register_maps",
    "register_values",
    "registers",
    "requests",
    "responses",
    "streams",
]
