"""What is wrong with a single frame: the rule that it breaks, from what the listener found out about it.

Laws: the listener decodes. Where it names an error, the frame is heard again without one mistake (upper case, no
checksum, another CRC), and the first mistake that explains the error names the rule.
"""

from collections.abc import Mapping
from functools import cache, lru_cache
from typing import Any, NamedTuple

from attrs import evolve

from i7000 import dcon, modbus
from i7000.conformance.judge_rules import Rule
from i7000.dissect import Heard, Knowledge, Known, Line, Meaning, Place, hear_frame, meanings
from i7000.errors import DecodeError, Fault
from i7000.modbus.request import EXCEPTION_BIT, MODULE_SETTINGS
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import Protocol

__all__ = ["STORING", "Broken", "answers", "driver_broken", "duty_after", "module_broken", "resembles", "writes_eeprom"]

_RTU = Protocol.MODBUS_RTU


class Broken(NamedTuple):
    """A rule that a frame breaks, and how, in words."""

    rule: Rule
    what: str


def driver_broken(heard: Heard, known: Known) -> Broken | None:
    """Return the rule that a command or request breaks by itself; None if it breaks none."""
    if heard.error is not None:
        rule = _of_command(heard.wire, heard.error, known) if heard.protocol is Protocol.DCON else _of_request(heard)
        return rule and Broken(rule, _words(heard))
    rule = _of_checksum(heard, Rule.DRIVER_CHECKSUM_MISSING, Rule.DRIVER_CHECKSUM_UNEXPECTED)
    if rule is not None:
        return Broken(rule, heard.contradictions[0])
    if heard.contradictions:
        return Broken(Rule.LACKS_COMMAND, heard.contradictions[0])
    if not any(meaning.models for meaning in heard.meanings):
        return Broken(Rule.LACKS_COMMAND, "; ".join(heard.notes))
    return None


def module_broken(heard: Heard, place: Place, asked: bytes, known: Known) -> Broken | None:
    """Return the rule that the answer to the frame `asked`, at `place`, breaks by itself; None if it breaks none.

    Shape: `known` is what is known of the module that was asked.
    Special: the listener may have read the frame as the answer to another one; it is heard again then.
    """
    if heard.answers != place and (heard.error is None or heard.protocol is _RTU):
        heard = _answering(asked, heard.wire, heard.protocol, known)
    if heard.error is not None and heard.meanings:
        return Broken(Rule.READING, str(heard.error))
    if heard.error is not None:
        of = _of_modbus_answer if heard.protocol is _RTU else _of_dcon_answer
        return Broken(of(heard.wire, heard.error, asked, known), _words(heard))
    for meaning in heard.meanings:
        code = getattr(meaning.message, "exception_code", None)
        if code is not None and code not in _CODES:
            return Broken(Rule.EXCEPTION_CODE, f"the exception code is {code:02X}")
    if not heard.contradictions:
        return None
    rule = _of_checksum(heard, Rule.MODULE_CHECKSUM_MISSING, Rule.MODULE_CHECKSUM_UNEXPECTED)
    if rule is not None and (rule is Rule.MODULE_CHECKSUM_MISSING) is not _is_sealed(asked):
        return None  # It answers as it was asked: its setting has changed, as it does at a power-on.
    return Broken(rule or Rule.CONTRADICTION, "; ".join(heard.contradictions))


_CODES = frozenset(map(int, modbus.ExceptionCode))


def _words(heard: Heard) -> str:
    """Return why a frame cannot be decoded: its likely causes, or else the error."""
    return "; ".join(heard.notes) or str(heard.error)


def _of_checksum(heard: Heard, missing: Rule, unexpected: Rule) -> Rule | None:
    """Return the rule that is broken by a frame which has a checksum where the module uses none, or the reverse."""
    for fact in (fact for meaning in heard.meanings for fact in meaning.refuted if fact.name == "checksum"):
        return missing if fact.value else unexpected
    return None


# --- DCON -------------------------------------------------------------------------------------------------------------

_DIGITS = frozenset(b"0123456789ABCDEF")
_SUM = len("FF")


def _reads(body: bytes, asked: bytes | None, known: Known) -> bool:
    """Return whether a body is a message, or the answer to a command if that is given."""
    try:
        (meaning, *_) = meanings(body + b"\r", asked, known)
    except DecodeError:
        return False
    return meaning.misfit is None and (asked is None or meaning.command is not None)


def _is_sealed(command: bytes) -> bool:
    """Return whether a command has a checksum: without its last digits it is one, and they are the sum of it."""
    body = command.rstrip(b"\r")
    return body[-_SUM:] == b"%02X" % dcon.checksum(body[:-_SUM]) and _reads(body[:-_SUM], None, _PLAIN)


_PLAIN = Known(checksum=False)


def _of_command(wire: bytes, error: DecodeError, known: Known) -> Rule:
    body = wire.rstrip(b"\r\n")
    plain, either = evolve(known, checksum=False), evolve(known, checksum=None)
    if error.fault is Fault.TERMINATOR:
        return Rule.DRIVER_TERMINATOR
    if body.upper() != body and _reads(body.upper(), None, either):
        return Rule.DRIVER_LOWER_CASE
    if known.checksum and _reads(body, None, plain):
        return Rule.DRIVER_CHECKSUM_MISSING
    if _DIGITS.issuperset(body[-_SUM:]) and _reads(body[:-_SUM], None, plain):
        right = int(body[-_SUM:], 16) == dcon.checksum(body[:-_SUM])
        return Rule.DRIVER_CHECKSUM_UNEXPECTED if right else Rule.DRIVER_CHECKSUM_WRONG
    if _reads(body, None, Known()):
        return Rule.LACKS_COMMAND
    return Rule.NO_COMMAND


_ANSWER_RULES: Mapping[Fault, Rule] = {
    Fault.LENGTH: Rule.LENGTH,
    Fault.LEADING: Rule.LEADING,
    Fault.ADDRESS: Rule.MODULE_ADDRESS,
    Fault.CHECKSUM: Rule.MODULE_CHECKSUM_WRONG,
    Fault.NUMBER: Rule.READING,
    Fault.VALUE: Rule.VALUE,
}
"""What is wrong with an answer by DCON, by the fault that the decoder found; any other is a character."""


def _of_dcon_answer(wire: bytes, error: DecodeError, asked: bytes, known: Known) -> Rule:
    body, command = wire.rstrip(b"\r\n"), asked.rstrip(b"\r")
    plain = evolve(known, checksum=False)
    sealed = _is_sealed(asked)
    command = (command[:-_SUM] if sealed else command) + b"\r"
    if error.fault is Fault.TERMINATOR:
        return Rule.MODULE_TERMINATOR
    if body.upper() != body:
        upper = body.upper()[:-_SUM] if sealed else body.upper()
        if _reads(upper, command, plain):
            return Rule.MODULE_LOWER_CASE
    if sealed and _reads(body, command, plain):
        return Rule.MODULE_CHECKSUM_MISSING
    if _DIGITS.issuperset(body[-_SUM:]) and _reads(body[:-_SUM], command, plain):
        if int(body[-_SUM:], 16) == dcon.checksum(body[:-_SUM]):
            return Rule.MODULE_CHECKSUM_UNEXPECTED
        return Rule.MODULE_CHECKSUM_WRONG if sealed else Rule.LENGTH
    return _ANSWER_RULES.get(error.fault, Rule.ALPHABET)


# --- Modbus -----------------------------------------------------------------------------------------------------------

_REQUEST_RULES: Mapping[Fault, Rule] = {
    Fault.CRC: Rule.DRIVER_CRC,
    Fault.ADDRESS: Rule.DRIVER_ADDRESS,
    Fault.RANGE: Rule.BOUNDS,
    Fault.COUNT: Rule.BOUNDS,
    Fault.VALUE: Rule.BOUNDS,
    Fault.RESERVED: Rule.BOUNDS,
}
"""What is wrong with a request, by the fault that the decoder found; any other is its form."""
_RESPONSE_RULES: Mapping[Fault, Rule] = {
    Fault.CRC: Rule.MODULE_CRC,
    Fault.ADDRESS: Rule.MODULE_ADDRESS,
    Fault.FUNCTION: Rule.FUNCTION,
    Fault.SUB_FUNCTION: Rule.FUNCTION,
    Fault.ECHO: Rule.ECHO,
    Fault.VALUE: Rule.VALUE,
    Fault.RESERVED: Rule.VALUE,
}
"""What is wrong with an answer by Modbus, by the fault that the decoder found; any other is its length."""
_EXCEPTION = len("afecc")


def _of_request(heard: Heard) -> Rule | None:
    _, alone = hear_frame(Line(protocol=_RTU), heard.wire, _RTU, sent=True)
    return None if alone.error is None else _REQUEST_RULES.get(alone.error.fault, Rule.NO_COMMAND)


def _of_modbus_answer(wire: bytes, error: DecodeError, asked: bytes, _: Known) -> Rule:
    of_settings = asked[1] == MODULE_SETTINGS
    if error.fault is not Fault.CRC and wire[1] == asked[1] and len(wire) == _EXCEPTION and wire[2] in _CODES:
        cut = of_settings and wire[2] == asked[2]
        return Rule.SETTINGS_LENGTH if cut else Rule.EXCEPTION_BIT
    rule = _RESPONSE_RULES.get(error.fault, Rule.LENGTH)
    return Rule.SETTINGS_LENGTH if rule is Rule.LENGTH and of_settings else rule


def _answering(asked: bytes, wire: bytes, protocol: Protocol, known: Known) -> Heard:
    """Return what a frame is on a line on which nothing was heard but the frame `asked`."""
    line, _ = hear_frame(Line(Knowledge.given(known), protocol), asked, protocol, sent=True)
    return hear_frame(line, wire, protocol, sent=False)[1]


def answers(asked: bytes, wire: bytes, known: Known) -> bool:
    """Return whether a Modbus frame is an answer to the request `asked`."""
    return _answering(asked, wire, _RTU, known).answers is not None


def resembles(wire: bytes, asked: bytes | None) -> bool:
    """Return whether a damaged Modbus frame is likely to be one: an answer to `asked`, or else a request.

    Special: noise that only has the length of a frame does not count. With the right CRC a damaged frame would be
        readable, or its CRC is right, or it begins as the answer does.
    """
    if asked is not None and wire[0] == asked[0] and wire[1] & ~EXCEPTION_BIT == asked[1]:
        return True
    try:
        modbus.unseal(wire)
    except DecodeError as error:
        if error.fault is not Fault.CRC:
            return False
        _, heard = hear_frame(Line(protocol=_RTU), modbus.seal(wire[:-2]), _RTU, sent=asked is None)
        return heard.error is None
    return True


@lru_cache(maxsize=256)
def duty_after(meaning: Meaning) -> tuple[float, bool]:
    """Return the seconds that every module which a command can be for needs after it, and whether it is answered."""
    message: Any = meaning.message
    codec: Any = modbus if isinstance(message, modbus.Message) else dcon
    return min(codec.pause_after(message, profile) for profile in meaning.fit.profiles), codec.is_answered(message)


# --- EEPROM -----------------------------------------------------------------------------------------------------------

STORING: frozenset[type[Any]] = frozenset((
    dcon.SetConfiguration, dcon.SetChannelMask, dcon.SetChannelTypeCode, dcon.SetCjcOffset, dcon.SetProtocol,
    dcon.SetCjcEnabled, dcon.SetModuleName, dcon.ResetHostWatchdogStatus, dcon.SetHostWatchdogTimeout,
    dcon.SetOpenWireDetection, dcon.SetConnectingMode, dcon.CalibrateSpan, dcon.CalibrateZero,
    dcon.CalibrateCurrentChannelSpan, dcon.CalibrateChannelZero, dcon.CalibrateChannelSpan, dcon.CalibrateInternally,
    dcon.ReloadDefaultCalibration, modbus.SetModuleAddress, modbus.SetCommunicationSettings, modbus.SetTypeCode,
    modbus.SetChannelMask, modbus.SetMiscellaneousSettings, modbus.SetCjcOffset, modbus.SetCjcEnabled,
))  # fmt: skip
"""The commands and sub-functions that write the EEPROM."""
_WRITES = (modbus.WriteSingleCoil, modbus.WriteSingleRegister, modbus.WriteMultipleCoils, modbus.WriteMultipleRegisters)
_NOT_STORED = ("cjc_update", "rtc_", "log_")
"""The names, or beginnings of names, of rows that are not settings in the EEPROM: the clock and the data logger."""


def writes_eeprom(meaning: Meaning) -> bool:
    """Return whether a command or request writes a setting to the EEPROM of a module, if it is accepted."""
    message: Any = meaning.message
    if isinstance(message, _WRITES):
        return not _volatile().issuperset(item.number for item in meaning.items)
    return type(message) in STORING


@cache
def _volatile() -> frozenset[str]:
    """Return the numbers of the manual that are settings in the EEPROM on no model."""
    rows = [row for model in Model for row in modbus.RegisterMap(Profile(model, type_codes=()))]
    lost = {number for row in rows if row.name.startswith(_NOT_STORED) for number in _numbers(row)}
    return frozenset(lost.difference(*(_numbers(row) for row in rows if not row.name.startswith(_NOT_STORED))))


def _numbers(row: modbus.Register) -> list[str]:
    first = int(row.number)
    return [f"{first + at:05}" for at in range(row.count)]
