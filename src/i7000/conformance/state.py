"""The procedure that makes the statement of a module."""

from collections.abc import Iterable

from i7000.conformance.claims import Claims, asked, has
from i7000.conformance.hazard import DEFAULT_ALLOWED
from i7000.conformance.oracle import Twin, eeprom_of
from i7000.conformance.run import Options, Run, plan
from i7000.conformance.statement import Level, Statement
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Reason, Verdict
from i7000.host.procedures import Procedure, Snapshot
from i7000.settings import LineSettings, Protocol

__all__ = ["stated"]


def stated(
    snapshot: Snapshot, statements: Iterable[Statement], line: LineSettings, *, checksum: bool
) -> Procedure[Claims]:
    """Make the procedure that asks a module for everything that any model has, and states what it answered.

    Shape: `statements` are those of ``spec/checks``: the open ones say how the module reads the manual.
    """
    eeprom = eeprom_of(snapshot)
    profile = Twin.of(eeprom, 0.0).state.profile
    wanted = [it for it in statements if it.level is Level.OPEN or it.id == "link/alive"]
    planned = plan(wanted, profile, snapshot.protocol, DEFAULT_ALLOWED)
    run = Run(planned, eeprom, Options(allowed=DEFAULT_ALLOWED), line=line, checksum=checksum)
    module = Subject(run.twin, line)
    found = []
    for name, query in asked(module).items():
        try:
            there = yield from has(module, query)
        except Reason:
            continue
        if there:
            found.append(name)
    yield from run.procedure()
    of_dcon = snapshot.protocol is Protocol.DCON
    return Claims(
        snapshot.model.value,
        snapshot.firmware,
        snapshot.name,
        snapshot.protocol,
        commands=tuple(found) if of_dcon else (),
        functions=tuple(name for name in found if not of_dcon and name[2:3] == "/"),
        registers=tuple(name for name in found if not of_dcon and name[2:3] != "/"),
        types=tuple(code.name for code in module.profile.type_codes),
        readings=tuple((it.id, it.text) for it in run.results if it.verdict is Verdict.INFO),
    )
