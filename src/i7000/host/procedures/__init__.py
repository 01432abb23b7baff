"""Procedures: conversations of several requests, as generators without I/O and without a clock.

A procedure yields a `Step` and is sent the result of it: a `Result` for `Ask`, None for `Tune`, `Wait` and `Tell`. A
driver that runs procedures carries out each step. Write your own with ``yield from``::

    def module_name(address: int, profile: Profile) -> Procedure[str | None]:
        result = yield from ask(dcon.ReadModuleName(address), profile)
        return result.outcome.response.name if isinstance(result.outcome, Answered) else None

Laws: a procedure makes a bounded number of requests, so it ends on every line. It raises nothing because of what a line
does: what it did not learn, and why, is in the value that it returns.
"""

from i7000.host.procedures.step import Ask, Procedure, Result, Step, Tell, Tune, Wait, ask

__all__ = ["Ask", "Procedure", "Result", "Step", "Tell", "Tune", "Wait", "ask"]
