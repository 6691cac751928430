"""What the manual prints redundantly about a point agrees with the facts taken, or an erratum says why not."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from fieldscribe import wording
from fieldscribe.checks.subject import Subject, same
from fieldscribe.diagnostics import Span
from fieldscribe.exact import number_text
from fieldscribe.language.formula import FormulaError, evaluate, parse_expression
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import NumberError, parse_number
from fieldscribe.model import Allowed, Point
from fieldscribe.resolve.allowed import as_text
from fieldscribe.resolve.points import Resolved

_LOW = "low_"


def check(subject: Subject) -> None:
    """Printed numbers, ranges, resolutions and counts that disagree with the point."""
    for resolved in subject.resolved:
        layer = resolved.draft.layer("printed")
        if layer is not None:
            _printed(subject, resolved, layer["printed"])


def _printed(subject: Subject, resolved: Resolved, printed: Map) -> None:
    numbers: Mapping[str, Fraction] | None = None
    scaled = resolved.draft.layer("scale") is None or resolved.draft.get("scale") is not None
    for key, value in printed.items():
        span = printed.span(key)
        if key in ("range_in_units", "resolution") and not scaled:
            continue  # nothing to hold it against where the scale is unknown
        if key == "range":
            _range(subject, resolved, value, span, in_units=False)
        elif key == "range_in_units":
            _range(subject, resolved, value, span, in_units=True)
        elif key == "resolution":
            _resolution(subject, resolved, value, span)
        elif key == "choices":
            _choices(subject, resolved, value, span)
        else:
            numbers = _numbers(resolved) if numbers is None else numbers
            _number(subject, resolved, key, value, printed, numbers)


def _numbers(resolved: Resolved) -> Mapping[str, Fraction]:
    """The point's number in every numbering of its group, and for a pair that of the word with the low part."""
    addresses = resolved.point.addresses
    numbering = resolved.draft.group.get("numbering", {})
    known: dict[str, Fraction] = {}
    for prefix, address in (("", addresses[:1]), (_LOW, addresses[1:][-1:])):
        if not address:
            continue
        own = {"wire": Fraction(address[0])}
        for name, text in numbering.items():
            try:
                own[name] = evaluate(parse_expression(text), own)
            except FormulaError:
                continue  # reported where the numbering stands
        known.update({prefix + name: number for name, number in own.items()})
    return known


def _number(
    subject: Subject, resolved: Resolved, key: str, value: Any, printed: Map, numbers: Mapping[str, Fraction]
) -> None:
    right = numbers.get(key)
    point = resolved.point
    if right is None:
        if not point.addresses:
            return
        hint = "the keys are wire, what `numbering` names, low_ before them, range, range_in_units, resolution, choices"
        subject.report.error("unknown-key", f"`{key}` names no numbering of this point", printed.key_span(key), hint)
        return
    for one, span in _each(value, printed.span(key)):
        try:
            given = parse_number(str(one))
        except NumberError as error:
            subject.report.error("bad-number", error.message, span, error.hint)
            continue
        if given != right:
            message = f"{key.replace('_', ' ')} {one} is printed for `{point.name}`, the address says {right} ({int(right):04X}h)"
            subject.disagrees(point.name, key, one, int(right), span, message)


def _each(value: Any, span: Span) -> Iterator[tuple[Any, Span]]:
    if isinstance(value, Seq):
        for index, one in enumerate(value):
            yield one, value.span(index)
    else:
        yield value, span


def _range(subject: Subject, resolved: Resolved, value: Any, span: Span, *, in_units: bool) -> None:
    key = "range_in_units" if in_units else "range"
    point, draft = resolved.point, resolved.draft
    if point.info.floating:
        return
    before = len(subject.report.findings)
    printed = subject.ranges.intervals(draft, value, span, in_units)
    if printed is None or len(subject.report.findings) > before:
        return
    if _same_range(point.allowed, printed):
        return
    taken = wording.range_text(point) if in_units else wording.raw_range_text(point)
    message = f"the {key.replace('_', ' ')} {as_text(value)} is printed for `{point.name}`, taken is {taken}"

    def right(said: Any) -> bool:
        found = subject.ranges.intervals(draft, said, span, in_units)
        return found is not None and _same_range(point.allowed, found)

    subject.disagrees(point.name, key, value, taken, span, message, right)


def _same_range(taken: Allowed, printed: Allowed) -> bool:
    fixed = [one for one in taken.intervals if isinstance(one.low, int) and isinstance(one.high, int)]
    printed_fixed = [one for one in printed.intervals if isinstance(one.low, int) and isinstance(one.high, int)]
    moving = [one for one in taken.intervals if one not in fixed]
    printed_moving = [one for one in printed.intervals if one not in printed_fixed]
    return moving == printed_moving and (fixed == printed_fixed or bool(moving) and not printed_fixed)


def _resolution(subject: Subject, resolved: Resolved, value: Any, span: Span) -> None:
    point = resolved.point
    number, _, unit = str(value).strip().partition(" ")
    step = _step(point)
    try:
        given = parse_number(number)
    except NumberError as error:
        subject.report.error("bad-number", error.message, span, error.hint)
        return
    if step is None:
        return
    right = f"{number_text(step)} {point.unit.symbol}".strip()
    if given != step or (unit.strip() and not same(unit, point.unit.symbol)):
        message = f"the resolution {value} is printed for `{point.name}`, the scale says {right}"
        subject.disagrees(point.name, "resolution", value, right, span, message)


def _step(point: Point) -> Fraction | None:
    if point.info.floating:
        return None
    if point.scale is None:
        return Fraction(1)
    if len(point.scale) > 1 or point.scale[0].rule.factors:
        return None
    return abs(1 / point.scale[0].rule.ratio)


def _choices(subject: Subject, resolved: Resolved, value: int, span: Span) -> None:
    point = resolved.point
    listed = [one for one in point.allowed.intervals if one.low == one.high] if point.allowed.listed else []
    right = len(point.enum.entries) if point.enum is not None else len(listed)
    if value != right:
        message = f"{value} choices are printed for `{point.name}`, taken are {right}"
        subject.disagrees(point.name, "choices", value, right, span, message)
