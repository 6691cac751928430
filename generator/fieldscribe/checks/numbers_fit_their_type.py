"""The numbers of a point fit its type: every entry of an enum can occur, steps lie in the type, computed limits too.

An entry lies in the range and the type, and it is not a special code. A limit from other points is a signed 64-bit
number, the widest with which generated code computes.
"""

from fieldscribe.arithmetic.words import INT64
from fieldscribe.diagnostics import Span
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import integer_in
from fieldscribe.model import Limit, Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.points import ResolvedPoint

_UNKNOWN = {"type", "bits"}
"""Keys without which the numbers of a point are unknown."""


def check(analysis: Analysis) -> None:
    """Report entries, steps and computed limits that do not fit, and entries that are special codes too."""
    for resolved in analysis.resolved:
        if resolved.point.allowed.moves:
            _limits(analysis, resolved)
        if not resolved.facts.failed.isdisjoint(_UNKNOWN):
            continue
        shape = resolved.point.shape
        if shape.enum is not None:
            _entries(analysis, resolved)
        if shape.specials:
            _specials(analysis, resolved)
        for start, _ in resolved.point.terms.steps:
            if not resolved.point.least <= start <= resolved.point.greatest:
                message = f"steps from {start} on lie outside the type, which holds {_held(resolved.point)}"
                hint = "steps are counted in raw numbers"
                analysis.report.error("range-outside-type", message, resolved.facts.span("steps"), hint)


def _limits(analysis: Analysis, resolved: ResolvedPoint) -> None:
    """Report computed limits that may be too great."""
    ends = (end for interval in resolved.point.allowed.intervals for end in (interval.low, interval.high))
    if any(isinstance(end, Limit) and end.greatest > INT64[1] for end in ends):
        key = "range" if resolved.facts.get("range") is not None else "range_in_units"
        message = f"the limit of `{resolved.point.name}` may exceed {INT64[1]}, which no generated code computes"
        hint = "give the points that it follows from a narrower type or range, or use `s64`"
        analysis.report.error("range-outside-type", message, resolved.facts.span(key), hint)


def _held(point: Point) -> str:
    return f"{point.least}..{point.greatest}"


def _specials(analysis: Analysis, resolved: ResolvedPoint) -> None:
    """Report numbers that are an entry of the enum and also a special code."""
    point, facts = resolved.point, resolved.facts
    for entry in point.enum.entries if point.enum is not None else ():
        special = point.special(entry.raw)
        if special is not None:
            place = facts.span("special") if facts.layer("special") is not None else None
            related = [(place, "the special codes")] if place is not None else []
            message = f"{entry.raw} is `{entry.name}` of the enum and the special code `{special.name}`"
            hint = "remove one of them; `special: {code: ~}` removes an inherited code"
            analysis.report.error("special-twice", message, _place(resolved, entry.raw), hint, related)


def _entries(analysis: Analysis, resolved: ResolvedPoint) -> None:
    point, facts = resolved.point, resolved.facts
    least, greatest = point.least, point.greatest
    ranged = facts.layer("range") is not None and "range" not in facts.failed
    for entry in point.enum.entries if point.enum is not None else ():
        if not least <= entry.raw <= greatest:
            message = f"`{entry.name}` is {entry.raw}, outside the type, which holds {_held(point)}"
            hint = "correct the number or the `type`"
            analysis.report.error("enum-outside-range", message, _place(resolved, entry.raw), hint)
        elif ranged and not point.allowed.holds(entry.raw) and point.special(entry.raw) is None:
            related = [(facts.span("range"), "the range")]
            message = f"`{entry.name}` is {entry.raw}, which the range does not allow"
            hint = "correct the number or the range; a code beside the numbers goes under `special`"
            analysis.report.error("enum-outside-range", message, _place(resolved, entry.raw), hint, related)


def _place(resolved: ResolvedPoint, number: int) -> Span:
    node = resolved.facts.get("enum")
    key = next((key for key in node if integer_in(key) == number), None) if isinstance(node, Map) else None
    return resolved.facts.span("enum") if key is None else node.key_span(key)
