"""The 28 models: the features of each one, and the firmware that introduced them.

Laws: most features follow from the name of a model, so they are rules on names, like the notes of the manual; the rows
are in ``spec/tables/models.json``. Firmware None means the newest, which has every feature of the model.
Manual: 1, 1.3, 1.9, 1.11, the notes of chapter 2.
"""

import re
from collections.abc import Iterable, Mapping
from enum import Enum
from functools import cached_property, total_ordering
from types import MappingProxyType

from attrs import field

from i7000.arguments import as_bytes, check_type
from i7000.errors import EncodeError
from i7000.frozen import frozen
from i7000.settings import Protocol
from i7000.type_codes import TypeCode

__all__ = ["CONFIGURABLE", "Firmware", "Gates", "Model", "gates_of", "series"]

_FIRMWARE = re.compile(r"([A-Z])([0-9])(?:\.([0-9]{1,2})|([0-9]{2}))")


@total_ordering
@frozen(eq=False, repr=False)
class Firmware:
    """A firmware version, as in the response to ``$AAF``; versions are ordered.

    Shape: a letter, a digit and a minor number, ``B3.9``; the address maps write ``B305`` for B3.5 (E67).
    Errors: `EncodeError`.
    Manual: 2.23, 3.4.

    >>> Firmware("B405") == Firmware("B4.5") > Firmware("B3.10") > Firmware("A9.0")
    True
    """

    text: str
    _key: tuple[str, int, int] = field(init=False)

    def __attrs_post_init__(self) -> None:
        match = _FIRMWARE.fullmatch(self.text) if isinstance(self.text, str) else None
        if not match:
            raise EncodeError("firmware", self.text, "a letter, a digit and a minor number: B3.9 or B305", "2.23")
        letter, major, minor, packed = match.groups()
        object.__setattr__(self, "_key", (letter, int(major), int(minor or packed)))

    def __eq__(self, other: object) -> bool:
        return self._key == other._key if isinstance(other, Firmware) else NotImplemented

    def __lt__(self, other: object) -> bool:
        return self._key < other._key if isinstance(other, Firmware) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._key)

    def __str__(self) -> str:
        """Return the version with its point, however it was written."""
        letter, major, minor = self._key
        return f"{letter}{major}.{minor}"

    def __repr__(self) -> str:
        return f"Firmware({str(self)!r})"

    @classmethod
    def from_bytes(cls, version: bytes) -> "Firmware | None":
        """Return the version in three bytes: major, minor and build (E75, assumption); None for invalid bytes.

        Manual: 3.3.7; E67, E75.

        >>> Firmware.from_bytes(bytes((0x0B, 4, 5))), Firmware.from_bytes(bytes((4, 5, 0)))
        (Firmware('B4.5'), None)
        """
        version = as_bytes("version", version)
        if len(version) != len("abc"):
            raise EncodeError("version", version, "3 bytes", "3.3.7")
        letter, major, minor = version
        if not 10 <= letter < 36 or major > 9 or minor > 99:
            return None
        return cls(f"{chr(letter - 10 + ord('A'))}{major}.{minor}")

    def __bytes__(self) -> bytes:
        """Return major, minor and build: B4.5 is 0B, 04, 05 (E75, assumption)."""
        letter, major, minor = self._key
        return bytes((int(letter, 36), major, minor))


Gates = Mapping["Model", Firmware | None]
"""The models that have a feature, and the firmware that introduced it (None: always)."""


class Model(Enum):
    """A module of the manual, by its printed name."""

    I_7017 = "I-7017"
    I_7017F = "I-7017F"
    I_7017C = "I-7017C"
    I_7017FC = "I-7017FC"
    I_7017R = "I-7017R"
    I_7017RC = "I-7017RC"
    I_7017R_A5 = "I-7017R-A5"
    I_7017Z = "I-7017Z"
    M_7017 = "M-7017"
    M_7017C = "M-7017C"
    M_7017R = "M-7017R"
    M_7017RC = "M-7017RC"
    M_7017R_A5 = "M-7017R-A5"
    M_7017Z = "M-7017Z"
    M_7017RMS = "M-7017RMS"
    M_7017mC_16 = "M-7017mC-16"
    I_7018 = "I-7018"
    I_7018P = "I-7018P"
    I_7018BL = "I-7018BL"
    I_7018R = "I-7018R"
    I_7018Z = "I-7018Z"
    M_7018 = "M-7018"
    M_7018R = "M-7018R"
    M_7018Z = "M-7018Z"
    M_7018_16 = "M-7018-16"
    I_7019R = "I-7019R"
    M_7019R = "M-7019R"
    M_7019Z = "M-7019Z"

    __hash__ = object.__hash__  # as equality, which is identity; that of `Enum` takes a call in Python

    @classmethod
    def find(cls, name: str) -> "Model":
        """Return the model of that name, in any case; I-7019 and M-7019 mean the R models (E36).

        Errors: `EncodeError` that names the nearest ones.
        """
        wanted = str(name).upper()
        if wanted in ("I-7019", "M-7019"):
            wanted += "R"
        for model in cls:
            if model.value.upper() == wanted:
                return model
        near = [model.value for model in cls if model.series in wanted] or [model.value for model in cls]
        raise EncodeError("model", name, ", ".join(near), "1")

    @property
    def series(self) -> str:
        """The series within I-7000 or M-7000: ``7017``, ``7018`` or ``7019``."""
        return self.value[2:6]

    @classmethod
    def series_of(cls, name: bytes) -> str | None:
        """Return the series of a name read by Modbus, such as ``7019``; None for any other bytes.

        Manual: 3.3.1; E75, E77.

        >>> Model.series_of(bytes.fromhex("00701900"))
        '7019'
        """
        return _SERIES.get(as_bytes("name", name))

    @property
    def modbus_name(self) -> bytes:
        """The name by Modbus, which contains only the series: 00 70 19 00 (3.3.1; E75, E77)."""
        return bytes.fromhex(f"00{self.series}00")

    @property
    def suffix(self) -> str:
        """The part of the name after the series: ``R-A5``, ``Z``, or nothing."""
        return self.value[6:]

    @property
    def factory_name(self) -> str:
        """The response to ``$AAM`` until another name is set; the same for the I- and the M- model (2.24)."""
        return (self.series + self.suffix.replace("-", "")).upper()[:6]

    @property
    def protocols(self) -> frozenset[Protocol]:
        """The protocols of the model: the M-7000 series adds Modbus RTU."""
        return frozenset(Protocol) if self.value.startswith("M") else frozenset({Protocol.DCON})

    @property
    def channels(self) -> int:
        """The number of differential input channels (1.3)."""
        if self.suffix.endswith("-16"):
            return 16
        return 10 if self.suffix == "Z" else 8

    @property
    def single_ended_channels(self) -> int | None:
        """The channels with single-ended inputs: by command on the 7017Z, by jumper on the M-7017mC-16 (1.3)."""
        if self.series == "7017" and self.suffix == "Z":
            return 20
        return 16 if self is Model.M_7017mC_16 else None

    @property
    def current_only(self) -> bool:
        """Whether the model measures only currents."""
        return self.series == "7017" and self.suffix in ("C", "FC", "RC", "mC-16")

    @property
    def default_type(self) -> TypeCode | None:
        """The factory type of every channel (1.9); that of the I-7018BL is not documented (E35)."""
        if self is Model.I_7018BL:
            return None
        if self.suffix == "R-A5":
            return TypeCode.V_150
        if self.current_only:
            return TypeCode.MA_20_0D
        return TypeCode.V_2_5 if self.series == "7018" else TypeCode.V_10

    @cached_property
    def type_codes(self) -> Mapping[TypeCode, Firmware | None]:
        """The supported types, and the firmware that introduced them (1.11; E35 to E42)."""
        return MappingProxyType(self._type_codes())

    def _type_codes(self) -> dict[TypeCode, Firmware | None]:  # noqa: PLR0911 - a table
        low, high = _codes(0x00, 0x06), _codes(0x08, 0x0D)
        match self.series, self.suffix:
            case "7017", "R-A5":
                return _codes(0x1B, 0x1C)
            case "7017", "RMS":
                return _codes(0x08, 0x0C)
            case "7017", "Z":
                return high | _unipolar(None)
            case "7017", _:
                return (_codes(0x0D, 0x0D) if self.current_only else high) | _unipolar(Firmware("B2.2"))
            case "7018", "BL":
                return _codes(0x0E, 0x16)
            case "7018", "P":
                return low | _codes(0x0E, 0x18)
            case "7018", "R":
                return low | _codes(0x0E, 0x19)
            case "7018", "Z":
                return low | _codes(0x0E, 0x19) | _unipolar(None)
            case "7018", _:
                return low | _codes(0x0E, 0x16)
            case _:
                return low | high | _codes(0x0E, 0x19) | _unipolar(Firmware("B2.7") if self.suffix == "R" else None)

    @property
    def thermocouples(self) -> frozenset[str]:
        """The letters of the supported thermocouples."""
        return frozenset(code.thermocouple for code in self.type_codes if code.thermocouple)

    @property
    def individually_configurable(self) -> bool:
        """Whether channels can have different types, with some firmware (see `CONFIGURABLE`)."""
        return self in CONFIGURABLE

    @property
    def type_by_configuration(self) -> bool:
        """Whether TT of ``%AANNTTCCFF`` sets the type; other models ignore it (2.1; E81)."""
        return self not in TT_UNUSED

    @property
    def fast_mode(self) -> bool:
        """Whether the model has a fast mode, of 12 bits (1.11 FF; E43)."""
        return self.series == "7017" and (self.suffix in ("F", "FC", "R", "RC", "R-A5", "Z", "mC-16"))

    @property
    def fast_mode_default(self) -> bool:
        """Whether fast mode is the factory default (1.9; E95)."""
        return self in (Model.I_7017F, Model.I_7017FC)

    @property
    def sampling_rate(self) -> int:
        """The samples per second over all channels, in normal mode (1.3; E72)."""
        return 8 if self.series == "7019" and self.suffix == "R" else 10

    @property
    def fast_sampling_rate(self) -> int | None:
        """The samples per second in fast mode (1.3; E96)."""
        if not self.fast_mode:
            return None
        return {"R-A5": 50, "mC-16": 200}.get(self.suffix, 60)

    @property
    def cjc(self) -> bool:
        """Whether the model measures and compensates the temperature of the cold junction."""
        return self.series != "7017"

    @property
    def open_wire_detection(self) -> bool:
        """Whether the model detects an open thermocouple wire (1.3; E69)."""
        return self.series == "7019" or (self.series == "7018" and self.suffix in ("R", "Z", "BL", "-16"))

    @property
    def filter_from(self) -> Firmware | None:
        """The firmware from which the mains filter can be selected; None: always (1.11 FF)."""
        return Firmware("B2.7") if self.series == "7019" and self.suffix == "R" else None

    @property
    def character_formats_from(self) -> Firmware:
        """The firmware from which the character format can be other than N81 (1.11 CC)."""
        if self.series == "7017":
            return Firmware("B2.6")
        return Firmware("B2.9") if self.series == "7018" and self.suffix != "Z" else Firmware("B3.1")


_SERIES = {model.modbus_name: model.series for model in Model}


def series(*names: str) -> frozenset[Model]:
    """Return the models that names of series stand for.

    A name stands for all models that begin with it: ``I-7017``, ``M-7018``, ``7019``. One that ends in a letter is a
    model, or the I- and the M- of it: ``7017Z``, ``I-7018R``.
    Errors: `EncodeError`.
    Manual: 1; E34, E36.

    >>> sorted(model.value for model in series("7017Z"))
    ['I-7017Z', 'M-7017Z']
    """
    models: set[Model] = set()
    for name in names:
        check_type("names", name, str)
        if name not in _NAMES:
            raise EncodeError("series", name, "a model, or the beginning of one up to its four digits", "1")
        models |= _NAMES[name]
    return frozenset(models)


_NAMES: dict[str, set[Model]] = {}
for _model in Model:
    for _name in {_model.value, _model.value[2:], _model.value[:6], _model.series}:
        _NAMES.setdefault(_name, set()).add(_model)


def _codes(first: int, last: int) -> dict[TypeCode, Firmware | None]:
    return {code: None for code in TypeCode if first <= code <= last}


def _unipolar(firmware: Firmware | None) -> dict[TypeCode, Firmware | None]:
    return {TypeCode.MA_4_20: firmware, TypeCode.MA_0_20: firmware}


def gates_of(*models: Iterable[Model], **firmware: str) -> Gates:
    """Return gates: `models` always, and the series named in `firmware` from that version on."""
    gate: dict[Model, Firmware | None] = {model: None for group in models for model in group}
    return gate | {Model[name]: Firmware(version) for name, version in firmware.items()}


CONFIGURABLE = gates_of(
    series("7017Z", "M-7017RMS", "M-7017mC-16", "7018Z", "7019"),
    I_7017R="B3.9", M_7017R="B3.9", I_7018R="B4.2", M_7018R="B4.5",
)  # fmt: skip
"""The models whose channels can have different types (2.1, 2.15)."""

TT_UNUSED = series("7017Z", "M-7017mC-16", "7018Z", "7019")
"""The models that ignore TT of ``%AANNTTCCFF``: their channels are set one by one (2.1)."""
