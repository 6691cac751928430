"""The remarks in the row of a point: all that no other column says."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.targets.docs.cells import LINE_BREAK, anchor, cell, code, link, narrow, narrow_link, target
from fieldscribe.targets.docs.numbers import SHORT_LIST, listed

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.model import Point
    from fieldscribe.targets.docs.subjects import Scope

_KEEPS = {
    "no": "lost when switched off",
    "yes": "kept, each write wears the memory",
    "choice": "kept when written to the EEPROM",
}


_LONGEST_REMARK = 120
"""Note and errata of more signs stand below the table."""


class OwnRemarks(NamedTuple):
    """What a point remarks of itself, as finished Markdown; most points say nothing."""

    variant: str = ""
    record: str = ""
    set: str = ""
    bits: str = ""
    numbers: str = ""
    written: str = ""
    was: str = ""
    note: str = ""
    errata: str = ""


NO_REMARKS = OwnRemarks()


def own_remarks(point: Point, numbers: str) -> OwnRemarks:
    """The remarks that tell a point from others of its kin; `numbers` is what the row says of a long list of names."""
    flags = point.shape.flags
    told = point.variant or point.record or point.write_place or point.was or point.note or point.errata
    if not (told or flags or numbers) and point.set is None:
        return NO_REMARKS
    return OwnRemarks(
        cell(f"only {point.variant}") if point.variant else "",
        cell(f"record {point.record}") if point.record else "",
        "" if point.set is None else f"set {point.set}",
        narrow_link("bits", point.item) if flags else "",
        numbers,
        cell(f"written at {wording.write_place_text(point)}") if point.write_place else "",
        "; ".join([f"was {code(old)}" for old in point.was]),
        *_note_and_errata(point),
    )


def _note_and_errata(point: Point) -> tuple[str, str]:
    if _has_more(point):
        return f"[more below](#{anchor('more', point.item)})", ""
    return _note(point), _errata(point.errata, narrow_link)


def _has_more(point: Point) -> bool:
    """Whether note and errata would make the row a tall one."""
    if not (point.note or point.errata):
        return False
    return len(wording.title_text(point.note) if point.note else "") + sum(map(len, point.errata)) > _LONGEST_REMARK


def more_below(points: Iterable[Point]) -> str:
    """The long notes and the many errata of points, as a list below their table."""
    return "".join(
        f"- {target('more', point.item)}: {'; '.join(filter(None, (_note(point), _errata(point.errata, link))))}\n"
        for point in points
        if _has_more(point)
    )


def _note(point: Point) -> str:
    return cell(wording.title_text(point.note).rstrip(".")) if point.note else ""


def _errata(ids: tuple[str, ...], linked: Callable[[str, str], str]) -> str:
    links = ", ".join([linked("erratum", erratum) for erratum in ids])
    return f"{'erratum' if len(ids) == 1 else 'errata'} {links}" if ids else ""


def form_of(own: OwnRemarks) -> tuple[bool, ...]:
    """Which remarks there are."""
    return () if own is NO_REMARKS else tuple(map(bool, own))


def remarks_text(scope: Scope, point: Point, own: OwnRemarks) -> str:
    """The whole cell: the names of numbers, each on its line, then all else in one; `own` may be blanks."""
    lines = (*_numbers(point, own), "; ".join(filter(None, _others(scope, point, own))))
    return LINE_BREAK.join(filter(None, lines))


def _numbers(point: Point, own: OwnRemarks) -> Iterator[str]:
    yield own.numbers
    enum = point.shape.enum
    if enum is not None and len(enum.entries) <= SHORT_LIST:
        yield listed(enum)
    yield from (
        narrow(cell(wording.special_text(special, point.shape.width)))
        for special in point.shape.specials
        if special.own
    )


def _others(scope: Scope, point: Point, own: OwnRemarks) -> Iterator[str]:
    """Short facts first, errata last."""
    shape, terms = point.shape, point.terms
    yield from (own.variant, own.record, own.set)
    if terms.telegram is not None:
        yield cell(f"telegram {terms.telegram}")
    if own.bits:
        yield f"bits: {own.bits}"
    yield cell(wording.shared_text(point))
    if shape.fixed is not None:
        yield cell(wording.fixed_text(point))
    if shape.specials_of:
        yield f"special codes of {narrow_link('codes', shape.specials_of)}"
    if terms.steps:
        yield cell("steps: " + wording.steps_text(point))
    if shape.display is not None:
        yield cell(wording.display_text(point))
    yield own.written
    yield from map(cell, wording.width_texts(point))
    yield from _conditions(scope, point)
    yield own.was
    if terms.reserved:
        yield "reserved"
    yield own.note
    yield own.errata
    if not terms.generated:
        yield cell(f"not generated: {terms.reason or 'no reason given'}")


def _conditions(scope: Scope, point: Point) -> Iterator[str]:
    terms = point.terms
    if terms.keeps in _KEEPS:
        yield _KEEPS[terms.keeps]
    elif terms.keeps is not None:
        known = any(terms.keeps == command.name for command in scope.device.commands)
        yield f"kept after {narrow_link('command', terms.keeps) if known else code(terms.keeps)}"
    if terms.conditions:
        yield cell("write only when: " + ", ".join(terms.conditions))
    if terms.when:
        yield narrow(cell(f"exists when {wording.condition_text(terms.when, scope.by_code)}"))
    if terms.since:
        yield cell(f"since {terms.since}")
    if terms.until:
        yield cell(f"until {terms.until}")
    if terms.changes:
        yield cell(f"changes {terms.changes}")
    if terms.changes_with:
        yield f"read it again after writing {', '.join(narrow_link('point', name) for name in terms.changes_with)}"
