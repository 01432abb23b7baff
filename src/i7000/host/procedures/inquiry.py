"""Questions to one module: what it is, and how it is set.

Laws: every question ends, and what a line does is a value: a question without an answer has a reason instead. A module
that answers nothing at all is asked no more.
"""

from collections.abc import Callable, Mapping
from typing import Any

from attrs import evolve, field

from i7000 import dcon, modbus
from i7000.arguments import check_int, check_type
from i7000.errors import EncodeError, I7000Error, InvalidValueError
from i7000.frozen import frozen
from i7000.host.events import Answered, Declined, Rejected
from i7000.host.procedures.settings import Setting, settings_of
from i7000.host.procedures.step import Procedure, ask
from i7000.host.procedures.values import Plain
from i7000.message import Query, Response
from i7000.modbus.request import LAST_ADDRESS
from i7000.models import Firmware
from i7000.profile import Profile
from i7000.settings import LineSettings, Protocol

__all__ = [
    "Answer",
    "Here",
    "Seen",
    "ask_for",
    "ask_setting",
    "identity",
    "is_there",
    "plain_value",
    "profile_after",
    "refined",
    "spot",
]

GONE = "the module does not answer"


@frozen
class Here:
    """Where a module is, and how it is spoken to.

    Shape: `line` has the line settings of the host, or None as long as they are those of the module.
    """

    address: int
    profile: Profile
    protocol: Protocol
    line: LineSettings | None = None


def spot(address: int, profile: Profile, protocol: Protocol, line: LineSettings | None = None) -> Here:
    """Return where a module is.

    Errors: `ArgumentError`; `InvalidValueError` for an address, or a protocol that the model does not have.
    """
    check_int("address", address)
    check_type("profile", profile, Profile)
    check_type("protocol", protocol, Protocol)
    check_type("line", line, LineSettings, optional=True)
    low, high = (1, LAST_ADDRESS) if protocol is Protocol.MODBUS_RTU else (0, 0xFF)
    if not low <= address <= high:
        raise InvalidValueError("address", address, f"{low}..{high} by {protocol.name}", "")
    if protocol not in profile.model.protocols:
        raise InvalidValueError("protocol", protocol.name, f"DCON: {profile.model.value} has no Modbus", "1.12")
    return Here(address, profile, protocol, line)


@frozen
class Answer:
    """The response to a question, or the reason why there is none."""

    response: Any = None
    reason: str = ""
    silent: bool = False
    """Whether nothing came at all."""


class Seen:
    """What a procedure has seen of a module so far."""

    def __init__(self) -> None:
        self.answers: dict[object, Answer] = {}
        self.silent: dict[object, Answer] = {}
        """The kinds of requests that the module does not answer, although it answers others."""
        self.gone = False


def ask_for(here: Here, query: Any) -> Procedure[Answer]:  # noqa: ANN401 - a query of either protocol
    """Return the procedure of one question."""
    result = yield from ask(query, here.profile)
    outcome = result.outcome
    if isinstance(outcome, Answered):
        return Answer(outcome.response)
    if isinstance(outcome, Declined):
        return Answer(None, refusal(outcome))
    if any(isinstance(it, Rejected) for it in result.others):
        return Answer(None, "the answer is not understood")
    return Answer(None, "no answer", silent=True)


def refusal(outcome: Declined) -> str:
    """Return a refusal in words."""
    if isinstance(outcome.response, dcon.Refused):
        return "refused"
    return f"refused: exception {outcome.response.describe()['exception_code']}"


def is_there(here: Here) -> Procedure[bool]:
    """Return whether the module answers a request that every module has: one of several, if its firmware lacks some."""
    for question in _QUESTIONS[here.protocol]:
        answer = yield from ask_for(here, question(here.address))
        if not answer.silent:
            return True
    return False


_QUESTIONS: Mapping[Protocol, tuple[Callable[[int], Query[Response]], ...]] = {
    Protocol.DCON: (dcon.ReadConfiguration, dcon.ReadModuleName, dcon.ReadFirmwareVersion),
    Protocol.MODBUS_RTU: (modbus.ReadModuleName, lambda address: modbus.ReadInputRegisters(address, 0, 1)),
}


def ask_setting(here: Here, setting: Setting, seen: Seen) -> Procedure[Answer]:
    """Return how a setting is set, from the module or from what was seen before."""
    query = setting.access.read(here.address)
    family = setting.access.family
    if query in seen.answers:
        return seen.answers[query]
    if seen.gone:
        return Answer(None, GONE, silent=True)
    if family in seen.silent:
        return seen.silent[family]
    answer = yield from ask_for(here, query)
    if answer.silent:
        if (yield from is_there(here)):
            answer = Answer(None, "no answer, although the module answers other commands")
            seen.silent[family] = answer
        else:
            seen.gone = True
            answer = Answer(None, GONE, silent=True)
    seen.answers[query] = answer
    return answer


def plain_value(setting: Setting, answer: Answer) -> tuple[Plain | None, str]:
    """Return the value of a setting in an answer; or None, and the reason why there is none."""
    if answer.response is None:
        return None, answer.reason
    try:
        return setting.values.plain(setting.name, setting.access.value(answer.response)), ""
    except I7000Error as error:
        return None, f"unexpected value: {error}"


# --- what a module is -------------------------------------------------------------------------------------------------


@frozen
class Identity:
    """What a module says that it is: its firmware and its name as sent, or the reasons why they are unknown."""

    firmware: str | None = None
    name: str | None = None
    unread: dict[str, str] = field(factory=dict)


def identity(here: Here) -> Procedure[Identity]:
    """Return the firmware and the name of a module."""
    rtu = here.protocol is Protocol.MODBUS_RTU
    firmware = yield from ask_firmware(here)
    name = yield from ask_for(here, (modbus if rtu else dcon).ReadModuleName(here.address))
    unread = {key: it.reason for key, it in (("firmware", firmware), ("name", name)) if it.response is None}
    return Identity(
        firmware.response,
        None if name.response is None else _name_text(name.response),
        unread,
    )


def ask_firmware(here: Here) -> Procedure[Answer]:
    """Return the firmware of a module; the response is the text of its version."""
    rtu = here.protocol is Protocol.MODBUS_RTU
    answer = yield from ask_for(here, (modbus if rtu else dcon).ReadFirmwareVersion(here.address))
    return answer if answer.response is None else Answer(_firmware_text(answer.response))


def _firmware_text(response: dcon.FirmwareVersion | modbus.FirmwareVersion) -> str:
    """Return the version as it was sent; undefined bytes in hex."""
    if isinstance(response, dcon.FirmwareVersion):
        return response.version
    return str(response.firmware or bytes((response.major, response.minor, response.build)).hex())


def _name_text(response: dcon.ModuleName | modbus.ModuleName) -> str:
    """Return the name as it was sent; by Modbus the series, or undefined bytes in hex."""
    if isinstance(response, dcon.ModuleName):
        return response.name
    return response.series or response.name.hex()


def refined(here: Here, firmware: str | None, seen: Seen) -> Procedure[Here]:
    """Return where the module is, with the firmware and the connecting mode that it has.

    Shape: `firmware` is what the module says; a firmware in the profile is kept.
    """
    profile = here.profile
    if profile.firmware is None and firmware is not None:
        profile = _with_firmware(profile, firmware)
    here = evolve(here, profile=profile)
    for setting in settings_of(profile, here.protocol):
        if setting.name == "single_ended":
            answer = yield from ask_setting(here, setting, seen)
            value, _ = plain_value(setting, answer)
            here = evolve(here, profile=profile_after(profile, setting, value))
    return here


def _with_firmware(profile: Profile, text: str) -> Profile:
    """Return a profile with a firmware, if it is one; types that it does not have are left out."""
    try:
        firmware = Firmware(text)
    except EncodeError:
        return profile
    try:
        return evolve(profile, firmware=firmware)
    except EncodeError:
        return evolve(profile, firmware=firmware, type_codes=())


def profile_after(profile: Profile, setting: Setting, value: Plain | None) -> Profile:
    """Return the profile of a module after a setting is known; the checksum has a time of its own and is left out."""
    if value is None:
        return profile
    typed: Any = setting.values.typed(setting.name, value)
    base = setting.name.partition(".")[0]
    if base in ("data_format", "modbus_data_format"):
        return evolve(profile, **{base: typed})
    if base == "single_ended" and typed is not profile.single_ended:
        return evolve(profile, single_ended=typed, type_codes=())
    if base == "type_code":
        types = (typed if setting.channel in (None, at) else code for at, code in enumerate(profile.type_codes))
        return evolve(profile, type_codes=tuple(types))
    return profile
