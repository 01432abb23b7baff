"""What the generator reads: the files of ``spec/``, and the names and numbers that C has for what is in them."""

import json
from functools import cached_property
from pathlib import Path
from typing import Any

from c.generate.values import Value, number, numbered, upper

__all__ = ["FORMATS", "STATUSES", "Record", "Spec", "firmware"]

Record = dict[str, Any]
"""An object of JSON."""

FORMATS = {"engineering": 0, "percent": 1, "hex": 2, "modbus_engineering": 3, "modbus_hex": 4}
"""The data formats: those of DCON with their codes in FF, then those of Modbus."""
STATUSES = numbered(("ok", "over_range", "under_range", "disabled"))
_MAPS = "tables/modbus_registers/*.json"


def firmware(version: str) -> Value:
    """Return a version as ``I7000_FIRMWARE`` makes it.

    >>> firmware("B2.10").source, firmware("B2.10").proof.hex()
    ("I7000_FIRMWARE('B', 2, 10)", '0a024200')
    """
    letter, (major, minor) = version[0], version[1:].split(".")
    value = ord(letter) << 16 | int(major) << 8 | int(minor)
    return number(value, f"I7000_FIRMWARE('{letter}', {major}, {minor})")


class Spec:
    """The files of a folder ``spec/``."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def file(self, name: str) -> Record:
        """Return a file by its name in the folder."""
        return json.loads((self._folder / name).read_text("utf-8"))  # type: ignore[no-any-return] # every file is an object

    def rows(self, table: str) -> list[Record]:
        """Return the rows of a table."""
        return self.file(f"tables/{table}.json")["rows"]  # type: ignore[no-any-return] # as promised by its schema

    def files(self, pattern: str) -> list[str]:
        """Return the names of files, in the order of the numbers in them."""
        found = (path.relative_to(self._folder).as_posix() for path in self._folder.glob(pattern))
        return sorted(found, key=lambda name: [(len(part), part) for part in name.replace("-", ".").split(".")])

    @cached_property
    def maps(self) -> list[Record]:
        """The nine maps."""
        return [self.file(name) for name in self.files(_MAPS)]

    @cached_property
    def models(self) -> dict[str, int]:
        """The models: their names, with their places in ``i7000_models``."""
        return numbered(row["name"] for row in self.rows("models"))

    @cached_property
    def modbus_models(self) -> list[str]:
        """The models that speak Modbus."""
        return [row["name"] for row in self.rows("models") if "modbus" in row["protocols"]]

    @cached_property
    def model_keys(self) -> list[str]:
        """The identifiers of the models."""
        return [row["key"] for row in self.rows("models")]

    @cached_property
    def type_keys(self) -> dict[str, int]:
        """The identifiers of the types, with their codes."""
        return {row["key"]: int(row["code"], 16) for row in self.rows("type_codes")}

    @cached_property
    def dcon(self) -> dict[str, int]:
        """The messages of DCON: the commands by their place in the table, then the responses."""
        rows = self.rows("dcon_commands")
        responses = (row["response"] for row in rows if row["response"])
        return numbered(dict.fromkeys([*(row["name"] for row in rows), *responses, "Refused"]))

    @cached_property
    def modbus(self) -> dict[str, int]:
        """The messages of Modbus: the requests of functions, of sub-functions, then the responses."""
        rows = [row for row in self.rows("modbus_functions") if row["name"]] + self.rows("module_settings")
        responses = (row["response_name"] for row in rows)
        return numbered(dict.fromkeys([*(row["name"] for row in rows), *responses, "ExceptionResponse"]))

    @cached_property
    def fields(self) -> dict[str, int]:
        """The fields of all messages."""
        names = {
            field["name"] for row in self.rows("dcon_commands") for field in row["fields"] + row["response_fields"]
        }
        for row in self.rows("modbus_functions") + self.rows("module_settings"):
            for pdu in (row["request"], row["response"]):
                names |= {name for name in map(field_of, (pdu or "").split()) if name}
        return numbered(("none", *sorted(names)))

    @cached_property
    def faults(self) -> dict[str, int]:
        """The faults, none first: those of DCON, then those of Modbus and registers."""
        found = ["none"]
        for schema in ("dcon_vectors", "modbus_vectors", "register_vectors"):
            properties = self.file(f"schema/{schema}.json")["properties"]["vectors"]["items"]["properties"]
            found += [fault for fault in properties["fault"]["enum"] if fault]
        return numbered(dict.fromkeys(found))

    def mask(self, models: list[str]) -> int:
        """Return models as bits."""
        return sum(1 << self.models[name] for name in models)


def field_of(token: str) -> str | None:
    """Return the field of a token of a PDU, or None.

    >>> [field_of(token) for token in ("46", "count:2", "bytes", "function+80", "values:bits")]
    [None, 'count', None, 'function', 'values']
    """
    name = token.removesuffix("+80").partition(":")[0]
    return name if name.islower() and name != "bytes" else None


def constants(values: dict[str, int]) -> dict[str, int]:
    """Return names with their numbers as enumerators have them."""
    return {upper(name): value for name, value in values.items()}
