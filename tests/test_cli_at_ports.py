"""Settings of modules in other processes: saved, changed, compared and restored at ports of this machine."""

import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.simulation import MAIN, free_port, process
from tests.terminal import Run
from tests.waiting import ENOUGH


@contextmanager
def pty(module: str) -> Iterator[str]:
    with process("--model", module, "--pty", stdout=subprocess.PIPE, text=True) as simulator:
        assert simulator.stdout
        yield simulator.stdout.readline().strip()


@contextmanager
def rfc2217(module: str) -> Iterator[str]:
    port = free_port()
    with process("--model", module, "--rfc2217", f"{port}", stdout=subprocess.PIPE, text=True) as simulator:
        assert simulator.stdout
        simulator.stdout.readline()
        yield f"rfc2217://127.0.0.1:{port}"


@pytest.mark.parametrize(
    ("where", "module", "line"),
    [
        (pty, "I-7018,checksum=true", ("--checksum", "--protocol", "dcon")),
        (rfc2217, "M-7019R@B3.7,type=K,baud=115200", ("--baud", "115200", "--protocol", "rtu")),
        (rfc2217, "M-7018,protocol=dcon,baud=38400,character_format=E81",
         ("--baud", "38400", "--character-format", "E81", "--protocol", "dcon", "--no-checksum")),
        (pty, "M-7017,address=5,init=true", ("--address", "0")),
    ],
)  # fmt: skip
def test_a_module_is_saved_changed_compared_and_restored(
    where: Any, module: str, line: tuple[str, ...], run: Run, tmp_path: Path
) -> None:
    path = str(tmp_path / "a.json")
    with where(module) as port:
        codes = [
            run(command, port, *arguments, *line).code
            for command, arguments in (
                ("backup", (path,)),
                ("set", ("host_watchdog_timeout=2.5",)),
                ("diff", (path,)),
                ("restore", (path, "--yes")),
                ("diff", (path,)),
            )
        ]

    assert codes == [0, 0, 1, 0, 0]


@pytest.mark.parametrize("where", [pty, rfc2217])
def test_one_command_is_sent(where: Any, run: Run) -> None:
    model = ("--model", "M-7019R")
    with where("M-7019R,type=K") as port:
        write = ("WriteSingleRegister", "address=1", "register=response_delay", "value=5")
        told = run("send", port, *write, *model, "--yes")

    assert (told.code, told.out.count("40488           response_delay  5 ms")) == (0, 2)


def test_a_process_that_is_interrupted_between_two_settings_says_what_it_changed() -> None:
    wanted = [f"cjc_offset.{channel}=1.5" for channel in range(8)]
    with pty("M-7019R,type=K,baud=1200") as port:
        command = [sys.executable, "-c", MAIN, "set", port, *wanted, "--baud", "1200"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as started:  # noqa: S603
            assert started.stdout
            assert started.stderr
            first = started.stdout.readline()
            started.send_signal(signal.SIGINT)
            rest = started.stdout.read()
            errors = started.stderr.read()
            code = started.wait(timeout=ENOUGH)

    done = (first + rest).count(" done\n")
    assert code == 130
    assert 1 <= done < len(wanted)
    assert errors.splitlines()[-1].endswith(" was changed before")
    assert "Traceback" not in errors
