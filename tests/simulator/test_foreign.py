"""Frames of the protocol that a module does not speak."""

import asyncio

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Fault, Model, Noise, Protocol, modbus, strategies
from i7000.device import Bus, Heard, factory, power_on
from i7000.simulator.faults import Faults
from i7000.simulator.foreign import LONGEST, deaf_module, foreign_frames
from i7000.simulator.observed import Observed
from i7000.simulator.simulator import Host, Simulated, Simulator
from tests.simulator.running import I_7018, module

DCON, RTU = Protocol.DCON, Protocol.MODBUS_RTU
M_7017 = module(Model.M_7017, protocol=RTU, address=2)
ASKED = modbus.encode(modbus.ReadInputRegisters(1, 0, 8))


def observed(
    modules: list[Simulated], *pieces: bytes, pause: float = 0.0, faults: Faults | None = None
) -> list[Observed]:
    """The events of the bytes that a host sends."""
    told: list[Observed] = []

    async def converse() -> None:
        host = Host(Simulator(modules, observe=told.append, faults=faults), "host", lambda _: None)
        for piece in pieces:
            host.receive(piece)
            if pause:
                await asyncio.sleep(pause)
        await asyncio.sleep(0.1)
        host.close()

    asyncio.run(converse())
    return told


def models(told: list[Observed]) -> list[tuple[bytes | Noise, Protocol, str | None]]:
    return [(it.heard, it.protocol, it.deaf.model.value if it.deaf else None) for it in told]


@pytest.mark.parametrize("frame", [b"$02M\r", b"#05\r", b"%0201000600\r", b"~**\r"])
def test_a_module_that_speaks_modbus_is_named_when_it_hears_dcon(frame: bytes) -> None:
    assert models(observed([M_7017], frame)) == [(frame, DCON, "M-7017")]


@pytest.mark.parametrize("start", [0, 0x0D, 0x2424, 0x2121])
def test_a_module_that_speaks_dcon_is_named_when_it_hears_modbus(start: int) -> None:
    frame = modbus.encode(modbus.ReadInputRegisters(1, start, 8))

    told = models(observed([I_7018], frame))

    assert told == [(frame, RTU, "I-7018")]


def test_frames_in_pieces_and_several_at_once_are_found() -> None:
    assert models(observed([M_7017], *[bytes((byte,)) for byte in b"$02M\r$022\r"])) == [
        (b"$02M\r", DCON, "M-7017"),
        (b"$022\r", DCON, "M-7017"),
    ]
    assert models(observed([I_7018], *[bytes((byte,)) for byte in ASKED + ASKED])) == [(ASKED, RTU, "I-7018")] * 2


def test_each_frame_is_reported_once() -> None:
    assert models(observed([I_7018], ASKED, ASKED, b"$01M\r", pause=0.05)) == [
        (ASKED, RTU, "I-7018"),
        (ASKED, RTU, "I-7018"),
        (b"$01M\r", DCON, None),
    ]


def test_of_several_modules_the_one_with_the_address_is_named() -> None:
    other = module(Model.M_7019R, protocol=RTU, address=3)

    assert models(observed([M_7017, other], b"$03M\r")) == [(b"$03M\r", DCON, "M-7019R")]
    assert models(observed([I_7018, M_7017], b"$02M\r")) == [(b"$02M\r", DCON, "M-7017")]
    assert models(observed([I_7018, M_7017], ASKED)) == [(ASKED, RTU, "I-7018")]


def test_nobody_is_named_where_the_protocol_is_spoken_and_the_address_is_nobodys() -> None:
    assert models(observed([I_7018, M_7017], b"$05M\r")) == [(b"$05M\r", DCON, None)]


def test_noise_stays_noise() -> None:
    assert models(observed([M_7017], b"$02M")) == [(Noise(b"$02M", Fault.FUNCTION), RTU, None)]
    assert models(observed([I_7018], ASKED[:-1])) == [(Noise(ASKED[:-1], Fault.LEADING), DCON, None)]


def test_noise_before_a_frame_is_reported_before_it() -> None:
    told = observed([I_7018], b"\xff\xfe", b"$01M\r")

    assert [it.heard for it in told] == [Noise(b"\xff\xfe", Fault.LEADING), b"$01M\r"]


def test_noise_without_an_end_is_reported_at_once() -> None:
    told: list[Observed] = []

    async def converse() -> None:
        host = Host(Simulator([I_7018], observe=told.append), "host", lambda _: None)
        host.receive(b"\xff" * (LONGEST + 1))
        host.close()

    asyncio.run(converse())

    assert [it.heard for it in told] == [Noise(b"\xff" * (LONGEST + 1), Fault.LEADING)]


@pytest.mark.parametrize(("spoken", "frame"), [(M_7017, b"$02M\r"), (I_7018, ASKED)])
def test_the_faults_of_a_frame_of_the_other_protocol_are_reported_with_it(spoken: Simulated, frame: bytes) -> None:
    (told,) = observed([spoken], frame, faults=Faults(noise=1.0))

    assert told.heard == frame
    assert [fault.partition(" ")[2] for fault in told.faults] == ["bytes of noise before"]


@pytest.mark.no_cover
@given(st.lists(strategies.device.eeproms(), min_size=1, max_size=3), st.binary(max_size=300) | st.just(ASKED))
def test_whatever_is_heard_only_frames_of_a_protocol_that_nobody_speaks_are_found(
    eeproms: list[object], wire: bytes
) -> None:
    modules = Bus(tuple(power_on(eeprom, now=0.0) for eeprom in eeproms)).modules  # type: ignore[arg-type] # Eeprom
    spoken = {one.ram.protocol for one in modules}

    found = foreign_frames(modules, wire)

    assert all(it.protocol not in spoken and it.frame in wire for it in found)  # type: ignore[operator] # no noise
    assert all(deaf_module(modules, it) is not None for it in found)


def test_noise_and_frames_that_modules_understand_have_no_deaf_module() -> None:
    modules = (power_on(factory(Model.I_7018), now=0.0),)

    assert deaf_module(modules, Heard(Noise(b"x", Fault.LEADING), RTU)) is None
    assert deaf_module(modules, Heard(b"$01M\r", DCON, 0)) is None
