"""The end of a run: the module as it was before, and the proof of it."""

from i7000.conformance.guard import GuardError
from i7000.conformance.oracle import Twin
from i7000.frozen import frozen
from i7000.host.procedures import PowerCycle, Procedure, Snapshot, Tune, diff, restore, snapshot
from i7000.settings import LineSettings

__all__ = ["Settled", "settle"]

_OF_ITSELF = frozenset({"host_watchdog_enabled"})
"""The settings that a module changes by itself: a host watchdog that times out is disabled then."""


@frozen
class Settled:
    """What a run left behind.

    Shape: `restored` are the settings that had to be written back; `left` are those that differ still, or that can no
        longer be read. `silent` is whether the module does not answer any more.
    """

    restored: tuple[str, ...] = ()
    left: tuple[str, ...] = ()
    silent: bool = False

    @property
    def is_as_before(self) -> bool:
        """Whether all settings are those of before the run."""
        return not self.left and not self.silent


def settle(
    before: Snapshot, place: Twin, line: LineSettings, *, home: Twin | None = None, writing: bool = True
) -> Procedure[Settled]:
    """Make the procedure that restores a module to a snapshot, wherever a run left it, and reads everything again.

    Shape: `place` is where the module is and how it is spoken to; `home` is where it was before the run: it may be
        there again, or still. `line` has the line settings of the host before the run, to which it returns. Without
        `writing` nothing is restored, only compared.
    """
    if place.state.ram.init_mode and not (home and home.state.ram.init_mode) and (yield PowerCycle()):
        place = Twin.of(place.state.eeprom, place.state.clock)
    found = yield from _found(place)
    if found is None and home is not None:
        place = home
        found = yield from _found(place)
    if found is None:
        yield Tune(line)
        return Settled(silent=True)
    changed = _changed(found, before)
    if not changed or not writing:
        yield Tune(line)
        return Settled(left=changed)
    state = place.state
    wanted = [name for name in changed if name in before]
    try:
        after = yield from restore(
            state.ram.address, state.profile, before, wanted, protocol=state.ram.protocol, line=state.ram.line_settings
        )
    except GuardError:
        yield Tune(line)
        return Settled(left=changed)
    yield Tune(after.line or line)
    again = yield from snapshot(after.address, after.profile, state.ram.protocol)
    return Settled(changed, _changed(again, before), silent=not again.settings)


def _changed(now: Snapshot, before: Snapshot) -> tuple[str, ...]:
    """Return the settings that differ, apart from those that a module changes by itself."""
    return tuple(
        change.name for change in diff(now, before) if not (change.name in _OF_ITSELF and change.before is False)
    )


def _found(place: Twin) -> Procedure[Snapshot | None]:
    """Return the settings of a module; None if it is not at this place."""
    ram = place.state.ram
    yield Tune(ram.line_settings)
    found = yield from snapshot(ram.address, place.state.profile, ram.protocol)
    return found if found.settings else None
