"""The manual's worked examples: their bytes, what they answer, what they mean."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any

from fieldscribe.language.nodes import Map
from fieldscribe.model import Bus, Frame, Point
from fieldscribe.resolve.allowed import round_half_away
from fieldscribe.resolve.drafts import humanised
from fieldscribe.resolve.names import Index
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.resolve.values import number


@dataclass(frozen=True, slots=True)
class OpenFrame:
    """A frame with its text."""

    frame: Frame
    raw: Map


def frames_of(scope: Scope, bus: Bus, index: Index, points: Mapping[str, Point]) -> list[OpenFrame]:
    """All frames in the order of the text; `valid` and `corrected` are still open."""
    result: dict[str, OpenFrame] = {}
    for raw in scope.listed("frames"):
        name = raw["name"]
        if name in result:
            scope.report.error(
                "duplicate-name", f"two frames have the name `{name}`", raw.span("name"), "rename one of them"
            )
            continue
        digits = "".join(str(raw["bytes"]).split())
        if len(digits) % 2:
            scope.report.error(
                "bad-number",
                "the bytes have an odd number of digits",
                raw.span("bytes"),
                "write two digits for each byte",
            )
            continue
        answers = raw.get("answers")
        if answers is not None and answers not in result:
            scope.report.error(
                "unknown-frame",
                f"there is no frame `{answers}` above",
                raw.span("answers"),
                "the request stands before its answer",
            )
            continue
        data = bytes.fromhex(digits)
        direction = raw.get("direction") or ("response" if answers else "request")
        framing = raw.get("framing") or (bus.framings[0] if bus.framings else "rtu")
        title = titles(raw.get("title"), humanised(name))
        frame = Frame(
            name,
            framing,
            direction,
            answers,
            data,
            data,
            True,
            _meaning(scope, raw, index, points),
            title,
            source_of(scope, raw),
            (),
        )
        result[name] = OpenFrame(frame, raw)
    return list(result.values())


def _meaning(scope: Scope, raw: Map, index: Index, points: Mapping[str, Point]) -> dict[str, int]:
    said: Map | dict[str, Any] = raw.get("says", {})
    meaning = {}
    for word, value in said.items():
        draft = index.find(word)
        if draft is None:
            scope.report.error(
                "unknown-point", f"there is no point `{word}`", raw["says"].key_span(word), index.hint(word)
            )
            continue
        point = points.get(draft.item)
        if point is not None:
            found = _raw_of(scope, point, value, raw["says"], word)
            if found is not None:
                meaning[point.item] = found
    return meaning


def _raw_of(scope: Scope, point: Point, value: Any, said: Map, word: str) -> int | None:
    if isinstance(value, bool):
        return int(value)
    if point.enum is not None and isinstance(value, str):
        named = next((entry.raw for entry in point.enum.entries if entry.name == value), None)
        if named is not None:
            return named
    if point.type == "bit" and value in ("on", "off"):
        return int(value == "on")
    exact = Fraction(value) if isinstance(value, int | Decimal) else number(value, said.span(word), scope.report)
    if exact is None:
        return None
    if point.scale is not None:
        if len(point.scale) > 1 or point.scale[0].rule.factors:
            scope.report.error(
                "bad-formula", f"`{word}` needs other points to be scaled", said.span(word), "leave it out of `says`"
            )
            return None
        exact = exact * point.scale[0].rule.ratio + point.scale[0].rule.offset
    return round_half_away(exact)
