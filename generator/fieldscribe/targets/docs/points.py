"""The tables of points, group by group."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.lowered.templates import TextTemplate, placeholders
from fieldscribe.targets.docs.cells import (
    LINE_BREAK,
    anchor,
    by_rows,
    cell,
    code,
    narrow,
    narrow_target,
    paragraph,
    source_cell,
    source_text,
)
from fieldscribe.targets.docs.numbers import Lists
from fieldscribe.targets.docs.remarks import OwnRemarks, form_of, more_below, own_remarks, remarks_text
from fieldscribe.targets.docs.subjects import numbers_head, numbers_text, place_text, reference_heads
from fieldscribe.targets.docs.words import Words

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.model import Group, Point
    from fieldscribe.targets.docs.numbers import ListView
    from fieldscribe.targets.docs.subjects import Scope, Subject
    from fieldscribe.targets.docs.words import WordView

_FACTS = ("Type", "R/W", "Range", "Unit", "Raw range", "Scale", "Remarks", "Source")
"""Columns that every device has: the first point that says something there changes no line of others."""


@dataclass(frozen=True, slots=True)
class GroupView:
    """A group of points on the page."""

    anchor: str
    heading: str
    name: str
    note: str
    facts: str
    points: str
    more: str
    words: tuple[WordView, ...]
    lists: tuple[ListView, ...]


class _Kin(NamedTuple):
    """The cells that points have alike."""

    space: str
    meaning: tuple[str, str]
    unit: str
    scale: str


def group_views(scope: Scope) -> Iterator[GroupView]:
    """All groups that have points or a note, in the author's order."""
    members: dict[str, list[Subject]] = {}
    for subject in scope.subjects:
        members.setdefault(subject.point.terms.group, []).append(subject)
    rows = _Rows(scope)
    for group in scope.device.groups:
        if group.name in members or group.note:
            yield _group_view(group, members.get(group.name, []), rows)


def _group_view(group: Group, subjects: list[Subject], rows: _Rows) -> GroupView:
    spaces = {subject.point.terms.space for subject in subjects}
    source = source_text(group.source, rows.scope.several)
    facts = [f"{len(subjects)} point{'' if len(subjects) == 1 else 's'}"]
    facts += [f"space {next(iter(spaces))}"] if len(spaces) == 1 else []
    facts += [f"source: {source}"] if source else []
    words, lists = Words(), Lists()
    for subject in subjects:
        words.take(subject.point)
    return GroupView(
        anchor=anchor("group", group.name),
        heading=cell(wording.title_text(group.title)),
        name=code(group.name),
        note=paragraph(wording.title_text(group.note)) if group.note else "",
        facts=cell("; ".join(facts)),
        points=rows.table(subjects, lists, with_space=len(spaces) > 1),
        more=more_below(subject.point for subject in subjects),
        words=tuple(words.views()),
        lists=tuple(lists.views()),
    )


class _Rows:
    """The rows of points: what points say alike is laid out once, what each says of itself fills it."""

    def __init__(self, scope: Scope) -> None:
        self.scope = scope
        self._kins: dict[int, _Kin] = {}
        self._remarks: dict[tuple[int, tuple[bool, ...]], TextTemplate] = {}

    def table(self, subjects: Sequence[Subject], lists: Lists, *, with_space: bool) -> str:
        """The table of a group."""
        references = reference_heads(point for point, *_ in subjects)
        heads = ("Code", "Name", "Space", "Wire address", "Index", numbers_head(references), *_FACTS)
        rows = [self._row(subject, lists, references, with_space) for subject in subjects]
        return by_rows(heads, rows, always=_FACTS)

    def _row(self, subject: Subject, lists: Lists, references: tuple[str, ...], with_space: bool) -> tuple[str, ...]:
        point, number, limits = subject
        kin = self._kins.get(number)
        if kin is None:
            kin = self._kins[number] = self._kin(point)
        name = narrow_target("point", point.item if point.variant else point.name)
        return (
            cell(point.code) if point.code else "",
            f"{name}{LINE_BREAK}{cell(wording.title_text(point.title))}",
            kin.space if with_space else "",
            place_text(point),
            "" if point.index is None else str(point.index),
            numbers_text(point, references),
            *kin.meaning,
            _with_default(point, limits.page[0]),
            kin.unit,
            limits.page[1],
            kin.scale,
            self._remarks_cell(point, number, lists),
            source_cell(point.source, self.scope.several),
        )

    def _kin(self, point: Point) -> _Kin:
        scale = narrow(cell(wording.formula_text(point, self.scope.by_code)))
        return _Kin(cell(point.space), (wording.type_text(point), point.access), cell(point.unit.symbol), scale)

    def _remarks_cell(self, point: Point, kin: int, lists: Lists) -> str:
        own = own_remarks(point, lists.said(point))
        form = form_of(own)
        pattern = self._remarks.get((kin, form))
        if pattern is None:
            text = remarks_text(self.scope, point, OwnRemarks(*placeholders(own)))
            pattern = self._remarks[kin, form] = TextTemplate(text)
        return pattern.fill(own)


def _with_default(point: Point, allowed: str) -> str:
    """The range, and below it the factory setting: few points have one, so a column of its own would be empty."""
    if point.default is None and point.default_raw is None:
        return allowed
    text = wording.default_parts(point) or wording.default_text(point, unit=False)
    default = f"default {narrow(cell(text))}"
    return f"{allowed}{LINE_BREAK}{default}" if allowed else default
