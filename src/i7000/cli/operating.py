"""What a person does at simulated modules: power, INIT switch and signals, as commands of `control`."""

import asyncio

from i7000.cli.control import Command
from i7000.cli.numbers import integer
from i7000.cli.signals import read_signals
from i7000.cli.words import UsageError, truth
from i7000.describe import address as address_words
from i7000.simulator.simulator import Simulator

__all__ = ["module_commands"]


def module_commands(simulator: Simulator, seed: int) -> dict[str, Command]:
    """Return the commands to the modules of a simulator; addresses are those in their EEPROMs."""

    async def power_cycle(text: str) -> str:
        simulator.power_cycle(_places(simulator, text) if text else None)
        return ""

    async def init(text: str) -> str:
        address, _, position = text.partition(" ")
        if not position:
            raise UsageError("write init ADDRESS on|off")
        on = truth(position.strip())
        for place in _places(simulator, address):
            simulator.switch_init(place, on=on)
        return ""

    async def signal(text: str) -> str:
        eeproms = [module.eeprom for module in simulator.bus.modules]
        connected = [sources for _, _, sources in simulator.modules()]
        simulator.connect(await asyncio.to_thread(read_signals, [text], eeproms, seed, connected))
        return ""

    return {
        "power-cycle": Command("power-cycle [ADDRESS]", power_cycle),
        "init": Command("init ADDRESS on|off", init),
        "signal": Command("signal [ADDRESS:]CHANNELS=SIGNAL", signal),
    }


def _places(simulator: Simulator, text: str) -> tuple[int, ...]:
    address = integer(text)
    places = simulator.places(address)
    if not places:
        addresses = sorted({module.eeprom.address for module in simulator.bus.modules})
        known = ", ".join(map(address_words, addresses))
        raise UsageError(f"no module has the address {address_words(address)}, only {known}")
    return places
