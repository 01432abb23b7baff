"""What is built at its first use is whole and built once, however many threads come to it cold at the same time."""

import subprocess
import sys

RACE = """
import sys
from threading import Barrier, Thread

from i7000 import Model, Profile, dcon, device, dissect, modbus
from i7000.modbus.frame import _TWO

THREADS = 8
PROFILE = Profile(Model.M_7019R)
REQUEST = bytes.fromhex("010400000008f1cc")
found = [None] * THREADS
start = Barrier(THREADS)


def race(place):
    start.wait()
    state = device.power_on(device.factory(Model.M_7019R), now=0.0)
    found[place] = (
        modbus.crc16(REQUEST),
        modbus.split(REQUEST * 2 + bytes(3)),
        modbus.encode(modbus.ReadCoils(1, 0, 8)),
        modbus.decode_response(bytes.fromhex("018402c2c1"), modbus.ReadInputRegisters(1, 200, 1), PROFILE),
        modbus.RegisterMap(PROFILE).rows,
        dcon.encode(dcon.ReadConfiguration(1), PROFILE),
        [meaning.message for meaning in dissect.meanings(b"#0184\\r")],
        [meaning.message for meaning in dissect.meanings(b"!01050600AD\\r")],
        device.step(state, REQUEST, device.Signals(), 0.0)[1],
    )


sys.setswitchinterval(1e-6)
threads = [Thread(target=race, args=(place,)) for place in range(THREADS)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
sys.setswitchinterval(0.005)
print(sum(it is not None and it == found[0] for it in found), len(_TWO))
"""


def test_cold_threads_find_every_table_whole_and_of_its_own_size() -> None:
    run = subprocess.run([sys.executable, "-c", RACE], capture_output=True, text=True, check=True)  # noqa: S603

    assert run.stdout == "8 65536\n"
