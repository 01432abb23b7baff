"""Firmware with bugs in DCON: checksums, addresses, answers, readings, settings, INIT."""

# ruff: noqa: ARG002 - a bug rarely looks at all that it is given

import re

from attrs import evolve

from i7000 import DataFormat, DecodeError, Model, Protocol, TypeCode, dcon
from i7000.conformance.hazard import Hazard
from i7000.device import Eeprom, State
from tests.conformance.zoo.animal import Animal
from tests.conformance.zoo.species import (
    Herd,
    acknowledging,
    answering,
    body_of,
    hearing,
    refusing,
    saying,
    sealed,
    settings,
)

HERD = Herd()
BROADCAST, WRITE, COMM, CALIBRATION = Hazard.BROADCAST, Hazard.WRITE, Hazard.COMM, Hazard.CALIBRATION
M_7019R, I_7017, I_7018, M_7017Z = Model.M_7019R, Model.I_7017, Model.I_7018, Model.M_7017Z
PLAIN = settings(M_7019R)
SUMMED = settings(M_7019R, checksum=True)
BIPOLAR = settings(I_7017)
"""A module with ``$AAA``, which reads in hex."""


def _hex_format(eeprom: Eeprom, data_format: DataFormat = DataFormat.HEX) -> Eeprom:
    return evolve(eeprom, report_settings=evolve(eeprom.report_settings, data_format=data_format))


# --- checksums --------------------------------------------------------------------------------------------------------


class _OtherSum(Animal):
    """Takes commands whose checksum is another one."""

    def takes(self, body: bytes, digits: bytes) -> bool:
        """Whether it takes a body with such digits after it."""
        raise NotImplementedError

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        body = frame[:-3]
        if len(frame) > 5 and self.takes(body, frame[-3:-1]):
            frame = sealed(self, body)
        return super().step(state, frame, now)


@HERD.animal("ignores-checksum", SUMMED, "frame/dcon/checksum-wrong frame/dcon/checksum-wrong-high-digit", others=18)
class IgnoresChecksum(_OtherSum):
    """The two digits of a checksum are dropped, not compared."""

    def takes(self, body: bytes, digits: bytes) -> bool:
        return True


@HERD.animal("half-a-checksum", SUMMED, "frame/dcon/checksum-wrong-high-digit")
class HalfAChecksum(_OtherSum):
    """Only the second digit of a checksum is compared."""

    def takes(self, body: bytes, digits: bytes) -> bool:
        return digits[1:] == b"%X" % (dcon.checksum(body) & 0xF)


@HERD.animal("needs-no-checksum", SUMMED, "frame/dcon/checksum-absent", others=40)
class NeedsNoChecksum(Animal):
    """A command without a checksum is carried out although the checksum is on."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        try:
            body_of(self, frame)
        except DecodeError:
            frame = sealed(self, frame[:-1])
        return super().step(state, frame, now)


@HERD.animal("answers-without-checksum", SUMMED, "link/alive")
class AnswersWithoutChecksum(Animal):
    """The answers have no checksum although it is on."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return None if answer is None else answer[:-3] + b"\r"


# --- whom it answers --------------------------------------------------------------------------------------------------


HERD.add(
    "answers-foreign-addresses",
    "Commands to every address are carried out, and answered.",
    hearing(rb"^([$#~@%])[0-9A-F]{2}", rb"\g<1>01"),
    PLAIN,
    "frame/dcon/address",
)
HERD.add(
    "answers-address-00",
    "Commands to address 00 are carried out without the INIT switch.",
    hearing(rb"^([$#~@%])00", rb"\g<1>01"),
    PLAIN,
    "frame/dcon/address",
)


@HERD.animal("refuses-for-others", PLAIN, "frame/dcon/address")
class RefusesForOthers(Animal):
    """Commands to other addresses are refused with ``?AA`` instead of being ignored."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        if answer is None and re.match(rb"[$#~@%][0-9A-F]{2}[^*]*\r", frame):
            return b"?01\r"
        return answer


@HERD.animal("refuses-wrong-checksums", SUMMED, "frame/dcon/checksum-wrong", others=4)
class RefusesWrongChecksums(Animal):
    """A command with a wrong checksum is refused with ``?AA`` instead of being ignored."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        if answer is None and re.match(rb"[$#~@%]01..", frame):
            return sealed(self, b"?01")
        return answer


HERD.add(
    "takes-any-leading-character",
    "The leading character of a command is not looked at.",
    hearing(rb"^[&*!](?=01)", b"$"),
    PLAIN,
    "frame/dcon/leading-character",
)
HERD.add(
    "answers-answers",
    "The answer of another module is taken for a command.",
    hearing(rb"^[!>?].*", rb"$01M"),
    PLAIN,
    "frame/dcon/answers-of-others",
)


@HERD.animal("refuses-fragments", PLAIN, "frame/dcon/truncated")
class RefusesFragments(Animal):
    """Text too short to have an address is refused with ``?AA``."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return b"?01\r" if 1 < len(frame) < 4 else answer


@HERD.animal("needs-no-end", PLAIN, "frame/dcon/end")
class NeedsNoEnd(Animal):
    """A command is carried out as soon as it is long enough, without its carriage return."""

    def hear(self, data: bytes, now: float) -> bytes:
        if re.fullmatch(rb"\$01[2FM]", data):
            return super().hear(data + b"\r", now)
        return super().hear(data, now)


@HERD.animal("hangs-after-long-text", PLAIN, "frame/dcon/long", others=40)
class HangsAfterLongText(Animal):
    """More text than its buffer holds stops the firmware for ever."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        self.hung = getattr(self, "hung", False) or len(frame) > 100
        return (state, None) if self.hung else super().step(state, frame, now)


@HERD.animal("answers-samplings", PLAIN, "dcon/2.2/sampling", allow=[BROADCAST])
class AnswersSamplings(Animal):
    """The broadcast ``#**`` is answered."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return b"!01\r" if frame == b"#**\r" else answer


@HERD.animal("answers-host-ok", PLAIN, "dcon/2.35/silent", allow=[BROADCAST])
class AnswersHostOk(Animal):
    """The broadcast ``~**`` is answered."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return b"!01\r" if frame == b"~**\r" else answer


# --- its answers ------------------------------------------------------------------------------------------------------


@HERD.animal("lower-case-hex", PLAIN, "dcon/2.14/reply")
class LowerCaseHex(Animal):
    """The hex digits of answers are in lower case."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return answer and re.sub(rb"(?<=^!01)[0-9A-F]+(?=\r)", lambda found: found[0].lower(), answer)


HERD.add("readings-with-address", "The readings have the address after the >.", saying(b"^>", b">01", to=rb"#01$"),
         PLAIN, "dcon/2.3/reply")  # fmt: skip
HERD.add("readings-with-exclamation-mark", "The reading of a channel begins with ! in place of >.",
         saying(b"^>", b"!01", to=rb"#01.$"), PLAIN, "dcon/2.4/reply")  # fmt: skip
HERD.add("blank-channels-dropped", "The blanks of a disabled channel are left out of the answer.",
         saying(b" {7}", b"", to=rb"#01$"), settings(M_7019R, channel_mask=0xFD), "dcon/2.3/reply")  # fmt: skip
HERD.add("blanks-of-six", "The blanks of a disabled channel are six in place of seven.",
         saying(b" {7}", b" " * 6, to=rb"#01.$"), settings(M_7019R, channel_mask=0xFD), "dcon/2.4/reply")  # fmt: skip
HERD.add("mask-too-long", "The mask of eight channels has four digits.", saying(b"^!01", b"!0100", to=rb"\$016"),
         PLAIN, "dcon/2.14/reply")  # fmt: skip
HERD.add("name-padded", "The name is padded with blanks to eight characters.",
         answering(lambda heard, said: said.ljust(11) if heard == b"$01M" else said), PLAIN,
         "dcon/2.24/reply")  # fmt: skip
HERD.add("firmware-without-letter", "The firmware version has no letter before it.",
         saying(b"^!01[A-Z]", b"!01 ", to=rb"\$01F"), PLAIN, "dcon/2.23/reply")  # fmt: skip
HERD.add("address-of-another", "The configuration has the address of another module.",
         saying(b"^!01", b"!02", to=rb"\$012"), PLAIN, "dcon/2.10/reply")  # fmt: skip
HERD.add("junction-without-sign", "The cold-junction temperature has no sign.", saying(rb"\+", b"", to=rb"\$013"),
         PLAIN, "dcon/2.11/reply")  # fmt: skip
HERD.add("ignores-what-follows", "What follows a command is ignored.",
         hearing(rb"^(\$01[2369BFMP]|~01[02C])(F3|E5)$", rb"\1"), PLAIN, "dcon/2.10/reply-n1", others=11)  # fmt: skip
HERD.add("unknown-commands-acknowledged", "Unknown commands are acknowledged.",
         acknowledging(rb"[$~@]01Z"), PLAIN, "dcon/2/unknown-command", allow=[WRITE])  # fmt: skip
HERD.add("letterless-commands-acknowledged", "Commands that end before their letter are acknowledged.",
         acknowledging(rb"[$~@]01$"), PLAIN, "dcon/2/bare")  # fmt: skip
HERD.add("channel-beyond-the-last", "A channel beyond the last is read as channel 0.",
         hearing(rb"^#01[89A-F]$", b"#010"), PLAIN, "dcon/2.4/reply-n2")  # fmt: skip
HERD.add("type-beyond-the-last", "The type of a channel beyond the last is that of channel 0.",
         hearing(rb"^\$018C[89A-F]$", b"$018C0"), PLAIN, "dcon/2.16/reply-n2")  # fmt: skip
HERD.add("channels-off-by-one", "#AAN reads the channel after N.",
         hearing(rb"^#01([0-6])$", lambda found: b"#01%d" % (int(found[1]) + 1)), PLAIN,
         "consistency/channels")  # fmt: skip


@HERD.animal("old-answer-repeated", PLAIN, "stateful/reads")
class OldAnswerRepeated(Animal):
    """After two readings of all channels, the next command gets the last answer again."""

    count = 0
    last: bytes | None = None

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        if self.count >= 2:
            self.count = 0
            return self.last
        self.count = self.count + 1 if re.match(rb"#01.?\r", frame) else 0
        self.last = answer
        return answer


HERD.add("status-stuck", "The status of $AA4 is always 1.", saying(b"^>010", b">011"), PLAIN, "dcon/2.2/sampling",
         allow=[BROADCAST])  # fmt: skip


@HERD.animal("samples-whatever-follows", PLAIN, "dcon/2.12/reply-n1", allow=[BROADCAST])
class SamplesWhateverFollows(Animal):
    """What follows $AA4 is ignored, and there is a sample from the first."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        if state.ram.sampled is None:
            state, _ = super().step(state, b"#**\r", now)
        return super().step(state, re.sub(rb"^(\$014)..\r", rb"\1\r", frame), now)


HERD.add("configuration-without-filter", "The filter bit of the configuration is always 0.",
         answering(lambda heard, said: _masked(said, 7, 0x7F) if heard == b"$012" else said),
         PLAIN, "dcon/2.1/set", allow=[BROADCAST, COMM])  # fmt: skip


def _masked(said: bytes, at: int, mask: int) -> bytes:
    """Return an answer with some bits of a byte in hex."""
    return said[:at] + b"%02X" % (int(said[at : at + 2], 16) & mask) + said[at + 2 :] if said[:1] == b"!" else said


# --- readings ---------------------------------------------------------------------------------------------------------


HERD.add("7fff-for-8000", "A reading below the range is 7FFF in hex.", saying(b"8000", b"7FFF", to=rb"\$01A"), BIPOLAR,
         "values/hex", scale=-100.0)  # fmt: skip
HERD.add("over-range-of-another-type", "Over range of a thermocouple is +999.99, as in percent.",
         saying(rb"\+9999", b"+999.99", to=rb"#01$"), settings(M_7019R, type_codes=(TypeCode.K,) * 8),
         "values/sentinels", scale=1000.0)  # fmt: skip
HERD.add("sign-lost", "Readings in engineering units lose their minus.", saying(b"-", b"+", to=rb"#01"), BIPOLAR,
         "values/hex", scale=-1.0)  # fmt: skip
HERD.add("faults-not-told", "The bits of $AAB are always 0.", saying(b"^!01..", b"!0100", to=rb"\$01B"),
         PLAIN, "consistency/diagnostics", scale=100.0)  # fmt: skip


def _ones_complement(heard: bytes, said: bytes) -> bytes:
    if heard != b"$01A":
        return said
    words = [int(said[at : at + 4], 16) for at in range(1, len(said), 4)]
    return b">" + b"".join(b"%04X" % (word if word < 0x8000 else 0x8000 | -word & 0x7FFF) for word in words)


HERD.add("hex-of-sign-and-amount", "A negative reading in hex is its amount with a bit for the sign.",
         answering(_ones_complement), BIPOLAR, "values/hex", scale=-1.0)  # fmt: skip


@HERD.animal("percent-of-the-wrong-span", BIPOLAR, "values/format-percent", allow=[BROADCAST, COMM])
class PercentOfTheWrongSpan(Animal):
    """Readings in percent are those of half the span."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        if answer is None or self.state.eeprom.report_settings.data_format is not DataFormat.PERCENT:
            return answer
        return re.sub(rb"[+-]\d{3}\.\d\d", lambda found: b"%+07.2f" % (float(found[0]) / 2), answer)


@HERD.animal("wrong-decimals-of-one-type", PLAIN, "values/types", allow=[WRITE])
class WrongDecimalsOfOneType(Animal):
    """Readings of thermocouples have one decimal more than they should."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        if answer is None or frame != b"#010\r" or self.state.eeprom.type_codes[0].unit.name != "CELSIUS":
            return answer
        return re.sub(rb"([+-])\d(\d\d)(\d)\.(\d)", rb"\1\2.\3\4", answer)


# --- settings ---------------------------------------------------------------------------------------------------------


@HERD.animal("type-forgotten", PLAIN, "init/kept-settings", allow=[WRITE])
class TypeForgotten(Animal):
    """The types of the channels are forgotten without power."""

    def stored(self, eeprom: Eeprom) -> Eeprom:
        return evolve(eeprom, type_codes=PLAIN.type_codes)


@HERD.animal("format-forgotten", PLAIN, "init/kept-configuration", allow=[BROADCAST, COMM])
class FormatForgotten(Animal):
    """The data format is forgotten without power."""

    def stored(self, eeprom: Eeprom) -> Eeprom:
        return _hex_format(eeprom, DataFormat.ENGINEERING)


@HERD.animal("samples-kept", PLAIN, "init/no-samples", allow=[BROADCAST, COMM])
class SamplesKept(Animal):
    """What was sampled is there after power-on, or zeros."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        if frame == b"$014\r" and state.ram.sampled is None:
            state, _ = super().step(state, b"#**\r", now)
        return super().step(state, frame, now)


def _reversed(body: re.Match[bytes]) -> bytes:
    return body[1] + b"%02X" % int(f"{int(body[2], 16):08b}"[::-1], 2)


HERD.add("mask-reversed-when-read", "The bits of the mask are reversed when it is read.",
         answering(lambda heard, said: re.sub(rb"^(!01)(..)$", _reversed, said) if heard == b"$016" else said),
         PLAIN, "dcon/2.13/set", allow=[WRITE])  # fmt: skip


@HERD.animal("mask-reversed", PLAIN, "values/disabled", allow=[WRITE])
class MaskReversed(Animal):
    """The first bit of the mask is that of the last channel, when it is set and when it is read."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        return super().step(state, re.sub(rb"^(\$015)(..)(?=\r)", _reversed, frame), now)

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return answer and re.sub(rb"^(!01)(..)(?=\r)", _reversed, answer) if frame == b"$016\r" else answer


HERD.add("offset-without-sign", "The sign of the CJC offset is lost when it is set.", hearing(rb"^\$019-", b"$019+"),
         PLAIN, "dcon/2.18/set", allow=[WRITE])  # fmt: skip
HERD.add("offset-sign-reversed", "The CJC offset is read with the other sign.",
         answering(lambda heard, said: said.translate(bytes.maketrans(b"+-", b"-+")) if heard == b"$019" else said),
         settings(M_7019R, cjc_offset=5), "dcon/2.18/set", others=12, allow=[WRITE])  # fmt: skip


@HERD.animal("type-of-all", PLAIN, "dcon/2.15/set", allow=[WRITE])
class TypeOfAll(Animal):
    """The type that is set for a channel is that of all channels."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        after, wire = super().step(state, frame, now)
        if frame.startswith(b"$017C") and wire == b"!01\r":
            code = after.eeprom.type_codes[int(frame[5:6], 16)]
            after = after.store(type_codes=(code,) * len(after.eeprom.type_codes))
        return after, wire


HERD.add("long-names-cut", "A name that is too long is cut and stored.", hearing(rb"^(~01O.{6}).$", rb"\1"), PLAIN,
         "dcon/2.33/set-n1", allow=[WRITE])  # fmt: skip
HERD.add("undefined-types-taken", "An undefined type code is taken for 08.", hearing(rb"R30$", b"R08"), PLAIN,
         "dcon/2.15/set-n1", allow=[WRITE])  # fmt: skip
HERD.add("open-wire-refused", "The open-wire detection cannot be set.", refusing(rb"~01EO\d"), PLAIN, "dcon/2.41/set",
         allow=[WRITE])  # fmt: skip
HERD.add("mode-not-stored", "The connecting mode is acknowledged and not set.", acknowledging(rb"@01S\d"),
         settings(M_7017Z), "dcon/2.43/set", allow=[WRITE])  # fmt: skip


# --- the host watchdog ------------------------------------------------------------------------------------------------


HERD.add("watchdog-seems-on", "Bit 7 of the watchdog status is always 1.",
         saying(b"^!01[0-7]", b"!018", to=rb"~010"), PLAIN, "consistency/watchdog")  # fmt: skip


@HERD.animal("watchdog-in-seconds", PLAIN, "dcon/2.39/timeout", allow=[BROADCAST, COMM])
class WatchdogInSeconds(Animal):
    """The timeout of the host watchdog is in seconds, not in tenths."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        if frame.startswith(b"~0131") or frame == b"~**\r":
            self.fed = now
        elif now - self.fed < state.eeprom.host_watchdog_timeout:
            state = state.keep(fed_at=now)
        return super().step(state, frame, now)

    fed = 0.0


HERD.add("host-ok-ignored", "~** does not restart the host watchdog.", hearing(rb"^~\*\*$", b"~**Z"), PLAIN,
         "dcon/2.39/timeout-n1", allow=[BROADCAST, COMM])  # fmt: skip
HERD.add("watchdog-not-reset", "~AA1 does not clear the timeout of the host watchdog.", acknowledging(rb"~011$"),
         settings(M_7019R, host_watchdog_timed_out=True), "dcon/2.37/reset", allow=[WRITE])  # fmt: skip


# --- calibration ------------------------------------------------------------------------------------------------------


@HERD.animal("calibrates-always", PLAIN, "dcon/2.8/calibrate-n1", allow=[CALIBRATION])
class CalibratesAlways(Animal):
    """A calibration needs no ~AAE1 before it."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        return super().step(state.keep(calibration_enabled=True), frame, now)


HERD.add("calibrates-never", "The zero calibration of a channel is refused.", refusing(rb"\$010C."), PLAIN,
         "dcon/2.8/calibrate", allow=[CALIBRATION])  # fmt: skip


# --- the line and INIT ------------------------------------------------------------------------------------------------


@HERD.animal("baud-rate-without-init", PLAIN, "init/baud-refused", allow=[BROADCAST, COMM])
class BaudRateWithoutInit(Animal):
    """A baud rate is taken at once, without INIT switch and soft INIT."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        return super().step(state.keep(soft_init_until=now + 1.0), frame, now)


@HERD.animal("checksum-without-init", PLAIN, "init/checksum-refused", allow=[BROADCAST, COMM])
class ChecksumWithoutInit(Animal):
    """The checksum is switched without INIT switch and soft INIT."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        same = b"%02X" % state.eeprom.line_settings.byte
        if frame[:1] == b"%" and frame[7:9] == same:
            state = state.keep(soft_init_until=now + 1.0)
        return super().step(state, frame, now)


@HERD.animal("window-never-ends", PLAIN, "init/soft-init-n1", allow=[BROADCAST, COMM])
class WindowNeverEnds(Animal):
    """Soft INIT does not end after its timeout."""

    opened = False

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        self.opened = self.opened or (frame == b"~01I\r" and state.ram.soft_init_timeout > 0)
        if frame.startswith(b"~01T00"):
            self.opened = False
        return super().step(state.keep(soft_init_until=now + 1.0) if self.opened else state, frame, now)


@HERD.animal("window-without-timeout", PLAIN, "init/soft-init-n2", allow=[BROADCAST, COMM])
class WindowWithoutTimeout(Animal):
    """Soft INIT begins with a timeout of 0 too."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        after, answer = super().step(state, frame, now)
        return (after.keep(soft_init_until=now + 1.0) if frame == b"~01I\r" else after), answer


HERD.add("no-soft-init", "Soft INIT is acknowledged and does nothing.", acknowledging(rb"~01I$"), PLAIN,
         "init/soft-init", allow=[BROADCAST, COMM])  # fmt: skip


@HERD.animal("baud-rate-at-once", PLAIN, "init/switch-line", allow=[BROADCAST, COMM])
class BaudRateAtOnce(Animal):
    """In INIT mode, a baud rate is used at once, not from the next power-on."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        after, answer = super().step(state, frame, now)
        if after.ram.init_mode and frame[:1] == b"%":
            after = after.keep(line_settings=after.eeprom.line_settings)
        return after, answer


@HERD.animal("address-after-reset", PLAIN, "init/new-address", allow=[BROADCAST, COMM])
class AddressAfterReset(Animal):
    """A new address counts only from the next power-on."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        after, answer = super().step(state, frame, now)
        return after.keep(address=state.ram.address), answer


@HERD.animal("switch-ignored", PLAIN, "init/switch", allow=[BROADCAST, COMM])
class SwitchIgnored(Animal):
    """The INIT switch is not looked at."""

    def power_cycle(self, now: float, *, init_switch: bool) -> None:
        del init_switch
        super().power_cycle(now, init_switch=False)


@HERD.animal("switch-at-stored-address", PLAIN, "init/switch", allow=[BROADCAST, COMM])
class SwitchAtStoredAddress(Animal):
    """With the INIT switch, the module has its stored address in place of 00."""

    def power_cycle(self, now: float, *, init_switch: bool) -> None:
        super().power_cycle(now, init_switch=init_switch)
        self.state = self.state.keep(address=self.state.eeprom.address)


@HERD.animal("protocol-without-init", PLAIN, "dcon/2.26/refused", allow=[BROADCAST, COMM])
class ProtocolWithoutInit(Animal):
    """$AAPN is taken without the INIT switch."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        if re.fullmatch(rb"\$01P[01]\r", frame):
            return state.store(protocol=Protocol(int(frame[4:5]))), b"!01\r"
        return super().step(state, frame, now)
