"""The manual's worked examples: their bytes, what they answer, what they mean."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fieldscribe.model import Bus, Frame, Point
from fieldscribe.resolve.drafts import humanised
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.resolve.values import number
from fieldscribe.wording.exact import number_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.diagnostics import Span
    from fieldscribe.language.nodes import Map
    from fieldscribe.resolve.names import Index


@dataclass(frozen=True, slots=True)
class OpenFrame:
    """A frame with its text."""

    frame: Frame
    raw: Map


def frames_of(scope: Scope, bus: Bus, index: Index, points: Mapping[str, Point]) -> list[OpenFrame]:
    """All frames in the order of the text; `valid` and `corrected` are still open."""
    result: dict[str, OpenFrame] = {}
    seen: dict[str, Span] = {}
    for raw in scope.listed("frames"):
        name = raw["name"]
        if name in seen:
            first = [(seen[name], "first given here")]
            message = f"two frames have the name `{name}`"
            scope.report.error("duplicate-name", message, raw.span("name"), "rename one of them", first)
            continue
        seen[name] = raw.span("name")
        answers = raw.get("answers")
        if answers is not None and answers not in result:
            if answers not in seen:
                hint = "the request stands above its answer"
                scope.unknown("frame", answers, raw.span("answers"), list(result), hint)
            continue
        digits = "".join(str(raw["bytes"]).split())
        if len(digits) % 2 or not digits:
            message = "the bytes have an odd number of digits" if digits else "the frame has no bytes"
            scope.report.error("bad-number", message, raw.span("bytes"), "write two digits for each byte")
            continue
        result[name] = OpenFrame(
            _frame(scope, bus, raw, bytes.fromhex(digits), _meaning(scope, raw, index, points)), raw
        )
    return list(result.values())


def _frame(scope: Scope, bus: Bus, raw: Map, data: bytes, meaning: Mapping[str, int]) -> Frame:
    answers = raw.get("answers")
    return Frame(
        name=raw["name"],
        framing=raw.get("framing") or (bus.framings[0] if bus.framings else "rtu"),
        direction=raw.get("direction") or ("response" if answers else "request"),
        answers=answers,
        printed=data,
        corrected=data,
        valid=True,
        meaning=meaning,
        title=titles(raw.get("title"), humanised(raw["name"])),
        source=source_of(scope, raw),
        errata=(),
    )


def _meaning(scope: Scope, raw: Map, index: Index, points: Mapping[str, Point]) -> dict[str, int]:
    said: Map | None = raw.get("says")
    meaning = {}
    for word, value in said.items() if said is not None else ():
        draft = index.find(word)
        if draft is None and said is not None:
            index.unknown(word, said.key_span(word))
        point = points.get(draft.item) if draft is not None else None
        if point is None or draft is None or said is None or draft.failed & {"scale", "type", "enum"}:
            continue
        found = _raw_of(scope, point, value, said, word)
        if found is not None:
            meaning[point.item] = found
    return meaning


def _raw_of(scope: Scope, point: Point, value: Any, said: Map, word: str) -> int | None:
    """The raw number that a frame is said to carry: of a name, or of a value in the unit; None after a finding."""
    span = said.span(word)
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, str) and not value[:1].isdigit():
        found, names = _of_name(point, value)
        if found is not None or names:
            if found is None:
                scope.unknown("entry", value, span, names)
            return found
    fault = _not_to_be_compared(point)
    if fault is not None:
        scope.report.error("bad-formula", f"`{word}` {fault}", span, "leave it out of `says`: frames hold raw numbers")
        return None
    exact = number(value, span, scope.report)
    if exact is None:
        return None
    if point.scale is not None:
        exact = exact * point.scale[0].rule.ratio + point.scale[0].rule.offset
    if exact.denominator != 1:
        message = f"`{word}` cannot be {value}: that is raw {number_text(exact)}"
        scope.report.error("bad-number", message, span, "give the value as printed, in the unit of the point")
        return None
    return exact.numerator


def _of_name(point: Point, name: str) -> tuple[int | None, list[str]]:
    """The raw number with that name, and all names that there are."""
    if point.enum is None:
        known = {"off": 0, "on": 1} if point.type == "bit" else {}
    else:
        known = {entry.name: entry.raw for entry in point.enum.entries}
    return known.get(name), list(known)


def _not_to_be_compared(point: Point) -> str | None:
    if point.info.floating:
        return "is a floating-point number"
    if point.scale is not None and (len(point.scale) > 1 or point.scale[0].rule.factors):
        return "needs other points to be scaled"
    return None
