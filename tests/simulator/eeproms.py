"""What modules can remember: all of it, and two modules to look at."""

from attrs import evolve
from hypothesis import strategies as st

from i7000 import CharacterFormat, Firmware, LineSettings, ModbusDataFormat, Model, Protocol, dcon
from i7000.device import Eeprom, Log, LogCommand, Record, factory
from i7000.device.state import profile_of
from i7000.strategies import firmwares, line_settings, report_settings
from i7000.strategies.dcon import names
from i7000.strategies.vocabulary import supported_types

__all__ = ["MODULES", "RECORD", "eeproms"]

LONG = st.integers(0, 0xFFFFFFFF)
MOMENTS = st.floats(-1e12, 1e12)


def dates() -> st.SearchStrategy[tuple[int, int, int, int, int, int]]:
    return st.tuples(
        st.integers(2000, 2159), st.integers(1, 12), st.integers(1, 31),
        st.integers(0, 23), st.integers(0, 59), st.integers(0, 59),
    )  # fmt: skip


def logs() -> st.SearchStrategy[Log]:
    records = st.builds(Record, LONG, st.tuples(*[st.integers(0, 0xFFFF)] * 16), LONG)
    return st.just(Log()) | st.builds(
        Log,
        clock_offset=MOMENTS,
        command=st.sampled_from(LogCommand),
        overwrite=st.booleans(),
        period=st.tuples(st.integers(0, 24), st.integers(0, 59), st.integers(0, 59)),
        start=dates(),
        end=dates(),
        read_index=LONG,
        last_index=LONG,
        records=st.lists(records, max_size=3).map(tuple),
        next_at=MOMENTS,
    )


@st.composite
def eeproms(draw: st.DrawFn) -> Eeprom:
    made = factory(draw(st.sampled_from(Model)), draw(st.none() | firmwares()))
    profile = profile_of(made)
    inputs = len(made.type_codes)
    supported = st.sampled_from(supported_types(profile))
    types = st.tuples(*[supported] * inputs) if profile.individually_configurable else supported.map(lambda it: (it,))
    codes = draw(types)
    has_modbus = Protocol.MODBUS_RTU in made.model.protocols
    return evolve(
        made,
        type_codes=codes * (inputs // len(codes)),
        report_settings=draw(report_settings(profile)),
        name=draw(names()),
        protocol=draw(st.sampled_from(sorted(made.model.protocols))),
        channel_mask=draw(st.integers(0, (1 << inputs) - 1)),
        channel_offsets=draw(st.tuples(*[st.integers(-128, 127)] * inputs)),
        channel_cjc_offsets=draw(st.tuples(*[st.integers(-0x1000, 0x1000)] * inputs)),
        open_wire_detection=draw(st.booleans()),
        address=draw(st.integers(0, 0xFF)),
        line_settings=draw(line_settings(profile)),
        single_ended=draw(st.booleans()) and dcon.SetConnectingMode.availability not in profile.refused,
        modbus_data_format=draw(st.sampled_from(ModbusDataFormat)) if has_modbus else ModbusDataFormat.HEX,
        cjc_offset=draw(st.integers(-0x1000, 0x1000)),
        cjc_enabled=draw(st.booleans()),
        host_watchdog_enabled=draw(st.booleans()),
        host_watchdog_timeout=draw(st.integers(0, 0xFF)),
        host_watchdog_timed_out=draw(st.booleans()),
        host_watchdog_timeouts=draw(st.integers(0, 0xFFFF)),
        host_watchdog_mode=draw(st.booleans()),
        response_delay=draw(st.integers(0, 30)),
        sampling_rate_8_hz=draw(st.booleans()),
        big_endian=draw(st.booleans()),
        log=draw(logs()),
    )


RECORD = Record(1, tuple(range(16)), 946684801)
MODULES = (
    factory(Model.M_7019R, Firmware("B3.7")),
    evolve(
        factory(Model.M_7017mC_16),
        address=0x1F,
        line_settings=LineSettings(character_format=CharacterFormat.E81),
        log=Log(command=LogCommand.PERIOD, period=(0, 0, 10), last_index=1, records=(RECORD,)),
    ),
)  # fmt: skip
