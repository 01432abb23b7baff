"""Changes of settings: what differs, and how to make it so without losing the module.

Laws: nothing is written that is already so, or that was not named. A command that carries several settings is made from
what was read just before, with only the named ones changed. Every write is read back. What could lose the module comes
last, and only if it was named.
"""

from collections.abc import Iterable, Mapping

from i7000.arguments import as_tuple, check_type
from i7000.errors import InvalidValueError, shown
from i7000.frozen import frozen
from i7000.host.procedures.inquiry import spot
from i7000.host.procedures.restoring import Restoration, make_so
from i7000.host.procedures.settings import Hazard, find_setting, hazard_of
from i7000.host.procedures.snapshot import Snapshot, in_order
from i7000.host.procedures.step import Procedure
from i7000.host.procedures.values import Plain
from i7000.profile import Profile
from i7000.settings import LineSettings, Protocol

__all__ = ["Change", "diff", "restore", "set_one"]


@frozen
class Change:
    """A setting that differs between two snapshots.

    Shape: `before` or `after` is None where a snapshot does not have the setting.
    """

    name: str
    before: Plain | None
    after: Plain | None
    hazard: Hazard


def diff(one: Snapshot, other: Snapshot) -> tuple[Change, ...]:
    """Return the settings that differ between two snapshots, in the order of their names.

    >>> from i7000 import Model
    >>> one, other = (Snapshot(Model.I_7018, settings={"type_code": code}) for code in "JK")
    >>> diff(one, other)
    (Change(name='type_code', before='J', after='K', hazard=<Hazard.PLAIN: 'plain'>),)
    """
    check_type("one", one, Snapshot)
    check_type("other", other, Snapshot)
    before, after = dict(one.settings), dict(other.settings)
    names = sorted({*before, *after}, key=in_order)
    return tuple(
        Change(name, before.get(name), after.get(name), hazard_of(name))
        for name in names
        if before.get(name) != after.get(name)
    )


def restore(  # noqa: PLR0913 - what it depends on
    address: int,
    profile: Profile,
    wanted: Snapshot,
    names: Iterable[str | Change] | None = None,
    *,
    protocol: Protocol = Protocol.DCON,
    line: LineSettings | None = None,
) -> Procedure[Restoration]:
    """Return the procedure that makes settings of a module as they are in a snapshot.

    Shape: `names` are the settings to restore: ``type_code.3``, or ``type_code`` for all channels; `Change` for its
        name. Without `names`, all that cannot lose the module. `line` has the line settings of the host; None means
        those that the module has stored.
    Errors: `ArgumentError`; `InvalidValueError` for a name that the snapshot does not have.
    """
    named = named_settings(wanted, names)
    return make_so(spot(address, profile, protocol, line), dict(wanted.settings), named)


def named_settings(wanted: Snapshot, names: Iterable[str | Change] | None) -> frozenset[str]:
    """Return the settings of a snapshot that `names` of `restore` stand for.

    Errors: `ArgumentError`; `InvalidValueError` for a name that the snapshot does not have.

    >>> from i7000 import Model
    >>> wanted = Snapshot(Model.I_7018, settings={"type_code": "K", "baud_rate": 9600})
    >>> named_settings(wanted, None), named_settings(wanted, ["baud_rate"])
    (frozenset({'type_code'}), frozenset({'baud_rate'}))
    """
    check_type("wanted", wanted, Snapshot)
    settings = dict(wanted.settings)
    if names is None:
        return frozenset(name for name in settings if hazard_of(name) is Hazard.PLAIN)
    if isinstance(names, str):
        names = (names,)
    return frozenset(name for key in as_tuple("names", names) for name in _named(key, settings))


def _named(key: str | Change, settings: Mapping[str, Plain]) -> Iterable[str]:
    """Return the settings that a name stands for."""
    check_type("names", key, str, Change)
    name = key if isinstance(key, str) else key.name
    found = [it for it in settings if name in (it, it.partition(".")[0])]
    if not found:
        raise InvalidValueError("names", name, ", ".join(settings), "", f"the snapshot has no setting {shown(name)}")
    return found


def set_one(  # noqa: PLR0913 - what it depends on
    address: int,
    profile: Profile,
    name: str,
    value: object,
    *,
    protocol: Protocol = Protocol.DCON,
    line: LineSettings | None = None,
) -> Procedure[Restoration]:
    """Return the procedure that sets one setting, and reads it back.

    Shape: `value` is a plain value, or text as people write it: ``K``, ``2.5 s``, ``on``, ``0-3,5``.
    Errors: `InvalidValueError` for a setting that the module does not have, and for a value that it cannot have;
        `ArgumentError`.
    """
    here = spot(address, profile, protocol, line)
    setting = find_setting(name, profile, protocol)
    plain = setting.values.plain(name, setting.values.typed(name, value))
    return make_so(here, {name: plain}, frozenset((name,)))
