"""Print every ratio beside its target; the exit code tells whether all were met."""

import sys

from tests.benchmarks import dcon, device, imports, modbus

missed = 0
for results in (
    dcon.codec_results,
    dcon.splitter_results,
    modbus.codec_results,
    modbus.splitter_results,
    device.step_results,
    imports.import_results,
):
    for result in results():
        print(result, flush=True)  # noqa: T201
        missed += not result.met
sys.exit(1 if missed else 0)
