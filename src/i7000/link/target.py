"""What a target is: the text that names a port at the terminal and in programs.

* A device such as ``/dev/ttyUSB0`` or ``COM3`` is a serial port of this machine.
* A URL of pyserial, such as ``socket://HOST:PORT`` or ``rfc2217://HOST:PORT``, is what it names. ``socket://`` carries
  the bytes of the serial line, as converters in raw mode do. Modbus TCP gateways (port 502) are not supported.
* ``sim:M-7019R@B3.7,type=K+M-7017`` is simulated modules in virtual time, written as for ``i7000 simulate --model``.
* ``exec:COMMAND`` is a process with the bytes of the line on its standard input and output, in real time.

Laws: a target that cannot be opened raises an error of one line that names it and what is possible. What
only some targets need is imported when one of them is opened.
"""

import re
import shlex
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, TypedDict, Unpack, cast
from urllib.parse import urlsplit

import serial

from i7000.errors import InvalidValueError
from i7000.link.errors import LinkError
from i7000.link.port import Port, settings_of
from i7000.settings import LineSettings

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings

    from i7000.device import Signals
    from i7000.simulator import Faults, Sources

__all__ = ["FORMS", "TargetOptions", "open_target"]

FORMS = "a device such as /dev/ttyUSB0 or COM3, socket://HOST:PORT, rfc2217://HOST:PORT, sim:MODEL or exec:COMMAND"
"""The forms of a target, for messages."""

_NEXT_MODULE = re.compile(r"\+(?=\s*[im]-)", re.IGNORECASE)
"""The sign between modules; others are those of numbers."""
_HOST_AND_PORT = re.compile(r"([\w.-]+|\[[\da-fA-F:]+\]):\d{1,5}")
_MOST_LISTED = 8
_WRITE_TIMEOUT = 5.0
"""The longest time in seconds that the other end of a port can hold up a write."""


class TargetOptions(TypedDict, total=False):
    """What `open_target` takes besides the target and the line settings; each is for some targets."""

    seed: int
    """For ``sim:``: the random seed of faults."""
    faults: "Faults"
    """For ``sim:``: the faults of the line."""
    signals: "Iterable[Signals | Sources]"
    """For ``sim:``: the signals at the inputs of each module."""
    init_switch: bool
    """For ``sim:`` and ``exec:``: power the modules on with the INIT switch set."""
    rs485: "RS485Settings"
    """For a serial port: RTS sets the direction of an RS-485 transceiver, if the driver of the port can do that."""


_OPTIONS_OF = {
    "sim": {"seed", "faults", "signals", "init_switch"},
    "exec": {"init_switch"},
    "URL": set(),
    "device": {"rs485"},
}


def open_target(
    text: str,
    line: LineSettings = LineSettings(),  # noqa: B008 - frozen
    **options: Unpack[TargetOptions],
) -> Port:
    r"""Open the port that a text names, with the settings of `line`.

    Shape: see the head of `i7000.link.target`, and `TargetOptions`.
    Special: a serial port is opened for this program alone, where the system can do that.
    Errors: `InvalidValueError` for a text that is not a target, and for an option that the target does not have;
        `LinkError` for a port that cannot be opened.

    >>> port = open_target("sim:I-7018,address=5+M-7017,protocol=dcon")
    >>> port.timeout = 1.0
    >>> port.write(b"$05M\r$02M\r"), port.read(18)
    (10, b'!057018\r!027017\r')
    """
    scheme, colon, rest = text.partition(":")
    kind = "device"
    if colon and scheme in ("sim", "exec"):
        kind = scheme
    elif rest.startswith("//"):
        kind = "URL"
    for name, value in options.items():
        if name not in _OPTIONS_OF[kind]:
            kinds = " or ".join(of for of, names in _OPTIONS_OF.items() if name in names)
            raise InvalidValueError(name, value, f"for {kinds} targets only, not for {text}", "")
    if not text.strip():
        raise InvalidValueError("target", text, FORMS, "")
    if kind == "sim":
        return _simulated(text, rest, line, options)
    if kind == "exec":
        return _process(text, rest, options)
    return _serial(text, line, options.get("rs485"), url=kind == "URL")


def _simulated(target: str, text: str, line: LineSettings, options: TargetOptions) -> Port:
    from i7000.cli.module import read_module  # noqa: PLC0415
    from i7000.cli.words import UsageError  # noqa: PLC0415
    from i7000.link.virtual import VirtualPort  # noqa: PLC0415
    from i7000.simulator import Simulated, default_sources  # noqa: PLC0415

    modules = []
    for address, written in enumerate(_NEXT_MODULE.split(text), 1):
        try:
            described = read_module(written.strip(), address, "module")
        except UsageError as error:
            raise InvalidValueError("target", target, str(error), "") from None
        switch = options.get("init_switch", False) or described.init_switch
        modules.append(Simulated(described.eeprom, default_sources(described.eeprom), switch))
    port = VirtualPort(modules, options.get("signals"), options.get("faults"), seed=options.get("seed", 0), line=line)
    port.name = target
    return port


def _process(target: str, text: str, options: TargetOptions) -> Port:
    from i7000.link.process import ProcessPort  # noqa: PLC0415

    try:
        command = shlex.split(text)
    except ValueError as error:
        raise InvalidValueError("target", target, f"{error}: a command as a shell reads it", "") from None
    if not command:
        raise InvalidValueError("target", target, "exec:COMMAND, such as exec:./module", "")
    return ProcessPort(command, init_switch=options.get("init_switch", False))


def _serial(target: str, line: LineSettings, rs485: "RS485Settings | None", *, url: bool) -> Port:
    """Open a port of pyserial."""
    settings = settings_of(line)
    if url and not _is_complete(target):
        raise InvalidValueError("target", target, FORMS, "")
    try:
        port = _unopened(target, exclusive=True, **settings)
    except ValueError:
        raise InvalidValueError("target", target, FORMS, "") from None
    except OSError as error:
        raise LinkError(f"{target}: {error}") from None
    try:
        port.open()
        if rs485:
            port.rs485_mode = rs485
    except Exception as error:  # noqa: BLE001 - pyserial raises many kinds
        port.close()
        raise LinkError(f"{target}: {_reason(error)}{'' if url else _possible(target)}") from None
    return port


def _is_complete(target: str) -> bool:
    """Return whether a URL of the network names a host and a port."""
    try:
        url = urlsplit(target)
        return url.scheme not in ("socket", "rfc2217") or (bool(url.hostname) and url.port is not None)
    except ValueError:
        return False


def _unopened(target: str, **settings: Any) -> serial.Serial:  # noqa: ANN401 - of pyserial
    if target.lower().startswith("rfc2217:"):
        from i7000.link.rfc2217 import Rfc2217Port  # noqa: PLC0415

        port: Any = Rfc2217Port(**settings)
        port.port = target
        return cast(serial.Serial, port)  # it has the same methods
    return serial.serial_for_url(target, do_not_open=True, write_timeout=_WRITE_TIMEOUT, **settings)


def _reason(error: BaseException) -> str:
    """Return why a port cannot be opened, without what pyserial puts in front of it."""
    cause = error.__context__ or error
    if isinstance(cause, BlockingIOError):
        return "another program uses it"
    reason = cause.args[1] if len(cause.args) > 1 else cause
    return " ".join(str(reason).split())


def _possible(target: str) -> str:
    """Return the end of a message with what can be meant: a host and port, or the serial ports of this machine."""
    from serial.tools.list_ports import comports  # noqa: PLC0415

    if _HOST_AND_PORT.fullmatch(target):
        return f"; for a host and port, write socket://{target} or rfc2217://{target}"
    ports = sorted(port.device for port in comports())
    more = ", ..." if len(ports) > _MOST_LISTED else ""
    if not ports:
        return f"; there are no serial ports here, but a target can also be {FORMS}"
    return f"; the serial ports here are {', '.join(ports[:_MOST_LISTED])}{more}"
