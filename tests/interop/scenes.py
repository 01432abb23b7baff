"""Simulated modules with known signals, and what their registers have to hold.

Laws: what is expected is computed from the signals by the formulas of the manual (3.5, A.5), without a codec of ours.
"""

from collections.abc import Sequence
from typing import Any

from attrs import frozen

from i7000 import ModbusDataFormat, Model, Protocol, TypeCode, Unit
from i7000.device import OPEN_WIRE, Signal
from i7000.simulator.simulator import Simulated
from i7000.simulator.sources import Fixed, Sources
from tests.simulator.running import module

OVER_RANGE, UNDER_RANGE = 0x7FFF, 0x8000
"""Of thermocouples, and of all types in the engineering format."""
TAKEN_AT = {"M-7017": 1, "M-7018": 2, "M-7019R": 3, "M-7017Z": 4, "M-7018-16": 5, "M-7017mC-16": 6}
NOBODY = 9


def hex_word(value: float, largest: float) -> int:
    """What stands for a value where 7FFF stands for the largest, and 8000 for its opposite (A.5)."""
    return round(value / largest * (32767 if value >= 0 else 32768)) % 65536


def counts(value: float, in_one: int) -> int:
    """What stands for a value in the engineering format, so many counts being one of its unit (3.5)."""
    return round(value * in_one) % 65536


@frozen
class Scene:
    """A module, and what it has to tell."""

    simulated: Simulated
    words: tuple[int, ...]
    """30001 and what follows, one for each channel."""

    @property
    def address(self) -> int:
        return self.simulated.eeprom.address


def connected(unit: Unit, values: Sequence[float | None], cold_junction: float = 25.0) -> Sources:
    """Values of one unit on the inputs; None is an open wire."""
    channels = [Fixed(OPEN_WIRE if value is None else Signal(value, unit)) for value in values]
    return Sources(tuple(channels), Fixed(Signal(cold_junction, Unit.CELSIUS)))


def by_modbus(model: Model, sources: Sources, **stored: Any) -> Simulated:
    stored = {"protocol": Protocol.MODBUS_RTU, "address": TAKEN_AT[model.value]} | stored
    return module(model, sources=sources, **stored)


VOLTS = (1.5, -2.5, 0.0, 9.999, -0.001, 10.0, 5.0, -10.0)
VOLTAGES = Scene(
    by_modbus(Model.M_7017, connected(Unit.VOLT, VOLTS)),
    tuple(hex_word(value, 10) for value in VOLTS),
)

DEGREES = (25.1, -270.0, 0.0, 1000.5, 1371.9, -0.1, 100.0, 2000.0)
THERMOCOUPLES = Scene(
    by_modbus(Model.M_7018, connected(Unit.CELSIUS, DEGREES, 23.45), type_codes=(TypeCode.K,) * 8),
    (*(hex_word(value, 1372) for value in DEGREES[:7]), OVER_RANGE),
)

MIXED = Scene(
    by_modbus(
        Model.M_7019R,
        Sources(
            (
                Fixed(Signal(25.1, Unit.CELSIUS)),
                Fixed(Signal(-12.34, Unit.CELSIUS)),
                Fixed(Signal(-211.0, Unit.CELSIUS)),
                Fixed(OPEN_WIRE),
                Fixed(Signal(1.5, Unit.VOLT)),
                Fixed(Signal(-9.999, Unit.VOLT)),
                Fixed(Signal(12.345, Unit.MILLIAMPERE)),
                Fixed(Signal(14.999, Unit.MILLIVOLT)),
            ),
            Fixed(Signal(-3.21, Unit.CELSIUS)),
        ),
        type_codes=(
            TypeCode.K,
            TypeCode.M,
            TypeCode.J,
            TypeCode.T,
            TypeCode.V_2_5,
            TypeCode.V_10,
            TypeCode.MA_4_20,
            TypeCode.MV_15,
        ),
        modbus_data_format=ModbusDataFormat.ENGINEERING,
    ),
    (
        counts(25.1, 10),
        counts(-12.34, 100),
        UNDER_RANGE,
        OVER_RANGE,
        counts(1.5, 10000),
        counts(-9.999, 1000),
        counts(12.345, 1000),
        counts(14.999, 1000),
    ),
)
"""A channel below its span and one with an open wire among them."""

MILLIAMPERES = (4.0, 4.5, 3.9, 20.0, 2.0, *(5.0 + channel for channel in range(15)))
SINGLE_ENDED = Scene(
    by_modbus(
        Model.M_7017Z,
        connected(Unit.MILLIAMPERE, MILLIAMPERES),
        type_codes=(TypeCode.MA_4_20,) * 20,
        single_ended=True,
    ),
    tuple(round((max(value, 4.0) - 4.0) / 16.0 * 65535) for value in MILLIAMPERES),
)
"""Of 4 to 20 mA, which are not signed; below 4 mA is 0000 (1.11)."""

MANY_DEGREES = tuple(-150.5 + 37.3 * channel for channel in range(16))
MANY_THERMOCOUPLES = Scene(
    by_modbus(Model.M_7018_16, connected(Unit.CELSIUS, MANY_DEGREES, 31.2), type_codes=(TypeCode.E,) * 16),
    tuple(hex_word(value, 1000) for value in MANY_DEGREES),
)

MANY_MILLIAMPERES = tuple(-15.3 + 2.1 * channel for channel in range(16))
LOGGER = Scene(
    by_modbus(Model.M_7017mC_16, connected(Unit.MILLIAMPERE, MANY_MILLIAMPERES)),
    tuple(hex_word(value, 20) for value in MANY_MILLIAMPERES),
)

SCENES = (VOLTAGES, THERMOCOUPLES, MIXED, SINGLE_ENDED, MANY_THERMOCOUPLES, LOGGER)
NAMES = tuple(TAKEN_AT)

DCON_7018 = module(Model.I_7018, sources=connected(Unit.VOLT, (1.5, -1.0, 0.25, 0, 0, 0, 0, 2.5)), address=0x07)
SAID_BY_7018 = b">+1.5000-1.0000+0.2500" + b"+0.0000" * 4 + b"+2.5000\r"
ONE_BUS = (*(scene.simulated for scene in SCENES), DCON_7018)
"""Modules of both protocols on one pair of wires."""
