"""The interface by which a family reads keys that only it has, with defaults for families that have none."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from fieldscribe.families import families
from fieldscribe.language.nodes import Map
from fieldscribe.model import Block, Bus, Code, FamilyFacts, Message, Point, Telegram
from fieldscribe.resolve.scope import Scope


class FamilyReader:
    """Reads the facts that only one family has. A family offers its reader as `READING` in its module `reading`."""

    def bus(self, scope: Scope, node: Map, functions: tuple[Code, ...]) -> FamilyFacts | None:
        """Return what only the family knows of the bus; report what its protocol cannot do."""

    def frame(self, scope: Scope, node: Map, framing: str) -> FamilyFacts | None:
        """Return what only the family knows of a worked example."""

    def refuses(self, scope: Scope, bus: Bus, node: Map) -> bool:
        """Report a worked example that cannot be one of this bus, and return True for it."""
        del scope, bus, node
        return False

    def messages(self, scope: Scope, bus: Bus) -> tuple[Message, ...]:
        """Return the messages that the description lays out."""
        del bus
        laid_out = " and ".join(family.name for family in families() if family.lays_out_messages)
        for node in scope.listed("messages"):
            hint = f"leave it out: the frames of {scope.family.name} are known"
            scope.report.error("family-key", f"messages are for the family {laid_out}", node.span("name"), hint)
        return ()

    def telegram(self, scope: Scope, node: Map, before: Sequence[Telegram]) -> None:
        """Report a telegram that the family's own frames cannot carry."""

    def writes(self, space: str) -> tuple[int, ...]:
        """Return the functions that write into a space."""
        del space
        return ()

    def blocks(
        self, bus: Bus, points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]
    ) -> tuple[Block, ...] | None:
        """Return the reads that bring all points of a group; None if the family plans none."""


def reader_of(scope: Scope) -> FamilyReader:
    """Return the reader of the device's family."""
    part = scope.family.part("reading")
    reading: FamilyReader = part.READING if part is not None else FamilyReader()
    return reading
