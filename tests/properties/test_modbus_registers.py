"""What holds for every row of the address maps, and for every plan to read some."""

from math import inf, nan
from typing import Any

import pytest
from attrs import evolve
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from i7000 import DecodeError, EncodeError, Fault, InvalidValueError, Model, Profile, Protocol, modbus
from i7000.modbus import Access, Area, Kind, Plan, Register, RegisterMap
from i7000.strategies import profiles
from i7000.strategies.modbus import plans, register_items, register_maps, register_values, registers

pytestmark = pytest.mark.no_cover

MODELS = [model for model in Model if Protocol.MODBUS_RTU in model.protocols]
FEW = settings(max_examples=settings().max_examples // 6)
"""For what is tried with every model."""

each_model = pytest.mark.parametrize("model", MODELS, ids=lambda model: model.value)

Places = set[tuple[Area, int]]


def items_of(request: Any) -> tuple[int, ...]:
    """What a write leaves in the registers or coils."""
    if isinstance(request, modbus.WriteMultipleRegisters):
        return request.values
    return (int(request.value),)


def rows_of(found: RegisterMap, *, but: Access) -> list[Register]:
    return [row for row in found if row.access is not but]


def decoded(found: RegisterMap, key: str | int, items: Any, **how: Any) -> Any:
    try:
        return found.decode(key, items, **how)
    except DecodeError as error:
        return error


# --- values -----------------------------------------------------------------------------------------------------------


@each_model
@FEW
@given(st.data())
def test_what_is_written_is_read_as_it_was(model: Model, data: st.DataObject) -> None:
    profile = data.draw(profiles(model, known_types=True))
    found = RegisterMap(profile)
    big_endian = data.draw(st.booleans())

    for row in rows_of(found, but=Access.READ):
        value = data.draw(register_values(row, profile))
        request = found.write(0x01, row.name, value, big_endian=big_endian)
        items = items_of(request)

        assert request == modbus.decode_request(modbus.encode(request, profile), profile)
        assert value == found.decode(row.name, items, big_endian=big_endian)
        assert type(value) is type(found.decode(row.name, items, big_endian=big_endian))


@each_model
@FEW
@given(st.data())
def test_what_is_read_within_its_range_is_written_as_it_was(model: Model, data: st.DataObject) -> None:
    profile = data.draw(profiles(model, known_types=True))
    found = RegisterMap(profile)

    for row in rows_of(found, but=Access.READ):
        items = tuple(map(int, data.draw(register_items(row, profile))))
        value = decoded(found, row.name, items)
        try:
            request = found.write(0x01, row.name, value)
        except EncodeError as error:
            assert error.field in (row.name, "baud_rate", "character_format")  # noqa: PT017 - many are in no range
        else:
            assert items == items_of(request)


@given(st.data())
def test_some_channels_are_written_and_read_like_all(data: st.DataObject) -> None:
    found = data.draw(register_maps())
    several = [row for row in found if row.count > 1 and row.kind not in (Kind.UINT32, Kind.RECORD)]
    row = data.draw(st.sampled_from(several))
    items = data.draw(register_items(row, found.profile))
    first = data.draw(st.integers(0, len(items) - 1))
    channels = range(first, data.draw(st.integers(first + 1, len(items))))

    values: Any = found.decode(row.name, items)
    request = found.read(0x01, row.number, channels=channels)

    assert values[first : channels.stop] == found.decode(row.number, items[first : channels.stop], channels=channels)
    assert values[first] == found.decode(f"{row.area.value}{row.address + first + 1:04d}", items[first : first + 1])
    assert (row.address + first, len(channels)) == (request.start, request.count)


@given(register_maps() | profiles(Model.M_7017mC_16, known_types=True).map(RegisterMap), st.data())
def test_readings_and_records_are_decoded_as_the_module_sent_them(found: RegisterMap, data: st.DataObject) -> None:
    told = [row for row in found if row.kind in (Kind.READING, Kind.RECORD)]
    row = data.draw(st.sampled_from(told))
    items = data.draw(register_items(row, found.profile))
    big_endian = data.draw(st.booleans())

    value: Any = found.decode(row.name, items, big_endian=big_endian)

    if row.kind is Kind.READING:
        assert modbus.readings(items, found.profile) == value
        return
    for at, record in enumerate(value):
        *words, first, second = items[18 * at : 18 * at + 18]
        assert modbus.readings(words, found.profile) == record.readings
        assert (first << 16 | second if big_endian else second << 16 | first) == record.time


# --- totality ---------------------------------------------------------------------------------------------------------


CHOICES = ("cjc_update",)
"""The rows of which only some words mean anything."""


@given(st.data())
def test_any_items_that_a_module_may_send_are_a_value_or_a_decode_error(data: st.DataObject) -> None:
    found = RegisterMap(data.draw(profiles(*MODELS)))
    row = data.draw(registers(found.profile))
    items = data.draw(register_items(row, found.profile))

    value = decoded(found, row.name, items)

    if isinstance(value, DecodeError):
        unknown_type = row.kind in (Kind.READING, Kind.RECORD) and not found.profile.type_codes
        assert unknown_type or row.name in CHOICES
        assert value.section


NO_WORDS = st.integers(max_value=-1) | st.integers(min_value=0x10000) | st.just(10**5000) | st.floats() | st.none()


@given(register_maps(), NO_WORDS, st.data())
def test_what_is_no_item_is_refused(found: RegisterMap, item: Any, data: st.DataObject) -> None:
    row = data.draw(registers(found.profile))
    items = [*data.draw(register_items(row, found.profile))[1:], item]

    with pytest.raises(DecodeError) as caught:
        found.decode(row.name, items)

    assert caught.value.fault is Fault.NUMBER
    assert caught.value.field == row.name


@given(register_maps(), st.lists(st.integers(0, 0xFFFF), max_size=20), st.data())
def test_another_number_of_items_than_the_row_has_is_refused(
    found: RegisterMap, items: list[int], data: st.DataObject
) -> None:
    row = data.draw(registers(found.profile, readable=True))
    assume(len(items) != found.read(0x01, row.name).count)

    with pytest.raises(DecodeError) as caught:
        found.decode(row.name, items)

    assert caught.value.fault is Fault.COUNT


ANY_KEY = st.text() | st.integers() | st.integers(0, 1000) | st.integers(0, 49999).map("{:05d}".format)
ANY_VALUE = st.one_of(
    st.none(), st.booleans(), st.integers(), st.integers(min_value=1 << 64), st.floats(), st.text(), st.binary(),
    st.lists(st.integers() | st.floats(), max_size=20), st.from_type(type(Protocol.DCON)), st.complex_numbers(),
)  # fmt: skip


@pytest.mark.parametrize("value", [nan, inf, -inf, 1e308, 10**400], ids=["nan", "inf", "-inf", "1e308", "huge"])
@FEW
@given(found=register_maps(), data=st.data())
def test_what_is_no_number_of_a_size_that_a_row_has_is_refused(
    value: float, found: RegisterMap, data: st.DataObject
) -> None:
    row = data.draw(registers(found.profile, writable=True))

    with pytest.raises(EncodeError):
        found.write(0x01, row.number, value)


@given(register_maps(), ANY_VALUE, st.data())
def test_any_value_is_written_or_refused(found: RegisterMap, value: Any, data: st.DataObject) -> None:
    row = data.draw(registers(found.profile))
    try:
        request = found.write(0x01, row.name, value)
    except EncodeError as error:
        assert error.field in (row.name, "register", "baud_rate", "character_format")  # noqa: PT017 - most are refused
    else:
        assert row.access is not Access.READ
        assert isinstance(request, modbus.Request)


@given(register_maps() | profiles().map(RegisterMap), ANY_KEY, st.none() | st.sampled_from(Area))
def test_any_key_finds_a_row_that_it_means_or_is_refused(found: RegisterMap, key: str | int, area: Area | None) -> None:
    try:
        row = found.find(key, area)
    except EncodeError as error:
        assert error.field == "register"  # noqa: PT017 - some keys are found
    else:
        assert row in found.rows


@given(st.data())
def test_a_row_is_found_by_each_of_its_numbers_and_addresses(data: st.DataObject) -> None:
    found = data.draw(register_maps())
    row = data.draw(st.sampled_from(found.rows))
    at = data.draw(st.integers(0, row.count - 1))
    number = f"{row.area.value}{row.address + at + 1:04d}"

    assert row == found.find(number)
    assert row == found.find(row.address + at, row.area)
    assert row == found.find(row.name, row.area)
    assert row.area.value == 0 or row == found.find(int(number))


# --- plans ------------------------------------------------------------------------------------------------------------


def places(request: Any) -> Places:
    area = {
        modbus.ReadCoils: Area.COIL,
        modbus.ReadDiscreteInputs: Area.DISCRETE_INPUT,
        modbus.ReadInputRegisters: Area.INPUT_REGISTER,
        modbus.ReadHoldingRegisters: Area.HOLDING_REGISTER,
    }[type(request)]
    return {(area, request.start + at) for at in range(request.count)}


@given(plans())
def test_a_plan_covers_its_rows_and_nothing_else_and_nothing_twice(plan: Plan) -> None:
    planned = [place for request in plan.requests for place in places(request)]
    single = [place for *_, key in plan.places for place in places(plan.registers.read(0x01, key))]

    assert len(planned) == len(set(planned))
    assert set(single) == set(planned)
    assert len(single) == len(planned)


@given(plans())
def test_the_requests_of_a_plan_are_such_as_the_module_takes(plan: Plan) -> None:
    profile = plan.registers.profile

    for request in plan.requests:
        assert request == modbus.decode_request(modbus.encode(request, profile), profile)


@given(plans())
def test_no_two_requests_of_a_plan_are_neighbours(plan: Plan) -> None:
    found = [sorted(places(request), key=lambda place: place[1]) for request in plan.requests]
    ends = {(area, address + 1) for *_, (area, address) in found}

    assert ends.isdisjoint({first for first, *_ in found})


@given(plans(), st.booleans(), st.data())
def test_a_plan_reads_what_single_reads_do(plan: Plan, big_endian: bool, data: st.DataObject) -> None:  # noqa: FBT001
    found = plan.registers
    plan = evolve(plan, big_endian=big_endian)
    memory = {
        (row.area, row.address + at): item
        for row in map(found.find, [key for *_, key in plan.places])
        for at, item in enumerate(data.draw(register_items(row, found.profile)))
    }

    def answer(request: Any) -> Any:
        values = tuple(memory[place] for place in sorted(places(request), key=lambda place: place[1]))
        return request.response(address=request.address, values=values)

    def single(key: str | int) -> Any:
        return decoded(found, key, answer(found.read(0x01, key)).values, big_endian=big_endian)

    alone = {row.name: single(key) for row, *_, key in plan.places}
    responses = [answer(request) for request in plan.requests]
    if any(isinstance(value, DecodeError) for value in alone.values()):
        with pytest.raises(DecodeError):
            plan.decode(responses)
    else:
        assert alone == plan.decode(responses)


@given(plans())
def test_an_exception_is_the_value_of_all_that_it_refused(plan: Plan) -> None:
    refusals = [
        modbus.ExceptionResponse(request.address, request.function, at) for at, request in enumerate(plan.requests)
    ]

    assert {row.name: refusals[at] for row, at, *_ in plan.places} == plan.decode(refusals)


@given(plans(), st.integers(0, 8))
def test_another_number_of_responses_than_requests_is_refused(plan: Plan, count: int) -> None:
    assume(count != len(plan.requests))

    with pytest.raises(InvalidValueError) as caught:
        plan.decode([modbus.Coils(0x01, (True,))] * count)

    assert caught.value.field == "responses"


# --- maps -------------------------------------------------------------------------------------------------------------


@given(profiles(*MODELS))
def test_no_two_rows_are_at_the_same_place_and_all_are_in_order(profile: Profile) -> None:
    rows = RegisterMap(profile).rows
    taken = [(row.area.value, row.address + at) for row in rows for at in range(row.count)]

    assert taken == sorted(set(taken))
    assert len(rows) == len({(row.name, row.area) for row in rows})
