"""A module on the test bench: it is talked to, time passes, its power comes and goes."""

from typing import Any

from attrs import define, evolve, field

from i7000 import Firmware, Model, Protocol, TypeCode, dcon, modbus
from i7000.device import Signals, State, advance, factory, power_on, step

__all__ = ["Bench", "bench"]


@define
class Bench:
    """A module, what is on its inputs, and the time."""

    state: State
    signals: Signals = field(factory=Signals)
    now: float = 1000.0

    def send(self, frame: bytes) -> bytes | None:
        """Send bytes, and tell what comes back."""
        self.state, answer = step(self.state, frame, self.signals, self.now)
        return answer

    def say(self, text: str) -> str | None:
        """Send a DCON command without its end, and tell the answer without its end."""
        checksum = self.state.ram.checksum
        answer = self.send(dcon.seal(text.encode(), checksum=checksum))
        return None if answer is None else dcon.unseal(answer, checksum=checksum).decode()

    def ask(self, request: modbus.Request[Any]) -> Any:
        """Send a Modbus request, and read the answer; None for silence."""
        profile = self.state.profile
        answer = self.send(modbus.encode(request, profile, force=True))
        return None if answer is None else modbus.decode_response(answer, request, profile)

    def read(self, key: str) -> Any:
        """Read a row of the module's map."""
        registers = modbus.RegisterMap(self.state.profile)
        response = self.ask(registers.read(self.state.ram.address, key))
        if isinstance(response, modbus.ExceptionResponse):
            return response
        return registers.decode(key, response.values, big_endian=self.state.eeprom.big_endian)

    def write(self, key: str, value: Any) -> Any:
        """Write a row of the module's map."""
        registers = modbus.RegisterMap(self.state.profile)
        big_endian = self.state.eeprom.big_endian
        return self.ask(registers.write(self.state.ram.address, key, value, big_endian=big_endian))

    def wait(self, seconds: float) -> None:
        """Move the time on."""
        self.now += seconds
        self.state = advance(self.state, self.signals, self.now)

    def power_cycle(self, *, init_switch: bool = False) -> None:
        """Take the power away, and give it back."""
        self.state = power_on(self.state.eeprom, init_switch=init_switch, now=self.now)


def bench(
    model: Model,
    firmware: str | None = None,
    *,
    signals: Signals | None = None,
    type_code: TypeCode | None = None,
    **stored: Any,
) -> Bench:
    """Put a module from the factory on the bench, speaking DCON if nothing else is said, with changes to its EEPROM."""
    eeprom = factory(model, None if firmware is None else Firmware(firmware))
    if type_code is not None:
        stored["type_codes"] = (type_code,) * len(eeprom.type_codes)
    eeprom = evolve(eeprom, **{"protocol": Protocol.DCON} | stored)
    return Bench(power_on(eeprom, now=1000.0), signals or Signals())
