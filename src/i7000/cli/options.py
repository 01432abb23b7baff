"""The options that several commands have: the module, the protocol, JSON."""

import re
from typing import Annotated, Literal

from attrs import evolve, fields, frozen
from cyclopts import Parameter

from i7000 import DataFormat, Firmware, InvalidValueError, ModbusDataFormat, Protocol
from i7000.cli import choices
from i7000.cli.module import Described, named, read_module
from i7000.cli.numbers import integer
from i7000.cli.refusals import as_written
from i7000.cli.words import UsageError, type_codes
from i7000.cli.words import model as model_named
from i7000.describe import address as address_words
from i7000.dissect import Knowledge, Known

__all__ = ["LAST_ADDRESS", "PROTOCOLS", "UNKNOWN", "Json", "Module", "ProtocolName", "Texts", "address_of"]

ProtocolName = Annotated[Literal["dcon", "rtu"], Parameter(help="The protocol of the message: DCON or Modbus RTU.")]
PROTOCOLS: dict[str, Protocol | None] = {"auto": None, **choices.PROTOCOLS}
"""The names of the protocols at the terminal."""

Texts = Annotated[tuple[str, ...], Parameter(negative="", show_default=False)]
"""The values of an option that can be given several times."""

_ADDRESSED = re.compile(r"([^=@,]*)=(.*)")
LAST_ADDRESS = 0xFF


@Parameter(name="*")
@frozen
class Module:
    """What is known about the modules."""

    model: Texts = ()
    """Model of the module, with settings if you like: I-7018R or M-7019R@B3.7,type=K; see `i7000 simulate --help`."""
    firmware: str | None = None
    """Firmware of the module, such as B3.9; the newest unless given."""
    types: Annotated[str | None, Parameter(name="--type")] = None
    """Type of all channels, such as K, V_10, MA_4_20 or the hex code 0F; or a type for each channel, with commas
    between. The factory default of the model unless given."""
    data_format: Annotated[DataFormat | None, Parameter(name="--format")] = None
    """Format of DCON readings; engineering unless given."""
    checksum: bool | None = None
    """Whether DCON frames have a checksum; without unless given."""
    single_ended: Annotated[bool | None, Parameter(negative="--differential")] = None
    """Whether the inputs of a 7017Z are single-ended; differential unless given."""
    modbus_format: ModbusDataFormat | None = None
    """Format of the analog registers of Modbus; hex unless given."""

    def known(self, protocol: str = "dcon") -> Known:
        """Return what is known of the one module that is described.

        Errors: `UsageError`.
        """
        by_address = self._read(protocol)
        others = by_address.pop(None, None)
        if by_address:
            raise UsageError("give one --model, without an address")
        return self._options(protocol) if others is None else others

    def knowledge(self, protocol: str) -> Knowledge:
        """Return what is known of all modules.

        Errors: `UsageError`.
        """
        by_address = self._read(protocol)
        others = by_address.pop(None, None)
        return Knowledge.given(
            self._options(protocol) if others is None else others,
            {address: known for address, known in by_address.items() if address is not None},
        )

    def protocols(self) -> dict[int | None, Protocol]:
        """Return the protocols in descriptions of --model, by address; the descriptions were read without an error."""
        found: dict[int | None, Protocol] = {}
        for text in self.model:
            addressed = _ADDRESSED.fullmatch(text)
            address, described = (integer(addressed[1]), addressed[2]) if addressed else (None, text)
            settings = dict(part.strip().partition("=")[::2] for part in described.split(","))
            if "protocol" in settings:
                found[integer(settings["address"]) if "address" in settings else address] = choices.PROTOCOLS[
                    choices.protocol_word(settings["protocol"]).strip().lower()
                ]
        return found

    def _read(self, protocol: str) -> dict[int | None, Known]:
        options = self._options(protocol)
        found: dict[int | None, Known] = {}
        for text in self.model:
            address, described = _described(text)
            if address in found and address is not None:
                raise UsageError(f"two modules have the address {address_words(address)}: give each its own")
            if address in found:
                raise UsageError(f"give the addresses of several modules: --model 1={self.model[0]} --model 2={text}")
            missing = {
                name: value
                for name in (it.name for it in fields(Known))
                if (value := getattr(options, name)) is not None and getattr(described, name) is None
            }
            found[address] = self._checked(evolve(described, **missing), protocol)
        return found

    def _options(self, protocol: str) -> Known:
        if protocol == "rtu" and (self.data_format is not None or self.checksum is not None):
            raise UsageError("--format and --checksum are for DCON; for Modbus give --modbus-format")
        if protocol == "dcon" and self.modbus_format is not None:
            raise UsageError("--modbus-format is for --protocol rtu; for DCON give --format")
        with named("--type"):
            types = None if self.types is None else type_codes(self.types)
        try:
            known = Known(
                None,
                None if self.firmware is None else Firmware(self.firmware),
                types,
                self.data_format,
                self.checksum,
                self.single_ended,
                self.modbus_format,
            )
        except InvalidValueError as refusal:
            raise self._said(refusal) from None
        return known if self.model else self._checked(known, protocol)

    def _checked(self, known: Known, protocol: str) -> Known:
        """Refuse what no module is."""
        if protocol == "rtu" and known.model and Protocol.MODBUS_RTU not in known.model.protocols:
            raise UsageError(f"{known.model.value} does not speak Modbus: M-7000 series only")
        try:
            _ = known.default, known.all, protocol == "rtu" and known.modbus
        except InvalidValueError as refusal:
            raise self._said(refusal) from None
        return known

    def _said(self, refusal: InvalidValueError) -> UsageError:
        """Return a refusal with the option that was given."""
        options = {"firmware": ("--firmware", self.firmware), "type_codes": ("--type", self.types)}
        options["single_ended"] = ("--single-ended", "given")
        name, text = options.get(refusal.field, ("", None))
        said = as_written(refusal, name, text) if text is not None else refusal
        return UsageError(said if self.model or refusal.field == "firmware" else f"no model accepts it: {said}")


def _described(text: str) -> tuple[int | None, Known]:
    """Read ``[ADDRESS=]MODEL[@FIRMWARE][,name=value...]``."""
    written, address = text, None
    addressed = _ADDRESSED.fullmatch(text)
    if addressed:
        with named(f"--model {written}"):
            address = integer(addressed[1])
        if not 0 <= address <= LAST_ADDRESS:
            raise UsageError(f"--model {written}: an address is 0..255 or 00h..FFh")
        text = addressed[2]
    if "@" not in text and "," not in text:
        return address, Known(model_named(text))
    described = read_module(text, 1 if address is None else address)
    if "address" in described.given:
        if address is not None:
            raise UsageError(f"--model {written}: the address is given twice")
        address = described.eeprom.address
    return address, _known(described)


def _known(described: Described) -> Known:
    """Return what a description says that decides how frames are read."""
    eeprom, given = described.eeprom, described.given
    types = eeprom.type_codes[: eeprom.model.single_ended_channels if eeprom.single_ended else eeprom.model.channels]
    return Known(
        eeprom.model,
        eeprom.firmware if "firmware" in given else None,
        (types[:1] if len(set(types)) == 1 else types) if "type" in given else None,
        eeprom.report_settings.data_format if "format" in given else None,  # type: ignore[arg-type] # it is defined
        eeprom.report_settings.checksum if "checksum" in given else None,
        eeprom.single_ended if "single_ended" in given else None,
        eeprom.modbus_data_format if "modbus_format" in given else None,
    )


UNKNOWN = Module()
Json = Annotated[bool, Parameter(help="Print JSON, one object a line.", negative="")]


def address_of(text: str) -> int:
    """Read an address of ``--address``.

    Errors: `UsageError`.
    """
    with named(f"--address {text}"):
        number = integer(text)
    if not 0 <= number <= LAST_ADDRESS:
        raise UsageError(f"--address {text}: an address is 0..255 or 00h..FFh")
    return number
