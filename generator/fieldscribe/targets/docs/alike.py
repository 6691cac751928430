"""What the documentation says alike of many points is worded once: everything but their identity."""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

    from fieldscribe.model import Point

Worded = TypeVar("Worded")


class Alike(Generic[Worded]):
    """Texts about points, each worded once for all points that it is true of."""

    def __init__(self, word: Callable[[Point], Worded]) -> None:
        """`word` makes the texts. It may look at all facts of a point that are in the key, and at no others."""
        self._word = word
        self._met: dict[Hashable, Worded] = {}

    def of(self, point: Point) -> Worded:
        """What is said of this point."""
        key = _key(point)
        worded = self._met.get(key)
        if worded is None:
            worded = self._met[key] = self._word(point)
        return worded


def _key(point: Point) -> Hashable:
    """All facts of a point but its identity; what points share as an object is compared as one, which is quick."""
    return (
        id(point.shape),
        id(point.terms),
        id(point.allowed),
        None if point.write_place is None else id(point.write_place),
        point.variant,
        point.default,
        point.default_raw,
        point.record,
        point.set,
        point.was,
        point.errata,
        len(point.addresses) if point.terms.untyped is not None else 0,
        (*point.note.items(),) if point.note else (),
    )
