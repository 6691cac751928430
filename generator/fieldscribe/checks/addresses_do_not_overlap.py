"""No two points take the same bits of one address, none lies in a gap, and no command stands on a point."""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING

from fieldscribe.checks.subject import inside
from fieldscribe.resolve.points import Resolved

if TYPE_CHECKING:
    from fieldscribe.checks.subject import Subject
    from fieldscribe.model import Command, Point

_WHOLE = (15, 0)
_Key = tuple[str, str | None, int, int]
"""Space, telegram, index (0 where addresses have none beside them) and address."""

Taken = dict[_Key, list[Resolved]]


def check(subject: Subject) -> None:
    """Overlapping points, points in gaps, commands on points or in gaps."""
    taken: Taken = {}
    told: set[int] = set()
    for resolved in subject.resolved:
        if subject.report.full:
            return
        if "space" in resolved.draft.failed:
            continue
        for address in resolved.point.addresses:
            others = taken.setdefault(_key(subject, resolved.point, address), [])
            for other in others:
                row = _row(resolved, other)
                if row not in told and _compare(subject, resolved, other, address) and row is not None:
                    told.add(row)
            if len(others) < 64:  # more than the bits of a word and its variants: compared enough
                others.append(resolved)
            _gap(subject, resolved, address)
    _commands(subject, taken)


def _key(subject: Subject, point: Point, address: int) -> _Key:
    indexed = point.space in subject.scope.family.indexed
    return point.space, point.telegram, (point.index or 0) if indexed else 0, address


def _place(subject: Subject, point: Point, address: int) -> str:
    """The address in words."""
    if point.telegram is not None:
        return f"word {address} of the telegram {point.telegram}"
    if point.space in subject.scope.family.indexed and point.index is not None:
        return f"{point.space} {address}, index {point.index}"
    return f"{point.space} {address} ({address:04X}h)"


def _row(mine: Resolved, other: Resolved) -> int | None:
    """The row that both are elements of, if they are: where its rule is wrong, one finding is enough."""
    one, another = mine.draft.element, other.draft.element
    return id(one.at) if one is not None and another is not None and one.at is another.at else None


def _compare(subject: Subject, mine: Resolved, other: Resolved, address: int) -> bool:
    """Report it if the two take the same bits; whether they do."""
    if _never_meet(mine.point, other.point):
        return False
    high, low = mine.point.bits or _WHOLE
    other_high, other_low = other.point.bits or _WHOLE
    if low > other_high or other_low > high:
        return False
    related = [(other.draft.span("at"), f"`{other.point.name}` stands here")]
    place = _place(subject, mine.point, address)
    if mine.point.bits and other.point.bits:
        message = f"`{mine.point.name}` and `{other.point.name}` both take bit {max(low, other_low)} of {place}"
        hint = "points may share a word, but not its bits"
        subject.report.error("bits-overlap", message, mine.draft.span("bits"), hint, related)
    else:
        message = f"`{mine.point.name}` and `{other.point.name}` both stand at {place}"
        hint = "correct one `at`, or give both `bits` of the word"
        if len(mine.point.addresses) > 1 or len(other.point.addresses) > 1:
            hint = "a point of 32 bits takes two addresses, one of 64 bits four: correct one `at` or `type`"
        elif _row(mine, other) is not None:
            hint = "`addressing` must give each set and index an address of its own: correct it, or the row"
        subject.report.error("address-taken", message, mine.draft.span("at"), hint, related)
    return True


def _never_meet(mine: Point, other: Point) -> bool:
    """Whether the two are never there at once: two values of one variant axis, or two conditions of the author."""
    if mine.variant is not None and other.variant is not None and mine.variant != other.variant:
        return mine.variant.partition("=")[0] == other.variant.partition("=")[0]
    return mine.when is not None and other.when is not None and mine.when != other.when


def _gap(subject: Subject, resolved: Resolved, address: int) -> None:
    gap = _gap_at(subject, resolved.point.space, address)
    if gap is not None:
        message = f"`{resolved.point.name}` lies in the gap {gap[0]:04X}h..{gap[1]:04X}h, which no request may touch"
        hint = "correct the gap under `bus`, or the address"
        subject.report.error("address-in-gap", message, resolved.draft.span("at"), hint)


def _gap_at(subject: Subject, space: str, address: int) -> tuple[int, int] | None:
    gaps = subject.bus.gaps.get(space, ())
    before = gaps[: bisect_right(gaps, (address, 0xFFFF))]
    return next((gap for gap in reversed(before) if gap[1] >= address), None)


def _writes_a_value(command: Command, point: Point) -> bool:
    """Whether the command is a name for writing one allowed value to the point."""
    whole = point.writable and point.bits is None and len(point.addresses) == 1 and not point.info.floating
    return whole and command.value is not None and inside(command.value, point.allowed)


def _commands(subject: Subject, taken: Taken) -> None:
    raws = {str(raw["name"]): raw for raw in reversed(list(subject.scope.listed("commands")))}
    for command in subject.commands:
        span = raws[command.name].span("at")
        for other in taken.get((command.space, None, 0, command.address), ()):
            if _writes_a_value(command, other.point):
                continue
            related = [(other.draft.span("at"), f"`{other.point.name}` stands here")]
            message = f"the command `{command.name}` and the point `{other.point.name}` share an address"
            hint = "a command writes where no point is, or a value that the range of a whole writable word allows"
            subject.report.error("address-taken", message, span, hint, related)
        if _gap_at(subject, command.space, command.address) is not None:
            message = f"the command `{command.name}` lies in a gap that no request may touch"
            subject.report.error("address-in-gap", message, span, "leave its address out of the gap")
