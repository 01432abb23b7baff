"""A whole module: the effects of time and of frames (manual 2, 3, A.2)."""

from i7000.arguments import LARGEST_FLOAT, as_bytes, check_clock, check_type
from i7000.device import dcon, modbus
from i7000.device.measurement import words
from i7000.device.signals import Signals
from i7000.device.state import State, at
from i7000.models import Model
from i7000.settings import Protocol

__all__ = ["advance", "is_for", "step"]

_MOST_TIMEOUTS = 0xFFFF


def step(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    r"""Give a frame to a module; return the state after it, and the response or None for silence.

    Shape: `frame` is one complete frame, as `split` of its protocol returns it.
    Time: `now` is in seconds, of the clock of `power_on`.
    Special: no frame raises an error; a frame that is not carried out only has the effects of time, see `advance`.
    Errors: `EncodeError` for a time that is not finite, `StateError` for a time before the last.
    Manual: 2, 3; E27, E94.

    >>> from i7000.device import factory, power_on
    >>> from i7000 import Model, Unit
    >>> module = power_on(factory(Model.I_7018), now=0.0)
    >>> step(module, b"#010\r", Signals.of(Unit.VOLT, 1.5), 0.0)[1]
    b'>+1.5000\r'
    """
    if frame.__class__ is not bytes:
        frame = as_bytes("frame", frame)
    state = advance(state, signals, now)
    address = state.ram.address
    if state.ram.protocol is Protocol.MODBUS_RTU:
        if frame[:1] not in (_BYTES[address], b"\0"):
            return state, None
        return modbus.step(state, frame, signals, now)
    if frame[1:3] not in (_DIGITS[address], b"**"):
        return state, None
    return dcon.step(state, frame, signals, now)


def is_for(state: State, frame: bytes) -> bool:
    """Return whether a frame has the address of this module."""
    address = state.ram.address
    return frame[:1] == _BYTES[address] if state.ram.protocol is Protocol.MODBUS_RTU else frame[1:3] == _DIGITS[address]


_BYTES = tuple([bytes((address,)) for address in range(0x100)])
_DIGITS = tuple([b"%02X" % address for address in range(0x100)])


def advance(state: State, signals: Signals, now: float) -> State:
    """Move the time on: the host watchdog may time out, and the data logger may record.

    Special: records that were due since the last call have the `signals` of this call.
    Errors: `EncodeError` for a time that is not finite, `StateError` for a time before the last.
    Manual: 2.36, 3.4.3, A.2; E31 (a timeout disables the watchdog), E100 (one of 0 never comes), E106, E114, E138.
    """
    if state.__class__ is not State:
        check_type("state", state, State)
    if signals.__class__ is not Signals:
        check_type("signals", signals, Signals)
    if now != state.clock:
        if now.__class__ is not float or not state.clock < now <= LARGEST_FLOAT:
            check_clock(now, state.clock)
        state = at(state, now)
    eeprom = state.eeprom
    timeout = eeprom.host_watchdog_timeout
    if eeprom.host_watchdog_enabled and timeout and now >= state.ram.fed_at + timeout / 10:
        state = state.store(
            host_watchdog_enabled=False,
            host_watchdog_timed_out=True,
            host_watchdog_timeouts=min(eeprom.host_watchdog_timeouts + 1, _MOST_TIMEOUTS),
        )
    if eeprom.model is Model.M_7017mC_16:
        return _logged(state, signals, now)
    return state


def _logged(state: State, signals: Signals, now: float) -> State:
    log = state.eeprom.log
    due = log.due(now)
    if not due:
        return state
    return state.store(log=log.recorded(words(state, signals), due))
