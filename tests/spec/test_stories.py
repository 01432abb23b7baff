"""What the stories under ``spec/`` promise: that they fit the tables, and that nothing in them contradicts itself."""

from __future__ import annotations

import re
from itertools import chain
from typing import TYPE_CHECKING

import pytest

from tests.crc import crc
from tests.each import each
from tests.spec import lint

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.spec.lint import Record

STORIES = [pytest.param(story, id=story["id"]) for story in lint.stories()]
MODELS = {row["name"]: row for row in lint.rows("models")}
ERRATA = {row["id"]: row for row in lint.rows("errata")}
SETTLED = 2
"""Seconds between power-on, or a change of signals, and the next frame."""


def steps(story: Record, kind: str) -> Iterator[Record]:
    return (step for step in story["steps"] if kind in step)


def messages(story: Record) -> list[Record]:
    return [message for step in steps(story, "send") for message in (step["send"], step["expect"]) if message]


def eyes(wire: bytes) -> str:
    return "".join(chr(byte) if 0x20 <= byte <= 0x7E else f"\\x{byte:02x}" for byte in wire.removesuffix(b"\r"))


def channels(profile: Record) -> int:
    model = MODELS[profile["model"]]
    found: int = model["single_ended_channels"] if profile["single_ended"] else model["channels"]
    return found


def test_ids_are_names_and_unique() -> None:
    ids = [story["id"] for story in lint.stories()]

    assert sorted({identifier for identifier in ids if ids.count(identifier) > 1}) == []
    assert [
        identifier for identifier in ids if re.fullmatch(r"story-(?!\d{1,3}$)[a-z0-9.-]+", identifier) is None
    ] == []


def test_a_step_has_a_line_of_its_own() -> None:
    data = {"stories": [{"id": "b", "steps": [{"at": 0}, {"at": 1.5}]}]}

    assert lint.canonical(data) == (
        '{\n  "stories": [\n    {"id": "b", "steps": [\n      {"at": 0},\n      {"at": 1.5}\n    ]}\n  ]\n}\n'
    )


def test_every_section_with_behaviour_has_a_story() -> None:
    wanted = {row["section"] for table in ("dcon_commands", "module_settings") for row in lint.rows(table)} | {
        "1.11",
        "1.12.1",
        "1.12.2",
        "3.1",
        "3.2",
        "A.1",
        "A.2",
        "A.5",
    }
    wanted |= {path.stem.partition("-")[0] for path in lint.table_files("modbus_registers")}
    told = set(chain.from_iterable(story["sections"] for story in lint.stories()))

    assert wanted - told == set()


@each("story", STORIES)
def test_time_does_not_go_back(story: Record) -> None:
    times = [step["at"] for step in story["steps"]]

    assert times == sorted(times)


@each("story", STORIES)
def test_only_a_module_with_power_is_spoken_to(story: Record) -> None:
    powered = False
    wrong = []
    for step in story["steps"]:
        if "power_on" in step:
            wrong += [step] if powered else []
            powered = True
        elif "power_off" in step:
            wrong += [] if powered else [step]
            powered = False
        elif "send" in step and not powered:
            wrong.append(step)

    assert wrong == []


@each("story", STORIES)
def test_the_init_switch_is_at_power_on_where_it_was_moved(story: Record) -> None:
    """The switch is moved by steps of its own; a power-on only says where it is."""
    position = False
    wrong = []
    for step in story["steps"]:
        if "switch" in step:
            position = step["switch"]["init"]
        elif "power_on" in step and step["power_on"]["init_switch"] != position:
            wrong.append(step)

    assert wrong == []


@each("story", STORIES)
def test_a_module_has_time_to_settle(story: Record) -> None:
    changed = -float("inf")
    early = []
    for step in story["steps"]:
        if "send" in step and step["at"] - changed < SETTLED:
            early.append(step)
        elif "power_on" in step or "signals" in step:
            changed = step["at"]

    assert early == []


def broadcast(message: Record) -> bool:
    text: str | None = message["text"]
    return message["wire"].startswith("00") if text is None else text.startswith(("#**", "~**"))


def pause(message: Record) -> float:
    """Seconds owed after a broadcast, and after the calibration of the factory is loaded by either protocol."""
    loading = re.fullmatch(r"\$..S1(..)?", message["text"] or "") or message["wire"][2:8] == "05010f"
    return 3 if loading else 0.002 * broadcast(message)


@each("story", STORIES)
def test_the_pauses_owed_are_kept(story: Record) -> None:
    following = [step["at"] for step in story["steps"][1:]] + [float("inf")]
    early = [
        step
        for step, then in zip(story["steps"], following, strict=True)
        if "send" in step and then - step["at"] < pause(step["send"])
    ]

    assert early == []


@each("story", STORIES)
def test_a_text_says_what_its_wire_says(story: Record) -> None:
    wrong = [
        message
        for message in messages(story)
        if message["text"] is not None and message["text"] != eyes(bytes.fromhex(message["wire"]))
    ]

    assert wrong == []


def answers(step: Record) -> bool:
    """Whether what is expected can be an answer to what is sent: whole, of the same protocol, of the same function."""
    command, response = (bytes.fromhex(step[side]["wire"]) for side in ("send", "expect"))
    if step["send"]["text"] is None:
        sealed = crc(response[:-2]) == response[-2:] and crc(command[:-2]) == command[-2:]
        return sealed and response[:1] == command[:1] and response[1] & 0x7F == command[1]
    whole = response.endswith(b"\r") and response.count(b"\r") == 1 and response[0] in b"!>?"
    return whole and step["expect"]["text"] is not None


@each("story", STORIES)
def test_what_is_expected_can_be_an_answer(story: Record) -> None:
    wrong = [step for step in steps(story, "send") if step["expect"] is not None and not answers(step)]

    assert wrong == []
    assert any(step["expect"] is not None for step in steps(story, "send"))


@each("story", STORIES)
def test_a_broadcast_is_not_answered(story: Record) -> None:
    wrong = [step for step in steps(story, "send") if step["expect"] is not None and broadcast(step["send"])]

    assert wrong == []


@each("story", STORIES)
def test_a_profile_fits_its_model(story: Record) -> None:
    profile = story["profile"]
    model = MODELS[profile["model"]]
    codes = {f"{code:02X}" for code in profile["type_codes"]}

    assert len(profile["type_codes"]) == channels(profile)
    assert codes - set(model["types"]) == set()
    assert profile["protocol"] in model["protocols"]
    assert (profile["modbus_data_format"] is None) == ("modbus" not in model["protocols"])
    assert len(codes) == 1 or model["individually_configurable"] is not None
    assert not profile["single_ended"] or model["single_ended_by_command"]
    assert not profile["report_settings"] & 0x20 or model["fast_mode"]


@each("story", STORIES)
def test_a_signal_goes_to_an_input_that_is_there(story: Record) -> None:
    model = MODELS[story["profile"]["model"]]
    inputs = {str(number) for number in range(channels(story["profile"]))} | ({"cjc"} if model["cjc"] else set())
    given = set(chain.from_iterable(step["signals"] for step in steps(story, "signals")))
    opened = any("open" in step["signals"].values() for step in steps(story, "signals"))

    assert given - inputs == set()
    assert not opened or model["open_wire_detection"]


@each("story", STORIES)
def test_a_story_names_what_its_steps_rest_on(story: Record) -> None:
    used = {step["erratum"] for step in steps(story, "send")} - {None}
    assumed = any(ERRATA[erratum]["assumption"] for erratum in story["errata"])

    assert used - set(story["errata"]) == set()
    assert story["source"] == "manual" or (story["source"] == "assumed") == assumed
    assert story["errata"] == sorted(story["errata"], key=lambda erratum: int(erratum[1:]))


PRINTED = [
    pytest.param(vector, id=vector["id"])
    for _, vector in lint.vectors("dcon")
    if vector["source"] == "manual" and "misprint" not in vector["flags"]
]


@each("vector", PRINTED)
def test_every_printed_exchange_happens_in_a_story_of_the_manual(vector: Record) -> None:
    told = [
        (step["send"]["wire"], step["expect"] and step["expect"]["wire"])
        for story in lint.stories()
        if story["source"] == "manual"
        for step in steps(story, "send")
    ]

    assert (vector["command_wire"], vector["response_wire"]) in told
