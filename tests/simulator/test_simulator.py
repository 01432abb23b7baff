"""A simulated bus and its hosts: on pseudo-terminals, TCP and RFC 2217."""

import asyncio
import errno
from collections.abc import Sequence
from contextlib import suppress
from threading import Event, Thread
from time import monotonic, sleep

import pytest
from attrs import evolve

from i7000 import LogCommand, Model, Noise, Profile, Protocol, ReportSettings, Unit, dcon, modbus
from i7000.device import Bus, Eeprom, Log, Signal
from i7000.simulator.deliveries import MOST_LATE_BYTES, MOST_LATE_PIECES
from i7000.simulator.faults import Faults, Way
from i7000.simulator.memory import MemoryFileError
from i7000.simulator.observed import Change, Observed
from i7000.simulator.pseudo_terminal import open_pty
from i7000.simulator.simulator import UNREAD, Host, Simulated, Simulator
from i7000.simulator.sources import Fixed, Sources
from i7000.simulator.tcp import listen
from tests.simulator.running import I_7018, SAID, TRANSPORTS, ask, connected, module, port, running

every_transport = pytest.mark.parametrize("scheme", TRANSPORTS)


@every_transport
def test_a_host_reads_what_is_on_the_inputs(scheme: str) -> None:
    with running(TRANSPORTS[scheme], I_7018) as here, port(here, scheme) as opened:
        assert ask(opened, b"#01\r", len(SAID)) == SAID
        assert ask(opened, b"$01M\r", 8) == b"!017018\r"


@every_transport
def test_bytes_of_all_values_pass(scheme: str) -> None:
    channels = Sources(tuple(Fixed(Signal(value, Unit.VOLT)) for value in (2.5, -2.5, -0.0001, 0.98, 1, 1, 1, 1)))
    spoken = module(Model.M_7018, sources=channels, protocol=Protocol.MODBUS_RTU)
    request = modbus.encode(modbus.ReadInputRegisters(1, 0, 4))

    with running(TRANSPORTS[scheme], spoken) as here, port(here, scheme) as opened:
        answer = ask(opened, request, 13)

    assert modbus.unseal(answer) == b"\x01\x04\x08\x7f\xff\x80\x00\xff\xff\x32\x2d"


@every_transport
def test_what_hosts_send_in_pieces_is_heard_whole(scheme: str) -> None:
    with running(TRANSPORTS[scheme], I_7018) as here, port(here, scheme) as opened:
        for byte in b"$01M":
            opened.write(bytes((byte,)))
            sleep(0.03)

        assert ask(opened, b"\r", 8) == b"!017018\r"


@pytest.mark.parametrize("scheme", ["socket", "rfc2217"])
def test_hosts_share_modules_and_not_what_they_have_half_sent(scheme: str) -> None:
    with (
        running(TRANSPORTS[scheme], I_7018) as here,
        port(here, scheme) as one,
        port(here, scheme) as other,
    ):
        one.write(b"$0")

        assert ask(other, b"~01OABC\r", 4) == b"!01\r"
        assert ask(one, b"1M\r", 7) == b"!01ABC\r"
        assert other.in_waiting == 0


def test_a_frame_that_could_be_longer_is_heard_when_the_line_is_silent() -> None:
    spoken = module(Model.M_7017, protocol=Protocol.MODBUS_RTU)
    request = modbus.SetChannelMask(1, 0x0F)

    with running(listen, spoken) as here, port(here, "socket") as opened:
        answer = ask(opened, modbus.encode(request, Profile(Model.M_7017)), 6)
        opened.write(b"\x01")
        sleep(0.1)
        observed = list(here.observed)

    assert modbus.encode(modbus.ChannelMaskResult(1, 0)) == answer
    assert [Noise] == [type(it.heard) for it in observed[1:]]


def test_a_frame_that_follows_an_answer_in_another_protocol_is_heard_at_once() -> None:
    """With the carriage return before it, the address of this frame is the function of a longer one."""
    modules = module(Model.I_7018), module(Model.M_7017, protocol=Protocol.MODBUS_RTU, address=0x10)
    answers: list[bytes] = []
    observed: list[Observed] = []

    async def converse() -> None:
        host = Host(Simulator(modules, observe=observed.append), "host", answers.append)
        host.receive(b"$01M\r")
        host.receive(modbus.encode(modbus.ReadModuleName(0x10)))

    asyncio.run(converse())

    assert answers == [b"!017018\r", modbus.encode(modbus.ModuleName(0x10, b"\0\x70\x17\0"))]
    assert [it.protocol for it in observed] == [Protocol.DCON, Protocol.MODBUS_RTU]


def test_what_comes_after_a_frame_that_is_answered_is_not_silence() -> None:
    modules = module(Model.I_7018), module(Model.M_7017, protocol=Protocol.MODBUS_RTU, address=0x20)
    asked = modbus.encode(modbus.ReadModuleName(0x20))
    answers: list[bytes] = []

    async def converse() -> None:
        host = Host(Simulator(modules), "host", answers.append)
        host.receive(b"$01M\r" + asked[:2])
        host.receive(asked[2:])

    asyncio.run(converse())

    assert answers == [b"!017018\r", modbus.encode(modbus.ModuleName(0x20, b"\0\x70\x17\0"))]


def test_the_response_delay_is_waited_for() -> None:
    spoken = module(Model.M_7017, protocol=Protocol.MODBUS_RTU, response_delay=30)
    request = modbus.encode(modbus.ReadModuleName(1))

    with running(listen, spoken) as here, port(here, "socket") as opened:
        began = monotonic()
        answer = ask(opened, request, 9)

    assert monotonic() - began > 0.029
    assert len(answer) == 9


def test_a_host_that_is_gone_gets_no_answer() -> None:
    spoken = module(Model.M_7017, protocol=Protocol.MODBUS_RTU, response_delay=30)

    with running(listen, spoken) as here:
        with port(here, "socket") as opened:
            opened.write(modbus.encode(modbus.ReadModuleName(1)))
            while not here.observed:
                sleep(0.001)
        sleep(0.05)

        with port(here, "socket") as opened:
            assert len(ask(opened, modbus.encode(modbus.ReadModuleName(1)), 9)) == 9


# --- faults -----------------------------------------------------------------------------------------------------------


def test_an_echo_comes_before_the_answer() -> None:
    with running(listen, I_7018, faults=Faults(echo=True)) as here, port(here, "socket") as opened:
        assert ask(opened, b"$01M\r", 13) == b"$01M\r!017018\r"


def test_lumps_come_one_after_the_other() -> None:
    with running(listen, I_7018, faults=Faults(lumps=True)) as here, port(here, "socket") as opened:
        began = monotonic()
        answer = ask(opened, b"#01\r", len(SAID))

    assert answer == SAID
    assert monotonic() - began > 0.06


def test_a_late_answer_comes_after_the_next_request() -> None:
    faults = Faults(late=1.0, late_by=0.1)
    with running(listen, I_7018, faults=faults) as here, port(here, "socket") as opened:
        opened.write(b"$01M\r")
        sleep(0.05)
        here.call(lambda: setattr(here.simulator, "faults", Faults()))

        answers = ask(opened, b"$016\r", 14)
        told = here.observed[0].faults

    assert answers == b"!01FF\r!017018\r"
    assert told == ("late by 0.1 s",)


@pytest.mark.parametrize(("command", "answer"), [(b"#01\r", SAID), (b"$01M\r", b"!017018\r")])
def test_of_late_answers_no_more_are_kept_than_there_is_room_for(command: bytes, answer: bytes) -> None:
    observed: list[Observed] = []
    room = min(MOST_LATE_PIECES, MOST_LATE_BYTES // len(answer))

    async def converse() -> int:
        simulator = Simulator([I_7018], faults=Faults(late=1.0, late_by=60), observe=observed.append)
        host = Host(simulator, "host", lambda _: None)
        host.receive(command * 2000)
        host.close()
        (lost,) = simulator.notices.values()
        return lost

    lost = asyncio.run(converse())

    assert lost == 2000 - room
    assert [[piece.after for piece in it.pieces] for it in observed] == [[60.0]] * room + [[]] * lost
    assert [it.faults for it in observed] == [("late by 60 s",)] * room + [
        ("late by 60 s", "an answer was lost: too many are late")
    ] * lost


def test_an_answer_that_is_not_late_is_sent_however_many_are() -> None:
    sent: list[bytes] = []

    async def converse() -> None:
        simulator = Simulator([I_7018], faults=Faults(late=1.0, late_by=60))
        host = Host(simulator, "host", sent.append)
        host.receive(b"#01\r" * 2000)
        simulator.faults = Faults()
        host.receive(b"$01M\r")
        host.close()

    asyncio.run(converse())

    assert sent == [b"!017018\r"]


def test_there_is_room_again_once_late_answers_have_come() -> None:
    sent: list[bytes] = []

    async def converse() -> None:
        simulator = Simulator([I_7018], faults=Faults(late=1.0, late_by=0.05))
        host = Host(simulator, "host", sent.append)
        host.receive(b"$01M\r" * 2000)
        await asyncio.sleep(0.3)
        host.receive(b"#01\r")
        await asyncio.sleep(0.3)

    asyncio.run(converse())

    assert (len(sent), sent[-1]) == (MOST_LATE_PIECES + 1, SAID)


def test_the_same_seed_has_the_same_faults() -> None:
    def heard(seed: int) -> list[bytes]:
        faults = Faults(drop=0.02, flip=0.02, noise=0.2)
        with running(listen, I_7018, faults=faults, seed=seed) as here, port(here, "socket") as opened:
            opened.timeout = 0.05
            return [ask(opened, b"#01\r", 100) for _ in range(10)]

    first = heard(1)

    assert first == heard(1)
    assert first != heard(2)


def test_the_faults_of_a_frame_are_reported_with_the_frame() -> None:
    """A request by Modbus that was damaged is heard only when the line is silent."""
    spoken = module(Model.M_7017, protocol=Protocol.MODBUS_RTU)

    with running(listen, spoken, faults=Faults(flip=1.0)) as here, port(here, "socket") as opened:
        opened.write(b"\x01\x04")
        while not here.observed:
            sleep(0.01)

    assert [len(it.faults) for it in here.observed] == [2]


def test_of_what_is_lost_altogether_not_all_is_remembered() -> None:
    async def converse() -> list[Observed]:
        observed: list[Observed] = []
        simulator = Simulator([I_7018], faults=Faults(drop=1.0), observe=observed.append)
        host = Host(simulator, "host", lambda _: None)
        host.receive(b"#01\r" * 1000)
        simulator.faults = Faults()
        host.receive(b"#02\r")
        return observed

    (told,) = asyncio.run(converse())

    assert told.faults[-1] == "byte 3999 lost"
    assert len(told.faults) == 16


def conversed(faults: Faults, *frames: bytes, modules: Sequence[Simulated] = (I_7018,)) -> list[bytes]:
    """What arrives after each frame that a host sends."""
    answers: list[bytes] = []

    async def converse() -> None:
        host = Host(Simulator(modules, faults=faults), "host", answers.append)
        for frame in frames:
            host.receive(frame)

    asyncio.run(converse())
    return answers


def test_a_fault_of_one_address_leaves_the_other_modules_alone() -> None:
    other = module(Model.I_7017, address=2)

    answers = conversed(Faults().at(0x01, silent=1.0), b"$01M\r", b"$02M\r", modules=(I_7018, other))

    assert answers == [b"!027017\r"]


def test_the_answer_to_an_earlier_command_is_that_to_the_last_different_one() -> None:
    answers = conversed(Faults(replay=1.0), b"$01M\r", b"$01M\r", b"$016\r", b"$016\r", b"$01M\r")

    assert answers == [b"!017018\r", b"!017018\r", b"!017018\r", b"!017018\r", b"!01FF\r"]


def test_a_refusal_has_the_checksum_of_its_module() -> None:
    checked = module(Model.I_7018, report_settings=ReportSettings(checksum=True))

    answers = conversed(Faults(refuse=1.0), dcon.seal(b"$01M", checksum=True), modules=(checked,))

    assert answers == [dcon.seal(b"?01", checksum=True)]


def test_requests_can_be_lost_while_answers_are_not() -> None:
    assert conversed(Faults().at(Way.FROM, drop=1.0), b"$01M\r") == [b""]
    assert conversed(Faults().at(Way.TO, drop=1.0), b"$01M\r") == []


# --- what modules remember --------------------------------------------------------------------------------------------


def test_what_changes_in_an_eeprom_is_stored_at_once() -> None:
    stored: list[Sequence[Eeprom]] = []

    with running(listen, I_7018, module(Model.I_7017, address=2), store=stored.append) as here:
        with port(here, "socket") as opened:
            ask(opened, b"$01M\r", 8)
            assert stored == []

            ask(opened, b"~01OABC\r", 4)

        assert [[eeprom.name for eeprom in eeproms] for eeproms in stored] == [["ABC", "7017"]]


def test_time_passes_for_modules_that_nobody_talks_to() -> None:
    stored: list[Sequence[Eeprom]] = []

    with running(listen, I_7018, store=stored.append) as here:
        with port(here, "socket") as opened:
            ask(opened, b"~013101\r", 4)
        sleep(0.5)

    assert [eeproms[0].host_watchdog_timeouts for eeproms in stored] == [0, 1]


@pytest.mark.parametrize(
    "error",
    [
        OSError(errno.ENOSPC, "no space", "modules.json"),
        MemoryFileError("modules.json", "the file", "is a device or pipe", "a regular file"),
    ],
    ids=["disk full", "no file"],
)
def test_what_cannot_be_stored_is_not_acknowledged_and_ends_the_simulation(error: Exception) -> None:
    answers: list[bytes] = []

    def store(_: Sequence[Eeprom]) -> None:
        raise error

    async def rename() -> None:
        simulator = Simulator([I_7018], store=store)
        host = Host(simulator, "host", answers.append)
        host.receive(b"$01M\r~01OABC\r")
        host.receive(b"~01OABD\r$01M\r")
        await simulator.run()

    with pytest.raises(type(error), match=r"modules\.json"):
        asyncio.run(rename())

    assert answers == []


def test_nothing_is_acknowledged_and_nothing_stored_after_the_end() -> None:
    answers: list[bytes] = []
    stored: list[Sequence[Eeprom]] = []

    async def rename() -> None:
        simulator = Simulator([I_7018], store=stored.append)
        host = Host(simulator, "host", answers.append)
        simulator.end()
        host.receive(b"~01OABC\r")
        host.receive(b"$01M\r")
        await simulator.run()

    asyncio.run(rename())

    assert (answers, stored) == ([b"!017018\r"], [])


def test_a_power_cycle_leaves_what_is_stored() -> None:
    with running(listen, I_7018) as here, port(here, "socket") as opened:
        ask(opened, b"~01OABC\r", 4)
        ask(opened, b"~01E1\r", 4)

        here.call(here.simulator.power_cycle)

        assert ask(opened, b"$01M\r", 7) == b"!01ABC\r"
        assert ask(opened, b"$010\r", 4) == b"?01\r"


def test_power_is_cycled_at_one_place_only() -> None:
    changed: list[Change] = []

    async def cycle() -> tuple[bool, ...]:
        simulator = Simulator([I_7018, module(Model.I_7017, address=2)], watch=changed.append)
        before = simulator.bus.modules
        simulator.power_cycle(simulator.places(2))
        return tuple(one is other for one, other in zip(before, simulator.bus.modules, strict=True))

    assert asyncio.run(cycle()) == (True, False)
    assert [(it.address, it.what) for it in changed] == [(2, ("power cycle",))]


def test_changes_of_settings_are_reported_after_they_are_stored_and_answered() -> None:
    told: list[object] = []

    async def rename() -> None:
        simulator = Simulator([I_7018], store=told.append, watch=told.append)
        Host(simulator, "host", told.append).receive(b"~01OABC\r")

    asyncio.run(rename())

    stored, answer, change = told
    assert isinstance(stored, list)
    assert isinstance(change, Change)
    assert (change.address, change.model, change.what) == (1, Model.I_7018, ("name 7018 -> ABC",))
    assert answer == b"!01\r"


def test_a_power_cycle_that_cannot_be_stored_is_not_reported() -> None:
    changed: list[Change] = []
    due = Log(command=LogCommand.CONTINUOUS, period=(0, 0, 1))

    def store(_: Sequence[Eeprom]) -> None:
        raise OSError("no space")

    async def cycle() -> bool:
        simulator = Simulator([module(Model.M_7017mC_16)], store=store, watch=changed.append)
        (state,) = simulator.bus.modules
        simulator.bus = before = Bus((state.store(log=due),))
        simulator.power_cycle()
        with pytest.raises(OSError, match="no space"):
            await simulator.run()
        return simulator.bus is before

    assert asyncio.run(cycle())
    assert changed == []


def test_what_a_data_logger_writes_is_stored_and_not_reported() -> None:
    stored: list[Sequence[Eeprom]] = []
    changed: list[Change] = []

    async def write() -> None:
        simulator = Simulator([I_7018], store=stored.append, watch=changed.append)
        (state,) = simulator.bus.modules
        simulator.change(Bus((state.store(log=evolve(Log())),)))
        simulator.report_changes()

    asyncio.run(write())

    assert (len(stored), changed) == (1, [])


def test_the_init_switch_is_read_at_power_on() -> None:
    async def switch() -> list[tuple[bool, int]]:
        simulator = Simulator([I_7018])
        found = []
        for on in (True, False):
            simulator.switch_init(0, on=on)
            found.append((simulator.bus.modules[0].ram.init_switch, simulator.bus.modules[0].ram.address))
            simulator.power_cycle()
            found.append((simulator.bus.modules[0].ram.init_switch, simulator.bus.modules[0].ram.address))
        return found

    assert asyncio.run(switch()) == [(True, 1), (True, 0), (False, 0), (False, 1)]


def test_a_module_with_the_init_switch_set_has_address_00() -> None:
    with running(listen, evolve(I_7018, init_switch=True)) as here, port(here, "socket") as opened:
        assert ask(opened, b"$00M\r", 8) == b"!007018\r"


def test_other_signals_can_be_connected() -> None:
    with running(listen, I_7018) as here, port(here, "socket") as opened:
        here.call(lambda: here.simulator.connect([Sources((Fixed(Signal(2.0, Unit.VOLT)),))]))

        assert ask(opened, b"#010\r", 9) == b">+2.0000\r"


# --- hosts that do not behave -----------------------------------------------------------------------------------------


@every_transport
def test_a_host_that_does_not_read_holds_up_nobody(scheme: str) -> None:
    asked = 500
    with running(TRANSPORTS[scheme], I_7018) as here:
        with port(here, scheme) as opened:
            opened.write(b"#01\r" * asked)
            while len(here.observed) < asked:
                sleep(0.01)
        with port(here, scheme) as opened:
            opened.reset_input_buffer()

            assert ask(opened, b"$01M\r", 8) == b"!017018\r"


def test_what_a_host_at_a_pseudo_terminal_does_not_read_is_lost_and_counted() -> None:
    with running(open_pty, I_7018) as here, port(here, "pty") as opened:
        for _ in range(100):
            opened.write(b"#01\r" * 20)
            if here.simulator.notices:
                break
            sleep(0.02)

    assert set(here.simulator.notices) == {UNREAD}


@pytest.mark.parametrize("scheme", ["socket", "rfc2217"])
def test_a_host_that_never_ends_leaves_the_others_their_turn(scheme: str) -> None:
    with running(TRANSPORTS[scheme], I_7018) as here, connected(here) as flooding:
        flooding.settimeout(0.01)
        over = Event()

        def flood() -> None:
            while not over.is_set():
                with suppress(TimeoutError):
                    flooding.send(b"#01\r" * 50_000)

        hostile = Thread(target=flood)
        hostile.start()
        try:
            while len(here.observed) < 1000:
                sleep(0.01)
            with port(here, scheme) as opened:
                before = len(here.observed)
                answer = ask(opened, b"$01M\r", 8)
                meanwhile = len(here.observed) - before
        finally:
            over.set()
            hostile.join()

    assert answer == b"!017018\r"
    assert meanwhile < 10_000


@every_transport
def test_noise_is_reported_and_has_no_effect(scheme: str) -> None:
    with running(TRANSPORTS[scheme], I_7018) as here, port(here, scheme) as opened:
        opened.write(bytes(range(256)) * 20)

        answer = ask(opened, b"\r$01M\r", 8)

    assert answer == b"!017018\r"
    assert any(isinstance(it.heard, Noise) for it in here.observed)


def test_a_simulation_that_has_ended_can_be_ended_again() -> None:
    with running(listen, I_7018) as here:
        here.call(here.simulator.end)
        here.call(here.simulator.end)

        assert here.call(lambda: here.simulator.now) > 0
