"""From drafts to the model's points: addresses, scales, allowed numbers, names."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.arithmetic.words import ends_of
from fieldscribe.language.units import unit_hint
from fieldscribe.model import TYPES, Allowed, Enum, Interner, Point, ScaleCase, Shape, Special, Unit
from fieldscribe.records import dataclass, replace
from fieldscribe.resolve.addresses import Places
from fieldscribe.resolve.allowed import Ranges
from fieldscribe.resolve.bounds import Bounds
from fieldscribe.resolve.defaults import default_of
from fieldscribe.resolve.display import display_of
from fieldscribe.resolve.enums import enum_of, flags_of
from fieldscribe.resolve.existence import existence_of
from fieldscribe.resolve.integer_path import Paths, paths_of
from fieldscribe.resolve.names import Index, bits_of, space_of, type_of
from fieldscribe.resolve.rules import Scales
from fieldscribe.resolve.scope import PLAIN, Scope, source_of, titles
from fieldscribe.resolve.special_codes import SpecialCodes, quantities
from fieldscribe.resolve.telegrams import SPACE
from fieldscribe.resolve.values import integer
from fieldscribe.resolve.word_facts import allowed_digits, digits_of, fixed_of, text_of

if TYPE_CHECKING:
    from fieldscribe.language.nodes import Map
    from fieldscribe.resolve.drafts import Draft
    from fieldscribe.resolve.telegrams import Telegrams


@dataclass(frozen=True, slots=True)
class Resolved:
    """A point with the draft that it came from: checks need its places in the text, which the model does not have."""

    point: Point
    draft: Draft


@dataclass(frozen=True, slots=True)
class Word:
    """What is known of a point before any formula is read: its space, type, bits of the word and special codes."""

    space: str
    type: str
    bits: tuple[int, int] | None
    specials: tuple[Special, ...]
    specials_of: str

    @property
    def width(self) -> int:
        """How many bits the raw number has."""
        return TYPES[self.type].bits if self.bits is None else self.bits[0] - self.bits[1] + 1

    @property
    def holds(self) -> tuple[int, int]:
        """The least and greatest raw number."""
        return ends_of(self.width, signed=TYPES[self.type].signed)


class _Tools(NamedTuple):
    """What works out the facts of all points."""

    places: Places
    ranges: Ranges
    interner: Interner


def resolve_points(
    scope: Scope, drafts: list[Draft], index: Index, telegrams: Telegrams
) -> tuple[list[Resolved], Ranges, Places]:
    """All points of the device, computed; a wrong fact is a finding, and the usual one is assumed in its place."""
    codes = SpecialCodes(scope)
    codes.check_types()
    words = {draft: _word(scope, draft, codes) for draft in drafts}
    bounds = Bounds(
        Scales(scope, index),
        {draft: word.holds for draft, word in words.items()},
        {draft: word.specials for draft, word in words.items()},
    )
    ranges = Ranges(bounds)
    places = Places(scope, telegrams)
    tools = _Tools(places, ranges, Interner())
    resolved = [Resolved(_point(scope, draft, word, tools), draft) for draft, word in words.items()]
    return resolved, ranges, places


def _word(scope: Scope, draft: Draft, codes: SpecialCodes) -> Word:
    space = space_of(scope, draft)
    bits = bits_of(scope, draft, space)
    kind = type_of(scope, draft, space, bits)
    return Word(space, kind, bits, *codes.of(draft, kind, bits))


def _point(scope: Scope, draft: Draft, word: Word, tools: _Tools) -> Point:
    get, (places, ranges, interner) = draft.get, tools
    shape, allowed, paths = _meaning(scope, draft, word, places.access(draft, word.space), ranges)
    place, write_place = places.places(draft, word.space, word.type, word.bits)
    reason = _reason(draft, bool(place.addresses), shape.access, raw_alone=paths.raw_alone)
    default, default_raw = default_of(scope, draft, shape)
    return Point(
        name=draft.name,
        variant=draft.variant,
        code=draft.code,
        group=str(draft.group["group"]),
        space=word.space,
        place=place,
        write_place=write_place,
        shape=interner.shape(shape),
        bits=word.bits,
        title=draft.title,
        note=titles(get("note")),
        unit=_unit(scope, draft),
        allowed=interner.allowed(allowed),
        default=default,
        default_raw=default_raw,
        steps=_steps(scope, draft),
        record=draft.record,
        set=draft.set_number,
        changes=get("changes"),
        keeps=_keeps(scope, draft) if shape.writable else None,
        conditions=tuple(get("conditions", ())) if shape.writable else (),
        when=existence_of(scope, draft, ranges.bounds.scales),
        since=get("since"),
        until=get("until"),
        was=tuple(f"{name}{draft.suffix}" for name in get("was", ())),
        reserved=bool(get("reserved", False)),
        source=source_of(scope, *draft.layers, draft.group),
        errata=(),
        generated=reason is None,
        reason=reason,
        telegram=draft.group.get("telegram") if word.space == SPACE else None,
        index=None if draft.element is None else draft.element.index,
        changes_with=_changes_with(draft, ranges.bounds.scales.index),
        untyped=_untyped(scope, draft),
    )


def _meaning(scope: Scope, draft: Draft, word: Word, access: str, ranges: Ranges) -> tuple[Shape, Allowed, Paths]:
    """What the raw numbers of a point are and which may be written."""
    text, digits = text_of(scope, draft), digits_of(scope, draft)
    ranged = draft.layer("range") is not None or draft.layer("range_in_units") is not None
    said_open = bool(draft.get("open", False))
    enum = None if draft.text else enum_of(scope, draft, closed=not ranged and not said_open)
    allowed = ranges.allowed(draft, enum)
    if digits is not None and not ranged:
        allowed = allowed_digits(scope, draft, digits, word.holds[1])
    if word.specials:
        allowed = quantities(scope, draft, allowed, word.specials)
    if enum is not None and not said_open and _all_named(allowed, enum):
        enum = enum_of(scope, draft, closed=True)
    cases = _cases(draft, ranges.bounds)
    paths = paths_of(draft, cases, ranges.bounds)
    shape = Shape(
        type=word.type,
        width=word.width,
        access=access,
        scale=cases,
        decimals=paths.decimals,
        encodes_values=paths.encodes_values,
        most_raw=paths.most_raw,
        enum=enum,
        flags=flags_of(scope, draft, word.bits, word.width),
        specials=word.specials,
        specials_of=word.specials_of,
        text=text,
        digits=digits,
        fixed=fixed_of(scope, draft, word.bits, word.width) if "w" in access else None,
    )
    shown = display_of(draft, shape, ranges.bounds)
    return shape if shown is None else replace(shape, display=shown), allowed, paths


def _cases(draft: Draft, bounds: Bounds) -> tuple[ScaleCase, ...] | None:
    """The cases of the point's scale; None without a scale, or if an exponent in it is too large (a finding)."""
    cases = None if draft.floating else bounds.scales.cases(draft)
    for case in cases or ():
        if case.rule.factors and not bounds.exponents_fit(case.rule, draft.span("scale")):
            draft.failed.add("scale")
            return None
    return cases


def _reason(draft: Draft, has_place: bool, access: str, *, raw_alone: bool) -> str | None:
    """Why no code is generated for the point; None if there is code for it."""
    if not has_place:
        return "the manual prints no address"
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
    raw: Map | None = draft.get("steps")
    if raw is None:
        return ()
    steps: dict[int, int] = {}
    for key, step in raw.items():
        start = integer(key, raw.key_span(key), scope.report)
        if start is None:
            continue
        if start in steps:
            message = f"the steps from {start} on are given twice"
            scope.report.error("duplicate-enum-value", message, raw.key_span(key), "remove one of them")
        steps.setdefault(start, step)
    return tuple(sorted(steps.items()))


def _all_named(allowed: Allowed, enum: Enum) -> bool:
    """Whether every number that may be written has a name."""
    numbers = {entry.raw for entry in enum.entries}
    return not allowed.moves and all(
        high - low < len(numbers) and numbers.issuperset(range(low, high + 1)) for low, high in allowed.fixed
    )


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
