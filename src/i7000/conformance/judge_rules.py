"""The rules for a line in operation: what a driver and a module owe to each other, by what can be heard of them.

Laws: an id is written once and never reused. Each rule has one side, the sections that it follows from, and a level.
What follows from the rules of a line with two wires, and not from the manual alone, is `INFERRED`.
"""

from enum import Enum, StrEnum
from typing import NamedTuple

from i7000.conformance.statement import Level

__all__ = ["Rule", "Side"]


class Side(StrEnum):
    """A side of the line."""

    DRIVER = "driver"
    """The host, which asks."""
    MODULE = "module"
    """A module, which answers."""


class _Statement(NamedTuple):
    """A rule as data."""

    name: str
    """Its id without the side: ``crc``."""
    side: Side
    level: Level
    sections: tuple[str, ...]
    errata: tuple[str, ...]
    sentence: str
    """What it requires."""
    brief: bool
    """Whether it is about times so short that an adapter which collects bytes hides or invents a breach."""


def _driver(  # noqa: PLR0913 - the facts of a rule
    name: str, level: Level, sections: str, errata: str, sentence: str, *, brief: bool = False
) -> _Statement:
    return _Statement(name, Side.DRIVER, level, tuple(sections.split()), tuple(errata.split()), sentence, brief)


def _module(  # noqa: PLR0913 - the facts of a rule
    name: str, level: Level, sections: str, errata: str, sentence: str, *, brief: bool = False
) -> _Statement:
    return _Statement(name, Side.MODULE, level, tuple(sections.split()), tuple(errata.split()), sentence, brief)


_M, _I, _O = Level.MUST, Level.INFERRED, Level.OPEN


class Rule(Enum):
    """A rule."""

    ASK_AFTER_BROADCAST = _driver(
        "ask-after-broadcast", _M, "2.2 2.35", "", "A driver waits 2 ms after #** and ~** before the next command.",
        brief=True,
    )  # fmt: skip
    ASK_AFTER_MODBUS_BROADCAST = _driver(
        "ask-after-modbus-broadcast", _I, "3", "E94",
        "A driver waits 2 ms after a request to address 0, as after a DCON broadcast.", brief=True,
    )  # fmt: skip
    ASK_IN_CALIBRATION = _driver(
        "ask-in-calibration", _M, "2.8 2.9 2.28", "E103",
        "A driver leaves a module alone while it calibrates, or loads its factory calibration.",
    )  # fmt: skip
    ASK_BEFORE_ANSWER = _driver(
        "ask-before-answer", _I, "2 3", "",
        "A driver asks again only after the answer, or after the time in which it can come.",
    )  # fmt: skip
    TAKES_LATE_ANSWER = _driver(
        "takes-late-answer",
        _I,
        "2 3",
        "",
        "A driver does not take the answer to one frame for that to the next.",
    )
    DRIVER_CHECKSUM_MISSING = _driver(
        "checksum-missing", _M, "2", "E27", "A command has a checksum if the module uses one."
    )
    DRIVER_CHECKSUM_UNEXPECTED = _driver(
        "checksum-unexpected", _M, "2", "E27", "A command has no checksum if the module uses none."
    )
    DRIVER_CHECKSUM_WRONG = _driver(
        "checksum-wrong", _M, "2", "E27", "The checksum of a command is the sum of its characters, modulo 256."
    )
    DRIVER_LOWER_CASE = _driver("lower-case", _M, "2", "E27", "All characters of a command are in upper case.")
    DRIVER_TERMINATOR = _driver("terminator", _M, "2", "", "A command ends with a carriage return, and nothing else.")
    NO_COMMAND = _driver(
        "no-command", _M, "2 3", "E27", "A driver sends commands and requests that the manual has, in their form."
    )
    LACKS_COMMAND = _driver(
        "lacks-command", _I, "2 3", "E27", "A driver sends a module what its model, firmware and protocol have."
    )
    DRIVER_CRC = _driver("crc", _M, "3", "", "A request ends with its CRC, low byte first.")
    DRIVER_ADDRESS = _driver(
        "address", _M, "3", "E94", "A request goes to an address from 1 to 247, or to 0 if all modules can do it."
    )
    BOUNDS = _driver(
        "bounds", _M, "3.1 3.2 3.3", "",
        "Counts, values, byte counts and reserved bytes of a request are within the bounds of its function.",
    )  # fmt: skip
    DRIVER_GAP_BEFORE = _driver(
        "gap-before-request", _I, "3", "", "A request begins after a silence of at least 3.5 characters.", brief=True
    )
    DRIVER_GAP_WITHIN = _driver(
        "gap-in-request", _I, "3", "", "A request has no silence of 3.5 characters inside it.", brief=True
    )
    EEPROM_LOOP = _driver(
        "eeprom-loop", _I, "2.1 A.1", "",
        "A driver does not write settings in a loop: the EEPROM wears out.",
    )  # fmt: skip

    LENGTH = _module("length", _M, "2 3", "", "An answer has the length of the answer to its command.")
    ALPHABET = _module("alphabet", _M, "2 3", "", "An answer has the characters and bytes that its format allows.")
    MODULE_LOWER_CASE = _module("lower-case", _M, "2", "", "All characters of an answer are in upper case.")
    LEADING = _module("leading", _M, "2", "E24", "An answer begins with the leading character of its command.")
    MODULE_TERMINATOR = _module("terminator", _M, "2", "", "An answer ends with a carriage return, and nothing else.")
    MODULE_ADDRESS = _module("address", _M, "2 3", "", "An answer has the address of the module that was asked.")
    FUNCTION = _module("function", _M, "3", "", "An answer has the function and sub-function of its request.")
    SETTINGS_LENGTH = _module("settings-length", _M, "3.3", "", "An answer of function 46h has all of its bytes.")
    ECHO = _module("echo", _M, "3", "", "The answer to a write repeats its address and its value or count.")
    ORDER = _module("order", _I, "2 3", "", "Answers come in the order of their commands.")
    MODULE_CHECKSUM_MISSING = _module(
        "checksum-missing", _M, "2", "", "An answer has a checksum if the module uses one."
    )
    MODULE_CHECKSUM_UNEXPECTED = _module(
        "checksum-unexpected", _M, "2", "", "An answer has no checksum if the module uses none."
    )
    MODULE_CHECKSUM_WRONG = _module(
        "checksum-wrong", _M, "2", "", "The checksum of an answer is the sum of its characters, modulo 256."
    )
    MODULE_CRC = _module("crc", _M, "3", "", "An answer ends with its CRC, low byte first.")
    READING = _module("reading", _I, "1.11", "E121", "A reading has the form and range of the type of its channel.")
    VALUE = _module("value", _M, "2 3", "", "A digit or byte of an answer has one of its defined values.")
    CONTRADICTION = _module(
        "contradiction", _I, "2 3", "", "An answer agrees with what the module has said of itself before."
    )
    LATE = _module("late", _O, "2 3", "", "An answer begins before the time is over in which a driver waits for it.")
    UNASKED = _module("unasked", _M, "2", "", "A module speaks only when it was asked.")
    SECOND_ANSWER = _module("second-answer", _M, "2", "", "A command has one answer.")
    ANSWERS_BROADCAST = _module("answers-broadcast", _M, "2 2.2 2.35", "E26", "A module does not answer #** and ~**.")
    ANSWERS_MODBUS_BROADCAST = _module(
        "answers-modbus-broadcast", _I, "3", "E94", "A module does not answer a request to address 0."
    )
    ANSWERS_INVALID = _module(
        "answers-invalid", _O, "2 3", "E27", "A module does not answer a frame that is damaged, or has a wrong form."
    )
    EXCEPTION_BIT = _module("exception-bit", _M, "3", "", "The function of an exception has bit 80h set.")
    EXCEPTION_CODE = _module("exception-code", _I, "3", "E94", "The code of an exception is defined.")
    MODULE_GAP_BEFORE = _module(
        "gap-before-answer", _I, "3", "", "An answer begins after a silence of at least 3.5 characters.", brief=True
    )
    MODULE_GAP_WITHIN = _module(
        "gap-in-answer", _I, "3", "", "An answer has no silence of 3.5 characters inside it.", brief=True
    )

    @property
    def id(self) -> str:
        """The id: ``listen/driver/crc``."""
        return f"listen/{self.side}/{self.value.name}"

    @property
    def side(self) -> Side:
        """The side that it binds."""
        return self.value.side

    @property
    def level(self) -> Level:
        """The evidence for it."""
        return self.value.level

    @property
    def sections(self) -> tuple[str, ...]:
        """The sections of the manual that it follows from."""
        return self.value.sections

    @property
    def errata(self) -> tuple[str, ...]:
        """The ids of the errata that it rests on."""
        return self.value.errata

    @property
    def sentence(self) -> str:
        """What it requires."""
        return self.value.sentence

    @property
    def brief(self) -> bool:
        """Whether an adapter that collects bytes hides or invents a breach of it."""
        return self.value.brief
