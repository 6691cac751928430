"""The tables of points, group by group, and the tables of the bits inside their words."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.patterns import Pattern, blanks
from fieldscribe.records import dataclass
from fieldscribe.targets.docs.cells import (
    anchor,
    by_rows,
    cell,
    code,
    number_cell,
    paragraph,
    source_cell,
    source_text,
    target,
)
from fieldscribe.targets.docs.remarks import OwnRemarks, form_of, own_remarks, remarks
from fieldscribe.targets.docs.subjects import reference_heads

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.model import Group, Point
    from fieldscribe.targets.docs.subjects import Scope, Subject

_FACTS = ("Type", "Access", "Range", "Raw range", "Scale", "Default", "Remarks", "Source")


@dataclass(frozen=True, slots=True)
class FlagsView:
    """The bits of one word."""

    point: str
    rows: str


@dataclass(frozen=True, slots=True)
class GroupView:
    """A group of points on the page."""

    anchor: str
    heading: str
    name: str
    note: str
    facts: str
    points: str
    flags: tuple[FlagsView, ...]


class _Kin(NamedTuple):
    """The cells that points have alike."""

    space: str
    meaning: tuple[str, str]
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
    return GroupView(
        anchor=anchor("group", group.name),
        heading=cell(wording.title_text(group.title)),
        name=code(group.name),
        note=paragraph(wording.title_text(group.note)) if group.note else "",
        facts=cell("; ".join(facts)),
        points=rows.table(subjects, with_space=len(spaces) > 1),
        flags=tuple(rows.flags(subjects)),
    )


class _Rows:
    """The rows of points: what points say alike is laid out once, what each says of itself fills it."""

    def __init__(self, scope: Scope) -> None:
        self.scope = scope
        self._kins: dict[int, _Kin] = {}
        self._remarks: dict[tuple[int, tuple[bool, ...]], Pattern] = {}
        self._flags: dict[int, str] = {}

    def table(self, subjects: Sequence[Subject], *, with_space: bool) -> str:
        """The table of a group."""
        references = reference_heads(point for point, *_ in subjects)
        heads = (
            *("Code", "Name", "Title", "Space", "Wire address", "Index"),
            *(cell(key.capitalize()) for key in references),
            *_FACTS,
        )
        return by_rows(heads, [self._row(subject, references, with_space) for subject in subjects], always=_FACTS)

    def flags(self, subjects: Sequence[Subject]) -> Iterator[FlagsView]:
        """The tables of bits of those points that have named ones."""
        for point, kin, _ in subjects:
            if point.shape.flags:
                rows = self._flags.get(kin)
                if rows is None:
                    rows = self._flags[kin] = _flag_table(point)
                yield FlagsView(target("bits", point.item), rows)

    def _row(self, subject: Subject, references: tuple[str, ...], with_space: bool) -> tuple[str, ...]:
        point, number, limits = subject
        kin = self._kins.get(number)
        if kin is None:
            kin = self._kins[number] = self._kin(point)
        return (
            cell(point.code) if point.code else "",
            target("point", point.item if point.variant else point.name),
            cell(wording.title_text(point.title)),
            kin.space if with_space else "",
            wording.words_text(point),
            "" if point.index is None else str(point.index),
            *[number_cell(point.place.references.get(key, "")) for key in references],
            *kin.meaning,
            *limits.page,
            kin.scale,
            "" if point.default is None and point.default_raw is None else cell(wording.default_text(point)),
            self._remarks_cell(point, number),
            source_cell(point.source, self.scope.several),
        )

    def _kin(self, point: Point) -> _Kin:
        scale = cell(wording.scale_text(point, self.scope.by_name))
        return _Kin(cell(point.space), (wording.type_text(point), point.access), scale)

    def _remarks_cell(self, point: Point, kin: int) -> str:
        own = own_remarks(point)
        form = form_of(own)
        pattern = self._remarks.get((kin, form))
        if pattern is None:
            shown = remarks(self.scope, point, OwnRemarks(*blanks(own)))
            pattern = self._remarks[kin, form] = Pattern("; ".join(filter(None, shown)))
        return pattern.filled(own)


def _flag_table(point: Point) -> str:
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
    return by_rows(("Bits", "Name", "Title", "True when", "Values"), rows)
