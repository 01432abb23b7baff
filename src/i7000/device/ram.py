"""The memory that a module loses without power (manual 2, A.1, A.2)."""

from types import NoneType

from attrs import frozen

from i7000.arguments import check_seconds, is_number, kind_words
from i7000.errors import InvalidValueError
from i7000.readings import Reading
from i7000.settings import CjcUpdate, LineSettings, Protocol, is_int
from i7000.type_codes import TypeCode

__all__ = ["Ram", "Sample"]

Sample = tuple[tuple[TypeCode, Reading], ...]
"""The type and the reading of each channel at one moment."""


@frozen(slots=False)
class Ram:
    """The memory that a module loses without power.

    Time: moments are in seconds of the clock of `i7000.device.step`.
    Manual: 2.2, 2.21, 2.31, 2.32, 2.34, A.1, A.2.
    """

    address: int
    """The address at which the module answers: 00 after power-on in INIT mode."""
    line_settings: LineSettings
    checksum: bool
    protocol: Protocol
    init_mode: bool
    """Whether the INIT switch was set at power-on."""
    init_switch: bool
    """Whether the switch is set now (E17)."""
    fed_at: float
    """The time when the host watchdog was last restarted."""
    sampled: Sample | None = None
    """The sample of the last ``#**``."""
    sampled_data_read: bool = False
    calibration_enabled: bool = False
    soft_init_timeout: int = 0
    """The soft INIT timeout in seconds."""
    soft_init_until: float | None = None
    """The time until which baud rate and checksum can be changed (E107)."""
    cjc_update: CjcUpdate = CjcUpdate.STARTED
    """The update setting; power-on starts the update, the default (E115)."""
    held_cold_junction: float | None = None
    """The cold-junction temperature when its update stopped, in degrees Celsius; None while it is updated."""
    reset_status_read: bool = False

    def __attrs_post_init__(self) -> None:
        for name in _KEPT:
            self.check(name)

    def check(self, name: str) -> None:
        """Check the value of a field.

        Errors: `InvalidValueError`.
        """
        value, kinds = getattr(self, name), _KEPT[name]
        if not isinstance(value, kinds):
            raise InvalidValueError(name, value, " or ".join(map(kind_words, kinds)), "")
        if name in _BYTES and not is_int(value, 0, 0xFF):
            raise InvalidValueError(name, value, "00..FF", _BYTES[name])
        if name in _TIMES and value is not None:
            check_seconds(name, value)
        if name == "held_cold_junction" and value is not None and not is_number(value):
            raise InvalidValueError(name, value, "a finite number of degrees Celsius", "")
        if name == "sampled" and not all(map(_is_sampled, self.sampled or ())):
            raise InvalidValueError(name, value, "type code and reading of each channel", "2.2")


def _is_sampled(channel: object) -> bool:
    return isinstance(channel, tuple) and tuple(map(type, channel)) == (TypeCode, Reading)


_KEPT: dict[str, tuple[type, ...]] = {
    "address": (int,), "line_settings": (LineSettings,), "checksum": (bool,), "protocol": (Protocol,),
    "init_mode": (bool,), "init_switch": (bool,), "fed_at": (int, float), "sampled": (tuple, NoneType),
    "sampled_data_read": (bool,), "calibration_enabled": (bool,), "soft_init_timeout": (int,),
    "soft_init_until": (int, float, NoneType), "cjc_update": (CjcUpdate,),
    "held_cold_junction": (int, float, NoneType), "reset_status_read": (bool,),
}  # fmt: skip
"""The types of each field of `Ram`."""
_BYTES = {"address": "2", "soft_init_timeout": "2.34"}
"""The fields of `Ram` that must be a byte, and their sections of the manual."""
_TIMES = ("fed_at", "soft_init_until")
