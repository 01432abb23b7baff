"""The end of a run: the module as it was before, and the proof of it."""

from i7000.conformance.guard import GuardError
from i7000.conformance.oracle import Twin
from i7000.frozen import frozen
from i7000.host.procedures import Procedure, Snapshot, Tune, diff, restore, snapshot
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


def settle(before: Snapshot, place: Twin, line: LineSettings) -> Procedure[Settled]:
    """Make the procedure that restores a module to a snapshot, wherever a run left it, and reads everything again.

    Shape: `place` is where the module is and how it is spoken to; `line` has the line settings of the host before the
        run, to which it returns.
    Special: where the guard refuses the writes, nothing is restored; a module that only read should be as before.
    """
    state = place.state
    yield Tune(state.ram.line_settings)
    address, profile, protocol = state.ram.address, state.profile, state.ram.protocol
    now = yield from snapshot(address, profile, protocol)
    if not now.settings:
        return Settled(silent=True)
    changed = tuple(change.name for change in diff(now, before))
    if not changed:
        yield Tune(line)
        return Settled()
    wanted = [name for name in changed if name in before]
    try:
        after = yield from restore(address, profile, before, wanted, protocol=protocol, line=state.ram.line_settings)
    except GuardError:
        yield Tune(line)
        return Settled(left=tuple(name for name in changed if name not in _OF_ITSELF))
    yield Tune(after.line or line)
    again = yield from snapshot(after.address, after.profile, protocol)
    return Settled(changed, tuple(change.name for change in diff(again, before)), silent=not again.settings)
