"""No two points take the same bits of one address, none lies in a gap, and no command stands on a point."""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.checks.coexistence import Coexistence
from fieldscribe.resolve.points import ResolvedPoint

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.diagnostics import Span
    from fieldscribe.model import Command, Point
    from fieldscribe.resolve.analysis import Analysis

_WHOLE = (15, 0)
_MOST = 512
_APART = ", or say by `when`, `variants`, `since` or `until` that they are never there at once"
_Key = tuple[str, str | None, int, int]
"""Space, telegram, index (0 where addresses of the space have no index) and address."""

Taken = dict[_Key, list[ResolvedPoint]]


def check(analysis: Analysis) -> None:
    """Overlapping points, points in gaps, commands on points or in gaps."""
    taken: Taken = {}
    known = _Known(Coexistence(analysis), set())
    gaps = any(analysis.bus.gaps.values())
    for resolved in analysis.resolved:
        if analysis.report.full:
            return
        if "space" in resolved.facts.failed:
            continue
        for address, key in _stands(resolved.point):
            others = taken.setdefault(_key(analysis, resolved.point, address), [])
            if others:
                _compare(analysis, resolved, others, (address, key), known)
            others.append(resolved)
            if gaps:
                _gap(analysis, resolved, address, key)
    _commands(analysis, taken)


class _Known(NamedTuple):
    """Which points can meet, and the rows of the manual whose overlaps are told."""

    meetings: Coexistence
    told_rows: set[int]


def _compare(
    analysis: Analysis, resolved: ResolvedPoint, others: list[ResolvedPoint], stands: tuple[int, str], known: _Known
) -> None:
    """Findings for bits of an address that the others there have, too."""
    meetings, told_rows = known
    address, key = stands
    fresh = [other for other in others if (row := _row(resolved, other)) is None or row not in told_rows]
    rivals = [
        other
        for other in fresh
        if other is not resolved and _overlap(resolved.point, other.point) and not meetings.never(resolved, other)
    ]
    if rivals:
        _report_overlap(analysis, resolved, rivals, address, key)
    told_rows.update(row for rival in rivals if (row := _row(resolved, rival)) is not None)
    if len(fresh) == _MOST:
        message = f"more than {_MOST} points stand at {_place_in_words(analysis, resolved.point, address)}"
        analysis.report.error("too-many-items", message, resolved.facts.span(key), "nobody needs so many")


def _stands(point: Point) -> Iterator[tuple[int, str]]:
    """The addresses where the point is read, and those where else it is written, with the keys that say them."""
    for address in point.place.addresses:
        yield address, "at"
    for address in () if point.write_place is None else point.write_place.addresses:
        yield address, "write_at"


def _stands_here(other: ResolvedPoint, address: int) -> tuple[Span, str]:
    """The place in the text that puts a point at an address, with a remark."""
    if address in other.point.addresses:
        return other.facts.span("at"), f"`{other.point.name}` stands here"
    return other.facts.span("write_at"), f"`{other.point.name}` is written here"


def _key(analysis: Analysis, point: Point, address: int) -> _Key:
    terms = point.terms
    index = point.index if point.index and terms.space in analysis.scope.family.indexed else 0
    return terms.space, terms.telegram, index, address


def _place_in_words(analysis: Analysis, point: Point, address: int) -> str:
    """The address in words."""
    if point.telegram is not None:
        return f"word {address} of the telegram {point.telegram}"
    if point.space in analysis.scope.family.indexed and point.index is not None:
        return f"{point.space} {address}, index {point.index}"
    return f"{point.space} {address} ({address:04X}h)"


def _row(mine: ResolvedPoint, other: ResolvedPoint) -> int | None:
    """The row of the manual, if both points were expanded from the same: all its overlaps are one finding."""
    expanded = mine.facts.element and other.facts.element
    return id(mine.facts.own) if expanded and mine.facts.own is other.facts.own else None


def _overlap(mine: Point, other: Point) -> bool:
    """Whether two points at one address have bits in common."""
    return (mine.bits or _WHOLE)[1] <= (other.bits or _WHOLE)[0] and (other.bits or _WHOLE)[1] <= (mine.bits or _WHOLE)[
        0
    ]


def _report_overlap(
    analysis: Analysis, mine: ResolvedPoint, others: list[ResolvedPoint], address: int, key: str
) -> None:
    """One finding that names all points at the address."""
    together = [mine, *others]
    related = [_stands_here(other, address) for other in others]
    place = _place_in_words(analysis, mine.point, address)
    what = f"{_listed([resolved.point.name for resolved in together])} {'both' if len(together) == 2 else 'all'}"
    if all(resolved.point.bits for resolved in together):
        bit = max(resolved.point.bits[1] for resolved in (mine, others[0]) if resolved.point.bits)
        hint = f"points may share a word, but not its bits: correct one{_APART}"
        analysis.report.error(
            "bits-overlap", f"{what} take bit {bit} of {place}", mine.facts.span("bits"), hint, related
        )
        return
    hint = f"correct one `{key}`, give each `bits` of the word{_APART}"
    if any(len(resolved.point.addresses) > 1 for resolved in together):
        hint = "a point of 32 bits takes two addresses, one of 64 bits four: correct one `at` or `type`"
    elif key == "write_at" and any(mine.facts.layer(key) is other.facts.layer(key) for other in others):
        hint = "each set, variant and member with an `at` of its own needs a `write_at`, or `write_at: ~`"
    elif any(_row(mine, other) is not None for other in others):
        hint = "`addressing` must give each set and index an address of its own: correct it, or the row"
    analysis.report.error("address-taken", f"{what} stand at {place}", mine.facts.span(key), hint, related)


def _listed(names: list[str]) -> str:
    quoted = [f"`{name}`" for name in dict.fromkeys(names)]
    return " and ".join(filter(None, (", ".join(quoted[:-1]), quoted[-1])))


def _gap(analysis: Analysis, resolved: ResolvedPoint, address: int, key: str) -> None:
    gap = _gap_at(analysis, resolved.point.space, address)
    if gap is not None:
        message = f"`{resolved.point.name}` lies in the gap {gap[0]:04X}h..{gap[1]:04X}h, which no request may touch"
        hint = "correct the gap under `bus`, or the address"
        analysis.report.error("address-in-gap", message, resolved.facts.span(key), hint)


def _gap_at(analysis: Analysis, space: str, address: int) -> tuple[int, int] | None:
    gaps = analysis.bus.gaps.get(space, ())
    before = gaps[: bisect_right(gaps, (address, 0xFFFF))]
    return next((gap for gap in reversed(before) if gap[1] >= address), None)


def _writes_a_value(command: Command, point: Point) -> bool:
    """Whether the command is a name for writing one allowed value to the point."""
    whole = point.writable and point.bits is None and not point.info.floating
    return (
        whole
        and point.written.addresses == (command.address,)
        and command.value is not None
        and point.allowed.holds(command.value)
    )


def _commands(analysis: Analysis, taken: Taken) -> None:
    raws = {str(node["name"]): node for node in reversed(list(analysis.scope.listed("commands")))}
    for command in analysis.commands:
        span = raws[command.name].span("at")
        for other in taken.get((command.space, None, 0, command.address), ()):
            if _writes_a_value(command, other.point):
                continue
            related = [_stands_here(other, command.address)]
            message = f"the command `{command.name}` and the point `{other.point.name}` share an address"
            hint = "a command writes where no point is, or a value that the range of a whole writable word allows"
            analysis.report.error("address-taken", message, span, hint, related)
        if _gap_at(analysis, command.space, command.address) is not None:
            message = f"the command `{command.name}` lies in a gap that no request may touch"
            analysis.report.error("address-in-gap", message, span, "leave its address out of the gap")
