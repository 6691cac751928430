"""Numbers, intervals, bits in the numbering of a manual, and formulas, read from YAML values.

A function that takes a `report` adds a finding and returns None; the others raise FactError, which holds the finding.
"""

import re
from collections.abc import Collection, Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any, NamedTuple

from fieldscribe.arithmetic.exact import pattern_of
from fieldscribe.diagnostics import Report, Span
from fieldscribe.language.formula.normal import MOST_BITS, evaluate, multiples
from fieldscribe.language.formula.parser import parse_expression
from fieldscribe.language.formula.syntax import FormulaError, NoSumError, UnknownNameError
from fieldscribe.language.numbers import NumberError, parse_integer, parse_number
from fieldscribe.language.suggestions import suggest_interval

WORD_BITS = 16
"""The bits of a word."""
NUMBERINGS = {
    "from 0": (0, False),
    "from 1": (1, False),
    "from 0 at the top": (0, True),
    "from 1 at the top": (1, True),
}
"""The numberings of bits in manuals: the number of the first bit, and whether that is the highest one."""


class FactError(Exception):
    """A fact cannot be used. The arguments are those of `Report.error`; none if the finding is reported already."""

    def report(self, report: Report) -> None:
        """Report the finding, if it is not reported already."""
        if self.args:
            report.error(*self.args)


class Written(NamedTuple):
    """A formula with its place in the file."""

    text: str
    span: Span

    def of(self, name: str) -> Span:
        """Return the place of a name in the formula, at its first use."""
        match = re.search(rf"\b{re.escape(name)}\b", self.text)
        return self.span.moved(match.start() if match else 0, len(name))


def number(value: Any, span: Span, report: Report) -> Fraction | None:
    """Return the exact number of a YAML scalar in any notation of a manual; None after a finding."""
    if isinstance(value, int | Decimal):
        return Fraction(value)
    try:
        return parse_number(str(value))
    except NumberError as error:
        report.error("bad-number", error.message, span, error.hint)
        return None


def pattern(value: Fraction | None, bits: int, span: Span, report: Report) -> int | None:
    """Return the bit pattern of a floating-point number; None without a number, or after a finding."""
    try:
        return None if value is None else pattern_of(value, bits)
    except OverflowError:
        message = f"a floating-point number of {bits} bits cannot be so large"
        report.error("range-outside-type", message, span, "correct the number, or the type")
        return None


def integer(value: Any, span: Span, report: Report) -> int | None:
    """Return the whole number of a YAML scalar; None after a finding."""
    try:
        return whole(value, span)
    except FactError as error:
        error.report(report)
        return None


def whole(value: Any, span: Span) -> int:
    """Return the whole number of a YAML scalar. Raises FactError."""
    if isinstance(value, int):
        return value
    try:
        return parse_integer(str(value))
    except NumberError as error:
        raise FactError("bad-number", error.message, span, error.hint) from error


def interval(text: str, span: Span, report: Report) -> tuple[int, int] | None:
    """Return the ends of `a..b`, or of a single number; None after a finding."""
    suggestion = None if ".." in text else suggest_interval(text)
    if suggestion is not None:
        report.error("bad-number", f"`{text[:60]}` is no interval", span, f"write {suggestion}")
        return None
    ends = whole_ends(text, span, report)
    if ends is not None and ends[0] > ends[1]:
        low_text, _, high_text = text.partition("..")
        message = f"`{text}` runs downwards"
        report.error("range-reversed", message, span, f"write {high_text.strip()}..{low_text.strip()}")
        return None
    return ends


def whole_ends(text: str, span: Span, report: Report) -> tuple[int, int] | None:
    """Return both numbers of `a..b`, or a single number twice; None after a finding."""
    ends = [integer(end.strip(), span, report) for end in text.split("..", 1)]
    return None if ends[0] is None or ends[-1] is None else (ends[0], ends[-1])


class BitNumbers(NamedTuple):
    """The numbering of a number of bits in a manual; the model counts them from 0, the lowest one first."""

    width: int
    first: int = 0
    from_top: bool = False

    def bit(self, number: int) -> int:
        """Return the bit that the manual numbers so."""
        return self.width - 1 + self.first - number if self.from_top else number - self.first

    def number(self, bit: int) -> int:
        """Return the number that the manual gives a bit."""
        return self.width - 1 + self.first - bit if self.from_top else bit + self.first

    def written(self, high: int, low: int) -> str:
        """Return an interval of bits as text, in the numbers of the manual."""
        return f"{self.number(high)}..{self.number(low)}"

    def range_of(self, text: str, span: Span, report: Report) -> tuple[int, int] | None:
        """Return the highest and the lowest bit that `5..4` or a single number names; None after a finding."""
        ends = whole_ends(text, span, report)
        if ends is None:
            return None
        high, low = map(self.bit, ends)
        if high < low:
            message, hint = f"bits `{text}` run upwards", f"the higher bit comes first: {self.written(low, high)}"
            report.error("range-reversed", message, span, hint)
            return None
        return high, low


def formula_value(text: str, names: Mapping[str, Fraction], span: Span, unknown: str = "") -> Fraction:
    """Return the result of a formula of known numbers (`base + 6`). Raises FactError.

    `unknown` is the hint if the formula names another number.
    """
    try:
        return evaluate(parse_expression(text), names)
    except FormulaError as error:
        raise _unknown_or_wrong(error, span, unknown) from error


def formula_multiples(
    text: str, names: Collection[str], span: Span, unknown: str, example: str = "slot * 1000 + 200"
) -> tuple[int, dict[str, int]]:
    """Return the constant and the factors of a sum of whole multiples of names. Raises FactError, as formula_value."""
    try:
        constant, factors = multiples(parse_expression(text), names)
    except NoSumError as error:
        hint = f"multiply a name by a whole number alone, such as `{example}`"
        raise FactError("bad-formula", error.message, span.moved(error.column), hint) from error
    except FormulaError as error:
        raise _unknown_or_wrong(error, span, unknown) from error
    if any(max(map(int.bit_length, number.as_integer_ratio())) > MOST_BITS for number in (constant, *factors.values())):
        raise FactError("bad-formula", "the numbers of this formula are too large", span, "write smaller ones")
    if any(number.denominator != 1 for number in (constant, *factors.values())):
        message = f"`{text}` does not rise in whole steps"
        raise FactError("bad-formula", message, span, f"write it as a sum of multiples, such as `{example}`")
    return int(constant), {name: int(factor) for name, factor in factors.items()}


def _unknown_or_wrong(error: FormulaError, span: Span, unknown: str) -> FactError:
    """Return the finding of a formula, with this hint if it names something unknown."""
    if unknown and isinstance(error, UnknownNameError):
        error.hint = unknown
    return formula_fault(error, span)


def formula_finding(error: FormulaError, span: Span, report: Report) -> None:
    """Report a finding at the column of the formula that is wrong."""
    formula_fault(error, span).report(report)


def formula_fault(error: FormulaError, span: Span) -> FactError:
    """Return the finding at the column of the formula that is wrong."""
    hint = error.hint or "formulas are made of numbers, points, + - * /, 10 ** n and parentheses"
    return FactError("bad-formula", error.message, span.moved(error.column), hint)
