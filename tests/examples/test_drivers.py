"""The example programs against a simulated bus on a pseudo-terminal, and in virtual time."""

import runpy
import sys
from collections.abc import Callable

import pytest

from i7000 import Fault, Noise, dcon, modbus
from i7000.conformance import believed
from i7000.examples import async_driver, sync_driver
from i7000.examples.task import Task, read_task
from i7000.host import Late, Rejected, TimedOut
from i7000.host.procedures import Result
from i7000.link import VirtualPort
from i7000.simulator.faults import Faults
from i7000.simulator.pseudo_terminal import open_pty
from tests.link.scene import FAST, MODULES, PROFILE, VOLTS
from tests.simulator.running import running

either = pytest.mark.parametrize("main", [sync_driver.main, async_driver.main])

PRINTED = """\
0 25.1 degC ok
1 26.4 degC ok
2 None degC disabled
3 None degC over_range
4 20.0 degC ok
5 20.1 degC ok
6 20.2 degC ok
7 20.3 degC ok
"""
DECLINED = (
    "Declined(command=ReadInputRegisters(address=0x03, start=0, count=10), "
    "response=ExceptionResponse(address=0x03, function=4, exception_code=3))\n"
)


@either
def test_the_programs_print_readings_or_what_else_came_of_it(
    main: Callable[[list[str]], int], capsys: pytest.CaptureFixture[str]
) -> None:
    with running(open_pty, *MODULES) as here:
        read = main([here.place, "--model", "M-7019R", "--address", "01", "--type", "K", "--checksum"])
        printed = capsys.readouterr().out
        declined = main([here.place, "--model", "M-7019Z", "--address", "03", "--modbus", "--baud", "115200"])

    assert (read, printed) == (0, PRINTED)
    assert (declined, capsys.readouterr().out) == (1, DECLINED)


def test_readings_of_another_type_than_the_given_one_are_not_printed_as_values(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with running(open_pty, *MODULES) as here:
        code = sync_driver.main([here.place, "--model", "M-7019R", "--address", "01", "--type", "V_10", "--checksum"])

    assert code == 1
    assert "number in the value of channel 0 at byte 0 of +0025.1;" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["i7000.examples.sync_driver", "i7000.examples.async_driver"])
def test_the_programs_can_be_run(
    name: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with running(open_pty, *MODULES, faults=Faults(echo=True)) as here:
        arguments = [here.place, "--model", "M-7018", "--address", "04", "--modbus", "--echo"]
        monkeypatch.setattr(sys, "argv", [name, *arguments])
        monkeypatch.delitem(sys.modules, name)
        with pytest.raises(SystemExit) as ended:
            runpy.run_module(name, run_name="__main__")

    columns = zip(*(line.split() for line in capsys.readouterr().out.splitlines()), strict=True)
    channels, values, units, statuses = map(list, columns)
    assert ended.value.code == 0
    assert (channels, units, statuses) == (list("01234567"), ["V"] * 8, ["ok"] * 8)
    assert pytest.approx(VOLTS[::-1], abs=1e-4) == [float(value) for value in values]


@either
def test_json_lines_are_what_provoke_reads(
    main: Callable[[list[str]], int], capsys: pytest.CaptureFixture[str]
) -> None:
    with running(open_pty, *MODULES) as here:
        arguments = [here.place, "--model", "M-7019R", "--checksum", "--json", "--polls", "2"]
        read = main([*arguments, "--address", "01", "--type", "K"])
        printed = capsys.readouterr().out.splitlines()
        codes = (main([*arguments, "--address", "01", "--type", "V_10"]), main([*arguments, "--address", "03"]))

    assert (read, codes) == (0, (1, 1))
    assert [believed.read(line) for line in printed[:4]] == [
        believed.Believed(1, 0, 25.1, "ok", "degC"),
        believed.Believed(1, 1, 26.4, "ok", "degC"),
        believed.Believed(1, 2, None, "disabled", "degC"),
        believed.Believed(1, 3, None, "over_range", "degC"),
    ]
    assert len(printed) == 16
    said = [believed.read(line) for line in capsys.readouterr().out.splitlines()]
    error, missing = believed.Believed(1, None, None, "error"), believed.Believed(3, None, None, "missing")
    assert said == [error, error, missing, missing]


@pytest.mark.parametrize("wrong", [["--polls", "0"], ["--type", "Q"], ["--baud", "9601"], ["--model", "I-7020"]])
def test_wrong_arguments_end_a_program_with_what_is_wrong(wrong: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        sync_driver.main(["/dev/null", "--model", "M-7019R", *wrong])

    assert ended.value.code == 2
    assert wrong[0] in capsys.readouterr().err


@pytest.mark.parametrize(
    ("wrong", "reason"),
    [
        (["--address", "1A"], "argument --address: '1A' has hex digits: write 0x1A or 1Ah\n"),
        (["--address", "300"], "argument --address: an address is 0..255 or 00h..FFh\n"),
        (["--address", "255", "--modbus"], "error: address cannot be 255: 0..247, manual 3.2\n"),
        (["--model", "I-7017", "--type", "K"], "error: type_codes cannot be "),
    ],
)
def test_what_no_module_has_ends_a_program_with_what_is_allowed(
    wrong: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        sync_driver.main(["/dev/null", "--model", "M-7019R", *wrong])

    assert ended.value.code == 2
    assert reason in capsys.readouterr().err


@pytest.mark.parametrize("address", ["10", "0x0A", "0Ah"])
def test_an_address_is_decimal_unless_it_is_marked_as_hex(address: str) -> None:
    task = read_task(["/dev/null", "--model", "M-7019R", "--address", address])

    assert task.commands == (dcon.ReadAnalogInputs(10),)


@either
@pytest.mark.parametrize("port", ["/no/such/port", "/dev/null", "gopher://127.0.0.1"])
def test_a_port_that_cannot_be_opened_ends_a_program_with_the_reason(
    main: Callable[[list[str]], int], port: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main([port, "--model", "M-7019R"])

    assert ended.value.code == 2
    (said,) = capsys.readouterr().err.splitlines()
    assert port in said


@either
@pytest.mark.parametrize("protocol", ["dcon", "rtu"])
def test_the_programs_read_simulated_modules(
    main: Callable[[list[str]], int], protocol: str, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = ["--modbus"] * (protocol == "rtu")

    assert main([f"sim:M-7019R,type=K,protocol={protocol}", "--model", "M-7019R", "--type", "K", *asked]) == 0
    assert [line.split()[2:] for line in capsys.readouterr().out.splitlines()] == [["degC", "ok"]] * 8


@either
def test_a_port_that_disappears_ends_a_program_with_the_reason(
    main: Callable[[list[str]], int], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    class Gone(VirtualPort):
        def read(self, size: int = 1) -> bytes:
            raise OSError(5, f"no {size} bytes")

    monkeypatch.setattr("i7000.link.virtual.VirtualPort", Gone)
    with pytest.raises(SystemExit) as ended:
        main(["sim:M-7019R", "--model", "M-7019R"])

    assert ended.value.code == 2
    assert capsys.readouterr().err == "sim:M-7019R: the port is lost: [Errno 5] no 1 bytes\n"


HINT = "M-7000 modules speak Modbus RTU, unless they were set to DCON: try --modbus\n"


@pytest.mark.parametrize(
    ("others", "text"),
    [
        ((), ""),
        ((Late(b"!01\r"),), ""),
        ((Rejected(b"?01\r", Fault.LENGTH, "57 characters"),), "last rejected frame: ?01\\r: 57 characters\n"),
        ((Rejected(b"", Fault.LENGTH, ""), Noise(b"\xff", Fault.LEADING)), "last rejected frame: \\xFF: leading\n"),
    ],
    ids=["nothing", "late", "a frame", "noise"],
)
def test_what_was_rejected_is_printed_beside_a_timeout(
    others: tuple[Rejected | Late | Noise, ...], text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    command = dcon.ReadAnalogInputs(0x01)
    task = Task("", FAST, PROFILE, (command,), echo=False)

    assert task.show(command, Result(TimedOut(command), others)) == 1
    assert capsys.readouterr().out == f"{TimedOut(command)}\n{text}{HINT}"


def test_a_timeout_by_modbus_has_no_hint_at_modbus(capsys: pytest.CaptureFixture[str]) -> None:
    command = modbus.ReadInputRegisters(0x01, 0, 8)

    assert Task("", FAST, PROFILE, (command,), echo=False).show(command, Result(TimedOut(command))) == 1
    assert capsys.readouterr().out == f"{TimedOut(command)}\n"
