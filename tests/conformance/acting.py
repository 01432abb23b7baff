"""What a module would do with bytes, and how harmful that is: found from its state and from the decoded command.

Independent of the guard: the classes stand here as the specification has them, by the name of the command, the number
of the row, and the field of the state.
"""

from functools import cache
from random import Random
from typing import Any, NamedTuple

from attrs import evolve

from i7000 import BaudRate, CharacterFormat, DecodeError, LineSettings, Model, Noise, Protocol, dcon, modbus
from i7000.conformance import DEFAULT_ALLOWED, Guard, GuardError, Hazard, allowing
from i7000.conformance.guard_dcon import HEARD_AS, hazards_in_text
from i7000.conformance.guard_rtu import hazards_at, hazards_with_crc
from i7000.device import Bus, Ear, Heard, Signals, State, Uart, advance, factory, power_on, step
from i7000.device.measurement import sample
from tests.conformance import near_misses

NOW = 1.0
SIGNALS = (Signals(),)
LINES = tuple(LineSettings(rate, form) for rate in BaudRate for form in CharacterFormat)

FASTER: dict[BaudRate | int, BaudRate] = {
    slow: fast for slow in BaudRate for fast in BaudRate if fast.bits_per_second == 2 * slow.bits_per_second
}
"""The baud rates with one twice as fast."""

CALIBRATING = {
    "CalibrateSpan", "CalibrateZero", "CalibrateCurrentChannelSpan", "CalibrateChannelZero", "CalibrateChannelSpan",
    "CalibrateInternally", "ReloadDefaultCalibration", "SetCalibrationEnabled",
}  # fmt: skip
LOSING = {
    "SetConfiguration", "SetProtocol", "SoftInit", "SetSoftInitTimeout", "SetHostWatchdogTimeout", "SetModuleAddress",
    "SetCommunicationSettings",
}  # fmt: skip
WRITING = {
    "SetChannelMask", "SetChannelTypeCode", "SetCjcOffset", "SetCjcUpdate", "SetCjcEnabled", "SetModuleName",
    "ResetHostWatchdogStatus", "SetOpenWireDetection", "SetConnectingMode", "SetTypeCode", "SetMiscellaneousSettings",
}  # fmt: skip
CALLING = {"SynchronizedSampling", "HostOk"}
LOSING_REGISTERS = {40485 - 40001, 40486 - 40001, 40488 - 40001, 40489 - 40001}
LOSING_COILS = {257 - 1, 261 - 1}
CALIBRATING_COILS = {272 - 1}
RESET_COIL = 273 - 1
STORED = {
    "address": Hazard.COMM, "line_settings": Hazard.COMM, "protocol": Hazard.COMM, "response_delay": Hazard.COMM,
    "host_watchdog_enabled": Hazard.COMM, "host_watchdog_timeout": Hazard.COMM,
}  # fmt: skip
"""The hazards of the stored fields that can lose a module; all others are writes."""
KEPT = {
    "address": Hazard.COMM, "line_settings": Hazard.COMM, "protocol": Hazard.COMM, "checksum": Hazard.COMM,
    "soft_init_timeout": Hazard.COMM, "calibration_enabled": Hazard.CALIBRATION, "cjc_update": Hazard.WRITE,
    "held_cold_junction": Hazard.WRITE, "sampled": Hazard.BROADCAST, "sampled_data_read": Hazard.MEMORY,
    "reset_status_read": Hazard.MEMORY,
}  # fmt: skip
"""The hazards of the fields in RAM; what every command does to `fed_at` and `soft_init_until` is none."""


class Combination(NamedTuple):
    """What is drawn for each string, beside the string."""

    model: Model
    protocol: Protocol
    init: str
    checksum: bool
    line: LineSettings
    same_line: bool
    unfinished: bool


COMBINATIONS = tuple(
    Combination(model, protocol, init, checksum, line, same_line, unfinished)
    for model in Model
    for protocol in model.protocols
    for init in ("off", "at power-on", "moved")
    for checksum in (False, True)
    for line in LINES
    for same_line in (True, False)
    for unfinished in (True, False)
)
ADDRESSES = (0x01, 0x24, 0x88, 0x0A)


def combination_of(number: int) -> Combination:
    """The combination of a string: all of them in turn, in a scattered order."""
    return COMBINATIONS[number * 12_289 % len(COMBINATIONS)]


@cache
def _module(model: Model, protocol: Protocol, init: str, checksum: bool) -> State:  # noqa: FBT001 - for the cache
    """A module that carries out as much as possible: everything is permitted, and the watchdog runs."""
    made = factory(model)
    report = evolve(made.report_settings, checksum=checksum)
    eeprom = evolve(
        made, protocol=protocol, report_settings=report, host_watchdog_enabled=True, host_watchdog_timeout=0xFF,
        host_watchdog_timed_out=True,
    )  # fmt: skip
    state = power_on(eeprom, init_switch=init == "at power-on", now=0.0)
    if init == "moved":
        state = state.switched(init_switch=True)
    state = state.keep(
        calibration_enabled=True, soft_init_timeout=0x3C, soft_init_until=60.0, sampled=sample(state, SIGNALS[0])
    )
    return advance(state, SIGNALS[0], NOW)


def module_of(combination: Combination, address: int) -> State:
    """The module of a combination; in INIT mode its line settings and its address are those of INIT mode."""
    return _module_at(*combination[:5], address)


@cache
def _module_at(  # noqa: PLR0913, PLR0917 - for the cache
    model: Model,
    protocol: Protocol,
    init: str,
    checksum: bool,  # noqa: FBT001
    line: LineSettings,
    address: int,
) -> State:
    state = _module(model, protocol, init, checksum)
    settings = {"address": address, "line_settings": line}
    return state.store(**settings) if state.ram.init_mode else state.store(**settings).keep(**settings)


UARTS = {line: Uart.of(line) for line in LINES}


def acted_on(before: State, after: State, heard: tuple[Heard, ...]) -> set[Hazard]:
    """The hazards of what a module did."""
    found = set()
    if after.eeprom != before.eeprom:
        old, new = before.eeprom, after.eeprom
        for name in vars(new):
            if name == "report_settings" and old.report_settings.checksum != new.report_settings.checksum:
                found.add(Hazard.COMM)
            if getattr(old, name) != getattr(new, name):
                found.add(STORED.get(name, Hazard.WRITE))
    if after.ram != before.ram:
        found |= {it for name, it in KEPT.items() if getattr(before.ram, name) != getattr(after.ram, name)}
        if after.ram.soft_init_until is not None and after.ram.soft_init_until != before.ram.soft_init_until:
            found.add(Hazard.COMM)
    for one in heard:
        found |= _carried_out(one, before)
    return found


def _carried_out(heard: Heard, before: State) -> set[Hazard]:
    if isinstance(heard.frame, Noise):
        return set()
    _, answer = step(before, heard.frame, SIGNALS[0], NOW)  # that of `heard` is garbled by other line settings
    try:
        if heard.protocol is Protocol.DCON:
            return _of_command(dcon.decode_command(heard.frame, heard.profile or before.profile), answer)
        return _of_request(modbus.decode_request(heard.frame, heard.profile or before.profile), answer)
    except DecodeError:
        return set()


def _of_command(command: Any, answer: bytes | None) -> set[Hazard]:
    name = type(command).__name__
    if name in CALLING:
        return {Hazard.BROADCAST}
    if answer is None or answer[:1] == b"?":
        return set()
    return _of_name(name) | ({Hazard.MEMORY} if name == "ReadSynchronizedData" else set())


def _of_name(name: str) -> set[Hazard]:
    kinds = ((CALIBRATING, Hazard.CALIBRATION), (LOSING, Hazard.COMM), (WRITING, Hazard.WRITE))
    return {hazard for names, hazard in kinds if name in names}


def _of_request(request: Any, answer: bytes | None) -> set[Hazard]:
    if request.address and (answer is None or answer[1] & 0x80):
        return set()
    found = _of_name(type(request).__name__)
    if request.function in (0x05, 0x0F):
        found |= {_of_place(it, LOSING_COILS, CALIBRATING_COILS) for it in _written(request)}
    elif request.function in (0x06, 0x10):
        found |= {_of_place(it, LOSING_REGISTERS, set()) for it in _written(request)}
    elif request.function == 0x01 and RESET_COIL in range(request.start, request.start + request.count):
        found.add(Hazard.MEMORY)
    if request.address == 0:
        found.add(Hazard.BROADCAST)
    return found


def _written(request: Any) -> range:
    if request.function == 0x05:
        return range(request.coil, request.coil + 1)
    if request.function == 0x06:
        return range(request.register, request.register + 1)
    return range(request.start, request.start + len(request.values))


def _of_place(place: int, losing: set[int], calibrating: set[int]) -> Hazard:
    if place in calibrating:
        return Hazard.CALIBRATION
    return Hazard.COMM if place in losing else Hazard.WRITE


# --- one string -------------------------------------------------------------------------------------------------------


class Case(NamedTuple):
    """A string, and what it is sent to."""

    wire: bytes
    before: bytes
    silence: bool
    host: LineSettings
    address: int
    combination: Combination


class Outcome(NamedTuple):
    """What the module did, and what the guard found; it is not asked if the module did nothing."""

    acted: set[Hazard]
    found: frozenset[Hazard]

    @property
    def is_covered(self) -> bool:
        """Whether whoever allows what the guard found allows what the module did."""
        return self.acted <= allowing(self.found)


def drawn(chance: Random, number: int, wire: bytes | None = None) -> Case:
    """The case of a number; its string is drawn if there is none."""
    combination = combination_of(number)
    address = chance.choice(ADDRESSES)
    own = 0 if combination.init == "at power-on" else address
    effective = LineSettings() if combination.init == "at power-on" else combination.line
    host = effective if combination.same_line else chance.choice(LINES)
    speaks_dcon = combination.protocol is Protocol.DCON or combination.init == "at power-on"
    checked = combination.checksum and combination.init != "at power-on"

    def miss() -> bytes:
        return near_misses.near_miss(chance, own, checksum=checked, dcon_spoken=speaks_dcon)

    before, silence = b"", False
    if combination.unfinished:
        whole = miss()
        cut = chance.randrange(1, 1 + max(1, len(whole) - 1))
        before, silence = whole[:cut], chance.random() < 0.2
        if wire is None and chance.random() < 0.7:
            wire = whole[cut:] if chance.random() < 0.5 else whole[cut:] + miss()
    halves = effective.baud_rate in FASTER and effective.character_format in (CharacterFormat.N81, CharacterFormat.N82)
    if wire is None and halves and not combination.same_line and chance.random() < 0.3:
        address, host = near_misses.SLOW_ADDRESS, LineSettings(FASTER[effective.baud_rate])
        wire = near_misses.half_as_fast(chance, chance.choice(near_misses.SLOW_COMMANDS))
        before = before if chance.random() < 0.3 else b""
    return Case(miss() if wire is None else wire, before, silence, host, address, combination)


def outcome_of(case: Case) -> Outcome:
    """Send a string to the module as if there were no guard; if the module acts, ask the guard too.

    Special: unfinished bytes that the guard refuses are shortened until it does not.
    """
    if not _is_harmless(case.before):
        return outcome_of(_with_less_before(case))
    acted = done_with(case, case.wire)
    if not acted:
        return Outcome(acted, frozenset())
    try:
        guard = guard_before(case, DEFAULT_ALLOWED)
    except GuardError:  # because of what modules with other line settings hear
        return outcome_of(_with_less_before(case))
    return Outcome(acted, guard.hazards_of(case.wire, case.host))


def acted_after(case: Case, allowed: frozenset[Hazard]) -> set[Hazard] | None:
    """What a module did with a string behind a guard with permissions; None if the guard refused any of it."""
    try:
        guard_before(case, allowed).sending(case.wire, case.host)
    except GuardError:
        return None
    return done_with(case._replace(before=b"", silence=False), case.before) | done_with(case, case.wire)


def done_with(case: Case, wire: bytes) -> set[Hazard]:
    """What a module does with bytes after the unfinished ones, as if there were no guard."""
    bus, ear = Bus((module_of(case.combination, case.address),)), Ear(UARTS[case.host])
    if case.before:
        bus, ear, _ = bus.hear(ear, case.before, SIGNALS, NOW)
    if case.silence:
        bus, ear, _ = bus.silence(ear, SIGNALS, NOW)
    (ready,) = bus.modules
    bus, ear, first = bus.hear(ear, wire, SIGNALS, NOW)
    bus, ear, second = bus.silence(ear, SIGNALS, NOW)
    return acted_on(ready, bus.modules[0], first + second)


def guard_before(case: Case, allowed: frozenset[Hazard]) -> Guard:
    """The guard of a line on which the unfinished bytes were sent.

    Errors: `GuardError`.
    """
    guard = Guard(allowed).sending(case.before, case.host)
    return guard.after_silence() if case.silence else guard


def _is_harmless(before: bytes) -> bool:
    """Whether the guard lets bytes pass on an idle line, as far as modules with the same line settings are concerned.

    It takes less time than the whole guard.
    """
    found = hazards_in_text(before.translate(HEARD_AS)) | hazards_with_crc(before, 0)
    return found | hazards_at(before, whole_body=False) <= DEFAULT_ALLOWED


def _with_less_before(case: Case) -> Case:
    return case._replace(before=case.before[: min(len(case.before) - 1, 3)])
