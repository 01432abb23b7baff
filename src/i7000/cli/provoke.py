"""``i7000 provoke``: a driver on a line where everything happens that can."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from i7000.cli.options import Texts
from i7000.cli.places import DEFAULT_PLACES, PlaceOptions
from i7000.cli.text import Line, Printer
from i7000.cli.words import UsageError, near

if TYPE_CHECKING:
    from i7000.conformance.scenarios import Scenario

__all__ = ["provoke"]

_LONGEST = 86_400.0
"""The longest time in seconds that can be given."""
_PATIENCE = 15.0
_MAX_TIME = 1800.0
_SHORTEST = 60.0
"""The seconds that a scenario may take in any case."""


def provoke(  # noqa: PLR0913 - each of them is an option
    *command: Annotated[
        str,
        Parameter(
            help="The driver to start, after --, with {target} where its port stands.", allow_leading_hyphen=True
        ),
    ],
    scenario: Annotated[
        Texts, Parameter(help="A scenario, or all; repeat it for each. Example: --scenario late-reply.")
    ] = (),
    list_: Annotated[bool, Parameter(name="--list", help="List the scenarios and exit.", negative="")] = False,
    explain: Annotated[str | None, Parameter(help="Explain a scenario and exit. Example: --explain echo.")] = None,
    schema: Annotated[
        bool, Parameter(help="Print the JSON Schema of a driver's output and exit.", negative="")
    ] = False,
    report_schema: Annotated[bool, Parameter(help="Print the JSON Schema of a report and exit.", negative="")] = False,
    model: Annotated[
        Texts,
        Parameter(
            help="A module that the driver reads, as for `i7000 simulate`; repeat it for each. Default: two I-7018 with"
            " type K, at addresses 1 and 2, by DCON."
        ),
    ] = (),
    driver_output: Annotated[
        str | None,
        Parameter(
            help="Judge a driver that you start: the file to which it writes, or - for standard input.",
            allow_leading_hyphen=True,
        ),
    ] = None,
    report: Annotated[
        Texts, Parameter(help="Write a report as KIND=FILE; the kind is json. Example: json=a.jsonl.")
    ] = (),
    seed: Annotated[int, Parameter(help="Random seed for faults; the same seed repeats the faults.")] = 0,
    patience: Annotated[
        float, Parameter(help="Seconds without a line of the driver after which it counts as a deadlock.")
    ] = _PATIENCE,
    max_time: Annotated[float, Parameter(help="Seconds after which no scenario goes on.")] = _MAX_TIME,
    place: PlaceOptions = DEFAULT_PLACES,
) -> int:
    """Provoke a driver: play everything that a line does, and judge what the driver believes.

    Your driver polls simulated modules, and prints one JSON object a line for each reading that it believes:
    `{"address": 1, "channel": 0, "value": 25.1, "unit": "degC", "status": "ok"}`; `--schema` has all of it. The inputs
    differ for each module and channel, and change all the time: an answer that is taken for another one is seen.
    `{target}` in the command is the port: a pseudo-terminal, `socket://...` or `rfc2217://...`.

    Example: `i7000 provoke --scenario all -- python -m i7000.examples.sync_driver {target} --model I-7018 --type K
    --address 1 --address 2 --polls 1000 --json`

    A driver fails that reports a wrong value, a value that no module gave, no value where it should, or nothing for
    longer than `--patience`, and one that ends. Each scenario has undisturbed answers, so that a driver which reports
    nothing fails too. For modules by Modbus RTU, give `--model M-7018,type=K,protocol=rtu`.

    To start the driver yourself, give one scenario and `--driver-output`: `driver socket://127.0.0.1:5020 | i7000
    provoke --scenario echo --tcp 5020 --driver-output -`.

    Exit code: 0 if all passed; 1 if one failed; 2 for wrong usage; 3 if the driver cannot be started, or its output
    does not fit the schema; 5 if nothing ran, or a scenario was inconclusive; 130 after Ctrl-C.
    """
    if schema or report_schema:
        sys.stdout.write(f"{_schema(report=report_schema)}\n")
        return 0
    printer = Printer()
    if list_ or explain is not None:
        printer.lines(_listed() if explain is None else _explained(_found(explain)))
        return 0
    chosen = _chosen(scenario)
    _check(command, driver_output, len(chosen))
    times = (("--patience", patience, _PATIENCE), ("--max-time", max_time, _MAX_TIME))
    for name, value, _ in times:
        if not 0 < value <= _LONGEST:
            raise UsageError(f"{name} {value:g}: give more than 0, and at most {_LONGEST:g} seconds")
    from i7000.cli.provoking import Provoking, run  # noqa: PLC0415 - networks take time to import

    options = [*place.given, *(word for text in model for word in ("--model", text))]
    options += [word for name, value, default in times if value != default for word in (name, f"{value:g}")]
    options += () if driver_output is None else ("--driver-output", driver_output)
    provoking = Provoking(
        chosen,
        model,
        place.has_pty,
        place.places(),
        command,
        driver_output or "",
        seed,
        max_time,
        max(_SHORTEST, 4 * patience),
        patience,
        _report(report),
        tuple(options),
    )
    return run(provoking, printer)


def _schema(*, report: bool) -> str:
    if report:
        from i7000.cli.provoke_report import SCHEMA as REPORT  # noqa: PLC0415 - only here

        return REPORT
    from i7000.conformance.believed import SCHEMA  # noqa: PLC0415

    return SCHEMA


def _chosen(names: Texts) -> "tuple[Scenario, ...]":
    """Return the scenarios with some names."""
    from i7000.conformance.scenarios import SCENARIOS  # noqa: PLC0415

    if not names:
        raise UsageError("give --scenario NAME or --scenario all; --list shows the scenarios")
    found = [_found(name) for name in dict.fromkeys(names) if name != "all"]
    return SCENARIOS if "all" in names else tuple(found)


def _found(name: str) -> "Scenario":
    from i7000.conformance.scenarios import SCENARIOS  # noqa: PLC0415

    scenarios = {it.name: it for it in SCENARIOS}
    if name not in scenarios:
        raise UsageError(f"there is no scenario {name!r}{near(name, scenarios) or '; --list shows them'}")
    return scenarios[name]


def _check(command: tuple[str, ...], output: str | None, scenarios: int) -> None:
    """Refuse what is neither a driver to start nor one that somebody else starts."""
    if bool(command) is (output is not None):
        raise UsageError("give a driver to start after --, or --driver-output for one that you start")
    if command and not any("{target}" in part for part in command):
        raise UsageError("write {target} in the command where the port of the driver stands")
    if not command and scenarios > 1:
        raise UsageError("a driver that you start takes one scenario: each has a port of its own")


def _listed() -> list[Line]:
    from i7000.conformance.scenarios import SCENARIOS  # noqa: PLC0415

    return [[(f"{it.name:<19} ", "bold"), (it.title, "")] for it in SCENARIOS]


def _explained(it: "Scenario") -> list[Line]:
    names = {"DCON": "DCON", "MODBUS_RTU": "Modbus RTU"}
    facts = {
        "on the line": it.line,
        "a right driver": it.right,
        "manual": ", ".join(it.sections),
        "protocols": " and ".join(sorted(names[one.name] for one in it.protocols)),
        "modules": f"{it.series}..." if it.series else "",
        "checksum": "needed in DCON" if it.sealed else "",
    }
    for number, step in enumerate(it.steps, 1):
        faults = step.faults or "no faults"
        by_rtu = "" if step.by_rtu is None else f"; by Modbus RTU {_BELIEFS[step.by_rtu]}"
        words = f"{step.answers} answers, {faults}, inputs {step.inputs}: {_BELIEFS[step.belief]}{by_rtu}"
        facts[f"step {number}"] = words
    return [
        [(it.name, "bold"), (f": {it.title}", "")],
        *[[(f"  {name:<15} {words}", "")] for name, words in facts.items() if words],
    ]


_BELIEFS = {"must": "to be reported", "may": "reported or rejected", "never": "not to be reported"}


def _report(texts: Texts) -> Path | None:
    found = None
    for text in texts:
        kind, equals, path = text.partition("=")
        if kind != "json" or not equals or not path or found is not None:
            raise UsageError(f"--report {text}: give json=FILE, once")
        found = Path(path)
    return found
