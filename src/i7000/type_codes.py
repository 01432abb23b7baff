"""The analog input types: code, unit, span and the scale of every data format (manual 1.11, 3.5, A.5).

Laws: a member states only independent facts (code, unit, span, thermocouple); everything that follows from them is
computed. The printed tables are in ``spec/tables``, and tests check the rules here against them.
"""

from enum import IntEnum, StrEnum

from i7000.arguments import check_int

__all__ = ["MIXED", "TypeCode", "Unit"]

MIXED = 0xFF
"""The value in place of a type code if the channels of a module have different types (manual 2.1, 2.10)."""

_TEXT_DIGITS = 5
_INT16_MAX = 32767


class Unit(StrEnum):
    """The units of readings."""

    MILLIVOLT = "mV"
    VOLT = "V"
    MILLIAMPERE = "mA"
    CELSIUS = "degC"


class TypeCode(IntEnum):
    """An analog input type, TT or rr of the manual.

    Unit: `minimum`, `maximum`, `full_scale`, `lowest` and `highest` are in `unit`.
    Manual: 1.11 (tables), 3.5 (Modbus engineering scale), A.5 (hex); E45, E52, E53, E54, E121.
    """

    unit: Unit
    minimum: float
    maximum: float
    thermocouple: str
    """The letter of the thermocouple, or empty."""
    full_scale: float
    """The larger absolute value of the span, MAX of the manual: the value of 100 % and of 7FFF."""
    signed_hex: bool
    """Whether a hex word is two's complement; the other two types run from 0000 at `minimum` to FFFF (E45)."""
    decimals: int
    """The number of digits after the point in DCON engineering text, which has five digits."""
    lowest: float
    """The lowest reading that a module sends: a tenth of `full_scale` below the span (E121, assumption)."""
    highest: float
    """The highest reading that a module sends: a tenth of `full_scale` above the span."""
    modbus_decimals: int
    """The number of decimals of the Modbus engineering word: as in text, or one less to fit in 16 bits."""

    MV_15 = 0x00
    MV_50 = 0x01
    MV_100 = 0x02
    MV_500_03 = 0x03
    V_1_04 = 0x04
    V_2_5 = 0x05
    MA_20_06 = 0x06
    MA_4_20 = 0x07
    V_10 = 0x08
    V_5 = 0x09
    V_1_0A = 0x0A
    MV_500_0B = 0x0B
    MV_150 = 0x0C
    MA_20_0D = 0x0D
    J = 0x0E
    K = 0x0F
    T = 0x10
    E = 0x11
    R = 0x12
    S = 0x13
    B = 0x14
    N = 0x15
    C = 0x16
    L = 0x17
    M = 0x18
    L_DIN43710 = 0x19
    MA_0_20 = 0x1A
    V_150 = 0x1B
    V_50 = 0x1C

    @staticmethod
    def name_of(code: int) -> str:
        """Return the name of a type, or the two hex digits of an undefined code.

        >>> TypeCode.name_of(0x0F), TypeCode.name_of(0x20)
        ('K', '20')
        """
        known = TypeCode.of(code)
        return known.name if isinstance(known, TypeCode) else f"{code:02X}"

    @classmethod
    def of(cls, code: int) -> "TypeCode | int":
        """Return the member of `code`; an undefined code, such as `MIXED`, is kept as an int."""
        if code.__class__ is not int:
            check_int("code", code)
        return _MEMBERS.get(code, code)


_FACTS: dict[TypeCode, tuple[Unit, float, float, str]] = {
    TypeCode.MV_15: (Unit.MILLIVOLT, -15, 15, ""),
    TypeCode.MV_50: (Unit.MILLIVOLT, -50, 50, ""),
    TypeCode.MV_100: (Unit.MILLIVOLT, -100, 100, ""),
    TypeCode.MV_500_03: (Unit.MILLIVOLT, -500, 500, ""),
    TypeCode.V_1_04: (Unit.VOLT, -1, 1, ""),
    TypeCode.V_2_5: (Unit.VOLT, -2.5, 2.5, ""),
    TypeCode.MA_20_06: (Unit.MILLIAMPERE, -20, 20, ""),
    TypeCode.MA_4_20: (Unit.MILLIAMPERE, 4, 20, ""),
    TypeCode.V_10: (Unit.VOLT, -10, 10, ""),
    TypeCode.V_5: (Unit.VOLT, -5, 5, ""),
    TypeCode.V_1_0A: (Unit.VOLT, -1, 1, ""),
    TypeCode.MV_500_0B: (Unit.MILLIVOLT, -500, 500, ""),
    TypeCode.MV_150: (Unit.MILLIVOLT, -150, 150, ""),
    TypeCode.MA_20_0D: (Unit.MILLIAMPERE, -20, 20, ""),
    TypeCode.J: (Unit.CELSIUS, -210, 760, "J"),
    TypeCode.K: (Unit.CELSIUS, -270, 1372, "K"),
    TypeCode.T: (Unit.CELSIUS, -270, 400, "T"),
    TypeCode.E: (Unit.CELSIUS, -270, 1000, "E"),
    TypeCode.R: (Unit.CELSIUS, 0, 1768, "R"),
    TypeCode.S: (Unit.CELSIUS, 0, 1768, "S"),
    TypeCode.B: (Unit.CELSIUS, 0, 1820, "B"),
    TypeCode.N: (Unit.CELSIUS, -270, 1300, "N"),
    TypeCode.C: (Unit.CELSIUS, 0, 2320, "C"),
    TypeCode.L: (Unit.CELSIUS, -200, 800, "L"),
    TypeCode.M: (Unit.CELSIUS, -200, 100, "M"),
    TypeCode.L_DIN43710: (Unit.CELSIUS, -200, 900, "L DIN43710"),
    TypeCode.MA_0_20: (Unit.MILLIAMPERE, 0, 20, ""),
    TypeCode.V_150: (Unit.VOLT, -150, 150, ""),
    TypeCode.V_50: (Unit.VOLT, -50, 50, ""),
}

for _code, (_unit, _minimum, _maximum, _thermocouple) in _FACTS.items():
    _code.unit, _code.minimum, _code.maximum, _code.thermocouple = _unit, _minimum, _maximum, _thermocouple
    _code.full_scale = max(abs(_minimum), abs(_maximum))
    _code.signed_hex = _code not in (TypeCode.MA_4_20, TypeCode.MA_0_20)
    _code.decimals = _TEXT_DIGITS - len(str(int(_code.full_scale)))
    _code.lowest = round(_minimum - _code.full_scale / 10, _code.decimals)
    _code.highest = round(_maximum + _code.full_scale / 10, _code.decimals)
    _code.modbus_decimals = _code.decimals - int(_code.full_scale * 10**_code.decimals > _INT16_MAX)

_MEMBERS: dict[int, TypeCode] = {member.value: member for member in TypeCode}
