"""The statement of a module, held against it both ways."""

from i7000.conformance.checks.steps import Steps
from i7000.conformance.claims import Claims, asked, has
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Note, Skipped, SkipReason
from i7000.host.procedures import Procedure
from i7000.settings import Protocol

__all__ = ["STEPS"]


def _claims(module: Subject) -> Claims:
    if module.claims is None:
        raise Skipped(SkipReason.PREREQUISITE, "no statement was given: see i7000 statement")
    return module.claims


def _claimed(module: Subject) -> set[str]:
    claims = _claims(module)
    return set(claims.commands) if module.protocol is Protocol.DCON else {*claims.functions, *claims.registers}


def _is_there(module: Subject) -> Procedure[None]:
    queries = asked(module)
    for name in sorted(_claimed(module)):
        if name not in queries:
            raise module.wrong(
                f"the statement claims {name}, which no module has", b"", b"", "names of i7000 statement"
            )
        if not (yield from has(module, queries[name])):
            sent, heard = module.exchange(queries[name])
            what = "is refused" if heard else "is not answered"
            raise module.wrong(f"the statement claims {name}, which {what}", sent, heard, name)
    yield from module.alive(b"")


def _is_all(module: Subject) -> Procedure[None]:
    claimed = _claimed(module)
    for name, query in asked(module).items():
        if name not in claimed and (yield from has(module, query)):
            text = f"the module has {name}, which the statement does not claim"
            raise module.wrong(text, *module.exchange(query), "a refusal or silence")
    yield from module.alive(b"")


def _is_read_so(module: Subject) -> Procedure[None]:
    from i7000.conformance.checks import STEPS as ALL  # noqa: PLC0415 - which has these steps

    for check, claimed in _claims(module).readings:
        if check not in ALL:
            raise module.wrong(
                f"the statement names {check}, which is not a check", b"", b"", "ids of i7000 check --list"
            )
        found = ""
        try:
            yield from ALL[check](module)
        except Note as note:
            found = note.text
        if found != claimed:
            raise module.wrong(f"{check}: {found or 'nothing to note'}", *module.exchange(), claimed)
    yield from module.alive(b"")


STEPS: dict[str, Steps] = {
    "statement/is-there": _is_there,
    "statement/is-all": _is_all,
    "statement/readings": _is_read_so,
}
