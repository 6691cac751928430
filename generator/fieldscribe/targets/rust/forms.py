"""The result of decoding a point: its type, its form in the runtime, and the facts of that form."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.lines import count_line
from fieldscribe.arithmetic.words import fits
from fieldscribe.targets.rust.literals import integer, type_range
from fieldscribe.targets.rust.rules import rule_lines

if TYPE_CHECKING:
    from fieldscribe.model import Linear
    from fieldscribe.targets.rust.identity import Words
    from fieldscribe.targets.rust.subjects import CratePoint, CrateScope

_COUNTS = {"i32": "i64", "u32": "i64", "i64": "i64", "u64": "i128"}
"""The count types of points whose raw number is the value, wider than the raw type; `i32` for all others."""


def form_lines(subject: CratePoint, words: Words, scope: CrateScope) -> tuple[str, ...]:
    """The fact about the result of decoding."""
    kind = "reading" if subject.point.specials else "value"
    if subject.form == "scaled" and subject.shape.rule is None:
        return _ruled(subject, scope, kind)
    form, facts = _form(subject)
    kind += "_or_error" if form == "wide" else ""
    return (f"=> {kind} {_value_type(subject, words)} as {form}({facts});",)


def _value_type(subject: CratePoint, words: Words) -> str:
    """The type of a value that is no special code."""
    if subject.form in ("scaled", "float"):
        return "f64"
    if subject.point.text is not None:
        return f"runtime::Text<{subject.point.text.characters}>"
    if words.enum and subject.point.digits is not None:
        return f"[enums::{words.enum}; {subject.point.digits.count}]"
    if words.enum:
        return f"enums::{words.enum}"
    return f"flags::{subject.name}" if subject.form == "flags" else subject.raw


def count_type(subject: CratePoint) -> str:
    """The integer that holds the counts of a point; empty if it has none."""
    point = subject.point
    if subject.form in ("float", "text", "digits"):
        return ""
    if subject.form != "scaled":
        return _COUNTS.get(subject.raw, "i32")
    if point.decimals is None:
        return ""
    return (
        "i64" if subject.shape.rule is None else f"i{min(64, _width(subject.shape.rule, point.decimals, subject.raw))}"
    )


def _form(subject: CratePoint) -> tuple[str, str]:
    """The form of a point whose scale, if any, depends on no other point, with the facts of the form."""
    point = subject.point
    if subject.shape.rule is not None:
        numbers = [subject.shape.rule.ratio, *([subject.shape.rule.offset] if subject.shape.rule.offset else ())]
        facts = ", ".join(f"{integer(number.numerator)}, {integer(number.denominator)}" for number in numbers)
        wide = point.decimals is not None and _width(subject.shape.rule, point.decimals, subject.raw) > 64
        return "wide" if wide else "scaled", facts
    if subject.form == "digits" and subject.shape.enum is not None:
        numbers_of = sorted({entry.raw for entry in subject.shape.enum.entries if 0 <= entry.raw <= 0xFFFF})
        return "digits", f"{subject.shape.carried}, [{', '.join(map(integer, numbers_of))}]"
    if subject.shape.enum is not None:
        return "named", subject.shape.carried
    return {"float": "floating", "text": "text", "flags": "flags"}.get(subject.form, "plain"), ""


def _ruled(subject: CratePoint, scope: CrateScope, kind: str) -> tuple[str, ...]:
    """The form of a scale that depends on other points: its rule, and the raw numbers that it can compute with."""
    point = subject.point
    head = f"=> {kind}_or_error f64 as ruled(|with: {subject.factors_type}|"
    wide = "" if point.encodes_values else "; wide true"
    within = ""
    if point.most_raw is not None:
        low = integer(-point.most_raw) if point.info.signed else "0"
        within = f"; within [{low}..={integer(point.most_raw)}]"
    lines = rule_lines(point, scope.lowered)
    if len(lines) == 1:
        return head, f"    {lines[0]}{wide}{within});"
    return head, *(f"    {line}" for line in lines[:-1]), f"    {lines[-1]}{wide}{within});"


@lru_cache(maxsize=4096)
def _width(rule: Linear, decimals: int, raw: str) -> int:
    """The bits of the narrowest of `i32`, `i64`, `i128` that holds all integers of decoding into counts.

    They are linear in the raw number, so that they are largest at the ends of its type. The runtime rounds the quotient
    and proves the widths of its own steps (`path.rs`).
    """
    line = count_line(rule, decimals).inverse
    numbers = (*line, *line.meets(type_range(raw)))
    return next((bits for bits in (32, 64) if fits(numbers, bits)), 128)
