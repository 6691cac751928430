"""No two points take the same bits of one address, none lies in a gap, and no command stands on a point."""

from __future__ import annotations

from fieldscribe.checks.subject import Subject
from fieldscribe.families import FAMILIES
from fieldscribe.resolve.points import Resolved

_WHOLE = (15, 0)


def check(subject: Subject) -> None:
    """Overlapping points, points in gaps, commands on points or in gaps."""
    taken: dict[tuple[str, int], list[Resolved]] = {}
    for resolved in subject.resolved:
        for address in resolved.point.addresses:
            others = taken.setdefault((resolved.point.space, address), [])
            for other in others:
                _compare(subject, resolved, other, address)
            others.append(resolved)
    _gaps(subject, taken)
    _commands(subject, taken)


def _compare(subject: Subject, mine: Resolved, other: Resolved, address: int) -> None:
    if mine.point.variant is not None and other.point.variant is not None and mine.point.variant != other.point.variant:
        return
    high, low = mine.point.bits or _WHOLE
    other_high, other_low = other.point.bits or _WHOLE
    if low > other_high or other_low > high:
        return
    related = [(other.draft.span("at"), f"`{other.point.name}` stands here")]
    if mine.point.bits and other.point.bits:
        message = (
            f"`{mine.point.name}` and `{other.point.name}` both take bit {max(low, other_low)} of address {address}"
        )
        subject.report.error(
            "bits-overlap", message, mine.draft.span("bits"), "points may share a word, but not its bits", related
        )
    else:
        message = (
            f"`{mine.point.name}` and `{other.point.name}` both stand at {mine.point.space} {address} ({address:04X}h)"
        )
        subject.report.error(
            "address-taken",
            message,
            mine.draft.span("at"),
            "correct one `at`, or give both `bits` of the word",
            related,
        )


def _gaps(subject: Subject, taken: dict[tuple[str, int], list[Resolved]]) -> None:
    spaces = FAMILIES[subject.scope.family].spaces
    for space, gaps in subject.bus.gaps.items():
        if space not in spaces:
            bus = next(file["bus"] for file in subject.scope.files if "bus" in file)
            subject.report.error(
                "unknown-space",
                f"there is no space `{space}`",
                bus["gaps"].key_span(space),
                f"known: {', '.join(spaces)}",
            )
        for resolved in (one for (where, _), points in taken.items() if where == space for one in points):
            if any(low <= address <= high for low, high in gaps for address in resolved.point.addresses):
                message = f"`{resolved.point.name}` lies in a gap that no request may touch"
                subject.report.error(
                    "address-in-gap", message, resolved.draft.span("at"), "correct the gap under `bus`, or the address"
                )


def _commands(subject: Subject, taken: dict[tuple[str, int], list[Resolved]]) -> None:
    raws = {raw["name"]: raw for raw in subject.scope.listed("commands")}
    for command in subject.commands:
        span = raws[command.name].span("at")
        for other in taken.get((command.space, command.address), ()):
            related = [(other.draft.span("at"), f"`{other.point.name}` stands here")]
            message = f"the command `{command.name}` and the point `{other.point.name}` share an address"
            subject.report.error("address-taken", message, span, "a command writes where no point is", related)
        if any(low <= command.address <= high for low, high in subject.bus.gaps.get(command.space, ())):
            message = f"the command `{command.name}` lies in a gap that no request may touch"
            subject.report.error("address-in-gap", message, span, "leave its address out of the gap")
