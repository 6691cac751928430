"""No two points use the same bits of one address, none lies in a gap, and no command writes to a point."""

from bisect import bisect_right
from collections.abc import Iterator

from fieldscribe.checks.coexistence import Coexistence, WordKey, word_key
from fieldscribe.diagnostics import Report, Span
from fieldscribe.model import Command, Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.points import ResolvedPoint

_WHOLE = (15, 0)
_MOST = 512
APART = (
    ", or say by `when`, `variants`, `since` or `until` that they are never there at once, or by `view_of` that both "
    "may be"
)


def check(analysis: Analysis) -> None:
    """Report overlapping points, points in gaps, and commands at the addresses of points or in gaps."""
    overlaps = _Overlaps(analysis)
    gaps = any(analysis.bus.gaps.values())
    for resolved in analysis.resolved:
        if analysis.report.full:
            return
        if resolved.facts.failed & {"space", "view_of"}:
            continue
        for address, key in _addresses(resolved.point):
            overlaps.add(resolved, address, key)
            if gaps:
                _check_gap(analysis, resolved, address, key)
    _check_commands(analysis, overlaps.taken)


class _Overlaps:
    """Collects the points at each address and reports those that share bits."""

    def __init__(self, analysis: Analysis) -> None:
        self.taken: dict[WordKey, list[ResolvedPoint]] = {}
        self._analysis = analysis
        self._coexistence = Coexistence(analysis)
        self._reported_rows: set[int] = set()
        self._reported_pairs: set[tuple[int, int]] = set()

    def add(self, resolved: ResolvedPoint, address: int, key: str) -> None:
        """Add a point at the address that this key gives it."""
        others = self.taken.setdefault(word_key(self._analysis, resolved.point, address), [])
        if len(others) > _MOST:
            return  # it has a finding
        rows = self._reported_rows
        fresh = [other for other in others if (row := _row(resolved, other)) is None or row not in rows]
        if fresh:
            self._compare(resolved, fresh, address, key)
        if len(fresh) == len(others):  # one point of a reported row is enough here
            others.append(resolved)

    def _compare(self, resolved: ResolvedPoint, fresh: list[ResolvedPoint], address: int, key: str) -> None:
        rows, report = self._reported_rows, self._analysis.report
        rivals = [
            other
            for other in fresh
            if (id(resolved), id(other)) not in self._reported_pairs and self._overlap(resolved, other)
        ]
        self._reported_pairs.update((id(resolved), id(other)) for other in rivals)
        place = _place_in_words(self._analysis, resolved.point, address)
        if rivals:
            _report_overlap(report, [resolved, *rivals], address, key, place)
        rows.update(row for rival in rivals if (row := _row(resolved, rival)) is not None)
        if len(fresh) == _MOST:
            message = f"more than {_MOST} points are at {place}"
            report.error("too-many-items", message, resolved.facts.span(key), "more is certainly a mistake")

    def _overlap(self, mine: ResolvedPoint, other: ResolvedPoint) -> bool:
        """Return True if two points at one address have bits in common and can exist in the same device."""
        (high, low), (other_high, other_low) = mine.point.bits or _WHOLE, other.point.bits or _WHOLE
        common = low <= other_high and other_low <= high and other is not mine
        return common and not _are_views(mine.point, other.point) and not self._coexistence.exclude(mine, other)


def _are_views(point: Point, other: Point) -> bool:
    """Return True if one point is a view of the other, or both are views of a third."""
    return bool({point.view_of, other.view_of} & {point.name, other.name}) or (
        point.view_of is not None and point.view_of == other.view_of
    )


def _addresses(point: Point) -> Iterator[tuple[int, str]]:
    """Yield the addresses where the point is read, and where it is written if that differs, each with its key."""
    for address in point.place.addresses:
        yield address, "at"
    for address in () if point.write_place is None else point.write_place.addresses:
        yield address, "write_at"


def _address_place(other: ResolvedPoint, address: int) -> tuple[Span, str]:
    """Return the place in the text that gives a point this address, with a remark."""
    if address in other.point.addresses:
        return other.facts.span("at"), f"`{other.point.name}` stands here"
    return other.facts.span("write_at"), f"`{other.point.name}` is written here"


def _place_in_words(analysis: Analysis, point: Point, address: int) -> str:
    """Return the address as a message shows it."""
    if point.telegram is not None:
        return f"word {address} of the telegram {point.telegram}"
    if point.space in analysis.scope.family.indexed and point.index is not None:
        return f"{point.space} {address}, index {point.index}"
    return f"{point.space} {address} ({address:04X}h)"


def _row(mine: ResolvedPoint, other: ResolvedPoint) -> int | None:
    """Return the row of the manual from which both points were expanded: its overlaps are one finding."""
    expanded = mine.facts.element and other.facts.element
    return id(mine.facts.node) if expanded and mine.facts.node is other.facts.node else None


def _report_overlap(report: Report, together: list[ResolvedPoint], address: int, key: str, place: str) -> None:
    """Report all points that overlap at an address as one finding about the first of them."""
    mine, *others = together
    related = [_address_place(other, address) for other in others]
    what = f"{_listed([resolved.point.name for resolved in together])} {'both' if len(together) == 2 else 'all'}"
    if all(resolved.point.bits for resolved in together):
        bit = max(resolved.point.bits[1] for resolved in together[:2] if resolved.point.bits)
        hint = f"points may share a word, but not its bits: correct one{APART}"
        report.error("bits-overlap", f"{what} take bit {bit} of {place}", mine.facts.span("bits"), hint, related)
        return
    hint = f"correct one `{key}`, give each `bits` of the word{APART}"
    longest = max((resolved.point for resolved in together), key=lambda point: len(point.addresses))
    if len(longest.addresses) > 1:
        first, last = min(longest.addresses), max(longest.addresses)
        hint = f"`{longest.name}` has the words {first} to {last}: correct an `at`, or how long it is{APART}"
    elif key == "write_at" and any(mine.facts.layer(key) is other.facts.layer(key) for other in others):
        hint = "each set, variant and member with an `at` of its own needs a `write_at`, or `write_at: ~`"
    elif any(_row(mine, other) is not None for other in others):
        hint = "`addressing` must give each set and index an address of its own: correct it, or the row"
    report.error("address-taken", f"{what} stand at {place}", mine.facts.span(key), hint, related)


def _listed(names: list[str]) -> str:
    quoted = [f"`{name}`" for name in dict.fromkeys(names)]
    return " and ".join(filter(None, (", ".join(quoted[:-1]), quoted[-1])))


def _check_gap(analysis: Analysis, resolved: ResolvedPoint, address: int, key: str) -> None:
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
    """Return True if the command is a name for writing one allowed value to the point."""
    whole = point.writable and point.bits is None and not point.info.floating
    known = command.value is not None and point.allowed.holds(command.value)
    return whole and known and point.written.addresses == (command.address,)


def _check_commands(analysis: Analysis, taken: dict[WordKey, list[ResolvedPoint]]) -> None:
    raws = {str(node["name"]): node for node in reversed(list(analysis.scope.listed("commands")))}
    for command in analysis.commands:
        span = raws[command.name].span("at")
        for other in taken.get((command.space, None, 0, command.address), ()):
            if _writes_a_value(command, other.point):
                continue
            related = [_address_place(other, command.address)]
            message = f"the command `{command.name}` and the point `{other.point.name}` share an address"
            hint = "a command writes where no point is, or a value that the range of a whole writable word allows"
            analysis.report.error("address-taken", message, span, hint, related)
        if _gap_at(analysis, command.space, command.address) is not None:
            message = f"the command `{command.name}` lies in a gap that no request may touch"
            analysis.report.error("address-in-gap", message, span, "leave its address out of the gap")
