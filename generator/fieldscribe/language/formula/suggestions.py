"""What a scale or a condition in another notation probably means, in ours: tables of patterns and replacements.

And decimals that were cut off, with the fractions that they stand for.
"""

import re
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from functools import lru_cache
from itertools import product
from typing import NamedTuple

from fieldscribe.language.formula.conditions import parse_condition
from fieldscribe.language.formula.parser import parse_scale
from fieldscribe.language.formula.syntax import FormulaError
from fieldscribe.language.numbers import LONGEST

_SIGNS = str.maketrans({"\u00d7": "*", "\u00b7": "*", "\u22c5": "*", "\u00f7": "/", "\u2212": "-", "\u2013": "-"})
_FACTOR = r"[0-9]+(?:\.[0-9]+)?"
_SIDES = {
    name: side
    for side, names in (
        ("value", "value y phys physical eng engineering result scaled actual real display wert"),
        ("raw", "raw x reg register count counts int integer data word rohwert"),
    )
    for name in names.split()
}
_SCALES = (
    (rf"\*\s*({_FACTOR})", r"value = raw * \1"),
    (rf"[xX]\s*({_FACTOR})", r"value = raw * \1"),
    (rf"({_FACTOR})\s*[xX*]?", r"value = raw * \1"),
    (rf"/\s*({_FACTOR})", r"value = raw / \1"),
    (rf"1\s*[:/]\s*({_FACTOR})", r"value = raw / \1"),
    (rf"({_FACTOR})\s*[:/]\s*({_FACTOR})", r"value = raw * \1 / \2"),
    (r"10\s*(?:\*\*|\^)\s*([-+]?[0-9]+)", r"value = raw * 10 ** \1"),
    (rf"({_FACTOR})\s*[^\W\d_]{{1,4}}(?:/bit|/digit|/lsb|/count)?", r"value = raw * \1"),
    (r"([^=]*\braw\b[^=]*)", r"value = \1"),
    (r"([^=]*\bvalue\b[^=]*)", r"raw = \1"),
    (r"(.*=.*)", r"\1"),
)
"""A pattern of the whole text, with our signs, and the scale that it stands for."""
_CONDITIONS = (
    (r"^\s*(?:if|only if|when)\s+", ""),
    (r"\|\|", " or "),
    (r"&&?", " and "),
    (r"\bis not\b|<>|\u2260", "!="),
    (r"\bis\b|===|(?<![=!<>])=(?!=)", "=="),
    (r"\bin\s*[\[{]([^\]}]*)[\]}]", r"in (\1)"),
    (r"([A-Za-z]\w*) in ([-+0-9A-Fa-fxh]+)\s*\.\.\s*([-+0-9A-Fa-fxh]+)", r"\1 >= \2 and \1 <= \3"),
)
"""What is replaced in a condition, one after the other."""
_LONGEST_FORMULA = 80


def suggest_scale(text: str) -> str | None:
    """Return the scale that a text probably means, in our notation; None if there is no suggestion."""
    if len(text) > _LONGEST_FORMULA:
        return None
    plain = re.sub(r"(?<=[0-9]),(?=[0-9])", ".", text.translate(_SIGNS).strip())
    plain = re.sub(r"(?<=[\w)])\s+[xX]\s+(?=[\w(])", " * ", plain)
    plain = re.sub(r"(?<=10)\s*\^\s*", " ** ", plain).replace("==", "=").replace(":=", "=")
    if "=" in plain or re.search(r"\b(raw|value)\b", plain):
        plain = re.sub(r"[A-Za-z_]+", lambda word: _SIDES.get(word[0].lower(), word[0]), plain)
    for pattern, scale in _SCALES:
        match = re.fullmatch(pattern, plain)
        line = "" if match is None else match.expand(scale)
        if line and _is_read_by(parse_scale, line):
            return exact_scale(line)
    return None


def suggest_condition(text: str) -> str | None:
    """Return the condition that a text probably means, in our notation; None if there is no suggestion."""
    if len(text) > _LONGEST_FORMULA:
        return None
    plain = text
    for pattern, replacement in _CONDITIONS:
        plain = re.sub(pattern, replacement, plain)
    plain = " ".join(plain.split())
    return plain if plain != text and _is_read_by(parse_condition, plain) else None


def _is_read_by(parse: Callable[[str], object], text: str) -> bool:
    try:
        parse(text)
    except FormulaError:
        return False
    return True


_DECIMAL = re.compile(r"(?<![0-9A-Za-z_.,'])[0-9]+\.[0-9]+(?![0-9A-Za-z_]|\.[0-9])")
_FEWEST_DIGITS = 5
_NUMERATORS = range(1, 17)
_POWERS_OF_TWO = tuple(2**two for two in range(8, 33))
_EXPONENTS_OF_TEN = range(-4, 6)
_THIRDS = (3, 6, 9, 12, 15, 18, 30, 36, 60, 90)
_REPEATING = re.compile(r"([0-9])\1\1[0-9]?\Z")
_LONGEST_TEXT = 2000


class CutOff(NamedTuple):
    """A decimal that is almost a simple fraction; `line` is the formula with that fraction."""

    typed: str
    exact: str
    line: str


@lru_cache(maxsize=16384)
def cut_off(text: str) -> CutOff | None:
    """Return the first decimal of a formula that is almost n / 2^k * 10^m, or a repeating fraction such as 2 / 3.

    "Almost" is within half a unit of the last digit; decimals with fewer than five digits are left alone.
    """
    if "." not in text:
        return None
    for decimal, exact in _cut(text[:_LONGEST_TEXT]):
        return CutOff(decimal[0], exact, exact_scale(text))
    return None


def exact_scale(text: str) -> str:
    """Return the formula with fractions in place of the decimals that were cut off."""
    for decimal, exact in reversed(list(_cut(text[:_LONGEST_TEXT]))):
        text = _replaced(text, decimal, exact)
    return text


def _cut(text: str) -> Iterator[tuple[re.Match[str], str]]:
    for decimal in _DECIMAL.finditer(text):
        typed = decimal[0]
        if len(typed) <= LONGEST and len(typed.replace(".", "").lstrip("0")) >= _FEWEST_DIGITS:
            exact = _almost(typed)
            if exact is not None:
                yield decimal, exact


def _replaced(text: str, decimal: re.Match[str], exact: str) -> str:
    """Return the text with the fraction in place of the decimal: `raw * 0.33333` becomes `raw / 3`."""
    before, after = text[: decimal.start()].rstrip(), text[decimal.end() :]
    top, _, bottom = exact.partition(" / ")
    if before.endswith("/"):
        product = f"* {bottom}" + ("" if top == "1" else f" / {top}")
        return f"{before[:-1].rstrip()} {product}{after}"
    if before.endswith("*") and top == "1":
        return f"{before[:-1].rstrip()} / {bottom}{after}"
    return f"{text[: decimal.start()]}{exact}{after}"


def _almost(typed: str) -> str | None:
    """Return the fraction that a decimal almost equals, as text; None if there is none, or if the decimal is exact."""
    number, half = Fraction(typed), Fraction(1, 2 * 10 ** len(typed.partition(".")[2]))
    powers = sorted(_near(number, half, _POWERS_OF_TWO))
    if powers and all(fraction != number for fraction, *_ in powers):
        return f"{powers[0][2]} / {powers[0][3]}"
    thirds = _near(number, half, _THIRDS) if _REPEATING.search(typed) else ()
    least = min((fraction for fraction, *_ in thirds if fraction.denominator % 3 == 0), default=None)
    return None if least is None else f"{least.numerator} / {least.denominator}"


def _near(number: Fraction, half: Fraction, divisors: Iterable[int]) -> Iterator[tuple[Fraction, int, int, int]]:
    """Yield each numerator / divisor * 10^m within `half` of a number, with its numerator and as top / bottom."""
    size = float(number)
    for divisor, ten in product(divisors, _EXPONENTS_OF_TEN):
        numerator = round(size * divisor / 10.0**ten)
        if numerator in _NUMERATORS:
            top, bottom = numerator * 10 ** max(ten, 0), divisor * 10 ** max(-ten, 0)
            if abs(Fraction(top, bottom) - number) <= half:
                yield Fraction(top, bottom), numerator, top, bottom
