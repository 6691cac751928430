"""The result of decoding a point: its type, its form in the runtime, and rules that need the values of other points."""

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from itertools import groupby, takewhile

from fieldscribe.arithmetic.exact import count_line
from fieldscribe.arithmetic.words import fits, mask_of
from fieldscribe.grouping import grouped
from fieldscribe.lowered import Lowered, Operand, Rule
from fieldscribe.model import Limit, Linear, Point, ScaleCase, Text
from fieldscribe.resources import Render
from fieldscribe.targets.rust.enums import old_names_text
from fieldscribe.targets.rust.layout import Lines, chained, fields_of, filled, wrapped
from fieldscribe.targets.rust.literals import integer, raw_type, type_range, value_name
from fieldscribe.targets.rust.scope import CratePoint, CrateScope
from fieldscribe.text import rust_string

_COUNTS = {"i32": "i64", "u32": "i64", "i64": "i64", "u64": "i128"}
"""The count types of points whose raw number is the value, wider than the raw type; `i32` for all others."""


def form_lines(subject: CratePoint, enum: str, scope: CrateScope) -> tuple[str, ...]:
    """Return the fact about the result of decoding."""
    kind = "reading" if subject.point.specials else "value"
    if subject.point.form == "scaled" and subject.point.fixed_scale is None:
        return _ruled(subject, scope, kind)
    form, facts = _form(subject)
    kind += "_or_error" if form in ("wide", "unicode", "dated") else ""
    return (f"=> {kind} {_value_type(subject, enum)} as {form}({facts});",)


def _value_type(subject: CratePoint, enum: str) -> str:
    """Return the type of a value that is not a special code."""
    if subject.point.form in ("scaled", "float"):
        return "f64"
    if subject.point.text is not None:
        return _text_type(subject.point.text)
    if enum and subject.point.digits is not None:
        return f"[enums::{enum}; {subject.point.digits.count}]"
    if enum:
        return f"enums::{enum}"
    return f"flags::{subject.name}" if subject.point.form == "flags" else subject.raw


def count_type(subject: CratePoint) -> str:
    """Return the integer that holds the counts of a point; empty if it has none."""
    point = subject.point
    if point.form in ("float", "text", "digits"):
        return ""
    if point.form != "scaled":
        return _COUNTS.get(subject.raw, "i32")
    if point.decimals is None:
        return ""
    return "i64" if point.fixed_scale is None else f"i{min(64, _width(point.fixed_scale, point.decimals, subject.raw))}"


def _form(subject: CratePoint) -> tuple[str, str]:
    """Return the form of a point whose scale, if any, depends on no other point, with the facts of the form."""
    point = subject.point
    if point.fixed_scale is not None:
        numbers = [point.fixed_scale.ratio, *([point.fixed_scale.offset] if point.fixed_scale.offset else ())]
        facts = ", ".join(f"{integer(number.numerator)}, {integer(number.denominator)}" for number in numbers)
        wide = point.decimals is not None and _width(point.fixed_scale, point.decimals, subject.raw) > 64
        return "wide" if wide else "scaled", facts
    if point.form == "digits" and subject.enum is not None:
        numbers_of = sorted({entry.raw for entry in subject.enum.entries if 0 <= entry.raw <= 0xFFFF})
        return "digits", f"{subject.carried}, [{', '.join(map(integer, numbers_of))}]"
    if subject.enum is not None:
        return "named", subject.carried
    if point.text is not None:
        return _form_of_text(point.text)
    return {"float": "floating", "text": "text", "flags": "flags"}.get(point.form, "plain"), ""


def _date_form(text: Text) -> str:
    """Return the parts of a date and time: word, lowest bit, mask, and what a 0 means."""
    parts = [
        f"{part.name.capitalize()} {part.word} {part.bits[1]} 0x{mask_of(part.width):04X} {part.base}"
        for part in text.parts
    ]
    flags = ("true" if flag else "false" for flag in (text.bcd, text.low_first))
    return f"{', '.join(flags)}, [{', '.join(parts)}]"


def _form_of_text(text: Text) -> tuple[str, str]:
    if text.parts:
        return "dated", _date_form(text)
    if text.is_unicode:
        return "unicode", f"{16 if text.encoding == 'utf-16' else 8}, {_layout(text)}"
    return ("packed", _layout(text)) if text.is_bytes or not text.is_plain else ("text", "")


def _text_type(text: Text) -> str:
    if text.parts:
        return "runtime::DateTime"
    if text.is_bytes:
        return f"[u8; {text.characters}]"
    return f"runtime::{'Utf8' if text.is_unicode else 'Text'}<{text.most_bytes}>"


def _layout(text: Text) -> str:
    """Return the layout of a text whose words are not plain."""
    padding, low_first = f"0x{text.padding:02X}", "true" if text.low_first else "false"
    return f"{text.characters}, {text.per_word}, {padding}, {low_first}"


def _ruled(subject: CratePoint, scope: CrateScope, kind: str) -> tuple[str, ...]:
    """Return the form of a scale that depends on other points: its rule, and the raw numbers that it accepts."""
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
    """Return the bits of the narrowest of `i32`, `i64`, `i128` that holds all integers of decoding into counts.

    The integers are linear in the raw number, so they are largest at the ends of its type. The runtime rounds the
    quotient and proves the widths of its own steps (`path.rs`).
    """
    line = count_line(rule, decimals).inverse
    numbers = (*line, *line.meets(type_range(raw)))
    return next((bits for bits in (32, 64) if fits(numbers, bits)), 128)


def rule_lines(point: Point, lowered: Lowered) -> Lines:
    """Return the lines that choose the case: in order, up to one without a condition."""
    scale = point.scale or ()
    always = next((case.rule for case in scale if case.point is None), None)
    otherwise = ("Err(runtime::Error::NoCase(None))",) if always is None else rule_of(lowered.rule(always))
    chosen = takewhile(lambda case: case.point is not None, scale)
    groups = groupby(chosen, key=lambda case: (case.point or "", rule_of(lowered.rule(case.rule))))
    arms = [line for (name, result), cases in groups for line in _arm(name, cases, result)]
    return ("match () {", *arms, f"    () => {'?'.join(otherwise)},", "}") if arms else chained(otherwise)


def _arm(name: str, cases: Iterable[ScaleCase], result: Lines) -> Iterator[str]:
    """Yield an arm for the raw numbers of cases with the same result."""
    codes = [integer(case.raw or 0) for case in cases]
    head = filled(f"() if matches!(runtime::Raw::to_i64({_raw_of(name)}), ", " | ", codes, ") => {")
    yield from (f"    {line}" for line in head)
    yield from (f"        {line}" for line in chained(result))
    yield "    }"


def rule_of(rule: Rule) -> Lines:
    """Return the lines that compute a scale with its factors; special codes of factors are refused first."""
    codes = [code for operand in rule.steps for code in _codes(operand)]
    steps = [f".unless({' || '.join(codes)})"] if codes else []
    for operand in rule.steps:
        steps.append(_step(operand, limit=False))
        if operand.within is not None and not operand.factor.ten_to:
            name, (low, high) = operand.factor.point, operand.within
            steps.append(f".within({rust_string(name)}, {_raw_of(name)}, {integer(low)}, {integer(high)})")
    return (f"{_start(rule)}{steps[0]}", *steps[1:]) if steps else (f"Ok({_start(rule)})",)


def limit_lines(limit: Limit, lowered: Lowered, *, lower: bool) -> Lines:
    """Return the lines that compute a limit within its outermost bound; just the bound if a code lifts the limit."""
    rule = lowered.rule(limit.rule)
    factors = (_step(operand, limit=True) for operand in rule.steps)
    bound = integer(limit.outermost(low=lower))
    first, *steps = (*factors, ".limit()", f".{'max' if lower else 'min'}({bound})")
    terms = (f"{_start(rule)}{first}", *steps)
    aside = [
        f"matches!(runtime::Raw::to_i64({_raw_of(name)}), {' | '.join(interval(*band) for band in codes)})"
        for name, codes in limit.unless
        if codes
    ]
    if not aside:
        return chained(terms)
    head = filled("if ", " || ", aside, " {")
    return *head, f"    {bound}", "} else {", *(f"    {line}" for line in chained(terms)), "}"


def interval(low: int, high: int) -> str:
    """Return a pattern for the numbers from `low` to `high`."""
    return integer(low) if low == high else f"{integer(low)}..={integer(high)}"


def _start(rule: Rule) -> str:
    ratio, offset = rule.ratio, rule.offset
    start = f"runtime::Rule::new({integer(ratio.numerator)}, {integer(ratio.denominator)})"
    return f"{start}.plus({integer(offset.numerator)}, {integer(offset.denominator)})" if offset else start


def _codes(operand: Operand) -> Iterator[str]:
    """Yield the condition that the factor's point holds a special code."""
    if operand.codes:
        bands = (interval(*band) for band in sorted(operand.codes))
        yield f"matches!({_raw_of(operand.factor.point)}, {' | '.join(bands)})"


def _step(operand: Operand, *, limit: bool) -> str:
    """Return the call that puts a factor into a rule."""
    factor = operand.factor
    raw, times = _raw_of(factor.point), "limited_by" if limit and not factor.ten_to else "times"
    if operand.floating:
        return f".{'over' if operand.over else times}_f32({raw})"
    if factor.ten_to and operand.within is not None:
        low, high = operand.within
        raw = f"runtime::arithmetic::exponent({rust_string(factor.point)}, {raw}, {integer(low)}, {integer(high)})?"
    if (factor.slope, factor.intercept) != (1, 0):
        raw = f"runtime::arithmetic::line({raw}, {integer(factor.slope)}, {integer(factor.intercept)})?"
    return f".{'over' if operand.over else times}{'_ten_to' if factor.ten_to else ''}({raw})"


def _raw_of(name: str) -> str:
    return f"with.{value_name(name)}"


def argument_structs(scope: CrateScope, render: Render) -> Iterator[dict[str, object]]:
    """Yield the structs of raw numbers that points need, as the template sees them.

    `part` is the struct of those that the scale needs, if writing needs more. `old_names` is the text of old names.
    """
    needy = [subject for subject in scope.subjects if subject.point.arguments]
    points = _points(scope) if needy else {}
    for subject in needy:
        old_items, part = subject.point.old_items, subject.factors_name
        if part:
            yield {
                "doc": f"Raw numbers that the scale of `{subject.item}` needs.",
                "name": part,
                "fields": _fields(subject.point.scale_arguments, scope, points),
                **_sources(subject.point.scale_arguments, points),
                "part": "",
                "old_names": old_names_text(part, [f"{old}_factors" for old in old_items], render),
            }
        yield {
            "doc": f"Raw numbers that `{subject.item}` needs.",
            "name": subject.name,
            "fields": _fields(subject.point.arguments, scope, points),
            **_sources(subject.point.arguments, points),
            "part": part,
            "part_literal": fields_of(8, "Self", tuple(map(value_name, subject.point.scale_arguments))),
            "old_names": old_names_text(subject.name, old_items, render),
        }


def _fields(
    names: tuple[str, ...], scope: CrateScope, points: Mapping[str, list[CratePoint]]
) -> tuple[tuple[tuple[str, ...], str, str], ...]:
    return tuple(
        (tuple(wrapped(_source(name, points))), value_name(name), raw_type(scope.lowered.points[name].shape))
        for name in names
    )


def _source(name: str, points: Mapping[str, list[CratePoint]]) -> str:
    """Return the points that give an argument: several if variants of the device differ."""
    links = [f"[`{subject.name}`](crate::points::{subject.name})" for subject in points.get(name, ())]
    return f"The raw number of {' or '.join(links) or f'`{name}`'}."


def _sources(names: tuple[str, ...], points: Mapping[str, list[CratePoint]]) -> dict[str, object]:
    """Return the fields with their points, if each has one point, and True if a client reads all of them."""
    sources = {name: points.get(name, []) for name in names}
    if any(len(found) != 1 or not found[0].point.readable for found in sources.values()):
        return {"sources": (), "read": False}
    pairs = tuple((value_name(name), found[0].name) for name, found in sources.items())
    return {"sources": pairs, "read": not any(found[0].point.telegram for found in sources.values())}


def _points(scope: CrateScope) -> dict[str, list[CratePoint]]:
    """Return the points of each name and item."""
    return grouped((name, subject) for subject in scope.subjects for name in {subject.item, subject.point.name})
