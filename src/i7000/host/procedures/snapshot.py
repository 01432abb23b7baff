"""A snapshot: everything that is set on a module, read with one procedure and kept as JSON.

Laws: a snapshot has only values that its model can have. Equal snapshots are equal JSON, byte by byte.
"""

import json
from collections.abc import Mapping
from typing import Any, Self, TypeVar

from attrs import field

from i7000.arguments import as_tuple, check_type
from i7000.errors import InvalidValueError, shown
from i7000.frozen import frozen
from i7000.host.procedures.inquiry import Here, Seen, ask_setting, identity, plain_value, refined, spot
from i7000.host.procedures.settings import Setting, known_settings, settings_of
from i7000.host.procedures.step import Procedure
from i7000.host.procedures.values import PROTOCOLS, Choice, Plain, choices
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import Protocol

__all__ = ["SCHEMA_VERSION", "Snapshot", "snapshot"]

SCHEMA_VERSION = 1
"""The version of the JSON form of a snapshot."""

T = TypeVar("T")
_KEYS = ("schema_version", "model", "firmware", "name", "protocol", "settings", "unread")


_Given = Mapping[str, T] | tuple[tuple[str, T], ...]


def _pairs(given: _Given[T]) -> tuple[tuple[str, T], ...]:
    """Return a mapping, or pairs, as pairs in the order of their names."""
    pairs = as_tuple("settings", given.items() if isinstance(given, Mapping) else given)
    if not all(isinstance(pair, tuple) and len(pair) == 2 and isinstance(pair[0], str) for pair in pairs):
        raise InvalidValueError("settings", given, "a mapping of names, or pairs of a name and a value", "")
    if len(dict(pairs)) != len(pairs):
        raise InvalidValueError("settings", given, "each name once", "")
    return tuple(sorted(pairs, key=lambda pair: in_order(pair[0])))


def _settings(given: _Given[Plain]) -> tuple[tuple[str, Plain], ...]:
    return _pairs(given)


def _reasons(given: _Given[str]) -> tuple[tuple[str, str], ...]:
    return _pairs(given)


def in_order(name: str) -> tuple[str, int]:
    """Return the key that sorts names: channel 10 comes after channel 9.

    >>> sorted(["type_code.10", "filter", "type_code.9"], key=in_order)
    ['filter', 'type_code.9', 'type_code.10']
    """
    base, _, channel = name.partition(".")
    return base, int(channel) if channel.isdecimal() and len(channel) < len("1000") else -1


@frozen
class Snapshot:
    """What is set on a module, by the names of the settings and in the units that people read.

    Shape: `settings` are pairs of a name and a plain value, `unread` pairs of a name and the reason why it could not be
        read; both accept mappings. `firmware` and `name` are as the module sent them; by Modbus `name` is the series.
    Errors: `InvalidValueError` for what the model does not have.

    >>> Snapshot(Model.I_7018, settings={"type_code": "K", "host_watchdog_timeout": 2.5})["host_watchdog_timeout"]
    2.5
    """

    model: Model
    firmware: str | None = None
    name: str | None = None
    protocol: Protocol = Protocol.DCON
    settings: tuple[tuple[str, Plain], ...] = field(default=(), converter=_settings)
    unread: tuple[tuple[str, str], ...] = field(default=(), converter=_reasons)

    def __attrs_post_init__(self) -> None:
        for name, value, kinds in (
            ("model", self.model, Model), ("firmware", self.firmware, str | None), ("name", self.name, str | None),
            ("protocol", self.protocol, Protocol),
        ):  # fmt: skip
            if not isinstance(value, kinds):
                raise InvalidValueError(name, value, f"an instance of {getattr(kinds, '__name__', kinds)}", "")
        for name, reason in self.unread:
            if not isinstance(reason, str):
                raise InvalidValueError(f"unread[{name}]", reason, "a reason in words", "")
        known = known_settings(self.model)
        settings = tuple((name, _plain(self.model, known, name, value)) for name, value in self.settings)
        object.__setattr__(self, "settings", settings)  # with 2.0 for 2, so that equal ones are the same text

    def __getitem__(self, name: str) -> Plain:
        """Return the value of a setting; `KeyError` for one that was not read."""
        return dict(self.settings)[name]

    def __contains__(self, name: object) -> bool:
        return name in dict(self.settings)

    def to_json(self) -> str:
        """Return the snapshot as JSON: ASCII, names in order, one name a line."""
        document = {
            "schema_version": SCHEMA_VERSION,
            "model": self.model.value,
            "firmware": self.firmware,
            "name": self.name,
            "protocol": choices(Protocol).plain("protocol", self.protocol),
            "settings": dict(self.settings),
            "unread": dict(self.unread),
        }
        return _lines(document)

    @classmethod
    def from_json(cls, text: str | bytes) -> Self:
        """Return the snapshot of a JSON text; limit the size of what you read from a file before.

        Errors: `InvalidValueError` for text that is not the JSON of a snapshot: it names the first thing that is wrong.

        >>> Snapshot.from_json(Snapshot(Model.I_7018, settings={"address": 1}).to_json())["address"]
        1
        """
        check_type("text", text, str, bytes)
        document = _document(text)
        version = document["schema_version"]
        if type(version) is not int or version != SCHEMA_VERSION:
            raise InvalidValueError("schema_version", version, f"{SCHEMA_VERSION}, that of this program", "")
        models = {model.value: model for model in Model}
        protocols = PROTOCOLS | {protocol.name.lower(): protocol for protocol in Protocol}
        settings, unread = (_mapping(document, key) for key in ("settings", "unread"))
        return cls(
            _one_of("model", document["model"], models),
            document["firmware"],
            document["name"],
            _one_of("protocol", document["protocol"], protocols),
            {name: tuple(value) if isinstance(value, list) else value for name, value in settings.items()},
            unread,
        )


def _plain(model: Model, known: Mapping[str, Setting], name: str, value: object) -> Plain:
    """Return the plain value of a setting; an int may stand for a float.

    Errors: `InvalidValueError` for a name that the model does not have, and for a value that is not plain.
    """
    if name not in known:
        reason = f"{model.value} has no setting {shown(name)}"
        raise InvalidValueError("settings", name, "the names of `settings_of`", "", reason)
    values = known[name].values
    plain = values.plain(name, values.typed(name, value))
    if isinstance(values, Choice) and value in values.also:
        return plain
    if plain != value or type(plain) not in (type(value), float):
        raise InvalidValueError(name, value, f"a plain value: {values.allowed}", "")
    return plain


# --- JSON -------------------------------------------------------------------------------------------------------------


def _lines(document: Mapping[str, Any]) -> str:
    """Return an object as JSON with a line for each of its names, and for those of an object in it."""

    def value(it: Any) -> str:  # noqa: ANN401 - whatever JSON has
        if not isinstance(it, dict):
            return json.dumps(it, allow_nan=False)
        inner = ",\n".join(f"    {json.dumps(name)}: {json.dumps(held, allow_nan=False)}" for name, held in it.items())
        return f"{{\n{inner}\n  }}" if it else "{}"

    return "{\n" + ",\n".join(f"  {json.dumps(name)}: {value(it)}" for name, it in document.items()) + "\n}\n"


def _damaged(reason: str) -> InvalidValueError:
    return InvalidValueError("json", None, "the JSON that `to_json` returns", "", f"this is not a snapshot: {reason}")


def _document(text: str | bytes) -> dict[str, Any]:
    """Return the object in a JSON text, with the keys of a snapshot."""

    def constant(name: str) -> None:
        raise _damaged(f"{name} is not a value of JSON")

    def unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found = dict(pairs)
        if len(found) != len(pairs):
            raise _damaged(f"a name stands twice among {shown([name for name, _ in pairs])}")
        return found

    try:
        text = text.decode() if isinstance(text, bytes) else text
        document = json.loads(text, parse_constant=constant, object_pairs_hook=unique)
    except InvalidValueError:
        raise
    except (ValueError, RecursionError) as error:
        raise _damaged(str(error)) from None
    if not isinstance(document, dict):
        raise _damaged("it is not an object")
    if set(document) != set(_KEYS):
        odd = sorted(set(document) ^ set(_KEYS))
        raise _damaged(f"{shown(odd[0])} is {'unknown' if odd[0] in document else 'missing'}; keys: {', '.join(_KEYS)}")
    return document


def _mapping(document: dict[str, Any], key: str) -> dict[str, Any]:
    found = document[key]
    if not isinstance(found, dict):
        raise InvalidValueError(key, found, "an object of names", "")
    return found


def _one_of(name: str, value: object, known: Mapping[str, Any]) -> Any:  # noqa: ANN401
    if not isinstance(value, str) or value not in known:
        raise InvalidValueError(name, value, ", ".join(known), "")
    return known[value]


# --- reading a module -------------------------------------------------------------------------------------------------


def snapshot(address: int, profile: Profile, protocol: Protocol = Protocol.DCON) -> Procedure[Snapshot]:
    """Return the procedure that reads everything that is set on a module, and changes nothing.

    Shape: the procedure returns a `Snapshot`; what it could not read is in `unread`.
    Special: firmware and connecting mode are read first. A firmware of the profile is used as given; without one, that
        of the module is used.
    Errors: `ArgumentError`; `InvalidValueError` for an address that the protocol does not have.
    """
    return _snapshot(spot(address, profile, protocol))


def _snapshot(here: Here) -> Procedure[Snapshot]:
    seen = Seen()
    identified = yield from identity(here)
    here = yield from refined(here, identified.firmware, seen)
    unread = dict(identified.unread)
    values: dict[str, Plain] = {}
    for setting in settings_of(here.profile, here.protocol):
        answer = yield from ask_setting(here, setting, seen)
        value, reason = plain_value(setting, answer)
        if value is None:
            unread[setting.name] = reason
        else:
            values[setting.name] = value
    return Snapshot(here.profile.model, identified.firmware, identified.name, here.protocol, values, unread)
