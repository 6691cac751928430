"""Reads numbers as manuals write them: decimal, hexadecimal with a marker, binary with `0b`; exact, as fractions.

`4136`, `0.1`, `-5`, `1e3`, `0x1028`, `1028h`, `H'33F`, `0b0101`. A leading zero does not change the base. Numbers that
could be read in two ways (`4E20`, `1,5`, `1FF`) are refused with a hint.
"""

import re
from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction
from functools import lru_cache

from fieldscribe.text import line, shortened

LONGEST = 64
"""The most characters that a number may have."""

MOST_EXPONENT = 400
"""The largest power of ten that may be written."""

_OTHER = re.compile(r"([+-]?)(?:0[xX]([0-9A-Fa-f]+)|[Hh]'([0-9A-Fa-f]+)|([0-9A-Fa-f]+)[hH]|0b([01]+))")
_DECIMAL = re.compile(r"([+-]?[0-9]+)(?:\.([0-9]+))?(?:([eE])([+-]?[0-9]+))?")


class NumberError(ValueError):
    """A text is no number. `message` says what is wrong, `hint` how to write it (may be empty)."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint


@lru_cache(maxsize=65536)
def parse_number(text: str) -> Fraction:
    """Return the exact number of a text; blanks around it are ignored. Raises NumberError."""
    text = text.strip(" \t")
    if len(text) > LONGEST:
        raise NumberError(f"a number has at most {LONGEST} characters", "write it with an exponent, as in 1e30")
    if match := _DECIMAL.fullmatch(text):
        return _decimal(text, match)
    if match := _OTHER.fullmatch(text):
        sign, *hexadecimal, binary = match.groups()
        magnitude = int(binary, 2) if binary else int("".join(filter(None, hexadecimal)), 16)
        return Fraction(-magnitude if sign == "-" else magnitude)
    raise _diagnosis(text)


@lru_cache(maxsize=65536)
def parse_integer(text: str) -> int:
    """Return the whole number of a text; a decimal point is refused, even before zeros. Raises NumberError."""
    number = parse_number(text)
    if number.denominator != 1 or "." in text:
        raise NumberError(f"`{shortened(text)}` is not a whole number", "write a whole number, without a decimal point")
    return number.numerator


def number_in(value: object) -> Fraction | None:
    """Return the number of a YAML value in some notation; None for any other value."""
    with suppress(NumberError):
        return parse_number(str(value))
    return None


def integer_in(value: object) -> int | None:
    """Return the whole number of a YAML value in some notation; None for any other value."""
    with suppress(NumberError):
        return parse_integer(str(value))
    return None


def _decimal(text: str, match: re.Match[str]) -> Fraction:
    """Return the number of a decimal, from its digits, fraction and exponent."""
    whole, fraction, mark, exponent = match.groups()
    if fraction is None and mark is None:
        return Fraction(int(whole))
    if mark == "E" and fraction is None and exponent[0] not in "+-":
        sign = "-" if whole[0] == "-" else ""
        raise NumberError(
            f"`{text}` could be hexadecimal or a power of ten",
            f"write {text}h or {sign}0x{text.lstrip('+-')} if hex is meant, {text.lower()} for the power of ten",
        )
    power = int(exponent or 0)
    if abs(power) > MOST_EXPONENT:
        raise NumberError(f"the exponent of `{text}` is beyond {MOST_EXPONENT}", "check the exponent")
    digits = int(whole + (fraction or ""))
    power -= len(fraction or "")
    return Fraction(digits * 10**power) if power >= 0 else Fraction(digits, 10**-power)


def _joined_hint(match: re.Match[str]) -> str:
    return f"write the digits together: {re.sub('[^0-9+-]', '', match[0])}"


def _other_hex_hint(match: re.Match[str]) -> str:
    digits = (match[1] or match[2]).upper()
    return f"write {digits}h" if digits[0].isdigit() else f"write 0x{digits}"


def _modicon_hint(match: re.Match[str]) -> str:
    number = max(0, int(match[2]) - 1)
    space = {"1": "discrete", "3": "input", "4": "holding"}[match[1]]
    return f"on the wire it is {number}, in the space `{space}`; the printed number goes under `printed`"


_REFUSED: tuple[tuple[str, str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"", "a number is missing", "write a number, for example 4136, 0.1, 1028h or 0b0101"),
    (r"[\u2010-\u2015\u2212].*", "this minus sign is not the one of the keyboard", "write -"),
    (r"[+-]?[0-9]{1,3}(?:,[0-9]{3}){2,}", "thousands are not separated", _joined_hint),
    (
        r"([+-]?[0-9]+),([0-9]+)",
        "a decimal comma, or a separator of thousands",
        r"write the decimal point: \1.\2; a list has a blank after each comma",
    ),
    (r"[+-]?[0-9]{1,3}(?:[_'\u2019\s][0-9]{3})+", "thousands are not separated", _joined_hint),
    (r"[+-]?[0-9]{1,3}(?:\.[0-9]{3}){2,}", "thousands are not separated", _joined_hint),
    (r"[+-]?0b[0-9]*", "a binary number has only the digits 0 and 1", "as in 0b0101; hexadecimal ends in h"),
    (r"[+-]?0B[01]*", "binary is marked with a small b", "write 0b0101 for binary, 0B01h for hexadecimal"),
    (r"([134])[xX]([0-9]{4,5})", "a number for people, counted from 1", _modicon_hint),
    (
        r"(?:\$|#|&[hH]|16#|[xX]')\s*([0-9A-Fa-f]+)'?|([0-9A-Fa-f]+)\s*(?:hex|HEX|Hex)",
        "hexadecimal in another notation",
        _other_hex_hint,
    ),
    (
        r"[+-]?(?:0[xX][0-9A-Za-z]*|[hH]'.*|[0-9][0-9A-Za-z]*[hH])",
        "a hexadecimal number has only the digits 0 to 9 and A to F, and one marker",
        "write 1028h, 0x1028 or H'1028",
    ),
    (
        r"([+-]?)([0-9A-Fa-f]+)",
        "hexadecimal digits without a marker",
        r"write \g<0>h or \g<1>0x\2 for hexadecimal; a unit is not part of a number",
    ),
    (r"[+-]?\.[0-9]+", "a digit is missing before the decimal point", "write 0.5"),
    (r"[+-]?[0-9]+\.", "a digit is missing after the decimal point", "write 5 or 5.0"),
    (r"[+-]\s+[0-9].*", "a blank stands between sign and number", "write the sign directly before it"),
    (
        r"[+-]?[0-9]+\s+[0-9A-Fa-f\s]+[hH]?",
        "a blank stands inside the number",
        "write it without blanks; a unit is not part of a number",
    ),
    (
        r"[+-]?[0-9]+(?:\.[0-9]+)?\s*(?:[^\W\d_][^\d]*|[%\u00b0\u2030\u00b5\u2126].*)",
        "a unit is not part of a number",
        "write the number alone; the unit has its own key",
    ),
)


def _diagnosis(text: str) -> NumberError:
    """Return the error for a text that is no number, from the first known mistake that fits."""
    for pattern, message, hint in _REFUSED:
        if match := re.fullmatch(pattern, text, re.DOTALL):
            advice = hint(match) if callable(hint) else match.expand(hint)
            return NumberError(f"`{shortened(text)}`: {message}" if text else message, line(advice))
    return NumberError(f"`{shortened(text)}` is not a number", "write a number, for example 4136, 0.1, 1028h or 0b0101")
