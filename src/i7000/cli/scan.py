"""``i7000 scan``: the search for modules whose address or line settings are unknown."""

from typing import Annotated, Literal

from cyclopts import Parameter

from i7000.cli.module import named
from i7000.cli.numbers import baud_rate, integer
from i7000.cli.options import LAST_ADDRESS, Json, Texts
from i7000.cli.port import DEFAULT_ASKING, AskOptions, Target
from i7000.cli.text import Printer
from i7000.cli.words import UsageError
from i7000.settings import BaudRate, CharacterFormat, LineSettings, Protocol

__all__ = ["scan"]

_EVERY = "all"


def scan(  # noqa: PLR0913 - each of them is an option
    target: Target,
    /,
    *,
    baud: Annotated[
        Texts, Parameter(help="Baud rate to try; repeat it for each, or all. Default: 9600. Example: --baud all.")
    ] = (),
    character_format: Annotated[
        tuple[Literal["N81", "N82", "E81", "O81", "all"], ...],
        Parameter(
            help="Character format to try; repeat it for each, or all. Default: N81.", negative="", show_default=False
        ),
    ] = (),
    addresses: Annotated[
        str, Parameter(help="Addresses to try, with commas and ranges. Example: --addresses 1-20,0x30.")
    ] = f"0-{LAST_ADDRESS}",
    protocol: Annotated[
        Literal["auto", "dcon", "rtu"], Parameter(help="Protocol to try; auto tries both at each address.")
    ] = "auto",
    checksum: Annotated[
        bool | None, Parameter(help="Try DCON with a checksum, or without one; both unless given.")
    ] = None,
    asking: AskOptions = DEFAULT_ASKING,
    json: Json = False,
) -> int:
    """Look for modules at all addresses, baud rates and formats that you name.

    The command first says how long it takes if nothing answers. It only reads, and never sends a broadcast: nothing on
    the line is changed. Likely places come first: address 01, and 00 for a module in INIT mode. Each module that
    answers is identified at once. At the end, or after Ctrl-C, there is a table of all modules.

    A slow adapter or a bad line needs a longer `--timeout` and `--retries`. If nothing answers, the command says what
    it heard and what to try next. `docs/find_a_module.md` is a guide for a module whose settings are forgotten.

    JSON keys: `record` (`module`), `address`, `baud_rate`, `character_format`, `protocol`, `checksum` (null by Modbus),
    `name`, `firmware`, `models` (the most likely one first) and `stored`: if the module is in INIT mode, its stored
    `address`, `baud_rate`, `character_format`, `protocol` and `checksum`, or else null.

    Example: `i7000 scan /dev/ttyUSB0 --baud all --addresses 1-20`

    Exit code: 0 if a module was found, 2 for wrong usage, 3 if none was found or the port is lost, 130 after Ctrl-C.
    """
    from i7000.cli.scanning import Search, run  # noqa: PLC0415 - it needs pyserial
    from i7000.host.procedures import SCAN_POLICY  # noqa: PLC0415 - it takes time

    rates = _rates(baud)
    formats = (
        tuple(CharacterFormat) if _EVERY in character_format else tuple(map(_format, character_format or ("N81",)))
    )
    search = Search(
        target,
        tuple(dict.fromkeys(LineSettings(rate, character) for character in formats for rate in rates)),
        _addresses(addresses),
        {"auto": (Protocol.DCON, Protocol.MODBUS_RTU), "dcon": (Protocol.DCON,), "rtu": (Protocol.MODBUS_RTU,)}[
            protocol
        ],
        (False, True) if checksum is None else (checksum,),
        asking.policy(SCAN_POLICY),
        asking.echo,
    )
    return run(search, Printer(json=json))


def _rates(texts: tuple[str, ...]) -> tuple[BaudRate, ...]:
    """Return baud rates, the likely ones first if they are all."""
    from i7000.host.procedures import EVERY_LINE  # noqa: PLC0415 - it takes time

    if _EVERY in texts:
        return tuple(dict.fromkeys(BaudRate(line.baud_rate) for line in EVERY_LINE))
    found = []
    for text in texts or ("9600",):
        rate = baud_rate(text)
        if not isinstance(rate, BaudRate):
            raise UsageError(f"--baud {text}: no module has this baud rate")
        found.append(rate)
    return tuple(found)


def _format(text: str) -> CharacterFormat:
    return CharacterFormat[text]


def _addresses(text: str) -> tuple[int, ...]:
    """Read addresses with commas and ranges."""
    found: list[int] = []
    for part in text.split(","):
        first, dash, last = (it.strip() for it in part.partition("-"))
        with named(f"--addresses {text}"):
            low, high = integer(first), integer(last if dash else first)
        if not (0 <= low <= LAST_ADDRESS and 0 <= high <= LAST_ADDRESS):
            raise UsageError(f"--addresses {text}: {part.strip()} is not within 0-{LAST_ADDRESS}, such as 1-20")
        if high < low:
            raise UsageError(f"--addresses {text}: {part.strip()} ends before it begins: write {last}-{first}")
        found.extend(range(low, high + 1))
    return tuple(dict.fromkeys(found))
