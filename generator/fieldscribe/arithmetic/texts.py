"""Texts and the words that hold them; bytes in their notations, dates as counted seconds, and dates and times in parts.

Each part (year, month, day, hour, minute, second and millisecond) has some bits of a word.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from datetime import UTC, date, datetime, time, timedelta
from fractions import Fraction
from ipaddress import AddressValueError, IPv4Address, IPv6Address
from typing import Any

from fieldscribe.arithmetic.exact import half_away
from fieldscribe.arithmetic.words import BCD, coded_ends, coded_number, coded_pattern, joined, mask_of, words_in
from fieldscribe.model import DatePart, Text

DATE, TIME, DATE_AND_TIME = "date", "time", "date and time"
_CLASSES: Mapping[str, Any] = {DATE: date, TIME: time, DATE_AND_TIME: datetime}
_SECOND = 1000
"""A second in milliseconds, and a millisecond in microseconds."""
_WEEK = 7
_SEPARATORS = re.compile(r"[:\s-]")
_MICRO = 1_000_000
_ADDRESSES: dict[str, type[IPv4Address | IPv6Address]] = {"ipv4": IPv4Address, "ipv6": IPv6Address}
_BLANK = " "
_CODECS = {"utf-8": "utf-8", "utf-16": "utf-16-be"}


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


def notated(notation: str, data: bytes) -> str:
    """Return bytes in their notation: `192.168.0.1`, `00:1A:2B:3C:4D:5E`, `1.2.0.14`, `001A2B`."""
    if notation in _ADDRESSES:
        return str(_ADDRESSES[notation](data))
    if notation.startswith("version"):
        nibbles = [part for byte in data for part in divmod(byte, 16)]
        return ".".join(map(str, data if notation == "version" else nibbles))
    return data.hex(*":" * notation.startswith("eui")).upper()


def bytes_of(notation: str, text: str, count: int) -> bytes | None:
    """Return the bytes of such a text; None if it is not `count` bytes in the notation."""
    try:
        if notation in _ADDRESSES:
            return None if "%" in text else _ADDRESSES[notation](text.strip()).packed
        if notation.startswith("version"):
            parts = [int(part) for part in text.split(".") if part.isascii() and part.isdigit()]
            parts = parts if len(parts) == text.count(".") + 1 else []
            if notation != "version" and all(part < 16 for part in parts):
                parts = [high << 4 | low for high, low in zip(parts[::2], parts[1::2], strict=True)]
            elif notation != "version":
                return None
            data = bytes(parts)
        else:
            data = bytes.fromhex(_SEPARATORS.sub("", text))
    except (AddressValueError, ValueError):
        return None
    return data if len(data) == count else None


def date_of(epoch: str, seconds: Fraction) -> str:
    """Return the time a number of seconds after a date: `2026-11-29T12:00:00Z`; empty after 9999-12-31."""
    try:
        time = _start(epoch) + timedelta(microseconds=half_away(seconds * _MICRO))
    except OverflowError:
        return ""
    return time.replace(tzinfo=None).isoformat() + "Z"


def epoch_in_unix(epoch: str) -> int:
    """Return a date as seconds after 1970-01-01."""
    return (_start(epoch) - _start("1970-01-01")) // timedelta(seconds=1)


def seconds_of(epoch: str, text: str) -> Fraction | None:
    """Return a time as seconds after a date (UTC if it has no zone); None if the text is not a time."""
    try:
        time = datetime.fromisoformat(text.strip())
    except ValueError:
        return None
    time = time if time.tzinfo is not None else time.replace(tzinfo=UTC)
    return Fraction((time - _start(epoch)) // timedelta(microseconds=1), _MICRO)


def _start(epoch: str) -> datetime:
    return datetime.fromisoformat(epoch).replace(tzinfo=UTC)


def text_of(layout: Text, pattern: int) -> str:
    """Return the text of all words, given as one number, without its padding. Raises ValueError for what is none.

    A date and time is a text, too: `2026-11-29T12:00:00`.
    """
    data, size = _swapped(layout, pattern.to_bytes(2 * layout.words, "big")), _size(layout)
    if layout.parts:
        return date_of_words(layout, words_in(data))
    codes = (data if layout.per_word * size > 1 else data[1::2])[: layout.characters * size]
    if layout.is_bytes:
        return notated(layout.encoding, codes)
    ends = (at for at in range(0, len(codes), size) if not (layout.padding or any(codes[at : at + size])))
    return codes[: next(ends, len(codes))].decode(_codec(layout)).rstrip(_BLANK)


def length_of(layout: Text, text: str) -> int:
    """Return the length of a text in units of its encoding: bytes, or words of UTF-16. Raises UnicodeEncodeError."""
    return len(text.encode(_codec(layout))) // _size(layout)


def fits(layout: Text, text: str) -> bool:
    """Return True if the encoding has all characters of a text, and there is room for them."""
    if layout.is_bytes:
        return bytes_of(layout.encoding, text, layout.characters) is not None
    if layout.encoding == "ascii" and not text.isascii():
        return False
    try:
        return bool(words_of_date(layout, text)) if layout.parts else length_of(layout, text) <= layout.characters
    except ValueError:
        return False


def pattern_of_text(layout: Text, text: str) -> int:
    """Return all words of a text that fits, padded, as one number."""
    size = _size(layout)
    if layout.parts:
        data = joined(words_of_date(layout, text)).to_bytes(2 * layout.words, "big")
        return int.from_bytes(_swapped(layout, data), "big")
    codes = bytes_of(layout.encoding, text, layout.characters) if layout.is_bytes else None
    codes = text.rstrip(_BLANK).encode(_codec(layout)) if codes is None else codes
    codes += layout.padding.to_bytes(size, "big") * (layout.per_word * layout.words - len(codes) // size)
    data = codes if layout.per_word * size > 1 else b"".join(bytes((0, code)) for code in codes)
    return int.from_bytes(_swapped(layout, data), "big")


def _codec(layout: Text) -> str:
    return _CODECS.get(layout.encoding, "latin-1")


def _size(layout: Text) -> int:
    return 2 if layout.encoding == "utf-16" else 1


def _swapped(layout: Text, data: bytes) -> bytes:
    """Return the bytes, those of each word exchanged if the low one comes first."""
    return b"".join(data[at : at + 2][::-1] for at in range(0, len(data), 2)) if layout.low_first else data
