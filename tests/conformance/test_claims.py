"""The statement of a module: what it holds, and that a module is held against it both ways."""

import json
from typing import Any

import pytest
from attrs import evolve

from i7000 import InvalidValueError, Model, Protocol, modbus, spec
from i7000.conformance.claims import Claims
from i7000.conformance.hazard import DEFAULT_ALLOWED
from i7000.conformance.oracle import eeprom_of
from i7000.conformance.run import CheckResult, Options, Run, plan
from i7000.conformance.state import stated
from i7000.conformance.verdict import SkipReason, Verdict
from i7000.device import Eeprom, factory, power_on
from i7000.host.procedures import Snapshot, snapshot
from i7000.link import Line, VirtualPort
from i7000.link.guarded import GuardedPort
from i7000.profile import Profile

MODELS = ((Model.I_7018, Protocol.DCON), (Model.M_7019R, Protocol.DCON), (Model.M_7017, Protocol.MODBUS_RTU))


def memory(model: Model, protocol: Protocol) -> Eeprom:
    return evolve(factory(model), protocol=protocol)


def line_of(eeprom: Eeprom) -> Line:
    return Line(GuardedPort(VirtualPort([power_on(eeprom, now=0.0)]), DEFAULT_ALLOWED))


def taken(line: Line, eeprom: Eeprom) -> Snapshot:
    return line.run(snapshot(1, Profile(eeprom.model, type_codes=()), eeprom.protocol))


def claims_of(eeprom: Eeprom) -> Claims:
    with line_of(eeprom) as line:
        known = spec.statements().values()
        return line.run(stated(taken(line, eeprom), known, line.line, checksum=False))


def held(eeprom: Eeprom, claims: Claims, *groups: str) -> dict[str, CheckResult]:
    """What becomes of the checks of some groups on a module with these claims."""
    with line_of(eeprom) as line:
        settings = eeprom_of(taken(line, eeprom))
        chosen = [it for it in spec.statements().values() if it.group in ("link", *groups)]
        profile = power_on(settings, now=0.0).profile
        planned = plan(chosen, profile, eeprom.protocol, DEFAULT_ALLOWED, claims)
        run = Run(planned, settings, Options(allowed=DEFAULT_ALLOWED, claims=claims), line=line.line, checksum=False)
        line.run(run.procedure())
    return {result.id: result for result in run.results}


@pytest.mark.parametrize(("model", "protocol"), MODELS)
def test_a_module_is_what_its_own_statement_claims(model: Model, protocol: Protocol) -> None:
    eeprom = memory(model, protocol)
    claims = claims_of(eeprom)

    found = held(eeprom, Claims.from_json(claims.to_json()), "statement")

    assert {it.verdict for it in found.values()} == {Verdict.PASS}
    assert (claims.model, claims.firmware, claims.protocol) == (model.value, "B4.5", protocol)
    assert claims.types == tuple(code.name for code in eeprom.type_codes)


def test_a_statement_has_the_commands_that_the_module_answers_and_no_others() -> None:
    claims = claims_of(memory(Model.I_7018, Protocol.DCON))

    assert "2.10" in claims.commands
    assert "2.16" not in claims.commands  # the types of single channels are those of other models
    assert dict(claims.readings)["frame/dcon/lower-case"] == "a command in lower case is not answered"


def test_a_statement_has_the_functions_and_registers_that_the_module_answers() -> None:
    claims = claims_of(memory(Model.M_7019R, Protocol.MODBUS_RTU))

    assert {"46/00", "46/20", "46/2B"} <= set(claims.functions)
    assert {"coil/00257", "holding_register/40489", "input_register/30001"} <= set(claims.registers)
    assert (claims.commands, "holding_register/40487" in claims.registers) == ((), False)


def test_what_is_claimed_but_not_there_fails_and_so_does_what_is_there_but_not_claimed() -> None:
    eeprom = memory(Model.M_7017, Protocol.MODBUS_RTU)

    found = held(eeprom, claims_of(memory(Model.M_7019R, Protocol.MODBUS_RTU)), "statement")

    assert found["statement/is-there"].verdict is Verdict.FAIL
    assert "which is refused" in found["statement/is-there"].text
    assert modbus.unseal(found["statement/is-there"].received)[1] & 0x80
    assert found["statement/is-all"].verdict is Verdict.FAIL
    assert "which the statement does not claim" in found["statement/is-all"].text


@pytest.mark.parametrize(
    ("changes", "check", "text"),
    [
        ({"commands": ("2.99",)}, "statement/is-there", "the statement claims 2.99, which no module has"),
        ({"readings": (("frame/none", ""),)}, "statement/readings", "names frame/none, which is not a check"),
        ({"readings": (("frame/dcon/doubled", "silence"),)}, "statement/readings", "an unfinished one is answered"),
        ({"readings": (("link/alive", "it sings"),)}, "statement/readings", "link/alive: nothing to note"),
    ],
)
def test_a_claim_that_does_not_hold_fails(changes: dict[str, Any], check: str, text: str) -> None:
    eeprom = memory(Model.I_7018, Protocol.DCON)

    found = held(eeprom, evolve(claims_of(eeprom), **changes), "statement")

    assert found[check].verdict is Verdict.FAIL
    assert text in found[check].text


@pytest.mark.parametrize(
    ("changes", "check", "sent", "received"),
    [
        ({"commands": ("2.16",)}, "statement/is-there", b"$018C0\r", b""),
        ({"commands": ("2.3",)}, "statement/is-all", b"#010\r", b">"),
        ({"readings": (("frame/dcon/lower-case", "silence"),)}, "statement/readings", b"$01M\r", b"!017018\r"),
        ({"readings": (("link/alive", "it sings"),)}, "statement/readings", b"$01M\r", b"!017018\r"),
    ],
)
def test_a_claim_that_does_not_hold_shows_what_the_module_answered(
    changes: dict[str, Any], check: str, sent: bytes, received: bytes
) -> None:
    eeprom = memory(Model.I_7018, Protocol.DCON)

    found = held(eeprom, evolve(claims_of(eeprom), **changes), "statement")[check]

    assert (found.sent, found.received[: len(received) or None]) == (sent, received)


def test_what_is_not_claimed_is_not_checked() -> None:
    eeprom = memory(Model.I_7018, Protocol.DCON)
    claims = claims_of(eeprom)
    fewer = evolve(claims, commands=tuple(section for section in claims.commands if section != "2.17"))

    found = held(eeprom, fewer, "dcon")

    assert found["dcon/2.17/reply"].reason is SkipReason.NOT_APPLICABLE
    assert found["dcon/2.17/reply"].text == "the statement of the module does not claim it"
    assert found["dcon/2.10/reply"].verdict is Verdict.PASS


def test_functions_that_are_not_claimed_are_not_checked() -> None:
    eeprom = memory(Model.M_7017, Protocol.MODBUS_RTU)
    claims = claims_of(eeprom)
    fewer = evolve(claims, functions=tuple(code for code in claims.functions if code != "46/20"))

    found = held(eeprom, fewer, "rtu")

    assert found["rtu/46/20/reply"].reason is SkipReason.NOT_APPLICABLE
    assert found["rtu/46/00/reply"].verdict is Verdict.PASS


def test_registers_that_are_not_claimed_are_not_checked() -> None:
    eeprom = memory(Model.M_7017, Protocol.MODBUS_RTU)
    claims = claims_of(eeprom)
    fewer = evolve(claims, registers=tuple(name for name in claims.registers if name != "holding_register/40489"))

    found = held(eeprom, fewer, "map")

    assert found["map/holding_register/host_watchdog_timeout"].reason is SkipReason.NOT_APPLICABLE
    assert found["map/holding_register/line_settings"].verdict is Verdict.PASS


@pytest.mark.parametrize(
    ("function", "area"),
    [
        ("ReadCoils", "coil"),
        ("ReadDiscreteInputs", "discrete_input"),
        ("ReadHoldingRegisters", "holding_register"),
        ("ReadInputRegisters", "input_register"),
    ],
)
def test_a_function_is_claimed_if_a_register_of_its_area_is(function: str, area: str) -> None:
    claims = claims_of(memory(Model.M_7017, Protocol.MODBUS_RTU))
    fewer = evolve(claims, registers=tuple(name for name in claims.registers if not name.startswith(f"{area}/")))
    about = [it for it in spec.statements().values() if it.function == function]

    assert about
    assert all(claims.covers(it) for it in about)
    assert not any(fewer.covers(it) for it in about)


def test_what_only_writes_is_no_part_of_a_statement() -> None:
    claims = Claims("M-7017", None, None, Protocol.MODBUS_RTU, functions=("46/00",))
    writes = [it for it in spec.statements().values() if it.function == "WriteSingleCoil" and it.register is None]

    assert writes
    assert all(map(claims.covers, writes))


def test_without_a_statement_its_group_is_left_out() -> None:
    state = power_on(factory(Model.I_7018), now=0.0)

    planned = plan(spec.statements().values(), state.profile, Protocol.DCON, DEFAULT_ALLOWED)

    assert not [it for it in planned if it.statement.group == "statement"]


WHOLE = Claims("I-7018", "B4.5", "7018", Protocol.DCON, commands=("2.10",), readings=(("a", "b"),))


@pytest.mark.parametrize(("protocol", "word"), [(Protocol.DCON, "dcon"), (Protocol.MODBUS_RTU, "rtu")])
def test_a_statement_is_read_as_it_was_written(protocol: Protocol, word: str) -> None:
    written = evolve(WHOLE, protocol=protocol)

    assert json.loads(written.to_json())["protocol"] == word
    assert Claims.from_json(written.to_json()) == written


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("{", "Expecting property name"),
        ("[]", "it is not an object"),
        ("{}", "'commands' is missing"),
        (WHOLE.to_json().replace('"types"', '"kinds"'), "'kinds' is unknown"),
        (WHOLE.to_json().replace('"schema_version": 1', '"schema_version": 2'), "schema_version is 2, not 1"),
        (WHOLE.to_json().replace('"dcon"', '"x"'), "protocol is 'x', not dcon or rtu"),
        (WHOLE.to_json().replace('"dcon"', '"modbus_rtu"'), "protocol is 'modbus_rtu', not dcon or rtu"),
        (WHOLE.to_json().replace('"dcon"', '["dcon"]'), "protocol is ['dcon'], not dcon or rtu"),
        (WHOLE.to_json().replace('"types": []', '"types": [1]'), "types is not a list of texts"),
        (WHOLE.to_json().replace('"b"', "1"), "readings is not an object of texts"),
        (WHOLE.to_json().replace('"I-7018"', "1"), "model is not a text"),
        (WHOLE.to_json().replace('"7018"', "1"), "name is not a text or null"),
        (evolve(WHOLE, commands=()).to_json(), "it claims no command, no function and no register"),
    ],
)
def test_text_that_is_not_a_statement_is_refused(text: str, reason: str) -> None:
    with pytest.raises(InvalidValueError, match="this is not a statement") as refusal:
        Claims.from_json(text)

    assert reason in str(refusal.value)
