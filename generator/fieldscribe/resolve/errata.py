"""Errata: which points or frames they are about, and what they say."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.families import sections_of_codes
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.model import About, Bus, Erratum, Named
from fieldscribe.records import dataclass
from fieldscribe.resolve.scope import Scope, source_of
from fieldscribe.resolve.values import integer

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.resolve.names import Index


_NAMED = (("frames", "frame"), ("messages", "message"), ("telegrams", "telegram"))
"""Sections of named things that an erratum may be about, and the key that names one."""


@dataclass(slots=True)
class OpenErratum:
    """An erratum with its text; `used` collects the keys of `printed` where a check really met the misprint."""

    erratum: Erratum
    raw: Map
    used: set[str]

    @property
    def subjects(self) -> tuple[About, ...]:
        """What it is about: its points, another thing, or nothing that has a name."""
        where = self.erratum.where
        return self.erratum.points or ((where,) if isinstance(where, Named) else ())

    def printed(self, key: str) -> Any:
        """The printed value of a key, or None."""
        printed = self.raw["printed"]
        return printed.get(key) if isinstance(printed, Map) else None


def errata_of(scope: Scope, index: Index, bus: Bus) -> list[OpenErratum]:
    """All errata in the order of the text; one about nothing that exists, or with an id given twice, is a finding."""
    seen: dict[str, Map] = {}
    result = []
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
        where = _where(scope, raw, bus)
        if not points and where is None:
            continue
        _flag_exists(scope, index, raw)
        source = source_of(scope, raw)
        if source.document not in scope.documents:
            scope.unknown("document", source.document, raw.span("document"), scope.documents)
        text = Erratum(
            raw["id"],
            points,
            where or "",
            source,
            in_one_line(raw["printed"]),
            in_one_line(raw["taken"]),
            str(raw["why"]),
            raw["certainty"],
            _facts(raw["printed"]),
        )
        result.append(OpenErratum(text, raw, set()))
    return result


def _points(scope: Scope, index: Index, raw: Map) -> Iterator[str]:
    """The names of the points that it is about; a word that means none is a finding."""
    words = [(raw["point"], raw.span("point"))] if "point" in raw else []
    words += [(word, raw["points"].span(number)) for number, word in enumerate(raw.get("points", ()))]
    for word, span in words:
        drafts = index.all(word)
        if not drafts:
            index.unknown(word, span)
        yield from dict.fromkeys(draft.name for draft in drafts)


def _flag_exists(scope: Scope, index: Index, raw: Map) -> None:
    """A finding for an erratum about a flag that its points do not have."""
    if "flag" not in raw:
        return
    words = [raw["point"]] if "point" in raw else list(raw.get("points", ()))
    flags = [value for word in words for draft in index.all(word) for value in (draft.get("flags") or {}).values()]
    names = [str(value if isinstance(value, str) else value["name"]) for value in flags]
    if raw["flag"] not in names:
        scope.unknown("flag", raw["flag"], raw.span("flag"), names)


def _where(scope: Scope, raw: Map, bus: Bus) -> Named | str | None:
    """What it is about, if not a whole point: a thing, words, or nothing; None after a finding."""
    for section, key in _NAMED:
        if key in raw:
            known = [str(item["name"]) for item in scope.listed(section)]
            if raw[key] not in known:
                scope.unknown(key, raw[key], raw.span(key), known)
            return Named(key, raw[key])
    for key, section in sections_of_codes().items():
        if key in raw:
            number = integer(raw[key], raw.span(key), scope.report)
            if number is not None and all(code.number != number for code in bus.codes(section)):
                scope.unknown(key, str(raw[key]), raw.span(key), ())
            return Named(key, str(raw[key]) if number is None else number)
    if "where" in raw:
        return str(raw["where"])
    if "point" not in raw and "points" not in raw:
        hint = "say `point`, `points`, `frame`, `function`, `message`, `telegram` or `where`"
        scope.report.error("erratum-unused", f"the erratum `{raw['id']}` is about nothing", raw.span("id"), hint)
        return None
    return f"the flag {raw['flag']}" if "flag" in raw else ""


def in_one_line(value: Any) -> str:
    """What is printed or taken, in one line."""
    facts = _facts(value)
    return "; ".join(f"{key.replace('_', ' ')} {text}" for key, text in facts) if facts else str(value)


def _facts(value: Any) -> tuple[tuple[str, str], ...]:
    """Each fact as (key, text); none where the erratum says it in words."""
    return tuple((str(key), _fact_text(fact, key)) for key, fact in value.items()) if isinstance(value, Map) else ()


def _fact_text(value: Any, key: str) -> str:
    """One fact as people read it: masks in hexadecimal, lists with slashes."""
    if key == "mask" and isinstance(value, int):
        return f"{value:04X}h"
    if isinstance(value, Seq):
        return " / ".join(map(str, value))
    return "nothing" if value is None else str(value)
