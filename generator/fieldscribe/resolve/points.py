"""From expanded to the model's points: addresses, scales, allowed numbers, names."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from fieldscribe.language.units import unit_hint
from fieldscribe.model import Point, Terms
from fieldscribe.resolve.addresses import Places
from fieldscribe.resolve.alike import Kinds, Once, frozen
from fieldscribe.resolve.bounds import Bounds
from fieldscribe.resolve.conditions import condition_of
from fieldscribe.resolve.defaults import default_of
from fieldscribe.resolve.plain_places import PlainPlaces
from fieldscribe.resolve.ranges import Ranges
from fieldscribe.resolve.scales import Scales
from fieldscribe.resolve.scope import PLAIN, Scope, Sources, titles
from fieldscribe.resolve.shapes import Meaning, Meanings, Word, Words
from fieldscribe.resolve.telegrams import SPACE
from fieldscribe.resolve.values import integer

if TYPE_CHECKING:
    from fractions import Fraction

    from fieldscribe.language.nodes import Map
    from fieldscribe.model import Allowed, Shape, Unit
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.resolve.symbols import SymbolTable
    from fieldscribe.resolve.telegrams import Telegrams


@dataclass(frozen=True, slots=True)
class ResolvedPoint:
    """A point with the facts that it came from: checks need its places in the text, which the model does not have."""

    point: Point
    facts: PointFacts


def resolve_points(
    scope: Scope, expanded: list[PointFacts], index: SymbolTable, telegrams: Telegrams
) -> tuple[list[ResolvedPoint], Ranges, Places]:
    """All points of the device, computed; a wrong fact is a finding, and the usual one is assumed in its place."""
    kind_of, word_of = Kinds().of, Words(scope).of
    kinds = {facts: kind_of(facts) for facts in expanded}
    words = {facts: word_of(facts, kind) for facts, kind in kinds.items()}
    bounds = Bounds(
        Scales(scope, index),
        {facts: word.holds for facts, word in words.items()},
        {facts: word.specials for facts, word in words.items()},
    )
    ranges, places = Ranges(bounds), Places(scope, telegrams)
    meaning_of = Meanings(scope, words, ranges, places).of
    points = _Points(scope, ranges.bounds.scales, places)
    resolved = [
        ResolvedPoint(points.point(facts, kind, words[facts], meaning_of(facts, kind)), facts)
        for facts, kind in kinds.items()
    ]
    return resolved, ranges, places


class _Points:
    """Puts points together: their identity, and what they share with others."""

    def __init__(self, scope: Scope, scales: Scales, places: Places) -> None:
        self._scope, self._scales, self._places = scope, scales, PlainPlaces(places)
        self._sources = Sources(scope)
        self._terms: Once[Terms] = Once(scope.report)
        self._defaults: Once[tuple[Fraction | None, int | None]] = Once(scope.report)

    def point(self, facts: PointFacts, kind: int, word: Word, meant: tuple[Meaning, Allowed]) -> Point:
        """The point of a facts."""
        (meaning, allowed), get = meant, facts.get
        shape, code, old_names = meaning.shape, get("code"), get("was")
        place, write_place = self._places.of(facts, word, kind)
        terms = self._terms.known.get(kind) or self._computed_terms(facts, kind, word, meaning)
        default, default_raw = self._default(facts, kind, shape)
        return Point(
            facts.name,
            facts.variant,
            None if code is None else str(code),
            facts.title,
            titles(get("note")),
            self._sources.of(facts),
            place,
            write_place,
            shape,
            terms if place.addresses else replace(terms, generated=False, reason="the manual prints no address"),
            allowed,
            default,
            default_raw,
            facts.record,
            facts.set_number,
            None if facts.element is None else facts.element.index,
            () if old_names is None else tuple(map(facts.called, old_names)),
            (),
        )

    def _default(self, facts: PointFacts, kind: int, shape: Shape) -> tuple[Fraction | None, int | None]:
        """The factory setting in the unit and as raw number."""
        if facts.layer("default") is None and facts.layer("default_in_units") is None:
            return None, None
        said = kind, frozen(facts.get("default")), frozen(facts.get("default_in_units"))
        return self._defaults.of(said, facts, lambda _: default_of(self._scope, facts, shape), lambda _: True)

    def _computed_terms(self, facts: PointFacts, kind: int, word: Word, meaning: Meaning) -> Terms:
        return self._terms.of(kind, facts, partial(self._terms_of, word, meaning), _are_general)

    def _terms_of(self, word: Word, meaning: Meaning, facts: PointFacts) -> Terms:
        get, scope, shape = facts.get, self._scope, meaning.shape
        reason = _reason(facts, shape.access, raw_alone=meaning.raw_alone)
        return Terms(
            group=str(facts.group["group"]),
            space=word.space,
            bits=word.bits,
            unit=_unit(scope, facts),
            steps=_steps(scope, facts),
            changes=get("changes"),
            keeps=_keeps(scope, facts) if shape.writable else None,
            conditions=tuple(get("conditions", ())) if shape.writable else (),
            when=condition_of(scope, facts, self._scales),
            since=get("since"),
            until=get("until"),
            reserved=bool(get("reserved", False)),
            generated=reason is None,
            reason=reason,
            telegram=facts.group.get("telegram") if word.space == SPACE else None,
            changes_with=_changes_with(facts, self._scales.index),
            untyped=_untyped(scope, facts),
        )


def _are_general(terms: Terms) -> bool:
    """Whether alike points share them: not where no point may name itself."""
    return terms.when is None and not terms.changes_with


def _reason(facts: PointFacts, access: str, *, raw_alone: bool) -> str | None:
    """Why no code is generated for a point that has an address; None if there is code for it."""
    if facts.get("reserved", False):
        return "reserved by the maker"
    if facts.untyped is not None:
        return "no type says its encoding" if facts.untyped else "the manual does not settle its type"
    if facts.layer("scale") is not None and facts.get("scale") is None:
        return "the manual does not settle its scale"
    if raw_alone:
        return "its scale needs integers of more than 63 bits"
    return "not reachable over the bus" if access == "none" else None


def _untyped(scope: Scope, facts: PointFacts) -> str | None:
    """What stands in place of a type; a finding where a type stands beside it, or `length` beside a type."""
    words, typed = facts.layer("untyped"), facts.layer("type")
    if words is not None and words is typed and words["type"] is not None:
        message, hint = f"`{facts.name}` has a type, and words that stand in place of one", "leave one of them out"
        scope.report.error("two-meanings", message, words.span("untyped"), hint)
    elif facts.untyped is None and "length" in facts.own and not facts.failed & {"type", "untyped"}:
        hint = "its type says how many words it takes: leave `length` out"
        scope.report.error("two-meanings", f"`{facts.name}` has a type", facts.span("length"), hint)
    return facts.untyped


def _keeps(scope: Scope, facts: PointFacts) -> str | None:
    """What keeps a written value; a finding where `keeps` and `keep_with` stand side by side."""
    kept, command = facts.layer("keeps"), facts.layer("keep_with")
    if kept is not None and kept is command:
        message, hint = "`keeps` and `keep_with` stand in place of each other", "leave one of them out"
        scope.report.error("two-meanings", message, kept.key_span("keep_with"), hint)
    return facts.keeps


def _unit(scope: Scope, facts: PointFacts) -> Unit:
    symbol = facts.get("unit")
    unit = PLAIN if symbol is None else scope.unit(symbol)
    if unit is None:
        scope.unknown("unit", str(symbol), facts.span("unit"), scope.units, unit_hint(str(symbol), scope.units))
        facts.failed.add("unit")
    return unit or PLAIN


def _steps(scope: Scope, facts: PointFacts) -> tuple[tuple[int, int], ...]:
    node: Map | None = facts.get("steps")
    if node is None:
        return ()
    steps: dict[int, int] = {}
    for key, step in node.items():
        start = integer(key, node.key_span(key), scope.report)
        if start is None:
            continue
        if start in steps:
            message = f"the steps from {start} on are given twice"
            scope.report.error("duplicate-enum-value", message, node.key_span(key), "remove one of them")
        steps.setdefault(start, step)
    return tuple(sorted(steps.items()))


def _changes_with(facts: PointFacts, index: SymbolTable) -> tuple[str, ...]:
    """The points whose writing changes this one, by name; a word that names none is a finding."""
    words = facts.get("changes_with")
    names: dict[str, None] = {}
    for place, word in enumerate(words if words is not None else ()):
        used = index.all(word)
        if not used:
            index.unknown(word, words.span(place))
        if facts in used:
            message = f"`{facts.name}` cannot change with itself"
            index.scope.report.error("two-meanings", message, words.span(place), "name the points that change it")
        names.update(dict.fromkeys(writer.name for writer in used))
    return tuple(names)
