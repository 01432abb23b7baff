"""What a module that speaks Modbus keeps without power (manual 3.4)."""

from functools import partial

from i7000.conformance.checks.map_writes import other_value, put_and_read
from i7000.conformance.checks.modbus_steps import changed_and_restored, read_row, row_of, row_with
from i7000.conformance.checks.steps import Steps
from i7000.conformance.subject import Subject
from i7000.host.procedures import Procedure
from i7000.modbus import Area

__all__ = ["STEPS"]


def _register_kept(module: Subject) -> Procedure[None]:
    """Write one register, switch the power off and on, read it, and restore it."""
    yield from module.power_cycle()
    area = Area.HOLDING_REGISTER
    row = row_with(module, area, "type_code") or row_of(module, area, "channel_mask")
    before = yield from read_row(module, row)
    new = (other_value(module, row, before[0]), *before[1:])

    def change() -> Procedure[None]:
        yield from put_and_read(module, row, 0, new)
        yield from module.power_cycle()
        yield from read_row(module, row)

    yield from changed_and_restored(module, change(), partial(put_and_read, module, row, 0, before))


STEPS: dict[str, Steps] = {"init/kept-register": _register_kept}
