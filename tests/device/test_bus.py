"""Several modules on one pair of wires."""

from collections.abc import Iterable
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import (
    BaudRate,
    CharacterFormat,
    DataFormat,
    Fault,
    InvalidValueError,
    LineSettings,
    Model,
    Noise,
    Profile,
    Protocol,
    ReportSettings,
    TypeCode,
    Unit,
    dcon,
    modbus,
)
from i7000.device import Bus, Ear, Heard, Log, LogCommand, Signals, State, Uart, power_on, step
from i7000.device.uart import hear_at
from i7000.strategies import device
from i7000.strategies.dcon import frames as dcon_frames
from i7000.strategies.modbus import chunkings
from i7000.strategies.modbus import frames as modbus_frames
from tests.device.driver import bench
from tests.device.test_properties import NOW, any_frames


def bus(**modules: Model) -> Bus:
    """A bus of modules: address ``A`` and DCON, or ``M`` and Modbus."""
    return Bus(
        tuple(
            bench(
                model,
                address=int(place[1:], 16),
                protocol=Protocol.MODBUS_RTU if place[0] == "M" else Protocol.DCON,
            ).state
            for place, model in modules.items()
        )
    )


def hear(line: Bus, frame: bytes) -> tuple[Bus, bytes | None]:
    return line.step(frame, [Signals()] * len(line.modules), 1000.0)


MIXED = {"A01": Model.I_7018, "A02": Model.M_7019R, "M01": Model.M_7017, "M03": Model.M_7018}


def test_the_module_that_is_asked_answers_in_its_protocol() -> None:
    line = bus(**MIXED)

    assert hear(line, b"$01M\r")[1] == b"!017018\r"
    assert hear(line, b"$02M\r")[1] == b"!027019R\r"
    assert hear(line, b"$03M\r")[1] is None
    asked = modbus.encode(modbus.ReadModuleName(1)), modbus.encode(modbus.ReadModuleName(2))
    assert hear(line, asked[0])[1] == modbus.encode(modbus.ModuleName(1, b"\0\x70\x17\0"))
    assert hear(line, asked[1])[1] is None


def test_three_modules_read_in_the_formats_that_the_manual_shows() -> None:
    volts = (5.96301157, 2.98104801, -2.27847715, -9.71633478, 1.18472854, -2.84153506, 7.69676809, -5.43434806)
    hexadecimal = ReportSettings(DataFormat.HEX)
    line = Bus((
        bench(Model.I_7017, type_code=TypeCode.MV_150).state,
        bench(Model.I_7017, address=2, report_settings=hexadecimal).state,
        bench(Model.I_7018, address=3, type_code=TypeCode.K).state,
    ))  # fmt: skip
    signals = (
        Signals.of(Unit.MILLIVOLT, 25.12, 20.45, 12.78, 18.97, 3.24, 15.35, 8.07, 14.79),
        Signals.of(Unit.VOLT, *volts),
        Signals.of(Unit.CELSIUS, *[-300.0] * 8),
    )

    assert line.step(b"#01\r", signals, 1000.0)[1] == (b">+025.12+020.45+012.78+018.97+003.24+015.35+008.07+014.79\r")
    assert line.step(b"#02\r", signals, 1000.0)[1] == b">4C532628E2D683A20F2ADBA16284BA71\r"
    assert line.step(b"#03\r", signals, 1000.0)[1] == b">" + b"-9999.9" * 8 + b"\r"


def test_a_broadcast_reaches_all_that_know_it() -> None:
    line, answer = hear(bus(**MIXED), b"#**\r")

    assert answer is None
    assert [module.ram.sampled is not None for module in line.modules] == [False, True, False, False]
    line, answer = hear(line, modbus.encode(modbus.WriteSingleRegister(0, 487, 5)))
    assert answer is None
    assert [module.eeprom.response_delay for module in line.modules] == [0, 0, 5, 5]


def test_answers_that_collide_are_garbled_unless_they_are_equal() -> None:
    line = Bus((bench(Model.I_7017).state, bench(Model.I_7017F).state))

    assert hear(line, b"$016\r")[1] == b"!01FF\r"
    answer = hear(line, b"$01M\r")[1]
    assert answer is not None
    assert answer == b"!017017\r"[:-1] + bytes((0x0D & ord("F"),)) + b"\r"


def test_every_module_has_its_signals() -> None:
    line = bus(A01=Model.I_7018)

    with pytest.raises(InvalidValueError, match="signals cannot be 0: 1, one for each module"):
        line.step(dcon.seal(b"#01", checksum=False), [], 0.0)


# --- what hosts send, in pieces ---------------------------------------------------------------------------------------

RTU = modbus.encode(modbus.ReadModuleName(1))
MASK = modbus.encode(modbus.SetChannelMask(1, 0x0F), Profile(Model.M_7017))


def hear_all(line: Bus, *pieces: bytes, ear: Ear | None = None) -> tuple[Bus, Ear, list[Heard]]:
    ear = ear or Ear()
    told: list[Heard] = []
    for piece in pieces:
        line, ear, heard = line.hear(ear, piece, [Signals()] * len(line.modules), 1000.0)
        told += heard
    return line, ear, told


def silence(line: Bus, ear: Ear) -> tuple[Bus, Ear, tuple[Heard, ...]]:
    return line.silence(ear, [Signals()] * len(line.modules), 1000.0)


@pytest.mark.parametrize("size", [1, 2, 3, 100])
def test_frames_are_heard_in_whatever_pieces_they_come(size: int) -> None:
    stream = b"$01M\r" + RTU + b"$02M\r" + b"\xff\xfe" + RTU

    _, ear, told = hear_all(bus(**MIXED), *(stream[at : at + size] for at in range(0, len(stream), size)))

    answers = sorted(heard.answer for heard in told if heard.answer)
    name = modbus.encode(modbus.ModuleName(1, b"\0\x70\x17\0"))
    assert [name, name, b"!017018\r", b"!027019R\r"] == answers
    assert not ear.waiting


def test_a_heard_frame_has_the_module_and_its_profile() -> None:
    line, ear, told = hear_all(bus(**MIXED), b"$02M\r", b"$09M\r")
    line, ear, _ = silence(line, ear)

    _, _, others = hear_all(line, RTU, ear=ear)

    told += others
    assert [(heard.module, heard.profile and heard.profile.model) for heard in told] == [
        (1, Model.M_7019R),
        (None, None),
        (2, Model.M_7017),
    ]
    assert [heard.protocol for heard in told] == [Protocol.DCON, Protocol.DCON, Protocol.MODBUS_RTU]


def test_noise_is_reported_unless_it_is_a_frame_to_others() -> None:
    _, _, told = hear_all(bus(A01=Model.I_7018), b"\xff\r", RTU + b"\r")

    assert [heard.frame.wire for heard in told if isinstance(heard.frame, Noise)] == [b"\xff\r", RTU + b"\r"]


@pytest.mark.parametrize("said", [b"$09M\r", b"#**\r", b"hello\r"])
def test_a_reported_dcon_frame_is_not_reported_again_as_noise_to_others(said: bytes) -> None:
    line, ear, told = hear_all(bus(**MIXED), said)

    _, ear, others = silence(line, ear)

    assert len(told) == 1
    assert others == ()
    assert ear == Ear()


def test_bytes_longer_than_a_frame_are_noise_before_the_silence() -> None:
    _, ear, told = hear_all(bus(M01=Model.M_7017), b"\xff" * 256, b"\xff")

    assert [heard.frame for heard in told] == [Noise(b"\xff" * 257, Fault.ADDRESS)]
    assert not ear.waiting


def test_a_setting_that_one_frame_makes_holds_for_the_next_in_the_same_piece() -> None:
    _, _, told = hear_all(bus(A01=Model.I_7018), b"%0102050600\r$02M\r$01M\r")

    assert [heard.answer for heard in told] == [b"!02\r", b"!027018\r", None]


def test_silence_ends_a_frame_that_could_be_longer() -> None:
    line, ear, told = hear_all(bus(M01=Model.M_7017), MASK)
    assert told == []
    assert ear.waiting

    line, ear, heard = silence(line, ear)

    assert [it.frame for it in heard] == [MASK]
    assert line.modules[0].eeprom.channel_mask == 0x0F
    assert Ear() == ear


def test_silence_does_not_end_a_frame_of_dcon() -> None:
    line, ear, told = hear_all(bus(**MIXED), b"$01")
    line, ear, _ = silence(line, ear)

    _, _, told = hear_all(line, b"M\r", ear=ear)

    assert [heard.answer for heard in told] == [b"!017018\r"]


def test_an_unknown_function_is_a_frame_when_silence_follows() -> None:
    line, ear, _ = hear_all(bus(M01=Model.M_7017), modbus.seal(b"\x01\x63\x00"))

    _, _, heard = silence(line, ear)

    assert [modbus.seal(b"\x01\xe3\x01")] == [it.answer for it in heard]


def test_a_heard_frame_has_the_response_delay() -> None:
    line, _, _ = hear_all(bus(M01=Model.M_7017), modbus.encode(modbus.WriteSingleRegister(1, 487, 30)))

    _, _, told = hear_all(line, RTU)

    assert [heard.delay for heard in told] == [0.03]


def test_a_module_hears_a_host_that_is_set_to_its_line_only() -> None:
    slow, fast = (
        bench(Model.I_7018, address=at, line_settings=LineSettings(rate)).state
        for at, rate in ((1, BaudRate.BAUD_9600), (2, BaudRate.BAUD_19200))
    )
    asked = b"$01M\r$02M\r"

    for uart, answers in (
        (Uart(9600), [b"!017018\r"]),
        (Uart(9600, stop_bits=2), [b"!017018\r"]),
        (Uart(19200), [b"!027018\r"]),
        (Uart(9600, parity="E"), []),
        (Uart(300), []),
        (None, [b"!017018\r", b"!027018\r"]),
    ):
        _, _, told = hear_all(Bus((slow, fast)), asked, ear=Ear(uart))

        assert answers == [heard.answer for heard in told if heard.answer]


def test_what_passes_a_wrong_parity_is_answered_in_a_parity_that_is_wrong_for_the_host() -> None:
    """Every character of this request has an odd number of ones, as stop bits and even parity bits alike have it."""
    module = bench(Model.I_7018, address=0x11).state

    _, _, told = hear_all(Bus((module,)), b"#11\r", ear=Ear(Uart(9600, parity="E")))

    answer = b">" + b"+0.0000" * 8 + b"\r"
    assert [hear_at(answer, Uart(9600), Uart(9600, parity="E"))] == [heard.answer for heard in told]


def test_one_piece_with_frames_of_both_protocols_is_not_cut_for_those_with_other_line_settings() -> None:
    """A cut would be a pause to the module that samples at its own settings: it hears the piece as a whole."""
    even = LineSettings(character_format=CharacterFormat.E81)
    stranger = bench(Model.I_7018, address=0x11).state
    asked = bench(Model.M_7019R, protocol=Protocol.MODBUS_RTU, line_settings=even).state
    request = modbus.encode(modbus.ReadModuleName(1))

    _, _, told = hear_all(Bus((stranger, asked)), request + b"#11\r", ear=Ear(Uart(9600, parity="E")))

    assert [(b"#11\r", 0), (request, 1)] == [
        (heard.frame, heard.module) for heard in told if not isinstance(heard.frame, Noise)
    ]


@pytest.mark.parametrize(
    ("frame", "ends"),
    [
        (b"\x01\x46\x63", True),
        (b"\x46\x63", True),
        (b"\x46", False),
        (b"\x00\x01\x46\x63", False),
        (Noise(b"\x01\x46\x63", Fault.LENGTH), False),
    ],
)
def test_what_waits_for_silence_ends_with_a_frame_if_nothing_came_after_it(frame: bytes | Noise, ends: bool) -> None:  # noqa: FBT001
    _, ear, _ = hear_all(bus(M01=Model.M_7017), b"\x01\x46\x63")

    assert ends == ear.ends_with(frame)


def test_what_does_not_wait_for_silence_ends_with_nothing() -> None:
    _, ear, _ = hear_all(bus(A01=Model.I_7018), b"$01")

    assert not ear.ends_with(b"$01")
    assert not Ear().ends_with(b"")


def test_all_that_waits_for_silence_has_to_end_with_the_frame() -> None:
    """The second module hears the characters with an odd number of ones only, so all but the third."""
    even = LineSettings(character_format=CharacterFormat.E81)
    modules = [
        bench(Model.M_7017, address=2, protocol=Protocol.MODBUS_RTU, line_settings=line).state
        for line in (even, LineSettings())
    ]
    _, ear, _ = hear_all(Bus(tuple(modules)), b"\x02\x46\x63\x01", ear=Ear(Uart(9600, parity="E")))

    assert not ear.ends_with(b"\x63\x01")
    assert ear.ends_with(b"\x01")


@pytest.mark.parametrize("modules", [None, [], (None,), "modules"])
def test_a_bus_is_a_tuple_of_modules(modules: Any) -> None:
    with pytest.raises(InvalidValueError, match=r"modules cannot be .*: a tuple of State"):
        Bus(modules)


# --- what holds for every bus -----------------------------------------------------------------------------------------


@st.composite
def buses(draw: st.DrawFn) -> Bus:
    """Modules at any addresses, of which several may be the same."""
    modules = []
    for state in draw(st.lists(device.states(now=NOW), min_size=1, max_size=5)):
        log = draw(st.sampled_from((Log(), Log(command=LogCommand.CONTINUOUS, period=(0, 0, 1), overwrite=True))))
        eeprom = evolve(state.eeprom, address=draw(st.integers(0, 0x11)), log=log)
        modules.append(power_on(eeprom, init_switch=state.ram.init_switch, now=NOW))
    return Bus(tuple(modules))


def sent_to(bus: Bus) -> st.SearchStrategy[bytes]:
    """Frames to its modules, damaged ones, frames to nobody, broadcasts and noise."""
    to_modules = st.sampled_from(bus.modules).flatmap(any_frames)
    unknown = st.builds(lambda module: modbus.seal(bytes((module.ram.address, 0x63, 0))), st.sampled_from(bus.modules))
    return st.one_of(
        to_modules,
        to_modules,
        unknown,
        dcon_frames(),
        modbus_frames(modbus.Side.REQUESTS),
        st.sampled_from((b"#**\r", b"~**\r", modbus.encode(modbus.WriteSingleRegister(0, 487, 5)))),
    )


def lived_through(bus: Bus, ear: Ear, pieces: Iterable[bytes], on: Signals) -> tuple[list[Heard], Bus]:
    """Hear pieces and the silence after them; tell the frames, and what became of the modules."""
    each = [on] * len(bus.modules)
    told: list[Heard] = []
    for piece in pieces:
        bus, ear, heard = bus.hear(ear, piece, each, NOW)
        told += heard
    bus, _, heard = bus.silence(ear, each, NOW)
    return [it for it in (*told, *heard) if not isinstance(it.frame, Noise)], bus


@pytest.mark.no_cover
@given(st.data(), buses(), device.signals())
def test_any_pieces_give_the_same_frames_in_the_same_order_and_the_same_modules(
    data: st.DataObject, bus: Bus, on: Signals
) -> None:
    wire = b"".join(data.draw(st.lists(sent_to(bus), max_size=6)))

    whole = lived_through(bus, Ear(), [wire], on)

    assert whole == lived_through(bus, Ear(), [bytes((byte,)) for byte in wire], on)
    assert whole == lived_through(bus, Ear(), data.draw(chunkings(wire)), on)


@pytest.mark.no_cover
@given(st.data(), buses(), device.signals())
def test_nothing_that_a_host_sends_at_any_line_settings_raises(data: st.DataObject, bus: Bus, on: Signals) -> None:
    uart = Uart(data.draw(st.sampled_from((300, 9600, 19200, 115200))), parity=data.draw(st.sampled_from("NEOMS")))
    wire = b"".join(data.draw(st.lists(sent_to(bus), max_size=6)))

    told, after = lived_through(bus, Ear(uart), data.draw(chunkings(wire)), on)

    assert len(bus.modules) == len(after.modules)
    assert all(heard.module is not None for heard in told if heard.answer is not None)


@pytest.mark.no_cover
@given(st.data(), buses(), device.signals(), st.floats(0, 1e6))
def test_who_is_not_asked_only_notices_the_time(data: st.DataObject, bus: Bus, on: Signals, later: float) -> None:
    frame = data.draw(sent_to(bus))

    after, answer = bus.step(frame, [on] * len(bus.modules), NOW + later)

    alone: list[tuple[State, bytes | None]] = [step(module, frame, on, NOW + later) for module in bus.modules]
    assert [state for state, _ in alone] == list(after.modules)
    assert (answer is None) == all(own is None for _, own in alone)
