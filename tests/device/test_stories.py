"""Every story of ``spec/`` is lived through by the model of its module."""

from typing import Any

import pytest
from attrs import evolve, field, mutable

from i7000 import Firmware, LineSettings, ModbusDataFormat, Model, ReportSettings, TypeCode
from i7000.device import OPEN_WIRE, Eeprom, Signal, Signals, State, advance, factory, power_on, step
from i7000.settings import Protocol
from tests.spec.lint import Record, stories

STORIES = [pytest.param(story, id=story["id"]) for story in stories()]
PROTOCOLS = {"dcon": Protocol.DCON, "modbus": Protocol.MODBUS_RTU}
ROOM = 25.0
"""The temperature of the terminals, in degrees Celsius, where a story gives none."""


def eeprom_of(profile: Record) -> Eeprom:
    """What the module of a story remembers before it begins."""
    model = Model.find(profile["model"])
    made = factory(model, None if profile["firmware"] is None else Firmware(profile["firmware"]))
    given = [TypeCode(code) for code in profile["type_codes"]]
    data_format = profile["modbus_data_format"]
    return evolve(
        made,
        address=profile["address"],
        type_codes=(*given, *made.type_codes[len(given) :]),
        line_settings=LineSettings.from_byte(profile["line_settings"]),
        report_settings=ReportSettings.from_byte(profile["report_settings"]),
        protocol=PROTOCOLS[profile["protocol"]],
        single_ended=profile["single_ended"],
        modbus_data_format=made.modbus_data_format if data_format is None else ModbusDataFormat[data_format.upper()],
    )


@mutable
class Bench:
    """A module with its power, its switch and its inputs, as a story finds them."""

    eeprom: Eeprom
    state: State | None = None
    inputs: dict[str, Any] = field(factory=dict)

    @property
    def signals(self) -> Signals:
        """What is on the inputs: nothing, in the unit of its type, where the story gives nothing."""
        nothing = (Signal(0.0, code.unit) for code in self.eeprom.type_codes)
        channels = tuple(self.inputs.get(str(number), signal) for number, signal in enumerate(nothing))
        return Signals(channels, cold_junction=self.inputs.get("cjc", ROOM))

    def play(self, happening: Record) -> None:
        """Perform one step at its time, except a frame."""
        now = happening["at"]
        if "power_on" in happening:
            self.state = power_on(self.eeprom, init_switch=happening["power_on"]["init_switch"], now=now)
        elif self.state is not None:
            self.keep(advance(self.state, self.signals, now))
        if "signals" in happening:
            self.inputs |= {name: self.signal(name, value) for name, value in happening["signals"].items()}
        elif "power_off" in happening:
            self.state = None
        elif "switch" in happening and self.state is not None:
            self.keep(self.state.switched(init_switch=happening["switch"]["init"]))

    def signal(self, name: str, value: Any) -> Any:
        if name == "cjc":
            return value
        return OPEN_WIRE if value == "open" else Signal(float(value), self.eeprom.type_codes[int(name)].unit)

    def keep(self, state: State) -> None:
        self.state = state
        self.eeprom = state.eeprom

    def hear(self, frame: bytes, now: float) -> bytes | None:
        """Give a frame to the module, and return the response."""
        assert self.state is not None
        state, answer = step(self.state, frame, self.signals, now)
        self.keep(state)
        return answer


@pytest.mark.parametrize("story", STORIES)
def test_a_module_lives_through_its_story(story: Record) -> None:
    bench = Bench(eeprom_of(story["profile"]))
    for number, happening in enumerate(story["steps"]):
        if "send" not in happening:
            bench.play(happening)
            continue
        expected = None if happening["expect"] is None else bytes.fromhex(happening["expect"]["wire"])
        actual = bench.hear(bytes.fromhex(happening["send"]["wire"]), happening["at"])

        assert expected == actual, f"step {number}: {happening['comment']}"
