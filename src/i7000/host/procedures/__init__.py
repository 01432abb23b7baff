"""Procedures: conversations of several requests, as generators without I/O and without a clock.

A procedure yields a `Step` and is sent the result of it: a `Result` for `Ask`, None for `Tune`, `Wait` and `Tell`. A
driver that runs procedures carries out each step. Write your own with ``yield from``::

    def module_name(address: int, profile: Profile) -> Procedure[str | None]:
        result = yield from ask(dcon.ReadModuleName(address), profile)
        return result.outcome.response.name if isinstance(result.outcome, Answered) else None

Laws: a procedure makes a bounded number of requests, so it ends on every line. It raises nothing because of what a line
does: what it did not learn, and why, is in the value that it returns.
"""

from i7000.host.procedures.change import Change, diff, restore, set_one
from i7000.host.procedures.restoring import Restoration, Restored, Status
from i7000.host.procedures.settings import NOT_SETTINGS, Hazard, Setting, find_setting, hazard_of, settings_of
from i7000.host.procedures.snapshot import SCHEMA_VERSION, Snapshot, snapshot
from i7000.host.procedures.step import Ask, Procedure, Result, Step, Tell, Tune, Wait, ask

__all__ = [
    "NOT_SETTINGS",
    "SCHEMA_VERSION",
    "Ask",
    "Change",
    "Hazard",
    "Procedure",
    "Restoration",
    "Restored",
    "Result",
    "Setting",
    "Snapshot",
    "Status",
    "Step",
    "Tell",
    "Tune",
    "Wait",
    "ask",
    "diff",
    "find_setting",
    "hazard_of",
    "restore",
    "set_one",
    "settings_of",
    "snapshot",
]
