"""A point that is a view of another shares words with it."""

from fieldscribe.checks.coexistence import WordKey, word_key
from fieldscribe.grouping import grouped
from fieldscribe.model import Point, bits_of
from fieldscribe.resolve.analysis import Analysis


def check(analysis: Analysis) -> None:
    """Report views that share no words with the point that they name."""
    any_view = any(resolved.point.view_of for resolved in analysis.resolved)
    viewed = grouped((resolved.point.name, resolved.point) for resolved in analysis.resolved if any_view)
    for resolved in analysis.resolved:
        point, facts = resolved.point, resolved.facts
        if point.view_of is None or facts.failed & {"at", "space", "type"}:
            continue
        others = {word for other in viewed.get(point.view_of, ()) for word in _words(analysis, other)}
        if others.isdisjoint(_words(analysis, point)):
            what = "word" if point.place.bit is None else "bit"
            message = f"`{point.name}` has no {what} of `{point.view_of}`"
            analysis.report.error("view", message, facts.span("view_of"), "correct `at`, or leave `view_of` out")


def _words(analysis: Analysis, point: Point) -> set[WordKey]:
    if point.place.bit is not None:
        return {word_key(analysis, point, bit) for bit in bits_of(point)}
    return {word_key(analysis, point, address) for address in point.addresses}
