"""``i7000 encode``: the frame of a message."""

from typing import Annotated, Literal

from cyclopts import Parameter

from i7000 import InvalidValueError
from i7000.cli.by_register import number_note
from i7000.cli.message import DCON, MODBUS, find, frame_text, make, refusal_words, registers
from i7000.cli.message import encode as encode_message
from i7000.cli.options import UNKNOWN, Json, Module
from i7000.cli.text import Line, Printer

__all__ = ["encode"]


def encode(
    name: Annotated[str, Parameter(help="Name of a command or response. i7000 commands lists them.")],
    /,
    *fields: Annotated[str, Parameter(help="The fields, each as field=value. Example: address=1.")],
    protocol: Annotated[
        Literal["auto", "dcon", "rtu"], Parameter(help="DCON or Modbus RTU. auto: DCON if both have the name.")
    ] = "auto",
    force: Annotated[bool, Parameter(help="Encode it even if the module would refuse it.", negative="")] = False,
    json: Json = False,
    module: Module = UNKNOWN,
) -> int:
    """Encode a message and print its frame: DCON as text, then in hex; Modbus in hex.

    * Numbers are decimal, or hex as `0x3A` or `3Ah`. Truth values are `true` and `false`. A choice is a name or a
      number: `update=once`.
    * Values have the unit that `i7000 decode` prints: `offset=-0.5` (degC), `timeout=2.5` (s). A number in hex is the
      counts in the frame: `offset=0x32` is 0.5 degC.
    * A type is two hex digits or a name: `type_code=0F`, `type_code=K`, `type_code=mixed`.
    * A mask is a number or a list of channels: `mask=0x3A` or `channels=1,3,4,5`.
    * `line_settings` is a byte, `line_settings=86h`, or its parts: `baud_rate=9600 character_format=E81`.
    * `report_settings` is a byte, `report_settings=40h`, or its parts: `data_format=hex checksum=true
      fast_mode=false filter=reject_50_hz`. Missing parts are those of the byte, or the factory default.
    * A list has commas: `values=+01.500,-01.500`; in Modbus `values=1,0x1F` or `values=true,false`.
    * In Modbus, `start`, `coil` and `register` are addresses as in frames: 488 for 40489. With `--model` they can be
      names, `register=host_watchdog_timeout value=2.5`. Values then have the units of `i7000 registers`, and what the
      model does not have is refused. Without `--model`, or with `--force`, values are the numbers in the frame, and an
      address that looks like a number of the manual is encoded with a note on standard error.

    Examples: `i7000 encode ReadConfiguration address=1`,
    `i7000 encode SetChannelMask address=1 channels=1,3,4,5 --model I-7018`,
    `i7000 encode ReadInputRegisters address=1 start=analog_input --model M-7019R`

    Exit code: 0 if the frame is printed, 1 if the model (or, without `--model`, every model) refuses it, 2 for wrong
    usage.

    JSON keys: `name`, `section`, `frame`, `wire` (hex).
    """
    kind = find(name, (*DCON, *MODBUS) if protocol == "auto" else MODBUS if protocol == "rtu" else DCON)
    protocol = "rtu" if kind in MODBUS else "dcon"
    known = module.known(protocol)
    printer = Printer(json=json)
    try:
        message = make(kind, fields, registers(known) if protocol == "rtu" else None, force=force)
        frame = encode_message(message, known, force=force)
    except InvalidValueError as refusal:
        words = refusal_words(refusal, kind, fields)
        printer.error(words if known.model or refusal.reason else f"no model accepts it: {words}")
        return 1
    text = frame_text(message, frame)
    record = {"name": type(message).__name__, "section": message.section, "frame": text, "wire": frame.hex()}
    in_hex: list[Line] = [] if protocol == "rtu" else [[(frame.hex(" "), "")]]
    printer.record(record, [[(text, "bold")], *in_hex])
    printer.flush()
    note = number_note(kind, fields)
    if note is not None:
        printer.note(note)
    return 0
