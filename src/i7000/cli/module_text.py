"""The modules of a live view in lines: with every channel where there is room, else one line for each module."""

from collections.abc import Iterator, Sequence

from attrs import frozen
from rich.text import Text

from i7000 import BaudRate, LineSettings, Protocol
from i7000.cli.traffic import reading_text, readings_text
from i7000.device import Signals, State
from i7000.device.measurement import readings
from i7000.simulator.sources import Fixed, Noise, Ramp, Recorded, Sine, Source, Sources

__all__ = ["Modules", "modules_text"]

Modules = Sequence[tuple[State, Signals, Sources]]
"""Modules, the signals at their inputs, and the sources of these."""
_GAP = "   "


def modules_text(modules: Modules, width: int, room: int) -> list[Text]:
    """Return modules in lines: with every channel if all of that fits into `room`, else a line for each.

    Special: if even that does not fit, the last line counts the modules that are not shown.
    """
    cells = [_cells(*module) for module in modules]
    size = _Size.of([cell for of_module in cells for cell in of_module])
    across = max(1, (width + len(_GAP)) // (size.width + len(_GAP)))
    if sum(1 + -(-len(of_module) // across) for of_module in cells) <= room and size.width <= width:
        return [
            line
            for (state, *_), of_module in zip(modules, cells, strict=True)
            for line in (_heading(state), *_in_columns(of_module, size, across))
        ]
    shown = len(modules) if len(modules) <= room else max(0, room - 1)
    texts = list(_in_a_line(modules[:shown]))
    if shown < len(modules):
        texts.append(Text(f"and {len(modules) - shown} more modules", "dim"))
    return texts


# --- every channel ----------------------------------------------------------------------------------------------------


@frozen
class _Cell:
    """A channel: its number, type, reading and source."""

    channel: str
    type_name: str
    value: str
    style: str
    unit: str
    source: str


@frozen
class _Size:
    """The widths of the parts of a cell that are aligned."""

    type_name: int
    value: int
    unit: int
    source: int

    @classmethod
    def of(cls, cells: Sequence[_Cell]) -> "_Size":
        """Return the size in which all cells fit, and any number."""
        return cls(
            max((len(cell.type_name) for cell in cells), default=0),
            max((_NUMBER, *(len(cell.value) for cell in cells))),
            max((len(cell.unit) for cell in cells), default=0),
            max((len(cell.source) for cell in cells), default=0),
        )

    @property
    def width(self) -> int:
        """The columns of a cell."""
        return 2 + 1 + self.type_name + 1 + self.value + 1 + self.unit + 2 + self.source


_NUMBER = len("-9999.9")


def _cells(state: State, signals: Signals, sources: Sources) -> list[_Cell]:
    types = state.eeprom.type_codes
    cells = []
    for channel, reading in enumerate(readings(state, signals)[: state.profile.channels]):
        value, style = reading_text(reading, types[channel])
        source = sources.channels[channel] if channel < len(sources.channels) else Fixed(None)
        unit = "" if reading.value is None else str(reading.unit)
        cells.append(_Cell(f"{channel:2}", types[channel].name, value, style, unit, _source_words(source)))
    return cells


def _source_words(source: Source) -> str:
    """Return where a signal comes from: the signal itself if it is constant."""
    if isinstance(source, Fixed):
        return "open" if source.signal is None else f"{source.signal.value:.6g}{source.signal.unit}"
    return _KINDS[type(source)]


_KINDS: dict[type[Source], str] = {Ramp: "ramp", Sine: "sine", Noise: "noise", Recorded: "csv"}


def _in_columns(cells: Sequence[_Cell], size: _Size, across: int) -> Iterator[Text]:
    """Yield lines of cells, one below the other in each column."""
    down = -(-len(cells) // across)
    for row in range(down):
        text = Text()
        for cell in cells[row::down]:
            text.append(_GAP if text else "")
            text.append(f"{cell.channel} ", "bold").append(f"{cell.type_name:<{size.type_name}} ", "cyan")
            text.append(f"{cell.value:>{size.value}} {cell.unit:<{size.unit}}", cell.style)
            text.append(f"  {cell.source:<{size.source}}", "dim")
        text.rstrip()
        yield text


def _heading(state: State) -> Text:
    return Text("  ").join((_address(state), _name(state), Text(_settings(state)), *_flags(state)))


# --- a line for each --------------------------------------------------------------------------------------------------


def _in_a_line(modules: Modules) -> Iterator[Text]:
    names = [Text("  ").join((_address(state), _name(state))) for state, *_ in modules]
    longest = max(map(len, names), default=0)
    for name, (state, signals, _) in zip(names, modules, strict=True):
        name.pad_right(longest - len(name) + 2)
        now = readings(state, signals)[: state.profile.channels]
        yield name + Text("  ").join((*_flags(state), readings_text(now, state.eeprom.type_codes)))


# --- parts ------------------------------------------------------------------------------------------------------------


def _address(state: State) -> Text:
    return Text(f"{state.ram.address:02X}", "bold")


def _name(state: State) -> Text:
    return Text(f"{state.eeprom.model.value}@{state.eeprom.firmware}", "cyan")


def _settings(state: State) -> str:
    """Return the protocol, line settings and checksum that are in use, not those after the next power-on."""
    ram = state.ram
    if ram.protocol is Protocol.MODBUS_RTU:
        return f"RTU {_line(ram.line_settings)}"
    return f"DCON {_line(ram.line_settings)} {'checksum' if ram.checksum else 'no checksum'}"


def _line(settings: LineSettings) -> str:
    rate = settings.baud_rate
    known = rate.bits_per_second if isinstance(rate, BaudRate) else f"code {rate:02X}"
    return f"{known} {settings.character_format.name}"


def _flags(state: State) -> list[Text]:
    """Return what is unusual about a module."""
    flags = []
    if state.eeprom.host_watchdog_timed_out:
        flags.append(Text("WATCHDOG TIMED OUT", "bold red"))
    if state.ram.init_mode:
        flags.append(Text("INIT", "bold magenta"))
    elif state.ram.init_switch:
        flags.append(Text("INIT switch on", "magenta"))
    return flags
