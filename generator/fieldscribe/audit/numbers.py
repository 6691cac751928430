"""Numbers in a manual's text, in every notation that manuals use, with all that each can mean.

The documents of a description say which notation a manual has.
"""

import re
from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache
from typing import Any, Final, NamedTuple

from fieldscribe.language.nodes import Map

USUAL_ACCESS: Final = {
    "r": ("R", "RO", "R/O", "r", "ro"),
    "w": ("W", "WO", "W/O", "w", "wo"),
    "rw": ("R/W", "RW", "r/w", "rw"),
}
"""How tables print access in its own cells, if the description does not say how this manual does."""
USUAL_TYPES: Final = {
    "bit": ("BIT", "Bit", "BOOL", "Bool", "bool"),
    "u8": ("UINT8", "uint8", "U8", "u8", "BYTE", "Byte"),
    "s8": ("INT8", "int8", "S8", "s8", "I8", "SINT"),
    "u16": ("UINT16", "uint16", "U16", "u16", "UINT", "WORD", "Word", "Wort"),
    "s16": ("INT16", "int16", "S16", "s16", "I16", "INT", "SHORT"),
    "u32": ("UINT32", "uint32", "U32", "u32", "UDINT", "ULONG", "DWORD", "Doppelwort"),
    "s32": ("INT32", "int32", "S32", "s32", "I32", "DINT", "LONG"),
    "f32": ("FLOAT32", "float32", "F32", "f32", "FLOAT", "Float", "float", "REAL"),
    "f64": ("FLOAT64", "float64", "F64", "f64", "DOUBLE", "Double", "LREAL"),
}
"""How tables usually print types."""


class Notation:
    """The notation of a manual: `writes`, `access` and `names` of its document, and its language."""

    def __init__(self, documents: Map) -> None:
        self._words: dict[str, list[str]] = {}
        self.access: dict[str, list[str]] = {}
        self.names: list[str] = []
        self.language = next((str(document["language"]) for document in documents.values()), "")
        for document in documents.values():
            for written, words in document.get("writes", {}).items():
                self._words.setdefault(str(written), []).extend(map(str, words))
            for access, words in document.get("access", {}).items():
                self.access.setdefault(access, []).extend(map(str, words))
            self.names += map(str, document.get("names", ()))

    def written(self, text: object) -> tuple[str, ...]:
        """Return the manual's words for the letters of a code, the name of a numbering, a number, or `default`."""
        return tuple(self._words.get(str(text), ()))

    def bits(self, high: int, low: int) -> tuple[str, ...]:
        """Return the manual's names for a part of a word: `Highbyte` for 15..8."""
        return self.written(f"{high}..{low}")

    def label(self, titles: Mapping[str, Any] | str | None) -> tuple[str, ...]:
        """Return a title as the manual prints it, in its language; empty if `writes` says that it prints none."""
        text = titles.get(self.language) if isinstance(titles, dict) else titles if self.language == "en" else None
        if text is None or not any(map(str.isalpha, str(text))):
            return ()
        return tuple(self._words.get(str(text), (str(text),)))


def joined(name: str, number: object) -> tuple[str, ...]:
    """Return how a manual writes a name and a number as one word: `PZD2`, `Bit13`."""
    return tuple(f"{name}{number}" for name in (name, name.capitalize(), name.upper()))


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
"""Matches a 1 that is the numerator of a fraction: `1/V`, `1/100`."""
_LONGEST_NUMBER = 80
"""A longer run of digits is not the number of a fact: it has no reading."""


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
    """Return all that a number can mean. Cached, because manuals print the same few numbers again and again."""
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
    """Return the readings of digits with points and commas, which separate decimals, thousands, or items."""
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
