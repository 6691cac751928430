"""Points under `view_of`, `write_with` and `select` can be what the point that names them needs.

A view shares words with the point that it names. Points that must be written together can be written in one request.
Points that select the meaning of addresses can be written, and are not selected themselves.
"""

from fieldscribe.checks.coexistence import WordKey, word_key
from fieldscribe.grouping import grouped
from fieldscribe.model import Point, bits_of
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.points import ResolvedPoint


def check(analysis: Analysis) -> None:
    """Report named points that do not fit."""
    points = [resolved.point for resolved in analysis.resolved]
    names_others = any(point.view_of or point.write_with or point.selects for point in points)
    by_name = grouped((point.name, point) for point in points if names_others)
    for resolved in analysis.resolved:
        facts = resolved.facts
        if resolved.point.view_of is not None and not facts.failed & {"at", "space", "type"}:
            _view(analysis, resolved, by_name)
        if resolved.point.write_with and not facts.failed & {"at", "space", "type", "access"}:
            _written_together(analysis, resolved, by_name)
        if facts.layer("select") is not None and "when" not in facts.failed:
            _selected(analysis, resolved, by_name)


def _view(analysis: Analysis, resolved: ResolvedPoint, by_name: dict[str, list[Point]]) -> None:
    """Report a view that shares no words with the point that it names."""
    point = resolved.point
    others = {word for other in by_name.get(point.view_of or "", ()) for word in _words(analysis, other)}
    if others.isdisjoint(_words(analysis, point)):
        what = "word" if point.place.bit is None else "bit"
        message = f"`{point.name}` has no {what} of `{point.view_of}`"
        hint = "correct `at`, or leave `view_of` out"
        analysis.report.error("view", message, resolved.facts.span("view_of"), hint)


def _words(analysis: Analysis, point: Point) -> set[WordKey]:
    if point.place.bit is not None:
        return {word_key(analysis, point, bit) for bit in bits_of(point)}
    return {word_key(analysis, point, address) for address in point.addresses}


def _written_together(analysis: Analysis, resolved: ResolvedPoint, by_name: dict[str, list[Point]]) -> None:
    """Report points under `write_with` that cannot be written, or not in the request of the point."""
    point = resolved.point
    others = [other for name in point.write_with for other in by_name.get(name, ()) if _meet(point, other)]
    words = {address for each in (point, *others) for address in each.written.addresses}
    if unwritable := [each.name for each in (point, *others) if not each.writable]:
        message, hint = f"`{unwritable[0]}` cannot be written", "leave it out, or correct its `access`"
    elif any(other.space != point.space for other in others):
        message, hint = "the points are not in one space", "name points that one request can write"
    elif point.space in analysis.scope.family.words:
        message = f"a request to the space `{point.space}` writes one number"
        hint = "say in a note how they are written, or use `steps` of a command"
    elif words and max(words) - min(words) >= len(words):
        message = f"between the words of `{point.name}` and those of the others lie words of other points"
        hint = "name all points that the request writes"
    else:
        return
    analysis.report.error("write-with", message, resolved.facts.span("write_with"), hint)


def _meet(point: Point, other: Point) -> bool:
    """Return True if both can exist in the same device."""
    return point.variant is None or other.variant is None or point.variant == other.variant


def _selected(analysis: Analysis, resolved: ResolvedPoint, by_name: dict[str, list[Point]]) -> None:
    """Report points under `select` that cannot be written or are selected; a family without bases has no `select`."""
    others = [by_name[name][-1] for name, _ in resolved.point.selects]
    if not analysis.scope.family.has_bases:
        message, hint = f"addresses of the family {analysis.scope.family.name} have one meaning", "leave it out"
    elif unwritable := next((other for other in others if not _is_written(other)), None):
        message, hint = f"`{unwritable.name}` cannot be written", "correct its `access`, or name another point"
    elif selected := next((other for other in others if other.selects), None):
        message, hint = f"`{selected.name}` is selected itself", "name all points that select, at each group"
    else:
        return
    analysis.report.error("wrong-choice", message, resolved.facts.span("select"), hint)


def _is_written(point: Point) -> bool:
    return point.writable and point.generated and bool(point.place.addresses)
