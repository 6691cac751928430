"""The manual's worked examples: their bytes, what they answer, what they mean."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families import families
from fieldscribe.model import Bus, Frame, Named, Point
from fieldscribe.resolve.family_reader import reader_of
from fieldscribe.resolve.frame_meanings import meaning_of
from fieldscribe.resolve.scope import Scope, humanised, source_of, titles

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.diagnostics import Span
    from fieldscribe.language.nodes import Map
    from fieldscribe.resolve.symbols import SymbolTable


@dataclass(frozen=True, slots=True)
class LocatedFrame:
    """A frame with its text."""

    frame: Frame
    node: Map

    @property
    def about(self) -> Named:
        """The frame as errata name it."""
        return Named("frame", self.frame.name)


def frames_of(scope: Scope, bus: Bus, index: SymbolTable, points: Mapping[str, Point]) -> list[LocatedFrame]:
    """All frames in the order of the text; checks fill in `valid` and `corrected` later."""
    result: dict[str, LocatedFrame] = {}
    seen: dict[str, Span] = {}
    for node in scope.listed("frames"):
        name = node["name"]
        if name in seen:
            first = [(seen[name], "first given here")]
            message = f"two frames have the name `{name}`"
            scope.report.error("duplicate-name", message, node.span("name"), "rename one of them", first)
            continue
        seen[name] = node.span("name")
        answers = node.get("answers")
        if answers is not None and answers not in result:
            if answers == name or answers not in seen:
                hint = "the request stands above its answer"
                scope.unknown("frame", answers, node.span("answers"), list(result), hint)
            continue
        digits = "".join(str(node["bytes"]).split())
        if len(digits) % 2 or not digits:
            message = "the bytes have an odd number of digits" if digits else "the frame has no bytes"
            scope.report.error("bad-number", message, node.span("bytes"), "write two digits for each byte")
            continue
        if not _known_framing(scope, node) or reader_of(scope).refuses(scope, bus, node):
            continue
        result[name] = LocatedFrame(
            _frame(scope, bus, node, bytes.fromhex(digits), meaning_of(scope, node, index, points)), node
        )
    return list(result.values())


def _frame(scope: Scope, bus: Bus, node: Map, data: bytes, meaning: Mapping[str, int]) -> Frame:
    answers = node.get("answers")
    framing = framing_of(scope, bus, node)
    _foreign_keys(scope, node)
    return Frame(
        name=node["name"],
        framing=framing,
        direction=node.get("direction") or ("response" if answers else "request"),
        answers=answers,
        printed=data,
        corrected=data,
        valid=True,
        meaning=meaning,
        title=titles(node.get("title"), humanised(node["name"])),
        source=source_of(scope, node),
        errata=(),
        own=reader_of(scope).frame(scope, node, framing),
    )


def framing_of(scope: Scope, bus: Bus, node: Map) -> str:
    """The framing of a frame: its own, or the first one of the bus or the family."""
    usual = bus.framings[0] if bus.framings else scope.family.framings[0]
    return str(node.get("framing") or usual)


def _known_framing(scope: Scope, node: Map) -> bool:
    """Whether the family has the framing; a finding if not."""
    family, known = scope.family.name, scope.family.framings
    if node.get("framing", known[0]) in known:
        return True
    message = f"`{node['framing']}` is no framing of the family {family}"
    scope.report.error("wrong-choice", message, node.span("framing"), f"write one of {', '.join(known)}")
    return False


def _foreign_keys(scope: Scope, node: Map) -> None:
    """Findings for keys that only frames of another family have."""
    for other in families():
        for key in other.frame_keys:
            if key in node and key not in scope.family.frame_keys:
                message = f"`{key}` is nothing that the family {scope.family.name} knows"
                hint = f"it belongs to {other.name}: leave it out"
                scope.report.error("family-key", message, node.key_span(key), hint)
