"""Bits that are always written as a constant leave a number to write, and do not change what other points are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask
from fieldscribe.checks.meetings import Meetings

if TYPE_CHECKING:
    from fieldscribe.checks.subject import Subject
    from fieldscribe.model import Fixed, Point
    from fieldscribe.resolve.points import Resolved

_RIVALS = ("enum", "digits", "scale")
"""What a word with fixed bits cannot have at all."""

_MOST = 64
"""How many bit groups of a word are compared with one: a word has 16 bits, and its variants a few times as many."""


def check(subject: Subject) -> None:
    """Fixed bits that no allowed number has, that two points write differently, or that another point takes."""
    meetings = Meetings(subject)
    words: dict[tuple[str, str | None, int, int], list[Resolved]] = {}
    fixed = [one for one in subject.resolved if one.point.fixed is not None]
    for one in subject.resolved if fixed else ():
        if one.point.writable and one.point.bits is not None and one.point.address is not None:
            words.setdefault(_word(subject, one.point, one.point.address), []).append(one)
    for one in fixed:
        point = one.point
        if point.fixed is None or one.draft.failed & {"type", "range", "fixed"}:
            continue
        rivals = one.draft.floating or any(one.draft.get(key) is not None for key in _RIVALS)
        if point.bits is None and not rivals and not _leaves_any(point, point.fixed):
            message = f"no number that may be written to `{point.name}` has these bits"
            hint = "numbers are the whole word, fixed bits with it: correct the range, or leave `fixed` out"
            subject.report.error("two-meanings", message, one.draft.span("fixed"), hint)
        if point.bits is not None and point.address is not None:
            others = words[_word(subject, point, point.address)][:_MOST]
            behind = False
            for other in others:
                if other is not one and not meetings.never(one, other):
                    _compare(subject, one, point.fixed, other, behind=behind)
                behind = behind or other is one


def _word(subject: Subject, point: Point, address: int) -> tuple[str, str | None, int, int]:
    index = (point.index or 0) if point.space in subject.scope.family.indexed else 0
    return point.space, point.telegram, index, address


def _compare(subject: Subject, one: Resolved, fixed: Fixed, other: Resolved, *, behind: bool) -> None:
    """Findings about two bit groups of one word; what is wrong with both is told once, by the later one (`behind`)."""
    own = group_mask(other.point)
    theirs = other.point.fixed
    related = [(other.draft.span(), f"`{other.point.name}` stands here")]
    if fixed.mask & own:
        bit = (fixed.mask & own).bit_length() - 1
        message = f"writing `{one.point.name}` would always change bit {bit}, which is of `{other.point.name}`"
        hint = "leave that bit out of `fixed`: the other bits of the word are written back as they were read"
        subject.report.error("bits-overlap", message, one.draft.span("fixed"), hint, related)
    elif behind and theirs is not None and (fixed.bits ^ theirs.bits) & fixed.mask & theirs.mask:
        bit = ((fixed.bits ^ theirs.bits) & fixed.mask & theirs.mask).bit_length() - 1
        message = f"`{one.point.name}` and `{other.point.name}` fix bit {bit} of their word differently"
        hint = "what is always written as a constant is one constant: correct one of them"
        subject.report.error("two-meanings", message, one.draft.span("fixed"), hint, related)


def _leaves_any(point: Point, fixed: Fixed) -> bool:
    """Whether a number with the fixed bits may be written; limits that other points set count as they are widest."""
    span = 1 << point.width
    for one in point.allowed.intervals:
        low, high = one.outer
        parts = ((low, high),) if low >= 0 else ((0, high), (low + span, min(high, -1) + span))
        if any(_next(first, fixed) <= last for first, last in parts if first <= last):
            return True
    return False


def _next(number: int, fixed: Fixed) -> int:
    """The least number from `number` on that has the fixed bits."""
    while wrong := (number ^ fixed.bits) & fixed.mask:
        top = wrong.bit_length() - 1
        number = ((number >> top) + 1) << top  # sets the highest wrong bit, or carries over it
    return number
