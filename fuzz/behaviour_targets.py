"""Modules and hosts on a hostile line: nothing raises, memory is bounded, what is refused changes nothing."""

from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from attrs import evolve

from fuzz.codec_targets import COMMANDS, REQUESTS, SEALED
from fuzz.inputs import FIRMWARES, HEADER, MODELS, pieces, profile_of
from i7000 import DecodeError, EncodeError, InvalidValueError, Noise, Profile, Protocol, Unit, dcon, host, modbus
from i7000.device import Bus, Ear, Heard, Log, LogCommand, Signals, State, Uart, advance, factory, power_on, step

__all__ = ["BY_MODBUS", "OTHER_PROTOCOL", "bus_hear", "device_step", "host_receive"]

_MOST_FRAMES = 6
_INIT, OTHER_PROTOCOL, _LOGGING, _WATCHDOG = 1, 2, 4, 8
"""Bits of the byte after the profile of a module."""
_START = 1000.0
_SIGNALS = (
    Signals.of(Unit.VOLT, *[0.5] * 20),
    Signals(),
    Signals.of(Unit.CELSIUS, *range(-100, 1900, 100)),
    Signals.of(Unit.MILLIAMPERE, *[12.0] * 20, cold_junction=-40.0),
)


@lru_cache(maxsize=1 << 12)
def _module(profile: Profile, options: int, address: int = 1) -> State:
    """Return a module that was just powered on, with the settings of a profile."""
    eeprom = factory(profile.model, profile.firmware or FIRMWARES[3])
    report = evolve(eeprom.report_settings, data_format=profile.data_format, checksum=profile.checksum)
    changes: dict[str, Any] = {
        "report_settings": report,
        "single_ended": profile.single_ended,
        "modbus_data_format": profile.modbus_data_format,
        "address": address,
    }
    if profile.type_codes:
        changes["type_codes"] = (profile.type_codes + eeprom.type_codes)[: len(eeprom.type_codes)]
    if options & OTHER_PROTOCOL:
        changes["protocol"] = Protocol.DCON
    if options & _LOGGING:
        changes["log"] = Log(command=LogCommand.CONTINUOUS, period=(0, 0, 1), overwrite=True)
    if options & _WATCHDOG:
        changes |= {"host_watchdog_enabled": True, "host_watchdog_timeout": 15}
    for kept in (changes, {"address": address}):
        try:
            return power_on(evolve(eeprom, **kept), init_switch=bool(options & _INIT), now=_START)
        except InvalidValueError:
            continue
    raise AssertionError(f"{profile} has no module")


def _sealed(frame: bytes, is_body: bool, state: State) -> bytes:  # noqa: FBT001 - positional for speed
    if not is_body:
        return frame
    if state.ram.protocol is Protocol.MODBUS_RTU:
        return modbus.seal(frame)
    return dcon.seal(frame, checksum=state.ram.checksum)


def device_step(data: bytes) -> None:
    """Give frames to a module, one a second; a host reads every answer, and what is refused changes nothing.

    Shape: the profile, options, then frames, each after a byte with its length and whether it is to be sealed.
    """
    if len(data) <= HEADER:
        return
    options = data[HEADER]
    state = _module(profile_of(data), options)
    signals = _SIGNALS[options >> 4 & 3]
    at, now = HEADER + 1, _START
    for _ in range(_MOST_FRAMES):
        if at >= len(data):
            break
        size = data[at] & ~SEALED
        frame = _sealed(data[at + 1 : at + 1 + size], bool(data[at] & SEALED), state)
        at += 1 + size
        now += 1.0
        before = state
        state, answer = step(before, frame, signals, now)
        _check_step(before, state, frame, answer, signals, now)
    power_on(state.eeprom, init_switch=True, now=now)


def _check_step(  # noqa: PLR0913, PLR0917 - all that a step is about
    before: State, after: State, frame: bytes, answer: bytes | None, signals: Signals, now: float
) -> None:
    is_modbus = before.ram.protocol is Protocol.MODBUS_RTU
    if answer is None:
        if frame[:1] != b"\0" and frame[1:3] != b"**":
            assert after == advance(before, signals, now)
        return
    assert len(answer) <= dcon.LONGEST_FRAME
    if is_modbus:
        if answer[1] & 0x80:
            assert after == advance(before, signals, now)
        _check_modbus_answer(frame, answer, before.profile)
        return
    if answer.startswith(b"?"):
        assert after == advance(before, signals, now)
    command = dcon.decode_command(frame, before.profile)
    assert isinstance(command, dcon.Command)
    assert dcon.decode_response(answer, command, before.profile)


def _check_modbus_answer(frame: bytes, answer: bytes, profile: Profile) -> None:
    try:
        request = modbus.decode_request(frame, profile)
    except DecodeError:
        assert answer == modbus.seal(bytes((frame[0], frame[1] | 0x80, answer[2])))
    else:
        assert modbus.decode_response(answer, request, profile)


def _bus(data: bytes) -> Bus:
    """Return a bus with a module of the profile, one of the other protocol and one in INIT mode."""
    second = bytes(((data[0] + 7) % len(MODELS), data[1] >> 1, data[2] ^ 1))
    modules = [_module(profile_of(data), data[HEADER] & 0xF)]
    if data[HEADER] & 0x10:
        modules.append(_module(profile_of(second), OTHER_PROTOCOL, 2))
    if data[HEADER] & 0x20:
        modules.append(_module(profile_of(second), _INIT, 1))
    return Bus(tuple(modules))


_LONGEST_REST = 256
Told = tuple[Bus, list[tuple[bytes, int | None, bytes | None]]]


def _lived_through(bus: Bus, ear: Ear, data: Iterator[bytes], signals: list[Signals]) -> Told:
    """Hear pieces and the silence after them: the modules, and the frames with what became of them."""
    told: list[Heard] = []
    for piece in data:
        bus, ear, heard = bus.hear(ear, piece, signals, _START)
        assert all(len(rest) <= _LONGEST_REST for _, rest in ear.rests)
        told += heard
    bus, ear, heard = bus.silence(ear, signals, _START)
    told += heard
    return bus, [(it.frame, it.module, it.answer) for it in told if not isinstance(it.frame, Noise)]


def bus_hear(data: bytes) -> None:
    """Check that several modules hear the same frames in a stream, whole and in pieces, and end in the same states.

    Shape: the profile of the first module, options, the size of the pieces, then the stream.
    """
    if len(data) < HEADER + 2:
        return
    bus = _bus(data)
    signals = [_SIGNALS[0]] * len(bus.modules)
    stream, cut = data[HEADER + 2 :], data[HEADER + 1]
    whole = _lived_through(bus, Ear(), iter((stream,)), signals)
    assert whole == _lived_through(bus, Ear(), pieces(stream, cut), signals)
    if data[HEADER] & 0x40:
        _lived_through(bus, Ear(Uart(115200 if cut & 1 else 1200, parity="NEO"[cut % 3])), pieces(stream, cut), signals)


_POLICY = host.Policy(retries=1, turnaround=0.05, grace=0.1)
_ECHO, BY_MODBUS = 1, 2
"""Bits of the byte after the profile of a host."""
_MOST_PIECES = 32
_MOST_DEADLINES = 8
"""More than the attempts of a request, and the silence before each."""


def host_receive(data: bytes) -> None:
    """Check a host that hears hostile bytes: a request has one outcome, and its response is that of the codec.

    Shape: the profile, options, the command, then pieces after a byte each: its length, and whether the next deadline
        passes first.
    """
    if len(data) < HEADER + 2:
        return
    profile, options, number = profile_of(data), data[HEADER], data[HEADER + 1]
    table: tuple[Any, ...] = REQUESTS if options & BY_MODBUS else COMMANDS
    command = table[number % len(table)]
    bus: host.Bus[Any] = host.Bus(policy=_POLICY, echo=bool(options & _ECHO))
    try:
        bus = host.send(bus, command, profile, 0.0)
    except EncodeError as error:
        assert str(error)
        return
    ended = _heard(bus, data[HEADER + 2 :], command, profile)
    assert host.next_deadline(ended) is None


def _heard(bus: host.Bus[Any], data: bytes, command: Any, profile: Profile) -> host.Bus[Any]:  # noqa: ANN401 - any
    """Give pieces to a host until its request has ended and the pieces are used up."""
    outcomes, at = 0, 0
    now = host.next_deadline(bus) or 0.0
    bus, events = host.receive(bus, b"", now)
    assert [type(event) for event in events] == [host.Transmit]
    for call in range(_MOST_PIECES + _MOST_DEADLINES):
        due = host.next_deadline(bus)
        if call >= _MOST_PIECES:
            at = len(data)
        if at >= len(data) and due is None:
            break
        head = data[at] if at < len(data) else SEALED
        piece = data[at + 1 : at + 1 + (head & ~SEALED)]
        at += 1 + len(piece)
        now = max(now, due) if due is not None and head & SEALED else now + 0.001
        bus, events = host.receive(bus, piece, now)
        assert len(bus.rest) <= _LONGEST_REST
        for event in events:
            outcomes += _check_event(event, command, profile)
        assert outcomes == (host.next_deadline(bus) is None)
    return bus


def _check_event(event: Any, command: Any, profile: Profile) -> int:  # noqa: ANN401 - an event of any kind
    """Check an event; return 1 for an outcome."""
    if isinstance(event, host.Answered | host.Declined):
        codec: Any = modbus if isinstance(command, modbus.Request) else dcon
        assert event.command == command
        wire = codec.encode(event.response, profile, force=True)
        assert codec.decode_response(wire, command, profile) == event.response
        return 1
    if isinstance(event, host.TimedOut | host.Sent):
        return 1
    assert isinstance(event, host.Transmit | host.Late | host.Rejected | Noise)
    return 0
