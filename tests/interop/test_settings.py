"""Settings of a device that has the registers of a module, but not function 46h: pymodbus, on a pseudo-terminal."""

import os
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread

import pytest

from i7000.host.procedures import Snapshot
from tests.interop.peers import PymodbusModule
from tests.terminal import Run

HOLDING, COIL = 0x03, 0x01
MODEL = ("--model", "M-7019R", "--protocol", "rtu", "--retries", "0", "--timeout", "0.05")


@contextmanager
def on_a_pty(played: PymodbusModule) -> Iterator[str]:
    """Answer at a pseudo-terminal, in a thread."""
    here, there = os.openpty()
    tty.setraw(there)

    def play() -> None:
        while frame := os.read(here, 300):
            if frame == b"end":
                return
            os.write(here, played.answer(frame))

    thread = Thread(target=play)
    thread.start()
    try:
        yield os.ttyname(there)
    finally:
        os.write(there, b"end")
        thread.join()
        os.close(there)
        os.close(here)


@pytest.fixture
def played() -> PymodbusModule:
    found = PymodbusModule(1)
    found.store(HOLDING, 484, (1, 0x06))
    found.store(HOLDING, 256, (0x0F,) * 8)
    found.store(HOLDING, 489, (0xFF,))
    found.store(COIL, 256, (1,))
    return found


def test_it_is_saved_changed_and_restored_by_its_registers(played: PymodbusModule, run: Run, tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    with on_a_pty(played) as port:
        saved = run("backup", port, str(path), *MODEL)
        changed = run("set", port, "host_watchdog_timeout=2.5", "type_code.3=J", *MODEL)
        now = played.stored(HOLDING, 488, 1), played.stored(HOLDING, 256, 8)
        compared = run("diff", port, str(path), *MODEL, "--json")
        restored = run("restore", port, str(path), "--yes", *MODEL)

    taken = Snapshot.from_json(path.read_bytes())
    assert (taken["type_code.7"], taken["address"], taken["baud_rate"]) == ("K", 1, 9600)
    assert set(dict(taken.unread)) >= {"firmware", "name"}
    assert saved.code == 1
    assert (changed.code, now) == (0, ((25,), (0x0F, 0x0F, 0x0F, 0x0E, 0x0F, 0x0F, 0x0F, 0x0F)))
    assert {it["name"] for it in compared.records} == {"host_watchdog_timeout", "type_code.3"}
    assert restored.code == 0
    assert (played.stored(HOLDING, 488, 1), played.stored(HOLDING, 256, 8)) == ((0,), (0x0F,) * 8)
