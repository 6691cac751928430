"""The tables of points on the page, group by group."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.facts.table import Context
from fieldscribe.grouping import grouped
from fieldscribe.model import Enum, Group, Point
from fieldscribe.targets.docs.cells import (
    LINE_BREAK,
    MARKDOWN,
    DocsScope,
    Remarks,
    anchor,
    by_rows,
    cell,
    code,
    link,
    narrow,
    narrow_link,
    narrow_target,
    numbers_head,
    numbers_text,
    paragraph,
    place_text,
    reference_heads,
    source_text,
    target,
)
from fieldscribe.targets.docs.words import word_views
from fieldscribe.wording.numbers import fixed_rule
from fieldscribe.wording.rules import RenamedPoints

_ALWAYS = ("Type", "R/W", "Range", "Unit", "Raw range", "Scale", "Remarks", "Source")
"""Columns that every device has: the first point that fills one changes no line of others."""
_SHORT_LIST = 4
"""Lists of at most this many names are in the row of every point that uses them; longer ones appear once in a group."""
_LONGEST_CELL = 24
"""Longer lists of names get a table below that of the points."""
_LONGEST_REMARK = 120
"""Longer notes with errata go below the table."""
_KEEPS = {
    "no": "lost when switched off",
    "yes": "kept, each write wears the memory",
    "choice": "kept when written to the EEPROM",
}


def group_views(scope: DocsScope) -> Iterator[dict[str, object]]:
    """Yield all groups that have points or a note, in the author's order."""
    members = grouped((point.terms.group, point) for point in scope.device.points)
    rows = _Rows(scope)
    for group in scope.device.groups:
        if group.name in members or group.note:
            yield _group_view(group, members.get(group.name, []), rows)


def _group_view(group: Group, points: list[Point], rows: _Rows) -> dict[str, object]:
    spaces = {point.terms.space for point in points}
    source = source_text(group.source, rows.scope.several)
    facts = [f"{len(points)} point{'' if len(points) == 1 else 's'}"]
    facts += [f"space {next(iter(spaces))}"] if len(spaces) == 1 else []
    base = rows.scope.device.base_of(points[0]) if points else None
    facts += [] if base is None else [f"addresses count from {wording.base_text(base)}"]
    facts += [f"source: {source}"] if source else []
    lists = _Lists()
    return {
        "anchor": anchor("group", group.name),
        "heading": cell(wording.title_text(group.title)),
        "name": code(group.name),
        "note": paragraph(wording.title_text(group.note)) if group.note else "",
        "facts": cell("; ".join(facts)),
        "points": rows.table(points, lists, with_space=len(spaces) > 1),
        "more": "".join(map(rows.more, filter(rows.has_more, points))),
        "words": list(word_views(points)),
        "lists": list(lists.views()),
    }


class _Cells(NamedTuple):
    """The cells that points with the same shape, terms and limits share; `names` are short lists of named numbers."""

    space: str
    type: str
    access: str
    unit: str
    scale: str
    names: str
    range: str
    raw_range: str


class _Rows:
    """Builds the rows of points; cells that points share are built once."""

    def __init__(self, scope: DocsScope) -> None:
        self.scope = scope
        errata = scope.device.errata
        self._doubts = {each.id: ", ".join(text for _, text in each.leaves_open) for each in errata if each.leaves_open}
        further: dict[str, Callable[[Point], str]] = {
            "words": lambda point: f"bits: {narrow_link('bits', point.item)}" if point.shape.flags else "",
            "special_of": lambda point: (
                point.specials_of and f"special codes of {narrow_link('codes', point.specials_of)}"
            ),
            "persistence": self._persistence,
            "when": self._when,
            "changes_with": partial(_other_points, "read it again after writing", "changes_with"),
            "write_with": partial(_other_points, "write it in one request with", "write_with"),
            "was": lambda point: "; ".join([f"was {code(old)}" for old in point.was]),
            "note": lambda point: _more_link(point) if self.has_more(point) else _note(point),
            "errata": self._errata,
        }
        self._remarks = Remarks(Context(scope.device, names=scope.by_code), cell, further)
        self._cells: dict[tuple[int, int, int], _Cells] = {}

    def table(self, points: Sequence[Point], lists: _Lists, *, with_space: bool) -> str:
        """Return the table of a group."""
        references = reference_heads(points)
        heads = ("Code", "Name", "Space", "Wire address", "Index", numbers_head(references), *_ALWAYS)
        rows = [self._row(point, lists, references, with_space) for point in points]
        return by_rows(heads, rows, always=_ALWAYS)

    def _row(self, point: Point, lists: _Lists, references: tuple[str, ...], with_space: bool) -> tuple[str, ...]:
        key = id(point.shape), id(point.terms), id(point.allowed)
        cells = self._cells.get(key)
        if cells is None:
            cells = self._cells[key] = self._shared_cells(point)
        remarks = lists.cell_of(point), cells.names, self._remarks.of(point)
        name = narrow_target("point", point.item if point.variant else point.name)
        return (
            narrow(cell(point.code)) if point.code else "",
            f"{name}{LINE_BREAK}{cell(wording.title_text(point.title))}",
            cells.space if with_space else "",
            place_text(point),
            "" if point.index is None else str(point.index),
            numbers_text(point.place.references, references),
            cells.type,
            cells.access,
            _with_default(point, cells.range),
            cells.unit,
            cells.raw_range,
            cells.scale,
            LINE_BREAK.join(filter(None, remarks)),
            MARKDOWN.source(point.source, self.scope.several),
        )

    def _shared_cells(self, point: Point) -> _Cells:
        scale = narrow(cell(wording.formula_text(point, self.scope.by_code)))
        enum = point.shape.enum
        names = (
            [_listed(enum, patterns=point.patterns)] if enum is not None and len(enum.entries) <= _SHORT_LIST else []
        )
        unshared = [special for special in point.shape.specials if not special.shared]
        names += [narrow(cell(wording.special_text(special, point.shape.width))) for special in unshared]
        unit, type_text = cell(point.unit.symbol), wording.type_text(point)
        limits = _limits(point, self.scope.by_code)
        return _Cells(cell(point.space), type_text, point.access, unit, scale, LINE_BREAK.join(names), *limits)

    def _errata(self, point: Point) -> str:
        if self.has_more(point):
            return "" if point.note else _more_link(point)
        return self._errata_with(narrow_link, point)

    def _errata_with(self, linked: Callable[[str, str], str], point: Point) -> str:
        """Return the errata of a point, with what they leave open."""
        links = ", ".join([linked("erratum", erratum) for erratum in point.errata if erratum not in self._doubts])
        doubts = [
            f"{cell(self._doubts[name])} ({linked('erratum', name)})" for name in point.errata if name in self._doubts
        ]
        known = f"{'erratum' if len(point.errata) - len(doubts) == 1 else 'errata'} {links}" if links else ""
        return "; ".join(filter(None, (known, f"the manual leaves open {', '.join(doubts)}" if doubts else "")))

    def has_more(self, point: Point) -> bool:
        """Return True if note and errata are too long for the row."""
        if not (point.note or point.errata):
            return False
        size = sum(len(self._doubts.get(name, name)) for name in point.errata)
        return len(wording.title_text(point.note) if point.note else "") + size > _LONGEST_REMARK

    def more(self, point: Point) -> str:
        """Return the line below the table with the note and the errata of a point."""
        texts = "; ".join(filter(None, (_note(point), self._errata_with(link, point))))
        return f"- {target('more', point.item)}: {texts}\n"

    def _when(self, point: Point) -> str:
        text = wording.condition_text(point.when, self.scope.by_code)
        return narrow(cell(f"exists when {text}")) if text else ""

    def _persistence(self, point: Point) -> str:
        keeps = point.terms.keeps
        if keeps is None or keeps in _KEEPS:
            return _KEEPS.get(keeps or "", "")
        known = any(keeps == command.name for command in self.scope.device.commands)
        return f"kept after {narrow_link('command', keeps) if known else code(keeps)}"


def _limits(point: Point, by_code: RenamedPoints) -> tuple[str, str]:
    """Return the range without its unit, and the raw range if it adds something; other points appear by code."""
    span = "" if point.flags else wording.range_text(point, by_code, unit=False)
    if point.scale is None and not point.allowed.moves and fixed_rule(point) is not None:
        return narrow(cell(span)), ""
    raw = wording.raw_range_text(point, RenamedPoints({}, by_code.names) if point.allowed.moves else None)
    return narrow(cell(span)), narrow(cell(raw))


def _with_default(point: Point, allowed: str) -> str:
    """Return the range, and below it the default: few points have one, so a column of its own would be mostly empty."""
    if point.default is None and point.default_raw is None:
        return allowed
    text = wording.default_parts(point) or wording.default_text(point, unit=False)
    default = f"default {narrow(cell(text))}"
    return f"{allowed}{LINE_BREAK}{default}" if allowed else default


def _other_points(what: str, attribute: str, point: Point) -> str:
    names = ", ".join(narrow_link("point", name) for name in getattr(point, attribute))
    return names and f"{what} {names}"


def _more_link(point: Point) -> str:
    return f"[more below](#{anchor('more', point.item)})"


def _note(point: Point) -> str:
    return cell(wording.title_text(point.note).rstrip(".")) if point.note else ""


class _Lists:
    """The long lists of names in a group; each is shown once, at the first point that uses it."""

    def __init__(self) -> None:
        self._first: dict[int, str] = {}
        self._users: dict[str, tuple[Enum, list[str]]] = {}

    def cell_of(self, point: Point) -> str:
        """Return the list of a point or a link to it; empty without one, and for a short one."""
        shape = point.shape
        enum = shape.named_numbers
        if enum is None or (shape.digits is None and len(enum.entries) <= _SHORT_LIST):
            return ""
        before = "each digit: " if shape.digits else ""
        first = self._first.setdefault(id(enum.entries), point.item)
        if len(enum.entries) > _LONGEST_CELL:
            self._users.setdefault(first, (enum, []))[1].append(point.item)
            return f"{before}[numbers below](#{anchor('numbers', first)})"
        return before + (
            _listed(enum, patterns=point.patterns)
            if first == point.item
            else f"numbers as of {narrow_link('point', first)}"
        )

    def views(self) -> Iterator[dict[str, str]]:
        """Yield the lists that go below the table."""
        for first, (enum, users) in self._users.items():
            points = ", ".join(link("point", item) for item in users)
            rows = [
                (str(entry.raw), code(entry.name), cell(wording.title_text(entry.title)), cell(entry.quantity or ""))
                for entry in enum.entries
            ]
            table = by_rows(("Raw", "Name", "Title", "Quantity"), rows)
            yield {"anchor": anchor("numbers", first), "points": points, "rows": table}


def _listed(enum: Enum, *, patterns: bool) -> str:
    """Return the names of an enum, each on its own line."""
    return LINE_BREAK.join(narrow(cell(wording.entry_text(entry, patterns=patterns))) for entry in enum.entries)
