"""``i7000 send``: one command, what came of it, and the commands that ask first."""

import os
import signal

import pytest

from i7000 import BaudRate, LineSettings, Model, Protocol, ReportSettings, TypeCode
from i7000.cli.schema import SCHEMA
from i7000.simulator.faults import Faults
from i7000.simulator.simulator import Simulated
from tests.each import each
from tests.simulator.running import module
from tests.terminal import Run
from tests.workbench import EVERY_MODULE, Bench

I_7018 = module(Model.I_7018, type_codes=(TypeCode.K,) * 8)
M_7019R = module(Model.M_7019R, protocol=Protocol.MODBUS_RTU)
EEPROMS = {"dcon": I_7018, "rtu": M_7019R}


@each("simulated", EVERY_MODULE)
def test_every_module_is_asked_for_its_readings(simulated: Simulated, workbench: Bench) -> None:
    by_dcon = simulated.eeprom.protocol is Protocol.DCON
    command = ("ReadAnalogInputs",) if by_dcon else ("ReadInputRegisters", "start=analog_input")

    told = workbench(simulated)("send", *command, "address=1", "--json")

    assert [record["direction"] for record in told.records] == ["command" if by_dcon else "request", "response"]
    assert all(reading["status"] for reading in told.records[1]["readings"])
    assert len(told.records[1]["readings"]) >= simulated.eeprom.model.channels
    assert told.code == 0


def test_what_is_sent_and_heard_is_decoded_with_times(workbench: Bench) -> None:
    told = workbench(I_7018)("send", "ReadConfiguration", "address=1")

    assert told.out.splitlines() == [
        "1      +0.000 s  -> $012",
        "     ReadConfiguration: module configuration (manual 2.10; E04 E18)",
        "       address         01",
        "2      +0.016 s  <- !010F0600",
        "     Configuration: module configuration (manual 2.10; E04 E18 E81)",
        "       answers         ReadConfiguration, frame 1",
        "       address         01",
        "       type_code       0F, thermocouple K, -270..1372 degC",
        "       line_settings   06, 9600 baud, N81",
        "       report_settings 00, engineering, no checksum, normal mode, 60 Hz rejected",
    ]
    assert told.code == 0


def test_registers_are_written_by_name_and_in_units(workbench: Bench) -> None:
    bench = workbench(M_7019R)

    told = bench("send", "WriteSingleRegister", "address=1", "register=host_watchdog_timeout", "value=2.5")

    assert told.out.count("40489           host_watchdog_timeout  2.5 s") == 2
    assert (told.code, bench.eeprom.host_watchdog_timeout) == (0, 25)


def test_function_46h_is_decoded_with_its_response(workbench: Bench) -> None:
    told = workbench(M_7019R)("send", "ReadFirmwareVersion", "address=1", "--json")

    assert [record["name"] for record in told.records] == ["ReadFirmwareVersion", "FirmwareVersion"]
    assert [record["answers"] for record in told.records] == [None, 1]


def test_a_name_of_both_protocols_is_that_of_the_module(workbench: Bench) -> None:
    told = workbench(I_7018)("send", "ReadModuleName", "address=1", "--json")

    assert [record["frame"] for record in told.records] == ["$01M", "!017018"]


def test_the_records_are_those_of_decode(workbench: Bench) -> None:
    told = workbench(I_7018)("send", "ReadAnalogInput", "address=1", "channel=0", "--json")

    assert {*told.records[0]} <= {*_keys()}


def _keys() -> set[str]:
    import json  # noqa: PLC0415

    return set(json.loads(SCHEMA)["properties"])


def test_with_model_nothing_else_is_sent(workbench: Bench) -> None:
    bench = workbench(I_7018)
    sent: list[bytes] = []
    bench.port.before_write = sent.append

    told = bench("send", "ReadAnalogInput", "address=1", "channel=0", "--model", "I-7018", "--type", "K")

    assert (told.code, sent, told.err) == (0, [b"#010\r"], "")


@pytest.mark.parametrize(
    ("simulated", "arguments"),
    [
        (module(Model.I_7018, report_settings=ReportSettings(checksum=True)), ()),
        (module(Model.I_7018, report_settings=ReportSettings(checksum=True)), ("--model", "I-7018", "--checksum")),
        (module(Model.M_7018, line_settings=LineSettings(BaudRate.BAUD_115200)), ("--baud", "115200")),
    ],
)
def test_a_module_is_asked_on_any_line(simulated: Simulated, arguments: tuple[str, ...], workbench: Bench) -> None:
    told = workbench(simulated)("send", "ReadChannelMask", "address=1", *arguments)

    assert (told.code, "ChannelMask: " in told.out) == (0, True)


def test_a_module_in_init_mode_is_asked_at_address_0(workbench: Bench) -> None:
    told = workbench(module(Model.I_7018, init_switch=True))("send", "ReadConfiguration", "address=0")

    assert (told.code, "$002" in told.out) == (0, True)


def test_an_echo_is_dropped(workbench: Bench) -> None:
    bench = workbench(I_7018)
    bench.port.faults = Faults(echo=True)

    told = bench("send", "ReadConfiguration", "address=1", "--echo", "--model", "I-7018")

    assert (told.code, told.out.count("$012")) == (0, 2)


# --- what can come of it ----------------------------------------------------------------------------------------------


def test_a_refusal_is_reported(workbench: Bench) -> None:
    told = workbench(I_7018)("send", "CalibrateSpan", "address=1", "--yes")

    assert (told.code, told.err.splitlines()[-1]) == (1, "i7000: the module refused it")


def test_an_exception_is_reported(workbench: Bench) -> None:
    bench = workbench(M_7019R)
    bench.port.faults = Faults(refuse=1.0, refuse_code=6)

    told = bench("send", "ReadFirmwareVersion", "address=1", "--model", "M-7019R", "--json")

    assert told.records[-1]["name"] == "ExceptionResponse"
    assert (told.code, told.err) == (1, "i7000: the module refused it\n")


def test_no_answer_is_reported_with_how_often_it_was_sent(workbench: Bench) -> None:
    bench = workbench(I_7018)

    told = bench("send", "ReadConfiguration", "address=2", "--model", "I-7018")
    once = bench("send", "SetModuleName", "address=2", "name=OVEN", "--model", "I-7018", "--retries", "0")

    assert (told.code, told.err, told.out.count("$022")) == (3, "i7000: no answer; it was sent 3 times\n", 3)
    assert once.err == "i7000: no answer; it was sent once; the module may have carried it out\n"


def test_a_module_that_does_not_answer_is_not_sent_the_command(workbench: Bench) -> None:
    bench = workbench(I_7018)
    told = bench("send", "SetModuleName", "address=2", "name=OVEN")

    assert (told.code, told.out) == (3, "")
    assert told.err.startswith("i7000: address 02 does not answer: nothing came")


@pytest.mark.parametrize(
    ("faults", "words"),
    [
        (Faults(noise=1.0), "i7000: noise, or a damaged frame: "),
        (Faults(misaddress=1.0), "i7000: not the response: "),
        (Faults(late=1.0, late_by=0.5), "i7000: late or duplicate, and dropped: "),
    ],
)
def test_what_the_driver_did_not_take_is_noted(faults: Faults, words: str, workbench: Bench) -> None:
    bench = workbench(I_7018)
    bench.port.faults = faults

    told = bench("send", "ReadConfiguration", "address=1", "--model", "I-7018", "--timeout", "0.05")

    assert words in told.err


def test_a_broadcast_needs_no_model_and_no_answer(workbench: Bench) -> None:
    told = workbench(I_7018)("send", "HostOk")

    assert (told.code, told.out.splitlines()[0], told.err) == (0, "1      +0.000 s  -> ~**", "")


def test_a_broadcast_with_a_checksum_says_so(workbench: Bench) -> None:
    told = workbench(I_7018)("send", "SynchronizedSampling", "--checksum")

    assert (told.code, "#**77" in told.out) == (0, True)


def test_a_broadcast_by_modbus_needs_a_model_and_consent(workbench: Bench) -> None:
    bench = workbench(M_7019R)
    command = ("send", "WriteSingleRegister", "address=0", "register=488", "value=2.5")

    told, asked, sent = bench(*command), bench(*command, "--model", "M-7019R"), None
    sent = bench(*command, "--model", "M-7019R", "--yes")

    assert "address 0 is a broadcast to all modules: give --model" in told.err
    assert "WriteSingleRegister changes a setting of every module on the line; " in asked.err
    assert (told.code, asked.code, sent.code, bench.eeprom.host_watchdog_timeout) == (2, 2, 0, 25)


# --- commands that ask ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("protocol", "command", "words"),
    [
        ("dcon", ("CalibrateSpan", "address=1"), "CalibrateSpan can change the calibration of the module"),
        ("rtu", ("SetModuleAddress", "address=1", "new_address=5"), "SetModuleAddress could lose the module"),
        ("rtu", ("WriteSingleCoil", "address=1", "coil=load_factory_calibration", "value=true"),
         "WriteSingleCoil can change the calibration of the module"),
        ("rtu", ("WriteMultipleRegisters", "address=1", "start=484", "values=5"),
         "WriteMultipleRegisters could lose the module"),
    ],
)  # fmt: skip
def test_a_dangerous_command_is_not_sent_without_consent(
    protocol: str, command: tuple[str, ...], words: str, workbench: Bench
) -> None:
    bench = workbench(EEPROMS[protocol])

    told = bench("send", *command)

    assert told.err.splitlines()[-1].startswith(f"i7000: {words}")
    assert told.err.endswith("; there is no terminal to ask you at: give --yes\n")
    assert (told.code, told.out, bench.eeprom) == (2, "", EEPROMS[protocol].eeprom)


@pytest.mark.usefixtures("answered")
@pytest.mark.parametrize(("answer", "address"), [(b"y\n", 5), (b"n\n", 1)])
def test_a_dangerous_command_is_sent_if_you_say_so(answer: bytes, address: int, workbench: Bench) -> None:
    bench = workbench(M_7019R)

    told = bench("send", "SetModuleAddress", "address=1", "new_address=5", stdin=answer)

    assert "can change. Send it? [y/N] " in told.err
    assert ("nothing was sent" in told.err) is (address == 1)
    assert (told.code, bench.eeprom.address) == (0 if address == 5 else 1, address)


# --- wrong usage ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("ReadConf address=1", "there is no command 'ReadConf'; did you mean ReadConfiguration?"),
        ("$022", "there is no command '$022': give its name and fields: ReadConfiguration address=2"),
        ("$018C3", "there is no command '$018C3': give its name and fields: ReadChannelTypeCode address=1 channel=..."),
        ("$x", "there is no command '$x': give its name; i7000 decode shows that of a frame"),
        ("!01050600", "there is no command '!01050600': give its name; i7000 decode shows that of a frame"),
        ("ReadConfiguration --address 2", "--address: the address is a field of the command, address="),
        ("ReadConfiguration --address=2", "--address: the address is a field of the command, address=2"),
        ("ReadConfiguration --adress 2", "Unknown option: --adress."),
        ("Configuration address=1", "there is no command 'Configuration'; did you mean "),
        ("ReadCoils address=1 --protocol dcon", "there is no command 'ReadCoils' with --protocol dcon"),
        ("ReadConfiguration", "ReadConfiguration needs address=..., such as address=1"),
        ("ReadConfiguration address=x", "address=x: 'x' is not a whole number"),
        ("ReadConfiguration address=1 channel=2", "ReadConfiguration has no field 'channel'; its fields are address"),
        ("SetModuleName address=1 name=TOOLONG", "name cannot be "),
        ("ReadOpenWireDetection address=1", "I-7018 with firmware B4.5 has no open wire detection setting: "),
        ("ReadCoils address=1 start=0 count=1", "ReadCoils is not a command of DCON, which the I-7018 speaks"),
        ("ReadCoils address=1 start=0 count=1 --model I-7018", "ReadCoils is not a command of "),
        (
            "SetProtocol address=1 protocol=rtu --model M-7018,protocol=rtu",
            "SetProtocol is not a command of Modbus RTU",
        ),
    ],
)
def test_what_cannot_be_sent_is_refused_and_nothing_is_sent(arguments: str, message: str, workbench: Bench) -> None:
    bench = workbench(I_7018)

    told = bench("send", *arguments.split())

    assert message in told.err.splitlines()[-1]
    assert (told.code, told.out, bench.eeprom) == (2, "", I_7018.eeprom)


# --- Ctrl-C -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "times", "code"),
    [
        (("ReadConfiguration",), 1, 130),
        (("SetModuleName", "name=OVEN"), 1, 130),
        (("ReadConfiguration",), 2, 130),
        (("SetModuleName", "name=OVEN"), 2, 6),
    ],
)
def test_ctrl_c_waits_for_the_outcome_and_twice_breaks_it_off(
    command: tuple[str, ...], times: int, code: int, workbench: Bench
) -> None:
    bench = workbench(I_7018)

    def interrupt() -> None:
        for _ in range(times):
            os.kill(os.getpid(), signal.SIGINT)

    bench.port.before_answer = interrupt
    told = bench("send", *command, "address=1", "--model", "I-7018")

    assert told.code == code
    assert ("the module may have carried it out" in told.err) is (code == 6)
    assert ("<-" in told.out) is (times == 1)


def test_the_help_explains_consent(run: Run) -> None:
    assert "ask you first" in run("send", "--help").out
