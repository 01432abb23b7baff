"""The Modbus RTU protocol (manual 3): every request and response, and the functions that write and read them.

A host uses `encode` and `decode_response`; a simulated module uses `decode_request` and `encode`. `split` and `flush`
find frames in received bytes. `RegisterMap` is the address map of a module. Every name in `__all__` of the submodules
is public and can be imported from here.
"""

from i7000.modbus import (
    channel_settings,
    codec,
    cold_junction,
    frame,
    module_settings,
    register_map,
    register_values,
    registers,
    request,
    standard,
    stream,
)
from i7000.modbus.channel_settings import *
from i7000.modbus.codec import *
from i7000.modbus.cold_junction import *
from i7000.modbus.frame import *
from i7000.modbus.module_settings import *
from i7000.modbus.register_map import *
from i7000.modbus.register_values import *
from i7000.modbus.registers import *
from i7000.modbus.request import *
from i7000.modbus.standard import *
from i7000.modbus.stream import *

__all__: list[str] = []
__all__ += channel_settings.__all__
__all__ += codec.__all__
__all__ += cold_junction.__all__
__all__ += frame.__all__
__all__ += module_settings.__all__
__all__ += register_map.__all__
__all__ += register_values.__all__
__all__ += registers.__all__
__all__ += request.__all__
__all__ += standard.__all__
__all__ += stream.__all__
