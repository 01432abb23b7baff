"""The DCON protocol (manual 2): every command and response, and the functions that write and read them.

A host uses `encode` and `decode_response`; a simulated module uses `decode_command` and `encode`. `split` finds frames
in received bytes; `readings` decodes the fields of a report. Every name in `__all__` of the submodules is public and
can be imported from here.
"""

from i7000.dcon import (
    calibration,
    codec,
    cold_junction,
    command,
    configuration,
    frame,
    identity,
    inputs,
    open_wire,
    reports,
    sampling,
    watchdog,
)
from i7000.dcon.calibration import *
from i7000.dcon.codec import *
from i7000.dcon.cold_junction import *
from i7000.dcon.command import *
from i7000.dcon.configuration import *
from i7000.dcon.frame import *
from i7000.dcon.identity import *
from i7000.dcon.inputs import *
from i7000.dcon.open_wire import *
from i7000.dcon.reports import *
from i7000.dcon.sampling import *
from i7000.dcon.watchdog import *

__all__: list[str] = []
__all__ += calibration.__all__
__all__ += codec.__all__
__all__ += cold_junction.__all__
__all__ += command.__all__
__all__ += configuration.__all__
__all__ += frame.__all__
__all__ += identity.__all__
__all__ += inputs.__all__
__all__ += open_wire.__all__
__all__ += reports.__all__
__all__ += sampling.__all__
__all__ += watchdog.__all__
