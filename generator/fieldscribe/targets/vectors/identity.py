"""Vectors of what tells a point from others: its places, references, old names, type and limits, read from the point.

Points whose identities have the same form share one pattern, into which each puts its own words.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.model import item_of
from fieldscribe.patterns import Pattern, blanks
from fieldscribe.targets.vectors.kinds import Written, text, word
from fieldscribe.targets.vectors.oracle import outer_bounds
from fieldscribe.text import line

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from fieldscribe.existence import Condition
    from fieldscribe.model import Point
    from fieldscribe.targets.vectors.lines import Lines


class Form(NamedTuple):
    """All that the lines of an identity follow from beside its words."""

    type: str
    words: int
    decimals: int | None
    """Of counts, where there are some."""
    display: int | None
    space: str | None
    """None without an address."""
    has_code: bool
    has_limits: bool
    references: tuple[str, ...]
    placed: tuple[tuple[int, ...], int | None, str | None] | None
    """Addresses, index and telegram of a point that its lowest address does not find."""
    symbol: str
    default: float | None
    changes: str | None
    changes_with: tuple[str, ...]
    variant: str | None
    only_for: tuple[str, ...] | None
    written: tuple[str, tuple[int, ...]] | None
    """The space and the addresses where the point is written, if not where it is read."""
    aliases: tuple[str, ...]


class Identities:
    """The identities of the points of a device."""

    def __init__(self, lines: Lines, variants: Mapping[str, tuple[str, ...]]) -> None:
        self._lines, self._variants = lines, variants
        self._parts: dict[Form, tuple[Lines, Pattern]] = {}

    def add(self, point: Point) -> None:
        """Name the point, and add what is its own: facts in which whoever shares too much goes wrong."""
        form, words = self._form(point), _words(point)
        known = self._parts.get(form)
        if known is None:
            part = self._lines.apart()
            _write(part, form, blanks(word and "?" for word in words))
            known = self._parts[form] = part, Pattern(part.joined)
        part, pattern = known
        self._lines.set("point", point.item)
        self._lines.include(part, pattern.filled(words))

    def _form(self, point: Point) -> Form:
        shape, terms, elsewhere = point.shape, point.terms, point.write_place
        special = point.index is not None or terms.telegram is not None or shape.text is not None
        return Form(
            shape.type,
            shape.words,
            shape.decimals if shape.form == "scaled" else None,
            shape.display,
            terms.space if point.addresses else None,
            point.code is not None,
            shape.form not in _WITHOUT_LIMITS,
            tuple(point.references),
            (point.addresses, point.index, terms.telegram) if special else None,
            terms.unit.symbol,
            None if point.default is None else float(point.default),
            None if terms.changes == "always" else terms.changes,
            terms.changes_with,
            None if point.variant is None else str(point.variant),
            None if terms.when is None else _only_for(terms.when, self._variants),
            None if elsewhere is None else (terms.space, elsewhere.addresses),
            tuple([item_of(old, point.variant) for old in point.was]) if point.was else (),
        )


_WITHOUT_LIMITS = ("float", "text", "digits")


def _words(point: Point) -> tuple[str, ...]:
    """What most points have of their own, in the notation of its field."""
    shape, addresses = point.shape, point.addresses
    low, high = outer_bounds(shape, point.allowed) if shape.form not in _WITHOUT_LIMITS else ("", "")
    return (
        word(point.item),
        word(point.name),
        word(point.group),
        str(min(addresses)) if addresses else "",
        "" if point.code is None else text(line(point.code)),
        str(low),
        str(high),
        *[str(number) if type(number) is int else text(line(str(number))) for number in point.references.values()],
    )


def _write(lines: Lines, form: Form, words: Iterable[str]) -> None:
    """The lines of a form; a word that is empty is absent."""
    item, name, group, address, code, low, high, *references = (Written(word) if word else None for word in words)
    if form.space is not None:
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
    """The axis that decides whether the point exists, followed by the values for which it can."""
    for axis in when.names:
        left = [value for value in variants.get(axis, ()) if _possible_for(when, axis, value)]
        if len(left) < len(variants.get(axis, ())):
            return (axis, *left)
    return None


def _possible_for(condition: Condition, axis: str, value: str) -> bool:
    """Whether some clause of the condition can hold for this value of the axis."""
    return any(
        all(comparison.of != axis or comparison.holds(value) for comparison in clause) for clause in condition.clauses
    )
