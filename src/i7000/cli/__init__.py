"""The command line ``i7000``: what frames of a log mean, frames to send, what a model can do (extra ``cli``).

Parts, from the outside: `app` has the commands and their options; `text` prints; `source` reads lines as they arrive,
`log` and `hex_lines` find the frames in them; `reader` and `rtu` find what they can mean to those who know what `dcon`
holds, `records` and `rtu_records` make records of that, `registers` names what Modbus messages touch; `message` makes
messages of ``field=value``; `simulate` runs a simulation, `simulated` reads what it is of, `traffic` and `view` show
what goes on in it, `outlet` writes that without waiting; `words` says values for people.
Laws: what is put in never raises; nothing that was put in is left out of what comes out.
"""

import sys
from collections.abc import Sequence

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line, and tell the exit code: 0 understood, 1 not understood or refused, 2 wrong usage.

    Special: without the packages of the extra it says what to install.
    """
    try:
        from i7000.cli.app import run  # noqa: PLC0415 - what it needs may not be there
    except ModuleNotFoundError as missing:
        sys.stderr.write(f'i7000: no module {missing.name}; the command line needs: pip install "i7000[cli]"\n')
        return 2
    return run(arguments)
