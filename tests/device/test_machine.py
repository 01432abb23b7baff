"""A module is driven through both doors, and held at every step against the plain rules of `tests.device.oracle`."""

from collections.abc import Callable
from contextlib import suppress

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, precondition, rule

from i7000 import Firmware, Model, Unit
from i7000.device import Signal, Signals, advance, factory, power_on, step
from tests.device import modbus_oracle
from tests.device.oracle import HAVE, MODELS, VERSIONS, Oracle, sealed

pytestmark = pytest.mark.no_cover

# --- what is said -----------------------------------------------------------------------------------------------------

Part = Callable[[Oracle], st.SearchStrategy[str]]


def hexadecimal(low: int, high: int, digits: int = 2) -> st.SearchStrategy[str]:
    return st.integers(low, high).map(lambda number: f"{number:0{digits}X}")


def mostly(usual: st.SearchStrategy[str], odd: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.sampled_from((usual, usual, usual, odd)).flatmap(lambda choice: choice)


def letters(*choices: str) -> Part:
    return lambda _: st.sampled_from(choices)


BYTE = hexadecimal(0, 0xFF)
FLAG = letters("0", "1", "1", "0", "2")


def channel(it: Oracle) -> st.SearchStrategy[str]:
    return mostly(hexadecimal(0, it.channels, 2 if it.single_ended else 1), hexadecimal(0, 0x15))


def mask(it: Oracle) -> st.SearchStrategy[str]:
    return mostly(hexadecimal(0, (1 << it.channels) - 1, it.mask_digits), hexadecimal(0, 0xFFFFFF, 4))


def type_code(it: Oracle) -> st.SearchStrategy[str]:
    return mostly(st.sampled_from([*it.row["types"], "FF"]), BYTE)


def line(it: Oracle) -> st.SearchStrategy[str]:
    return mostly(st.sampled_from((f"{it.line:02X}", f"{it.line:02X}", "06", "07", "8A")), BYTE)


def report(it: Oracle) -> st.SearchStrategy[str]:
    return mostly(st.sampled_from([f"{it.report ^ bit:02X}" for bit in (0, 0, 1, 2, 0x20, 0x40, 0x80)]), BYTE)


def new_address(it: Oracle) -> st.SearchStrategy[str]:
    return mostly(st.just(f"{it.stored_address:02X}"), BYTE)


COMMANDS: dict[str, tuple[str, tuple[Part, ...]]] = {
    "2.1": ("%", (new_address, type_code, line, report)), "2.3": ("#", ()), "2.4": ("#", (channel,)),
    "2.5": ("$0", ()), "2.6": ("$1", ()), "2.7": ("$0C", (channel,)), "2.8": ("$0C", (channel,)),
    "2.9": ("$1C", (channel,)), "2.10": ("$2", ()), "2.11": ("$3", ()), "2.12": ("$4", ()), "2.13": ("$5", (mask,)),
    "2.14": ("$6", ()), "2.15": ("$7C", (channel, letters("R"), type_code)), "2.16": ("$8C", (channel,)),
    "2.17": ("$9", ()), "2.18": ("$9", (letters("+", "-"), lambda _: hexadecimal(0, 0x1001, 4))), "2.19": ("$A", ()),
    "2.20": ("$A", ()), "2.21": ("$A", (FLAG,)), "2.22": ("$B", ()), "2.23": ("$F", ()), "2.24": ("$M", ()),
    "2.25": ("$P", ()), "2.26": ("$P", (FLAG,)), "2.27": ("$S0", ()), "2.28": ("$S1", ()), "2.29": ("~C", ()),
    "2.30": ("~C", (FLAG,)), "2.31": ("~E", (FLAG,)), "2.32": ("~I", ()),
    "2.33": ("~O", (lambda _: st.text(st.characters(min_codepoint=0x1F, max_codepoint=0x7F), max_size=7),)),
    "2.34": ("~T", (lambda _: hexadecimal(0, 0x3D),)), "2.36": ("~0", ()), "2.37": ("~1", ()), "2.38": ("~2", ()),
    "2.39": ("~3", (FLAG, lambda _: hexadecimal(0, 0xFF))), "2.40": ("~EO", ()), "2.41": ("~EO", (FLAG,)),
    "2.42": ("@S", ()), "2.43": ("@S", (FLAG,)),
}  # fmt: skip
"""Of each section the letters around the address, and what follows."""
READERS = [
    command for command, parts in COMMANDS.values() if not parts and command[1:] not in ("0", "1", "S0", "S1", "I")
]


@st.composite
def commands(draw: st.DrawFn, it: Oracle, address: int | None = None) -> str:
    own = it.address if address is None else address
    has = [section for section in COMMANDS if it.has(HAVE[section])]
    command, parts = COMMANDS[draw(st.sampled_from((*has, *has, *COMMANDS)))]
    return f"{command[0]}{own:02X}{command[1:]}" + "".join(draw(part(it)) for part in parts)


ITEM = st.sampled_from((0, 1, 2, 3, 7, 0xFF, 0x1000, 0xF000, 0xFFFF)) | st.integers(0, 300) | st.integers(0, 0xFFFF)
SUB_FUNCTIONS = b"\x00\x04\x05\x06\x07\x08\x20\x25\x26\x29\x2a\x2b\x2c\x2d\x2e\x2f\x30"
LENGTHS = dict(zip(SUB_FUNCTIONS, (0, 4, 1, 8, 2, 3, 0, 0, 1, 0, 1, 1, 3, 1, 2, 0, 1), strict=True))
SMALL = st.sampled_from((0, 0, 0, 1, 1, 2, 6, 7, 8, 0x0A, 0x20, 0x80, 0x83)) | st.integers(0, 0xFF)
AREAS = {
    0x01: "coil", 0x02: "discrete_input", 0x03: "holding_register", 0x04: "input_register",
    0x05: "coil", 0x06: "holding_register", 0x0F: "coil", 0x10: "holding_register",
}  # fmt: skip


def words(*numbers: int) -> bytes:
    return b"".join(number.to_bytes(2, "big") for number in numbers)


def legal_items(it: Oracle, register: int) -> st.SearchStrategy[int]:
    row, _ = modbus_oracle.places(it, "holding_register", "W").get(register, ({"minimum": 0, "maximum": 3}, 0))
    if row.get("name") in ("type_code", "module_type_code"):
        return st.sampled_from([int(code, 16) for code in it.row["types"]])
    high = 0xFFFF if row["maximum"] is None else row["maximum"]
    return st.integers(row["minimum"] or 0, high).map(lambda number: number & 0xFFFF)


@st.composite
def requests(draw: st.DrawFn, oracle: Oracle) -> bytes:
    """Requests of every function, without address and CRC; mostly of what is there."""
    function = draw(st.sampled_from((0x46, 0x46, *AREAS)))
    if function == 0x46:
        sub = draw(st.sampled_from(SUB_FUNCTIONS))
        length = LENGTHS[sub] + (oracle.mask_digits // 2 - 1 if sub == 0x26 else 0)
        return bytes((function, sub, *(draw(SMALL) for _ in range(length))))
    there = sorted(modbus_oracle.places(oracle, AREAS[function], "R" if function < 5 else "W")) or [0]
    start = draw(st.sampled_from(there) | ITEM)
    if function < 5:
        return bytes((function,)) + words(start, draw(st.integers(0, 20)))
    if function == 0x05:
        return bytes((function,)) + words(start, draw(st.sampled_from((0xFF00, 0x0000, 0xFF00, 0x0000, 0x0001))))
    if function == 0x06:
        return bytes((function,)) + words(start, draw(ITEM | legal_items(oracle, start)))
    items = draw(st.lists(ITEM, min_size=1, max_size=12))
    count = len(items)
    if function == 0x10:
        return bytes((function,)) + words(start, count) + bytes((2 * count,)) + words(*items)
    data = (draw(st.integers(0, (1 << count) - 1))).to_bytes((count + 7) // 8, "little")
    return bytes((function,)) + words(start, count) + bytes((len(data),)) + data


@st.composite
def damaged(draw: st.DrawFn, frame: bytes) -> bytes:
    at, byte = draw(st.integers(0, len(frame) - 1)), draw(st.integers(0, 0xFF))
    end = draw(st.sampled_from((frame[at:], frame[at + 1 :], b"")))
    return frame[:at] + bytes((byte,)) + end if draw(st.booleans()) else frame[:at] + end


# --- the machine ------------------------------------------------------------------------------------------------------

LEVELS = st.sampled_from((0.0, 1.0, -1.0, 10.0, 60.0, -60.0, 499.0, 625.0, 1000.0, 2500.0, -4000.0, 5100.0, 150_000.0))
DEGREES = st.sampled_from((0.0, 25.0, 25.5, -12.25, -250.0, 100.0, 399.5, 1000.0, 2400.0))
INPUT = st.none() | st.tuples(st.just("mV"), LEVELS) | st.tuples(st.just("degC"), DEGREES)
RICH = ["I-7019R", "M-7019R", "M-7019Z", "M-7017Z", "M-7017mC-16", "M-7017R", "M-7017RMS", "M-7018R"]
"""Models that have much that others have not."""
UNITS = {"mV": Unit.MILLIVOLT, "degC": Unit.CELSIUS}


class Module(RuleBasedStateMachine):
    """The model and the oracle, which hear the same."""

    @initialize(
        model=st.sampled_from(sorted(MODELS) + RICH * 3), firmware=st.sampled_from(VERSIONS[::-1]), dcon=st.booleans()
    )
    def leave_the_factory(self, model: str, firmware: str, *, dcon: bool) -> None:
        self.oracle = Oracle(model, firmware)
        self.state = power_on(factory(Model(model), Firmware(firmware)), now=0.0)
        if dcon and self.oracle.protocol == "modbus":
            self.the_protocol_is_changed(address=1, line=0x06)

    @property
    def signals(self) -> Signals:
        signals = (None if it is None else Signal(it[1], UNITS[it[0]]) for it in self.oracle.signals)
        return Signals(tuple(signals), cold_junction=self.oracle.ambient)

    def send(self, frame: bytes) -> bytes | None:
        """Give a frame to both: the responses are equal, and a refused one changes nothing."""
        before = advance(self.state, self.signals, self.oracle.now)
        modbus = self.oracle.protocol == "modbus"
        expected = modbus_oracle.hear(self.oracle, frame) if modbus else self.oracle.hear(frame)
        self.state, actual = step(self.state, frame, self.signals, self.oracle.now)
        assert expected == actual, f"{frame!r}: {expected!r} expected, {actual!r} said by {self.oracle.model}"
        heard = actual is None and (frame[:1] == b"\x00" if modbus else frame[1:3] == b"**")
        refused = actual is not None and (actual[1] & 0x80 if modbus else actual[:1] == b"?")
        if refused or (actual is None and not heard):
            assert before == self.state
        return actual

    def say(self, body: str) -> None:
        self.send(sealed(body, checksum=self.oracle.checksum))

    def ask(self, function: int, *numbers: int) -> bytes | None:
        return self.send(modbus_oracle.sealed(bytes((self.oracle.address, function)) + words(*numbers)))

    def write(self, name: str, value: int) -> None:
        """Write a coil or register by its name, if the module has it."""
        for function, area in ((0x05, "coil"), (0x06, "holding_register")):
            for address, (row, at) in modbus_oracle.places(self.oracle, area, "W").items():
                if row["name"] == name and at == 0:
                    self.ask(function, address, 0xFF00 * value if function == 0x05 else value)

    # --- anything ---------------------------------------------------------------------------------------------------

    @precondition(lambda self: self.oracle.protocol == "modbus")
    @rule(data=st.data(), address=st.sampled_from((None, None, None, 0, 2)))
    def a_request(self, data: st.DataObject, address: int | None) -> None:
        own = self.oracle.address if address is None else address
        frame = modbus_oracle.sealed(bytes((own,)) + data.draw(requests(self.oracle)))
        with suppress(modbus_oracle.UnsaidError):
            self.send(frame)

    @precondition(lambda self: self.oracle.protocol == "dcon")
    @rule(data=st.data())
    def a_command(self, data: st.DataObject) -> None:
        self.say(data.draw(commands(self.oracle)))

    @rule(data=st.data(), address=st.integers(0, 0xFF), broadcast=st.sampled_from(("#**", "~**")))
    def something_else(self, data: st.DataObject, address: int, broadcast: str) -> None:
        request = bytes((self.oracle.address,)) + data.draw(requests(self.oracle))
        checksum = self.oracle.checksum
        frame = data.draw(
            st.sampled_from(
                (
                    sealed(broadcast, checksum=checksum),
                    sealed(broadcast, checksum=not checksum),
                    sealed(data.draw(commands(self.oracle, address)), checksum=checksum),
                    data.draw(damaged(sealed(data.draw(commands(self.oracle)), checksum=checksum))),
                    data.draw(damaged(modbus_oracle.sealed(request))),
                    modbus_oracle.sealed(data.draw(damaged(request))),
                )
            )
        )
        with suppress(modbus_oracle.UnsaidError):
            self.send(frame)

    # --- what happens to it -----------------------------------------------------------------------------------------

    @rule(data=st.data())
    def time_passes(self, data: st.DataObject) -> None:
        it = self.oracle
        ends = [end for end in (it.fed_at + it.timeout / 10, it.soft_until) if end >= it.now]
        self.oracle.tick(data.draw(st.sampled_from([it.now + 0.125, it.now + 1.0, it.now + 16.0, *ends])))
        self.state = advance(self.state, self.signals, self.oracle.now)

    @rule(switch=st.booleans())
    def the_switch_is_moved(self, *, switch: bool) -> None:
        self.oracle.switch = switch
        self.state = self.state.switched(init_switch=switch)

    @rule(switch=st.sampled_from((False, False, True)))
    def the_power_goes_and_comes(self, *, switch: bool) -> None:
        self.oracle.switch = switch
        self.oracle.power_on()
        self.state = power_on(self.state.eeprom, init_switch=switch, now=self.oracle.now)

    @rule(signals=st.lists(INPUT, min_size=1, max_size=4), ambient=st.sampled_from((25.0, 25.0, 0.0, -10.5, 60.25)))
    def the_inputs_change(self, signals: list[tuple[str, float] | None], ambient: float) -> None:
        self.oracle.signals = [signals[at % len(signals)] for at in range(self.oracle.inputs)]
        self.oracle.ambient = ambient
        self.all_is_read()

    # --- what belongs together --------------------------------------------------------------------------------------

    @rule(address=st.sampled_from((1, 2, 0xF7)), line=st.sampled_from((0x06, 0x07, 0x0A)))
    def the_protocol_is_changed(self, address: int, line: int) -> None:
        """By the switch and ``$AAPN``, or by Modbus; and the address, so that it can be reached by both."""
        if self.oracle.protocol == "modbus":
            self.send(modbus_oracle.sealed(bytes((self.oracle.address, 0x46, 4, address, 0, 0, 0))))
            own = self.oracle.address
            self.send(modbus_oracle.sealed(bytes((own, 0x46, 6, 0, line, 0, 0, 0, 0, 0, 0))))
        else:
            self.the_switch_is_moved(switch=True)
            own = self.oracle.address
            self.say(f"%{own:02X}{address:02X}{self.oracle.module_type:02X}{line:02X}{self.oracle.report:02X}")
            self.say(f"${self.oracle.address:02X}P1")
        self.the_power_goes_and_comes(switch=False)

    @precondition(lambda self: self.oracle.protocol == "dcon")
    @rule(code=st.sampled_from(("0", "1")), switch=st.booleans())
    def the_switch_permits_a_protocol(self, code: str, *, switch: bool) -> None:
        self.the_switch_is_moved(switch=switch)
        self.say(f"${self.oracle.address:02X}P{code}")
        self.say(f"${self.oracle.address:02X}P")

    @precondition(lambda self: self.oracle.protocol == "dcon" and self.oracle.has(HAVE["2.32"]))
    @rule(
        data=st.data(),
        seconds=st.integers(0, 16),
        between=st.sampled_from(("", "", "$2", "~0", "~I")),
        late=st.booleans(),
    )
    def line_or_checksum_is_changed_by_soft_init(
        self, data: st.DataObject, seconds: int, between: str, *, late: bool
    ) -> None:
        self.the_switch_is_moved(switch=False)
        for command in (f"~T{seconds:02X}", "~I", between):
            if command:
                self.say(f"{command[0]}{self.oracle.address:02X}{command[1:]}")
        self.oracle.tick(self.oracle.now + seconds - (0 if late else 0.5 * (seconds > 0)))
        own, line = self.oracle.address, data.draw(st.sampled_from((self.oracle.line, self.oracle.line ^ 1)))
        report = self.oracle.report ^ data.draw(st.sampled_from((0x00, 0x40)))
        self.say(f"%{own:02X}{own:02X}{self.oracle.module_type:02X}{line:02X}{report:02X}")

    @rule(timeout=st.integers(0, 0xFF), share=st.sampled_from((0.5, 0.99, 1.0)), fed=st.booleans())
    def the_host_watchdog_waits(self, timeout: int, share: float, *, fed: bool) -> None:
        """Twice for a part of its time-out; between, the host may give a sign of life."""
        if self.oracle.protocol == "modbus":
            self.write("host_watchdog_timeout", timeout)
            self.write("host_watchdog_enabled", 1)
        else:
            self.say(f"~{self.oracle.address:02X}31{timeout:02X}")
        self.oracle.tick(self.oracle.now + share * timeout / 10)
        if fed and self.oracle.protocol == "dcon":
            self.say("~**")
        elif fed:
            self.ask(0x03, 484, 1)
        self.oracle.tick(self.oracle.now + share * timeout / 10)
        self.the_watchdog_is_read()

    def the_watchdog_is_read(self) -> None:
        if self.oracle.protocol == "modbus":
            self.ask(0x01, 260, 1)
            self.ask(0x01, 269, 1)
            self.ask(0x03, 491, 1)
        else:
            self.say(f"~{self.oracle.address:02X}0")

    @rule(updates=st.lists(st.integers(0, 2), min_size=1, max_size=3))
    def the_cold_junction_is_held(self, updates: list[int]) -> None:
        """While its temperature changes."""
        for update in updates:
            self.oracle.ambient += 1.5
            if self.oracle.protocol == "modbus":
                self.send(modbus_oracle.sealed(bytes((self.oracle.address, 0x46, 0x30, update))))
            else:
                self.say(f"${self.oracle.address:02X}A{update}")
        self.oracle.ambient -= 3.25
        self.all_is_read()

    @rule(data=st.data(), channel=st.integers(0, 8), offset=st.integers(0, 0xFF), signal=INPUT)
    def a_channel_is_set(
        self, data: st.DataObject, channel: int, offset: int, signal: tuple[str, float] | None
    ) -> None:
        it = self.oracle
        code = int(data.draw(st.sampled_from(sorted(it.row["types"], reverse=True))), 16)
        if it.protocol == "modbus":
            at = channel if it.individual else 0
            for body in (bytes((8, 0, at, code)), bytes((0x2C, 0x80 + channel, 0, offset))):
                self.send(modbus_oracle.sealed(bytes((it.address, 0x46)) + body))
        else:
            number = f"{channel:0{2 if it.single_ended else 1}X}"
            self.say(f"${it.address:02X}7C{number}R{code:02X}")
            everywhere = code if channel == 8 else 0xFF
            self.say(f"%{it.address:02X}{it.stored_address:02X}{everywhere:02X}{it.line:02X}{it.report:02X}")
        it.signals[channel % it.inputs] = signal
        self.all_is_read()

    @precondition(lambda self: self.oracle.protocol == "dcon")
    @rule(signal=INPUT, samples=st.sampled_from((1, 1, 2, 0)))
    def a_sample_is_read_twice(self, signal: tuple[str, float] | None, samples: int) -> None:
        for _ in range(samples):
            self.say("#**")
            self.oracle.signals[0] = signal
            for _ in range(2):
                self.say(f"${self.oracle.address:02X}4")

    @precondition(lambda self: self.oracle.model.endswith("7017Z"))
    @rule(mask=st.integers(0, 0xFFFFF), single_ended=st.booleans())
    def the_connecting_mode_is_changed(self, mask: int, *, single_ended: bool) -> None:
        if self.oracle.protocol == "modbus":
            self.write("single_ended", single_ended)
            self.write("channel_mask", mask & 0xFFFF)
            self.write("channel_mask_high", mask >> 16)
        else:
            self.say(f"@{self.oracle.address:02X}S{single_ended:d}")
            own = mask & (1 << self.oracle.channels) - 1
            self.say(f"${self.oracle.address:02X}5{own:0{self.oracle.mask_digits}X}")
        self.all_is_read()

    @rule()
    def all_is_read(self) -> None:
        if self.oracle.protocol == "modbus":
            for function in (0x01, 0x02, 0x03, 0x04):
                for start in modbus_oracle.places(self.oracle, AREAS[function], "R"):
                    with suppress(modbus_oracle.UnsaidError):
                        self.ask(function, start, 1)
            return
        for command in READERS:
            self.say(f"{command[0]}{self.oracle.address:02X}{command[1:]}")


TestModule = Module.TestCase
TestModule.settings = settings(max_examples=settings().max_examples * 2, stateful_step_count=30)
