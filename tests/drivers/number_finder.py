"""A naive driver for DCON: whatever looks like a number in whatever came is a reading."""

import json
import re
import sys
from collections.abc import Callable, Iterator
from time import sleep
from typing import Any

import serial


def poll(port: Any, wait: Callable[[float], object] = sleep) -> Iterator[str]:
    for address in (1, 2):
        port.write(b"#%02X\r" % address)
        answer = port.read_until(b"\r").decode("latin-1")
        found = re.findall(r"[+-]\d+\.?\d*", answer)
        for channel, number in enumerate(found):
            yield json.dumps({"address": address, "channel": channel, "value": float(number)})
        if not found:
            yield json.dumps({"address": address, "status": "missing"})
    wait(0.1)


def main(target: str) -> None:
    port: Any = serial.serial_for_url(target, 9600, timeout=0.3)
    with port:
        while True:
            for line in poll(port):
                print(line, flush=True)  # noqa: T201


if __name__ == "__main__":
    main(sys.argv[1])
