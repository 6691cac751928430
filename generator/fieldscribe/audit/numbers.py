"""Numbers in a manual's text, in every notation that manuals use, with all that each can mean."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

_NUMBER = re.compile(
    r"""(?<![\w,'\u2018\u2019\u201a])(?<![^.]\.)(?:
        0[xX](?P<long>[0-9A-Fa-f]{4})
      | (?:0[xX]|[Hh]'|[Hh]ex[ ])(?P<marked>[0-9A-Fa-f]+)
      | (?P<binary>[01]{4,}(?:[ ][01]{4,})+)(?=[ ]?bin(?!\w))
      | (?P<parted>[0-9]+(?:\\?_[0-9]+)+)(?:(?=bin\b)|(?![A-Za-z0-9]|_[A-Za-z0-9]))
      | (?P<spaced>[0-9A-F](?:[ ][0-9A-F]){1,3})[ ]h(?!\w)
      | (?P<tailed>(?=[A-F]*[0-9]|[A-F]+[hH]|[A-Fa-f]+[0-9])[0-9A-Fa-f]+)[hH](?!\w)
      | (?P<bare>[0-9A-F]*[0-9][0-9A-F]*[A-F][0-9A-F]*|[A-F][0-9A-F]*[0-9][0-9A-F]*|[A-F]{2}|[A-F]{4})(?!\w)
      | (?P<grouped>(?<![0-9][ ])[1-9][0-9]{0,2}(?:[ \u00a0\u2009\u202f][0-9]{3})+)(?![\w'.,]*[0-9])(?![ ][0-9])
      | (?P<decimal>[0-9]+(?:[.,][0-9]+)*)
    )""",
    re.VERBOSE,
)
_LIST = re.compile("(?![0-9]{1,3}(?:,[0-9]{3})+$)[0-9]+(?:,[0-9]+){2,}")
"""Numbers separated by commas without blanks; three digits after each comma are thousands."""
_LATEX_FRACTION = "\\frac{"
_DENOMINATOR = re.compile("/(?:[^\\W\\d_]|%|[0-9]{2})")
"""What makes a 1 the numerator of a fraction: `1/V`, `1/100`."""
_LONGEST_NUMBER = 80
"""A longer run of digits is no number of a fact; it has no reading."""


class Token(NamedTuple):
    """A number in the text: its spelling, line and column from 1, and what it can mean (`10`: ten, sixteen, two)."""

    text: str
    line: int
    column: int
    readings: frozenset[Fraction]

    def is_plainly(self, numbers: frozenset[Fraction]) -> bool:
        """Return True if it means one of these numbers other than as two or three binary digits (`11` for 3)."""
        if len(self.text) > 3 or not set(self.text) <= {"0", "1"}:
            return not self.readings.isdisjoint(numbers)
        return not (self.readings - {Fraction(int(self.text, 2))} | {Fraction(int(self.text))}).isdisjoint(numbers)


def tokens_of(text: str, line: int, column: int = 0) -> list[Token]:
    """Return the numbers in a piece of a line that begins after `column` characters."""
    tokens: list[Token] = []
    for match in _NUMBER.finditer(text):
        if _LIST.fullmatch(match[0]):
            for part in re.finditer("[0-9]+", match[0]):
                tokens += tokens_of(part[0], line, column + match.start() + part.start())
        elif match[0] != "1" or not _is_numerator(text, match):
            digits = match[0].replace(" ", "_") if match["binary"] else match[0]
            tokens.append(Token(match[0], line, column + match.start() + 1, readings_of(digits)))
    return tokens


def _is_numerator(text: str, match: re.Match[str]) -> bool:
    before = text.endswith(_LATEX_FRACTION, 0, match.start())
    return before or _DENOMINATOR.match(text, match.end()) is not None


@lru_cache(10_000)
def readings_of(number: str) -> frozenset[Fraction]:
    """Return all that a number can mean; the cache pays because the same few are printed again and again."""
    match = _NUMBER.fullmatch(number) if len(number) <= _LONGEST_NUMBER else None
    return frozenset(_readings(match) if match else ())


def _readings(match: re.Match[str]) -> set[Fraction]:
    if marked := match["long"] or match["marked"] or match["tailed"]:
        return {Fraction(int(marked, 16))}
    if parted := match["parted"]:
        digits = parted.replace("_", "").replace("\\", "")
        return {Fraction(int(digits, 2 if set(digits) <= {"0", "1"} else 10))}
    if spaced := match["spaced"]:
        return {Fraction(int(spaced.replace(" ", ""), 16))}
    if grouped := match["grouped"]:
        return {Fraction("".join(grouped.split())), *map(Fraction, grouped.split())}
    if bare := match["bare"]:
        amount = {Fraction(int(bare[:-1]))} if re.fullmatch("[1-9][0-9]*A", bare) else set()
        return {Fraction(int(bare, 16)), *amount}  # "10A" may be ten ampere
    text = match["decimal"]
    readings = _decimal_readings(text)
    if text.isdigit() and len(text) in (2, 4, 8):
        readings.add(Fraction(int(text, 16)))
    if set(text) <= {"0", "1"} and len(text) > 1:
        readings.add(Fraction(int(text, 2)))
    return readings


def _decimal_readings(text: str) -> set[Fraction]:
    """Points and commas may separate decimals, thousands, or the numbers of a list."""
    parts = re.split(r"[.,]", text)
    if len(parts) == 1:
        return {Fraction(int(text))}
    if len(parts) == 2:
        readings = {Fraction(int("".join(parts)), 10 ** len(parts[1]))}
    else:
        readings = {Fraction(int(part)) for part in parts}
    if all(len(part) == 3 for part in parts[1:]):
        readings.add(Fraction(int("".join(parts))))
    return readings
