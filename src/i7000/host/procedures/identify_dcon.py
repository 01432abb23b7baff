"""The identity of a module by DCON (manual 2).

Laws: asks only commands that read, and that change nothing in the module.
"""

import re
from collections.abc import Callable
from typing import Any

from attrs import evolve

from i7000 import dcon
from i7000.availability import Availability
from i7000.dissect import Known
from i7000.errors import EncodeError
from i7000.host.bus import Policy
from i7000.host.events import Answered, Declined, TimedOut
from i7000.host.procedures.asking import channel_types, outcome_words, unlearned, value
from i7000.host.procedures.evidence import Evidence, by_factory_type, by_types
from i7000.host.procedures.identified import Identified, Unknown, profile_of
from i7000.host.procedures.step import Procedure, Result, ask
from i7000.models import Firmware, Model
from i7000.profile import Profile
from i7000.settings import DataFormat, Protocol
from i7000.type_codes import MIXED, TypeCode

__all__ = ["identify_by_dcon"]

_FACTORY_NAME = re.compile(r"[0-9]{4,5}[A-Z]*")
"""The form of the names that modules of this maker have from the factory."""

_PROBES: tuple[Callable[[int], dcon.Command[Any]], ...] = (
    dcon.ReadProtocol,
    dcon.ReadConnectingMode,
    dcon.ReadDiagnostics,
    dcon.ReadCjcEnabled,
    lambda address: dcon.ReadChannelTypeCode(address, 0),
    dcon.ReadChannelMask,
)
"""The commands that some models do not have, or answer in another length. The responses to neighbours differ in form,
so that a duplicate of one is not taken for the other.
"""


def identify_by_dcon(
    address: int, profile: Profile, policy: Policy | None, contact: Policy | None
) -> Procedure[Identified]:
    """Make the procedure that identifies a module that answers with the checksum setting of `profile`.

    Shape: `policy` is that of every request, except those that only some models answer: silence is an answer there, so
        that they have `contact`, the policy with which the module answered first.
    """
    configured = yield from ask(dcon.ReadConfiguration(address), profile, policy)
    named, no_name = yield from value("name", dcon.ReadModuleName(address), profile, policy)
    version, no_version = yield from value("firmware", dcon.ReadFirmwareVersion(address), profile, policy)
    known, missing = _configured(configured, profile)
    known = evolve(known, firmware=None if version is None else Firmware(version.version))
    configuration = configured.outcome.response if isinstance(configured.outcome, Answered) else None
    name = None if named is None else named.name
    evidence = _by_configuration(_by_name(name), name, configuration, known)
    evidence, known, silent = yield from _probed(address, evidence, known, contact)
    known, no_mode = yield from _connecting_mode(address, evidence, known, policy)
    known, no_types = yield from _types(address, evidence, known, configuration, policy)
    evidence = _by_name_of_one(by_factory_type(by_types(evidence, known), known), name)
    modbus = (Unknown("modbus_data_format", "DCON has no command that reads it"),)
    return Identified(
        address,
        Protocol.DCON,
        name=name,
        version=None if version is None else version.version,
        known=evidence.known(known),
        line_settings=None if configuration is None else configuration.line_settings,
        stored_address=None if configuration is None or configuration.address == address else configuration.address,
        candidates=evidence.candidates,
        reasons=evidence.reasons,
        unknown=(
            *no_name,
            *no_version,
            *missing,
            *evidence.unknown(silent),
            *no_mode,
            *no_types,
            *(modbus if any(Protocol.MODBUS_RTU in model.protocols for model in evidence.models) else ()),
        ),
    )


def _configured(configured: Result[dcon.Configuration], profile: Profile) -> tuple[Known, tuple[Unknown, ...]]:
    """Return what the configuration says, and the checksum setting with which the module answers."""
    known = Known(checksum=profile.checksum)
    outcome = configured.outcome
    if not isinstance(outcome, Answered):
        return known, (unlearned("data_format", configured, profile),)
    data_format = outcome.response.report_settings.data_format
    if not isinstance(data_format, DataFormat):
        return known, (Unknown("data_format", f"the data format {data_format} is not defined", outcome),)
    return evolve(known, data_format=data_format), ()


# --- the model --------------------------------------------------------------------------------------------------------


def _by_name(name: str | None) -> Evidence:
    """Return the models that can have a name."""
    if name is None:
        return Evidence.of(Model, "the name was not learned")
    named = [model for model in Model if model.factory_name == name]
    if named:
        return Evidence.of(named, f"{name} is the factory name of {' and '.join(model.value for model in named)}")
    others = [model for model in Model if model.series != name[:4]]
    if len(others) < len(Model):
        return Evidence.of(Model, f"{name} is not a factory name").doubt(others, f"{name} is not of its series")
    if _FACTORY_NAME.fullmatch(name):
        return Evidence.of((), f"{name} is the name of another product")
    return Evidence.of(Model, f"{name} is not a factory name")


def _by_name_of_one(evidence: Evidence, name: str | None) -> Evidence:
    """Doubt the only model that is left if the name of the module does not confirm it."""
    if name is None:
        return evidence.alone("the name was not learned")
    if any(model.factory_name == name for model in evidence.models):
        return evidence
    return evidence.alone(f"{name} is not its factory name")


def _by_configuration(
    evidence: Evidence, name: str | None, configuration: dcon.Configuration | None, known: Known
) -> Evidence:
    """Keep the models that can have the type code of the configuration."""
    if configuration is None or not evidence.models:
        return evidence
    code = TypeCode.of(configuration.type_code)
    if code == MIXED or isinstance(code, TypeCode):
        what = "the channels have different types" if code == MIXED else f"the type is {code:02X}"
        models = [model for model in Model if _can_be_configured(_untyped(known, model), code)]
        if not set(evidence.models).intersection(models):
            evidence = Evidence.of(
                Model, f"{name} was given to the module: the models of that name do not have its type"
            )
        unused = [model for model in models if code != MIXED and not _untyped(known, model).supports(code)]
        return evidence.only(models, what).doubt(unused, f"it has no type {code:02X}")
    if any(model.factory_name == name for model in Model):
        return evidence  # Models that do not use it may have anything there (E81).
    return Evidence.of((), f"the type code {code:02X} is that of another product")


def _can_be_configured(profile: Profile, code: TypeCode | int) -> bool:
    """Return whether a module can have a type code in its configuration: `MIXED` if the types of channels differ."""
    if code == MIXED:
        return profile.individually_configurable
    return not profile.model.type_by_configuration or profile.supports(code)


def _untyped(known: Known, model: Model) -> Profile:
    return profile_of(evolve(known, types=None), model)


def _probed(
    address: int, evidence: Evidence, known: Known, contact: Policy | None
) -> Procedure[tuple[Evidence, Known, Unknown | None]]:
    """Make the procedure that asks what only some of the candidates answer; also return the last silence."""
    silent: Unknown | None = None
    for probe in _PROBES:
        command = probe(address)
        forms = {model: _form(command, _untyped(known, model)) for model in evidence.models}
        groups = evidence.groups(forms.__getitem__)
        if len(groups) < 2:
            continue
        for form, models in groups.items():
            if form is None:
                continue
            profile = _untyped(known, models[0])
            result = yield from _once(command, profile, contact)
            words = outcome_words(result, profile)
            if isinstance(result.outcome, Answered):
                evidence = evidence.only(models, words)
                if isinstance(result.outcome.response, dcon.ConnectingMode):
                    known = evolve(known, single_ended=result.outcome.response.single_ended)
                break
            if isinstance(result.outcome, Declined) and known.firmware is not None:
                evidence = evidence.only(set(Model).difference(models), words)
            else:
                silent = unlearned("model", result, profile)
                evidence = evidence.doubt(models, words)
    return evidence, known, silent


def _once(command: dcon.Command[Any], profile: Profile, contact: Policy | None) -> Procedure[Result[Any]]:
    """Make the procedure that asks a second time only if something other than the response came."""
    result = yield from ask(command, profile, contact)
    if isinstance(result.outcome, TimedOut) and result.others:
        result = yield from ask(command, profile, contact)
    return result


def _form(command: dcon.Command[Any], profile: Profile) -> tuple[bytes, int] | None:
    """Return the form of an exchange with a module, by which models can be distinguished; None if it has none."""
    try:
        return dcon.encode(command, profile), dcon.longest_response(command, profile)
    except EncodeError:
        return None


# --- channels ---------------------------------------------------------------------------------------------------------


def _connecting_mode(
    address: int, evidence: Evidence, known: Known, policy: Policy | None
) -> Procedure[tuple[Known, tuple[Unknown, ...]]]:
    asked = known.single_ended is not None
    if asked or not evidence.models or evidence.models[0] not in Availability.SERIES_7017Z.gates:
        return known, ()
    profile = _untyped(known, evidence.models[0])
    mode, missing = yield from value("single_ended", dcon.ReadConnectingMode(address), profile, policy)
    return (known if mode is None else evolve(known, single_ended=mode.single_ended)), missing


def _types(
    address: int, evidence: Evidence, known: Known, configuration: dcon.Configuration | None, policy: Policy | None
) -> Procedure[tuple[Known, tuple[Unknown, ...]]]:
    """Make the procedure that reads the types: from the configuration if it has that of all channels."""
    if not evidence.models:
        return known, (Unknown("types", evidence.reasons[-1]),)
    profile = _untyped(known, evidence.models[0])
    code = None if configuration is None else TypeCode.of(configuration.type_code)
    if isinstance(code, TypeCode) and profile.model.type_by_configuration:
        return evolve(known, types=(code,)), ()
    if not profile.individually_configurable:
        reason = "the configuration was not learned" if code is None else f"the type code {code:02X} is not defined"
        return known, (Unknown("types", reason),)
    commands = [dcon.ReadChannelTypeCode(address, channel) for channel in range(profile.channels)]
    types, missing = yield from channel_types(commands, profile, policy)
    return evolve(known, types=types), missing
