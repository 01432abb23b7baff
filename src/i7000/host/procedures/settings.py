"""Everything that can be set on a module and that it remembers without power: one table for both protocols.

A setting has one name, whatever the protocol. Settings of a channel have its number behind a point: ``type_code.3``.
How a value is written on the line stands in `i7000.dcon` and in the rows of `i7000.modbus.RegisterMap`.

Laws: calibration is not among the settings. Clocks, counters and what a module forgets without power are not either:
`NOT_SETTINGS` has their names.
"""

from collections.abc import Callable, Iterable, Mapping
from enum import Enum
from functools import lru_cache
from types import MappingProxyType

from i7000 import dcon, modbus
from i7000.arguments import check_type
from i7000.availability import Availability
from i7000.errors import InvalidValueError
from i7000.frozen import frozen
from i7000.host.procedures.access import Access, Place, message, register, registers_of
from i7000.host.procedures.values import Channels, Choice, Name, Quantity, Values, choices, switch, types
from i7000.modbus.channel_settings import FAST_MODE_BIT, FILTER_BIT
from i7000.modbus.cold_junction import FIRST_CHANNEL
from i7000.modbus.registers import Kind, Register
from i7000.modbus.request import LAST_ADDRESS
from i7000.models import Firmware, Model
from i7000.profile import Profile
from i7000.settings import BaudRate, CharacterFormat, DataFormat, Protocol

__all__ = ["NOT_SETTINGS", "Hazard", "Setting", "find_setting", "hazard_of", "known_settings", "settings_of", "why_not"]


class Hazard(Enum):
    """What a wrong value of a setting can do."""

    PLAIN = "plain"
    """The module can still be reached."""
    LOSES = "loses"
    """The module may not be found again: its address, line settings, protocol or checksum change."""


@frozen
class Row:
    """A setting of one or more models: where it stands in each protocol, and which values it can have.

    Shape: places of Modbus in the order of preference. Without `values`, the row of the address map defines them.
    """

    name: str
    dcon: Place | None = None
    modbus: tuple[Place, ...] = ()
    values: Callable[[Profile], Values] | None = None
    hazard: Hazard = Hazard.PLAIN
    deferred: bool = False
    """Whether a change is in use from the next power-on only, and needs the INIT switch by DCON."""
    of_channels: bool = False
    has: Callable[[Profile], bool] = lambda _: True

    def places(self, protocol: Protocol) -> Iterable[Place]:
        """Return the places in a protocol."""
        if protocol is Protocol.MODBUS_RTU:
            return self.modbus
        return () if self.dcon is None else (self.dcon,)


@frozen
class Setting:
    """A setting that a module has, in one protocol.

    Shape: `channel` is None for a setting of the whole module.
    """

    name: str
    channel: int | None
    hazard: Hazard
    deferred: bool
    """Whether a change is in use from the next power-on only, and needs the INIT switch by DCON."""
    values: Values
    access: Access

    @property
    def unit(self) -> str | None:
        """The unit of its values."""
        return self.values.unit

    @property
    def allowed(self) -> str:
        """The values that it can have, for messages."""
        return self.values.allowed


# --- the table --------------------------------------------------------------------------------------------------------


def _by_register(name: str, dcon_place: Place | None = None, **facts: object) -> Row:
    """Return a row whose register has the same name."""
    return Row(name, dcon_place, (register(name),), **facts)  # type: ignore[arg-type] # fields of `Row`


def _configuration(path: str, response_path: str = "") -> Place:
    return message(dcon.ReadConfiguration, dcon.SetConfiguration, path, response_path=response_path)


def _communication(path: str) -> Place:
    return message(modbus.ReadCommunicationSettings, modbus.SetCommunicationSettings, path)


def _miscellaneous(response_path: str, bit: int) -> Place:
    reader, writer = modbus.ReadMiscellaneousSettings, modbus.SetMiscellaneousSettings
    return message(reader, writer, "settings", response_path=response_path, bit=bit)


_OFFSETS = modbus.ReadCjcOffset, modbus.SetCjcOffset, "offset"
_CHANNEL_OFFSETS = message(*_OFFSETS, first=FIRST_CHANNEL, per_unit=10)
_DATE = ("year", "month", "date", "hour", "minute", "second")
_TYPE_CODE = message(modbus.ReadTypeCode, modbus.SetTypeCode, "type_code")

ROWS = (
    Row(
        "single_ended",
        message(dcon.ReadConnectingMode, dcon.SetConnectingMode, "single_ended"),
        (register("single_ended"),),
    ),
    Row(
        "type_code", _configuration("type_code"), (register("module_type_code"), _TYPE_CODE), types,
        has=lambda profile: not profile.individually_configurable,
    ),
    Row(
        "type_code", message(dcon.ReadChannelTypeCode, dcon.SetChannelTypeCode, "type_code"),
        (register("type_code"), _TYPE_CODE), types,
        of_channels=True, has=lambda profile: profile.individually_configurable,
    ),
    Row("data_format", _configuration("report_settings.data_format"), values=lambda _: choices(DataFormat)),
    _by_register("modbus_data_format"),
    Row(
        "filter", _configuration("report_settings.filter"),
        (register("filter"), _miscellaneous("filter", FILTER_BIT)), has=lambda profile: profile.has_filter,
    ),
    Row(
        "fast_mode", _configuration("report_settings.fast_mode"),
        (register("fast_mode"), _miscellaneous("fast_mode", FAST_MODE_BIT)),
        has=lambda profile: profile.model.fast_mode,
    ),
    _by_register("sampling_rate"),
    Row(
        "channel_mask", message(dcon.ReadChannelMask, dcon.SetChannelMask, "mask"),
        (message(modbus.ReadChannelMask, modbus.SetChannelMask, "mask"),), lambda profile: Channels(profile.channels),
    ),
    Row(
        "cjc_enabled", message(dcon.ReadCjcEnabled, dcon.SetCjcEnabled, "enabled"),
        (register("cjc_enabled"), message(modbus.ReadCjcEnabled, modbus.SetCjcEnabled, "enabled")),
    ),
    Row(
        "module_cjc_offset", message(dcon.ReadCjcOffset, dcon.SetCjcOffset, "offset"),
        (register("module_cjc_offset"), message(*_OFFSETS, per_unit=100)),
    ),
    Row(
        "cjc_offset", None, (register("cjc_offset"), _CHANNEL_OFFSETS), of_channels=True,
        has=lambda profile: profile.model.series == "7018",
    ),
    Row(
        "cjc_offset", None, (register("cjc_offset"),), of_channels=True,
        has=lambda profile: profile.model.series == "7019",
    ),
    Row(
        "temperature_offset", None, (register("temperature_offset"), _CHANNEL_OFFSETS), of_channels=True,
        has=lambda profile: profile.model.series == "7019",
    ),
    _by_register("open_wire_detection", message(dcon.ReadOpenWireDetection, dcon.SetOpenWireDetection, "enabled")),
    Row("name", message(dcon.ReadModuleName, dcon.SetModuleName, "name"), values=lambda _: Name()),
    _by_register("response_delay"),
    _by_register("host_watchdog_mode"),
    _by_register(
        "host_watchdog_timeout", message(dcon.ReadHostWatchdogTimeout, dcon.SetHostWatchdogTimeout, "timeout")
    ),
    _by_register(
        "host_watchdog_enabled", message(dcon.ReadHostWatchdogTimeout, dcon.SetHostWatchdogTimeout, "enabled")
    ),
    _by_register("big_endian"),
    *(_by_register(f"log_period_{part}") for part in _DATE[3:]),
    *(_by_register(f"log_{end}_{part}") for end in ("start", "end") for part in _DATE),
    _by_register("log_overwrite"),
    _by_register("log_command"),
    Row(
        "checksum", _configuration("report_settings.checksum"), values=lambda _: switch(),
        hazard=Hazard.LOSES, deferred=True,
    ),
    Row(
        "character_format", _configuration("line_settings.character_format"),
        (register("line_settings", "character_format"), _communication("line_settings.character_format")),
        lambda _: choices(CharacterFormat), Hazard.LOSES, deferred=True,
        has=lambda profile: profile.has_character_formats,
    ),
    Row(
        "baud_rate", _configuration("line_settings.baud_rate"),
        (register("line_settings", "baud_rate"), _communication("line_settings.baud_rate")),
        lambda _: choices(BaudRate), Hazard.LOSES, deferred=True,
    ),
    Row(
        "protocol", message(dcon.ReadProtocol, dcon.SetProtocol, "protocol"),
        (register("protocol"), _communication("protocol")), hazard=Hazard.LOSES, deferred=True,
    ),
    Row(
        "address", _configuration("new_address", response_path="address"), values=lambda _: Quantity(0, 0xFF),
        hazard=Hazard.LOSES,
    ),
    Row(
        "address", None,
        (
            register("module_address"),
            message(modbus.ReadCommunicationSettings, modbus.SetModuleAddress, "new_address", response_path="address"),
        ),
        lambda _: Quantity(1, LAST_ADDRESS), Hazard.LOSES,
    ),
)  # fmt: skip
"""All settings, in the order in which they are restored: the connecting mode decides which channels there are, the data
logger starts when its times are set, and what could lose the module comes last.
"""

NOT_SETTINGS: Mapping[str, str] = MappingProxyType({
    "cjc_update": "a module forgets it without power",
    "load_factory_calibration": "calibration is never changed here",
    "host_watchdog_timeout_count": "it is a counter",
    "host_watchdog_timed_out": "it is a state of the module",
    "log_read_index": "it is a place in the log",
    "rtc_epoch": "it is the clock",
    **dict.fromkeys((f"rtc_{part}" for part in _DATE), "it is the clock"),
})  # fmt: skip
"""The rows of the address maps that can be written and are not settings, and why."""


# --- the settings of a module -----------------------------------------------------------------------------------------


def settings_of(profile: Profile, protocol: Protocol) -> tuple[Setting, ...]:
    """Return the settings of a module that a protocol can read and write, in the order of the table.

    Shape: a setting of the channels is there for each channel of the connecting mode.
    Errors: `ArgumentError`.

    >>> [setting.name for setting in settings_of(Profile(Model.I_7017), Protocol.DCON)][:4]
    ['type_code', 'data_format', 'filter', 'channel_mask']
    """
    check_type("profile", profile, Profile)
    check_type("protocol", protocol, Protocol)
    return tuple(_settings_of(profile, protocol).values())


def find_setting(name: str, profile: Profile, protocol: Protocol) -> Setting:
    """Return a setting of a module by its name.

    Errors: `InvalidValueError` for a name that the module does not have in this protocol; `ArgumentError`.

    >>> find_setting("host_watchdog_timeout", Profile(Model.I_7017), Protocol.DCON).allowed
    '0..25.5 s in steps of 0.1'
    """
    check_type("name", name, str)
    check_type("profile", profile, Profile)
    check_type("protocol", protocol, Protocol)
    settings = _settings_of(profile, protocol)
    if name not in settings:
        raise InvalidValueError("name", name, _names(settings), "", why_not(name, profile, protocol))
    return settings[name]


@lru_cache(maxsize=len(Model))
def known_settings(model: Model) -> Mapping[str, Setting]:
    """Return the settings that a model can have, with any firmware, and in any protocol and connecting mode.

    >>> {"type_code", "type_code.7"} <= set(known_settings(Model.M_7018R))
    True
    """
    modes = (True, False) if model in Availability.SERIES_7017Z.gates else (False,)
    found: dict[str, Setting] = {}
    for firmware in (None, *_OLDER):
        for single_ended in modes:
            profile = Profile(model, firmware=firmware, single_ended=single_ended, type_codes=())
            for protocol in Protocol:
                found = {**_settings_of(profile, protocol), **found}
    return MappingProxyType(found)


_OLDER = (Firmware("B3.0"), Firmware("A0.0"))
"""One with all types and, on models that have them for each channel now, one type for all channels; and the oldest."""


def hazard_of(name: str) -> Hazard:
    """Return what a wrong value of a setting can do, by its name.

    >>> hazard_of("address"), hazard_of("type_code.3")
    (<Hazard.LOSES: 'loses'>, <Hazard.PLAIN: 'plain'>)
    """
    check_type("name", name, str)
    return _HAZARDS.get(name.partition(".")[0], Hazard.PLAIN)


_HAZARDS = {row.name: row.hazard for row in ROWS}


def _names(settings: Mapping[str, Setting]) -> str:
    """Return the names of settings for messages; those of channels once, with the range of the channels."""
    last = {name.partition(".")[0]: setting.channel for name, setting in settings.items()}
    return ", ".join(name if channel is None else f"{name}.0..{channel}" for name, channel in last.items())


def why_not(name: str, profile: Profile, protocol: Protocol) -> str:
    """Return why a name is not that of a setting of the module."""
    base = name.partition(".")[0]
    if base in NOT_SETTINGS:
        return f"{name} is not a setting: {NOT_SETTINGS[base]}"
    if any(name in _settings_of(profile, other) for other in Protocol if other is not protocol):
        return f"{profile.name} has no setting {name} by {protocol.name}"
    kind = "setting" if base in _HAZARDS else "such setting as"
    return f"{profile.name} has no {kind} {name}"


@lru_cache(maxsize=64)
def _settings_of(profile: Profile, protocol: Protocol) -> Mapping[str, Setting]:
    found: dict[str, Setting] = {}
    for row in ROWS:
        for channel in range(profile.channels) if row.of_channels else (None,):
            places = row.places(protocol) if row.has(profile) else ()
            access = next((it for it in (place(profile, channel) for place in places) if it is not None), None)
            if access is not None:
                name = row.name if channel is None else f"{row.name}.{channel}"
                values = _defined(profile.model, row.name) if row.values is None else row.values(profile)
                found[name] = Setting(name, channel, row.hazard, row.deferred, values, access)
    return MappingProxyType(found)


@lru_cache(maxsize=512)
def _defined(model: Model, name: str) -> Values:
    """Return the values that a row of an address map defines: of this model, or else of another one that has it."""
    models = (model, *(it for it in Model if it.series == model.series), *Model)
    rows = (row for it in models for row in registers_of(Profile(it, type_codes=())) if row.name == name)
    return _of_row(next(rows))


def _of_row(row: Register) -> Values:
    """Return the values of a row of an address map."""
    if row.labels:
        return Choice(tuple((label, bool(at) if row.kind is Kind.BOOL else at) for at, label in enumerate(row.labels)))
    if isinstance(row.values, type) and issubclass(row.values, Enum):
        return choices(row.values)
    if row.kind is Kind.BOOL:
        return switch()
    return Quantity(row.minimum or 0, row.maximum or 0, 1 if row.scale is None else round(1 / row.scale), row.unit)
