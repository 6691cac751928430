"""Dates and times in parts: year, month, day, hour, minute, second and millisecond, each in some bits of a word."""

from collections.abc import Iterator, Mapping, Sequence
from datetime import date, datetime, time
from typing import Any

from fieldscribe.arithmetic.words import BCD, coded_ends, coded_number, coded_pattern, mask_of
from fieldscribe.model import DatePart, Text

DATE, TIME, DATE_AND_TIME = "date", "time", "date and time"
_CLASSES: Mapping[str, Any] = {DATE: date, TIME: time, DATE_AND_TIME: datetime}
_SECOND = 1000
"""A second in milliseconds, and a millisecond in microseconds."""
_WEEK = 7


def date_of_words(layout: Text, words: Sequence[int]) -> str:
    """Return the date and time in words: `2026-11-29T12:00:00`. Raises ValueError if they hold none."""
    held = {part.name: _number(layout, part, words) for part in layout.parts if part.name != "weekday"}
    seconds, milliseconds = divmod(held.pop("millisecond", 0), _SECOND)
    if seconds and "second" in held:
        raise ValueError
    if layout.encoding != DATE:
        held |= {"second": held.get("second", seconds), "microsecond": milliseconds * _SECOND}
    return str(_CLASSES[layout.encoding](**held).isoformat())


def words_of_date(layout: Text, text: str) -> list[int]:
    """Return the words of a date and time; numbers without a part are ignored. Raises ValueError for any other text."""
    value = _CLASSES[layout.encoding].fromisoformat(text.strip())
    words = [0] * layout.words
    for part, number in _numbers(layout, value):
        if not 0 <= number <= _greatest(layout, part):
            raise ValueError
        bits = coded_pattern(number, part.width, BCD) if layout.bcd else number
        words[part.word] |= bits << part.bits[1]
    return words


def first_date(layout: Text) -> str | None:
    """Return a date or time that the parts can hold: of 2000 if they can; None if there is none."""
    bases = [part.base for part in layout.parts if part.name == "year"]
    years = {2000: None, **{base + after: None for base in bases for after in range(_WEEK)}, 1: None}
    days = (f"{year:04}-01-{day:02}" for year in years for day in range(1, _WEEK + 1))
    for text in ["00:00"] if layout.encoding == TIME else days:
        try:
            words_of_date(layout, text)
        except ValueError:
            continue
        return text
    return None


def _greatest(layout: Text, part: DatePart) -> int:
    return coded_ends(part.width, BCD)[1] if layout.bcd else mask_of(part.width)


def _number(layout: Text, part: DatePart, words: Sequence[int]) -> int:
    bits = words[part.word] >> part.bits[1] & mask_of(part.width)
    number = coded_number(bits, part.width, BCD) if layout.bcd else bits
    if number > _greatest(layout, part):
        raise ValueError
    return number + part.base


def _numbers(layout: Text, value: date | time) -> Iterator[tuple[DatePart, int]]:
    """Yield the parts with their numbers for a date and time. Raises ValueError for a time with a zone."""
    if getattr(value, "tzinfo", None) is not None:
        raise ValueError
    has_second = any(part.name == "second" for part in layout.parts)
    for part in layout.parts:
        if part.name == "weekday" and isinstance(value, date):
            yield part, _weekday(value.isoweekday(), part.base)
        elif part.name == "millisecond" and isinstance(value, (time, datetime)):
            yield part, value.microsecond // _SECOND + (0 if has_second else value.second * _SECOND)
        else:
            yield part, getattr(value, part.name) - part.base


def _weekday(iso: int, sunday: int) -> int:
    """Return the number of a weekday (ISO: Monday 1, Sunday 7) in a count whose Sunday is 0, 1, 6 or 7."""
    return iso % _WEEK + sunday if sunday < _WEEK - 1 else iso - _WEEK + sunday
