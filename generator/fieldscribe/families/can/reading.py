"""Reads the family's own facts from the description."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.can.facts import CanBus, CanExample
from fieldscribe.families.can.messages import messages_of
from fieldscribe.resolve.families import Reading
from fieldscribe.resolve.values import integer

if TYPE_CHECKING:
    from fieldscribe.language.nodes import Map
    from fieldscribe.model import Bus, Code, Message
    from fieldscribe.resolve.scope import Scope


class CanReading(Reading):
    """Frames have an identifier, and the description lays out their bytes."""

    def bus(self, scope: Scope, node: Map, functions: tuple[Code, ...]) -> CanBus:
        """How fast the bus is, and how long its identifiers are."""
        del scope, functions
        return CanBus(node.get("bitrate"), node.get("identifier_bits"))

    def frame(self, scope: Scope, node: Map, framing: str) -> CanExample:
        """The identifier of a frame; a finding where there is none."""
        del framing
        if "can_id" in node:
            return CanExample(integer(node["can_id"], node.span("can_id"), scope.report))
        if "can_id" not in node.broken:
            message = f"the frame `{node['name']}` says no identifier"
            scope.report.error("missing-key", message, node.span("name"), "add `can_id: …`")
        return CanExample()

    def messages(self, scope: Scope, bus: Bus) -> tuple[Message, ...]:
        """The messages that the description lays out."""
        return messages_of(scope, bus)


READING = CanReading()
