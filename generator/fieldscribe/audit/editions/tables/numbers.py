"""Numbers, ranges, steps and units in the text of cells, exact, in English and German notation."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables.cell_text import one_line

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

_NUMBER = r"[-+\u2212]?\d{1,15}(?:[.,]\d{1,9})?"
_PLAIN_UNIT = (
    r"(?:%(?:/s)?|‰|°(?:\s?[CF])?|(?!(?:to|bis|und|and|through|x)\b)[A-Za-zµμΩ°][A-Za-zµμΩ°/²³·]{0,14}|1/[a-z]{1,4})"
)
_UNIT = rf"(?:{_PLAIN_UNIT}|\({_PLAIN_UNIT}\))"
_TO = r"(?:-|–|—|−|\.{2,}|…|~|÷|\bto\b|\bbis(?: zu)?\b|\bthrough\b)"
_BETWEEN = r"(?:\bto\b|\bund\b|\band\b|-|–|\bbis\b)"
_RANGE = re.compile(
    rf"(?<![\w.,])(?:(?:zwischen|between)\s+({_NUMBER})\s*({_UNIT})?\s*{_BETWEEN}"
    rf"|({_NUMBER})\s*({_UNIT})?\s*{_TO})\s*({_NUMBER})(?![\d.,]*\d|h\b)\s*({_UNIT})?"
)
_LIST = re.compile(r"[-+]?\d+(?:\s*(?:,\s|;|/|\||,$|,(?=\d+(?:,|$)))\s*[-+]?\d+)+\s*,?")
_EITHER = re.compile(r"(\d{1,5}) (?:or|oder) (\d{1,5})\b(?![.,]\d)")
_LIMIT = rf"\(?\s*(?:[A-Za-z]{{1,4}}\d{{1,4}}(?:\s*[x*·×]\s*\d{{1,6}})?|{_NUMBER})\s*\)?"
_MOVING = re.compile(rf"({_LIMIT})\s*(?:{_TO})\s*({_LIMIT})")
_CODE = re.compile(r"[A-Za-z]{1,4}\d{1,4}")
_WORDS = {
    "std": "h", "stunde": "h", "stunden": "h", "hours": "h", "hour": "h", "hrs": "h",
    "sek": "s", "sekunde": "s", "sekunden": "s", "seconds": "s", "second": "s", "sec": "s",
    "minuten": "min", "minute": "min", "minutes": "min", "msec": "ms", "millisekunden": "ms",
    "tage": "d", "days": "d", "grad": "°", "prozent": "%", "percent": "%", "hz": "Hz", "khz": "kHz",
    "volt": "V", "ampere": "A", "amps": "A", "watt": "W", "u/min": "rpm", "1/min": "1/min",
}  # fmt: skip
"""Units as people write them out, in both languages."""


@dataclass(frozen=True, slots=True)
class Span:
    """A range in a cell: its ends, the unit beside them (empty without one), and whether it has decimals."""

    low: Fraction
    high: Fraction
    unit: str
    decimals: bool
    text: str

    @property
    def as_yaml(self) -> str:
        """As a description writes it."""
        return f"{decimal(self.low)}..{decimal(self.high)}"


def number_of(text: str) -> Fraction:
    """The number of a text with a decimal point or comma."""
    return Fraction(text.replace("\u2212", "-").replace(",", ".").lstrip("+"))


def decimal(number: Fraction) -> str:
    """An exact decimal fraction, or a whole number, as YAML has it."""
    if number.denominator == 1:
        return str(number.numerator)
    places = next(count for count in range(1, 40) if (number * 10**count).denominator == 1)
    digits = f"{abs(number * 10**places).numerator:0{places + 1}d}"
    return f"{'-' if number < 0 else ''}{digits[:-places]}.{digits[-places:]}"


def is_decimal(number: Fraction) -> bool:
    """Whether a number has a finite decimal form of a sane length."""
    return (number * 10**18).denominator == 1


@cache
def _spellings() -> Mapping[str, str]:
    from fieldscribe.language.units import shipped

    known: dict[str, str] = {}
    for unit in shipped().values():
        for spelling in unit.spellings:
            known.setdefault(spelling, unit.unit.symbol)
    return known


def unit_of(text: str) -> str:
    """The shipped unit that a text names; empty if it names none."""
    from fieldscribe.language.units import shipped_unit

    plain = " ".join(text.split()).strip(" .;:[]()")
    if not plain or len(plain) > 24:
        return ""
    known = shipped_unit(plain)
    if known is not None:
        return known.symbol
    return _spellings().get(plain) or _WORDS.get(plain.casefold(), "")


def spans(text: str) -> list[Span]:
    """All ranges in a text, from left to right; what stands for a unit and is none is left out."""
    return list(_spans(one_line(text)))


def _spans(text: str) -> Iterator[Span]:
    for found in _RANGE.finditer(text):
        low, before, high, after = found[1] or found[3], found[2] or found[4], found[5], found[6]
        unit = unit_of(after or "") or unit_of(before or "")
        first, last = number_of(low), number_of(high)
        yield Span(min(first, last), max(first, last), unit, any(sign in low + high for sign in ".,"), found[0].strip())


def listed(text: str) -> list[int] | None:
    """The numbers of a cell that is nothing but a list of whole numbers, such as `0, 1, 2`; None if it is none."""
    plain = one_line(text).strip(" ,;")
    if either := _EITHER.match(plain):
        return [int(either[1]), int(either[2])]
    if not _LIST.fullmatch(plain) or re.fullmatch(r"[-+]?\d+,\d+", plain):  # `0,1` is a tenth
        return None
    return [int(number) for number in re.findall(r"[-+]?\d+", plain)]


def alone(text: str) -> tuple[Fraction, str, str] | None:
    """The one number of a cell, its text, and what stands behind it, as in `0,1 Hz`; None for anything else."""
    plain = one_line(text)
    found = re.fullmatch(rf"({_NUMBER})\s*([^\d]*(?:/[a-z0-9]+)?)", plain)
    return (number_of(found[1]), found[1], found[2].strip()) if found else None


def moving(text: str) -> tuple[str, str] | None:
    """Both ends of a range that codes of other points limit, as in `(b082 x 10)-600`, as a description writes them."""
    found = _MOVING.match(one_line(text))
    if found is None or not (_CODE.search(found[1]) or _CODE.search(found[2])):
        return None
    return _limit(found[1]), _limit(found[2])


def _limit(text: str) -> str:
    plain = text.strip(" ()")
    return re.sub(r"\s*[x*·×]\s*", " * ", plain) if _CODE.match(plain) else decimal(number_of(plain))


def codes_in(ends: Iterable[str]) -> set[str]:
    """The codes that limits name."""
    return {found for end in ends for found in _CODE.findall(end)}
