"""One object for all that is equal, so that what follows from it is worked out once."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.model.rules import Allowed
    from fieldscribe.model.shape import Shape


class Interner:
    """The shapes of a device's points, and what they allow, each once."""

    def __init__(self) -> None:
        self._shapes: dict[Shape, Shape] = {}
        self._allowed: dict[Allowed, Allowed] = {}

    def shape(self, shape: Shape) -> Shape:
        """The first shape that is equal."""
        return self._shapes.setdefault(shape, shape)

    def allowed(self, allowed: Allowed) -> Allowed:
        """The first limits that are equal."""
        return self._allowed.setdefault(allowed, allowed)
