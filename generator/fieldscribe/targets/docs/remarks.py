"""The remarks in the row of a point: all that no other column says."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.targets.docs.cells import cell, code, link

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Point
    from fieldscribe.targets.docs.subjects import Scope

_INLINE_NAMES = 4
"""An enum with at most so many names is shown in the point's row; a longer one is linked."""

_KEEPS = {
    "no": "lost when switched off",
    "yes": "kept, each write wears the memory",
    "choice": "kept when written to the EEPROM",
}


class OwnRemarks(NamedTuple):
    """What a point remarks of itself, as finished Markdown; most points say nothing."""

    variant: str = ""
    record: str = ""
    set: str = ""
    bits: str = ""
    names: str = ""
    written: str = ""
    was: str = ""
    note: str = ""
    errata: str = ""


NO_REMARKS = OwnRemarks()


def own_remarks(point: Point) -> OwnRemarks:
    """The remarks that tell a point from others of its kin."""
    flags, enum = point.shape.flags, point.shape.enum
    linked = enum is not None and len(enum.entries) > _INLINE_NAMES
    told = point.variant or point.record or point.write_place or point.was or point.note or point.errata
    if not (told or flags or linked) and point.set is None:
        return NO_REMARKS
    return OwnRemarks(
        cell(f"only {point.variant}") if point.variant else "",
        cell(f"record {point.record}") if point.record else "",
        "" if point.set is None else f"set {point.set}",
        link("bits", point.item) if flags else "",
        link("names", enum.name) if enum is not None and linked else "",
        cell(f"written at {wording.write_place_text(point)}") if point.write_place else "",
        "; ".join([f"was {code(old)}" for old in point.was]),
        cell(wording.title_text(point.note).rstrip(".")) if point.note else "",
        "; ".join([f"erratum {link('erratum', erratum)}" for erratum in point.errata]),
    )


def form_of(own: OwnRemarks) -> tuple[bool, ...]:
    """Which remarks there are."""
    return () if own is NO_REMARKS else tuple(map(bool, own))


def remarks(scope: Scope, point: Point, own: OwnRemarks) -> Iterator[str]:
    """All remarks, short facts first, errata last; `own` are those of the point itself, or blanks for them."""
    shape, terms = point.shape, point.terms
    yield from (own.variant, own.record, own.set)
    if terms.telegram is not None:
        yield cell(f"telegram {terms.telegram}")
    yield from _names(point, own)
    yield from (cell(wording.special_text(special, shape.width)) for special in shape.specials if special.own)
    if shape.specials_of:
        yield f"special codes of {link('codes', shape.specials_of)}"
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


def _names(point: Point, own: OwnRemarks) -> Iterator[str]:
    if own.bits:
        yield f"bits: {own.bits}"
    if point.fixed is not None:
        yield cell(wording.fixed_text(point))
    if point.digits is not None:
        yield f"names of each digit: {link('names', point.digits.enum.name)}"
    if own.names:
        yield f"names: {own.names}"
    elif point.enum is not None:
        yield ", ".join(cell(wording.entry_text(entry)) for entry in point.enum.entries)


def _conditions(scope: Scope, point: Point) -> Iterator[str]:
    terms = point.terms
    if terms.keeps in _KEEPS:
        yield _KEEPS[terms.keeps]
    elif terms.keeps is not None:
        known = any(terms.keeps == command.name for command in scope.device.commands)
        yield f"kept after {link('command', terms.keeps) if known else code(terms.keeps)}"
    if terms.conditions:
        yield cell("write only when: " + ", ".join(terms.conditions))
    if terms.when:
        yield cell(f"exists when {wording.condition_text(terms.when, scope.by_name)}")
    if terms.since:
        yield cell(f"since {terms.since}")
    if terms.until:
        yield cell(f"until {terms.until}")
    if terms.changes:
        yield cell(f"changes {terms.changes}")
    if terms.changes_with:
        yield f"read it again after writing {', '.join(link('point', name) for name in terms.changes_with)}"
