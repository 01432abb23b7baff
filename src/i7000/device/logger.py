"""The clock and the data logger of the M-7017mC-16 (manual 3.4.3).

Laws: nothing here depends on a module. The clock is an offset to the time argument of `i7000.device.step`, and the
caller passes the words to record. Many details are not in the manual and are assumptions: E105, E109 to E111.
"""

from collections.abc import Mapping
from math import ceil, floor

from attrs import evolve

from i7000.arguments import check_seconds
from i7000.errors import InvalidValueError
from i7000.frozen import frozen
from i7000.settings import LogCommand, is_int

__all__ = ["CAPACITY", "Log", "LogCommand", "Record", "date_of", "moment_of"]

CAPACITY = 1024
"""The capacity of the logger in records (E109, assumption: the manual has no number)."""
RECORDS_IN_MAP = 6

Date = tuple[int, int, int, int, int, int]
"""Year, month, date, hour, minute, second."""
_DAY = 86_400


_Limits = Mapping[str, tuple[int, int]]
_PERIOD_LIMITS: _Limits = {"hours": (0, 24), "minutes": (0, 59), "seconds": (0, 59)}
_DATE_LIMITS: _Limits = {
    "year": (2000, 2159), "month": (1, 12), "date": (1, 31), "hour": (0, 23), "minute": (0, 59), "second": (0, 59),
}  # fmt: skip


def _check_parts(name: str, value: tuple[int, ...], limits: _Limits) -> None:
    """Check that a value is a tuple of ints, each within its limits."""
    whole = isinstance(value, tuple) and len(value) == len(limits)
    if not whole or not all(is_int(part, *limit) for part, limit in zip(value, limits.values(), strict=True)):
        allowed = ", ".join(f"{part} {low}..{high}" for part, (low, high) in limits.items())
        raise InvalidValueError(name, value, f"a tuple of {allowed}", "3.4.3")


def _check_long(name: str, value: object) -> None:
    if not is_int(value, 0, 0xFFFFFFFF):
        raise InvalidValueError(name, value, "0..4294967295", "3.4.3")


@frozen
class Record:
    """The words of the inputs at one moment.

    Shape: `words` are in the Modbus data format at that moment; `time` in seconds of the module's clock.
    Errors: `InvalidValueError` for values that no register can contain.
    """

    index: int
    words: tuple[int, ...]
    time: int

    def __attrs_post_init__(self) -> None:
        for name, value in (("index", self.index), ("time", self.time)):
            _check_long(name, value)
        if not isinstance(self.words, tuple) or not all(is_int(word, 0, 0xFFFF) for word in self.words):
            raise InvalidValueError("words", self.words, "a tuple of words, 0000..FFFF", "3.4.3")


@frozen
class Log:
    """The data logger's settings and its records, oldest first; all of it survives a power cycle (E110).

    Shape: records are counted from 1, so a last index of 0 means that there are no records (E105).
    Time: `clock_offset` is the module's clock, in seconds since 1970, minus the time argument.
    Errors: `InvalidValueError` for values that no module can have stored, and for a time that is not finite.
    Manual: 3.4.3; E73, E74, E105, E109, E110, E111, E131, E135.
    """

    clock_offset: float = 946_684_800.0
    """The offset of a clock that was never set: it starts at the year 2000, the first one that it supports (E110)."""
    command: LogCommand = LogCommand.STOP
    overwrite: bool = False
    period: tuple[int, int, int] = (0, 0, 0)
    """Hours, minutes, seconds; the logger does not run with a period of zero (E74: undefined)."""
    start: Date = (2000, 1, 1, 0, 0, 0)
    end: Date = (2159, 12, 31, 23, 59, 59)
    read_index: int = 1
    last_index: int = 0
    records: tuple[Record, ...] = ()
    next_at: float = 0.0
    """The time of the next record, on the module's clock."""

    def __attrs_post_init__(self) -> None:
        for name, value in (("clock_offset", self.clock_offset), ("next_at", self.next_at)):
            check_seconds(name, value)
        if not isinstance(self.command, LogCommand):
            raise InvalidValueError("command", self.command, "a LogCommand", "3.4.3")
        if not isinstance(self.overwrite, bool):
            raise InvalidValueError("overwrite", self.overwrite, "True or False", "3.4.3")
        _check_parts("period", self.period, _PERIOD_LIMITS)
        _check_parts("start", self.start, _DATE_LIMITS)
        _check_parts("end", self.end, _DATE_LIMITS)
        _check_long("read_index", self.read_index)
        _check_long("last_index", self.last_index)
        if not isinstance(self.records, tuple) or not {Record}.issuperset(map(type, self.records)):
            raise InvalidValueError("records", self.records, "a tuple of Record", "3.4.3")
        if len(self.records) > CAPACITY:
            raise InvalidValueError("records", len(self.records), f"0..{CAPACITY}", "3.4.3")

    @property
    def seconds(self) -> int:
        """The sampling period in seconds."""
        hours, minutes, seconds = self.period
        return hours * 3600 + minutes * 60 + seconds

    def clock(self, now: float) -> float:
        """Return the module's clock, in seconds since 1970."""
        return self.clock_offset + now

    def running(self, now: float) -> bool:
        """Return whether the logger runs: started, with a period and free records, and within its start and end."""
        within = moment_of(self.start) <= self.clock(now) <= moment_of(self.end)
        return (
            self.command is not LogCommand.STOP
            and self.seconds > 0
            and (self.overwrite or len(self.records) < CAPACITY)
            and (self.command is LogCommand.CONTINUOUS or within)
        )

    def planned(self, now: float) -> "Log":
        """Schedule the next record after a change of settings or of the clock.

        Time: at once in continuous mode; in period mode at the next whole period after the start (E105, E110).
        """
        clock, start = self.clock(now), moment_of(self.start)
        if self.command is LogCommand.PERIOD and self.seconds:
            clock = start + ceil(max(0.0, clock - start) / self.seconds) * self.seconds
        return evolve(self, next_at=clock)

    def due(self, now: float) -> int:
        """Return how many records are due, regardless of the capacity."""
        if self.command is LogCommand.STOP or not self.seconds:
            return 0
        until = self.clock(now)
        if self.command is LogCommand.PERIOD:
            until = min(until, moment_of(self.end))
        return max(0, floor((until - self.next_at) / self.seconds) + 1)

    def resumed(self, now: float) -> "Log":
        """Skip the records that were due without power; later records keep their period (E110)."""
        due = self.due(now)
        return evolve(self, next_at=self.next_at + due * self.seconds) if due else self

    def recorded(self, words: tuple[int, ...], due: int) -> "Log":
        """Add the records that are due, up to the capacity; the oldest are overwritten if that is enabled."""
        room = due if self.overwrite else min(due, CAPACITY - len(self.records))
        new = tuple(
            Record(self.last_index + 1 + at & 0xFFFFFFFF, words, floor(self.next_at + at * self.seconds) & 0xFFFFFFFF)
            for at in range(max(0, room - CAPACITY), room)
        )
        return evolve(
            self,
            records=(self.records + new)[-CAPACITY:],
            last_index=self.last_index + room & 0xFFFFFFFF,
            next_at=self.next_at + due * self.seconds,
        )

    def set_clock(self, parts: Mapping[str, int], now: float) -> "Log":
        """Set some parts of the date; a day that the month does not have becomes its last (E111)."""
        date = changed(date_of(self.clock(now)), parts)
        return self.set_epoch(moment_of(date), now)

    def set_epoch(self, seconds: int, now: float) -> "Log":
        """Set the clock, in seconds since 1970."""
        return evolve(self, clock_offset=seconds - now).planned(now)

    def window(self) -> tuple[Record | None, ...]:
        """Return the records that the registers show: those from the read index on."""
        by_index = {record.index: record for record in self.records}
        return tuple(by_index.get(self.read_index + at) for at in range(RECORDS_IN_MAP))


DATE_PARTS = tuple(_DATE_LIMITS)


def changed(date: Date, parts: Mapping[str, int]) -> Date:
    """Return a date with some parts changed."""
    year, month, day, hour, minute, second = (
        parts.get(name, value) for name, value in zip(DATE_PARTS, date, strict=True)
    )
    return year, month, day, hour, minute, second


def moment_of(date: Date) -> int:
    """Return the seconds from 1970 to a date; a day that the month does not have becomes its last.

    >>> moment_of((2020, 12, 22, 13, 5, 9)), moment_of((2021, 2, 31, 0, 0, 0)) == moment_of((2021, 2, 28, 0, 0, 0))
    (1608642309, True)
    """
    year, month, day, hour, minute, second = date
    last = _days(year + month // 12, month % 12 + 1) - _days(year, month)
    return (_days(year, month) + min(day, last) - 1) * _DAY + hour * 3600 + minute * 60 + second


def date_of(seconds: float) -> Date:
    """Return the date so many seconds after 1970.

    >>> date_of(1608642309.7)
    (2020, 12, 22, 13, 5, 9)
    """
    days, rest = divmod(floor(seconds), _DAY)
    year = 1970 + days * 400 // 146_097
    year -= _days(year, 1) > days
    year += _days(year + 1, 1) <= days
    month = max(month for month in range(1, 13) if _days(year, month) <= days)
    return year, month, days - _days(year, month) + 1, rest // 3600, rest // 60 % 60, rest % 60


_DAYS_BEFORE = (0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334)


def _days(year: int, month: int) -> int:
    """Return the days from 1970 to the first of a month."""
    past = year - 1
    leaps = past // 4 - past // 100 + past // 400 - 477
    leap = month > 2 and year % 4 == 0 and (year % 100 != 0 or year % 400 == 0)
    return (year - 1970) * 365 + leaps + _DAYS_BEFORE[month - 1] + leap
