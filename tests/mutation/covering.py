"""Which tests cover which file: the one place that says so.

The first row whose pattern fits a file is the one that counts. Its first stage is run first and has to be quick; a
mutant that it does not notice goes on to the next. Every stage stops at its first failure.
"""

from __future__ import annotations

from fnmatch import fnmatch
from typing import NamedTuple, TypeAlias

Stage: TypeAlias = tuple[str, ...]
"""Files and folders of tests, as patterns from the root."""


class Row(NamedTuple):
    """The tests of some files."""

    target: str
    pattern: str
    stages: tuple[Stage, ...]


EVERYWHERE = ("tests/test_arguments.py", "tests/test_public_names.py", "tests/test_readme.py", "tests/test_errors.py")
"""Last of all stages of code: what holds for every module."""

DCON = ("tests/test_agreement.py", "tests/dcon", "tests/test_cli_decode.py", "tests/properties/test_dcon.py")
MODBUS = (
    "tests/modbus", "tests/properties/test_modbus*.py", "tests/test_cli_decode_modbus.py",
)  # fmt: skip
DEVICE = ("tests/device", "tests/simulator/test_sources.py", "tests/simulator/test_memory*.py")
HOST = ("tests/host", "tests/link/test_line.py", "tests/examples", "tests/test_cli_explain.py")
PROCEDURES = (
    "tests/host/procedures", "tests/test_cli_scan.py", "tests/test_cli_read.py", "tests/test_cli_set.py",
    "tests/test_cli_backup.py", "tests/test_cli_restore.py", "tests/test_cli_diff.py",
)  # fmt: skip
RULES = ("tests/spec/test_[efgkmprst]*.py",)
"""What holds for the data beyond its form; the form takes the longest."""
SPEC = ("tests/spec/test_[!ai]*.py", "tests/test_spec.py", "tests/test_readme.py")
"""All but the archive and the index, which has the digest of each file and so notices every change."""

ROWS = (
    Row("readings", "src/i7000/readings.py", (
        ("tests/test_readings.py",),
        ("tests/dcon/test_reports.py", "tests/dcon/test_vectors.py", "tests/test_agreement.py",
         "tests/modbus/test_register_vectors.py", "tests/device/test_measurement.py"),
        ("tests/properties/test_readings.py", *DCON),
        ("tests/modbus", "tests/test_growth.py", *EVERYWHERE),
    )),
    Row("checksum", "src/i7000/dcon/frame.py", (
        ("tests/dcon/test_frame.py",), ("tests/dcon/test_codec.py", "tests/dcon/test_vectors.py"), DCON, EVERYWHERE,
    )),
    Row("codecs", "src/i7000/dcon/layout.py", (
        ("tests/dcon/test_layout.py",), ("tests/dcon/test_codec.py", "tests/dcon/test_vectors.py"), DCON, EVERYWHERE,
    )),
    Row("codecs", "src/i7000/dcon/*.py", (
        ("tests/dcon/test_codec.py", "tests/dcon/test_reports.py", "tests/dcon/test_layout.py"),
        ("tests/dcon/test_vectors.py", "tests/test_agreement.py", "tests/dcon"), DCON, EVERYWHERE,
    )),
    Row("CRC", "src/i7000/modbus/frame.py", (("tests/modbus/test_frame.py",), MODBUS, EVERYWHERE)),
    Row("codecs", "src/i7000/modbus/stream.py", (("tests/modbus/test_stream.py",), MODBUS, EVERYWHERE)),
    Row("codecs", "src/i7000/modbus/register*.py", (
        ("tests/modbus/test_register_map.py", "tests/modbus/test_register_vectors.py",
         "tests/modbus/test_agreement.py"),
        MODBUS, ("tests/device/test_modbus.py", "tests/host/procedures", *EVERYWHERE),
    )),
    Row("codecs", "src/i7000/modbus/*.py", (
        ("tests/modbus/test_codec.py", "tests/modbus/test_layout.py"),
        ("tests/modbus/test_vectors.py", "tests/modbus"), MODBUS, EVERYWHERE,
    )),
    Row("guard", "src/i7000/conformance/guard*.py", (
        ("tests/conformance/test_guard.py",), ("tests/conformance/test_guard_proof.py", "tests/link/test_guarded.py"),
        ("tests/conformance", *EVERYWHERE),
    )),
    Row("guard", "src/i7000/conformance/hazard.py", (
        ("tests/conformance/test_hazard.py", "tests/conformance/test_guard.py"),
        ("tests/conformance/test_guard_proof.py", "tests/link/test_guarded.py"), ("tests/conformance", *EVERYWHERE),
    )),
    Row("host", "src/i7000/host/procedures/identif*.py", (
        ("tests/host/procedures/test_identify.py", "tests/host/procedures/test_evidence.py"), PROCEDURES, EVERYWHERE,
    )),
    Row("host", "src/i7000/host/procedures/restoring.py", (
        ("tests/host/procedures/test_change.py", "tests/host/procedures/test_change_faults.py"), PROCEDURES, EVERYWHERE,
    )),
    Row("host", "src/i7000/host/procedures/snapshot.py", (
        ("tests/host/procedures/test_snapshot.py",), PROCEDURES, EVERYWHERE,
    )),
    Row("host", "src/i7000/host/procedures/[sp][cl]a*.py", (
        ("tests/host/procedures/test_scan.py",), PROCEDURES, EVERYWHERE,
    )),
    Row("host", "src/i7000/host/procedures/read.py", (
        ("tests/host/procedures/test_read.py",), PROCEDURES, EVERYWHERE,
    )),
    Row("host", "src/i7000/host/procedures/settings.py", (
        ("tests/host/procedures/test_settings.py", "tests/host/procedures/test_values.py"), PROCEDURES, EVERYWHERE,
    )),
    Row("host", "src/i7000/host/procedures/values.py", (
        ("tests/host/procedures/test_values.py", "tests/host/procedures/test_settings.py"), PROCEDURES, EVERYWHERE,
    )),
    Row("host", "src/i7000/host/procedures/step.py", (
        ("tests/host/procedures/test_step.py",), PROCEDURES, EVERYWHERE,
    )),
    Row("host", "src/i7000/host/procedures/*.py", (
        ("tests/host/procedures/test_step.py", "tests/host/procedures/test_confirm.py",
         "tests/host/procedures/test_identify.py"),
        PROCEDURES, EVERYWHERE,
    )),
    Row("host", "src/i7000/host/*.py", (
        ("tests/host/test_bus.py", "tests/host/test_abandon.py", "tests/host/test_dangers.py"), HOST,
        (*PROCEDURES, *EVERYWHERE),
    )),
    Row("device", "src/i7000/device/bus.py", (("tests/device/test_bus.py",), DEVICE, EVERYWHERE)),
    Row("device", "src/i7000/device/uart.py", (("tests/device/test_uart.py",), DEVICE, EVERYWHERE)),
    Row("device", "src/i7000/device/logger.py", (("tests/device/test_logger.py",), DEVICE, EVERYWHERE)),
    Row("device", "src/i7000/device/[ms][ei]*.py", (
        ("tests/device/test_measurement.py", "tests/device/test_dcon.py"), DEVICE, EVERYWHERE,
    )),
    Row("device", "src/i7000/device/[r]*.py", (
        ("tests/device/test_modbus.py", "tests/device/test_logger.py", "tests/device/test_dcon.py"), DEVICE, EVERYWHERE,
    )),
    Row("device", "src/i7000/device/*.py", (
        ("tests/device/test_state.py", "tests/device/test_dcon.py", "tests/device/test_modbus.py"), DEVICE, EVERYWHERE,
    )),
    Row("spec", "spec/vectors/dcon/*.json", (
        ("tests/dcon/test_vectors.py",), RULES, SPEC, ("tests/dcon", "tests/device"),
    )),
    Row("spec", "spec/vectors/modbus/*.json", (
        ("tests/modbus/test_vectors.py",), RULES, SPEC, ("tests/modbus", "tests/device"),
    )),
    Row("spec", "spec/vectors/registers/*.json", (
        ("tests/modbus/test_register_vectors.py",), RULES, SPEC, ("tests/modbus",),
    )),
    Row("spec", "spec/vectors/readings/*.json", (
        ("tests/test_agreement.py", "tests/dcon/test_vectors.py"), RULES, SPEC,
        ("tests/test_readings.py", "tests/dcon"),
    )),
    Row("spec", "spec/vectors/frames/*.json", (
        ("tests/dcon/test_vectors.py", "tests/modbus/test_vectors.py", "tests/modbus/test_stream.py"), RULES, SPEC,
        ("tests/dcon", "tests/modbus"),
    )),
    Row("spec", "spec/stories/*.json", (
        ("tests/device/test_stories.py",), ("tests/spec/test_stories.py", "tests/spec/test_references.py"), SPEC,
    )),
    Row("spec", "spec/errata.json", (
        ("tests/spec/test_errata.py", "tests/spec/test_references.py"), RULES, SPEC, ("tests/test_agreement.py",),
    )),
    Row("spec", "spec/tables/*.json", (
        ("tests/test_agreement.py", "tests/modbus/test_agreement.py", "tests/spec/test_references.py"),
        RULES, SPEC, ("tests/dcon", "tests/modbus", "tests/device", "tests/test_cli_explain.py"),
    )),
)  # fmt: skip

GOALS = {
    "CRC": 1.0, "checksum": 1.0, "readings": 1.0, "guard": 1.0, "spec": 1.0,
    "codecs": 0.98, "host": 0.98, "device": 0.98,
}  # fmt: skip
"""The least part of the mutants of each target that the tests have to notice."""


def row_of(file: str) -> Row | None:
    """Return the row of a file, or None where no mutants of it are made."""
    return next((row for row in ROWS if fnmatch(file, row.pattern)), None)
