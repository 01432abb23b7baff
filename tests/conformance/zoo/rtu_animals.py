"""Firmware with bugs in Modbus RTU: CRC, units, functions, counts, exceptions, function 46h, registers, settings."""

# ruff: noqa: ARG001, ARG002, ARG005 - a bug rarely looks at all that it is given

from collections.abc import Callable

from attrs import evolve

from i7000 import DecodeError, Model, Protocol, modbus
from i7000.conformance.hazard import Hazard
from i7000.device import Eeprom, State
from tests.conformance.zoo.animal import Animal
from tests.conformance.zoo.species import (
    Herd,
    Kind,
    acknowledging,
    answering,
    hearing,
    refusing,
    saying,
    settings,
)

HERD = Herd()
BROADCAST, WRITE, COMM = Hazard.BROADCAST, Hazard.WRITE, Hazard.COMM
RTU = Protocol.MODBUS_RTU
PLAIN = settings(Model.M_7019R, RTU)
_RESERVED, _UNIT = b"\xf8", b"\x01"


# --- CRC and units ----------------------------------------------------------------------------------------------------


@HERD.animal("ignores-crc", PLAIN, "rtu/crc/wrong frame/rtu/crc-swapped", others=7)
class IgnoresCrc(Animal):
    """The CRC of a request is dropped, not compared."""

    def damaged(self, frame: bytes) -> bytes | None:
        return modbus.seal(frame[:-2]) if len(frame) > 4 else None


@HERD.animal("takes-swapped-crc", PLAIN, "frame/rtu/crc-swapped rtu/crc/wrong")
class TakesSwappedCrc(Animal):
    """A request whose CRC has its high byte first is carried out too."""

    def damaged(self, frame: bytes) -> bytes | None:
        swapped = frame[:-2] + frame[:-3:-1]
        return swapped if modbus.seal(frame[:-2]) == swapped else None


@HERD.animal("needs-no-crc", PLAIN, "rtu/crc/missing")
class NeedsNoCrc(Animal):
    """A request without a CRC is carried out."""

    def damaged(self, frame: bytes) -> bytes | None:
        return modbus.seal(frame) if len(frame) == 6 and frame[1] in range(1, 5) else None


@HERD.animal("sends-swapped-crc", PLAIN, "link/alive")
class SendsSwappedCrc(Animal):
    """The answers have the high byte of the CRC first."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return None if answer is None else answer[:-2] + answer[:-3:-1]


HERD.add("answers-foreign-units", "Requests to every unit are answered.", hearing(rb"^[\x02-\xf7]", _UNIT), PLAIN,
         "frame/rtu/address")  # fmt: skip
HERD.add("answers-unit-0", "Reads at address 0 are answered.", hearing(rb"^\x00(?=[\x04F])", _UNIT), PLAIN,
         "rtu/address/broadcast-read", allow=[BROADCAST])  # fmt: skip
HERD.add("answers-unit-248", "The reserved unit 248 is taken for its own.", hearing(rb"^\xf8", _UNIT), PLAIN,
         "rtu/address/reserved")  # fmt: skip
HERD.add("answers-broadcast-writes", "Writes at address 0 are answered.", hearing(rb"^\x00(?=\x05)", _UNIT), PLAIN,
         "rtu/address/broadcast-write", allow=[BROADCAST, WRITE])  # fmt: skip


@HERD.animal("answers-answers", PLAIN, "frame/rtu/answers-of-others")
class AnswersAnswers(Animal):
    """An exception of another unit is answered."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return modbus.seal(b"\1\x84\1") if len(frame) == 5 and frame[1] & 0x80 and frame[0] != 1 else answer


@HERD.animal("answers-fragments", PLAIN, "frame/rtu/truncated", others=2)
class AnswersFragments(Animal):
    """A request that is cut off is answered with exception 03."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return modbus.seal(b"\1\x84\3") if len(frame) == 4 and frame[2:] == b"\0\0" else answer

    def damaged(self, frame: bytes) -> bytes | None:
        return frame if len(frame) == 4 and frame[:2] == b"\1\4" else None

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        return (state, None) if len(frame) == 4 and frame[2:] == b"\0\0" else super().step(state, frame, now)


@HERD.animal("hangs-after-long-frames", PLAIN, "frame/rtu/long", others=2)
class HangsAfterLongFrames(Animal):
    """A frame that is longer than 256 bytes stops the firmware for ever."""

    hung = False

    def silence(self, now: float) -> bytes:
        self.hung = self.hung or len(self._heard) > 256
        answer = super().silence(now)
        return b"" if self.hung else answer


# --- functions and exceptions -----------------------------------------------------------------------------------------


def _exceptions(change: Callable[[bytes], bytes]) -> Kind:
    return answering(lambda heard, said: change(said) if len(said) == 3 and said[1] & 0x80 else said)


HERD.add("exceptions-without-bit-7", "An exception has the function code of the request.",
         _exceptions(lambda said: said[:1] + bytes((said[1] & 0x7F,)) + said[2:]), PLAIN,
         "rtu/function/unknown", others=40)  # fmt: skip
HERD.add("wrong-exception-for-counts", "A count of 0 or of too many is refused with exception 02.",
         answering(lambda heard, said: said[:2] + b"\2" if said[1:] == b"\x84\3" and len(heard) == 6 else said), PLAIN,
         "rtu/04/counts-n1")  # fmt: skip
HERD.add("wrong-exception-for-addresses", "A start that is not there is refused with exception 03.",
         answering(lambda heard, said: said[:2] + b"\3" if said[1:] == b"\x84\2" else said), PLAIN,
         "rtu/04/counts-n2", others=2)  # fmt: skip
HERD.add("wrong-exception-of-46h", "An unknown sub-function of 46h is refused with exception 03.",
         answering(lambda heard, said: said[:2] + b"\3" if said[1:] == b"\xc6\2" else said), PLAIN,
         "rtu/46/unknown", allow=[WRITE])  # fmt: skip


@HERD.animal("unknown-functions-ignored", PLAIN, "rtu/function/unknown")
class UnknownFunctionsIgnored(Animal):
    """An unknown function is not answered."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return None if answer and answer[2:3] == b"\1" and answer[1] & 0x80 else answer


HERD.add(
    "answers-with-another-function",
    "Function 04 is answered with function 03.",
    saying(rb"^(.)\x04", lambda found: found[1] + b"\3"),
    PLAIN,
    "map/input_register/analog_input rtu/04/counts",
    others=9,
)
HERD.add("bit-7-ignored", "A function code with bit 7 is carried out.",
         hearing(rb"^\x01([\x84\xc6])", lambda found: b"\1" + bytes((found[1][0] & 0x7F,))), PLAIN,
         "rtu/function/bit-7")  # fmt: skip
HERD.add("function-02-everywhere", "Function 02 reads coils where the firmware does not have it.",
         answering(lambda heard, said: b"\1\2\1\0" if said[1:2] == b"\x82" else said),
         settings(Model.M_7018R, RTU, "B1.0"), "rtu/function/absent")  # fmt: skip


# --- counts and lengths -----------------------------------------------------------------------------------------------


HERD.add("byte-count-off", "The byte count counts itself.",
         answering(lambda heard, said: said[:2] + bytes((said[2] + 1,)) + said[3:] if said[1:2] == b"\3" else said),
         PLAIN, "rtu/03/counts", others=45)  # fmt: skip
HERD.add("odd-bits-dropped", "The last byte of several bits is left out if it is not full.",
         answering(lambda heard, said: said[:2] + bytes((len(said[3:-1]),)) + said[3:-1]
                   if said[1:2] == b"\1" and heard[5] % 8 and heard[5] > 1 else said), PLAIN,
         "rtu/01/counts", others=6)  # fmt: skip
HERD.add("one-byte-of-bits-more", "Eight bits are answered in two bytes.",
         answering(lambda heard, said: said[:2] + b"\2" + said[3:] + b"\0"
                   if said[1:2] == b"\1" and heard[4:] == b"\0\x08" else said), PLAIN, "rtu/01/counts")  # fmt: skip


@HERD.animal("reads-one-more", PLAIN, "map/across/input_register-n1", others=2)
class ReadsOneMore(Animal):
    """A read may go one register beyond the last."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        after, answer = super().step(state, frame, now)
        count = int.from_bytes(frame[4:6], "big") - 1
        if answer and answer[1] == 0x84 and frame[1] == 4 and count > 0:
            shorter = frame[:4] + count.to_bytes(2, "big")
            _, less = super().step(state, modbus.seal(shorter), now)
            if less and less[1] == 4:
                answer = modbus.seal(less[:2] + bytes((less[2] + 2,)) + less[3:-2] + b"\0\0")
        return after, answer


HERD.add(
    "long-requests-taken",
    "A byte after a read is ignored.",
    hearing(rb"^(\x01[\x01-\x04]....)\x00$", rb"\1"),
    PLAIN,
    "rtu/04/length",
    others=3,
)
HERD.add(
    "gaps-read-as-zeros",
    "Registers that are not there are read as 0.",
    answering(lambda heard, said: heard[:2] + b"\2\0\0" if said[1:] == b"\x84\2" and heard[4:] == b"\0\1" else said),
    PLAIN,
    "map/gaps/input_register rtu/04/counts-n2",
)
HERD.add("holding-gaps-read-as-zeros", "Holding registers that are not there are read as 0.",
         answering(lambda heard, said: heard[:2] + b"\2\0\0"
                   if said[1:2] == b"\x83" and heard[4:] == b"\0\1" and len(heard) == 6 else said),
         PLAIN, "map/gaps/holding_register rtu/03/counts-n2")  # fmt: skip
HERD.add("coil-gaps-read-as-zeros", "Coils that are not there are read as 0.",
         answering(lambda heard, said: heard[:2] + b"\1\0"
                   if said[1:2] == b"\x81" and heard[4:] == b"\0\1" and len(heard) == 6 else said),
         PLAIN, "map/gaps/coil rtu/01/counts-n2")  # fmt: skip


# --- function 46h -----------------------------------------------------------------------------------------------------


HERD.add("reserved-byte-ignored", "The reserved byte of sub-function 05 may be anything.",
         hearing(rb"^\x01F\x05.$", b"\1F\5\0"), PLAIN, "rtu/46/05/reserved")  # fmt: skip
HERD.add("channel-beyond-the-last", "The type of a channel beyond the last is that of channel 0.",
         hearing(rb"^\x01F\x07\x00[\x08-\xff]$", b"\1F\7\0\0"), PLAIN, "rtu/46/07/channels-n1")  # fmt: skip
HERD.add("channels-off-by-one", "Sub-function 07 reads the type of the next channel.",
         hearing(rb"^\x01F\x07\x00([\x00-\x06])$", lambda found: b"\1F\7\0" + bytes((found[1][0] + 1,))),
         settings(Model.M_7019R, RTU, type_codes=(*PLAIN.type_codes[:7], PLAIN.type_codes[0].__class__(0x0F))),
         "rtu/46/07/channels")  # fmt: skip
HERD.add("name-too-short", "Sub-function 00 has three bytes of the name.",
         saying(rb"^(\x01F\x00...).", rb"\1"), PLAIN, "rtu/46/00/reply")  # fmt: skip
HERD.add("unknown-sub-functions-acknowledged", "Unknown sub-functions are acknowledged.",
         acknowledging(rb"\x01F[\x01\x0a\x1f\x7f]", 3), PLAIN, "rtu/46/unknown", allow=[WRITE])  # fmt: skip


# --- registers --------------------------------------------------------------------------------------------------------


def _bytes_swapped(heard: bytes, said: bytes) -> bytes:
    data = said[3:]
    pairs = b"".join(data[at : at + 2][::-1] for at in range(0, len(data), 2))
    return said[:3] + pairs if said[1:2] == b"\3" else said


HERD.add("register-bytes-swapped", "The low byte of a holding register comes first.", answering(_bytes_swapped), PLAIN,
         "map/holding_register/type_code map/holding_register/module_address", others=30)  # fmt: skip


def _words_swapped(heard: bytes, said: bytes) -> bytes:
    if heard[1:4] != b"\3\x01\xe2" or heard[4:] != b"\0\2":
        return said
    return said[:3] + said[5:7] + said[3:5]


HERD.add("names-of-others", "The registers of the name have that of another model.",
         answering(lambda heard, said: said[:3] + b"\x70\x17\0\0" if heard[1:] == b"\3\x01\xe2\0\2" else said), PLAIN,
         "map/holding_register/module_name")  # fmt: skip


HERD.add(
    "readings-shifted",
    "The input register of a channel alone is that of the next one.",
    hearing(rb"^\x01\x04\x00([\x00-\x06])\x00\x01$", lambda found: b"\1\4\0" + bytes((found[1][0] + 1,)) + b"\0\1"),
    PLAIN,
    "map/input_register/analog_input",
    others=2,
)
HERD.add(
    "single-reads-refused",
    "A register can only be read with its neighbours.",
    refusing(rb"\x01\x04\x00[\x00-\x07]\x00\x01"),
    PLAIN,
    "map/input_register/analog_input",
    others=10,
)
HERD.add("many-reads-refused", "More than seven registers cannot be read at once.",
         refusing(rb"\x01\x03..\x00[\x08-\x7d]", 3), PLAIN, "map/across/holding_register", others=9)  # fmt: skip


@HERD.animal("reset-status-stays", PLAIN, "map/coil/reset_status")
class ResetStatusStays(Animal):
    """The reset status is still 1 after it was read."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        after, answer = super().step(state, frame, now)
        return after.keep(reset_status_read=False), answer


HERD.add(
    "padding-bits-set",
    "The bits after the last coil are 1. That is legal, but strange.",
    answering(
        lambda heard, said: (
            said[:-1] + bytes((said[-1] | 0xFF << heard[5] % 8 & 0xFF,))
            if said[1:2] == b"\1" and heard[5] % 8 and len(heard) == 6
            else said
        )
    ),
    PLAIN,
    "rtu/01/padding",
    others=0,
)


# --- settings ---------------------------------------------------------------------------------------------------------


@HERD.animal("writes-forgotten", PLAIN, "map/write/type_code", allow=[WRITE], others=12)
class WritesForgotten(Animal):
    """A type that is written is acknowledged and not set."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        after, answer = super().step(state, frame, now)
        return (state if frame[:4] < b"\1\6\1\x08" and frame[:3] == b"\1\6\1" else after), answer


@HERD.animal("writes-reach-the-next", PLAIN, "map/write/cjc_offset", allow=[WRITE], others=12)
class WritesReachTheNext(Animal):
    """The offset of a channel that is written is that of the next channel."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        after, answer = super().step(state, frame, now)
        offsets = after.eeprom.channel_cjc_offsets
        if frame[:3] == b"\1\6\1" and after.eeprom != state.eeprom and offsets != state.eeprom.channel_cjc_offsets:
            after = after.store(channel_cjc_offsets=offsets[-1:] + offsets[:-1])
        return after, answer


HERD.add("offset-sign-lost", "The sign of the CJC offset of the module is lost when 46h/2C sets it.",
         hearing(rb"^\x01F\x2c\x00([\x80-\xff].)$", lambda found: b"\1F\x2c\0"
                 + (0x10000 - int.from_bytes(found[1], "big")).to_bytes(2, "big")), PLAIN, "rtu/46/2C/set",
         allow=[WRITE])  # fmt: skip
HERD.add("mask-bits-reversed", "The bits of the mask are reversed when 46h/26 sets it.",
         hearing(rb"^\x01F\x26(.)$", lambda found: b"\1F\x26" + bytes((int(f"{found[1][0]:08b}"[::-1], 2),))), PLAIN,
         "rtu/46/26/set", allow=[WRITE])  # fmt: skip
HERD.add("any-value-is-on", "A coil takes the value 0001 for FF00.", acknowledging(rb"\x01\x05..\x00\x01", 6), PLAIN,
         "rtu/05/values", allow=[WRITE])  # fmt: skip
HERD.add(
    "read-only-acknowledged",
    "Writes to the readings are acknowledged.",
    acknowledging(rb"\x01\x06\x00[\x00-\x1f]"),
    PLAIN,
    "map/read-only/holding_register/analog_input",
    allow=[WRITE],
)
HERD.add(
    "undefined-types-taken",
    "An undefined type code is acknowledged.",
    acknowledging(rb"\x01\x06\x01[\x00-\x07]\x00[\x1b\x1c]"),
    PLAIN,
    "map/write/type_code-n1",
    allow=[WRITE],
)
HERD.add(
    "bounds-one-too-wide",
    "A channel mask of 100h is acknowledged.",
    acknowledging(rb"\x01\x06\x01\xe9\x01\x00"),
    PLAIN,
    "map/write/channels-n1",
    allow=[WRITE],
)


@HERD.animal("format-not-used", PLAIN, "values/modbus-formats", allow=[WRITE], others=2)
class FormatNotUsed(Animal):
    """The data format of Modbus is stored, and the readings stay as they are."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        if frame[1:2] in {b"\3", b"\4"} and frame[2:4] < b"\0\x20":
            _, answer = super().step(state.store(modbus_data_format=PLAIN.modbus_data_format), frame, now)
            return state, answer
        return super().step(state, frame, now)


@HERD.animal("address-not-taken", PLAIN, "map/write/module_address", allow=[BROADCAST, COMM])
class AddressNotTaken(Animal):
    """A new address is acknowledged and not stored."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        after, answer = super().step(state, frame, now)
        return after.store(address=state.eeprom.address).keep(address=state.ram.address), answer


@HERD.animal("type-forgotten", PLAIN, "init/kept-register", allow=[WRITE])
class TypeForgotten(Animal):
    """The types of the channels are forgotten without power."""

    def stored(self, eeprom: Eeprom) -> Eeprom:
        return evolve(eeprom, type_codes=PLAIN.type_codes)


# --- time -------------------------------------------------------------------------------------------------------------


@HERD.animal("response-delay-ignored", settings(Model.M_7019R, RTU, response_delay=30), "timing/response-delay")
class ResponseDelayIgnored(Animal):
    """The answers come at once, whatever the response delay is."""

    def delay(self) -> float:
        return 0.0


@HERD.animal("gaps-ignored", PLAIN, "timing/broken", others=2)
class GapsIgnored(Animal):
    """A pause within a request does not end it."""

    ended_at = -1.0

    def hear(self, data: bytes, now: float) -> bytes:
        if now - self.ended_at > 0.13:
            self._heard = b""
        return super().hear(data, now)

    def silence(self, now: float) -> bytes:
        self.ended_at = now
        try:
            modbus.unseal(self._heard)
        except DecodeError:
            return b""
        return super().silence(now)
