"""What a `Meaning` says of itself, for both protocols."""

from i7000 import DataFormat, Firmware, ModbusDataFormat, Model, Protocol, TypeCode, dcon, modbus
from i7000.dissect import Known, Meaning
from i7000.dissect.meaning import errata
from tests.dissect.frames import REQUEST, RESPONSE
from tests.dissect.hearing import last_heard


def meaning_of(*frames: str | bytes, known: Known | None = None) -> Meaning:
    (meaning,) = last_heard(*frames, known=known).meanings
    return meaning


def test_a_response_has_the_section_of_its_command() -> None:
    assert meaning_of("$012", known=Known(Model.I_7018)).section == "2.10"
    assert meaning_of("$012", "!010F0600", known=Known(Model.I_7018)).section == "2.10"


def test_the_protocol_is_that_of_the_message() -> None:
    assert meaning_of("$012").protocol is Protocol.DCON
    assert meaning_of(REQUEST).protocol is Protocol.MODBUS_RTU


def test_fields_have_values_and_words() -> None:
    fields = meaning_of("$012", "!010F0600", known=Known(Model.I_7018)).fields

    assert [(field.name, field.value, field.text) for field in fields][:2] == [
        ("address", 1, "01"),
        ("type_code", 0x0F, "0F, thermocouple K, -270..1372 degC"),
    ]


def test_errata_are_those_of_the_message() -> None:
    assert meaning_of("@01S1", known=Known(Model.I_7017Z)).errata == errata(dcon.SetConnectingMode) == ("E03",)


def test_the_pause_is_the_longest_of_all_models_that_it_can_be() -> None:
    assert meaning_of("#**").pause == 0.002
    assert meaning_of("$012", known=Known(Model.I_7018)).pause == 0.0
    assert meaning_of(REQUEST).pause == 0.0
    assert meaning_of("$010C0", known=Known(Model.I_7019R, firmware=Firmware("B2.6"))).pause == 16.0


def test_by_modbus_the_models_are_those_that_have_the_request() -> None:
    request = modbus.encode(modbus.ReadCjcOffset(1, 0))

    assert meaning_of(request, known=Known(Model.M_7017)).models == ()
    assert set(meaning_of(request).models) == {it.model for it in Known().modbus if it.model.cjc}


def test_a_checksum_is_certain_or_not() -> None:
    assert meaning_of("$012B7", known=Known(Model.I_7018)).checksum is True
    assert meaning_of("$012", known=Known(Model.I_7018)).checksum is False
    assert meaning_of(REQUEST).checksum is None


def test_formats_are_those_that_readings_fit() -> None:
    known = Known(Model.I_7018, types=(TypeCode.K,))

    assert meaning_of("#010", ">+0025.1", known=known).data_formats == (DataFormat.ENGINEERING,)
    assert meaning_of("$012", known=known).data_formats == ()
    assert meaning_of("$01A", ">" + "7FFF" * 8, known=Known(Model.I_7017)).data_formats == ()
    assert meaning_of(REQUEST, RESPONSE, known=Known(Model.M_7018)).data_formats == (ModbusDataFormat.HEX,)


def test_what_readings_rest_on_is_assumed_if_it_is_the_factory_default() -> None:
    assert meaning_of("#010", ">+02.500", known=Known(Model.I_7017)).assumed == ("types", "data_format")
    assert meaning_of(REQUEST, RESPONSE, known=Known(Model.M_7018)).assumed == ("types", "modbus_data_format")
    assert meaning_of("#010", ">+02.500", known=Known(Model.I_7017, types=(TypeCode.V_10,))).assumed == ("data_format",)
