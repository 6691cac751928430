"""Template keys: which points have the same text but for their fields.

A target formats the fields of a point (its name, code, addresses, references, limits), lays its text out once with
placeholders as wide as the fields, and fills it for every point with the same key and field widths.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import replace

from fieldscribe.model import Allowed, Point, Shape, Terms


class TemplateKeys:
    """Numbers points: those with the same number have the same text in every target, but for their fields.

    Fields are the name, title, code, group and source of a point, its addresses, the numbers of its references, its
    default, the ends of a single range, and the name of an enum that is called after the point.
    """

    def __init__(self) -> None:
        self._keys: dict[Hashable, int] = {}
        self._shapes: dict[int, tuple[int, int, str]] = {}
        self._terms: dict[int, int] = {}

    def of(self, point: Point) -> int:
        """Return the key of a point."""
        shape, allowed, addresses = point.shape, point.allowed, point.place.addresses
        whole, unnamed, enum = self._shapes.get(id(shape)) or self._of_shape(shape)
        if not whole or allowed.moves or point.was or point.variant is not None or point.write_place is not None:
            return self._number(point.item)
        references = point.place.references
        return self._number(
            (
                unnamed if enum == point.item else whole,
                self._terms.get(id(point.terms)) or self._of_terms(point.terms),
                -len(allowed.intervals) if _is_range(allowed) else id(allowed),
                tuple([address - addresses[0] for address in addresses]) if len(addresses) > 1 else len(addresses),
                tuple(references),
                tuple(map(type, references.values())),
                point.code is None,
                point.default is None,
                point.index,
                point.errata,
            )
        )

    def _number(self, facts: Hashable) -> int:
        return self._keys.setdefault(facts, len(self._keys) + 1)

    def _of_shape(self, shape: Shape) -> tuple[int, int, str]:
        """Return the numbers of a shape with and without the name of its enum, and that name.

        Texts, digits and scales that need other points follow from more than the shape: 0.
        """
        enum = shape.enum
        if shape.text is not None or shape.digits is not None or shape.scale_arguments:
            numbers = 0, 0, ""
        elif enum is None:
            numbers = self._number(shape), 0, ""
        else:
            facts = replace(shape, enum=None), enum.closed, id(enum.entries)
            numbers = self._number((facts, enum.name)), self._number(facts), enum.name
        self._shapes[id(shape)] = numbers
        return numbers

    def _of_terms(self, terms: Terms) -> int:
        number = self._terms[id(terms)] = self._number(replace(terms, group=""))
        return number


def _is_range(allowed: Allowed) -> bool:
    """Return True if the limits are one range of raw numbers, or none: its ends are fields."""
    return len(allowed.intervals) <= 1 and not allowed.units
