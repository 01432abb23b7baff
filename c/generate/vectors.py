"""``i7000_vectors.h``: the vectors of ``spec/vectors/``, a section for each file."""

import re
from collections.abc import Callable, Iterable, Iterator
from pathlib import PurePosixPath
from typing import NamedTuple

from c.generate.header import definition, filled
from c.generate.spec import FORMATS, STATUSES, Record, Spec, firmware
from c.generate.tables import UNIT_NUMBERS
from c.generate.values import (
    Value,
    enumerator,
    items,
    number,
    optional_text,
    pointer,
    real,
    row,
    text,
    upper,
    wire,
)

__all__ = ["Section", "sections", "vectors_header"]

OUTCOMES = {"response": 0, "refused": 1, "exception": 1, "silence": 2, "reject": 3}
SOURCES = {"manual": 0, "derived": 1, "assumed": 2}
FLAGS = {
    flag: 1 << at
    for at, flag in enumerate(("host-refuses", "host-may-refuse", "needs-state", "decode-only", "lenient", "misprint"))
}
SIDES = {"requests": 0, "responses": 1, "both": 2}
DIRECTIONS = {"decode": (1, "I7000_READ"), "encode": (2, "I7000_WRITE"), "both": (3, "I7000_READ | I7000_WRITE")}


class Section(NamedTuple):
    """The vectors of a file."""

    file: str
    name: str
    """Its part of the names in C, such as ``dcon_2_10``."""
    kind: str
    profiles: list[Value]
    vectors: list[Value]

    @property
    def array(self) -> str:
        """The name of its array."""
        return f"i7000_vectors_{self.name}"

    @property
    def condition(self) -> str:
        """The condition on which it is compiled."""
        folder = self.file.partition("/")[0].upper()
        names = ("ALL", folder, self.name.upper())
        return " || ".join(f"defined(I7000_VECTORS_{name})" for name in names)


def sections(spec: Spec) -> list[Section]:
    """Return the sections, in the order of their files."""
    return [_section(name, spec) for name in spec.files("vectors/*/*.json")]


def vectors_header(found: list[Section]) -> str:
    """Return ``i7000_vectors.h``."""
    return filled("i7000_vectors.h", sections=_written(found), lists=_lists(found))


def _written(found: list[Section]) -> Iterator[str]:
    for section in found:
        yield from ("", f"#if {section.condition}")
        if section.profiles:
            yield from definition("static const i7000_profile", f"i7000_profiles_{section.name}", section.profiles)
        yield from definition(f"static const {section.kind}", section.array, section.vectors)
        yield "#endif"


def _lists(found: list[Section]) -> Iterator[str]:
    for kind, listed in (
        ("i7000_exchange", "i7000_exchange_section"),
        ("i7000_reading_vector", "i7000_reading_section"),
    ):
        is_exchange = kind == "i7000_exchange"
        yield f"static const {listed} {listed}s[] = {{"
        for section in found:
            if section.kind == kind:
                side = f" {int(section.file.startswith('modbus'))}," if is_exchange else ""
                yield from (
                    f"#if {section.condition}",
                    f'    {{"{section.file}",{side} {section.array}, {len(section.vectors)}}},',
                    "#endif",
                )
        yield f"    {{NULL,{' 0,' if is_exchange else ''} NULL, 0}},"
        yield "};"


def _section(file: str, spec: Spec) -> Section:
    data = spec.file(file)
    path = PurePosixPath(file).relative_to("vectors")
    folder, stem = path.parent.name, path.stem
    kind, make = _KINDS.get(str(path)) or _KINDS[folder]
    number_of = re.match(r"46-[0-9A-F]{2}|[0-9][0-9A-F.]*(?=-)", stem)
    name = re.sub(r"\W", "_", f"{folder}_{number_of[0] if number_of else stem}").lower()
    manual = data.get("section") or re.sub(r".*sections? |;.*", "", data["source"])
    profiles: dict[str, Value] = {}

    def profile_of(vector: Record) -> Value:
        found = vector.get("profile")
        if found is None:
            return Value("NULL", b"\xff")
        value = _profile(found, spec)
        profiles.setdefault(value.source, value)
        return Value(f"&i7000_profiles_{name}[{list(profiles).index(value.source)}]", value.proof)

    made = [make(_Vector(it, folder, text(manual), profile_of(it), spec)) for it in data["vectors"]]
    return Section(str(path), name, kind, list(profiles.values()), made)


class _Vector(NamedTuple):
    """A vector with what is made of it in the same way whatever its kind."""

    it: Record
    folder: str
    section: Value
    profile: Value
    spec: Spec

    @property
    def names(self) -> tuple[Value, Value, Value]:
        """Its id, section and erratum."""
        return text(self.it["id"]), self.section, optional_text(self.it["erratum"])

    @property
    def source(self) -> Value:
        """Where it comes from."""
        return enumerator("SOURCE", SOURCES, self.it["source"])

    @property
    def flags(self) -> Value:
        """Its flags, or those of them that C has."""
        flags = self.it["flags"]
        return number(
            sum(FLAGS[flag] for flag in flags), " | ".join(f"I7000_FLAG_{upper(flag)}" for flag in flags) or "0"
        )

    def message(self, key: str) -> Value:
        """A message of it, or NULL."""
        return pointer(_message(self.it[key], self.folder, self.spec), "i7000_vector_message")

    def wire(self, key: str) -> Value:
        """Bytes of it."""
        return wire(self.it[key], readable=self.folder != "modbus")

    def fault(self) -> Value:
        """Its fault."""
        return enumerator("FAULT", self.spec.faults, self.it.get("fault") or "none")


def _enums_of(prefix: str, values: dict[str, int], keys: Iterable[str] | None) -> Value:
    """Return an array of enumerators as a pointer alone."""
    found = items([enumerator(prefix, values, key) for key in keys or ()], "uint8_t")
    return Value(found.source.rpartition(", ")[0], found.proof)


def _profile(it: Record, spec: Spec) -> Value:
    known = firmware(it["firmware"]) if it["firmware"] else number(0xFFFFFFFE, "I7000_NEWEST")
    model = spec.models[it["model"]]
    types = it["type_codes"]
    codes = [number(code) for code in types] + [number(0)] * (20 - len(types))
    listed = Value("{" + ", ".join(str(code) for code in types) + "}", b"".join(code.proof for code in codes))
    modbus_format = f"modbus_{it.get('modbus_data_format', 'hex')}"
    return row(
        number(model, f"I7000_MODEL_{spec.model_keys[model]}"), enumerator("FORMAT", FORMATS, it["data_format"]),
        enumerator("FORMAT", FORMATS, modbus_format), number(it["checksum"]), number(it["single_ended"]),
        number(len(types)), known, listed,
    )  # fmt: skip


def _message(it: Record | None, folder: str, spec: Spec) -> Value | None:
    if it is None:
        return None
    protocol, names = ("MODBUS", spec.modbus) if folder == "modbus" else ("DCON", spec.dcon)
    fields = [_field(name, value, folder, spec) for name, value in it["fields"].items()]
    return row(enumerator(protocol, names, it["type"]), items(fields, "i7000_vector_field"))


def _field(name: str, value: object, folder: str, spec: Spec) -> Value:
    """Return a field with what it has alone, the rest being zero."""
    field = enumerator("FIELD", spec.fields, name)
    parts = {"number": number(0), "text": optional_text(None), "texts": items([], ""), "words": items([], "")}
    if isinstance(value, str) and name == "values":
        key, found = "words", items([number(int(bit)) for bit in value], "uint16_t")
    elif isinstance(value, str) and folder == "modbus":
        key, found = "number", number(int(value, 16), f"0x{value}")
    elif isinstance(value, str):
        key, found = "text", text(value)
    elif isinstance(value, list) and value and isinstance(value[0], str):
        key, found = "texts", items([text(it) for it in value], "char *const")
    elif isinstance(value, list):
        key, found = "words", items([number(it) for it in value], "uint16_t")
    elif isinstance(value, float):
        key, found = "number", number(round(value * 10))
    elif isinstance(value, int):
        key, found = "number", number(value)
    else:
        raise TypeError(f"{name} of a vector has a value that C has no form for: {value!r}")
    parts[key] = found
    proof = field.proof + b"".join(part.proof for part in parts.values())
    listed, _, count = found.source.rpartition(", ")
    written = f"{listed}, .count = {count}" if key in ("texts", "words") else found.source
    return Value(f"{{.field = {field.source}, .{key} = {written}}}", proof)


# --- kinds of vectors -------------------------------------------------------------------------------------------------


def _exchange(vector: _Vector) -> Value:
    it = vector.it
    asked = "command" if vector.folder == "dcon" else "request"
    return row(
        *vector.names, vector.profile, enumerator("OUTCOME", OUTCOMES, it["outcome"]),
        vector.fault(), vector.source, vector.flags, vector.wire(f"{asked}_wire"), vector.message(asked),
        vector.wire("response_wire"), vector.message("response"),
    )  # fmt: skip


def _reading(vector: _Vector) -> Value:
    it = vector.it
    return row(
        *vector.names, vector.source, vector.flags, number(int(it["type_code"], 16), f"0x{it['type_code']}"),
        enumerator("FORMAT", FORMATS, it["format"]), number(*DIRECTIONS[it.get("direction", "decode")]),
        enumerator("STATUS", STATUSES, it.get("status", "ok")), vector.fault(), text(it["text"]), real(it.get("value")),
    )  # fmt: skip


def _line(vector: _Vector) -> Value:
    it = vector.it
    texts = items([text(field) for field in it["values"]], "char *const")
    return row(
        *vector.names, vector.source, vector.profile, text(it["line"]),
        Value(texts.source.rpartition(", ")[0], texts.proof), _enums_of("STATUS", STATUSES, it["statuses"]),
        number(len(it["values"])),
    )  # fmt: skip


def _reals(values: list[float | None]) -> Value:
    """Return an array of doubles as a pointer alone."""
    found = items([real(value) for value in values], "double")
    return Value(found.source.rpartition(", ")[0], found.proof)


def _channels(vector: _Vector) -> Value:
    it = vector.it
    return row(
        *vector.names, vector.source, vector.profile, vector.message("command"), vector.message("response"),
        _reals(it["values"]), _enums_of("UNIT", UNIT_NUMBERS, map(str.upper, it["units"])),
        _enums_of("STATUS", STATUSES, it["statuses"]),
        number(len(it["values"])),
    )  # fmt: skip


def _register(vector: _Vector) -> Value:
    it = vector.it
    return row(
        *vector.names, vector.source, vector.profile, text(it["name"]), number(it["first"]), number(it["big_endian"]),
        number(*DIRECTIONS[it["direction"]]), vector.fault(), items([number(item) for item in it["items"]], "uint32_t"),
        _reals(it["values"] or []), _enums_of("STATUS", STATUSES, it["statuses"]), number(len(it["values"] or [])),
    )  # fmt: skip


def _checksum(vector: _Vector) -> Value:
    check = wire(vector.it["checksum"].encode().hex(), readable=True)
    return row(text(vector.it["id"]), vector.section, vector.wire("body"), check)


def _crc(vector: _Vector) -> Value:
    return row(*vector.names[:2], wire(vector.it["body"], readable=False), wire(vector.it["crc"], readable=False))


def _split(vector: _Vector) -> Value:
    it = vector.it
    is_dcon = "side" not in it
    return row(
        *vector.names, vector.source, number(it.get("checksum", False)),
        enumerator("SIDE", SIDES, it.get("side", "requests")), vector.profile,
        wire(it["stream"], readable=is_dcon), _events(it["events"], vector, readable=is_dcon),
        wire(it["rest"], readable=is_dcon), _events(it.get("flushed", []), vector, readable=is_dcon),
    )  # fmt: skip


def _events(found: list[Record], vector: _Vector, *, readable: bool) -> Value:
    faults = vector.spec.faults
    return items(
        [
            row(
                enumerator("FAULT", faults, it.get("fault", "none")),
                wire(it.get("frame", it.get("noise")), readable=readable),
            )
            for it in found
        ],
        "i7000_event",
    )


_KINDS: dict[str, tuple[str, Callable[[_Vector], Value]]] = {
    "dcon": ("i7000_exchange", _exchange),
    "modbus": ("i7000_exchange", _exchange),
    "readings": ("i7000_reading_vector", _reading),
    "readings/legacy.json": ("i7000_line_vector", _line),
    "readings/channels.json": ("i7000_channels_vector", _channels),
    "registers": ("i7000_register_vector", _register),
    "frames/checksums.json": ("i7000_check_vector", _checksum),
    "frames/crc.json": ("i7000_check_vector", _crc),
    "frames/split.json": ("i7000_split_vector", _split),
    "frames/rtu_split.json": ("i7000_split_vector", _split),
}
"""The structure of the vectors of a file, or else of its folder, and what makes it."""
