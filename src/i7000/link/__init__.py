"""Lines and ports: requests over serial ports, networks, simulated modules and processes (extra ``serial``).

`VirtualPort` is a serial port with simulated modules in virtual time, for tests.
"""

from i7000.link.virtual import VirtualPort

__all__ = ["VirtualPort"]
