"""A codec that computes checksums and CRCs, but for one case, or at its start or end: ``hostile.py BEHAVIOUR [ID]``."""

import json
import os
import sys
import time
from typing import Any

BEHAVIOUR, ID = (*sys.argv[1:], "", "")[:2]
ABOUT = {"name": "hostile", "version": "1", "language": "Python"}
STARTED = {"protocol": 1, "implementation": ABOUT, "operations": ["frames.checksum", "frames.crc"]}
FOREVER = 3600


def say(text: str, end: str = "\n") -> None:
    sys.stdout.write(text + end)
    sys.stdout.flush()


def result(case: Any) -> Any:
    body = bytes.fromhex(case["input"]["body"])
    if case["operation"] == "frames.checksum":
        return {"checksum": f"{sum(body) & 0xFF:02X}"}
    crc = 0xFFFF
    for byte in body:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ 0xA001 * (crc & 1)
    return {"crc": crc.to_bytes(2, "little").hex()}


def misbehave(seq: int, case: Any) -> None:
    answer = {"seq": seq, "result": result(case)}
    if BEHAVIOUR == "dies":
        sys.stderr.write("x" * 100_000 + "\nSegmentation fault\n")
        sys.stderr.flush()
        os._exit(3)
    elif BEHAVIOUR == "dies in half a line":
        say('{"seq"', end="")
        os._exit(0)
    elif BEHAVIOUR == "is silent":
        return
    elif BEHAVIOUR == "is deaf":
        time.sleep(FOREVER)
    elif BEHAVIOUR == "floods":
        while True:
            say("y" * 1000)
    elif BEHAVIOUR == "answers twice":
        say(json.dumps(answer))
        say(json.dumps(answer))
    else:
        lines = {
            "says hello": "hello",
            "is long": "z" * 100_000,
            "is long without an end": "z" * 100_000,
            "says another number": json.dumps(answer | {"seq": seq + 1}),
            "is wrong": json.dumps({"seq": seq, "result": dict.fromkeys(result(case), "0000")}),
            "refuses": json.dumps({"seq": seq, "error": {"fault": "length"}}),
            "skips": json.dumps({"seq": seq, "skipped": "later"}),
            "crashes": json.dumps({"seq": seq, "crashed": "ZeroDivisionError \x1b[2J \ud800"}),
            "says nothing of it": json.dumps({"seq": seq}),
        }
        say(lines[BEHAVIOUR], end="" if BEHAVIOUR.endswith("an end") else "\n")


def main() -> int:
    if BEHAVIOUR == "never starts":
        time.sleep(FOREVER)
    for line in sys.stdin:
        message = json.loads(line)
        if message["cmd"] == "start":
            say(json.dumps({"seq": message["seq"]} | STARTED))
        elif message["cmd"] == "stop":
            break
        elif ID in ("", message["case"]["id"]) and not BEHAVIOUR.endswith("after stop"):
            misbehave(message["seq"], message["case"])
        else:
            say(json.dumps({"seq": message["seq"], "result": result(message["case"])}))
    if BEHAVIOUR == "goes on after stop":
        time.sleep(FOREVER)
    if BEHAVIOUR == "talks after stop":
        say("bye")
    return int(BEHAVIOUR == "fails after stop")


if __name__ == "__main__":
    sys.exit(main())
