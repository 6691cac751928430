"""Expands the rows of all groups into points: every record, set, index and variant written out."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from fieldscribe.language.keys import identifying_keys, inherited, keys_of
from fieldscribe.language.keys.places import FORMAT, POINT, USE
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import parse_integer
from fieldscribe.language.suggestions import value_hint
from fieldscribe.model import Titles, Variant, item_of
from fieldscribe.resolve.point_facts import Element, PointFacts, elements_of, set_title
from fieldscribe.resolve.scope import Scope, titles
from fieldscribe.text import humanised

MOST_POINTS = 100_000
"""The most points of a device. Without a limit, rows that repeat could fill the memory."""

_LAST_SET = 999
_AXES = frozenset(("sets", "indices", "set", "index"))
"""Keys of a row that describes several points, or one of several."""
_OWN = identifying_keys(POINT)
"""Keys that a further set does not inherit from the row that it repeats; the title is extended instead."""
_OF_RECORDS = inherited(USE)
"""Keys that the use of a record may set for all its members."""


def expand(scope: Scope) -> list[PointFacts]:
    """Return the points of all groups in the order of the text; report more than MOST_POINTS."""
    points: list[PointFacts] = []
    for group in scope.groups:
        for point in group.get("points", ()):
            points.extend(_point(scope, group, point))
            if len(points) > MOST_POINTS:
                message = f"the rows up to here stand for more than {MOST_POINTS} points"
                hint = "look at the sets, indices and records"
                scope.report.error("too-many-items", message, point.span("name"), hint)
                return points[:MOST_POINTS]
    return points


def _point(scope: Scope, group: Map, point: Map) -> Iterable[PointFacts]:
    if "record" in point:
        return _record(scope, group, point)
    if "cases" in point:
        return _cases(scope, group, point)
    rows = point.get("sets")
    if not isinstance(rows, Map) and not _AXES.isdisjoint(point):
        return _elements(scope, group, point)
    if "each" in point and _AXES.isdisjoint(point.broken):
        message = f"`{point['name']}` has no elements that could differ"
        hint = "`each` belongs to a count of `sets`, or to `indices`"
        scope.report.error("unknown-element", message, point.key_span("each"), hint)
    title = _title(point)
    facts = PointFacts(point["name"], (point, *_format(scope, point)), group, point, title, enum_name=point["name"])
    return _variants(scope, facts) if rows is None else _sets(scope, facts, rows)


def _cases(scope: Scope, group: Map, point: Map) -> Iterator[PointFacts]:
    """Yield a point for each meaning of the row; report a case without a condition, and keys that repeat it too."""
    row = PointFacts(point["name"], (point, *_format(scope, point)), group, point, _title(point))
    row.set_number = row.get("set")
    row.element = _single_element(scope, row)
    cases: Map = point["cases"]
    for key in ("sets", "indices", "each", "variants"):
        if key in point:
            hint = "say it in the `when` of each case, or write rows of their own"
            message = f"`{row.name}` has `cases` and `{key}`"
            scope.report.error("two-meanings", message, point.key_span(key), hint)
    for name, override in cases.items():
        words = humanised(name).lower()
        title = titles(override.get("title")) or {language: f"{text} ({words})" for language, text in row.title.items()}
        own_name = f"{row.name}_{name}"
        enum_name = own_name if "enum" in override else row.name
        case = replace(row, name=own_name, layers=(override, *row.layers), title=title, enum_name=enum_name)
        if "when" not in override and "when" not in override.broken:
            message, hint = f"the case `{name}` does not say when it holds", "add `when: …`"
            scope.report.error("missing-key", message, cases.key_span(name), hint)
            case.failed.add("when")
        yield case


def _title(point: Map) -> Titles:
    """Return the title of a row; without one, its name in words."""
    title = point.get("title")
    return titles(title, "" if isinstance(title, Map) and "en" in title else humanised(point["name"]))


def _sets(scope: Scope, first: PointFacts, rows: Map) -> Iterator[PointFacts]:
    """Yield the point in its own set, and in each further set that has a row under `sets`."""
    if "indices" in first.node:
        message = f"`{first.name}` repeats in indices, and in sets that have rows of their own"
        hint = "write a point with its `indices` for each set"
        scope.report.error("two-meanings", message, first.node.key_span("indices"), hint)
    first.set_number = first.get("set", 1)
    first.element = _single_element(scope, first)
    yield from _variants(scope, first)
    for number, override in _further_sets(scope, rows, first.set_number):
        own_name = f"{first.name}_set_{number}"
        repeated = replace(
            first,
            name=own_name,
            layers=(override, *first.layers),
            node=override,
            title=titles(override.get("title")) or set_title(first.title, number),
            set_number=number,
            enum_name=own_name if "enum" in override else first.name,
            hidden=_OWN,
        )
        repeated.element = _single_element(scope, repeated)
        yield from _variants(scope, repeated)


def _further_sets(scope: Scope, rows: Map, own_set: int | None) -> Iterator[tuple[int, Map]]:
    """Yield the further sets by number; report wrong numbers and repeated ones."""
    seen: set[int] = set()
    for key in rows:
        number, span = parse_integer(key), rows.key_span(key)
        if number == own_set:
            hint = "say by `set` which set the point's own row is, if it is not the first; name the others here"
            scope.report.error("wrong-choice", f"the set {number} is the point itself", span, hint)
        elif number > _LAST_SET:
            scope.report.error("wrong-choice", f"there is no set {number}", span, f"sets are 0..{_LAST_SET}")
        elif number in seen:
            scope.report.error("duplicate-name", f"the set {number} is given twice", span, "say it once")
        else:
            seen.add(number)
            yield number, rows[key]


def _single_element(scope: Scope, facts: PointFacts) -> Element | None:
    """Return the element of a row that states its own set or index; None if it states none."""
    if facts.get("index") is None and (facts.get("set") is None or isinstance(facts.get("sets"), Map)):
        return None
    elements = elements_of(scope, facts)
    return elements[0] if len(elements) == 1 else None


def _elements(scope: Scope, group: Map, point: Map) -> Iterator[PointFacts]:
    """Yield the points of a row with `sets` and `indices`."""
    title = _title(point)
    layers = (point, *_format(scope, point))
    elements = elements_of(scope, PointFacts(point["name"], layers, group, point, title))
    rows: Map = point.get("each") or Map(point.file, point.start)
    overrides: dict[str, Map] = {}
    spelt: dict[str, str] = {}
    known = dict.fromkeys(key for element in elements for key in reversed(element.keys))
    for key, override in rows.items():
        number = "/".join(str(parse_integer(part)) for part in key.split("/"))  # `1/2` for `01h/2`
        if overrides.setdefault(number, override) is not override:
            first = [(rows.key_span(spelt[number]), "first given here")]
            message = f"the element {key} is given twice"
            scope.report.error("duplicate-name", message, rows.key_span(key), "say it once", first)
        spelt.setdefault(number, key)
        if elements and number not in known:
            message = f"`{point['name']}` has no element {key}"
            hint = f"known: {', '.join(list(known)[:12]) or 'none'}"
            scope.report.error("unknown-element", message, rows.key_span(key), hint)
    for element in elements:
        overriding = tuple(overrides[key] for key in element.keys if key in overrides)
        name = point["name"] + element.suffix
        own_title = next((titles(override["title"]) for override in overriding if "title" in override), None)
        yield from _variants(
            scope,
            PointFacts(
                name,
                (*overriding, *layers),
                group,
                point,
                own_title or element.titled(title),
                set_number=element.set_number,
                element=element,
                enum_name=name if any("enum" in override for override in overriding) else point["name"],
            ),
        )


def _variants(scope: Scope, facts: PointFacts) -> Iterable[PointFacts]:
    """Return the point once for each of its variants, or unchanged if it has none."""
    overrides: Map | None = facts.get("variants")
    return _all_varied(scope, facts, overrides) if overrides else (facts,)


def _all_varied(scope: Scope, facts: PointFacts, overrides: Map) -> Iterator[PointFacts]:
    axes = scope.axes
    first = ""
    for key, override in overrides.items():
        axis, _, value = key.partition("=")
        span = overrides.key_span(key)
        if axis not in axes or value not in axes[axis]["values"]:
            known = [f"{name}={choice}" for name, entry in axes.items() for choice in entry["values"]]
            scope.unknown("variant", key, span, known)
        elif axis != (first := first or axis):
            message = f"`{facts.name}` differs by `{first}` and by `{axis}`"
            hint = "a point can differ by one axis only; make it two points with `when`"
            scope.report.error("two-axes", message, span, hint)
        else:
            yield _varied(scope, facts, Variant(axis, value), override)


def _varied(scope: Scope, facts: PointFacts, variant: Variant, override: Map) -> PointFacts:
    varied = replace(
        facts,
        layers=(override, *facts.layers),
        variant=variant,
        enum_name=item_of(facts.enum_name, variant) if "enum" in override else facts.enum_name,
        hidden=facts.hidden - override.keys(),
    )
    own_key = next((key for key in ("set", "index") if key in override), None)
    if own_key is None:
        return varied
    if facts.suffix:
        message = f"the row of `{facts.node['name']}` stands for several points, and its variant for one of them"
        hint = "give the variant a row of its own"
        scope.report.error("two-meanings", message, override.key_span(own_key), hint)
        return varied
    varied.element = _single_element(scope, varied)
    return varied


def _record(scope: Scope, group: Map, use: Map) -> Iterator[PointFacts]:
    """Yield the points of a record where a row uses it."""
    record = scope.records.get(use["record"])
    if record is None:
        scope.unknown("record", use["record"], use.span("record"), scope.records)
        return
    for key in use:
        if key not in keys_of(USE) and not key.startswith("x-"):
            message = f"`{key}` cannot be given for a whole record"
            scope.report.error("record-key", message, use.key_span(key), "give it for one member under `members`")
    members = {point["name"] for point in record["points"]}
    for name in use.get("members", {}):
        if name not in members:
            span = use["members"].key_span(name)
            scope.unknown("member", name, span, sorted(members))
    for point in record["points"]:
        if "record" in point:
            message = f"a record cannot contain the record `{point['record']}`"
            scope.report.error("record-cycle", message, point.span("record"), "write its points out")
        elif keys := [key for key in ("sets", "indices", "set", "index", "each", "cases") if key in point]:
            message = "the points of a record cannot repeat in sets, indices or cases"
            scope.report.error("record-key", message, point.key_span(keys[0]), "use the record once for each of them")
        else:
            yield from _variants(scope, _member(scope, group, use, point))


def _member(scope: Scope, group: Map, use: Map, point: Map) -> PointFacts:
    override: Map | None = use.get("members", {}).get(point["name"])
    shared = (point,) if override is None else (override, point)
    together = titles(use.get("title"), humanised(use["name"]))
    single = _title(point)
    title = {language: f"{text}: {single.get(language, single['en'])}" for language, text in together.items()}
    layers = (*shared, *_format(scope, point), _whole_record(use))
    name = f"{use['name']}_{point['name']}"
    enum_name = name if override is not None and "enum" in override else f"{use['record']}_{point['name']}"
    return PointFacts(name, layers, group, shared[0], title, record=use["name"], use=use, enum_name=enum_name)


def _whole_record(use: Map) -> Map:
    """Return what a use of a record gives all its members: the place in the manual, and the common code."""
    result = Map(use.file, use.start)
    for key in _OF_RECORDS:
        if key in use:
            result[key] = use[key]
    return result


def _format(scope: Scope, point: Map) -> tuple[Map, ...]:
    """Return the layer of the point's `format`, if it has one; all keys of an unknown format count as broken."""
    if "format" not in point:
        return ()
    facts = scope.formats.get(point["format"])
    if facts is None:
        hint = value_hint("type", point["format"])
        scope.unknown("format", point["format"], point.span("format"), scope.formats, hint)
        nothing = Map(point.file, point.start)
        nothing.broken = tuple(keys_of(FORMAT))
        return (nothing,)
    return (facts,)
