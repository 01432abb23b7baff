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
from i7000.host.procedures.confirm import confirmed
from i7000.host.procedures.identified import Candidate, Identified, Unknown
from i7000.host.procedures.identify import identify
from i7000.host.procedures.places import EVERY_LINE, SCAN_POLICY, Place, places, scan_time
from i7000.host.procedures.read import ChannelFault, Report, read
from i7000.host.procedures.restoring import Restoration, Restored, Status, Writing
from i7000.host.procedures.scan import Finding, FindingKind, Progress, Scanned, scan
from i7000.host.procedures.settings import NOT_SETTINGS, Hazard, Setting, find_setting, hazard_of, settings_of
from i7000.host.procedures.snapshot import SCHEMA_VERSION, Snapshot, snapshot
from i7000.host.procedures.step import (
    Ask,
    BytesHeard,
    PowerCycle,
    Procedure,
    Result,
    SendBytes,
    Step,
    Tell,
    Tune,
    Wait,
    ask,
)

__all__ = [
    "EVERY_LINE",
    "NOT_SETTINGS",
    "SCAN_POLICY",
    "SCHEMA_VERSION",
    "Ask",
    "BytesHeard",
    "Candidate",
    "Change",
    "ChannelFault",
    "Finding",
    "FindingKind",
    "Hazard",
    "Identified",
    "Place",
    "PowerCycle",
    "Procedure",
    "Progress",
    "Report",
    "Restoration",
    "Restored",
    "Result",
    "Scanned",
    "SendBytes",
    "Setting",
    "Snapshot",
    "Status",
    "Step",
    "Tell",
    "Tune",
    "Unknown",
    "Wait",
    "Writing",
    "ask",
    "confirmed",
    "diff",
    "find_setting",
    "hazard_of",
    "identify",
    "places",
    "read",
    "restore",
    "scan",
    "scan_time",
    "set_one",
    "settings_of",
    "snapshot",
]
