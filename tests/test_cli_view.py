import io
import re
import threading
from collections.abc import Mapping, Sequence
from time import monotonic, sleep
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console
from rich.text import Text

import i7000
from i7000 import Fault, Firmware, LineSettings, Model, Profile, Protocol, ReportSettings, TypeCode, Unit
from i7000.cli.view import View
from i7000.device import Signal, Signals, State, factory, power_on
from i7000.simulator.observed import Change, Observed
from i7000.simulator.sources import Fixed, Noise, Ramp, Recorded, Sine, Sources
from tests.waiting import ENOUGH

HOT = (Signal(25.12, Unit.CELSIUS), Signal(1500.0, Unit.CELSIUS), Signal(-300.0, Unit.CELSIUS))
VOLT = Unit.VOLT
SOURCES = Sources((
    *map(Fixed, (*HOT, Signal(5.0, Unit.CELSIUS))),
    Ramp(0, 10, 60, VOLT), Sine(0, 1, 60, VOLT), Noise(0, 1, VOLT), Recorded((0,), (1,), VOLT),
))  # fmt: skip
NOISE = i7000.Noise(b"x", Fault.LEADING)
SIGNALS = Signals((*HOT, Signal(5.0, Unit.CELSIUS), Signal(1.5, Unit.VOLT)))


def module(model: Model = Model.M_7019R, **settings: Any) -> State:
    return power_on(evolve(factory(model, Firmware("B3.7")), **settings), now=0.0)


MIXED = module(type_codes=(TypeCode.K,) * 4 + (TypeCode.V_10,) * 4, channel_mask=0b1111_0111)
VOLTS = module(Model.I_7017, report_settings=ReportSettings(checksum=True), address=0x1F)
EVERY = (MIXED, VOLTS, module(Model.I_7018, host_watchdog_timed_out=True), module(Model.M_7017Z, single_ended=True))


Seen = Observed | Change


def drawn(  # noqa: PLR0913, PLR0917 - all but the first are options
    states: Sequence[State],
    seen: Sequence[Seen] = (),
    width: int = 140,
    height: int = 40,
    encoding: str = "utf-8",
    notices: Mapping[str, int] | None = None,
    prompt: str | None = None,
    sources: Sources = SOURCES,
) -> list[str]:
    file = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    console = Console(file=file, width=width, height=height, color_system=None)
    line = None if prompt is None else lambda: Text(prompt)
    view = View(lambda: [(state, SIGNALS, sources) for state in states], console, (), notices, line)
    for it in seen:
        if isinstance(it, Change):
            view.change(it)
        else:
            view.show(it)
    console.print(view)
    file.seek(0)
    return [line.rstrip() for line in file.read().splitlines()]


def heard(frame: bytes = b"#01\r", answer: bytes | None = None, at: float = 1.0, client: str = "pty") -> Observed:
    return Observed(at, client, frame, Protocol.DCON, Profile(Model.I_7018), answer)


# --- the modules ------------------------------------------------------------------------------------------------------


def test_a_module_has_a_heading_and_its_channels_with_type_reading_and_source() -> None:
    assert drawn([MIXED], width=80)[:5] == [
        "01  M-7019R@B3.7  RTU 9600 N81",
        " 0 K           25.1 degC  25.12degC    4 V_10       1.500 V     ramp",
        " 1 K     OVER_RANGE       1500degC     5 V_10       0.000 V     sine",
        " 2 K    UNDER_RANGE       -300degC     6 V_10       0.000 V     noise",
        " 3 K       disabled       5degC        7 V_10       0.000 V     csv",
    ]


def test_channels_stand_in_as_many_columns_as_there_is_room_for() -> None:
    assert [len(drawn([VOLTS], width=width)) for width in (30, 80, 120, 200)] == [10, 6, 5, 4]


def test_values_stay_in_their_columns_when_they_change() -> None:
    cold, hot = (
        drawn([module(type_codes=(TypeCode.K,) * 8)], sources=Sources((Fixed(None),) * 8), width=width)
        for width in (80, 80)
    )

    assert cold == hot


def test_an_input_without_a_source_is_open() -> None:
    assert drawn([VOLTS], sources=Sources(), width=30)[1].endswith("open")


def test_the_settings_are_those_of_now_and_not_those_of_after_power_on() -> None:
    state = MIXED.store(line_settings=LineSettings.from_byte(0x8A), protocol=Protocol.DCON)

    assert drawn([state])[0] == "01  M-7019R@B3.7  RTU 9600 N81"
    assert drawn([power_on(state.eeprom, now=0.0)])[0] == "01  M-7019R@B3.7  DCON 115200 E81 no checksum"
    assert drawn([VOLTS])[0] == "1F  I-7017@B3.7  DCON 9600 N81 checksum"


def test_a_baud_rate_that_no_module_has_is_shown_as_its_code() -> None:
    assert "code 3F N81" in drawn([MIXED.keep(line_settings=LineSettings(0x3F))])[0]


def test_a_watchdog_that_timed_out_is_marked() -> None:
    timed_out = module(host_watchdog_timed_out=True)

    assert drawn([timed_out])[0].endswith("  WATCHDOG TIMED OUT")
    assert "M-7019R@B3.7  WATCHDOG TIMED OUT  0.000, 0.000, " in drawn([timed_out], height=2)[0]


def test_a_module_in_init_mode_is_marked_and_has_address_00() -> None:
    assert drawn([power_on(MIXED.eeprom, init_switch=True, now=0.0)])[0] == (
        "00  M-7019R@B3.7  DCON 9600 N81 no checksum  INIT"
    )


def test_an_init_switch_that_waits_for_power_on_is_marked() -> None:
    assert drawn([MIXED.switched(init_switch=True)])[0].endswith("RTU 9600 N81  INIT switch on")


def test_only_the_channels_of_the_connecting_mode_are_shown() -> None:
    differential, single_ended = (drawn([module(Model.M_7017Z, single_ended=mode)]) for mode in (False, True))

    assert len(re.findall(r"\d\.\d{3} V", "".join(differential))) == 10
    assert len(re.findall(r"\d\.\d{3} V", "".join(single_ended))) == 20


def test_modules_that_have_no_room_are_shown_in_a_line_each_and_the_rest_counted() -> None:
    rows = drawn([module(address=at) for at in range(32)], [heard()] * 30, width=80, height=24)

    assert len(rows) == 24
    assert [row[:2] for row in rows[:14]] == [f"{at:02X}" for at in range(14)]
    assert all(len(row) <= 80 for row in rows)
    assert rows[14] == "and 18 more modules"
    assert rows[15] == "on the line  requests 30"
    assert rows[-1].endswith("silence")


def test_a_line_that_is_cut_shows_it() -> None:
    rows = drawn(EVERY, width=50, height=7)

    assert rows[0] == "01  M-7019R@B3.7  25.1 degC, OVER_RANGE, UNDER_..."
    assert len(rows[0]) == 50


def test_a_bus_without_modules_is_shown() -> None:
    assert drawn([])[-1] == "on the line  nothing yet"


def test_where_hosts_find_the_bus_stays_in_view() -> None:
    console = Console(file=io.StringIO(), width=140, height=40, color_system=None)
    with console.capture() as captured:
        console.print(View(list, console, ("/dev/pts/7", "socket://127.0.0.1:5020")))

    assert captured.get().splitlines()[-1].split("  ") == [
        "on the line",
        "/dev/pts/7",
        "socket://127.0.0.1:5020",
        "nothing yet",
    ]


def test_notices_are_shown_with_how_often_they_came() -> None:
    notices: dict[str, int] = {}
    console = Console(file=io.StringIO(), width=60, height=40, color_system=None)
    view = View(list, console, (), notices)
    notices |= {"a connection was refused: 64 are open": 3, "an answer was lost: its host does not read": 1}
    view.show(heard())
    with console.capture() as captured:
        console.print(view)

    assert captured.get().splitlines()[-4:-1] == [
        "on the line  requests 1",
        "a connection was refused: 64 are open (3 times)",
        "an answer was lost: its host does not read",
    ]


def test_what_was_on_the_line_is_counted() -> None:
    noise = Observed(1.0, "pty", NOISE, Protocol.DCON, None, None, ("byte 1 lost", "byte 2 lost"))
    rows = drawn([], [heard(), heard(answer=b"!01\r"), noise])

    assert rows[0] == "on the line  requests 2  answers 1  faults 2  noise 1"


def test_changes_of_modules_stand_among_the_traffic() -> None:
    change = Change(1.0, 1, Model.I_7018, ("watchdog tripped",), stored=True)

    assert drawn([], [change]) == ["on the line", "     1.000  01 I-7018  EEPROM: watchdog tripped"]


def test_the_prompt_is_the_last_line_of_the_screen() -> None:
    rows = drawn([MIXED], [heard()], height=20, prompt="q quit")
    small = drawn([MIXED] * 9, [heard()] * 30, height=10, prompt="q quit \x1b[2J")

    assert (len(rows), rows[-1]) == (20, "q quit")
    assert (len(small), small[-1]) == (10, r"q quit \x1b[2J")


# --- the traffic ------------------------------------------------------------------------------------------------------


def test_the_last_that_was_on_the_line_stands_at_the_bottom() -> None:
    rows = drawn([MIXED], [heard(at=at / 10) for at in range(1000)], height=20)

    assert len(rows) == 20
    assert [row[:12].strip() for row in rows[-3:]] == ["99.700", "99.800", "99.900"]


def test_a_long_line_is_folded_beside_its_time() -> None:
    rows = drawn([MIXED], [heard(b"$012\r", b"!010E0642\r")], width=60)

    at = next(number for number, row in enumerate(rows) if row.startswith("     1.000"))
    assert all(row.startswith(" " * 12 + row[12]) for row in rows[at + 1 :])
    assert len(rows) > at + 2


def test_on_a_very_narrow_terminal_lines_are_folded_from_the_left() -> None:
    rows = drawn([MIXED], [heard(b"$012\r", b"!010E0642\r")], width=30)

    assert "1.000  pty  -> $012" in rows
    assert any(row.startswith("<- !010E0642") for row in rows)


def test_no_control_character_reaches_the_terminal() -> None:
    text = "".join(drawn([MIXED], [heard(b"$\x1b[2J\r", b"\x07\x9b\r", client="\x1b]0;x\x07")]))

    assert text.isprintable()
    assert r"\x1b[2J" in text


def test_what_the_terminal_cannot_write_is_escaped() -> None:
    rows = drawn([MIXED], [heard(client="/dev/☃")], encoding="ascii")

    assert r"/dev/\u2603" in rows[-1]


@given(
    st.lists(st.sampled_from(EVERY), max_size=12),
    st.integers(0, 40),
    st.integers(0, 4),
    st.integers(1, 160),
    st.integers(1, 40),
    st.none() | st.text(max_size=200),
)
def test_a_view_fits_every_terminal(  # noqa: PLR0913, PLR0917 - all that a view shows
    states: list[State], frames: int, notices: int, width: int, height: int, prompt: str | None
) -> None:
    seen = [heard(b"$012\r", b"!010E0642\r", at=at) for at in range(frames)]

    rows = drawn(
        states, seen, width, height, notices={f"an answer was lost {at}": at for at in range(notices)}, prompt=prompt
    )

    assert len(rows) <= height
    assert all(len(row) <= width for row in rows)


# --- live -------------------------------------------------------------------------------------------------------------


class Terminal(io.StringIO):
    """A terminal that counts how often it is drawn on."""

    def __init__(self) -> None:
        super().__init__()
        self.written = threading.Event()

    def flush(self) -> None:
        super().flush()
        if "ReadAnalogInputs" in self.getvalue():
            self.written.set()


def live(terminal: io.StringIO, *, force_terminal: bool = True) -> View:
    console = Console(file=terminal, force_terminal=force_terminal, width=100, height=30, legacy_windows=False)
    return View(lambda: [(MIXED, SIGNALS, SOURCES)], console)


def test_what_is_shown_appears_and_the_terminal_is_left_as_it_was() -> None:
    terminal = Terminal()
    with live(terminal) as view:
        view.show(heard())
        appeared = terminal.written.wait(ENOUGH)
    text = terminal.getvalue()

    assert appeared
    assert "M-7019R@B3.7" in text
    assert text.count("\x1b[?1049h") == text.count("\x1b[?1049l") == 1
    assert text.count("\x1b[?25l") == text.count("\x1b[?25h")
    assert text.rindex("\x1b[?1049l") > text.rindex("ReadAnalogInputs")
    assert text.rindex("\x1b[?25h") > text.rindex("ReadAnalogInputs")


def test_it_is_drawn_at_once_if_asked_to() -> None:
    terminal = Terminal()
    with live(terminal) as view:
        view.show(heard())
        view.refresh()

        assert "ReadAnalogInputs" in terminal.getvalue()


def test_the_terminal_is_left_as_it_was_after_an_error_too() -> None:
    terminal = Terminal()
    with pytest.raises(KeyboardInterrupt), live(terminal):
        raise KeyboardInterrupt

    assert terminal.getvalue().endswith("\x1b[?25h\x1b[?1049l")


def test_it_is_drawn_four_times_a_second_at_most() -> None:
    terminal = Terminal()
    began = monotonic()
    with live(terminal) as view:
        while monotonic() < began + 1.1:
            view.show(heard())
            sleep(0.001)
    took = monotonic() - began

    assert 2 <= terminal.getvalue().count("on the line") <= 2 + 4 * took


def test_a_terminal_that_is_stopped_holds_up_nobody() -> None:
    going_on = threading.Event()
    stopped = threading.Event()

    class Stopped(io.StringIO):
        def write(self, text: str) -> int:
            if threading.current_thread() is not threading.main_thread():
                stopped.set()
                going_on.wait(ENOUGH)
            return super().write(text)

    with live(Stopped()) as view:
        assert stopped.wait(ENOUGH)
        observed = heard()
        began = monotonic()
        for _ in range(1000):
            view.show(observed)
        took = monotonic() - began
        going_on.set()

    assert took < 1


def test_nothing_is_written_to_what_is_no_terminal() -> None:
    file = io.StringIO()
    with live(file, force_terminal=False) as view:
        view.show(heard())

    assert file.getvalue() == ""
