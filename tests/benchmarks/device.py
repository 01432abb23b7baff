"""The model of a module against its own codec: reading the same frame and writing the same answer, nothing between.

What is compared: `step` reads the frame, looks at time, does what is asked or measures, makes the response and writes
it. The codec is given the response ready made, and where there is none it only reads; where all channels are measured
anew each time, it is given their readings, and writes these as fields or words too. Signals that change are others in
each step, made before. Frames that write are sent in turn, so that each changes something.
"""

from collections.abc import Iterator
from contextlib import suppress
from itertools import count, cycle, repeat
from typing import Any

from attrs import evolve, frozen

from i7000 import DecodeError, Model, Profile, Protocol, ReportSettings, TypeCode, Unit, dcon, modbus
from i7000.device import LogCommand, Signal, Signals, State, factory, power_on, step
from tests.benchmarks.timing import Result, Task, at_most, best_times, shown

MOST = 4.0
FIXED = Signals.of(Unit.MILLIVOLT, *(100.0 * channel for channel in range(8)))
MANY = 100_000


def module(protocol: Protocol, *, checksum: bool = False) -> State:
    """An M-7019R, all channels +/- 1 V."""
    made = factory(Model.M_7019R)
    report = ReportSettings(checksum=checksum)
    types = (TypeCode.V_1_0A,) * len(made.type_codes)
    return power_on(evolve(made, protocol=protocol, report_settings=report, type_codes=types), now=0.0)


@frozen
class Dialogue:
    """Frames that a module hears in turn."""

    what: str
    state: State
    frames: tuple[bytes, ...]
    changing: bool = False
    """Whether there are other signals each time."""
    measured: bool = False
    """Whether all channels are measured anew each time."""
    seconds: float = 0.0
    """How much time passes between two."""

    def device(self) -> Task:
        """Give the next frame to the module."""
        state, frames, signals = self.state, cycle(self.frames), changing() if self.changing else repeat(FIXED)
        moments = count(0.0, self.seconds)

        def hear() -> bytes | None:
            nonlocal state
            state, answer = step(state, next(frames), next(signals), next(moments))
            return answer

        return hear

    def codec(self) -> Task:
        """Read the next frame, and write what answers it."""
        state, heard = self.state, []
        for frame in self.frames:
            after, answer = step(state, frame, FIXED, 0.0)
            heard.append((frame, state.profile, self.writing(value_of(frame, answer, state), after.profile)))
            state = after
        rounds = cycle(heard)
        rtu = self.state.ram.protocol is Protocol.MODBUS_RTU
        decode: Any = modbus.decode_request if rtu else dcon.decode_command

        def read_and_write() -> object:
            frame, before, write = next(rounds)
            with suppress(DecodeError):
                decode(frame, before)
            return write()

        return read_and_write

    def writing(self, response: Any, profile: Profile) -> Task:
        """Return how the codec encodes a response: from its readings, if they are measured."""
        if response is None:
            return lambda: None
        if self.measured and isinstance(response, dcon.AnalogInputs):
            told = dcon.readings(response, profile)
            return lambda: dcon.encode(dcon.AnalogInputs(dcon.fields(told, profile)), profile)
        if self.measured and isinstance(response, modbus.InputRegisters):
            read, at = modbus.readings(response.values, profile), response.address
            return lambda: modbus.encode(modbus.InputRegisters(at, modbus.words(read, profile)), profile)
        encode: Any = modbus.encode if isinstance(response, modbus.Message) else dcon.encode
        return lambda: encode(response, profile)


def changing() -> Iterator[Signals]:
    """Signals that are never the same, more than are asked for."""
    made = (Signals((Signal(tick / MANY, Unit.VOLT), *FIXED.channels[1:])) for tick in range(MANY))
    return iter(tuple(made))


def value_of(frame: bytes, answer: bytes | None, state: State) -> Any:
    """The response that an answer is, as a value; None for silence."""
    if answer is None:
        return None
    if state.ram.protocol is Protocol.DCON:
        command: Any = dcon.decode_command(frame, state.profile)
        return dcon.decode_response(answer, command, state.profile)
    if answer[1] & 0x80:
        return modbus.ExceptionResponse(answer[0], answer[1] & 0x7F, answer[2])
    return modbus.decode_response(answer, modbus.decode_request(frame, state.profile), state.profile)


def dcon_dialogues() -> Iterator[Dialogue]:
    """What a module with checksums hears."""
    state = module(Protocol.DCON, checksum=True)

    def says(what: str, *commands: dcon.AnyCommand, changing: bool = False, measured: bool = False) -> Dialogue:
        frames = tuple(dcon.encode(command, state.profile, force=True) for command in commands)
        return Dialogue(what, state, frames, changing, measured)

    mask = (dcon.SetChannelMask(0x01, 0x7F), dcon.SetChannelMask(0x01, 0xFF))
    yield says("#AA, the same signals", dcon.ReadAnalogInputs(0x01))
    yield says("#AA, other signals each time", dcon.ReadAnalogInputs(0x01), changing=True, measured=True)
    yield says("#AAN", dcon.ReadAnalogInput(0x01, 3))
    yield says("$AA2", dcon.ReadConfiguration(0x01))
    yield says("$AA8Ci", dcon.ReadChannelTypeCode(0x01, 3))
    yield says("$AA5VV, each changes the mask", *mask)
    yield says("$AA7CiRrr, each changes a type", *(dcon.SetChannelTypeCode(0x01, 3, code) for code in TYPES))
    inputs = dcon.ReadAnalogInputs(0x01)
    yield says("$AA5VV and #AA in turn", mask[0], inputs, mask[1], inputs, measured=True)
    yield says("$AA8Ci, refused", dcon.ReadChannelTypeCode(0x01, 9))
    yield says("$AA2 to another module", dcon.ReadConfiguration(0x02))
    wrong = dcon.encode(dcon.ReadConfiguration(0x01), state.profile)[:-2] + b"0\r"
    yield Dialogue("$AA2 with a wrong checksum", state, (wrong,))


TYPES = (TypeCode.K, TypeCode.V_1_0A)


def modbus_dialogues() -> Iterator[Dialogue]:
    """What the same module hears by Modbus."""
    state = module(Protocol.MODBUS_RTU)

    def says(what: str, *requests: modbus.Request[Any], changing: bool = False, measured: bool = False) -> Dialogue:
        frames = tuple(modbus.encode(request, state.profile, force=True) for request in requests)
        return Dialogue(what, state, frames, changing, measured)

    yield says("04, the same signals", modbus.ReadInputRegisters(0x01, 0, 8))
    yield says("04, other signals each time", modbus.ReadInputRegisters(0x01, 0, 8), changing=True, measured=True)
    yield says("03, types of 8 channels", modbus.ReadHoldingRegisters(0x01, 256, 8))
    yield says("01, a coil", modbus.ReadCoils(0x01, 259, 1))
    yield says("46h, the mask", modbus.ReadChannelMask(0x01))
    yield says("06, each changes the delay", *(modbus.WriteSingleRegister(0x01, 487, delay) for delay in (1, 2)))
    yield says("06, each changes the watchdog", *(modbus.WriteSingleRegister(0x01, 488, time) for time in (1, 2)))
    types = (modbus.WriteMultipleRegisters(0x01, 256, (code,) * 8) for code in TYPES)
    yield says("10, each changes 8 types", *types)
    yield says("05, each changes a coil", *(modbus.WriteSingleCoil(0x01, 268, value) for value in (True, False)))
    yield says("46h, each changes the mask", *(modbus.SetChannelMask(0x01, mask) for mask in (0x7F, 0xFF)))
    yield says("03, exception 02", modbus.ReadHoldingRegisters(0x01, 470, 10))
    yield Dialogue(
        "04, 16 channels, a log record each time", logging(), says("", READ_16).frames, measured=True, seconds=1.0
    )
    yield says("04 to another module", modbus.ReadInputRegisters(0x02, 0, 8))
    frame = modbus.encode(modbus.ReadInputRegisters(0x01, 0, 8))
    yield Dialogue("04 with a wrong CRC", state, (frame[:-1] + bytes((frame[-1] ^ 1,)),))


READ_16 = modbus.ReadInputRegisters(0x01, 0, 16)


def logging() -> State:
    """An M-7017mC-16 that makes a record every second, and room for it."""
    state = power_on(factory(Model.M_7017mC_16), now=0.0)
    log = evolve(state.eeprom.log, command=LogCommand.CONTINUOUS, period=(0, 0, 1), overwrite=True)
    return state.store(log=log.planned(0.0))


def step_results() -> Iterator[Result]:
    """Step, of reading the command and writing the answer; how many steps that is in a second."""
    for protocol, dialogues in (("DCON", dcon_dialogues()), ("Modbus", modbus_dialogues())):
        found = {dialogue.what: dialogue for dialogue in dialogues}
        tasks = {f"step {what}": dialogue.device() for what, dialogue in found.items()}
        tasks |= {what: dialogue.codec() for what, dialogue in found.items()}
        times = best_times(tasks, turns=100, seconds=0.004)
        for what in found:
            yield at_most(f"step, of its own codec: {protocol} {what}", times[f"step {what}"], times[what], MOST)
        slowest = max(times[f"step {what}"] for what in found)
        yield shown(f"thousand steps a second, {protocol}, of the slowest", 1e-3 / slowest)
