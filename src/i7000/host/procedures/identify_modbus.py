"""The identity of a module by Modbus RTU (manual 3).

Laws: asks only requests that read, and that change nothing in the module: the reset status (00273) is never read.
"""

from typing import Any

from attrs import evolve

from i7000 import modbus
from i7000.dissect import Known
from i7000.host.bus import Policy
from i7000.host.events import Answered, Declined
from i7000.host.procedures.asking import channel_types, outcome_words, types_of, unlearned, value
from i7000.host.procedures.evidence import Evidence, by_factory_type, by_types
from i7000.host.procedures.identified import Identified, Unknown, profile_of
from i7000.host.procedures.step import Procedure, ask
from i7000.modbus import Access, Area, Kind, RegisterMap
from i7000.modbus.register_map import READERS
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import Protocol
from i7000.type_codes import TypeCode

__all__ = ["identify_by_modbus"]

_MODELS = tuple(model for model in Model if Protocol.MODBUS_RTU in model.protocols)
_PLAIN = Profile(Model.M_7017, type_codes=())
"""The profile for requests that every model has."""
_TELLING = (Area.COIL, Area.INPUT_REGISTER, Area.HOLDING_REGISTER)
"""The areas that distinguish models."""


def identify_by_modbus(address: int, policy: Policy | None) -> Procedure[Identified]:
    """Make the procedure that identifies a module, or another Modbus device, that answers."""
    named = yield from ask(modbus.ReadModuleName(address), _PLAIN, policy)
    name = named.outcome.response if isinstance(named.outcome, Answered) else None
    no_name = () if name is not None else (unlearned("name", named, _PLAIN),)
    version: modbus.FirmwareVersion | None = None
    no_version: tuple[Unknown, ...] = ()
    if not isinstance(named.outcome, Declined):
        version, no_version = yield from value("firmware", modbus.ReadFirmwareVersion(address), _PLAIN, policy)
    if name is None and version is None:
        reason = "the device does not answer function 46: it is another Modbus device, or answers were lost"
        if isinstance(named.outcome, Declined):
            reason = f"{outcome_words(named, _PLAIN)}: it is another Modbus device"
        nothing = Evidence.of((), reason)
        return Identified(
            address,
            Protocol.MODBUS_RTU,
            reasons=nothing.reasons,
            unknown=(*no_name, *no_version, *nothing.unknown(None), *_unreadable(reason)),
        )
    found = Identified(
        address,
        Protocol.MODBUS_RTU,
        name=None if name is None else name.name.hex().upper(),
        version=None if version is None else bytes((version.major, version.minor, version.build)).hex().upper(),
        known=Known(firmware=None if version is None else version.firmware),
        unknown=(*no_name, *no_version, *_undefined(version)),
    )
    return (yield from _identified(found, _by_name(name), policy))


_OF_DCON = ("data_format", "checksum")
"""The settings of DCON, which Modbus does not read."""


def _unreadable(reason: str) -> tuple[Unknown, ...]:
    """Return that every setting is unknown."""
    return tuple(Unknown(name, reason) for name in ("types", "modbus_data_format", *_OF_DCON))


def _undefined(version: modbus.FirmwareVersion | None) -> tuple[Unknown, ...]:
    """Return that a version is unknown if its bytes are not those of one."""
    if version is None or version.firmware is not None:
        return ()
    return (Unknown("firmware", f"{version.major:02X} {version.minor:02X} {version.build:02X} is not a version (E75)"),)


def _by_name(name: modbus.ModuleName | None) -> Evidence:
    """Return the models that can have a name: those of a series."""
    if name is None:
        return Evidence.of(_MODELS, "the name was not learned")
    series = name.series
    if series is None:
        return Evidence.of((), f"{name.name.hex(' ').upper()} is the name of another product")
    return Evidence.of(
        [model for model in _MODELS if model.series == series], f"the name is that of the {series} series"
    )


def _identified(found: Identified, evidence: Evidence, policy: Policy | None) -> Procedure[Identified]:
    if not evidence.models:
        unknown = (*found.unknown, *evidence.unknown(None), *_unreadable(evidence.reasons[-1]))
        return evolve(found, reasons=evidence.reasons, unknown=unknown)
    address, known = found.address, found.known
    first, no_types = yield from value("types", modbus.ReadTypeCode(address, 0), _PLAIN, policy)
    code = None if first is None else TypeCode.of(first.type_code)
    if isinstance(code, TypeCode):
        able = [model for model in _MODELS if profile_of(known, model).supports(code)]
        evidence = evidence.only(able, f"the type of channel 0 is {code:02X}")
    evidence, silent = yield from _probed(address, evidence, known, policy)
    single_ended: bool | None = None
    no_mode: tuple[Unknown, ...] = ()
    types: tuple[TypeCode | None, ...] | None = None
    if evidence.models[0] is Model.M_7017Z:
        single_ended, no_mode = yield from _row(address, "single_ended", profile_of(known, Model.M_7017Z), policy)
    known = evolve(known, single_ended=single_ended)
    profile = profile_of(known, evidence.models[0])
    if profile.individually_configurable:
        types, no_types = yield from _types(address, profile, policy)
    elif any(profile_of(known, model).individually_configurable for model in evidence.models):
        no_types = (Unknown("types", "the model is unknown, and with it whether channel 0 has the type of all"),)
    else:
        types, undefined = types_of((code,))
        no_types = (*no_types, *undefined)
    modbus_format, no_format = yield from _row(address, "modbus_data_format", profile, policy)
    known = evolve(known, types=types, modbus_data_format=modbus_format)
    evidence = by_factory_type(by_types(evidence, known), known)
    if found.name is None:
        evidence = evidence.alone("the name was not learned")
    return evolve(
        found,
        known=evidence.known(known),
        candidates=evidence.candidates,
        reasons=evidence.reasons,
        unknown=(
            *found.unknown, *evidence.unknown(silent), *no_mode, *no_types, *no_format,
            *(Unknown(name, "Modbus has no request that reads it") for name in _OF_DCON),
        ),
    )  # fmt: skip


def _types(
    address: int, profile: Profile, policy: Policy | None
) -> Procedure[tuple[tuple[TypeCode | None, ...] | None, tuple[Unknown, ...]]]:
    """Make the procedure that reads the types of all channels: in one request if the map has them."""
    codes, _ = yield from _row(address, "type_code", profile, policy)
    if codes is not None:
        return types_of(codes)
    return (
        yield from channel_types(
            [modbus.ReadTypeCode(address, channel) for channel in range(profile.channels)], profile, policy
        )
    )


def _row(address: int, key: str, profile: Profile, policy: Policy | None) -> Procedure[tuple[Any, tuple[Unknown, ...]]]:
    """Make the procedure that reads a row of the map; a row that the module does not have is unknown."""
    registers = RegisterMap(profile)
    if key not in {row.name for row in registers}:
        return None, (Unknown(key, f"{profile.name} has no register for it"),)
    request: Any = registers.read(address, key)
    answer, missing = yield from value(key, request, profile, policy)
    return (None if answer is None else registers.decode(key, answer.values)), missing


# --- the model --------------------------------------------------------------------------------------------------------


def _probed(
    address: int, evidence: Evidence, known: Known, policy: Policy | None
) -> Procedure[tuple[Evidence, Unknown | None]]:
    """Make the procedure that reads what only some of the candidates have; also return the last silence.

    Shape: at most one request for each candidate, for the item that half of them have.
    """
    silent: Unknown | None = None
    asked: set[_Place] = set()
    for _ in evidence.models:
        places = {model: _places(profile_of(known, model)) - asked for model in evidence.models}
        having = {
            place: [it for it in places if place in places[it]] for place in set[_Place]().union(*places.values())
        }
        splitting = [place for place, models in having.items() if len(models) < len(places)]
        if not splitting:
            break
        place = min(splitting, key=lambda it: (abs(2 * len(having[it]) - len(places)), it[0].value, it[1]))
        asked.add(place)
        result = yield from ask(READERS[place[0]](address, place[1], 1), _PLAIN, policy)
        words = outcome_words(result, _PLAIN)
        if isinstance(result.outcome, Answered):
            evidence = evidence.only(having[place], words)
        elif isinstance(result.outcome, Declined) and known.firmware is not None:
            evidence = evidence.only(set(_MODELS).difference(having[place]), words)
        else:
            silent = unlearned("model", result, _PLAIN)
    return evidence, silent


_Place = tuple[Area, int]
"""An item of a map: its area and address."""


def _places(profile: Profile) -> set[_Place]:
    """Return the items of a map that a host can read without a change in the module."""
    return {
        (row.area, address)
        for row in RegisterMap(profile)
        if row.area in _TELLING and row.access is not Access.WRITE and row.kind is not Kind.RECORD
        for address in range(row.address, row.address + row.count)
    } - _CHANGED_BY_READING


_CHANGED_BY_READING = {
    (row.area, row.address)
    for model in _MODELS
    for row in RegisterMap(Profile(model, type_codes=()))
    if row.ends_when_read
}
"""The items that no procedure reads, whichever model it may be."""
