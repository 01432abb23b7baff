"""The ways in which logs write frames, and what stands around them: each a few words of one kind.

Laws: a spelling says which bytes it means; what stands around it has no frame in it.
"""

from collections.abc import Callable
from typing import Final

Spelling = Callable[[bytes], str]


def _joined(separator: str, form: str) -> Spelling:
    return lambda wire: separator.join(form % byte for byte in wire)


def _words(wire: bytes) -> str:
    return " ".join(wire[at : at + 2].hex() for at in range(0, len(wire), 2))


def _dots(wire: bytes) -> str:
    return "".join(chr(byte) if 0x20 <= byte < 0x7F else "." for byte in wire)


def _shown(byte: int) -> str:
    return chr(byte) if 0x21 <= byte < 0x7F else ""


_C_ESCAPES = {7: r"\a", 8: r"\b", 9: r"\t", 10: r"\n", 11: r"\v", 12: r"\f", 13: r"\r", 27: r"\e", 34: r"\"", 92: r"\\"}


def _in_c(wire: bytes) -> str:
    """Write a string as the UART debugger of ESPHome does."""
    return "".join(_C_ESCAPES.get(byte) or (chr(byte) if 32 <= byte < 127 else rf"\x{byte:02X}") for byte in wire)


BYTES: Final[dict[str, Spelling]] = {
    "blanks": _joined(" ", "%02x"),
    "upper case": _joined(" ", "%02X"),
    "one word": bytes.hex,
    "one word, upper case": lambda wire: wire.hex().upper(),
    "colons": _joined(":", "%02x"),
    "dashes": _joined("-", "%02X"),
    "commas": _joined(",", "%02x"),
    "commas and blanks": _joined(", ", "%02X"),
    "semicolons": _joined(";", "%02X"),
    "bars": _joined("|", "%02X"),
    "underscores": _joined("_", "%02x"),
    "dots": _joined(".", "%02x"),
    "slashes": _joined("/", "%02x"),
    "words of two": _words,
    "0x": _joined(" ", "0x%02x"),
    "0x and commas": _joined(", ", "0x%02X"),
    "pymodbus": lambda wire: " ".join(map(hex, wire)),
    "0x1 and commas": lambda wire: ",".join(map(hex, wire)),
    "h": _joined(" ", "%02Xh"),
    "Basic": _joined(" ", "&H%02X"),
    "Pascal": _joined(" ", "$%02X"),
    "percent": _joined("", "%%%02X"),
    "libmodbus, requests": _joined("", "[%02X]"),
    "libmodbus, responses": _joined("", "<%02x>"),
    "libmodbus with blanks": _joined("", "< %02x >"),
    "braces": _joined("", "{%02X}"),
    "escapes": _joined("", r"\x%02x"),
    "a string of escapes": lambda wire: f'"{_joined("", chr(92) + "x%02x")(wire)}"',
    "JSON, a string": lambda wire: f'"{_joined("", chr(92) + "u%04x")(wire)}"',
    "octal": lambda wire: f'"{_joined("", chr(92) + "%03o")(wire)}"',
    "a string of C": lambda wire: f'"{_in_c(wire)}"',
    "strace": lambda wire: f'write(3, "{_in_c(wire)}", {len(wire)}) = {len(wire)}',
    "Python": repr,
    "Python, bytearray": lambda wire: repr(bytearray(wire)),
    "Python, fromhex": lambda wire: f"bytes.fromhex('{wire.hex()}')",
    "Python, a list": lambda wire: f"bytes({list(wire)})",
    "node": lambda wire: f"<Buffer {wire.hex(' ')}>",
    "C, an array": lambda wire: f"{{{_joined(', ', '0x%02x')(wire)}}}",
    "Rust": lambda wire: f"vec![{_joined(', ', '0x%02x')(wire)}]",
    "JSON, strings": lambda wire: f'["{_joined(chr(34) + "," + chr(34), "%02x")(wire)}"]',
    "JSON, numbers": lambda wire: f"[{','.join(map(str, wire))}]",
    "decimal": lambda wire: " ".join(map(str, wire)),
    "modbus-tk": lambda wire: "-".join(map(str, wire)),
    "decimal, three digits": _joined(" ", "%03d"),
    "ModScan": _joined("", "[%03d]"),
    "hex without zeros": _joined(" ", "%x"),
    "JSON of node": lambda wire: f'{{"type":"Buffer","data":[{",".join(map(str, wire))}]}}',
    "Node-RED": lambda wire: f"buffer[{len(wire)}] [{', '.join(map(hex, wire))}]",
    "Java, signed": lambda wire: str([byte - 256 if byte > 127 else byte for byte in wire]),
    "Go": lambda wire: f"[]byte{{{', '.join(map(hex, wire))}}}",
    "Rust, a string": lambda wire: f'b"{_in_c(wire)}"',
    "IEC 61131": _joined(", ", "16#%02X"),
    "slsnif": lambda wire: " ".join(f"{_shown(byte)}({byte:02x})" for byte in wire),
    "slsnif, decimal": lambda wire: " ".join(f"{_shown(byte)}({byte:03})" for byte in wire),
    "Perl": lambda wire: f'"{_joined("", chr(92) + "x{%02x}")(wire)}"',
    "text in brackets": lambda wire: " ".join(f"0x{byte:02X}({_shown(byte) or '.'})" for byte in wire),
    "the CRC apart": lambda wire: f"{wire[:-2].hex(' ')} CRC: {wire[-2:].hex(' ')}",
    "a length before": lambda wire: f"{len(wire)} {wire.hex(' ')}",
    "minimalmodbus": lambda wire: f"{wire.decode('latin-1')!r} ({wire.hex(' ').upper()})",
    "Portmon": lambda wire: f"IRP_MJ_WRITE\tVCP0\tSUCCESS\tLength {len(wire)}: {wire.hex(' ').upper()} \t",
    "QModMaster": lambda wire: f"[RTU]>Tx > 12:00:01:123 - {wire.hex(' ').upper().replace(' ', '  ')}  ",
    "hexdump": lambda wire: f"00000000  {wire.hex(' ')}  |{_dots(wire)}|",
    "xxd": lambda wire: f"00000000: {_words(wire)}  {_dots(wire)}",
    "tshark": lambda wire: f"0000  {wire.hex(' ')}   {_dots(wire)}",
    "a sniffer": lambda wire: f"{wire.hex(' ')}    {_dots(wire)}",
}
"""The bytes of a frame of either protocol."""

COLUMNS: Final = frozenset({"hexdump", "xxd", "tshark", "a sniffer", "a length before"})
"""Spellings that take a whole line."""

ENDS: Final = (
    "", r"\r", r"\r\n", "<CR>", "(CR)", "[CR]", "<cr>", "(cr)", "{CR}", "<CR><LF>", "[CR][LF]", " <CR>", " (cr)",
    "<0d>", "<0D>", "<0x0D>", "{0D}", "[0D]",
    "[0d][0a]", "$R", "$R$L", "^M", "^M^J", "#13", "&#13;", "%0D", r"\x0D", r"\x0d", r"\015", r"\0D", r"\u000d",
    "\u240d", "\u21b5",
)  # fmt: skip
"""The carriage return of a frame that is written as text."""


def _text(wire: bytes) -> str:
    return wire[:-1].decode("ascii")


TEXTS: Final[dict[str, Spelling]] = {
    **{f"text {end}": lambda wire, end=end: _text(wire) + end for end in ENDS},  # type: ignore[misc]
    **{f"a string {end}": lambda wire, end=end: f'"{_text(wire)}{end}"' for end in ENDS},  # type: ignore[misc]
    "strace": lambda wire: rf'write(3, "{_text(wire)}\r", {len(wire)}) = {len(wire)}',
    "LabVIEW": lambda wire: _text(wire).replace(" ", r"\s") + r"\r",
    "HTML": lambda wire: f"<td>{_text(wire).replace('>', '&gt;')}</td>",
    "XML": lambda wire: f"<frame>{_text(wire).replace('>', '&gt;')}&#13;</frame>",
    "a sum of strings": lambda wire: f'Write("{_text(wire)}" + "\\r")',
    "Python, a sum": lambda wire: rf'write(b"{_text(wire)}" + b"\r")',
    "SQL": lambda wire: f"VALUES ('TX', '{_text(wire)}');",
    "Markdown": lambda wire: f"| `{_text(wire)}` |",
}
"""A DCON frame as text."""

BEFORE: Final = (
    "", "TX: ", "RX: ", "> ", "< ", "-> ", "<- ", ">>> ", "<<< ", "=> ", "send: ", "recv(8): ", "data=", '"data": ',
    "Response = ", "request: ", "(8 bytes) ", "<< [8] ", "TX(8)=", "port 3 -> ", "1: ", "#5 ", "1;TX;", "0.020000 ",
    "1700000000.123 ", "12:00:01 ", "[12:00:01] ", "[ 1234.567890] ", "08:15:00,123 [DEBUG] send: ",
    "2024-03-07 08:15:00.120 -> ", "2024-03-07T08:15:00.120Z TX ", "03/07/2024 8:15:00 AM: ", "07.03.2024 08:15:00 ",
    "Mar  7 08:15:00 host app[123]: ", "INFO:root:Tx: ", "COM3: ", "/dev/ttyUSB0 > ", "Written data (COM3)  ",
    "\u041e\u0442\u043f\u0440\u0430\u0432\u043b\u0435\u043d\u043e: ",
)  # fmt: skip
"""What stands before a frame: directions, dates, times, ports, lengths, in the words of many tools and languages."""

AFTER: Final = (
    "", " ", "\t", " (15 ms)", " // firmware", " (8 bytes), roundtrip time: 41.7 ms.", " ok", " # comment", "; ", ".",
    " old_data:  addr=None", ", 8 bytes", " [8]", " in 15 ms", " len=8",
)  # fmt: skip
BETWEEN: Final = (
    " -> ", " <- ", " => ", " RX: ", "  Response: ", " | ", " , ", ", responses: [ ", " = ", " / ", "\t", "; rx=",
    " RX(7) ",
)  # fmt: skip
"""What stands between the frames of one line."""

WITHOUT_FRAMES: Final = (
    "", " ", "COM3 opened at 9600 8N1", "Waiting for a confirmation...", "Bytes flushed (0)",
    "$PATH and 50% done! really?",
    "2024-03-07 08:15:00.120 INFO started", "retry 3 of 5 in 0.25 s", "serial 12345678, firmware B3.7", "#define X",
    "0000", "deadbeef", "port closed (errno 5)", "timeout after 1000 ms!", "-> <- => >>> <<<",
    "192.168.0.7:502 connected",
)  # fmt: skip


def rows(wire: bytes, width: int = 16) -> list[tuple[int, bytes]]:
    """Cut a frame into rows, with the offset of each."""
    return [(at, wire[at : at + width]) for at in range(0, len(wire), width)]


def _halves(row: bytes) -> str:
    return f"{row[:8].hex(' ')}  {row[8:].hex(' ')}"


DUMPS: Final[dict[str, Callable[[bytes], list[str]]]] = {
    "hexdump -C": lambda wire: [
        *(f"{at:08x}  {_halves(row):48}  |{_dots(row)}|" for at, row in rows(wire)),
        f"{len(wire):08x}",
    ],
    "xxd": lambda wire: [f"{at:08x}: {_words(row):39}  {_dots(row)}" for at, row in rows(wire)],
    "od -tx1": lambda wire: [*(f"{at:07o} {row.hex(' ')}" for at, row in rows(wire)), f"{len(wire):07o}"],
    "tshark -x": lambda wire: [f"{at:04x}  {_halves(row):48}   {_dots(row)}" for at, row in rows(wire)],
    "socat -x": lambda wire: [
        f"> 2026/11/30 12:00:01.000123456  length={len(wire)} from=0 to={len(wire) - 1}",
        *(f" {row.hex(' '):48} {_dots(row)}" for _, row in rows(wire)),
        "--",
    ],
    "jpnevulator": lambda wire: [
        "2026-11-30 12:00:01.123456: ttyS0",
        *(f"{row.hex(' ').upper():48} {_dots(row)}" for _, row in rows(wire)),
    ],
    "Serial Port Monitor": lambda wire: [
        "[12:00:01] Written data (COM3)   ",
        *(f"    {row.hex(' '):48}   {_dots(row)}   " for _, row in rows(wire)),
    ],
    "Format-Hex": lambda wire: [
        "           00 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F",
        "",
        *(f"{at:08X}   {row.hex(' ').upper():48} {_dots(row)}" for at, row in rows(wire)),
    ],
    "Saleae": lambda wire: [
        "Time [s],Value,Parity Error,Framing Error",
        *(f"{at / 1000:.9f},0x{wire[at]:02X},," for at in range(len(wire))),
    ],
    "sigrok": lambda wire: [f"uart-1: {byte:02X}" for byte in wire],
    "PulseView": lambda wire: [
        f"{1000 * at}-{1000 * at + 9} UART: TX data: {byte:02X}" for at, byte in enumerate(wire)
    ],
    "interceptty": lambda wire: [f"> 0x{byte:02x} ({_shown(byte)})" for byte in wire],
}
"""Spellings in which a frame takes several lines."""
