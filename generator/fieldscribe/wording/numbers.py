"""Texts of exact numbers, of the parts of dates, and of what frames hold: addresses, bytes, words, units, checksums.

`fixed_rule` and `value_multiple` tell how raw numbers become values where no other point decides it.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from math import gcd

from fieldscribe.arithmetic.exact import SAME, Line, nearest, value_line
from fieldscribe.model import Bus, Code, DatePart, Factor, Frame, Point, Text
from fieldscribe.text import line

_SHORT = 6
"""A factor with at most this many decimals is written as a decimal (`x 0.125`), else as a division (`/ 256`)."""
_MONDAY = 6
"""Of weekdays that count from Monday, Sunday is 6 or 7."""
ALL_ELEMENTS = 255
_NO_ANSWER: Mapping[str, str] = {
    "wrong_unit": "it comes from another unit than was asked",
    "wrong_transaction": "its transaction number is not that of the request",
    "wrong_function": "its function is not that of the request",
    "bad_byte_count": "it brings another number of bytes than was asked for",
    "echo_mismatch": "it does not repeat the request",
    "short_frame": "it is shorter than it says",
    "long_frame": "it is longer than it says",
    "wrong_parameter": "it is about another parameter or element",
    "wrong_response": "its response does not belong to the task",
    "wrong_length": "it has too few words for its response",
}


@lru_cache(maxsize=4096)
def exact(numerator: int, denominator: int = 1) -> str:
    """Return the exact number as text: a decimal if it ends (`0.1`), else a fraction (`7/3`)."""
    if denominator == 1:
        return str(numerator)
    common = gcd(numerator, denominator) * (1 if denominator > 0 else -1)
    numerator, denominator = numerator // common, denominator // common
    if denominator == 1:
        return str(numerator)
    places = decimal_places(denominator)
    if places is None:
        return f"{numerator}/{denominator}"
    return _decimal(numerator * 10**places // denominator, places)


def number_text(number: Fraction) -> str:
    """Return a fraction as text, as `exact` does."""
    return exact(number.numerator, number.denominator)


def rounded(numerator: int, denominator: int, decimals: int) -> str:
    """Return the number with this many decimals, rounded to nearest, halves away from zero: `50.00`; never `-0`."""
    return _decimal(nearest(numerator * 10**decimals, denominator), decimals)


def hex_text(number: int, digits: int = 4) -> str:
    """Return a number as manuals print it: `1028h`."""
    return f"{number:0{digits}X}h"


@lru_cache(maxsize=4096)
def times_text(start: str, numerator: int, denominator: int) -> str:
    """Return `start` times a fraction: `raw x 0.1`, `raw / 256`, `raw x 7 / 3`; just `start` for one."""
    if numerator == denominator:
        return start
    if numerator == 1:
        places = decimal_places(denominator)
        return f"{start} / {denominator}" if places is None or places > _SHORT else f"{start} x {exact(1, denominator)}"
    decimal = exact(numerator, denominator)
    if "/" in decimal or len(decimal.partition(".")[2]) > _SHORT:
        return f"{start} x {numerator} / {denominator}"
    return f"{start} x {decimal}"


def plus_text(start: str, numerator: int, denominator: int) -> str:
    """Return `start` plus a fraction: `raw + 2.5`, `raw - 7/3`; just `start` for zero."""
    if numerator == 0:
        return start
    return f"{start} {'-' if numerator < 0 else '+'} {exact(abs(numerator), denominator)}"


def shortest(count: int, places: int) -> str:
    """Return a count of 10^-places as a decimal, without zeros at its end."""
    whole, rest = divmod(abs(count), 10**places)
    sign = "-" if count < 0 else ""
    return f"{sign}{whole}.{rest:0{places}}".rstrip("0") if rest else f"{sign}{whole}"


@lru_cache(maxsize=4096)
def decimal_places(denominator: int) -> int | None:
    """Return how many decimals a reduced fraction over `denominator` has; None if they never end."""
    twos = (denominator & -denominator).bit_length() - 1
    rest, fives = denominator >> twos, 0
    while rest % 5 == 0:
        rest, fives = rest // 5, fives + 1
    return max(twos, fives) if rest == 1 else None


def _decimal(count: int, places: int) -> str:
    """Return a count of 10^-places as a decimal."""
    digits = str(abs(count)).rjust(places + 1, "0")
    point = "." if places else ""
    return f"{'-' if count < 0 else ''}{digits[: len(digits) - places]}{point}{digits[len(digits) - places :]}"


def fixed_rule(point: Point) -> Line | None:
    """Return the rule from raw numbers to values; None if it depends on other points or is unknown."""
    if point.scale is None:
        return SAME if point.generated or not point.unit.symbol else None
    return None if point.fixed_scale is None else value_line(point.fixed_scale)


def value_multiple(factor: Factor, point: Point) -> Fraction | None:
    """Return k such that `raw * slope + intercept == k * value` for the factor's point; None if there is none."""
    rule = fixed_rule(point)
    if rule is None or point.info.floating:
        return None
    multiply, add, divide = rule
    return Fraction(factor.slope * divide, multiply) if factor.intercept * multiply == factor.slope * add else None


# Dates.


def parts_text(layout: Text) -> str:
    """Return the places of the parts: `year from 2000 in bits 15..8 of word 1, month in bits 7..0 of word 1`."""
    return ", ".join(f"{_part_name(part)} in {_part_place(part)}" for part in layout.parts)


def _part_name(part: DatePart) -> str:
    """Return a part with its base."""
    if part.name == "weekday":
        first, number = ("monday", part.base - _MONDAY) if part.base >= _MONDAY else ("sunday", part.base)
        return f"weekday from {first} {number}"
    return f"{part.name} from {part.base}" if part.base else part.name


def _part_place(part: DatePart) -> str:
    """Return the place of a part: `word 2`, or `bits 6..0 of word 1`."""
    high, low = part.bits
    bits = "" if part.width == 16 else f"bits {high}..{low} of " if high > low else f"bit {low} of "
    return f"{bits}word {part.word + 1}"


# Frames.


def units_text(bus: Bus) -> str:
    """Return the unit numbers that the device may have: `units are 1 to 32`."""
    low, high = bus.units
    return f"units are {low} to {high}"


def strange_unit(bus: Bus, unit: int) -> str:
    """Return a text if the device cannot have a unit number; empty if it can."""
    low, high = bus.units
    return "" if low <= unit <= high else f"the device cannot have unit {unit}: {units_text(bus)}"


def hex_words(words: Sequence[int]) -> str:
    """Return words as manuals print them: `0001h FFFFh`."""
    return " ".join(f"{word:04X}h" for word in words)


def too_short(what: str, least: int, here: int) -> str:
    """Return a text about bytes that are too few for any frame."""
    return f"{what} has at least {least} bytes, here {'is' if here == 1 else 'are'} {here}"


def spaced(data: bytes) -> str:
    """Return bytes as manuals print them: `05 06 10 28`."""
    return data.hex(" ").upper()


def check_text(there: bytes, right: bytes) -> str:
    """Return the result of comparing a checksum (`there`) with the computed one (`right`)."""
    if not there:
        return f"missing; it would be {spaced(right)}"
    return f"ok ({spaced(there)})" if there == right else f"wrong: {spaced(there)}; these bytes give {spaced(right)}"


def no_answer_text(status: str, request: str = "request") -> str:
    """Return why a frame does not answer the open request."""
    return f"it does not answer the {request}: {_NO_ANSWER.get(status, status)}"


def span_text(low: int, high: int) -> str:
    """Return addresses in both notations: `1028h (4136)`, `1013h to 1014h (4115 to 4116)`."""
    return f"{hex_text(low)} ({low})" if low == high else f"{hex_text(low)} to {hex_text(high)} ({low} to {high})"


def element_text(parameter: int, index: int, *, alone: bool) -> str:
    """Return `parameter 1082`, or `parameter 2010, index 1`. `alone`: the parameter has a single element."""
    element = f", all elements (index {index})" if index == ALL_ELEMENTS else f", index {index}"
    return f"parameter {parameter}" + ("" if index == 0 and alone else element)


def numbered(codes: Sequence[Code], number: int) -> Code | None:
    """Return the code with that number."""
    return next((code for code in codes if code.number == number), None)


def word_text(addresses: tuple[int, ...], address: int, *, text: bool = False) -> str:
    """Return the word of a point at an address: `low word (2 of 2)`; empty for a point of one word."""
    count = len(addresses)
    if count < 2 or address not in addresses:
        return ""
    place = addresses.index(address)
    if text:
        return f"word {place + 1} of {count}, the first characters first"
    name = {0: "high word", count - 1: "low word"}.get(place, "word")
    return f"{name} ({place + 1} of {count}, the high part first)"


def misprint_text(frame: Frame) -> str:
    """Return the note for a frame that the manual prints with exactly this error."""
    known = f" (errata: {', '.join(frame.errata)})" if frame.errata else ""
    return line(f"the manual prints exactly these bytes as {frame.name}{known}; right is {spaced(frame.corrected)}")
