"""The virtual port: what modules answer, when, and what a serial port does besides."""

from collections.abc import Callable
from time import monotonic
from typing import Any

import pytest
import serial
from attrs import evolve

from i7000 import BaudRate, CharacterFormat, LineSettings, Model, Protocol, TypeCode, Unit, modbus
from i7000.device import LogCommand, Signals, Uart, factory, power_on
from i7000.device.uart import hear_at
from i7000.errors import InvalidValueError, StateError
from i7000.link import VirtualPort
from i7000.link.virtual import BUFFER
from i7000.simulator.faults import Faults, Way
from i7000.simulator.observed import Observed
from i7000.simulator.sources import Fixed, Ramp, Sources
from tests.simulator.running import module

VOLTS = Signals.of(Unit.VOLT, 1.5)
READ = b"#010\r"
SAID = b">+1.5000\r"
CHARACTER = 10 / 9600
REQUEST = modbus.encode(modbus.ReadInputRegisters(0x01, 0, 1))
"""A request of 8 bytes; the response has 7."""


def dcon_port(**options: Any) -> VirtualPort:
    return VirtualPort([power_on(factory(Model.I_7018), now=0.0)], [VOLTS], **options)


def modbus_port(**stored: Any) -> VirtualPort:
    return VirtualPort([power_on(evolve(factory(Model.M_7018), **stored), now=0.0)], [VOLTS])


def answer(port: VirtualPort, request: bytes = READ, seconds: float = 1.0) -> bytes:
    port.write(request)
    port.timeout = seconds
    return port.read(1000)


def test_each_exchange_can_be_observed() -> None:
    port = dcon_port(faults=Faults(late=1.0, late_by=0.3))
    seen: list[Observed] = []
    port.observe = seen.append

    answer(port, b"#0F0\r#010\r")

    (observed,) = seen
    assert (observed.heard, observed.answer, observed.faults) == (READ, SAID, ("late by 0.3 s",))
    (piece,) = observed.pieces
    assert (piece.wire, round(piece.after, 6)) == (SAID, 0.3)


# --- time -------------------------------------------------------------------------------------------------------------


def test_a_dcon_response_takes_the_time_of_its_characters_and_of_the_command() -> None:
    port = dcon_port()
    port.timeout = 1.0
    port.write(READ)

    assert port.read_until(b"\r") == SAID
    assert port.now() == pytest.approx((len(READ) + len(SAID)) * CHARACTER)


def test_each_byte_is_there_at_its_time_and_not_before() -> None:
    port = dcon_port()
    port.write(READ)
    port.sleep((len(READ) + 3.5) * CHARACTER)

    assert port.in_waiting == 3


@pytest.mark.parametrize("delay", [0, 20])
def test_a_modbus_response_follows_after_a_silence_and_the_response_delay(delay: int) -> None:
    port = modbus_port(response_delay=delay)
    port.timeout = 1.0
    port.write(REQUEST)

    assert len(port.read(7)) == 7
    assert port.now() == pytest.approx((8 + 3.5 + 7) * CHARACTER + delay / 1000)


def test_a_read_without_bytes_moves_the_time_to_its_timeout() -> None:
    port = dcon_port()
    port.timeout = 0.25

    assert port.read() == b""
    assert port.now() == 0.25


def test_a_read_with_timeout_zero_moves_no_time() -> None:
    port = dcon_port()
    port.timeout = 0

    assert port.read() == b""
    assert port.now() == 0.0


def test_a_read_without_a_timeout_waits_for_bytes_that_are_on_their_way() -> None:
    port = dcon_port()
    port.write(READ)

    assert port.read(len(SAID)) == SAID


def test_a_read_that_would_wait_forever_is_refused() -> None:
    with pytest.raises(StateError, match="would wait forever"):
        dcon_port().read()


def test_polling_while_the_time_stands_still_is_refused() -> None:
    port = dcon_port()

    with pytest.raises(StateError, match=r"call sleep\(\)"):
        any(port.in_waiting for _ in range(1_000_000))


def test_polling_with_sleep_between_gets_the_answer() -> None:
    port = dcon_port()
    port.write(READ)
    while port.in_waiting < len(SAID):
        port.sleep(0.0001)

    assert port.read(port.in_waiting) == SAID


@pytest.mark.parametrize("seconds", [-1.0, float("nan"), float("inf")])
def test_a_sleep_of_an_impossible_time_is_refused(seconds: float) -> None:
    with pytest.raises(InvalidValueError, match="seconds"):
        dcon_port().sleep(seconds)


def test_no_real_time_passes() -> None:
    began = monotonic()
    dcon_port().sleep(1e6)

    assert monotonic() - began < 1e6


def test_modules_that_were_on_before_keep_their_clock() -> None:
    port = VirtualPort([power_on(factory(Model.I_7018), now=7.0)])

    assert port.now() == 7.0
    assert answer(port, b"$01M\r") == b"!017018\r"


# --- what modules hear and say ----------------------------------------------------------------------------------------


def test_bytes_that_are_written_one_by_one_are_one_frame() -> None:
    port = dcon_port()
    for byte in READ[:-1]:
        port.write(bytes((byte,)))

    assert answer(port, READ[-1:]) == SAID


def test_silence_ends_a_request_with_an_unknown_function() -> None:
    port = modbus_port()

    assert answer(port, modbus.seal(b"\x01\x2b\x00")) == modbus.seal(b"\x01\xab\x01")


def test_the_rest_of_a_request_after_a_silence_is_no_longer_part_of_it() -> None:
    port = modbus_port()

    assert answer(port, REQUEST[:5]) == b""
    assert answer(port, REQUEST[5:]) == b""
    assert len(answer(port, REQUEST)) == 7


def test_a_request_in_two_pieces_without_a_silence_is_one() -> None:
    port = modbus_port()
    port.write(REQUEST[:5])
    port.sleep(6 * CHARACTER)

    assert len(answer(port, REQUEST[5:])) == 7


def test_two_commands_at_once_get_their_responses_one_after_the_other() -> None:
    assert answer(dcon_port(), READ + b"$01M\r") == SAID + b"!017018\r"


def test_several_modules_of_both_protocols_share_the_line() -> None:
    port = VirtualPort([module(Model.I_7018), module(Model.M_7018, address=0x02, protocol=Protocol.MODBUS_RTU)])

    assert answer(port, b"$01M\r") == b"!017018\r"
    assert answer(port, modbus.encode(modbus.ReadModuleName(0x02)))[:3] == b"\x02\x46\x00"


def test_a_module_of_a_simulator_brings_its_own_signals() -> None:
    sources = Sources((Fixed(VOLTS.channel(0)),))

    assert answer(VirtualPort([module(Model.I_7018, sources=sources)])) == SAID


def test_signals_can_change_with_time_and_at_any_time() -> None:
    port = VirtualPort([power_on(factory(Model.I_7018), now=0.0)], [Sources((Ramp(0, 2, 10, Unit.VOLT),))])

    port.sleep(5.0)
    assert answer(port) == b">+1.0000\r"

    port.signals[0] = VOLTS
    assert answer(port) == SAID


def test_each_module_needs_its_signals() -> None:
    with pytest.raises(InvalidValueError, match="1, one for each module"):
        VirtualPort([power_on(factory(Model.I_7018), now=0.0)], [])


def test_a_data_logger_records_the_signals_of_their_time() -> None:
    eeprom = factory(Model.M_7017mC_16)
    log = evolve(eeprom.log, period=(0, 0, 10), command=LogCommand.CONTINUOUS).planned(0.0)
    signals = Sources((Ramp(0, 20, 60, Unit.MILLIAMPERE),))
    port = VirtualPort([power_on(evolve(eeprom, log=log), now=0.0)], [signals])
    port.sleep(35.0)

    words = [record.words[0] for record in port.modules[0].eeprom.log.records]
    assert words == sorted(set(words))
    assert len(words) == 3


# --- line settings ----------------------------------------------------------------------------------------------------

FAST = LineSettings(BaudRate.BAUD_19200)


def test_another_baud_rate_than_that_of_the_module_gives_garbage() -> None:
    port = dcon_port(line=FAST)

    assert answer(port) == b""
    port.baudrate = 9600
    assert answer(port) == SAID


def test_garbage_of_a_module_is_what_the_host_samples_at_its_own_rate() -> None:
    port = dcon_port(line=LineSettings(BaudRate.BAUD_9600, CharacterFormat.E81))
    port.write(hear_at(READ, Uart(9600), Uart(9600, parity="E")))

    port.timeout = 1.0
    assert port.read(100) != SAID


def test_what_was_written_before_a_change_of_settings_is_sent_with_the_old_ones() -> None:
    port = dcon_port()
    port.write(READ)
    port.baudrate = 19200

    assert port.now() == pytest.approx(len(READ) * CHARACTER)
    port.baudrate = 9600
    port.timeout = 1.0
    assert port.read(len(SAID)) == SAID


@pytest.mark.parametrize("parity", ["E", "O"])
def test_characters_with_parity_take_longer(parity: str) -> None:
    line = LineSettings(BaudRate.BAUD_9600, CharacterFormat[f"{parity}81"])
    eeprom = evolve(factory(Model.I_7018), line_settings=line)
    port = VirtualPort([power_on(eeprom, now=0.0)], [VOLTS], line=line)
    port.write(READ)

    assert port.read(len(SAID)) == SAID
    assert port.now() == pytest.approx((len(READ) + len(SAID)) * 11 / 9600)


def test_an_undefined_baud_rate_is_refused() -> None:
    with pytest.raises(InvalidValueError, match="baud_rate"):
        dcon_port(line=LineSettings(0x3F))


def test_a_time_between_bytes_is_refused() -> None:
    with pytest.raises(InvalidValueError, match="inter_byte_timeout"):
        dcon_port().inter_byte_timeout = 0.1


# --- power ------------------------------------------------------------------------------------------------------------


def test_a_power_cycle_keeps_the_settings_and_loses_what_is_on_the_line() -> None:
    port = dcon_port()
    answer(port, b"~01O7018A\r")
    port.write(READ)
    port.sleep(len(READ) * CHARACTER)
    port.power_cycle()

    assert answer(port, b"$01M\r") == b"!017018A\r"


def test_the_init_switch_counts_at_the_next_power_on() -> None:
    port = VirtualPort([module(Model.I_7018, address=0x05)])
    port.init_switches[0] = True

    assert answer(port, b"$002\r") == b""
    port.power_cycle()
    assert answer(port, b"$002\r")[:3] == b"!05"


def test_a_module_of_a_simulator_can_have_power_with_the_init_switch_set() -> None:
    port = VirtualPort([module(Model.I_7018, address=0x05, init_switch=True)])

    assert answer(port, b"$002\r")[:3] == b"!05"


# --- faults -----------------------------------------------------------------------------------------------------------


def test_an_echo_arrives_while_the_bytes_are_sent() -> None:
    port = dcon_port(faults=Faults(echo=True))
    port.timeout = 1.0
    port.write(READ)

    assert port.read(len(READ)) == READ
    assert port.now() == pytest.approx(len(READ) * CHARACTER)
    assert port.read(len(SAID)) == SAID


def test_lumps_arrive_every_16_milliseconds() -> None:
    port = dcon_port(faults=Faults(lumps=True))
    port.timeout = 1.0
    port.write(b"#01\r")
    first = port.read(1) + port.read(port.in_waiting)

    assert len(first) == 15
    assert port.now() == pytest.approx(4 * CHARACTER + 0.016)


def test_a_late_response_is_late() -> None:
    port = dcon_port(faults=Faults(late=1.0, late_by=0.5))
    port.write(READ)

    assert port.read(len(SAID)) == SAID
    assert port.now() == pytest.approx((len(READ) + len(SAID)) * CHARACTER + 0.5)


def test_a_late_response_does_not_delay_another() -> None:
    port = dcon_port(faults=Faults(late=1.0, late_by=0.5))
    port.write(READ)
    port.sleep(0.1)
    port.faults = Faults()

    assert answer(port, b"$01M\r", 0.3) == b"!017018\r"
    assert port.read(len(SAID)) == SAID


@pytest.mark.parametrize("faults", [Faults(drop=1.0), Faults(flip=1.0)], ids=["drop", "flip"])
def test_a_damaged_command_gets_no_answer(faults: Faults) -> None:
    assert answer(dcon_port(faults=faults)) == b""


def test_faults_can_be_those_of_one_address_or_direction() -> None:
    modules = [power_on(evolve(factory(Model.I_7018), address=address), now=0.0) for address in (1, 2)]
    port = VirtualPort(modules, [VOLTS, VOLTS], Faults().at(0x02, silent=1.0))
    assert (answer(port), answer(port, b"#020\r")) == (SAID, b"")

    port.faults = Faults().at(Way.TO, drop=1.0)
    assert answer(port) == b""

    port.faults = Faults().at(Way.FROM, refuse=1.0)
    assert answer(port) == b"?01\r"


def test_an_earlier_response_can_come_again() -> None:
    port = dcon_port()
    assert answer(port, b"$01M\r") == b"!017018\r"
    port.faults = Faults(replay=1.0)

    assert answer(port) == b"!017018\r"


def test_the_same_seed_repeats_the_faults_and_another_does_not() -> None:
    def heard(seed: int) -> list[bytes]:
        port = dcon_port(faults=Faults(drop=0.02, flip=0.02, noise=0.2, late=0.2), seed=seed)
        return [answer(port) for _ in range(50)]

    assert heard(7) == heard(7) != heard(8)


# --- the rest of a serial port ----------------------------------------------------------------------------------------


def test_a_reset_of_the_input_drops_what_has_arrived() -> None:
    port = dcon_port()
    port.write(READ)
    port.sleep((len(READ) + 3) * CHARACTER + 1e-6)
    port.reset_input_buffer()
    port.timeout = 1.0

    assert port.read(100) == SAID[3:]


def test_a_reset_of_the_output_drops_what_is_not_sent() -> None:
    port = dcon_port()
    port.write(READ)
    port.sleep(2 * CHARACTER + 1e-6)
    assert port.out_waiting == 2
    port.reset_output_buffer()

    assert port.out_waiting == 0
    assert answer(port, b"0\r") == SAID


def test_a_reset_of_an_empty_output_does_nothing() -> None:
    port = dcon_port()
    port.reset_output_buffer()

    assert port.out_waiting == 0
    assert answer(port) == SAID


def test_a_flush_waits_until_everything_is_sent() -> None:
    port = dcon_port()
    port.flush()
    assert port.now() == 0.0
    port.write(READ)
    port.flush()

    assert port.now() == pytest.approx(len(READ) * CHARACTER)


def test_a_full_buffer_delays_a_write() -> None:
    port = dcon_port()
    written = port.write(bytes(3 * BUFFER))

    assert written == 3 * BUFFER
    assert port.now() == pytest.approx(2 * BUFFER * CHARACTER)


def test_bytes_beyond_the_input_buffer_are_lost() -> None:
    port = dcon_port(faults=Faults(echo=True))
    port.write(bytes(2 * BUFFER))
    port.sleep(100.0)

    assert port.in_waiting == BUFFER


def test_a_closed_port_raises_as_one_of_pyserial_does_and_can_be_opened_again() -> None:
    with dcon_port() as port:
        pass
    uses: list[Callable[[], object]] = [
        port.read, port.flush, port.reset_input_buffer, port.reset_output_buffer,
        lambda: port.write(READ), lambda: port.in_waiting, lambda: port.out_waiting,
    ]  # fmt: skip
    for use in uses:
        with pytest.raises(serial.PortNotOpenError):
            use()

    port.open()
    assert answer(port) == SAID
    with pytest.raises(serial.SerialException, match="already open"):
        port.open()


def test_rts_and_dtr_and_break_have_no_effect() -> None:
    port = dcon_port()
    port.rts = port.dtr = port.break_condition = False

    assert answer(port) == SAID


def test_the_types_of_channels_decide_what_is_read() -> None:
    eeprom = evolve(factory(Model.M_7019R), type_codes=(TypeCode.K,) * 8, protocol=Protocol.DCON)
    port = VirtualPort([power_on(eeprom, now=0.0)], [Signals.of(Unit.CELSIUS, 25.1)])

    assert answer(port) == b">+0025.1\r"
    assert answer(port, b"#01\r").startswith(b">+0025.1")
