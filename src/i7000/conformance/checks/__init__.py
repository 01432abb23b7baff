"""The steps of the checks, one module a group; ``spec/checks`` has what each of them is about.

To add a check, write its statement into the file of its group, and its steps into the module: a function of a `Subject`
under the same id in `STEPS`. A check passes by ending; what it raises ends it otherwise, see
`i7000.conformance.verdict`.
"""

from collections.abc import Mapping
from types import MappingProxyType

from i7000.conformance.checks import (
    consistency,
    dcon,
    frame,
    init,
    init_modbus,
    link,
    map,  # noqa: A004
    rtu,
    stateful,
    statement,
    timing,
    values,
)
from i7000.conformance.checks.steps import Steps

__all__ = ["STEPS", "Steps"]

STEPS: Mapping[str, Steps] = MappingProxyType(
    {
        **link.STEPS,
        **frame.STEPS,
        **dcon.STEPS,
        **values.STEPS,
        **consistency.STEPS,
        **rtu.STEPS,
        **map.STEPS,
        **timing.STEPS,
        **stateful.STEPS,
        **init.STEPS,
        **init_modbus.STEPS,
        **statement.STEPS,
    }
)
"""The steps of every check by its id."""
