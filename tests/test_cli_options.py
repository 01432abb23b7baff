"""What is said of modules at the terminal: one for all, or one for each address."""

import pytest

from i7000 import DataFormat, Firmware, ModbusDataFormat, Model, TypeCode
from i7000.cli.options import Module
from i7000.dissect import Known
from tests.terminal import Run, refusal

K, V_10 = TypeCode.K, TypeCode.V_10

pytestmark = pytest.mark.usefixtures("plain")


@pytest.mark.parametrize(
    ("module", "known"),
    [
        (Module(), Known()),
        (Module(("I-7018",)), Known(Model.I_7018)),
        (Module(("I-7018@B2.9,type=K",)), Known(Model.I_7018, Firmware("B2.9"), (K,))),
        (Module(("I-7018,type=K,checksum=true,format=hex",)), Known(Model.I_7018, None, (K,), DataFormat.HEX, True)),
        (Module(("I-7018",), types="K"), Known(Model.I_7018, types=(K,))),
        (Module(("M-7019R,type=K/V_10/K/K/K/K/K/K",)), Known(Model.M_7019R, types=(K, V_10, *[K] * 6))),
        (
            Module(("M-7018,modbus_format=engineering",)),
            Known(Model.M_7018, modbus_data_format=ModbusDataFormat.ENGINEERING),
        ),
        (Module(("I-7018,type=K",), types="J"), Known(Model.I_7018, types=(K,))),
        (Module(checksum=True, firmware="B3.7"), Known(firmware=Firmware("B3.7"), checksum=True)),
    ],
)
def test_options_say_what_is_known(module: Module, known: Known) -> None:
    assert module.known("auto") == known
    assert module.knowledge("auto").of(0x05).known == known


def test_modules_are_told_apart_by_their_addresses() -> None:
    knowledge = Module(("1=M-7019R@B3.7,type=K", "0x10=I-7018,checksum=true", "I-7017")).knowledge("auto")

    assert knowledge.of(0x01).known == Known(Model.M_7019R, Firmware("B3.7"), (K,))
    assert knowledge.of(0x10).known == Known(Model.I_7018, checksum=True)
    assert knowledge.of(0x02).known == Known(Model.I_7017)


def test_an_address_can_be_one_of_the_settings() -> None:
    assert list(Module(("I-7018,address=2",)).knowledge("dcon").modules) == [0x02]


@pytest.mark.parametrize(
    ("module", "protocol", "said"),
    [
        (
            Module(("I-7018", "I-7017")),
            "auto",
            "give the addresses of several modules: --model 1=I-7018 --model 2=I-7017",
        ),
        (Module(("256=I-7018",)), "auto", "--model 256=I-7018: an address is 0..255 or 00h..FFh"),
        (Module(("1A=I-7018",)), "auto", "0x1A"),
        (Module(("I-7099",)), "auto", "there is no model 'I-7099'; did you mean "),
        (Module(("I-7018",), types="V_10"), "auto", "--type cannot be V_10"),
        (Module(("I-7018",), firmware="X"), "auto", "--firmware cannot be X"),
        (Module(("I-7018",), single_ended=True), "auto", "--single-ended cannot be given"),
        (Module(("I-7018",)), "rtu", "I-7018 does not speak Modbus: M-7000 series only"),
        (Module(checksum=True), "rtu", "--format and --checksum are for DCON"),
        (Module(modbus_format=ModbusDataFormat.HEX), "dcon", "--modbus-format is for --protocol rtu"),
        (Module(("3=I-7018,address=2",)), "auto", "--model 3=I-7018,address=2: the address is given twice"),
        (Module(("zz=I-7018",)), "auto", "--model zz=I-7018: 'zz' is not a whole number"),
        (Module(types="FOO"), "auto", "--type: 'FOO' is not a type: "),
        (Module(types="K,J"), "auto", "no model accepts it: --type cannot be K,J: 8 type codes"),
        (Module(("I-7018,colour=red",)), "auto", "a module has no setting 'colour'"),
    ],
)
def test_what_no_module_is_is_refused(module: Module, protocol: str, said: str) -> None:
    assert said in refusal(lambda: module.knowledge(protocol))


def test_a_command_about_one_module_takes_no_addresses() -> None:
    assert refusal(lambda: Module(("1=I-7018",)).known()) == "give one --model, without an address"


# --- decode -----------------------------------------------------------------------------------------------------------


def test_the_module_at_an_address_is_read_as_it_was_given(run: Run) -> None:
    result = run("decode", "--model", "1=I-7018,type=K", "--model", "2=I-7017", "#010", ">+0025.1", "#020", ">+02.500")

    assert "25.1 degC" in result.out
    assert "2.5 V" in result.out
    assert result.code == 0


@pytest.mark.parametrize("address", ["2", "0x02", "02h"])
def test_one_module_can_be_shown_alone(run: Run, address: str) -> None:
    result = run("decode", "--address", address, "--json", "$012", "!01050600", "$022", "!02050600", "COM3 opened")

    assert [record["address"] for record in result.records] == [2, 2]
    assert [record["answers"] for record in result.records] == [None, 3]
    assert result.code == 0


def test_what_is_wrong_with_other_modules_does_not_count_then(run: Run) -> None:
    assert run("decode", "--address", "2", "$012", "!0105", "$022", "!02050600").code == 0


def test_frames_and_a_file_are_one_too_many(run: Run) -> None:
    result = run("decode", "$012", "--raw")

    assert (result.code, result.err) == (2, "i7000: give either frames, or --file or --raw\n")


def test_what_contradicts_a_model_that_was_given_is_printed_and_costs_the_exit_code(run: Run) -> None:
    result = run("decode", "--model", "I-7018,type=J", "$012", "!010F0600")

    assert "contradiction   type 0F (K), but type 0E (J) was given\n" in result.out
    assert (result.code, result.err) == (1, "i7000: 1 contradicting what is known: line 2\n")


def test_what_contradicts_the_factory_default_is_a_note_and_costs_nothing(run: Run) -> None:
    result = run("decode", "--model", "I-7017", "#010", ">+0152.4")

    assert "note            not as from the factory: another type\n" in result.out
    assert result.code == 0


def test_two_modules_at_one_address_are_refused() -> None:
    refused = refusal(lambda: Module(("1=I-7018", "1=I-7017")).knowledge("auto"))

    assert refused == "two modules have the address 01: give each its own"
