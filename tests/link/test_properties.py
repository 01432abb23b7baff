"""What holds for the virtual port and the line whatever is written, and in whatever pieces."""

from hypothesis import given
from hypothesis import strategies as st

from i7000 import Model, Profile, Protocol, Unit, dcon, modbus
from i7000.device import Signals
from i7000.host import Answered, Policy
from i7000.link import Line, VirtualPort
from i7000.simulator.faults import Faults
from tests.simulator.running import module

DCON = module(Model.M_7018)
RTU = module(Model.M_7018, address=0x02, protocol=Protocol.MODBUS_RTU)
PROFILE = Profile(Model.M_7018)
POLICY = Policy(retries=0, turnaround=0.1, grace=0.3)
VOLTS = Signals.of(Unit.VOLT, 1.5)
FRAMES = (b"#01\r", b"$01M\r", b"~**\r", modbus.encode(modbus.ReadInputRegisters(0x02, 0, 8)))

probabilities = st.sampled_from((0.0, 0.01, 0.3))
faults = st.builds(
    Faults,
    echo=st.booleans(),
    lumps=st.booleans(),
    drop=probabilities,
    flip=probabilities,
    noise=probabilities,
    late=probabilities,
    late_by=st.just(0.1),
    silent=probabilities,
    truncate=probabilities,
)


def bus(given_faults: Faults | None = None, seed: int = 0) -> VirtualPort:
    return VirtualPort((DCON, RTU), (VOLTS, VOLTS), given_faults, seed=seed)


@given(st.lists(st.binary(max_size=40) | st.sampled_from(FRAMES), max_size=8), faults, st.integers(0, 99))
def test_any_bytes_are_heard_and_leave_the_line_usable(pieces: list[bytes], some: Faults, seed: int) -> None:
    port = bus(some, seed)
    for piece in pieces:
        port.write(piece)
        port.sleep(0.01)
    port.write(b"\r")
    port.faults = Faults()
    port.sleep(10.0)

    with Line(port, policy=POLICY) as line:
        for command in (dcon.ReadModuleName(0x01), modbus.ReadModuleName(0x02)):
            assert isinstance(line.ask(command, PROFILE), Answered)


@given(st.lists(st.sampled_from(FRAMES), max_size=4), st.lists(st.integers(0, 60), max_size=10))
def test_the_pieces_of_a_write_make_no_difference(frames: list[bytes], cuts: list[int]) -> None:
    written = b"".join(frames)
    whole, pieced = bus(), bus()
    whole.write(written)
    for start, stop in zip((0, *sorted(cuts)), (*sorted(cuts), None), strict=True):
        pieced.write(written[start:stop])

    for port in (whole, pieced):
        port.timeout = 2.0
    assert whole.read(1000) == pieced.read(1000)


@given(faults, st.integers(0, 99))
def test_the_time_never_goes_back_and_ends_with_every_request(some: Faults, seed: int) -> None:
    port = bus(some, seed)
    times: list[float] = []
    with Line(port, policy=POLICY, echo=some.echo, observe=lambda observed: times.append(observed.at)) as line:
        for command in (dcon.ReadAnalogInputs(0x01), modbus.ReadInputRegisters(0x02, 0, 8)):
            line.ask(command, PROFILE)

    assert times == sorted(times)
    assert port.now() < 5.0
