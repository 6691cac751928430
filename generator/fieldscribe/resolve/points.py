"""From drafts to the model's points: addresses, scales, allowed numbers, names."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from fieldscribe.language.units import unit_hint
from fieldscribe.model import Point, Terms
from fieldscribe.resolve.addresses import Places
from fieldscribe.resolve.alike import Kinds, Once, frozen
from fieldscribe.resolve.allowed import Ranges
from fieldscribe.resolve.bounds import Bounds
from fieldscribe.resolve.defaults import default_of
from fieldscribe.resolve.existence import existence_of
from fieldscribe.resolve.meanings import Meaning, Meanings, Word, Words
from fieldscribe.resolve.plain_places import PlainPlaces
from fieldscribe.resolve.rules import Scales
from fieldscribe.resolve.scope import PLAIN, Scope, Sources, titles
from fieldscribe.resolve.telegrams import SPACE
from fieldscribe.resolve.values import integer

if TYPE_CHECKING:
    from fractions import Fraction

    from fieldscribe.language.nodes import Map
    from fieldscribe.model import Allowed, Shape, Unit
    from fieldscribe.resolve.drafts import Draft
    from fieldscribe.resolve.names import Index
    from fieldscribe.resolve.telegrams import Telegrams


@dataclass(frozen=True, slots=True)
class Resolved:
    """A point with the draft that it came from: checks need its places in the text, which the model does not have."""

    point: Point
    draft: Draft


def resolve_points(
    scope: Scope, drafts: list[Draft], index: Index, telegrams: Telegrams
) -> tuple[list[Resolved], Ranges, Places]:
    """All points of the device, computed; a wrong fact is a finding, and the usual one is assumed in its place."""
    kind_of, word_of = Kinds().of, Words(scope).of
    kinds = {draft: kind_of(draft) for draft in drafts}
    words = {draft: word_of(draft, kind) for draft, kind in kinds.items()}
    bounds = Bounds(
        Scales(scope, index),
        {draft: word.holds for draft, word in words.items()},
        {draft: word.specials for draft, word in words.items()},
    )
    ranges, places = Ranges(bounds), Places(scope, telegrams)
    meaning_of = Meanings(scope, words, ranges, places).of
    points = _Points(scope, ranges.bounds.scales, places)
    resolved = [
        Resolved(points.point(draft, kind, words[draft], meaning_of(draft, kind)), draft)
        for draft, kind in kinds.items()
    ]
    return resolved, ranges, places


class _Points:
    """Puts points together: their identity, and what they share with others."""

    def __init__(self, scope: Scope, scales: Scales, places: Places) -> None:
        self._scope, self._scales, self._places = scope, scales, PlainPlaces(places)
        self._sources = Sources(scope)
        self._terms: Once[Terms] = Once(scope.report)
        self._defaults: Once[tuple[Fraction | None, int | None]] = Once(scope.report)

    def point(self, draft: Draft, kind: int, word: Word, meant: tuple[Meaning, Allowed]) -> Point:
        """The point of a draft."""
        (meaning, allowed), get = meant, draft.get
        shape, code, old_names = meaning.shape, get("code"), get("was")
        place, write_place = self._places.of(draft, word, kind)
        terms = self._terms.known.get(kind) or self._computed_terms(draft, kind, word, meaning)
        default, default_raw = self._default(draft, kind, shape)
        return Point(
            draft.name,
            draft.variant,
            None if code is None else str(code),
            draft.title,
            titles(get("note")),
            self._sources.of(draft),
            place,
            write_place,
            shape,
            terms if place.addresses else replace(terms, generated=False, reason="the manual prints no address"),
            allowed,
            default,
            default_raw,
            draft.record,
            draft.set_number,
            None if draft.element is None else draft.element.index,
            () if old_names is None else tuple(map(draft.called, old_names)),
            (),
        )

    def _default(self, draft: Draft, kind: int, shape: Shape) -> tuple[Fraction | None, int | None]:
        """The factory setting in the unit and as raw number."""
        if draft.layer("default") is None and draft.layer("default_in_units") is None:
            return None, None
        said = kind, frozen(draft.get("default")), frozen(draft.get("default_in_units"))
        return self._defaults.of(said, draft, lambda _: default_of(self._scope, draft, shape), lambda _: True)

    def _computed_terms(self, draft: Draft, kind: int, word: Word, meaning: Meaning) -> Terms:
        return self._terms.of(kind, draft, partial(self._terms_of, word, meaning), _are_general)

    def _terms_of(self, word: Word, meaning: Meaning, draft: Draft) -> Terms:
        get, scope, shape = draft.get, self._scope, meaning.shape
        reason = _reason(draft, shape.access, raw_alone=meaning.raw_alone)
        return Terms(
            group=str(draft.group["group"]),
            space=word.space,
            bits=word.bits,
            unit=_unit(scope, draft),
            steps=_steps(scope, draft),
            changes=get("changes"),
            keeps=_keeps(scope, draft) if shape.writable else None,
            conditions=tuple(get("conditions", ())) if shape.writable else (),
            when=existence_of(scope, draft, self._scales),
            since=get("since"),
            until=get("until"),
            reserved=bool(get("reserved", False)),
            generated=reason is None,
            reason=reason,
            telegram=draft.group.get("telegram") if word.space == SPACE else None,
            changes_with=_changes_with(draft, self._scales.index),
            untyped=_untyped(scope, draft),
        )


def _are_general(terms: Terms) -> bool:
    """Whether alike points share them: not where no point may name itself."""
    return terms.when is None and not terms.changes_with


def _reason(draft: Draft, access: str, *, raw_alone: bool) -> str | None:
    """Why no code is generated for a point that has an address; None if there is code for it."""
    if draft.get("reserved", False):
        return "reserved by the maker"
    if draft.untyped is not None:
        return "no type says its encoding" if draft.untyped else "the manual does not settle its type"
    if draft.layer("scale") is not None and draft.get("scale") is None:
        return "the manual does not settle its scale"
    if raw_alone:
        return "its scale needs integers of more than 63 bits"
    return "not reachable over the bus" if access == "none" else None


def _untyped(scope: Scope, draft: Draft) -> str | None:
    """What stands in place of a type; a finding where a type stands beside it, or `length` beside a type."""
    words, typed = draft.layer("untyped"), draft.layer("type")
    if words is not None and words is typed and words["type"] is not None:
        message, hint = f"`{draft.name}` has a type, and words that stand in place of one", "leave one of them out"
        scope.report.error("two-meanings", message, words.span("untyped"), hint)
    elif draft.untyped is None and "length" in draft.own and not draft.failed & {"type", "untyped"}:
        hint = "its type says how many words it takes: leave `length` out"
        scope.report.error("two-meanings", f"`{draft.name}` has a type", draft.span("length"), hint)
    return draft.untyped


def _keeps(scope: Scope, draft: Draft) -> str | None:
    """What keeps a written value; a finding where `keeps` and `keep_with` stand side by side."""
    kept, command = draft.layer("keeps"), draft.layer("keep_with")
    if kept is not None and kept is command:
        message, hint = "`keeps` and `keep_with` stand in place of each other", "leave one of them out"
        scope.report.error("two-meanings", message, kept.key_span("keep_with"), hint)
    return draft.keeps


def _unit(scope: Scope, draft: Draft) -> Unit:
    symbol = draft.get("unit")
    unit = PLAIN if symbol is None else scope.unit(symbol)
    if unit is None:
        scope.unknown("unit", str(symbol), draft.span("unit"), scope.units, unit_hint(str(symbol), scope.units))
        draft.failed.add("unit")
    return unit or PLAIN


def _steps(scope: Scope, draft: Draft) -> tuple[tuple[int, int], ...]:
    node: Map | None = draft.get("steps")
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


def _changes_with(draft: Draft, index: Index) -> tuple[str, ...]:
    """The points whose writing changes this one, by name; a word that names none is a finding."""
    words = draft.get("changes_with")
    names: dict[str, None] = {}
    for place, word in enumerate(words if words is not None else ()):
        used = index.all(word)
        if not used:
            index.unknown(word, words.span(place))
        if draft in used:
            message = f"`{draft.name}` cannot change with itself"
            index.scope.report.error("two-meanings", message, words.span(place), "name the points that change it")
        names.update(dict.fromkeys(writer.name for writer in used))
    return tuple(names)
