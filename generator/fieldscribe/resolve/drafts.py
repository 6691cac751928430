"""Points before they are computed: every record, set and variant expanded, every fact still with its place in the text."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from fieldscribe.diagnostics import Span
from fieldscribe.language.nodes import Map
from fieldscribe.model import Titles
from fieldscribe.resolve.scope import Scope, titles, unknown_name

_INHERITED = frozenset(
    "space type words unit scale range access keeps changes conditions when since until reserved source".split()
)
"""What a group says for its points."""

_OWN = frozenset("code at printed was name sets members record title".split())
"""What a further set does not take from the point it repeats (the title is extended instead)."""

_SET_WORDS = {"en": "set", "de": "Parametersatz"}


@dataclass(slots=True)
class Draft:
    """One expanded point: its layers of facts, own facts first, and the group last. `use` is where its record is used."""

    name: str
    layers: tuple[Map, ...]
    group: Map
    own: Map
    title: Titles
    variant: str | None = None
    record: str | None = None
    set: int | None = None
    use: Map | None = None
    enum_name: str = ""
    hidden: frozenset[str] = field(default_factory=frozenset)

    def layer(self, key: str) -> Map | None:
        """The layer that says this fact."""
        for one in self.layers:
            if key in one and (one is self.own or key not in self.hidden):
                return one
        return self.group if key in _INHERITED and key in self.group else None

    def get(self, key: str, otherwise: Any = None) -> Any:
        """The fact, or `otherwise`."""
        found = self.layer(key)
        return otherwise if found is None else found[key]

    def span(self, key: str | None = None) -> Span:
        """Where the fact stands, or the point's name when nobody says it."""
        found = self.layer(key) if key is not None else None
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
        if "group" in file:
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
    layers = (point, *_format(scope, point))
    title = titles(point.get("title"), humanised(point["name"]))
    first = 1 if "sets" in point else None
    plain = Draft(point["name"], layers, group, point, title, set=first, enum_name=point["name"])
    yield from _variants(scope, plain)
    for number, override in point.get("sets", {}).items():
        own_title = titles(override.get("title")) or _set_title(title, number)
        name = f"{point['name']}_set_{int(number)}"
        repeated = Draft(
            name, (override, *layers), group, override, own_title, set=int(number), enum_name=point["name"], hidden=_OWN
        )
        yield from _variants(scope, repeated)


def _variants(scope: Scope, draft: Draft) -> Iterator[Draft]:
    overrides = draft.get("variants")
    if not overrides:
        yield draft
        return
    axes = scope.header.get("variants", {})
    for key, override in overrides.items():
        axis, _, value = key.partition("=")
        if value not in axes.get(axis, {}).get("values", {}):
            known = [f"{one}={each}" for one, entry in axes.items() for each in entry["values"]]
            scope.report.error(
                "unknown-variant",
                f"device.yaml declares no variant `{key}`",
                overrides.key_span(key),
                unknown_name(key, known, "variants"),
            )
            continue
        enum_name = f"{draft.enum_name}_{value.lower()}" if "enum" in override else draft.enum_name
        yield Draft(
            draft.name, (override, *draft.layers), draft.group, draft.own, draft.title, key, draft.record, draft.set, draft.use,
            enum_name, draft.hidden,
        )  # fmt: skip


def _record(scope: Scope, group: Map, use: Map) -> Iterator[Draft]:
    record = scope.records.get(use["record"])
    if record is None:
        hint = unknown_name(use["record"], sorted(scope.records), "records")
        scope.report.error("unknown-record", f"there is no record `{use['record']}`", use.span("record"), hint)
        return
    members = {point["name"] for point in record["points"]}
    for name in use.get("members", {}):
        if name not in members:
            hint = unknown_name(name, sorted(members), "points` of the record, `")
            scope.report.error(
                "unknown-member", f"the record has no member `{name}`", use["members"].key_span(name), hint
            )
    for point in record["points"]:
        if "record" in point:
            message = f"a record cannot contain the record `{point['record']}`"
            scope.report.error("record-cycle", message, point.span("record"), "write its points out")
            continue
        yield _member(scope, group, use, point)


def _member(scope: Scope, group: Map, use: Map, point: Map) -> Draft:
    override = use.get("members", {}).get(point["name"])
    shared = tuple(layer for layer in (override, point) if layer is not None)
    together = titles(use.get("title"), humanised(use["name"]))
    single = titles(point.get("title"), humanised(point["name"]))
    title = {language: f"{together[language]}: {single.get(language, single['en'])}" for language in together}
    layers = (*shared, *_format(scope, point), _whole_record(use))
    name = f"{use['name']}_{point['name']}"
    enum_name = f"{use['record']}_{point['name']}"
    return Draft(
        name,
        layers,
        group,
        override if override is not None else point,
        title,
        record=use["name"],
        use=use,
        enum_name=enum_name,
    )


def _whole_record(use: Map) -> Map:
    """What the use of a record says for all its members: where it stands in the manual, and the code of the whole."""
    result = Map(use.file, use.at)
    for key in (
        "code",
        "line",
        "section",
        "page",
        "access",
        "keeps",
        "changes",
        "conditions",
        "when",
        "since",
        "until",
    ):
        if key in use:
            result[key] = use[key]
            result.value_at[key] = use.value_at[key]
    return result


def _format(scope: Scope, point: Map) -> tuple[Map, ...]:
    if "format" not in point:
        return ()
    found = scope.formats.get(point["format"])
    if found is None:
        hint = unknown_name(point["format"], sorted(scope.formats), "formats")
        scope.report.error("unknown-format", f"there is no format `{point['format']}`", point.span("format"), hint)
        return ()
    return (found,)


def _set_title(title: Titles, number: str) -> Titles:
    return {language: f"{text} ({_SET_WORDS.get(language, 'set')} {int(number)})" for language, text in title.items()}


def humanised(name: str) -> str:
    """`base_frequency` as `Base frequency`."""
    return name.replace("_", " ").capitalize()
