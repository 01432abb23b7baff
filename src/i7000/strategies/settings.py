"""Strategies for settings, snapshots and what becomes of them.

Laws: a snapshot has only settings and values that its model can have. The smallest example is an empty one of an
I-7017.
"""

from collections.abc import Callable, Mapping
from typing import Any

from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import Model, Profile
from i7000.host.procedures.change import Change
from i7000.host.procedures.restoring import Restoration, Restored, Status
from i7000.host.procedures.settings import Setting, hazard_of, settings_of
from i7000.host.procedures.snapshot import Snapshot
from i7000.host.procedures.values import Channels, Choice, Name, Plain, Quantity, Values
from i7000.strategies.dcon import names
from i7000.strategies.vocabulary import addresses, firmwares, line_settings, profiles

__all__ = ["plain_values", "settings", "snapshots"]


def plain_values(values: Values) -> SearchStrategy[Plain]:
    """Make plain values that a setting can have."""
    match values:
        case Choice():
            return st.sampled_from([plain for plain, _ in values.options])
        case Quantity():
            counts = st.integers(values.low, values.high)
            return counts if values.per_unit == 1 else counts.map(lambda count: count / values.per_unit)
        case Channels():
            return st.sets(st.integers(0, values.count - 1)).map(lambda channels: tuple(sorted(channels)))
        case Name():
            return names()


@st.composite
def settings(draw: st.DrawFn, *models: Model) -> Setting:
    """Make settings of `models`, or of all."""
    profile = draw(profiles(*models))
    return draw(st.sampled_from(settings_of(profile, draw(st.sampled_from(sorted(profile.model.protocols))))))


@st.composite
def snapshots(draw: st.DrawFn, *models: Model) -> Snapshot:
    """Make snapshots of `models`, or of all, by any of their protocols."""
    model = draw(st.sampled_from(models or tuple(Model)))
    firmware = draw(st.none() | firmwares())
    protocol = draw(st.sampled_from(sorted(model.protocols)))
    held = settings_of(Profile(model, firmware=firmware, type_codes=()), protocol)
    read = draw(st.lists(st.sampled_from(held), unique_by=lambda setting: setting.name))
    left = [setting.name for setting in held if setting not in read]
    return Snapshot(
        model,
        draw(st.just(str(firmware)) | st.none() | st.text(max_size=6)),
        draw(st.none() | st.text(max_size=6)),
        protocol,
        {setting.name: draw(plain_values(setting.values)) for setting in read},
        {name: draw(st.text()) for name in draw(st.lists(st.sampled_from([*left, "name"]), max_size=3, unique=True))},
    )


@st.composite
def _changes(draw: st.DrawFn) -> Change:
    setting = draw(settings())
    before, after = (draw(st.none() | plain_values(setting.values)) for _ in range(2))
    return Change(setting.name, before, after, hazard_of(setting.name))


@st.composite
def _results(draw: st.DrawFn) -> Restored:
    setting = draw(settings())
    before, after = (draw(st.none() | plain_values(setting.values)) for _ in range(2))
    wanted = draw(plain_values(setting.values))
    return Restored(setting.name, draw(st.sampled_from(Status)), wanted, before, after, draw(st.text()))


def _restorations() -> SearchStrategy[Restoration]:
    lines = st.none() | line_settings(Profile(Model.M_7017))
    return st.builds(Restoration, st.lists(_results(), max_size=3).map(tuple), addresses(), profiles(), lines)


BY_KIND: Mapping[type, Callable[[], SearchStrategy[Any]]] = {
    Change: _changes,
    Restoration: _restorations,
    Restored: _results,
    Setting: settings,
    Snapshot: snapshots,
}
"""The strategies of the public classes."""
