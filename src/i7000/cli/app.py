"""The commands of ``i7000``, and how a run of it ends."""

import sys
from collections.abc import Sequence
from contextlib import suppress
from typing import Literal

from cyclopts import App, CycloptsError, UnknownOptionError, UnusedCliTokensError

from i7000.cli.backup import backup
from i7000.cli.check import check
from i7000.cli.commands import commands
from i7000.cli.coverage import coverage
from i7000.cli.decode import decode
from i7000.cli.diff import diff
from i7000.cli.encode import encode
from i7000.cli.errata import errata
from i7000.cli.fuzz import fuzz
from i7000.cli.listen import listen
from i7000.cli.options import address_of
from i7000.cli.provoke import provoke
from i7000.cli.proxy import proxy
from i7000.cli.read import read
from i7000.cli.registers import registers
from i7000.cli.replay import replay
from i7000.cli.report import report
from i7000.cli.restore import restore
from i7000.cli.scan import scan
from i7000.cli.send import send
from i7000.cli.set_setting import set_setting
from i7000.cli.simulate import simulate
from i7000.cli.statement import statement
from i7000.cli.text import Printer
from i7000.cli.vectors import DELIMITER, vectors
from i7000.cli.words import UsageError
from i7000_cli import CLOSED, INTERRUPTED

__all__ = ["app", "run"]

app = App(
    name="i7000",
    help="Read ICP DAS I-7000 / M-7000 analog input modules, find, configure and simulate them; decode and encode"
    " their protocols, DCON and Modbus RTU.\n\nExample: `i7000 decode '$012' '!01050600'`\n\nEvery command also exits"
    " with 2 if the output cannot be written, 130 after Ctrl-C, 141 if the reader of the output stops early.",
    help_format="markdown",
    suppress_keyboard_interrupt=False,
)

for _command in (
    decode, encode, commands, registers, errata, listen, read, scan, send, backup, diff, restore, simulate, proxy,
    check, report, replay, provoke, coverage, vectors, fuzz, statement,
):  # fmt: skip
    app.command(_command, version_flags=())
app.command(set_setting, name="set", version_flags=())


@app.command(name="--install-completion")
def install_completion(shell: Literal["bash", "zsh", "fish"], /) -> int:
    """Complete commands and options in new shells. Example: `i7000 --install-completion bash`."""
    file = app.install_completion(shell=shell)
    Printer().record({}, [[(f"completion is in {file}: start a new {shell} to use it", "")]])
    return 0


def run(arguments: Sequence[str] | None) -> int:
    """Run the command line, and return the exit code."""
    arguments = sys.argv[1:] if arguments is None else arguments
    if arguments and arguments[0] == vectors.__name__ and DELIMITER in arguments:  # cyclopts drops the first of these
        at = arguments.index(DELIMITER)
        arguments = [*arguments[:at], DELIMITER, *arguments[at:]]
    try:
        return app(arguments, exit_on_error=False, print_error=False, result_action="return_value") or 0
    except (BrokenPipeError, SystemExit):  # rich makes the latter of the former
        return CLOSED
    except (CycloptsError, UsageError, OSError) as error:
        with suppress(OSError, SystemExit):  # The terminal may be gone.
            Printer().error(_words(error))
        return error.code if isinstance(error, UsageError) else 2
    except ModuleNotFoundError as missing:
        extra = _EXTRAS.get(missing.name or "", "cli")
        Printer().error(f'no module {missing.name}; this needs: pip install "i7000[{extra}]"')
        return 2
    except KeyboardInterrupt:
        return INTERRUPTED


_EXTRAS = {"cattrs": "simulator", "filelock": "simulator", "serial": "serial"}
"""The extras of what an EEPROM file and a port need."""


def _words(error: Exception) -> str:
    """Return what is wrong, of a file with its name first."""
    if isinstance(error, FileExistsError):
        return f"{error.filename} exists: give the name of a new file"
    if isinstance(error, OSError) and error.strerror:
        return error.strerror if error.filename is None else f"{error.filename}: {error.strerror}"
    if isinstance(error, UnusedCliTokensError) and error.unused_tokens:
        unused = error.unused_tokens[0]
        is_address = _is_address(unused, error.app or app)
        meant = f"write --address {unused}" if is_address else "put what has blanks in quotes"
        return f"unexpected argument {unused!r}: {meant}"
    if isinstance(error, UnknownOptionError) and error.command_chain == (send.__name__,):
        option, _, value = f"{error.token.keyword or error.token.value}".partition("=")
        if option == "--address":
            return f"unknown option --address: the address is a field of the command, address={value or 1}"
    return str(error)


def _is_address(text: str, command: App) -> bool:
    """Return whether a text is an address, and the command has an option for one."""
    names = {name for it in command.assemble_argument_collection() for name in it.names}
    if "--address" not in names:
        return False
    try:
        address_of(text)
    except UsageError:
        return False
    return True
