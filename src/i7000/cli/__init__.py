"""The command line ``i7000`` (extra ``cli``): decode, encode, explain and simulate.

Parts, from the outside:

* `app` has the commands, each in a module of its own: `decode`, `encode`, `commands`, `registers`, `errata`,
  `simulate`, `proxy`. `options` has what several of them take.
* For `decode`: `source` reads lines and bytes as they arrive, `readers` gives them to `i7000.dissect`, `frame_text`
  makes lines for people of what that returns, `records` JSON, `schema` describes the JSON.
* For `encode`: `message` makes a message of ``field=value``, `by_register` of register names and the map of a model.
* For `commands`, `registers` and `errata`: `explain` collects facts, `facts` reads ``spec/``, `explain_text` prints.
* For `simulate`: `simulation` runs it; `module`, `signals` and `faults` read its options; `traffic`, `view` and
  `module_text` show what happens; `control`, `operating` and `keys` operate it while it runs.
* For `proxy`: `proxying` runs it. For both: `serving` has their ports and how they end, and `outlet` writes without
  waiting.
* For `vectors`: `vector_files` reads the vectors, `codec_process` is the other program, `codec_run` gives it the cases,
  `vector_records` makes the reports, `vector_schema` describes messages and reports.
* For all: `words`, `choices`, `numbers` and `units` read values, `refusals` reports those that are refused, `text`
  prints.

Laws: no input raises; all input is in the output, decoded or not.
"""

import sys
from collections.abc import Sequence

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line, and return the exit code: 0 understood, 1 not understood or refused, 2 wrong usage.

    Special: without the packages of the extra it prints what to install.
    """
    try:
        from i7000.cli.app import run  # noqa: PLC0415 - what it needs may not be there
    except ModuleNotFoundError as missing:
        sys.stderr.write(f'i7000: no module {missing.name}; the command line needs: pip install "i7000[cli]"\n')
        return 2
    return run(arguments)
