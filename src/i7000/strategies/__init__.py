"""Hypothesis strategies for the public classes: the vocabulary here, the rest in `dcon`, `modbus` and so on.

Laws: strategies draw valid values unless the name says otherwise. The smallest example is the simplest one: address 01,
channel 0, no checksum, the I-7017 (for Modbus the M-7017) with its newest firmware. `st.from_type` knows every public
class of `i7000` and its packages as soon as Hypothesis is imported.
"""

from enum import Enum
from functools import partial
from typing import Any


def register() -> None:
    """Register the strategies of all public classes with Hypothesis."""
    from hypothesis.strategies import register_type_strategy  # noqa: PLC0415 - it may be being imported

    import i7000.dcon  # noqa: PLC0415 - only for its names
    import i7000.device  # noqa: PLC0415
    import i7000.host.procedures  # noqa: PLC0415
    import i7000.modbus  # noqa: PLC0415

    for module in (i7000, i7000.dcon, i7000.modbus, i7000.device, i7000.host, i7000.host.procedures):
        for kind in (getattr(module, name) for name in module.__all__):
            if isinstance(kind, type) and not issubclass(kind, Enum):  # Hypothesis knows what to do with an Enum.
                register_type_strategy(kind, partial(strategy_for, kind))


def strategy_for(kind: Any, _: object = None) -> Any:  # noqa: ANN401 - a class, and the strategy for it
    """Return the strategy for a class of the package; None for an enumeration, and for a class without one."""
    sources = (vocabulary, maps, device, host, procedures, findings, settings)
    by_kind = {kind: make for source in sources for kind, make in source.BY_KIND.items()}
    if kind in by_kind:
        return by_kind[kind]()
    if issubclass(kind, ModbusMessage):
        return modbus.messages(kind)
    return dcon.messages(kind) if issubclass(kind, DconMessage) else None


# Hypothesis may call `register` while it is being imported, which may be by the modules that follow.
from i7000.dcon import Message as DconMessage  # noqa: E402
from i7000.modbus import Message as ModbusMessage  # noqa: E402
from i7000.strategies import dcon, device, findings, host, modbus, procedures, settings, vocabulary  # noqa: E402
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
    "findings",
    "firmwares",
    "host",
    "line_settings",
    "modbus",
    "procedures",
    "profiles",
    "readings",
    "register",
    "report_settings",
    "settings",
    "strategy_for",
    "word_readings",
]
