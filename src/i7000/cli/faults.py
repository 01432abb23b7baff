"""How faults of the line are written: ``late=0.25:0.9@01``.

Laws: any text gives a value or a `UsageError`; `faults_words` writes what `read_faults` reads.
"""

from collections.abc import Iterable, Iterator
from typing import Any

from attrs import evolve, fields_dict

from i7000 import InvalidValueError
from i7000.cli.numbers import integer
from i7000.cli.refusals import as_written
from i7000.cli.words import UsageError, near, truth
from i7000.simulator.faults import Faults, Way

__all__ = ["faults_words", "read_faults"]

_SECOND = {"late": "late_by", "refuse": "refuse_code", "split": "split_by"}
"""The faults that have another value after the probability."""
_SECOND_WORDS = {"late": "number of seconds", "refuse": "code", "split": "number of seconds"}
_DEFAULT = Faults()
_FAULTS = [name for name in fields_dict(Faults) if name not in {*_SECOND.values(), "scoped"}]
_SWITCHES = [name for name in _FAULTS if isinstance(getattr(_DEFAULT, name), bool)]


def read_faults(texts: Iterable[str], faults: Faults = _DEFAULT) -> Faults:
    """Return faults changed by texts; the last text for the same fault counts.

    Shape: ``NAME[=PROBABILITY[:VALUE]][@WHERE]``; WHERE is ``to``, ``from`` or an address.
    Errors: `UsageError`.

    >>> faults = read_faults(["echo", "late=0.1:0.25", "drop=0.01@to"])
    >>> faults.echo, faults.late, faults.late_by, faults.drop, faults.requests.drop
    (True, 0.1, 0.25, 0.0, 0.01)
    """
    for text in texts:
        what, at, where = text.partition("@")
        name, values = _values(what, text)
        try:
            faults = faults.at(_where(where, text), **values) if at else evolve(faults, **values)
        except InvalidValueError as error:
            if error.field == "fault":
                reason = "requests can only have drop, flip and noise" if where == Way.TO else f"{name} is for all"
                raise UsageError(f"{text!r}: {reason}: write {what}") from None
            raise UsageError(f"{text!r}: {_refused(error, what)}") from None
    return faults


def _refused(error: InvalidValueError, what: str) -> InvalidValueError:
    """Return a refusal with the value as it was written."""
    probability, _, second = what.partition("=")[2].partition(":")
    words = {field: (f"the {_SECOND_WORDS[name]} of {name}", second) for name, field in _SECOND.items()}
    return as_written(error, *words.get(error.field, (error.field, probability)))


def _values(text: str, whole: str) -> tuple[str, dict[str, Any]]:
    """Return the name of a fault, and the values of its fields."""
    name, equals, value = text.partition("=")
    if name not in _FAULTS:
        raise UsageError(f"there is no fault {name!r}; faults are {', '.join(_FAULTS)}{near(name, _FAULTS)}")
    if name in _SWITCHES:
        return name, {name: truth(value) if equals else True}
    probability, colon, second = value.partition(":")
    if colon and name not in _SECOND:
        raise UsageError(f"{whole!r}: only late and split have a time, and refuse a code")
    example = f"such as {name}={_EXAMPLES.get(name, '0.01')}"
    try:
        found: dict[str, Any] = {name: float(probability)}
    except ValueError:
        raise UsageError(f"{whole!r}: give a probability, {example}") from None
    if colon:
        try:
            found[_SECOND[name]] = integer(second) if name == "refuse" else float(second)
        except (ValueError, UsageError):
            raise UsageError(f"{whole!r}: {second!r} is not a {_SECOND_WORDS[name]}, {example}") from None
    return name, found


_EXAMPLES = {"late": "0.1:0.25", "refuse": "0.1:02h", "split": "0.1:0.05"}


def _where(text: str, whole: str) -> Way | int:
    if text in list(Way):
        return Way(text)
    try:
        address = integer(text)
    except UsageError:
        raise UsageError(f"{whole!r}: after @ stands to, from or an address such as 01") from None
    if not 0 <= address <= 0xFF:
        raise UsageError(f"{whole!r}: an address is 0..255 or 00h..FFh")
    return address


def faults_words(faults: Faults) -> str:
    """Return faults as they are written; ``off`` if there are none.

    >>> faults_words(read_faults(["lumps", "late=0.1:0.25", "refuse=1@02"])), faults_words(Faults())
    ('lumps late=0.1:0.25 refuse=1@02h', 'off')
    """
    common = {
        name: value for name in fields_dict(Faults) if (value := getattr(faults, name)) != getattr(_DEFAULT, name)
    }
    words = list(_words({name: getattr(faults, name) for name in _with_seconds(common)}, ""))
    for where in dict.fromkeys(it.where for it in faults.scoped):
        values = {it.name: it.value for it in faults.scoped if it.where == where}
        words += _words(values, f"@{where}" if isinstance(where, Way) else f"@{where:02X}h")
    return " ".join(words) or "off"


def _with_seconds(names: Iterable[str]) -> set[str]:
    """Return names of fields, both of a fault with two values."""
    pairs = [{name, second} for name, second in _SECOND.items()]
    return set(names) - {"scoped"} | {name for pair in pairs if not pair.isdisjoint(names) for name in pair}


def _words(values: dict[str, Any], end: str) -> Iterator[str]:
    for name in _FAULTS:
        if name not in values:
            continue
        value, second = values[name], values.get(_SECOND.get(name, ""))
        if name in _SWITCHES:
            yield name + ("" if value else "=off") + end
        else:
            yield f"{name}={_number(value)}" + ("" if second is None else f":{_number(second)}") + end


def _number(value: float) -> str:
    return str(value).removesuffix(".0")
