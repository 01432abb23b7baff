"""``i7000 check``: a module held against the protocol."""

import sys
from typing import Annotated

from cyclopts import Parameter

from i7000.cli.asked import DEFAULT_ONE, OneModule, asked_of
from i7000.cli.harm import HARMLESS, HarmOptions
from i7000.cli.options import UNKNOWN, Module, Texts
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions
from i7000.cli.words import UsageError

__all__ = ["check"]


def check(  # noqa: PLR0913 - each of them is an option
    target: Annotated[
        str | None, Parameter(help="The port: a device, a URL of pyserial, sim:MODEL or exec:COMMAND.")
    ] = None,
    /,
    *select: Annotated[
        str,
        Parameter(help="Ids of checks, groups such as dcon, patterns such as 'map/coil/*', sections such as 2.10."),
    ],
    list_: Annotated[bool, Parameter(name="--list", help="List the checks, and end.", negative="")] = False,
    explain: Annotated[str | None, Parameter(help="Explain a check, and end. Example: --explain link/alive.")] = None,
    schema: Annotated[
        bool, Parameter(help="Print the JSON Schema of a line of a JSON report, and end.", negative="")
    ] = False,
    strict: Annotated[bool, Parameter(help="Let what is allowed but strange (WARN) fail too.", negative="")] = False,
    certify: Annotated[
        bool,
        Parameter(
            help="Check everything, without a baseline, and say in a word whether all passed, with what was allowed and"
            " what was not, and if no --statement was given.",
            negative="",
        ),
    ] = False,
    baseline: Annotated[str | None, Parameter(help="A file with failures that are known; they do not count.")] = None,
    baseline_update: Annotated[
        bool, Parameter(help="Write the failures of this run to --baseline.", negative="")
    ] = False,
    report: Annotated[
        Texts, Parameter(help="Write a report: json=FILE, html=FILE, junit=FILE, pytest=FILE or pcap=FILE; repeat it.")
    ] = (),
    statement: Annotated[
        str | None,
        Parameter(help="A file of i7000 statement: check the module against it, both ways, whatever is selected."),
    ] = None,
    seed: Annotated[int, Parameter(help="Seed of what is random.")] = 0,
    max_time: Annotated[str | None, Parameter(help="Begin no check after this time: 30s, 5min.")] = None,
    quiet: Annotated[bool, Parameter(help="Print only what did not pass, and the summary.", negative="")] = False,
    harm: HarmOptions = HARMLESS,
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
    one: OneModule = DEFAULT_ONE,
    module: Module = UNKNOWN,
) -> int:
    """Check a module against the protocol: which requirement of which section it fails, with the bytes.

    Unless you allow more, only what changes nothing is sent: every frame passes a guard that refuses what a module
    could take for anything else. With `--allow write` settings are changed and restored; the settings of before are in
    a file (`--snapshot`) before anything is written, and everything is read again at the end. `--allow broadcast` sends
    frames that every module of the line hears. `--allow comm` can lose the module: be there to switch its power.
    `--allow calibration` can destroy the calibration.

    The module is asked what it is first; `--model` says it instead, and `--statement` does for a module of no known
    model. What it answers is compared with a model of it that has the same settings. Checks of what the module does not
    have are skipped as `not-applicable`.

    A module that does not answer is looked for at the baud rates and character formats that you do not give, unless
    they mean nothing to the target (`exec:` and `socket:`). What was found is printed, and used for the run.

    Verdicts:

    * `PASS`; `PASS-GOOD-ONLY`: it does what it should, but what it should not do was not tested.
    * `FAIL`; `FLAKY`: repeated, it ended otherwise. `WARN`: allowed, but strange.
    * `INFO`: the manual leaves the point open. `INCONCLUSIVE`: nothing came that could decide.
    * `SKIP`: not carried out, with the reason. `ERROR`: the line or this program failed.

    Example: `i7000 check sim:M-7019R,type=K`

    Example: `i7000 check /dev/ttyUSB0 dcon values --address 2 --report html=module.html`

    Example: `i7000 check 'exec:./firmware' --allow write --report junit=results.xml`

    Exit code: 0 if all that ran passed; 1 for FAIL, FLAKY and PASS-GOOD-ONLY (and WARN with `--strict`) that are not in
    the baseline; 2 for wrong usage or a report that cannot be written; 3 if the port cannot be opened or is lost, or
    the module does not answer; 4 for an internal error; 5 if nothing was decided; 6 if the module was left changed;
    130 after Ctrl-C. The worst one wins.
    """
    from i7000.cli.check_options import Wishes  # noqa: PLC0415 - it takes time
    from i7000.cli.check_text import explained, listed  # noqa: PLC0415 - it takes time
    from i7000.cli.checking import run  # noqa: PLC0415 - it takes time

    if schema:
        from i7000.cli.check_schema import SCHEMA  # noqa: PLC0415 - it takes time

        sys.stdout.write(f"{SCHEMA}\n")
        return 0
    if list_:
        return listed((*((target,) if target else ()), *select))
    if explain is not None:
        return explained(explain)
    if target is None:
        raise UsageError("give a port, such as /dev/ttyUSB0 or sim:M-7019R; --list and --explain need none")
    wishes = Wishes(
        select=select,
        harm=harm,
        strict=strict,
        certify=certify,
        baseline=baseline,
        baseline_update=baseline_update,
        reports=report,
        statement=statement,
        seed=seed,
        max_time=max_time,
        quiet=quiet,
    )
    return run(asked_of(target, line, asking, one, module, detected=True), wishes)
