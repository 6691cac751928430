"""Points that select the meaning of addresses can be written, and are not selected themselves."""

from fieldscribe.model import Point
from fieldscribe.resolve.analysis import Analysis


def check(analysis: Analysis) -> None:
    """Report points under `select` that cannot be written or are selected; a family without bases has no `select`."""
    points = {resolved.point.name: resolved.point for resolved in analysis.resolved}
    for resolved in analysis.resolved:
        facts = resolved.facts
        if facts.layer("select") is None or "when" in facts.failed:
            continue
        others = [points[name] for name, _ in resolved.point.selects]
        if not analysis.scope.family.has_bases:
            message = f"addresses of the family {analysis.scope.family.name} have one meaning"
            hint = "leave it out"
        elif unwritable := next((other for other in others if not _is_written(other)), None):
            message, hint = f"`{unwritable.name}` cannot be written", "correct its `access`, or name another point"
        elif selected := next((other for other in others if other.selects), None):
            message, hint = f"`{selected.name}` is selected itself", "name all points that select, at each group"
        else:
            continue
        analysis.report.error("wrong-choice", message, facts.span("select"), hint)


def _is_written(point: Point) -> bool:
    return point.writable and point.generated and bool(point.place.addresses)
