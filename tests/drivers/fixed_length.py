"""A naive driver for DCON: a fixed sleep, then `read(58)`; what it has is cut into fields of 7 characters."""

import json
import sys
from collections.abc import Callable, Iterator
from time import sleep
from typing import Any

import serial


def poll(port: Any, wait: Callable[[float], object] = sleep) -> Iterator[str]:
    for address in (1, 2):
        port.write(b"#%02X\r" % address)
        wait(0.05)
        answer = port.read(58).decode("latin-1")
        for channel in range(8):
            field = answer[1 + 7 * channel : 8 + 7 * channel]
            try:
                yield json.dumps({"address": address, "channel": channel, "value": float(field)})
            except ValueError:
                yield json.dumps({"address": address, "channel": channel, "status": "error"})


def main(target: str) -> None:
    port: Any = serial.serial_for_url(target, 9600, timeout=0.3)
    with port:
        while True:
            for line in poll(port):
                print(line, flush=True)  # noqa: T201


if __name__ == "__main__":
    main(sys.argv[1])
