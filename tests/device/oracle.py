"""What the manual has a module do, said as simply as it can be: some settings, and patterns of what is sent.

Written from chapters 1 to 3 and the appendix, and from ``spec/``, to hold the model of `i7000.device` against. Who has
a command, a register, a type is looked up in the tables of ``spec/``; what they do is said here, on bare bytes.

Laws: nothing of `i7000` is imported. An answer of True is ``!AA``, of False ``?AA``, and nothing has changed then; of
None silence.
"""

import re
from collections.abc import Callable
from math import inf
from typing import Any

from tests.spec.lint import Record, rows

__all__ = ["HAVE", "MODELS", "TYPES", "VERSIONS", "Oracle", "bits", "sealed"]

MODELS: dict[str, Record] = {row["name"]: row for row in rows("models")}
TYPES: dict[int, Record] = {int(row["code"], 16): row for row in rows("type_codes")}
HAVE: dict[str, dict[str, str | None]] = {row["section"]: row["models"] for row in rows("dcon_commands")}
VERSIONS = "A2.0", "B1.4", "B2.1", "B2.2", "B2.6", "B2.7", "B2.9", "B3.1", "B3.5", "B3.7", "B3.9", "B4.2", "B4.5"
"""Firmware on both sides of every change that the manual tells of."""

Answer = bool | str | None
ANSWERS: list[tuple[str, str, Callable[..., Answer]]] = []
"""Sections of chapter 2, the pattern of the command behind its address, and what comes of it."""


def answers(section: str, lead: str, pattern: str = "") -> Callable[[Callable[..., Answer]], Callable[..., Answer]]:
    """Return how a command is answered: ``h`` stands for a hex digit, ``N`` for a channel, ``V`` for a channel mask."""

    def add(answer: Callable[..., Answer]) -> Callable[..., Answer]:
        ANSWERS.append((section, re.escape(lead) + "AA" + pattern, answer))
        return answer

    return add


def sealed(body: str, *, checksum: bool) -> bytes:
    """Write a DCON frame (2)."""
    return (body + (f"{sum(body.encode('latin-1')) & 0xFF:02X}" if checksum else "") + "\r").encode("latin-1")


class Oracle:
    """A module: its settings, what it forgets without power, what is on its inputs, and the time."""

    def __init__(self, model: str, firmware: str) -> None:
        self.model, self.firmware, self.row = model, firmware, MODELS[model]
        self.series, self.now = self.row["series"], 0.0
        inputs: int = self.row["single_ended_channels"] or self.row["channels"]
        self.inputs = inputs
        self.types = [int(self.row["default_type"] or "0E", 16)] * inputs
        self.mask = (1 << inputs) - 1
        self.signals: list[tuple[str, float] | None] = [("degC", 0.0)] * inputs
        """What is on each channel: ``mV``, or ``degC`` at the hot end of a thermocouple, or nothing."""
        self.ambient = 25.0
        self.stored_address, self.line, self.stored_checksum, self.data_format = 1, 0x06, False, 0
        self.fast, self.filter_50_hz = bool(self.row["fast_mode_default"]), False
        self.stored_protocol = "modbus" if "modbus" in self.row["protocols"] else "dcon"
        self.name = (self.series + model[6:].replace("-", ""))[:6].upper()
        self.single_ended = self.engineering = False
        self.cjc_offset, self.cjc_enabled = 0, True
        self.tenths, self.hundredths = [0] * inputs, [0] * inputs
        self.open_wire = self.row["open_wire_detection"]
        self.watchdog, self.timeout, self.timed_out, self.timeouts = False, 0, False, 0
        self.delay, self.sampling_8_hz, self.watchdog_mode = 0, True, False
        self.switch = False
        self.power_on()

    def power_on(self) -> None:
        """Forget what is forgotten without power; in INIT mode be module 00, DCON, no checksum (A.1)."""
        self.init_mode = self.switch
        self.address = 0 if self.switch else self.stored_address
        self.checksum = not self.switch and self.stored_checksum
        self.protocol = "dcon" if self.switch else self.stored_protocol
        self.fed_at, self.calibration, self.reset_told = self.now, False, False
        self.soft_timeout, self.soft_until = 0, -inf
        self.update, self.held = 1, None  # type: int, float | None
        self.sampled: list[list[str]] | None = None  # in each data format
        self.sampled_told = False

    # --- what it has ------------------------------------------------------------------------------------------------

    def since(self, version: str | bool | None) -> bool:  # noqa: FBT001 - a cell of a table
        """Whether the firmware is late enough; without a version, any is."""
        return version in (None, True) or self.firmware >= str(version)

    def has(self, models: dict[str, str | None]) -> bool:
        """Whether a row of a table names the model, with this firmware."""
        return self.model in models and self.since(models[self.model])

    def supports(self, code: int) -> bool:
        """Whether the inputs can have a type (1.11)."""
        types = self.row["types"]
        return f"{code:02X}" in types and self.since(types[f"{code:02X}"])

    @property
    def channels(self) -> int:
        """Channels in the connecting mode (2.43)."""
        return int(self.inputs if self.single_ended else self.row["channels"])

    @property
    def mask_digits(self) -> int:
        """Digits of a channel mask (2.13)."""
        return int(self.row["mask_digits_single_ended" if self.single_ended else "mask_digits"])

    @property
    def individual(self) -> bool:
        """Whether each channel can have its own type (2.15)."""
        version = self.row["individually_configurable"]
        return version is not None and (version == "always" or self.since(version))

    @property
    def enabled(self) -> int:
        """The mask of the channels that are there and on."""
        return self.mask & (1 << self.channels) - 1

    @property
    def module_type(self) -> int:
        """The type of all channels, FF if they differ (2.10)."""
        types = set(self.types[: self.channels])
        return types.pop() if len(types) == 1 else 0xFF

    def line_allowed(self, line: int) -> bool:
        """Whether CC can be set (1.11)."""
        return 3 <= line & 0x3F <= 0x0A and (line < 0x40 or self.since(self.row["character_formats_from"]))

    def report_allowed(self, report: int) -> bool:
        """Whether FF can be set (1.11)."""
        filtered = not report & 0x80 or self.since(self.row["filter"])
        return report & 3 < 3 and not report & 0x1C and (not report & 0x20 or self.row["fast_mode"]) and filtered

    @property
    def report(self) -> int:
        """FF."""
        return self.filter_50_hz << 7 | self.stored_checksum << 6 | self.fast << 5 | self.data_format

    def set_types(self, code: int, channel: int | None = None) -> None:
        """Set the type of a channel, or of all."""
        for at in [channel] if channel is not None and self.individual else range(self.inputs):
            self.types[at] = code

    def set_mask(self, mask: int) -> None:
        """Switch the channels that are there."""
        self.mask = self.mask & ~((1 << self.channels) - 1) | mask

    def set_address(self, address: int) -> None:
        """Change the address, at once if not in INIT mode (2.1, 1.12.2)."""
        self.stored_address = address
        self.address = self.address if self.init_mode else address

    def set_watchdog(self, timeout: int, *, enabled: bool) -> None:
        """Set the host watchdog, which begins to wait (2.39)."""
        self.watchdog, self.timeout, self.fed_at = enabled, timeout, self.now

    def set_update(self, update: int) -> None:
        """Start the update of the cold junction's temperature, stop it, or make it once (2.21)."""
        if update == 1:
            self.held = None
        elif update == 2 or self.held is None:
            self.held = self.ambient
        self.update = update

    def tick(self, now: float) -> None:
        """Move the time on: the host watchdog may time out, which disables it (2.36, A.2)."""
        self.now = now
        if self.watchdog and self.timeout and now >= self.fed_at + self.timeout / 10:
            self.watchdog, self.timed_out, self.timeouts = False, True, min(self.timeouts + 1, 0xFFFF)

    # --- what it measures -------------------------------------------------------------------------------------------

    def junction(self, ambient: float) -> float:
        """The temperature of the terminals, as the module knows it."""
        return ambient if self.held is None else self.held

    def cold_junction(self) -> float:
        """The reported temperature: with the offset on the 7018 series (2.11)."""
        return self.junction(self.ambient) + (self.cjc_offset / 100 if self.series == "7018" else 0)

    def value(self, channel: int, signal: tuple[str, float] | None, ambient: float) -> float:
        """The reading of a channel that is on; infinite beyond its span (1.11)."""
        kind = TYPES[self.types[channel]]
        low, high = kind["minimum"], kind["maximum"]
        unit, level = signal or ("", 0.0)
        if kind["thermocouple"]:
            shorted = inf * level if level else ambient
            if signal is None and self.open_wire:
                shorted = inf
            value = (level if unit == "degC" else shorted) - ambient
            own = self.tenths[channel] / 10 if self.cjc_enabled or self.series == "7019" else 0
            hundredths = (self.cjc_offset + self.hundredths[channel]) / 100
            value += own + (self.junction(ambient) + hundredths if self.cjc_enabled else 0)
        else:
            value = level / {"mV": 1, "V": 1000, "mA": 125}[kind["unit"]] if unit == "mV" else 0.0
            value = abs(value) if self.model == "M-7017RMS" else value
        if not low <= value <= high:
            return inf if value > high else -inf
        if self.fast:
            bottom = -kind["max"] if kind["hex_signed"] else low
            step = (high - bottom) / 4096
            value = bottom + min(round((value - bottom) / step), 4095) * step
        return float(value)

    def fields(self, data_format: int, signals: list[tuple[str, float] | None], ambient: float) -> list[str]:
        """Return the fields of the channels as DCON sends them (1.11, 2.3)."""
        legacy = self.series == "7018" and self.model[0] == "I" and self.firmware <= "B1.4"
        return [self.field(at, data_format, signals[at], ambient, legacy=legacy) for at in range(self.channels)]

    def field(
        self, channel: int, data_format: int, signal: tuple[str, float] | None, ambient: float, *, legacy: bool
    ) -> str:
        kind = TYPES[self.types[channel]]
        value = self.value(channel, signal, ambient)
        if not self.mask >> channel & 1:
            if self.series == "7019":
                return " " * (4 if data_format == 2 else 7)
            value = max(0.0, kind["minimum"])
        if abs(value) == inf and legacy:
            return "+9999" if value > 0 else "-0000"
        if data_format == 2:
            return f"{self.word(channel, value):04X}"
        if abs(value) == inf:
            return ("-" if value < 0 else "+") + ("9999.9" if data_format == 0 else "999.99")
        if data_format == 0:
            return f"{value:+z07.{kind['engineering_decimals']}f}"
        bottom, span = (0, kind["max"]) if kind["hex_signed"] else (kind["minimum"], kind["maximum"] - kind["minimum"])
        return f"{(value - bottom) / span * 100:+z07.2f}"

    def word(self, channel: int, value: float) -> int:
        """A reading in hexadecimal (1.11, A.5)."""
        kind = TYPES[self.types[channel]]
        if kind["hex_signed"]:
            counts = value / kind["max"] * (32767 if value > 0 else 32768)
            return int(round(min(max(counts, -32768), 32767)) & 0xFFFF)
        counts = (value - kind["minimum"]) / (kind["maximum"] - kind["minimum"]) * 65535
        return round(min(max(float(counts), 0.0), 65535.0))

    def faults(self, channels: int) -> list[bool]:
        """Which channels are on and out of range: on the 7017 and 7018 of 4..20 and 0..20 mA only (2.22, 3.4)."""
        told = [self.series == "7019" or not TYPES[code]["hex_signed"] for code in self.types]
        out = [abs(self.value(at, self.signals[at], self.ambient)) == inf for at in range(channels)]
        return [told[at] and out[at] and bool(self.mask >> at & 1) for at in range(channels)]

    # --- DCON -------------------------------------------------------------------------------------------------------

    def hear(self, frame: bytes) -> bytes | None:
        """Hear a DCON frame; tell the answer, or None for silence (2)."""
        end = -3 if self.checksum else -1
        body = frame[:end].decode("latin-1")
        if frame != sealed(body, checksum=self.checksum):
            return None
        if body == "#**" and self.series == "7019":
            self.sampled = [self.fields(code, self.signals, self.ambient) for code in range(3)]
            self.sampled_told = False
        if body == "~**":
            self.fed_at = self.now
        own, checksum = f"{self.address:02X}", self.checksum
        for section, pattern, answer in ANSWERS:
            marks = {"AA": own, "hh": "([0-9A-F]{2})", "h": "([0-9A-F])", "V": f"([0-9A-F]{{{self.mask_digits}}})"}
            marks["N"] = "([0-9A-F]{2})" if self.single_ended else "([0-9A-F])"
            found = re.fullmatch(re.sub("AA|hh|h|V|N", lambda it: marks[it[0]], pattern), body)  # noqa: B023
            if not found or not self.has(HAVE[section]):
                continue
            told = answer(self, *found.groups())
            if told is None:
                break
            if told is not False and section != "2.32":
                self.soft_until = -inf
            text = told if isinstance(told, str) else "?!"[bool(told)] + own
            return sealed(text, checksum=checksum)
        return None


# --- chapter 2 --------------------------------------------------------------------------------------------------------


def reads(section: str, command: str, tell: Callable[[Any], str]) -> None:
    """Return the response to a command without digits after ``!AA``, or from ``>`` on."""

    def answer(it: Oracle) -> Answer:
        told = tell(it)
        return told if told.startswith(">") else f"!{it.address:02X}{told}"

    answers(section, command[0], command[1:])(answer)


def sets(section: str, command: str, pattern: str, store: Callable[..., bool | None]) -> None:
    """Return what a command stores, or False if it is refused. Its digits are passed as numbers."""

    def answer(it: Oracle, *digits: str) -> Answer:
        return store(it, *(int(each, 16) for each in digits)) is not False

    answers(section, command[0], command[1:] + pattern)(answer)


def keep(name: str) -> Callable[[Oracle, int], None]:
    """Store a number, or a digit as a truth value where there is one."""

    def store(it: Oracle, value: int) -> None:
        setattr(it, name, type(getattr(it, name))(value))

    return store


@answers("2.1", "%", "hhhhhhhh")
def configure(it: Oracle, *digits: str) -> Answer:
    """Set address, type, line and reports; line and checksum only by the switch or a soft INIT (2.1, 2.32)."""
    new, code, line, report = (int(each, 16) for each in digits)
    given = it.row["uses_tt"] and not (code == 0xFF and it.individual)
    locked = line != it.line or bool(report & 0x40) != it.stored_checksum
    allowed = (not given or it.supports(code)) and it.line_allowed(line) and it.report_allowed(report)
    if not allowed or (locked and not it.switch and it.now >= it.soft_until):
        return False
    if given:
        it.set_types(code)
    it.line, it.stored_checksum, it.data_format = line, bool(report & 0x40), report & 3
    it.fast, it.filter_50_hz = bool(report & 0x20), bool(report & 0x80)
    it.set_address(new)
    if locked and not it.switch:
        it.checksum = it.stored_checksum
    return f"!{new:02X}"


@answers("2.4", "#", "N")
def one_input(it: Oracle, digits: str) -> Answer:
    """Read one channel."""
    channel = int(digits, 16)
    return channel < it.channels and ">" + it.fields(it.data_format, it.signals, it.ambient)[channel]


@answers("2.12", "$", "4")
def sampled(it: Oracle) -> Answer:
    """Read what was on the inputs at the last ``#**``, and whether that was read before."""
    if it.sampled is None:
        return False
    first, it.sampled_told = not it.sampled_told, True
    return f">{it.address:02X}{first:d}" + "".join(it.sampled[it.data_format])


@answers("2.15", "$", "7CNRhh")
def set_channel_type(it: Oracle, *digits: str) -> Answer:
    """Set the type of one channel."""
    channel, code = (int(each, 16) for each in digits)
    if channel >= it.channels or not it.supports(code):
        return False
    it.set_types(code, channel)
    return True


@answers("2.16", "$", "8CN")
def channel_type(it: Oracle, digits: str) -> Answer:
    """Read the type of one channel."""
    channel = int(digits, 16)
    return channel < it.channels and f"!{it.address:02X}C{digits}R{it.types[channel]:02X}"


@answers("2.18", "$", "9([+-])hhhh")
def set_cjc_offset(it: Oracle, sign: str, *digits: str) -> Answer:
    """Set the CJC offset, of up to 1000h hundredths of a degree."""
    offset = int("".join(digits), 16)
    if offset <= 0x1000:
        it.cjc_offset = -offset if sign == "-" else offset
    return offset <= 0x1000


@answers("2.33", "~", "O([ -~]{1,6})")
def set_name(it: Oracle, name: str) -> Answer:
    """Set the name; a leading character in it makes it no name (E102); what looks like data is refused (E122)."""
    if set(name) & set("%#$~@!>?"):
        return None
    number = name[:4] in ("7017", "7018", "7019")
    digits = len(name) if re.fullmatch("[0-9A-F]*", name) else 0
    data = (
        (digits in (2, 4, 6) and not number)
        or (digits == 3 and name[0] in "01")
        or name in ("0", "1", "2")
        or re.fullmatch("[+-][0-9A-F]{4}|C[0-9A-F][0-9A-F]?R[0-9A-F][0-9A-F]|[A-Z][0-9][.][0-9][0-9]?", name)
    )
    it.name = it.name if data else name
    return not data


def set_soft_timeout(it: Oracle, seconds: int) -> bool:
    """Set the time-out of soft INIT, up to 60 s."""
    it.soft_timeout = seconds if seconds <= 60 else it.soft_timeout
    return seconds <= 60


def set_channels(it: Oracle, mask: int) -> bool:
    """Switch channels; those that are not there cannot be switched on."""
    if mask >> it.channels:
        return False
    it.set_mask(mask)
    return True


def set_protocol(it: Oracle, code: int) -> bool:
    """Set the protocol of the next power-on; it takes the switch."""
    it.stored_protocol = ("dcon", "modbus")[code] if it.switch else it.stored_protocol
    return it.switch


def bits(flags: list[bool]) -> int:
    """A mask, channel 0 the lowest bit."""
    return sum(flag << at for at, flag in enumerate(flags))


reads("2.3", "#", lambda it: ">" + "".join(it.fields(it.data_format, it.signals, it.ambient)))


def calibrate(it: Oracle, channel: int = 0) -> bool:
    """Calibrate, if that was enabled."""
    return it.calibration and channel < it.channels


sets("2.5", "$0", "", calibrate)
sets("2.6", "$1", "", calibrate)
sets("2.7", "$0", "CN", calibrate)
sets("2.8", "$0", "CN", calibrate)
sets("2.9", "$1", "CN", calibrate)
reads("2.11", "$3", lambda it: f">{it.cold_junction():+z07.1f}")
sets("2.13", "$5", "V", set_channels)
reads("2.14", "$6", lambda it: f"{it.enabled:0{it.mask_digits}X}")
reads("2.17", "$9", lambda it: f"{'-' if it.cjc_offset < 0 else '+'}{abs(it.cjc_offset):04X}")
reads("2.19", "$A", lambda it: ">" + "".join(it.fields(2, it.signals, it.ambient)))
reads("2.20", "$A", lambda it: f"{it.update}")
sets("2.21", "$A", "([012])", Oracle.set_update)
reads("2.22", "$B", lambda it: f"{bits(it.faults(it.channels)):0{it.mask_digits}X}")
reads("2.23", "$F", lambda it: it.firmware)
reads("2.24", "$M", lambda it: it.name)
reads("2.25", "$P", lambda it: f"1{it.stored_protocol == 'modbus':d}")
sets("2.26", "$P", "([01])", set_protocol)
sets("2.27", "$S0", "", lambda _: True)
sets("2.28", "$S1", "", lambda _: True)
reads("2.29", "~C", lambda it: f"{it.cjc_enabled:d}")
sets("2.30", "~C", "([01])", keep("cjc_enabled"))
sets("2.31", "~E", "([01])", keep("calibration"))
sets("2.32", "~I", "", lambda it: setattr(it, "soft_until", it.now + it.soft_timeout))
sets("2.34", "~T", "hh", set_soft_timeout)
reads("2.36", "~0", lambda it: f"{it.watchdog << 7 | it.timed_out << 2:02X}")
sets("2.37", "~1", "", lambda it: setattr(it, "timed_out", False))
reads("2.38", "~2", lambda it: f"{it.watchdog:d}{it.timeout:02X}")
sets("2.39", "~3", "([01])hh", lambda it, enabled, timeout: it.set_watchdog(timeout, enabled=bool(enabled)))
reads("2.40", "~EO", lambda it: f"{it.open_wire:d}")
sets("2.41", "~EO", "([01])", keep("open_wire"))
reads("2.42", "@S", lambda it: f"{it.single_ended:d}")
sets("2.43", "@S", "([01])", keep("single_ended"))


@answers("2.10", "$", "2")
def configuration(it: Oracle) -> Answer:
    """Read the configuration; in INIT mode the address too (E18)."""
    return f"!{it.stored_address:02X}{it.module_type:02X}{it.line:02X}{it.report:02X}"
