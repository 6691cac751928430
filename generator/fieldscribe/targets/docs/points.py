"""The tables of points, group by group, and the tables of the bits inside their words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.patterns import blanks
from fieldscribe.records import dataclass
from fieldscribe.targets.docs.alike import Alike
from fieldscribe.targets.docs.cells import (
    Table,
    anchor,
    by_rows,
    cell,
    code,
    link,
    paragraph,
    source_text,
    table,
    target,
)
from fieldscribe.wording.exact import fixed_rule

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from fieldscribe.model import Device, Group, Point

_INLINE_NAMES = 4
"""An enum with at most so many names is shown in the point's row; a longer one is linked."""

_KEEPS = {
    "no": "lost when switched off",
    "yes": "kept, each write wears the memory",
    "choice": "kept when written to the EEPROM",
}


[_BITS] = blanks("?")
"""Where the link to the table of its bits stands in the remarks on a point."""


@dataclass(frozen=True, slots=True)
class _Meaning:
    """The cells of a point that follow from more than its identity."""

    type: str
    access: str
    range: str
    raw_range: str
    scale: str
    default: str
    remarks: str
    """With a blank for the link to the bits of a word."""

    def remarks_on(self, point: Point) -> str:
        """The remarks with the point's own links."""
        return self.remarks.replace(_BITS, link("bits", point.item)) if point.shape.flags else self.remarks


@dataclass(frozen=True, slots=True)
class FlagsView:
    """The bits of one word."""

    point: str
    rows: Table


@dataclass(frozen=True, slots=True)
class GroupView:
    """A group of points on the page."""

    anchor: str
    heading: str
    name: str
    note: str
    facts: str
    points: Table | None
    flags: tuple[FlagsView, ...]


def group_views(device: Device) -> Iterator[GroupView]:
    """All groups that have points or a note, in the author's order."""
    members: dict[str, list[Point]] = {}
    for point in device.points:
        members.setdefault(point.group, []).append(point)
    by_name = {point.name: point for point in device.points}
    meanings = Alike(lambda point: _meaning(device, point, by_name))
    for group in device.groups:
        if group.name in members or group.note:
            yield _group_view(device, group, members.get(group.name, []), meanings)


def reference_heads(points: Sequence[Point]) -> tuple[str, ...]:
    """The numberings of the manual that some of the points have, in the order of their first use."""
    return tuple(dict.fromkeys(key for point in points for key in point.references))


def _group_view(device: Device, group: Group, points: list[Point], meanings: Alike[_Meaning]) -> GroupView:
    spaces = {point.space for point in points}
    several = len(device.documents) > 1
    source = source_text(group.source, several)
    facts = [f"{len(points)} point{'' if len(points) == 1 else 's'}"]
    facts += [f"space {next(iter(spaces))}"] if len(spaces) == 1 else []
    facts += [f"source: {source}"] if source else []
    flags = (FlagsView(target("bits", point.item), _flag_table(point)) for point in points if point.flags)
    return GroupView(
        anchor=anchor("group", group.name),
        heading=cell(wording.title_text(group.title)),
        name=code(group.name),
        note=paragraph(wording.title_text(group.note)) if group.note else "",
        facts=cell("; ".join(facts)),
        points=_point_table(points, meanings, len(spaces) > 1, several) if points else None,
        flags=tuple(flags),
    )


def _point_table(points: list[Point], meanings: Alike[_Meaning], with_space: bool, several: bool) -> Table | None:
    references = [
        (cell(key.capitalize()), [cell(str(point.references.get(key, ""))) for point in points])
        for key in reference_heads(points)
    ]
    said = [meanings.of(point) for point in points]
    return table(
        [
            ("Code", [cell(point.code or "") for point in points]),
            ("Name", [target("point", point.item) for point in points]),
            ("Title", [cell(wording.title_text(point.title)) for point in points]),
            ("Space", [cell(point.space) if with_space else "" for point in points]),
            ("Wire address", [wording.words_text(point) for point in points]),
            ("Index", ["" if point.index is None else str(point.index) for point in points]),
            *references,
            ("Type", [meaning.type for meaning in said]),
            ("Access", [meaning.access for meaning in said]),
            ("Range", [meaning.range for meaning in said]),
            ("Raw range", [meaning.raw_range for meaning in said]),
            ("Scale", [meaning.scale for meaning in said]),
            ("Default", [meaning.default for meaning in said]),
            ("Remarks", [meaning.remarks_on(point) for meaning, point in zip(said, points, strict=True)]),
            ("Source", [cell(source_text(point.source, several)) for point in points]),
        ]
    )


def _meaning(device: Device, point: Point, by_name: Mapping[str, Point]) -> _Meaning:
    return _Meaning(
        wording.type_text(point),
        point.access,
        "" if point.flags else cell(wording.range_text(point, by_name)),
        cell(wording.raw_range_text(point)) if _has_rule(point) else "",
        cell(wording.scale_text(point, by_name)),
        cell(wording.default_text(point)),
        "; ".join(_remarks(device, point, by_name)),
    )


def _has_rule(point: Point) -> bool:
    return point.scale is not None or fixed_rule(point) is None or any(not isinstance(end, int) for end in _ends(point))


def _ends(point: Point) -> Iterator[object]:
    for interval in point.allowed.intervals:
        yield interval.low
        yield interval.high


def _remarks(device: Device, point: Point, by_name: Mapping[str, Point]) -> Iterator[str]:
    """Everything that has no column of its own: short facts first, errata last."""
    if point.variant:
        yield cell(f"only {point.variant}")
    yield from _repeated(point)
    yield from _names(point)
    yield from (cell(wording.special_text(special, point.width)) for special in point.specials if special.own)
    if point.specials_of:
        yield f"special codes of {link('codes', point.specials_of)}"
    if point.steps:
        yield cell("steps: " + wording.steps_text(point))
    if point.display is not None:
        yield cell(wording.display_text(point))
    if point.write_place is not None:
        yield cell(f"written at {wording.write_place_text(point)}")
    yield from map(cell, wording.width_texts(point))
    yield from _conditions(device, point, by_name)
    if point.note:
        yield cell(wording.title_text(point.note).rstrip("."))
    yield from (f"erratum {link('erratum', erratum)}" for erratum in point.errata)
    if not point.generated:
        yield cell(f"not generated: {point.reason or 'no reason given'}")


def _repeated(point: Point) -> Iterator[str]:
    if point.record:
        yield cell(f"record {point.record}")
    if point.set is not None:
        yield f"set {point.set}"
    if point.telegram is not None:
        yield cell(f"telegram {point.telegram}")


def _names(point: Point) -> Iterator[str]:
    if point.flags:
        yield f"bits: {_BITS}"
    if point.fixed is not None:
        yield cell(wording.fixed_text(point))
    if point.digits is not None:
        yield f"names of each digit: {link('names', point.digits.enum.name)}"
    if point.enum is None:
        return
    if len(point.enum.entries) <= _INLINE_NAMES:
        yield ", ".join(cell(wording.entry_text(entry)) for entry in point.enum.entries)
    else:
        yield f"names: {link('names', point.enum.name)}"


def _conditions(device: Device, point: Point, by_name: Mapping[str, Point]) -> Iterator[str]:
    if point.keeps in _KEEPS:
        yield _KEEPS[point.keeps]
    elif point.keeps is not None:
        known = any(point.keeps == command.name for command in device.commands)
        yield f"kept after {link('command', point.keeps) if known else code(point.keeps)}"
    if point.conditions:
        yield cell("write only when: " + ", ".join(point.conditions))
    if point.when:
        yield cell(f"exists when {wording.condition_text(point.when, by_name)}")
    if point.since:
        yield cell(f"since {point.since}")
    if point.until:
        yield cell(f"until {point.until}")
    if point.changes:
        yield cell(f"changes {point.changes}")
    if point.changes_with:
        yield f"read it again after writing {', '.join(link('point', name) for name in point.changes_with)}"
    yield from (f"was {code(old)}" for old in point.was)
    if point.reserved:
        yield "reserved"


def _flag_table(point: Point) -> Table:
    rows = [
        (
            wording.flag_bits(flag, point),
            code(flag.name),
            cell(wording.title_text(flag.title)),
            "0" if flag.width == 1 and flag.active == 0 else "1" if flag.width == 1 else "",
            ", ".join(cell(wording.flag_value_text(entry)) for entry in flag.values),
        )
        for flag in point.flags
    ]
    table = by_rows(("Bits", "Name", "Title", "True when", "Values"), rows)
    assert table is not None, "a word with flags has rows"
    return table
