"""What raw numbers mean: range, scale and unit of a row, from everything that its cells say of them.

Manuals print a range as raw numbers, in the unit, or both; and a step. What agrees is taken. Where two things disagree,
or nothing says which of two readings is meant, the fact is left out and a question says why.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables import numbers
from fieldscribe.audit.editions.tables.cell_text import one_line

if TYPE_CHECKING:
    from fieldscribe.audit.editions.tables.numbers import Span
    from fieldscribe.audit.editions.tables.said import Said

_NEAR = Fraction(1, 100)


@dataclass(slots=True)
class Meaning:
    """What was taken, as YAML, and what stays open. `printed` holds what the manual says twice."""

    range: str | None = None
    range_in_units: str | None = None
    scale: str | None = None
    unit: str = ""
    signed: bool = False
    highest: int = 0
    printed: dict[str, str] = field(default_factory=dict)
    special: dict[int, str] = field(default_factory=dict)
    misprints: dict[str, tuple[str, str]] = field(default_factory=dict)
    questions: list[str] = field(default_factory=list)
    follows: str = ""
    """Why there is a scale although none is printed."""


def evidence(said: Said) -> str | None:
    """Whether a row shows that its range column holds raw numbers, or values in the unit."""
    if said.explicit:
        return "raw"
    if any(span.decimals or span.unit for span in said.raws):
        return "units"
    if said.step is not None and said.step != 1 and said.raws:
        factors = [_factor(said.raws[0], span) for span in said.values]
        return "raw" if any(factor is not None and _near(factor, said.step) for factor in factors) else None
    return None


def meaning_of(said: Said, column: str | None) -> Meaning:
    """Range, scale and unit of a row. `column` says what other rows show of its range column."""
    meaning = Meaning(unit=said.unit)
    if said.unknown_unit:
        meaning.questions.append(f"is `{said.unknown_unit[:40]}` a unit? It is none of those that need no declaration")
    step = _settle_step(said, meaning)
    _settle_range(said, step, column, meaning)
    if step not in (None, 1) and meaning.scale is None:
        meaning.scale = _as_scale(step) if isinstance(step, Fraction) else None
    if said.open_formula:
        meaning.scale = "~"
        meaning.questions.append(f"the formula reads: {said.open_formula[:160]}")
    return meaning


def _settle_step(said: Said, meaning: Meaning) -> Fraction | None:
    """What one raw step is worth: what step, formula and pairs of ranges agree on."""
    told = said.step if said.step is not None else said.factor
    if said.step is not None and not said.doubtful_step and not (told is not None and told > 1):
        meaning.printed["resolution"] = f"{said.step_text} {said.unit}".strip()
    shown = [(factor, span) for span in said.values for factor in (_shown_factor(said, span),) if factor is not None]
    agreeing = [(factor, span) for factor, span in shown if told is not None and _near(factor, told)]
    if agreeing:
        _take_span(agreeing[-1][1], told, said, meaning)
        return told
    if not shown:
        return _unproven(told, said, meaning)
    factor, span = shown[-1]
    exact = _is_exact(said.raws[0], span, factor)
    if told is None:
        if exact and _is_nice(factor):
            if not said.explicit and factor != 1:
                meaning.questions.append(f"the scale follows from {said.raws[0].text} and {span.text}; is it meant?")
                meaning.follows = f"{said.raws[0].text} is also printed as {span.text}."
            _take_span(span, factor, said, meaning)
            return factor
        return None
    return _disagreeing(told, factor, span, said, meaning)


def _disagreeing(told: Fraction, factor: Fraction, span: Span, said: Said, meaning: Meaning) -> Fraction | None:
    """The step and the pair of ranges say different things: two ends that fit outweigh one number."""
    step = numbers.decimal(told) if numbers.is_decimal(told) else told
    words = f"the step {step} and {said.raws[0].text} for {span.text} disagree"
    if said.step is not None and said.raws[0].low and _is_exact(said.raws[0], span, factor) and _is_power(factor):
        meaning.questions.append(f"{words}; the scale follows from the ranges")
        printed = meaning.printed.get("resolution")
        if printed is not None:
            meaning.misprints["resolution"] = (printed, f"{numbers.decimal(factor)} {said.unit}".strip())
        _take_span(span, factor, said, meaning)
        return factor
    if _is_power(_nearest_power(factor)) and not _near(factor, told) and _near(_nearest_power(factor), factor):
        meaning.scale = "~"
        meaning.questions.append(words)
        meaning.printed.pop("resolution", None)
        return None
    return told


def _unproven(told: Fraction | None, said: Said, meaning: Meaning) -> Fraction | None:
    if told is not None and told > 1 and said.step is not None:
        meaning.scale = "~"
        meaning.printed.pop("resolution", None)
        meaning.questions.append(
            f"is a value {said.step_text} times the raw number, or the raw number that of the value?"
        )
        return None
    if said.doubtful_step:
        meaning.questions.append(f"the step is printed as {said.step_text}: is it one of the last digit?")
    return told


def _take_span(span: Span, factor: Fraction | None, said: Said, meaning: Meaning) -> None:
    """The range in the unit that goes with the raw one: its unit, and the range itself where it agrees to the digit."""
    if span.unit and not meaning.unit:
        meaning.unit = span.unit
    elif span.unit and span.unit != meaning.unit:
        _other_unit(span, meaning)
    if factor is not None and said.raws[0].low * factor == span.low and said.raws[0].high * factor == span.high:
        meaning.printed["range_in_units"] = span.as_yaml
    elif factor is not None and abs(said.raws[0].high * factor - span.high) > factor:
        meaning.questions.append(f"the range is also printed as {span.text}, which is not the same")


def _other_unit(span: Span, meaning: Meaning) -> None:
    from fieldscribe.language.units import factor_between, shipped_unit

    own = shipped_unit(meaning.unit)
    if own is None or factor_between(span.unit, own) in (None, 1):
        return
    meaning.questions.append(f"the unit is printed as {meaning.unit} and, with the range, as {span.unit}")
    printed = meaning.printed.get("resolution")
    if printed is not None:
        meaning.misprints["resolution"] = (printed, f"{printed.split()[0]} {span.unit}")
    meaning.unit = span.unit


def _settle_range(said: Said, step: Fraction | None, column: str | None, meaning: Meaning) -> None:
    if said.listed is not None:
        meaning.range = ", ".join(map(str, said.listed))
        meaning.signed, meaning.highest = min(said.listed) < 0, max(said.listed)
    elif said.moving is not None:
        meaning.range = " .. ".join(said.moving)
        _add_named(said, meaning)
    elif said.raws:
        _from_spans(said, step, column, meaning)
    elif re.search(r"\d", said.range_text) and not re.fullmatch(r"[^\d]{0,2}\d+[^\w-]?\w{0,4}", said.range_text):
        meaning.questions.append(f"which range is meant by: {said.range_text[:120]}")


def _from_spans(said: Said, step: Fraction | None, column: str | None, meaning: Meaning) -> None:
    first = said.raws[0]
    if len(said.raws) > 1 and any(first.low <= span.low and span.high <= first.high for span in said.raws[1:]):
        meaning.questions.append(f"the first range was taken of: {said.range_text[:120]}")
        said = replace(said, raws=said.raws[:1])
    joined = " | ".join(span.as_yaml for span in said.raws)
    whole = one_line(said.range_text)
    rest = whole.replace(first.text, "", 1)
    if re.search(r"[A-Za-z]{3,}\.?\s*[A-Za-z]*$", rest) and not said.explicit and re.search(r"\d\s*-\s*[a-z]", whole):
        meaning.questions.append(f"which range is meant by: {whole[:120]}")
        return
    in_units = any(span.decimals or span.unit for span in said.raws) and not said.explicit
    if len(said.raws) > 1:
        meaning.questions.append(f"{len(said.raws)} ranges are printed: {whole[:120]}; for which variant is each?")
    if in_units:
        meaning.range_in_units = joined
        meaning.unit = meaning.unit or next((span.unit for span in said.raws if span.unit), "")
        meaning.signed = first.low < 0
        if step is None and any(span.decimals for span in said.raws):
            meaning.scale = "~"
            meaning.questions.append("what is one raw step worth? The range has decimals, and no step is printed")
        return
    if step not in (None, 1) and column != "raw" and not meaning.printed.get("range_in_units") and not said.explicit:
        agreeing = meaning.scale is None and any(_shown_factor(said, span) for span in said.values)
        if not agreeing:
            meaning.questions.append(f"is the range {joined} raw, or in the unit?")
            return
    meaning.range = joined
    meaning.signed, meaning.highest = first.low < 0, int(max(span.high for span in said.raws))
    _add_named(said, meaning)


def _add_named(said: Said, meaning: Meaning) -> None:
    """Numbers that the range cell names beside the range, such as `0=inactive`."""
    for number, label in said.named:
        meaning.questions.append(f"{number} is printed as `{label[:40]}`: a special code that may be written?")
        meaning.special[number] = label
        if meaning.range and (said.moving or not any(span.low <= number <= span.high for span in said.raws)):
            meaning.range = f"{number} | {meaning.range}"


def _shown_factor(said: Said, span: Span) -> Fraction | None:
    return _factor(said.raws[0], span) if said.raws else None


def _factor(raw: Span, value: Span) -> Fraction | None:
    """What one raw step is worth if both ranges are the same; None if no factor fits both ends."""
    if not raw.high or not value.high or (raw.high < 0) != (value.high < 0) or raw is value:
        return None
    factor = value.high / raw.high
    return factor if abs(raw.low * factor - value.low) <= max(factor, abs(value.low) * _NEAR * 5) else None


def _is_exact(raw: Span, value: Span, factor: Fraction) -> bool:
    return abs(raw.low * factor - value.low) <= factor / 2 and raw.high * factor == value.high


def _is_nice(factor: Fraction) -> bool:
    return (
        _is_power(factor) or factor.numerator == 1 or (numbers.is_decimal(factor) and len(numbers.decimal(factor)) < 6)
    )


def _is_power(factor: Fraction) -> bool:
    return factor > 0 and any(factor == Fraction(10) ** power for power in range(-6, 7))


def _nearest_power(factor: Fraction) -> Fraction:
    return min((Fraction(10) ** power for power in range(-6, 7)), key=lambda power: abs(power - factor))


def _near(one: Fraction, other: Fraction) -> bool:
    return abs(one - other) <= other * _NEAR


def _as_scale(step: Fraction) -> str:
    if numbers.is_decimal(step) and len(numbers.decimal(step)) <= 8:
        return f"value = raw * {numbers.decimal(step)}"
    if step.numerator == 1:
        return f"raw = value * {step.denominator}"
    return f"value = raw * {step.numerator} / {step.denominator}"
