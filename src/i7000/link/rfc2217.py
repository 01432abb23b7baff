"""The port of pyserial for RFC 2217, without its delays."""

from serial import rfc2217

__all__ = ["Rfc2217Port"]


class Rfc2217Port(rfc2217.Serial):
    """A port that negotiates its settings only if one of them changes: that of pyserial does so for each timeout."""

    _negotiated: tuple[object, ...] = ()

    def _reconfigure_port(self) -> None:
        settings = (self.baudrate, self.bytesize, self.parity, self.stopbits, self.xonxoff, self.rtscts)
        if settings != self._negotiated:
            super()._reconfigure_port()  # type: ignore[misc] # not in the stubs
            self._negotiated = settings
