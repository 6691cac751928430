"""Bits that are always written as a constant leave numbers to write and belong to no other point."""

from fieldscribe.arithmetic.words import group_mask
from fieldscribe.checks.coexistence import Coexistence, WordKey, word_key
from fieldscribe.model import Fixed, Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.points import ResolvedPoint

_RIVALS = ("enum", "digits", "scale")
"""Keys that a word with fixed bits cannot have."""

_MOST = 64
"""The most bit groups of a word that each is compared with: a word has 16 bits, times its variants."""


def check(analysis: Analysis) -> None:
    """Report fixed bits that no allowed number has, that two points write differently, or of another point."""
    coexistence = Coexistence(analysis)
    words: dict[WordKey, list[ResolvedPoint]] = {}

    def written_word(point: Point) -> WordKey:
        return word_key(analysis, point, min(point.written.addresses))

    fixed = [resolved for resolved in analysis.resolved if resolved.point.fixed is not None]
    for resolved in analysis.resolved if fixed else ():
        if resolved.point.writable and resolved.point.bits is not None and resolved.point.addresses:
            words.setdefault(written_word(resolved.point), []).append(resolved)
    for resolved in fixed:
        point = resolved.point
        if point.fixed is None or resolved.facts.failed & {"type", "range", "fixed"}:
            continue
        rivals = resolved.facts.floating or any(resolved.facts.get(key) is not None for key in _RIVALS)
        if point.bits is None and not rivals and not _leaves_any(point, point.fixed):
            message = f"no number that may be written to `{point.name}` has these bits"
            hint = "numbers are the whole word with its fixed bits: correct the range, or leave `fixed` out"
            analysis.report.error("two-meanings", message, resolved.facts.span("fixed"), hint)
        if point.bits is not None and point.addresses:
            others = words[written_word(point)][:_MOST]
            later = False
            for other in others:
                if other is not resolved and not coexistence.exclude(resolved, other):
                    _compare(analysis, resolved, point.fixed, other, later=later)
                later = later or other is resolved


def _compare(analysis: Analysis, resolved: ResolvedPoint, fixed: Fixed, other: ResolvedPoint, *, later: bool) -> None:
    """Report what is wrong between two bit groups of one word; the later one (`later`) reports what concerns both."""
    mask = group_mask(other.point)
    other_fixed = other.point.fixed
    related = [(other.facts.span(), f"`{other.point.name}` stands here")]
    if fixed.mask & mask:
        bit = (fixed.mask & mask).bit_length() - 1
        message = f"writing `{resolved.point.name}` always changes bit {bit}, which belongs to `{other.point.name}`"
        hint = "leave that bit out of `fixed`: the other bits of the word are written back as they were read"
        analysis.report.error("bits-overlap", message, resolved.facts.span("fixed"), hint, related)
    elif later and other_fixed is not None and (fixed.bits ^ other_fixed.bits) & fixed.mask & other_fixed.mask:
        bit = ((fixed.bits ^ other_fixed.bits) & fixed.mask & other_fixed.mask).bit_length() - 1
        message = f"`{resolved.point.name}` and `{other.point.name}` fix bit {bit} of their word differently"
        hint = "what is always written as a constant is one constant: correct one of them"
        analysis.report.error("two-meanings", message, resolved.facts.span("fixed"), hint, related)


def _leaves_any(point: Point, fixed: Fixed) -> bool:
    """Return True if a number with the fixed bits may be written; limits set by other points count at their widest."""
    span = 1 << point.width
    for interval in point.allowed.intervals:
        low, high = interval.outer
        parts = ((low, high),) if low >= 0 else ((0, high), (low + span, min(high, -1) + span))
        if any(_next_with_bits(first, fixed) <= last for first, last in parts if first <= last):
            return True
    return False


def _next_with_bits(number: int, fixed: Fixed) -> int:
    """Return the least number from `number` on that has the fixed bits."""
    while wrong := (number ^ fixed.bits) & fixed.mask:
        top = wrong.bit_length() - 1
        number = ((number >> top) + 1) << top  # rounded up to that bit, which sets it or carries over it
    return number
