"""A limit from other points is a signed 64-bit number, the widest with which generated code computes."""

from fieldscribe.arithmetic.words import INT64
from fieldscribe.model import Limit
from fieldscribe.resolve.analysis import Analysis


def check(analysis: Analysis) -> None:
    """Report computed limits that may be greater."""
    for resolved in analysis.resolved:
        allowed = resolved.point.allowed
        ends = (end for interval in allowed.intervals for end in (interval.low, interval.high))
        if allowed.moves and any(isinstance(end, Limit) and end.greatest > INT64[1] for end in ends):
            key = "range" if resolved.facts.get("range") is not None else "range_in_units"
            message = f"the limit of `{resolved.point.name}` may exceed {INT64[1]}, which no generated code computes"
            hint = "give the points that it follows from a narrower type or range, or use `s64`"
            analysis.report.error("range-outside-type", message, resolved.facts.span(key), hint)
