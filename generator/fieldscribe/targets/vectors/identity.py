"""Vectors of the identity of a point: its places, references, old names, type and limits.

Points whose identities have the same form share one text template, which each fills with its own words.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.lowered.templates import TextTemplate, placeholders
from fieldscribe.model import item_of
from fieldscribe.targets.vectors.kinds import Written, text, word
from fieldscribe.targets.vectors.oracle import outer_bounds
from fieldscribe.text import line

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from fieldscribe.conditions import Condition
    from fieldscribe.model import Point, Shape, Terms
    from fieldscribe.targets.vectors.lines import Lines


class Form(NamedTuple):
    """All facts that the lines of an identity depend on, except its words; those of shape and terms come first."""

    type: str
    words: int
    decimals: int | None
    """Decimals of counts; None if there are no counts."""
    display: int | None
    space: str
    has_limits: bool
    symbol: str
    changes: str | None
    changes_with: tuple[str, ...]
    only_for: tuple[str, ...] | None
    has_address: bool
    has_code: bool
    references: tuple[str, ...]
    placed: tuple[tuple[int, ...], int | None, str | None] | None
    """Addresses, index and telegram, if the lowest address does not identify the point."""
    default: float | None
    variant: str | None
    written: tuple[str, tuple[int, ...]] | None
    """Space and addresses for writing, if they differ from those for reading."""
    aliases: tuple[str, ...]


class Identities:
    """The identities of the points of a device."""

    def __init__(self, lines: Lines, variants: Mapping[str, tuple[str, ...]]) -> None:
        self._lines, self._variants = lines, variants
        self._parts: dict[tuple[object, ...], tuple[Lines, TextTemplate]] = {}
        self._shared: dict[tuple[int, int], tuple[tuple[object, ...], str]] = {}

    def add(self, point: Point) -> None:
        """Set the point and add its own facts: a target that shares too much between points gets these wrong."""
        shape, terms = point.shape, point.terms
        shared = self._shared.get((id(shape), id(terms)))
        if shared is None:
            shared = self._shared[id(shape), id(terms)] = self._in_common(shape, terms), word(terms.group)
        in_common, group = shared
        form, words = in_common + _own(point), _words(point, group)
        known = self._parts.get(form)
        if known is None:
            part = self._lines.apart()
            _write(part, Form._make(form), placeholders(word and "?" for word in words))
            known = self._parts[form] = part, TextTemplate(part.joined)
        part, pattern = known
        self._lines.include(part, pattern.fill(words))

    def _in_common(self, shape: Shape, terms: Terms) -> tuple[object, ...]:
        """The first half of a form."""
        return (
            shape.type,
            shape.words,
            shape.decimals if shape.form == "scaled" else None,
            shape.display,
            terms.space,
            shape.form not in _WITHOUT_LIMITS,
            terms.unit.symbol,
            None if terms.changes == "always" else terms.changes,
            terms.changes_with,
            None if terms.when is None else _only_for(terms.when, self._variants),
        )


_WITHOUT_LIMITS = ("float", "text", "digits")


def _own(point: Point) -> tuple[object, ...]:
    """The second half of the form of a point."""
    addresses, elsewhere, telegram = point.place.addresses, point.write_place, point.terms.telegram
    special = point.index is not None or telegram is not None or point.shape.text is not None
    return (
        bool(addresses),
        point.code is not None,
        tuple(point.place.references),
        (addresses, point.index, telegram) if special else None,
        None if point.default is None else float(point.default),
        None if point.variant is None else str(point.variant),
        None if elsewhere is None else (point.terms.space, elsewhere.addresses),
        tuple([item_of(old, point.variant) for old in point.was]) if point.was else (),
    )


def _words(point: Point, group: str) -> tuple[str, ...]:
    """Return the words that differ from point to point, in the notation of their fields."""
    shape, place, name, code = point.shape, point.place, word(point.name), point.code
    low, high = outer_bounds(shape, point.allowed) if shape.form not in _WITHOUT_LIMITS else ("", "")
    return (
        name if point.variant is None else word(point.item),
        name,
        group,
        str(min(place.addresses)) if place.addresses else "",
        "" if code is None else text(line(code)),
        str(low),
        str(high),
        *[str(number) if type(number) is int else text(line(str(number))) for number in place.references.values()],
    )


def _write(lines: Lines, form: Form, words: Iterable[str]) -> None:
    """Add the lines of a form; an empty word is absent."""
    item, name, group, address, code, low, high, *references = (Written(word) if word else None for word in words)
    lines.set("point", item)
    if form.has_address:
        printed = dict(zip(form.references, references, strict=True))
        lines.add("address", form.space, address, form.words, code, low, high, form.decimals, printed)
        if form.written is not None:
            lines.add("write_address", min(form.written[1]))
        if form.placed is not None:
            lines.add("place", *form.placed)
        if form.symbol:
            lines.add("symbol", form.symbol)
        if form.display is not None:
            lines.add("display", form.display)
    held = form.type, form.symbol or None, form.default, form.changes, form.changes_with, form.variant, form.only_for
    lines.add("facts", group, name, *held, *(form.written or ()))
    for old in form.aliases:
        lines.add("alias", old, item)


def _only_for(when: Condition, variants: Mapping[str, tuple[str, ...]]) -> tuple[str, ...] | None:
    """Return the variant axis that decides whether the point exists, then the values for which it can exist."""
    for axis in when.names:
        left = [value for value in variants.get(axis, ()) if _possible_for(when, axis, value)]
        if len(left) < len(variants.get(axis, ())):
            return (axis, *left)
    return None


def _possible_for(condition: Condition, axis: str, value: str) -> bool:
    """Return True if a clause of the condition can hold for this value of the axis."""
    return any(
        all(comparison.of != axis or comparison.holds(value) for comparison in clause) for clause in condition.clauses
    )
