"""Points before they are computed: every record, set and variant expanded, every fact still with its place in the text."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from fieldscribe.diagnostics import Span
from fieldscribe.language.nodes import Map
from fieldscribe.model import TYPES, Titles
from fieldscribe.resolve.scope import Scope, titles

_INHERITED = (
    *("space", "type", "words", "unit", "scale", "range", "access", "keeps"),
    *("changes", "conditions", "when", "since", "until", "reserved", "source"),
)
"""What a group says for its points."""

_OWN = frozenset({"code", "at", "printed", "was", "name", "sets", "members", "record", "title"})
"""What a further set does not take from the point it repeats (the title is extended instead)."""

_OF_RECORDS = ("code", "line", "section", "page", "access", "keeps", "changes", "conditions", "when", "since", "until")
"""What the use of a record says for all its members."""

_NOT_OF_RECORDS = frozenset({*_OF_RECORDS, "name", "title", "note", "record", "at", "members"})

_OF_FORMATS = ("type", "range", "scale", "unit", "enum", "flags", "special")
"""What an unknown format leaves open."""

_SET_WORDS = {"en": "set", "de": "Parametersatz"}


@dataclass(slots=True, eq=False)
class Draft:
    """One expanded point: its layers of facts, own facts first, and the group last. `use` is where its record is used.

    `failed` collects the facts that turned out wrong, so that nothing is held against what was taken in their place.
    """

    name: str
    layers: tuple[Map, ...]
    group: Map
    own: Map
    title: Titles
    variant: str | None = None
    record: str | None = None
    set_number: int | None = None
    use: Map | None = None
    enum_name: str = ""
    hidden: frozenset[str] = frozenset()
    failed: set[str] = field(default_factory=set)
    _where: dict[str, Map] = field(default_factory=dict)

    def __post_init__(self) -> None:
        group, where = self.group, self._where
        for key in _INHERITED:
            if key in group:
                where[key] = group
        for layer in reversed(self.layers):
            keys = layer if layer is self.own or not self.hidden else layer.keys() - self.hidden
            where.update(dict.fromkeys(keys, layer))
            self.failed.difference_update(keys)
            self.failed.update(layer.broken)
        if ("enum" in where or "flags" in where or self.floating) and where.get("scale") is group:
            del where["scale"]  # a scale for the numbers of a group is none for its names and floats

    @property
    def floating(self) -> bool:
        """Whether the point says that it is a floating-point number."""
        return TYPES[self.get("type", "u16")].floating

    def layer(self, key: str) -> Map | None:
        """The layer that says this fact."""
        return self._where.get(key)

    def get(self, key: str, otherwise: Any = None) -> Any:
        """The fact, or `otherwise`."""
        found = self._where.get(key)
        return otherwise if found is None else found[key]

    def span(self, key: str | None = None) -> Span:
        """Where the fact stands, or the point's name when nobody says it."""
        found = self._where.get(key) if key is not None else None
        if found is not None and key is not None:
            return found.span(key)
        return self.own.span("name" if "name" in self.own else None)

    @property
    def code(self) -> str | None:
        """The manual's short name."""
        found = self.get("code")
        return None if found is None else str(found)

    @property
    def item(self) -> str:
        """The name with the variant's value."""
        return self.name if self.variant is None else f"{self.name}_{self.variant.partition('=')[2].lower()}"


def groups(scope: Scope) -> Iterator[Map]:
    """The mappings that hold points: the entries of `groups` and each part with `group`."""
    for file in scope.files:
        yield from file.get("groups", ())
        if "group" in file and "space" in file:
            yield file


def expand(scope: Scope) -> list[Draft]:
    """All points of all groups, in the order of the text."""
    return [
        draft for group in groups(scope) for point in group.get("points", ()) for draft in _point(scope, group, point)
    ]


def _point(scope: Scope, group: Map, point: Map) -> Iterator[Draft]:
    if "record" in point:
        yield from _record(scope, group, point)
        return
    name = point["name"]
    layers = (point, *_format(scope, point))
    title = titles(point.get("title"), humanised(name))
    sets: Map | None = point.get("sets")
    yield from _variants(
        scope, Draft(name, layers, group, point, title, set_number=1 if sets else None, enum_name=name)
    )
    for number, override in sets.items() if sets is not None else ():
        own_title = titles(override.get("title")) or _set_title(title, number)
        own_name = f"{name}_set_{int(number)}"
        enum_name = own_name if "enum" in override else name
        repeated = Draft(
            own_name,
            (override, *layers),
            group,
            override,
            own_title,
            set_number=int(number),
            enum_name=enum_name,
            hidden=_OWN,
        )
        yield from _variants(scope, repeated)


def _variants(scope: Scope, draft: Draft) -> Iterator[Draft]:
    overrides: Map | None = draft.get("variants")
    if not overrides:
        yield draft
        return
    axes = scope.axes
    first = ""
    for key, override in overrides.items():
        axis, _, value = key.partition("=")
        span = overrides.key_span(key)
        if axis not in axes or value not in axes[axis]["values"]:
            known = [f"{one}={each}" for one, entry in axes.items() for each in entry["values"]]
            scope.unknown("unknown-variant", "variant", key, span, known, "variants")
        elif axis != (first := first or axis):
            message = f"`{draft.name}` differs by `{first}` and by `{axis}`"
            scope.report.error(
                "two-axes", message, span, "a point can differ by one axis only; make it two points with `when`"
            )
        else:
            yield _varied(draft, key, value, override)


def _varied(draft: Draft, key: str, value: str, override: Map) -> Draft:
    return Draft(
        draft.name,
        (override, *draft.layers),
        draft.group,
        draft.own,
        draft.title,
        variant=key,
        record=draft.record,
        set_number=draft.set_number,
        use=draft.use,
        enum_name=f"{draft.enum_name}_{value.lower()}" if "enum" in override else draft.enum_name,
        hidden=draft.hidden - override.keys(),
    )


def _record(scope: Scope, group: Map, use: Map) -> Iterator[Draft]:
    record = scope.records.get(use["record"])
    if record is None:
        scope.unknown("unknown-record", "record", use["record"], use.span("record"), scope.records, "records")
        return
    for key in use:
        if key not in _NOT_OF_RECORDS and not key.startswith("x-"):
            message = f"`{key}` cannot be said for a whole record"
            scope.report.error("record-key", message, use.key_span(key), "say it for one member under `members`")
    members = {point["name"] for point in record["points"]}
    for name in use.get("members", {}):
        if name not in members:
            span = use["members"].key_span(name)
            scope.unknown("unknown-member", "member of the record", name, span, sorted(members), "records")
    for point in record["points"]:
        if "record" in point:
            message = f"a record cannot contain the record `{point['record']}`"
            scope.report.error("record-cycle", message, point.span("record"), "write its points out")
        elif "sets" in point:
            message = "the points of a record cannot repeat in sets"
            scope.report.error("record-key", message, point.key_span("sets"), "use the record once for each set")
        else:
            yield from _variants(scope, _member(scope, group, use, point))


def _member(scope: Scope, group: Map, use: Map, point: Map) -> Draft:
    override: Map | None = use.get("members", {}).get(point["name"])
    shared = (point,) if override is None else (override, point)
    together = titles(use.get("title"), humanised(use["name"]))
    single = titles(point.get("title"), humanised(point["name"]))
    title = {language: f"{text}: {single.get(language, single['en'])}" for language, text in together.items()}
    layers = (*shared, *_format(scope, point), _whole_record(use))
    name = f"{use['name']}_{point['name']}"
    enum_name = name if override is not None and "enum" in override else f"{use['record']}_{point['name']}"
    return Draft(name, layers, group, shared[0], title, record=use["name"], use=use, enum_name=enum_name)


def _whole_record(use: Map) -> Map:
    """What the use of a record says for all its members: where it stands in the manual, and the code of the whole."""
    result = Map(use.file, use.at)
    for key in _OF_RECORDS:
        if key in use:
            result[key] = use[key]
            result.value_at[key] = use.value_at[key]
    return result


def _format(scope: Scope, point: Map) -> tuple[Map, ...]:
    if "format" not in point:
        return ()
    found = scope.formats.get(point["format"])
    if found is None:
        scope.unknown("unknown-format", "format", point["format"], point.span("format"), scope.formats, "formats")
        nothing = Map(point.file, point.at)
        nothing.broken = _OF_FORMATS
        return (nothing,)
    return (found,)


def _set_title(title: Titles, number: str) -> Titles:
    return {language: f"{text} ({_SET_WORDS.get(language, 'set')} {int(number)})" for language, text in title.items()}


def humanised(name: str) -> str:
    """`base_frequency` as `Base frequency`."""
    return name.replace("_", " ").capitalize()
