"""The manual's worked examples: their bytes, what they answer, what they mean."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.model import Bus, Frame, Point
from fieldscribe.resolve.drafts import humanised
from fieldscribe.resolve.frame_meanings import meaning_of
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.resolve.values import integer

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.diagnostics import Span
    from fieldscribe.language.nodes import Map
    from fieldscribe.resolve.names import Index


_FRAMINGS = {"modbus": ("rtu", "tcp"), "can": ("can",), "uss": ("uss", "pkw", "pzd", "broadcast")}
"""The framings of each family, the usual one first."""

_VARIABLE = 127


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
            if answers == name or answers not in seen:
                hint = "the request stands above its answer"
                scope.unknown("frame", answers, raw.span("answers"), list(result), hint)
            continue
        digits = "".join(str(raw["bytes"]).split())
        if len(digits) % 2 or not digits:
            message = "the bytes have an odd number of digits" if digits else "the frame has no bytes"
            scope.report.error("bad-number", message, raw.span("bytes"), "write two digits for each byte")
            continue
        if not (_known_framing(scope, raw) and _known_length(scope, bus, raw)):
            continue
        result[name] = OpenFrame(
            _frame(scope, bus, raw, bytes.fromhex(digits), meaning_of(scope, raw, index, points)), raw
        )
    return list(result.values())


def _frame(scope: Scope, bus: Bus, raw: Map, data: bytes, meaning: Mapping[str, int]) -> Frame:
    answers = raw.get("answers")
    return Frame(
        name=raw["name"],
        framing=framing_of(scope, bus, raw),
        direction=raw.get("direction") or ("response" if answers else "request"),
        answers=answers,
        printed=data,
        corrected=data,
        valid=True,
        meaning=meaning,
        title=titles(raw.get("title"), humanised(raw["name"])),
        source=source_of(scope, raw),
        errata=(),
        pkw=_pkw(scope, bus, raw),
        can_id=_can_id(scope, raw),
    )


def framing_of(scope: Scope, bus: Bus, raw: Map) -> str:
    """The framing of a frame: said, or the usual one of the family."""
    usual = bus.framings[0] if bus.framings else _FRAMINGS[str(scope.header["family"])][0]
    return str(raw.get("framing") or usual)


def _known_framing(scope: Scope, raw: Map) -> bool:
    """Whether the family has the framing; a finding if not."""
    family = str(scope.header["family"])
    known = _FRAMINGS[family]
    if raw.get("framing", known[0]) in known:
        return True
    message = f"`{raw['framing']}` is no framing of the family {family}"
    scope.report.error("wrong-choice", message, raw.span("framing"), f"write one of {', '.join(known)}")
    return False


def _known_length(scope: Scope, bus: Bus, raw: Map) -> bool:
    """Whether the parameter part can have the length that is said; a finding if not."""
    if scope.header["family"] != "uss" or not bus.pkw or raw.get("pkw", bus.pkw[0]) in bus.pkw:
        return True
    message = f"the parameter part cannot have the length {raw['pkw']}"
    hint = f"known under `bus`: {', '.join(map(str, bus.pkw))}"
    scope.report.error("wrong-choice", message, raw.span("pkw"), hint)
    return False


def _pkw(scope: Scope, bus: Bus, raw: Map) -> int | None:
    """USS: the length of the parameter part that the link is set to."""
    if scope.header["family"] != "uss":
        _foreign(scope, raw, "pkw", "uss")
        return None
    said: int = raw.get("pkw", _VARIABLE)
    return None if framing_of(scope, bus, raw) in ("pzd", "broadcast") else said


def _can_id(scope: Scope, raw: Map) -> int | None:
    """CAN: the identifier of the frame."""
    if scope.header["family"] != "can":
        _foreign(scope, raw, "can_id", "can")
        return None
    if "can_id" in raw:
        return integer(raw["can_id"], raw.span("can_id"), scope.report)
    if "can_id" not in raw.broken:
        message = f"the frame `{raw['name']}` says no identifier"
        scope.report.error("missing-key", message, raw.span("name"), "add `can_id: …`")
    return None


def _foreign(scope: Scope, raw: Map, key: str, family: str) -> None:
    if key in raw:
        message = f"`{key}` is nothing that the family {scope.header['family']} knows"
        scope.report.error("family-key", message, raw.key_span(key), f"it belongs to {family}: leave it out")
