"""Points that must be written together can be written in one request."""

from fieldscribe.grouping import grouped
from fieldscribe.model import Point
from fieldscribe.resolve.analysis import Analysis


def check(analysis: Analysis) -> None:
    """Report points under `write_with` that cannot be written, or not in the request of the point."""
    one_at_a_time = analysis.scope.family.words
    together = [resolved for resolved in analysis.resolved if resolved.point.write_with]
    by_name = grouped((resolved.point.name, resolved.point) for resolved in analysis.resolved if together)
    for resolved in together:
        point, facts = resolved.point, resolved.facts
        if facts.failed & {"at", "space", "type", "access"}:
            continue
        others = [other for name in point.write_with for other in by_name.get(name, ()) if _meet(point, other)]
        words = {address for each in (point, *others) for address in each.written.addresses}
        span = facts.span("write_with")
        if unwritable := [each.name for each in (point, *others) if not each.writable]:
            message, hint = f"`{unwritable[0]}` cannot be written", "leave it out, or correct its `access`"
        elif any(other.space != point.space for other in others):
            message, hint = "the points are not in one space", "name points that one request can write"
        elif point.space in one_at_a_time:
            message = f"a request to the space `{point.space}` writes one number"
            hint = "say in a note how they are written, or use `steps` of a command"
        elif words and max(words) - min(words) >= len(words):
            message = f"between the words of `{point.name}` and those of the others lie words of other points"
            hint = "name all points that the request writes"
        else:
            continue
        analysis.report.error("write-with", message, span, hint)


def _meet(point: Point, other: Point) -> bool:
    """Return True if both can exist in the same device."""
    return point.variant is None or other.variant is None or point.variant == other.variant
