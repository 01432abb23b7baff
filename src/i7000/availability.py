"""Which models have a command, a request or a table of addresses (the notes of chapters 2 and 3).

Laws: each message class names its member, so availability is stated once, at the command.
"""

from enum import Enum

from i7000.models import CONFIGURABLE, Gates, Model, gates_of, series

__all__ = ["Availability"]

_R_MODELS = "7017Z, 7018Z, 7019 series, M-7017RMS, M-7017mC-16; I-7017R, M-7017R from B3.9, I-7018R B4.2, M-7018R B4.5"
_M_7017_SERIES = dict.fromkeys(("M_7017", "M_7017C", "M_7017R", "M_7017RC", "M_7017R_A5"), "B3.0")


class Availability(Enum):
    """The models that have a feature: a phrase for messages, and the gates to check.

    Manual: 2, 3; E55, E56, E68, E69.
    """

    scope: str
    gates: Gates

    ALL = "all models", gates_of(Model)
    SERIES_7019 = "7019 series only", gates_of(series("7019"))
    SERIES_7018_7019 = "7018 and 7019 series only", gates_of(series("7018", "7019"))
    SERIES_7017_7018 = "7017 and 7018 series only", gates_of(series("7017", "7018"))
    SERIES_7017 = "7017 series only", gates_of(series("7017"))
    SERIES_7017Z = "7017Z only", gates_of(series("7017Z"))
    M_7017MC_16 = "M-7017mC-16 only", gates_of(series("M-7017mC-16"))
    SOFT_INIT = "M-7017mC-16 and 7019 series only", gates_of(series("M-7017mC-16", "7019"))
    CONFIGURABLE = _R_MODELS, CONFIGURABLE
    OPEN_WIRE = (
        "7018R from B4.2 and 7019 series from B3.7 only",
        gates_of(I_7018R="B4.2", M_7018R="B4.2", I_7019R="B3.7", M_7019R="B3.7", M_7019Z="B3.7"),
    )
    M_SERIES = "M-7000 series only", gates_of(series("M-7017", "M-7018", "M-7019"))
    M_7018_M_7019 = "M-7018 and M-7019 series only", gates_of(series("M-7018", "M-7019"))
    M_7019 = "M-7019 series only", gates_of(series("M-7019"))
    RANGE_STATUS = (
        "M-7019 series, and M-7017 series from B3.0 but the M-7017RMS only",
        gates_of(series("M-7017Z", "M-7017mC-16", "M-7019"), **_M_7017_SERIES),
    )
    ADDRESS_MAP = (
        "M-7000 series only; M-7017 series and M-7019R from B3.0, M-7018 and M-7018R from B3.5",
        gates_of(
            series("M-7017Z", "M-7017mC-16", "M-7017RMS", "M-7018Z", "M-7018-16", "M-7019Z"),
            M_7019R="B3.0",
            M_7018="B3.5",
            M_7018R="B3.5",
            **_M_7017_SERIES,
        ),
    )

    __hash__ = object.__hash__  # as equality, which is identity; that of `Enum` takes a call in Python

    def __init__(self, scope: str, gates: Gates) -> None:
        self.scope = scope
        self.gates = gates
