"""How the family of a device reads keys that only it has, with defaults for families that have none."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families import families

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from fieldscribe.language.nodes import Map
    from fieldscribe.model import Block, Bus, Code, Message, Own, Point, Telegram
    from fieldscribe.resolve.scope import Scope


class FamilyReader:
    """Reads the facts that only one family has; a family offers its own reader as `READING` in its module `reading`."""

    def bus(self, scope: Scope, node: Map, functions: tuple[Code, ...]) -> Own | None:
        """What the family alone knows of the bus, with findings for what its protocol cannot do."""
        del scope, node, functions
        return None

    def frame(self, scope: Scope, node: Map, framing: str) -> Own | None:
        """What the family alone knows of a worked example."""
        del scope, node, framing
        return None

    def refuses(self, scope: Scope, bus: Bus, node: Map) -> bool:
        """Whether a worked example cannot be one of this bus, with a finding."""
        del scope, bus, node
        return False

    def messages(self, scope: Scope, bus: Bus) -> tuple[Message, ...]:
        """The messages that the description lays out."""
        del bus
        laid_out = " and ".join(family.name for family in families() if family.lays_out_messages)
        for node in scope.listed("messages"):
            hint = f"leave it out: the frames of {scope.family.name} are known"
            scope.report.error("family-key", f"messages are for the family {laid_out}", node.span("name"), hint)
        return ()

    def telegram(self, scope: Scope, node: Map, before: Sequence[Telegram]) -> None:
        """Findings for a telegram that the family's own frames cannot carry."""

    def writes(self, space: str) -> tuple[int, ...]:
        """The functions that write into a space."""
        del space
        return ()

    def blocks(
        self, bus: Bus, points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]
    ) -> tuple[Block, ...] | None:
        """The reads that bring all points of a group; None where the family plans none."""
        del bus, points, variants
        return None


def reader_of(scope: Scope) -> FamilyReader:
    """How the device's family reads its own keys."""
    part = scope.family.part("reading")
    reading: FamilyReader = part.READING if part is not None else FamilyReader()
    return reading
