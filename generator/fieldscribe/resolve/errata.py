"""Errata: whom they are about, and what they say."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fieldscribe.language.nodes import Map, Seq
from fieldscribe.model import Bus, Erratum
from fieldscribe.resolve.scope import Scope, source_of
from fieldscribe.resolve.values import integer

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from fieldscribe.resolve.names import Index


@dataclass(slots=True)
class OpenErratum:
    """An erratum with its text; `used` collects the keys of `printed` that a check found to disagree indeed."""

    erratum: Erratum
    raw: Map
    used: set[str]

    @property
    def subjects(self) -> tuple[str, ...]:
        """Whom it is about: points by name, `frame:NAME`, `function:NUMBER`, or nothing."""
        return self.erratum.points or ((self.erratum.where,) if ":" in self.erratum.where else ())

    def printed(self, key: str) -> Any:
        """The printed value of a key, or None."""
        printed = self.raw["printed"]
        return printed.get(key) if isinstance(printed, Map) else None


def errata_of(scope: Scope, index: Index, bus: Bus) -> list[OpenErratum]:
    """All errata in the order of the text; one about nothing that exists, or with an id given twice, is a finding."""
    seen: dict[str, Map] = {}
    result = []
    frames = {one["name"] for one in scope.listed("frames")}
    functions = {code.number for code in bus.functions}
    for raw in scope.listed("errata"):
        if raw["id"] in seen:
            first = (seen[raw["id"]].span("id"), "first given here")
            scope.report.error(
                "duplicate-name",
                f"two errata have the id `{raw['id']}`",
                raw.span("id"),
                "ids are never reused",
                [first],
            )
            continue
        seen[raw["id"]] = raw
        points = tuple(_points(scope, index, raw))
        where = _where(scope, raw, frames, functions)
        if not points and where is None:
            continue
        source = source_of(scope, raw)
        if source.document not in scope.documents:
            scope.unknown("document", source.document, raw.span("document"), scope.documents)
        text = Erratum(
            raw["id"],
            points,
            where or "",
            source,
            said(raw["printed"]),
            said(raw["taken"]),
            str(raw["why"]),
            raw["certainty"],
        )
        result.append(OpenErratum(text, raw, set()))
    return result


def _points(scope: Scope, index: Index, raw: Map) -> Iterator[str]:
    words = [(raw["point"], raw.span("point"))] if "point" in raw else []
    words += [(word, raw["points"].span(number)) for number, word in enumerate(raw.get("points", ()))]
    for word, span in words:
        found = index.all(word)
        if not found:
            index.unknown(word, span)
        yield from dict.fromkeys(draft.name for draft in found)


def _where(scope: Scope, raw: Map, frames: Collection[str], functions: Collection[int]) -> str | None:
    """Where it is, if not at a point: `frame:NAME`, `function:NUMBER`, words, or nothing; None after a finding."""
    if "frame" in raw:
        if raw["frame"] not in frames:
            scope.unknown("frame", raw["frame"], raw.span("frame"), frames)
        return f"frame:{raw['frame']}"
    if "function" in raw:
        number = integer(raw["function"], raw.span("function"), scope.report)
        if number is not None and number not in functions:
            word = str(raw["function"])
            scope.unknown("function", word, raw.span("function"), ())
        return f"function:{number}"
    if "where" in raw:
        return str(raw["where"]).replace(":", ",")
    if "point" not in raw and "points" not in raw:
        hint = "say `point`, `points`, `frame`, `function` or `where`"
        scope.report.error("erratum-unused", f"the erratum `{raw['id']}` is about nothing", raw.span("id"), hint)
        return None
    return ""


def said(value: Any) -> str:
    """What is printed or taken, in one line."""
    if isinstance(value, Map):
        return "; ".join(f"{key.replace('_', ' ')} {_one(one)}" for key, one in value.items())
    return str(value)


def _one(value: Any) -> str:
    if isinstance(value, Seq):
        return " / ".join(map(str, value))
    return "nothing" if value is None else str(value)
