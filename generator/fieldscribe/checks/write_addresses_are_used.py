"""A write address differs from the read address, in a family whose requests can write elsewhere."""

from collections.abc import Iterator

from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.points import ResolvedPoint

_LEAVE_OUT = "leave `write_at` out"


def check(analysis: Analysis) -> None:
    """Report write addresses that no request would use, or that add nothing."""
    for resolved in analysis.resolved:
        facts = resolved.facts
        if facts.get("write_at") is None or facts.failed & {"at", "write_at", "space"}:
            continue
        wrong = next(_wrong(analysis, resolved), None)
        if wrong is not None:
            message, hint = wrong
            analysis.report.error("write-address", f"`{facts.name}` {message}", facts.span("write_at"), hint)


def _wrong(analysis: Analysis, resolved: ResolvedPoint) -> Iterator[tuple[str, str]]:
    """Yield what is wrong with a write address, the most helpful reason first."""
    point, family = resolved.point, analysis.scope.family
    if not family.writes_elsewhere:
        yield f"is written where it is read: {family.name} devices have no separate write address", _LEAVE_OUT
    if point.access != "none" and not point.writable:
        yield "is only read", f"{_LEAVE_OUT}, or correct `access`"
    if point.access == "w":
        yield "is only written, and `at` says where", f"give the write address as `at`, and {_LEAVE_OUT}"
    if not point.addresses and resolved.facts.layer("at") is not None and resolved.facts.get("at") is None:
        yield (
            "is written at an address, and read at none",
            "a point that is only written has `access: w`, and its address at `at`",
        )
    if point.write_place is None:
        return
    if point.write_place.addresses == point.addresses:
        yield "is written where it is read", _LEAVE_OUT
    if len({mine - other for mine, other in zip(point.addresses, point.write_place.addresses, strict=True)}) > 1:
        yield "is written in another order than it is read", "write the words in the order of `at`"
    if set(point.addresses) & set(point.write_place.addresses):
        yield "is read and written at overlapping addresses", "correct `at`, `write_at` or the type"
