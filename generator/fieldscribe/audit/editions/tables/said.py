"""What the cells of a row say about its raw numbers, taken apart: ranges, step, unit, formula."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables import numbers
from fieldscribe.audit.editions.tables.cell_text import one_line
from fieldscribe.audit.editions.tables.labels import without_labels

if TYPE_CHECKING:
    from fieldscribe.audit.editions.tables.numbers import Span

_SAME_AS = re.compile(r"entspr|corresponds?|equals?|equivalent|≙|→|=", re.IGNORECASE)
_NAMED = re.compile(r"(?<![\w>])(\d{1,5})\s*=\s*([A-Za-zÄÖÜäöü][\w ]*)")
_FRACTION = re.compile(r"\(?\s*1\s*/\s*(10{0,6})\s*\)?\s*(.*)")
_SYMBOL = r"[^\W\d][\w\\/-]*(?:\s*\[[^\]]*\]|\s*\([^()\d]*\))?"
_UNIT_SIGNS = r"[A-Za-z%°µΩ/²]+"
_TIMES = r"(\d+(?:[.,]\d+)?)(?![\d.,])"
_FACTOR = rf"\(?\s?{_TIMES}\s?/\s?{_UNIT_SIGNS}\s?\)?|{_TIMES}(?!\s?/)|\(\s?{_UNIT_SIGNS}\s?/\s?{_UNIT_SIGNS}\s?\)"
_FORMULA = re.compile(rf"[^=]*=\s*{_SYMBOL}(?P<factors>(?:\s*[*·×]?\s*(?:{_FACTOR}))*)\s*[.]?")
_LONGEST_FORMULA = 200


@dataclass(frozen=True, slots=True)
class Said:
    """What the cells of a row say, taken apart: ranges that may be raw, ranges in the unit, the step, the unit."""

    raws: tuple[Span, ...]
    values: tuple[Span, ...]
    listed: tuple[int, ...] | None
    moving: tuple[str, str] | None
    named: tuple[tuple[int, str], ...]
    step: Fraction | None
    step_text: str
    unit: str
    factor: Fraction | None
    explicit: bool
    range_text: str
    open_formula: str = ""
    doubtful_step: bool = False
    unknown_unit: str = ""


def take_apart(cells: dict[str, str], unit_beside: str) -> Said:
    """The cells about the meaning of raw numbers, by role."""
    told = one_line(without_labels(cells.get("range", "")))
    raws, explicit = numbers.spans(told), False
    values = numbers.spans(without_labels(cells.get("description", "")))
    if len(raws) > 1 and _SAME_AS.search(told[told.find(raws[0].text) + len(raws[0].text) :]):
        values, raws, explicit = raws[1:], raws[:1], True
    if not told and cells.get("least") and cells.get("greatest"):
        raws = numbers.spans(f"{cells['least']} .. {cells['greatest']}")
    listed = numbers.listed(told)
    step, text, unit, doubtful, unknown = _step_of(cells.get("step", ""), cells.get("unit", ""))
    factor, open_formula = _factor_of(cells.get("formula", ""))
    moving = numbers.moving(told) if not raws or raws[0].text not in told[:20] else None
    whole = one_line(cells.get("range", "")) if raws or moving else ""
    named = tuple((int(number), label.strip()) for number, label in _NAMED.findall(whole))
    return Said(
        *(tuple(raws), tuple(values), None if listed is None else tuple(listed), moving, named, step, text),
        *(unit or numbers.unit_of(unit_beside), factor, explicit, told, open_formula, doubtful, unknown),
    )


def _step_of(step: str, unit: str) -> tuple[Fraction | None, str, str, bool, str]:
    """The step, its text, the unit, whether the step is doubtful, and what is no unit: `0,1 Hz`, `1/100 Hz`, `Hz`."""
    found, text, symbol, doubtful, unknown = None, "", "", False, ""
    for cell in (step, unit):
        plain = one_line(cell).strip()
        parted, alone = _FRACTION.fullmatch(plain), numbers.alone(plain)
        said = parted[2] if parted else alone[2] if alone else plain
        named = numbers.unit_of(said)
        unknown = unknown if named or not any(char.isalpha() for char in said) else said
        if parted:
            found = Fraction(1, int(parted[1]))
            text = numbers.decimal(found)
        elif alone and found is None:
            found, text = alone[0], alone[1].replace(",", ".")
        elif named and cell is step:
            found, text = Fraction(1), "1"
        symbol = symbol or named
    if found == 0:
        found, doubtful = Fraction(1, 10 ** len(text.partition(".")[2])), True
    return found, text, symbol, doubtful, unknown


def _factor_of(formula: str) -> tuple[Fraction | None, str]:
    """What one raw step is worth by a formula that says `raw = value * number`; else the formula itself, if any."""
    plain = one_line(formula)[:_LONGEST_FORMULA].strip()
    if "=" not in plain:
        return None, ""
    found = _FORMULA.fullmatch(plain)
    if found is None:
        return None, plain
    product = Fraction(1)
    for factor in re.finditer(_FACTOR, found["factors"]):
        product *= numbers.number_of(factor[1] or factor[2]) if factor[1] or factor[2] else 1
    return (1 / product, "") if product else (None, plain)
