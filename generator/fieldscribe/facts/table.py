"""What an entry of the table of facts is, and how the facts of a thing are exported from the model."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import KW_ONLY, dataclass, replace
from functools import cached_property
from operator import attrgetter, itemgetter
from typing import Any, NamedTuple, TypeAlias

from fieldscribe.facts.schema import Schema
from fieldscribe.model import Device, FamilyFacts, Point, Shape, Terms
from fieldscribe.wording.rules import Points

WIRE, API, BEHAVIOUR, COMPATIBLE, DOCS = "wire", "api", "behaviour", "compatible", "docs"
"""The classes of differences: breaks on the wire, breaks code, changes behaviour, compatible, for people only."""

Exported: TypeAlias = Mapping[str, Any]
"""A device, or a thing in it, in the form of the exported model."""

Row: TypeAlias = tuple[str, str]
"""A label and a text."""

Weight: TypeAlias = "str | Callable[[Any, Any], str]"
"""A class of differences, or a function that returns it for the old and the new value."""


@dataclass(frozen=True, eq=False)
class Context:
    """What the values of facts need in addition to the thing itself; `for_code` leaves out facts for people."""

    device: Device
    for_code: bool = False
    names: Points | None = None
    """The names of points in texts, by item; their own names if None."""

    @cached_property
    def by_name(self) -> Mapping[str, Point]:
        """Points by name, and by their names with the variant."""
        return {name: point for point in self.device.points for name in (point.item, point.name)}

    @property
    def points(self) -> Points:
        """The names of points in texts."""
        return self.by_name if self.names is None else self.names

    @cached_property
    def directions(self) -> Mapping[str, str]:
        """The directions of the telegrams, by name."""
        return {telegram.name: telegram.direction for telegram in self.device.telegrams}


class View(NamedTuple):
    """What `diff` compares of an exported thing: a label, the class of a difference, and the compared value.

    No difference is reported if one of the labels that it `follows` differs too. `refers` is the kind of the things
    that the value names: renaming such a thing makes no difference. `yaml` are the keys of a description that state
    the fact, where they differ from the label.
    """

    label: str
    weight: Weight
    value: Callable[[Exported], Any]
    follows: tuple[str, ...] = ()
    refers: str = ""
    yaml: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Parts:
    """Named parts of a thing for `diff`: what `listed` gives of it, with the facts of `table` and `views`.

    Two parts are the same if their names are, or if only they have equal values for `same_by`: labels of their facts,
    or further views. `whole` is the class if all parts are added or removed at once; without it each part is reported.
    `summary` is what is reported of an added or removed part. `in_code` gives the class of a fact from the part on both
    sides, the label of the fact (empty for parts of it) and its usual class.
    """

    label: str
    kind: str
    listed: Callable[[Exported], Iterable[Exported]]
    table: FactTable
    views: tuple[View, ...] = ()
    same_by: tuple[str | View, ...] = ()
    added: str = COMPATIBLE
    removed: str = API
    renamed: Weight = API
    whole: str = ""
    summary: Callable[[Exported], Any] = itemgetter("name")
    yaml: tuple[str, ...] = ()
    in_code: Callable[[Exported, Exported, str, str], str] = lambda _old, _new, _label, weight: weight

    @cached_property
    def entries(self) -> Mapping[str, View | Parts]:
        """The views of a part, by label."""
        views = *(view for fact in self.table for view in fact.compared()), *self.views
        return {view.label: view for view in views}


@dataclass(frozen=True, eq=False)
class Fact:
    """One fact: its published key, its description, its JSON Schema, its value, and what `diff` compares.

    The value is the attribute of the same name (or `attribute`), or what the function `value` returns of the thing and
    its context; an empty attribute is an absent fact. With `table` it is a thing of that table, a list of such things
    or a mapping to them. `shared` names what decides the value of a function for a point, if it is only its `shape`,
    its `terms` or its `limits`.

    `weight`, `follows`, `refers` and `yaml` are short for one view of the exported value. A `derived` fact is neither
    compared nor in the digest: it says what it follows from. One that is not `published` is only in the digest. A fact
    `for_people` never reaches code.

    The last fields are its text for people, which `says` sets.
    """

    key: str
    doc: str
    schema: Schema
    weight: Weight = ""
    _: KW_ONLY
    attribute: str = ""
    value: Callable[[Any, Context], Any] | None = None
    table: FactTable | None = None
    shared: str = ""
    follows: tuple[str, ...] = ()
    refers: str = ""
    yaml: tuple[str, ...] = ()
    views: tuple[View | Parts, ...] = ()
    derived: str = ""
    published: bool = True
    for_people: bool = False
    label: str = ""
    text: Callable[[Any, Context], str] | None = None
    rows: Callable[[Any, Context], Iterable[Row]] | None = None
    remark: str = ""
    column: str = ""

    def of(self, value: Callable[[Any, Context], Any], shared: str = "") -> Fact:
        """Return the fact with the function that returns its value for a thing and its context.

        `shared` is what decides the value for a point, if it is only its `shape`, `terms` or `limits`.
        """
        return replace(self, value=value, shared=shared)

    def differs(self, *views: View | Parts) -> Fact:
        """Return the fact with the views that `diff` compares instead of the exported value."""
        return replace(self, views=views)

    def says(self, label: str = "", **changes: Any) -> Fact:
        """Return the fact with its text for people.

        `label` and `text` make a row of an explanation (`rows` makes several), `remark` a remark in a table of points.
        Without `text` the value is the text. `column` describes the column of the value in the sheets.
        """
        return replace(self, label=label, **changes)

    def compared(self) -> tuple[View | Parts, ...]:
        """The views of the fact that `diff` compares."""
        if self.weight:
            label = self.key.replace("_", " ")
            return View(label, self.weight, itemgetter(self.key), self.follows, self.refers, self.yaml), *self.views
        return self.views

    @cached_property
    def get(self) -> Callable[[Any, Context], Any]:
        """The value of the fact in the model."""
        if self.value is not None:
            return self.value
        attribute = attrgetter(self.attribute or self.key)
        return lambda thing, _: attribute(thing)

    @cached_property
    def holder(self) -> str:
        """What decides the value for a point: `shape`, `terms` or `limits`; empty if it is the point itself."""
        attribute = (self.attribute or self.key).partition(".")[0]
        fields = {"terms": Terms.__annotations__, "shape": Shape.__annotations__}
        by_attribute = "" if self.value else next((name for name, known in fields.items() if attribute in known), "")
        return self.shared or by_attribute

    def text_of(self, point: Point, context: Context) -> str:
        """Return the text of the fact of a point; empty if the fact is absent."""
        if self.text is not None:
            return self.text(point, context)
        return _plain_text(self.get(point, context), ", ")

    def cell_of(self, point: Point, context: Context) -> str:
        """Return the value of the fact of a point as one cell; empty if the fact is absent."""
        return _plain_text(self.get(point, context), "; ")

    def remark_of(self, point: Point, context: Context) -> str:
        """Return the fact of a point as a remark; empty if the fact is absent."""
        text = self.text_of(point, context) if self.remark else ""
        return self.remark.format(text) if text else ""

    def rows_of(self, point: Point, context: Context) -> Iterable[Row]:
        """Return the rows of label and text that explain the fact; texts may be empty."""
        if self.rows is not None:
            return self.rows(point, context)
        return [(self.label, self.text_of(point, context))] if self.label else []

    @property
    def is_number(self) -> bool:
        """True if every value is a whole number, or null."""
        return self.schema.get("type") in ("integer", ["integer", "null"])

    @cached_property
    def usual(self) -> Any:
        """The value of an absent fact: null if the schema allows it, else an empty or a false value."""
        types = self.schema.get("type")
        if "null" in types if isinstance(types, list) else {"type": "null"} in self.schema.get("anyOf", ()):
            return None
        return _EMPTY.get(str(types), ...)


def family_facts(kind: type[FamilyFacts], *facts: Fact) -> FactTable:
    """Return facts of a bus or a frame that only one family has, of the class `kind`; for others they are empty."""
    others = kind()

    def of_thing(fact: Fact) -> Fact:
        def value(thing: Any, context: Context) -> Any:
            return fact.get(thing.family_facts if isinstance(thing.family_facts, kind) else others, context)

        return replace(fact, value=value)

    return tuple(map(of_thing, facts))


def _plain_text(value: Any, separator: str) -> str:
    if value is None or value is False:
        return ""
    if value is True:
        return "yes"
    return separator.join(value) if isinstance(value, tuple) else str(value)


_EMPTY: Mapping[str, Any] = {"array": [], "object": {}, "string": "", "boolean": False}

FactTable: TypeAlias = tuple[Fact, ...]
FactsOf: TypeAlias = Callable[[FactTable, Any, Context], dict[str, Any]]


def exported(table: FactTable, thing: object, context: Context) -> dict[str, Any]:
    """Return all published facts of a thing by key, in the order of the table."""
    return {
        fact.key: plain_value(fact, fact.get(thing, context), context, exported) for fact in table if fact.published
    }


def stated(table: FactTable, thing: object, context: Context) -> dict[str, Any]:
    """Return the facts of a thing that are not derived and differ from their usual value."""
    values: dict[str, Any] = {}
    for fact in table:
        left_out = fact.derived or (fact.for_people and context.for_code)
        value = None if left_out else plain_value(fact, fact.get(thing, context), context, stated)
        if value is not None and value != fact.usual:
            values[fact.key] = value
    return values


def plain_value(fact: Fact, value: Any, context: Context, facts_of: FactsOf) -> Any:
    """Return a value as JSON data; `facts_of` turns the things of the fact's own table into objects."""
    if fact.table is None or value is None:
        return list(value) if isinstance(value, tuple) else value
    if isinstance(value, dict):
        return {key: facts_of(fact.table, thing, context) for key, thing in value.items()}
    if isinstance(value, tuple):
        return [facts_of(fact.table, thing, context) for thing in value]
    return facts_of(fact.table, value, context)
