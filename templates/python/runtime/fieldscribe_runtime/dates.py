# SPDX-License-Identifier: 0BSD
"""Forms of dates and times whose parts are numbers in some bits of the words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from .arguments import shown
from .errors import MalformedError, WrongTypeError
from .forms import Form, Type

if TYPE_CHECKING:
    import datetime
    from collections.abc import Sequence

    from .forms import Allowed
    from .rules import Raws

D = TypeVar("D", bound="datetime.date | datetime.time")

_WEEK = 7


class _Part:
    """A part of a date. `facts` are its word, its highest and its lowest bit there, and its base.

    The base is the year that 0 means; for a weekday, the number of Sunday.
    """

    def __init__(self, coding: str, name: str, *facts: int) -> None:
        self.name, self.word, self.low, self.base = name, facts[0], facts[2], facts[3] if len(facts) > 3 else 0
        self.wire, self.width = Type(16, coding=coding), facts[1] - facts[2] + 1
        self.most = (10 ** (self.width // 4) if coding else 1 << self.width) - 1


class _Dated(Form[D, D]):
    """A date, a time or both in the device's own time, without a zone; words hold the parts, the first one highest.

    Parts are decimal digits of four bits each if `bcd`. A part that the point does not have is ignored.
    """

    made: str
    what: str

    def __init__(
        self, words: int, parts: Sequence[tuple[Any, ...]], *, bcd: bool = False, low_first: bool = False
    ) -> None:
        import datetime  # only devices with such points need it

        self.wire = Type(16 * words)
        self.words = words
        self._ordered = Type(16, low_byte_first=low_first).ordered
        self._parts = [_Part("bcd" if bcd else "", *part) for part in parts]
        self._class: Any = getattr(datetime, self.made)
        self._names = {part.name for part in self._parts}

    def decode(self, raw: int, raws: Raws) -> D:
        """Return the date and time; raises MalformedError if the words hold none."""
        words = self._ordered([raw >> 16 * place & 0xFFFF for place in reversed(range(self.words))])
        try:
            value: D = self._class(**self._held(words))
        except (OverflowError, ValueError):
            raise MalformedError(f"words {' '.join(f'{word:04X}' for word in words)}h are no {self.what}") from None
        return value

    def _held(self, words: Sequence[int]) -> dict[str, int]:
        """Return the parts by Python's names for them; raises ValueError for invalid digits."""
        held: dict[str, int] = {}
        for part in self._parts:
            number = part.wire.number(words[part.word] >> part.low, part.width)
            if number > part.most and part.name != "weekday":
                raise ValueError
            held[part.name] = number + part.base
        held.pop("weekday", None)
        second, millisecond = divmod(held.pop("millisecond", 0), 1000)
        if second and "second" in held:
            raise ValueError
        if "hour" in held:
            held.update(second=held.get("second", second), microsecond=1000 * millisecond)
        return held

    def converted(self, value: D, raws: Raws) -> int | None:
        """Return the words of a date and time; None if its parts have no room for it."""
        if not isinstance(value, self._class) or (self.made == "date" and hasattr(value, "hour")):
            raise WrongTypeError(f"takes a datetime.{self.made}, not {shown(value)}")
        if getattr(value, "tzinfo", None) is not None:
            raise WrongTypeError(f"takes a time without a zone, as the device keeps it, not {shown(value)}")
        words = [0] * self.words
        for part in self._parts:
            number = self._number_of(part, value)
            if not 0 <= number <= part.most:
                return None
            words[part.word] |= part.wire.pattern(number, part.width) << part.low
        raw = 0
        for word in self._ordered(words):
            raw = raw << 16 | word
        return raw

    def _number_of(self, part: _Part, value: Any) -> int:
        if part.name == "weekday":
            iso: int = value.isoweekday()
            return iso % _WEEK + part.base if part.base < _WEEK - 1 else iso - _WEEK + part.base
        if part.name == "millisecond":
            second = 0 if "second" in self._names else value.second
            return int(value.microsecond // 1000 + 1000 * second)
        return int(getattr(value, part.name) - part.base)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """Return the words if they are a date and time."""
        try:
            self.decode(raw, raws)
        except MalformedError:
            return None
        return raw if 0 <= raw < 1 << self.wire.bits else None

    def decode_count(self, raw: int, raws: Raws) -> int:
        """Raises WrongTypeError: a date has no counts."""
        raise WrongTypeError(f"a {self.what} has no counts: use raw numbers or values")

    def converted_count(self, count: int, raws: Raws) -> int:
        """Raises WrongTypeError: a date has no counts."""
        raise WrongTypeError(f"a {self.what} has no counts: use raw numbers or values")

    def shown(self, raw: int, raws: Raws, display: int | None = None) -> str:
        """Return the date and time: `2026-11-29T12:00:00`."""
        value: Any = self.decode(raw, raws)
        return str(value.isoformat())

    def choices(self, unit: str) -> str | None:
        """Return what a refused value is."""
        return f"no {self.what} that the point can hold"


class DateParts(_Dated["datetime.date"]):
    """A date in parts."""

    made = what = "date"


class TimeParts(_Dated["datetime.time"]):
    """A time in parts."""

    made = what = "time"


class DateTimeParts(_Dated["datetime.datetime"]):
    """A date and time in parts."""

    made, what = "datetime", "date and time"
