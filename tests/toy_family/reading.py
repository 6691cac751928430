"""How a bell's own keys are read: how often it may be struck."""

from __future__ import annotations

from fieldscribe.language.nodes import Map
from fieldscribe.model import Code
from fieldscribe.resolve.bus import FamilyReader
from fieldscribe.resolve.scope import Scope

from toy_family import BellBus


class BellReading(FamilyReader):
    """Bells have one fact of their own."""

    def bus(self, scope: Scope, raw: Map, functions: tuple[Code, ...]) -> BellBus:
        """How often a bell may be struck."""
        del scope, functions
        return BellBus(raw.get("strikes", 60))


READING = BellReading()
