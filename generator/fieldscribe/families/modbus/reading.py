"""Reads the family's own facts from the description, and reports what the protocol cannot do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.modbus.blocks import plan_blocks
from fieldscribe.families.modbus.facts import ModbusBus
from fieldscribe.families.modbus.functions import BROADCAST, PROTOCOL_MOST, SPACES
from fieldscribe.language.nodes import Map
from fieldscribe.resolve.families import Reading

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from fieldscribe.diagnostics import Span
    from fieldscribe.model import Block, Bus, Code, Point
    from fieldscribe.resolve.scope import Scope


class ModbusReading(Reading):
    """How Modbus functions, their counts, broadcasts and block reads are taken from a description."""

    def bus(self, scope: Scope, node: Map, functions: tuple[Code, ...]) -> ModbusBus:
        """How coils are padded."""
        _counts(scope, node, functions)
        _broadcasts(scope, node, functions)
        return ModbusBus(node.get("pad_coil_bytes"))

    def writes(self, space: str) -> tuple[int, ...]:
        """The functions that write into a space."""
        return tuple(
            function for function in (SPACES[space].write_one, SPACES[space].write_many) if function is not None
        )

    def blocks(self, bus: Bus, points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]) -> tuple[Block, ...]:
        """The reads that bring all points of a group."""
        return plan_blocks(bus, points, variants)


def _counts(scope: Scope, node: Map, functions: tuple[Code, ...]) -> None:
    """Report functions with more items than the protocol can carry."""
    spans = _places(node, "max")
    for code in functions:
        most = PROTOCOL_MOST.get(code.number)
        if most is not None and code.most is not None and code.most > most:
            message = f"`max: {code.most}` is more than one request can carry"
            hint = f"function {code.number:02X}h takes at most {most}"
            scope.report.error("too-many-items", message, spans[code.name], hint)


def _broadcasts(scope: Scope, node: Map, functions: tuple[Code, ...]) -> None:
    """Report broadcast functions that the protocol always answers."""
    spans = _places(node, "broadcast")
    for code in functions:
        if code.broadcast and code.number not in BROADCAST:
            message = f"function {code.number:02X}h is never broadcast: it is of no use without an answer"
            shown = ", ".join(f"{function:02X}h" for function in sorted(BROADCAST))
            scope.report.error("not-broadcast", message, spans[code.name], f"functions that can be: {shown}")


def _places(node: Map, key: str) -> Mapping[str, Span]:
    """Where each function stands in the description, by its name."""
    return {value["name"]: value.span(key) for value in node.get("functions", {}).values() if isinstance(value, Map)}


READING = ModbusReading()
