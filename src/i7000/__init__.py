"""The protocols of the ICP DAS I-7000 / M-7000 analog-input modules as pure functions on immutable values.

This package has the shared vocabulary. The protocols are `i7000.dcon` and, for M-7000 modules, `i7000.modbus` (Modbus
RTU).
"""

from i7000.errors import (
    ArgumentError,
    DecodeError,
    EncodeError,
    Fault,
    I7000Error,
    InvalidValueError,
    Noise,
    StateError,
)
from i7000.models import Firmware, Model, series
from i7000.profile import Profile
from i7000.readings import Reading, Status
from i7000.settings import (
    BaudRate,
    CharacterFormat,
    CjcUpdate,
    DataFormat,
    Filter,
    LineSettings,
    LogCommand,
    ModbusDataFormat,
    Protocol,
    ReportSettings,
)
from i7000.type_codes import MIXED, TypeCode, Unit

__all__ = [
    "MIXED",
    "ArgumentError",
    "BaudRate",
    "CharacterFormat",
    "CjcUpdate",
    "DataFormat",
    "DecodeError",
    "EncodeError",
    "Fault",
    "Filter",
    "Firmware",
    "I7000Error",
    "InvalidValueError",
    "LineSettings",
    "LogCommand",
    "ModbusDataFormat",
    "Model",
    "Noise",
    "Profile",
    "Protocol",
    "Reading",
    "ReportSettings",
    "StateError",
    "Status",
    "TypeCode",
    "Unit",
    "series",
]

__version__ = "0.1.0"
