"""Strategies for the model of the modules: input signals, memory, modules with power.

Laws: every state is one that a module can reach: it accepts its settings, and its history is a sequence of frames. The
smallest example is a module from the factory with open inputs.
"""

from collections.abc import Callable, Mapping
from typing import Any

from attrs import evolve
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import BaudRate, ModbusDataFormat, Model, Protocol, Unit, dcon, modbus
from i7000.availability import Availability
from i7000.device import (
    Bus,
    Ear,
    Eeprom,
    Heard,
    Log,
    LogCommand,
    Ram,
    Record,
    Signal,
    Signals,
    State,
    Uart,
    factory,
    power_on,
    step,
)
from i7000.profile import CHANNEL_OFFSETS, CJC_OFFSETS, RESPONSE_DELAYS
from i7000.strategies.dcon import any_commands, names
from i7000.strategies.modbus import any_requests
from i7000.strategies.vocabulary import addresses, firmwares, line_settings, report_settings, supported_types

__all__ = ["eeproms", "frames", "logs", "records", "signals", "states", "uarts"]

_WORD = st.integers(0, 0xFFFF)
_LONG = st.integers(0, 0xFFFFFFFF)

# --- inputs -----------------------------------------------------------------------------------------------------------


def signals() -> SearchStrategy[Signals]:
    """Make signals for any number of channels, of any size and unit, many of them within some span."""
    channel = st.none() | _signals()
    cold_junction = st.just(25.0) | st.floats(-200, 200)
    return st.builds(Signals, st.lists(channel, max_size=20).map(tuple), cold_junction=cold_junction)


def _signals() -> SearchStrategy[Signal]:
    values = st.one_of(st.floats(-30, 30), st.floats(-3000, 3000), st.floats(allow_nan=False, allow_infinity=False))
    return st.builds(Signal, values, st.sampled_from(Unit))


# --- the data logger --------------------------------------------------------------------------------------------------


def records() -> SearchStrategy[Record]:
    """Make records of the data logger: 16 channels at one moment."""
    return st.builds(Record, _LONG, st.tuples(*[_WORD] * 16), _LONG)


@st.composite
def logs(draw: st.DrawFn, now: float = 0.0) -> Log:
    """Make data loggers, stopped or running, with some records."""
    told = draw(st.lists(records(), max_size=3))
    last = draw(st.integers(len(told), 0xFFFF))
    day = st.integers(2000, 2159), st.integers(1, 12), st.integers(1, 31)
    date = st.tuples(*day, st.integers(0, 23), st.integers(0, 59), st.integers(0, 59))
    return Log(
        clock_offset=draw(st.just(Log().clock_offset) | st.integers(0, 0xFFFFFFFF).map(float)),
        command=draw(st.sampled_from(LogCommand)),
        overwrite=draw(st.booleans()),
        period=draw(st.tuples(st.integers(0, 24), st.integers(0, 59), st.integers(0, 59))),
        start=draw(st.just(Log().start) | date),
        end=draw(st.just(Log().end) | date),
        read_index=draw(st.integers(1, 5) | _LONG),
        last_index=last,
        records=tuple(evolve(record, index=last - at) for at, record in enumerate(told))[::-1],
    ).planned(now)


# --- modules ----------------------------------------------------------------------------------------------------------


@st.composite
def eeproms(draw: st.DrawFn, *models: Model, protocol: Protocol | None = None, now: float = 0.0) -> Eeprom:
    """Make memories of modules of `models`, or of all that use `protocol`: any valid settings."""
    able = [model for model in models or Model if protocol in (None, *model.protocols)]
    made = factory(draw(st.sampled_from(able)), draw(st.none() | firmwares()))
    if not draw(st.booleans()):
        return made if protocol is None else evolve(made, protocol=protocol)
    profile = power_on(made, now=0.0).profile
    supported = st.sampled_from(supported_types(profile))
    inputs = len(made.type_codes)
    types = (draw(supported),) * inputs
    if profile.individually_configurable:
        types = draw(st.just(types) | st.tuples(*[supported] * inputs))
    modbus_format = st.sampled_from(ModbusDataFormat)
    return evolve(
        made,
        type_codes=types,
        report_settings=draw(report_settings(profile)),
        line_settings=draw(line_settings(profile)),
        name=draw(st.just(made.name) | names()),
        protocol=draw(st.sampled_from(sorted(made.model.protocols))) if protocol is None else protocol,
        channel_mask=draw(st.integers(0, (1 << inputs) - 1)),
        channel_offsets=draw(st.tuples(*[st.integers(*CHANNEL_OFFSETS)] * inputs)),
        channel_cjc_offsets=draw(st.tuples(*[st.integers(*CJC_OFFSETS)] * inputs)),
        open_wire_detection=draw(st.booleans()),
        address=draw(addresses() if made.model.value[0] == "I" else st.integers(1, 247)),
        single_ended=draw(st.booleans()) and Availability.SERIES_7017Z not in profile.refused,
        modbus_data_format=draw(modbus_format) if made.model.value[0] == "M" else made.modbus_data_format,
        cjc_offset=draw(st.integers(*CJC_OFFSETS)),
        cjc_enabled=draw(st.booleans()),
        host_watchdog_enabled=draw(st.booleans()),
        host_watchdog_timeout=draw(st.integers(0, 0xFF)),
        host_watchdog_timed_out=draw(st.booleans()),
        host_watchdog_timeouts=draw(_WORD),
        host_watchdog_mode=draw(st.booleans()),
        response_delay=draw(st.integers(*RESPONSE_DELAYS)),
        sampling_rate_8_hz=draw(st.booleans()),
        big_endian=draw(st.booleans()),
        log=draw(logs(now)) if made.model is Model.M_7017mC_16 else made.log,
    )


@st.composite
def states(
    draw: st.DrawFn, *models: Model, protocol: Protocol | None = None, now: float = 0.0, dialogue: int = 3
) -> State:
    """Make modules with power since `now`, as in `eeproms`, that have received some frames: at most `dialogue`.

    Special: without `protocol`, some are in INIT mode.
    """
    eeprom = draw(eeproms(*models, protocol=protocol, now=now))
    state = power_on(eeprom, now=now, init_switch=protocol is None and draw(st.sampled_from((False, False, True))))
    for _ in range(draw(st.integers(0, dialogue))):
        state, _answer = step(state, draw(frames(state)), draw(signals()), now)
    return state


def frames(state: State) -> SearchStrategy[bytes]:
    """Make frames for a module, in its protocol; including commands that it refuses or does not have."""
    own = state.ram.address
    if state.ram.protocol is Protocol.MODBUS_RTU:
        return any_requests(state.profile).map(
            lambda it: modbus.encode(
                evolve(it, address=own) if modbus.is_answered(it) else it, state.profile, force=True
            )
        )
    return any_commands(state.profile).map(
        lambda it: dcon.encode(
            evolve(it, address=own) if isinstance(it, dcon.Command) else it, state.profile, force=True
        )
    )


def _buses() -> SearchStrategy[Bus]:
    return st.lists(states(dialogue=1), max_size=3).map(lambda modules: Bus(tuple(modules)))


def uarts() -> SearchStrategy[Uart]:
    """Make settings of one end of a line, mostly those that modules have."""
    rates = st.sampled_from([rate.bits_per_second for rate in BaudRate]) | st.integers(1, 1_000_000)
    return st.builds(
        Uart,
        st.just(9600) | rates,
        parity=st.sampled_from("NEOMS"),
        stop_bits=st.sampled_from((1, 1.5, 2)),
        data_bits=st.sampled_from((8, 7, 6, 5)),
    )


@st.composite
def _hearings(draw: st.DrawFn) -> tuple[Ear, tuple[Heard, ...]]:
    """Make the results of giving frames or noise to one or two modules."""
    modules = draw(st.lists(states(dialogue=0), min_size=1, max_size=2))
    frame = draw(frames(modules[0]) | st.binary(min_size=1, max_size=8))
    sent = frame[: draw(st.integers(1, len(frame)))] if draw(st.booleans()) else frame
    _, ear, heard = Bus(tuple(modules)).hear(Ear(draw(st.none() | uarts())), sent, [Signals()] * len(modules), 0.0)
    return ear, heard


def _ears() -> SearchStrategy[Ear]:
    return _hearings().map(lambda hearing: hearing[0])


def _heard() -> SearchStrategy[Heard]:
    return _hearings().filter(lambda hearing: bool(hearing[1])).map(lambda hearing: hearing[1][0])


def _ram() -> SearchStrategy[Ram]:
    return states().map(lambda state: state.ram)


BY_KIND: Mapping[type, Callable[[], SearchStrategy[Any]]] = {
    Bus: _buses,
    Ear: _ears,
    Eeprom: eeproms,
    Heard: _heard,
    Log: logs,
    Ram: _ram,
    Record: records,
    Signal: _signals,
    Signals: signals,
    State: states,
    Uart: uarts,
}
"""The strategies of the public classes."""
