"""``i7000 encode``: the frame of a message."""

from typing import Annotated

from cyclopts import Parameter

from i7000 import EncodeError
from i7000.cli.message import DCON, MODBUS, frame_text, make
from i7000.cli.message import encode as encode_message
from i7000.cli.options import UNKNOWN, Json, Module, ProtocolName
from i7000.cli.text import Line, Printer

__all__ = ["encode"]


def encode(
    name: Annotated[str, Parameter(help="A command, as i7000 commands lists it, or a response.")],
    /,
    *fields: Annotated[str, Parameter(help="field=value for each field.")],
    protocol: ProtocolName = "dcon",
    force: Annotated[bool, Parameter(help="Write it even if the module would refuse it.", negative="")] = False,
    json: Json = False,
    module: Module = UNKNOWN,
) -> int:
    """Write a frame: as text, then in hex; by Modbus in hex.

    * Numbers are decimal, or hex as `0x3A`; truth values `true` or `false`; choices a name or a number: `update=once`.
    * Types are hex codes or names: `type_code=0F`, `type_code=K`, `type_code=mixed`.
    * A mask is a number or a list of channels: `mask=0x3A` or `channels=1,3,4,5`.
    * `line_settings` is a byte in hex, `line_settings=86`, or its parts: `baud_rate=9600 character_format=E81`.
    * `report_settings` is a byte in hex, `report_settings=40`, or its parts: `data_format=hex checksum=true
      fast_mode=false filter=reject_50_hz`. Parts that are not given are those of the byte, or the factory default.
    * Lists have commas between: `values=+01.500,-01.500`, by Modbus `values=1,0x1F` or `values=true,false`.

    Examples: `i7000 encode SetChannelMask address=1 channels=1,3,4,5 --model I-7018`,
    `i7000 encode ReadInputRegisters address=1 start=0 count=8 --protocol rtu`

    Exit code: 0; 1 if the model, or every model, refuses it; 2 for wrong usage.

    JSON keys: `name`, `section`, `frame`, `wire` (hex).
    """
    known = module.known(protocol)
    printer = Printer(json=json)
    try:
        message = make(name, fields, MODBUS if protocol == "rtu" else DCON)
    except EncodeError as refusal:
        printer.error(str(refusal))
        return 1
    try:
        frame = encode_message(message, known, force=force)
    except EncodeError as refusal:
        printer.error(refusal if known.model else f"no model takes it; the first says: {refusal}")
        return 1
    text = frame_text(message, frame)
    record = {"name": type(message).__name__, "section": message.section, "frame": text, "wire": frame.hex()}
    in_hex: list[Line] = [] if protocol == "rtu" else [[(frame.hex(" "), "")]]
    printer.record(record, [[(text, "bold")], *in_hex])
    printer.flush()
    return 0
