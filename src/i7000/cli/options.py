"""What several commands take: options of a module, of output, of protocols."""

from typing import Annotated, Literal

from attrs import frozen
from cyclopts import Parameter

from i7000 import DataFormat, EncodeError, Firmware, ModbusDataFormat, Model
from i7000.cli.dcon import Known
from i7000.cli.refusals import as_written
from i7000.cli.words import UsageError, type_codes

__all__ = ["UNKNOWN", "Json", "Module", "ProtocolName"]

ProtocolName = Annotated[Literal["dcon", "rtu"], Parameter(help="DCON, or Modbus RTU.")]


@Parameter(name="*")
@frozen
class Module:
    """What is known about the module; what is not given is not known."""

    model: str | None = None
    """Its printed name: I-7018R."""
    firmware: str | None = None
    """Its firmware: B3.9; the newest if it is not given."""
    types: Annotated[str | None, Parameter(name="--type")] = None
    """Its type, or the types of all channels with commas between: hex codes (0F) or names (K, V_10, MA_4_20)."""
    data_format: Annotated[DataFormat | None, Parameter(name="--format")] = None
    """How its readings are written."""
    checksum: bool | None = None
    """Whether its frames have a checksum."""
    single_ended: Annotated[bool | None, Parameter(negative="--differential")] = None
    """Whether its inputs are single-ended: 7017Z only."""
    modbus_format: ModbusDataFormat | None = None
    """How its analog registers are written."""

    def known(self, protocol: ProtocolName = "dcon") -> Known:
        """The options as values.

        Errors: `UsageError`.
        """
        if protocol == "rtu" and (self.data_format is not None or self.checksum is not None):
            raise UsageError("--format and --checksum are of DCON; the registers have --modbus-format")
        if protocol == "dcon" and self.modbus_format is not None:
            raise UsageError("--modbus-format is of --protocol rtu; DCON has --format")
        try:
            known = Known(
                None if self.model is None else Model.find(self.model),
                None if self.firmware is None else Firmware(self.firmware),
                None if self.types is None else type_codes(self.types),
                self.data_format,
                self.checksum,
                self.single_ended,
                self.modbus_format,
            )
            _ = known.default, known.all
        except EncodeError as refusal:
            written = {
                "model": ("--model", self.model),
                "firmware": ("--firmware", self.firmware),
                "type_codes": ("--type", self.types),
                "single_ended": ("--single-ended", "given"),
            }
            name, text = written[refusal.field]
            raise UsageError(as_written(refusal, name, f"{text}")) from None
        return known


UNKNOWN = Module()
Json = Annotated[bool, Parameter(help="Write JSON, an object a line.", negative="")]
