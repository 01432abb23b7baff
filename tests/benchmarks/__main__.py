"""Print every ratio and figure beside its target, if it has one; the exit code tells whether all were met."""

import sys

from tests.benchmarks import dcon, decode, device, imports, load, modbus
from tests.benchmarks.timing import summary

verdicts = []
for results in (
    dcon.codec_results,
    dcon.splitter_results,
    modbus.codec_results,
    modbus.splitter_results,
    device.step_results,
    decode.decode_results,
    imports.import_results,
    load.load_results,
):
    for result in results():
        print(result, flush=True)  # noqa: T201
        verdicts.append(result.verdict)
print(summary(verdicts))  # noqa: T201
sys.exit(1 if "MISSED" in verdicts else 0)
