"""Builds the points of the model from their facts: places, shapes, limits, and what points of a group share."""

from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import NamedTuple

from fieldscribe.arithmetic.exact import float_of
from fieldscribe.conditions import Condition
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import number_in
from fieldscribe.language.units import unit_hint
from fieldscribe.model import Linear, Point, Shape, Terms, Unit
from fieldscribe.resolve.addresses import Places
from fieldscribe.resolve.bounds import Bounds
from fieldscribe.resolve.bus import KEY_OF, Telegrams
from fieldscribe.resolve.conditions import condition_of
from fieldscribe.resolve.encodings import Encoding, encoding_of
from fieldscribe.resolve.point_facts import TO_END, PointFacts
from fieldscribe.resolve.ranges import Ranges
from fieldscribe.resolve.scales import IDENTITY, Scales
from fieldscribe.resolve.scope import PLAIN, Scope, source_of, titles
from fieldscribe.resolve.shapes import FactKeys, Memo, ShapeAndLimits, Shapes
from fieldscribe.resolve.special_codes import SpecialCodes
from fieldscribe.resolve.symbols import SymbolTable
from fieldscribe.resolve.values import integer, number, pattern

_MOST_NAMES = 12


class ResolvedPoint(NamedTuple):
    """A point with the facts that it was built from. Checks need their places in the text; the model has none."""

    point: Point
    facts: PointFacts


def resolve_points(
    scope: Scope, all_facts: list[PointFacts], symbols: SymbolTable, telegrams: Telegrams
) -> tuple[list[ResolvedPoint], Ranges, Places]:
    """Return all points of the device; report wrong facts, and assume defaults for them."""
    codes, kind_of, known = SpecialCodes(scope), FactKeys().of, Memo[Encoding](scope.report)
    codes.check_types()
    kinds = {facts: kind_of(facts) for facts in all_facts}
    encodings = {facts: known.of(kind, facts, partial(encoding_of, codes)) for facts, kind in kinds.items()}
    scales = Scales(scope, symbols)
    ranges, places = Ranges(Bounds(scales, encodings)), Places(scope, telegrams)
    shape_of = Shapes(scope, encodings, ranges, places).of
    points = _Points(scope, scales, places)
    resolved = [
        ResolvedPoint(points.point(facts, kind, encodings[facts], shape_of(facts, kind)), facts)
        for facts, kind in kinds.items()
    ]
    return resolved, ranges, places


class _Points:
    """Builds points from their identity and what they share with others."""

    def __init__(self, scope: Scope, scales: Scales, places: Places) -> None:
        self._scope, self._scales, self._places = scope, scales, places
        self._terms: Memo[Terms] = Memo(scope.report)

    def point(self, facts: PointFacts, kind: int, encoding: Encoding, found: ShapeAndLimits) -> Point:
        """Return the point that has these facts."""
        get, shape = facts.get, found.shape
        code, old_names = get("code"), get("was")
        place, write_place = self._places.of(facts, encoding)
        terms = self._terms.of(kind, facts, partial(self._terms_of, encoding, found), _are_general)
        default, default_raw = _default_of(self._scope, facts, shape)
        return Point(
            facts.name,
            facts.variant,
            None if code is None else str(code),
            facts.title,
            titles(get("note")),
            source_of(self._scope, *facts.layers, facts.group),
            place,
            write_place,
            shape,
            terms if place.addresses else replace(terms, generated=False, reason="the manual prints no address"),
            found.allowed,
            default,
            default_raw,
            facts.record,
            facts.set_number,
            None if facts.element is None else facts.element.index,
            () if old_names is None else tuple(map(facts.called, old_names)),
            (),
            _enum_names(facts, shape),
        )

    def _terms_of(self, encoding: Encoding, found: ShapeAndLimits, facts: PointFacts) -> Terms:
        get, scope, shape = facts.get, self._scope, found.shape
        reason = _reason(facts, shape.access, raw_alone=found.raw_alone)
        return Terms(
            group=str(facts.group["group"]),
            space=encoding.space,
            bits=encoding.bits,
            unit=_unit(scope, facts),
            steps=_steps(scope, facts),
            changes=get("changes"),
            keeps=_keeps(scope, facts) if shape.writable else None,
            conditions=tuple(get("conditions", ())) if shape.writable else (),
            when=(when := condition_of(facts, self._scales)),
            since=get("since"),
            until=get("until"),
            reserved=bool(get("reserved", False)),
            generated=reason is None,
            reason=reason,
            telegram=facts.group.get(KEY_OF.get(encoding.space, "")),
            changes_with=_other_points(facts, "changes_with", self._scales.symbols),
            untyped=_untyped(scope, facts),
            view_of=_view_of(facts, self._scales.symbols),
            certainty=_certainty(scope, facts),
            base=None if (base := scope.base_of(facts.group)) is None else base.name,
            to_end=facts.get("indices") == TO_END,
            takes_effect=_takes_effect(facts) if shape.writable else None,
            write_with=_other_points(facts, "write_with", self._scales.symbols),
            selects=_selects(facts, when, self._scales.symbols),
        )


def _are_general(terms: Terms) -> bool:
    """Return True if all points of a kind share these terms: they name no other points and do not depend on a block."""
    others = terms.changes_with or terms.view_of or terms.write_with
    return terms.when is None and not others and not terms.to_end


def _reason(facts: PointFacts, access: str, *, raw_alone: bool) -> str | None:
    """Return why no code is generated for a point with an address; None if there is code for it."""
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
    """Return the text given instead of a type; report a type beside it, and `length` beside a type."""
    words, typed = facts.layer("untyped"), facts.layer("type")
    if words is not None and words is typed and words["type"] is not None:
        message, hint = f"`{facts.name}` has both a type and `untyped`", "leave one of them out"
        scope.report.error("two-meanings", message, words.span("untyped"), hint)
    elif facts.untyped is None and "length" in facts.node and not (facts.bytes or facts.failed & {"type", "untyped"}):
        is_text = facts.get("type") == "text"
        if is_text and facts.get("characters") is None:
            return None  # it has a finding
        how = "`characters` say" if is_text else "its type says"
        hint = f"{how} how many words it takes: leave `length` out"
        scope.report.error("two-meanings", f"`{facts.name}` has a type", facts.span("length"), hint)
    return facts.untyped


def _keeps(scope: Scope, facts: PointFacts) -> str | None:
    """Return how a written value is kept; report `keeps` and `keep_with` in the same mapping."""
    kept, command = facts.layer("keeps"), facts.layer("keep_with")
    if kept is not None and kept is command:
        message, hint = "`keeps` and `keep_with` exclude each other", "leave one of them out"
        scope.report.error("two-meanings", message, kept.key_span("keep_with"), hint)
    return facts.keeps


def _enum_names(facts: PointFacts, shape: Shape) -> tuple[str, ...]:
    """Return the name and the old names of an enum in the row of the point."""
    enum = shape.named_numbers
    return () if enum is None or enum.name else (facts.enum_name, *facts.old_enum_names)


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


def _takes_effect(facts: PointFacts) -> str | None:
    """Return when the device uses a written value, None if at once."""
    when = facts.get("takes_effect")
    return None if when == "at once" else when


def _selects(facts: PointFacts, when: Condition | None, symbols: SymbolTable) -> tuple[tuple[str, int], ...]:
    """Return the points that select the meaning of the address, each with its raw number."""
    if facts.layer("select") is None or when is None:
        return ()
    names = {used.name for word in facts.get("select") for used in symbols.all(word)}
    return tuple((test.of, int(test.than[0])) for test in when.clauses[0] if test.of in names and test.test == "==")


def _other_points(facts: PointFacts, key: str, symbols: SymbolTable) -> tuple[str, ...]:
    """Return the names of the points in a list; report words that name none, and the point itself."""
    words = facts.get(key)
    names: dict[str, None] = {}
    for place, word in enumerate(words if words is not None else ()):
        used = symbols.all(word)
        if not used:
            symbols.unknown(word, words.span(place))
        if facts in used:
            message = f"`{facts.name}` cannot name itself under `{key}`"
            symbols.scope.report.error("two-meanings", message, words.span(place), "name other points")
        names.update(dict.fromkeys(writer.name for writer in used))
    return tuple(names)


def _view_of(facts: PointFacts, symbols: SymbolTable) -> str | None:
    """Return the name of the point that has the same words; report a word that names none."""
    word = facts.get("view_of")
    if word is None:
        return None
    viewed = symbols.find(word, facts)
    if viewed is None:
        symbols.unknown(word, facts.span("view_of"))
        facts.failed.add("view_of")
    elif viewed is facts:
        message = f"`{facts.name}` cannot be a view of itself"
        symbols.scope.report.error("two-meanings", message, facts.span("view_of"), "name another point")
    elif (first := viewed.get("view_of")) is not None:
        message, hint = f"`{word}` is a view itself", f"write `view_of: {first}`, which it is a view of"
        if symbols.find(first, viewed) is facts:
            hint = "leave `view_of` out at one of them"
        symbols.scope.report.error("view", message, facts.span("view_of"), hint)
        facts.failed.add("view_of")
    return None if viewed is None else viewed.name


def _certainty(scope: Scope, facts: PointFacts) -> str | None:
    """Return where the facts come from if not from the manual: as the point, its group or the device says."""
    certainty = facts.get("certainty", scope.header.get("certainty"))
    return None if certainty == "manual" else certainty


def _default_of(scope: Scope, facts: PointFacts, shape: Shape) -> tuple[Fraction | None, int | None]:
    """Return the factory setting in the unit and as raw number; None if it is not given or depends on other points."""
    stated_so = facts.layer("default") is not None or facts.layer("default_in_units") is not None
    if facts.text or not stated_so:
        return None, None
    rule = None if facts.floating else _rule(facts, shape)
    if facts.layer("default_in_units") is not None:
        stated, span = facts.get("default_in_units"), facts.span("default_in_units")
        if stated in _named_numbers(shape):
            message = f"`{stated}` is a name, and `default_in_units` is a number in the unit"
            scope.report.error("bad-number", message, span, f"write `default: {stated}`")
            return None, None
        value = number(stated, span, scope.report)
        if value is not None and facts.pattern_bits:
            raw = pattern(value, facts.pattern_bits, span, scope.report)
            return None if raw is None else value, raw
        exact = None if value is None or rule is None else rule.at(value)
        return value, exact.numerator if exact is not None and exact.denominator == 1 else None
    raw = _default_raw(scope, facts, shape)
    if raw is not None and facts.pattern_bits:
        return Fraction(float_of(raw, facts.pattern_bits)), raw
    return None if raw is None or rule is None else (raw - rule.offset) / rule.ratio, raw


def _default_raw(scope: Scope, facts: PointFacts, shape: Shape) -> int | None:
    """Return the raw number that `default` gives; None after a finding."""
    default, span, enum = facts.get("default"), facts.span("default"), shape.enum
    if facts.floating:
        message = "`default` is in raw numbers, which are bit patterns here"
        stated = default if not isinstance(default, str) or number_in(default) is not None else "1.5"
        scope.report.error("float-fact", message, span, f"write the value, as in `default_in_units: {stated}`")
        return None
    if default in (named := _named_numbers(shape)):
        return named[default]
    if isinstance(default, str) and enum is not None and default.isidentifier():
        if "enum" in facts.failed:
            return None  # it may be one of the names that could not be read
        hint = f"write a number, or one of {', '.join(entry.name for entry in enum.entries[:_MOST_NAMES])}"
        scope.report.error("bad-number", f"`{default}` is no name of this enum", span, hint)
        return None
    if isinstance(default, str) and "." in default and number_in(default) is not None:
        message = f"`{default}` has a decimal point, and `default` is in raw numbers"
        scope.report.error("bad-number", message, span, f"write `default_in_units: {default}`, or the raw number")
        return None
    return integer(default, span, scope.report)


def _named_numbers(shape: Shape) -> dict[str, int]:
    named = {special.name: special.low for special in shape.specials if special.low == special.high}
    return named | {entry.name: entry.raw for entry in (() if shape.enum is None else shape.enum.entries)}


def _rule(facts: PointFacts, shape: Shape) -> Linear | None:
    """Return the rule between value and raw number; None if it depends on other points or is unknown."""
    if shape.scale is not None:
        return shape.fixed_scale
    unsettled = facts.untyped is not None or (facts.layer("scale") is not None and facts.get("scale") is None)
    return None if unsettled and facts.get("unit") is not None else IDENTITY
