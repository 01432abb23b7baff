"""The memory of a module, with and without power, and how power changes it (manual 1.9, 1.12.2, A.1).

Laws: `Eeprom` survives a power cycle, `Ram` does not; both are frozen, so a power cycle is a function too. A `State`
always has the profile that decodes its bytes.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any, TypeVar

from attrs import Attribute, evolve, field, fields_dict, frozen

from i7000.arguments import LARGEST_FLOAT, check_clock, check_seconds, check_type, kind_words
from i7000.device.logger import Log
from i7000.device.ram import Ram
from i7000.errors import ArgumentError, InvalidValueError
from i7000.models import Firmware, Model
from i7000.profile import CHANNEL_OFFSETS, CJC_OFFSETS, RESPONSE_DELAYS, Profile
from i7000.settings import (
    BaudRate,
    DataFormat,
    LineSettings,
    ModbusDataFormat,
    Protocol,
    ReportSettings,
    is_int,
)
from i7000.type_codes import TypeCode

__all__ = ["NEWEST", "Eeprom", "Inputs", "State", "factory", "power_on"]

NEWEST = Firmware("B4.5")
"""The latest firmware in the manual for each series; the default of a module (E113)."""


def inputs_of(model: Model) -> int:
    """Return the number of channels of a model in the connecting mode with the most channels."""
    return model.single_ended_channels or model.channels


# --- the EEPROM -------------------------------------------------------------------------------------------------------

Check = Callable[["Eeprom", "Attribute[Any]", Any], None]


def _within(low: int, high: int) -> Check:
    def check(_: "Eeprom", attribute: "Attribute[Any]", value: object) -> None:
        if not is_int(value, low, high):
            raise InvalidValueError(attribute.name, value, f"{low}..{high}", "3.4")

    return check


def _a(kind: type) -> Check:
    def check(_: "Eeprom", attribute: "Attribute[Any]", value: object) -> None:
        if not isinstance(value, kind):
            raise InvalidValueError(attribute.name, value, kind_words(kind), "")

    return check


def _one_each(check: Check) -> Check:
    def check_all(eeprom: "Eeprom", attribute: "Attribute[Any]", values: tuple[int, ...]) -> None:
        inputs = inputs_of(eeprom.model)
        if not isinstance(values, tuple) or len(values) != inputs:
            raise InvalidValueError(attribute.name, values, f"a tuple of {inputs} on {eeprom.model.value}", "1.3")
        for value in values:
            check(eeprom, attribute, value)

    return check_all


def _check_mask(eeprom: "Eeprom", attribute: "Attribute[Any]", mask: object) -> None:
    most = (1 << inputs_of(eeprom.model)) - 1
    if not is_int(mask, 0, most):
        raise InvalidValueError(attribute.name, mask, f"0..{most}", "3.4")


def _check_name(_: "Eeprom", __: "Attribute[Any]", name: str) -> None:
    Profile.check_name(name, "2.24")


def _check_protocol(eeprom: "Eeprom", attribute: "Attribute[Any]", protocol: Protocol) -> None:
    if not isinstance(protocol, Protocol) or protocol not in eeprom.model.protocols:
        raise InvalidValueError(attribute.name, protocol, f"DCON: {eeprom.model.value} has no Modbus", "1.12")


def _check_line(_: "Eeprom", attribute: "Attribute[Any]", line: LineSettings) -> None:
    if not isinstance(line, LineSettings) or not isinstance(line.baud_rate, BaudRate):
        raise InvalidValueError(attribute.name, line, "a baud rate code of 03..0A", "1.11")


def _check_report(_: "Eeprom", attribute: "Attribute[Any]", report: ReportSettings) -> None:
    known = isinstance(report, ReportSettings) and isinstance(report.data_format, DataFormat)
    if not known or report.reserved:
        raise InvalidValueError(attribute.name, report, "a data format of 0..2, no reserved bits", "1.11")


@frozen(slots=False)  # so that a copy is one dictionary
class Eeprom:
    """The memory of a module that survives a power cycle. Only `model` is required.

    Shape: per-channel tuples have an entry for each channel of the single-ended mode, if the model has one. Every other
        field has the factory default.
    Errors: `InvalidValueError` for values that no module can have stored.
    Manual: 1.9, 1.11, 2, 3.4; E35, E72, E83, E95.
    """

    model: Model = field(validator=_a(Model))
    firmware: Firmware = field(validator=_a(Firmware))
    type_codes: tuple[TypeCode, ...] = field(validator=_one_each(_a(TypeCode)))
    report_settings: ReportSettings = field(validator=_check_report)
    name: str = field(validator=_check_name)
    """The name that ``$AAM`` reads; the factory name is the number of the model, cut to six characters (E113)."""
    protocol: Protocol = field(validator=_check_protocol)
    channel_mask: int = field(validator=_check_mask)
    channel_offsets: tuple[int, ...] = field(validator=_one_each(_within(*CHANNEL_OFFSETS)))
    """Tenths of a degree: CJC offsets of the 7018 series, temperature offsets of the 7019 series (E62)."""
    channel_cjc_offsets: tuple[int, ...] = field(validator=_one_each(_within(*CJC_OFFSETS)))
    """Hundredths of a degree, 7019 series only (40353..)."""
    open_wire_detection: bool = field(validator=_a(bool))
    address: int = field(default=1, validator=_within(0, 0xFF))
    line_settings: LineSettings = field(default=LineSettings(), validator=_check_line)
    single_ended: bool = field(default=False, validator=_a(bool))
    modbus_data_format: ModbusDataFormat = field(default=ModbusDataFormat.HEX, validator=_a(ModbusDataFormat))
    cjc_offset: int = field(default=0, validator=_within(*CJC_OFFSETS))
    """Hundredths of a degree."""
    cjc_enabled: bool = field(default=True, validator=_a(bool))
    host_watchdog_enabled: bool = field(default=False, validator=_a(bool))
    host_watchdog_timeout: int = field(default=0, validator=_within(0, 0xFF))
    """Tenths of a second."""
    host_watchdog_timed_out: bool = field(default=False, validator=_a(bool))
    host_watchdog_timeouts: int = field(default=0, validator=_within(0, 0xFFFF))
    """The number of timeouts (40492); it survives a power cycle, as the status does (E114)."""
    host_watchdog_mode: bool = field(default=False, validator=_a(bool))
    """Coil 00260, which has no effect on modules without outputs (E30)."""
    response_delay: int = field(default=0, validator=_within(*RESPONSE_DELAYS))
    """The response delay by Modbus, in milliseconds."""
    sampling_rate_8_hz: bool = field(default=True, validator=_a(bool))
    """Coil 00274 of the M-7019R; 1.3 has 8 samples a second (E72)."""
    big_endian: bool = field(default=False, validator=_a(bool))
    log: Log = field(default=Log(), hash=False, validator=_a(Log))

    def __attrs_post_init__(self) -> None:
        self.check_types(profile_of(self))  # which refuses a mode or format that the model does not have

    def check_types(self, profile: Profile) -> None:
        """Raise `InvalidValueError` for unsupported types of channels outside the connecting mode.

        Errors: `InvalidValueError`; the profile has checked the types of the other channels.
        """
        check_type("profile", profile, Profile)
        if not all(map(profile.supports, self.type_codes[profile.channels :])):
            raise InvalidValueError("type_codes", self.type_codes, profile.supported_types(), "1.11")


_STORED = fields_dict(Eeprom)
_OF_PROFILE = frozenset({
    "firmware", "type_codes", "single_ended", "report_settings", "modbus_data_format",
})  # fmt: skip
"""The fields that the profile depends on, beside the model."""
_OF_READINGS = _OF_PROFILE | {
    "channel_mask", "channel_offsets", "channel_cjc_offsets", "open_wire_detection", "cjc_offset", "cjc_enabled",
}  # fmt: skip
"""The fields that readings depend on, in any data format."""
_Frozen = TypeVar("_Frozen")


def _copied(value: _Frozen, changes: dict[str, Any]) -> _Frozen:
    """Return a copy of a frozen value with unchecked changes; the instance has a `__dict__`."""
    fields = vars(value) | changes
    if len(fields) != len(vars(value)):
        name, *_ = (name for name in changes if name not in vars(value))
        raise ArgumentError(name, changes[name], ", ".join(vars(value)), f"{type(value).__name__} has no {name}")
    copy = object.__new__(type(value))
    object.__setattr__(copy, "__dict__", fields)
    return copy


def factory(model: Model, firmware: Firmware | None = None) -> Eeprom:
    """Return the memory of a module from the factory.

    Special: without a firmware it has the latest in the manual. The I-7018BL, whose default is not documented, has type
        0E, the first that it can have (E35, assumption).
    Manual: 1.9; E35, E83, E95, E113, E132.

    >>> factory(Model.I_7018).name, factory(Model.M_7017Z).protocol.name, factory(Model.I_7017F).report_settings.byte
    ('7018', 'MODBUS_RTU', 32)
    """
    check_type("model", model, Model)
    check_type("firmware", firmware, Firmware, optional=True)
    inputs = inputs_of(model)
    zeros = (0,) * inputs
    return Eeprom(
        model=model,
        firmware=NEWEST if firmware is None else firmware,
        type_codes=(model.default_type or TypeCode.J,) * inputs,
        report_settings=ReportSettings(fast_mode=model.fast_mode_default),
        name=model.factory_name,
        protocol=max(model.protocols),
        channel_mask=(1 << inputs) - 1,
        channel_offsets=zeros,
        channel_cjc_offsets=zeros,
        open_wire_detection=model.open_wire_detection,
    )


# --- a module with power ----------------------------------------------------------------------------------------------


@frozen(eq=False)
class Inputs:
    """The EEPROM at the last change of a field that readings depend on.

    Special: it is equal only to itself, so that a cache lookup does not compare its fields.
    """

    eeprom: Eeprom


@frozen
class State:
    """A module with power; change `Eeprom` and `Ram` with `store` and `keep`."""

    eeprom: Eeprom
    ram: Ram
    profile: Profile = field(init=False, eq=False, repr=False)
    """The profile that a host needs now."""

    @profile.default
    def _profile(self) -> Profile:
        for name, value, kind in (("eeprom", self.eeprom, Eeprom), ("ram", self.ram, Ram)):
            if not isinstance(value, kind):
                raise InvalidValueError(name, value, kind_words(kind), "")
        return profile_of(self.eeprom, checksum=self.ram.checksum)

    inputs: Inputs = field(init=False, eq=False, repr=False)

    @inputs.default
    def _inputs(self) -> Inputs:
        return Inputs(self.eeprom)

    clock: float = field(default=-LARGEST_FLOAT, kw_only=True, eq=False, repr=False)
    """The time of the last call; it is not part of equality."""

    def __attrs_post_init__(self) -> None:
        check_seconds("clock", self.clock)

    def store(self, **changes: Any) -> "State":  # noqa: ANN401 - fields of `Eeprom`
        """Return the state with changes to the EEPROM.

        Errors: `ArgumentError` for a field that it does not have; `InvalidValueError` for values that no module can
            have stored; only the changes are checked.
        """
        eeprom = _copied(self.eeprom, changes)
        if "model" in changes:  # by which nearly everything is measured
            return State(evolve(self.eeprom, **changes), self.ram, clock=self.clock)
        for name, value in changes.items():
            stored = _STORED[name]
            stored.validator(eeprom, stored, value)  # type: ignore[misc] # all of them have one
        profile = self.profile
        if not _OF_PROFILE.isdisjoint(changes):
            profile = profile_of(eeprom, checksum=self.ram.checksum)
            eeprom.check_types(profile)
        inputs = self.inputs if _OF_READINGS.isdisjoint(changes) else Inputs(eeprom)
        return _state(eeprom, self.ram, profile, inputs, self.clock)

    def keep(self, **changes: Any) -> "State":  # noqa: ANN401 - fields of `Ram`
        """Return the state with changes to the RAM.

        Errors: `ArgumentError` for a field that it does not have; `InvalidValueError` for values that it cannot have.
        """
        ram = _copied(self.ram, changes)
        for name in changes:
            ram.check(name)
        same = ram.checksum == self.ram.checksum
        profile = self.profile if same else profile_of(self.eeprom, checksum=ram.checksum)
        return _state(self.eeprom, ram, profile, self.inputs, self.clock)

    def switched(self, *, init_switch: bool) -> "State":
        """Return the state after the INIT switch, or INIT* terminal, is moved with the power on (E17)."""
        check_type("init_switch", init_switch, bool)
        return self.keep(init_switch=init_switch)

    @property
    def response_delay(self) -> float:
        """The seconds that the module waits before its response; the setting is for Modbus only."""
        return self.eeprom.response_delay / 1000 if self.ram.protocol is Protocol.MODBUS_RTU else 0.0

    @property
    def enabled(self) -> int:
        """The mask of the channels that are on, of those that the connecting mode has."""
        return self.eeprom.channel_mask & ((1 << self.profile.channels) - 1)


def _state(eeprom: Eeprom, ram: Ram, profile: Profile, inputs: Inputs, clock: float) -> State:
    """Return a state with its derived attributes, without computing them."""
    state = object.__new__(State)
    object.__setattr__(state, "eeprom", eeprom)
    object.__setattr__(state, "ram", ram)
    object.__setattr__(state, "profile", profile)
    object.__setattr__(state, "inputs", inputs)
    object.__setattr__(state, "clock", clock)
    return state


def at(state: State, now: float) -> State:
    """Return the state with another clock time; `i7000.device.advance` has the effects of time."""
    return _state(state.eeprom, state.ram, state.profile, state.inputs, now)


def power_on(eeprom: Eeprom, *, init_switch: bool = False, now: float) -> State:
    """Return a module after power-on; with the EEPROM of a running module this is a power cycle.

    Special: with the INIT switch set it has address 00, 9600 baud, N81, no checksum and DCON; what is stored stays.
        Without power the data logger has recorded nothing.
    Errors: `InvalidValueError` for a time that is not finite.
    Manual: 1.12.2, A.1; E101, E110.

    >>> module = power_on(factory(Model.M_7019R), init_switch=True, now=0.0)
    >>> module.ram.address, module.ram.protocol.name, module.eeprom.address, module.eeprom.protocol.name
    (0, 'DCON', 1, 'MODBUS_RTU')
    """
    check_type("eeprom", eeprom, Eeprom)
    check_type("init_switch", init_switch, bool)
    check_clock(now)
    ram = Ram(
        address=0 if init_switch else eeprom.address,
        line_settings=LineSettings() if init_switch else eeprom.line_settings,
        checksum=not init_switch and eeprom.report_settings.checksum,
        protocol=Protocol.DCON if init_switch else eeprom.protocol,
        init_mode=init_switch,
        init_switch=init_switch,
        fed_at=now,
    )
    log = eeprom.log.resumed(now)
    return State(eeprom if log is eeprom.log else evolve(eeprom, log=log), ram, clock=now)


def profile_of(eeprom: Eeprom, *, checksum: bool = False) -> Profile:
    """Return the profile that a host needs for a module with this EEPROM."""
    return _profile(
        eeprom.model,
        eeprom.firmware.text,
        eeprom.type_codes,
        eeprom.single_ended,
        checksum,
        eeprom.report_settings.data_format,
        eeprom.modbus_data_format,
    )


@lru_cache(maxsize=1024)
def _profile(  # noqa: PLR0913, PLR0917 - what a profile is made of
    model: Model,
    firmware: str,
    type_codes: tuple[TypeCode, ...],
    single_ended: bool,  # noqa: FBT001 - positional for the cache
    checksum: bool,  # noqa: FBT001
    data_format: DataFormat,
    modbus_data_format: ModbusDataFormat,
) -> Profile:
    known = Profile(model, firmware=Firmware(firmware), single_ended=single_ended, type_codes=())
    return evolve(
        known,
        type_codes=type_codes[: known.channels],
        checksum=checksum,
        data_format=data_format,
        modbus_data_format=modbus_data_format,
    )
