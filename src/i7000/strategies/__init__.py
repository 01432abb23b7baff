"""Hypothesis strategies for the public classes: the vocabulary here, the rest in `dcon`, `modbus`, `device`, `host`.

Laws: what a strategy draws is valid unless its name says otherwise; the smallest example is the plainest one: address
01, channel 0, no checksum, the I-7017 (for Modbus the M-7017) with its newest firmware. `st.from_type` knows every
public class of `i7000` and its packages as soon as Hypothesis is imported.
"""

from enum import Enum
from functools import partial
from typing import Any


def register() -> None:
    """Tell Hypothesis of the strategies; it calls this itself, through its entry-point group."""
    from hypothesis.strategies import register_type_strategy  # noqa: PLC0415 - it may be being imported

    import i7000.dcon  # noqa: PLC0415 - only for its names
    import i7000.device  # noqa: PLC0415
    import i7000.host  # noqa: PLC0415
    import i7000.modbus  # noqa: PLC0415

    for module in (i7000, i7000.dcon, i7000.modbus, i7000.device, i7000.host):
        for kind in (getattr(module, name) for name in module.__all__):
            if isinstance(kind, type) and not issubclass(kind, Enum):  # Hypothesis knows what to do with an Enum.
                register_type_strategy(kind, partial(_strategy, kind))


def _strategy(kind: Any, _: object) -> Any:  # noqa: ANN401 - a class, and the strategy for it
    """Make the strategy for a class when it is asked for."""
    by_kind = {**vocabulary.BY_KIND, **maps.BY_KIND, **device.BY_KIND, **host.BY_KIND}
    if kind in by_kind:
        return by_kind[kind]()
    return modbus.messages(kind) if issubclass(kind, Message) else dcon.messages(kind)


# Hypothesis asks for `register` while it is being imported, which may be by the modules that follow.
from i7000.modbus import Message  # noqa: E402
from i7000.strategies import dcon, device, host, modbus, vocabulary  # noqa: E402
from i7000.strategies.modbus import maps  # noqa: E402
from i7000.strategies.vocabulary import (  # noqa: E402
    addresses,
    errors,
    firmwares,
    line_settings,
    profiles,
    readings,
    report_settings,
    word_readings,
)

__all__ = [
    "addresses",
    "dcon",
    "device",
    "errors",
    "firmwares",
    "host",
    "line_settings",
    "modbus",
    "profiles",
    "readings",
    "register",
    "report_settings",
    "word_readings",
]
