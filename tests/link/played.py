"""A program that plays an I-7018 on its standard input and output, for ``exec:``: ``python played.py [ADDRESS]``."""

import os
import sys
from time import monotonic

from attrs import evolve

from i7000 import Model, Unit
from i7000.device import Bus, Ear, Signals, factory, power_on


def main() -> None:
    """Answer until the input ends."""
    eeprom = evolve(factory(Model.I_7018), address=int(sys.argv[1], 16) if len(sys.argv) > 1 else 1)
    switch = os.environ["I7000_INIT"] == "1"
    bus, ear = Bus((power_on(eeprom, now=monotonic(), init_switch=switch),)), Ear()
    while data := os.read(0, 4096):
        bus, ear, told = bus.hear(ear, data, [Signals.of(Unit.VOLT, 1.5)], monotonic())
        for heard in told:
            if heard.answer is not None:
                os.write(1, heard.answer)


if __name__ == "__main__":
    main()
