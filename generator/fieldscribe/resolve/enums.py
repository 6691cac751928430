"""Reads the entries of enums, and refuses numbers and names that are given twice."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from fieldscribe.diagnostics import Report, Span
from fieldscribe.language.nodes import Map
from fieldscribe.language.suggestions import suggest_interval
from fieldscribe.model import Entry, Enum
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope, humanised, titles
from fieldscribe.resolve.values import integer


def enum_of(scope: Scope, facts: PointFacts, closed: bool) -> Enum | None:
    """Return the point's enum; None if it has none, or after a finding."""
    raw = facts.get("enum")
    if raw is None:
        return None
    enum = named_enum(scope, facts, raw, facts.span("enum"), closed=closed)
    entries = scope.named_enums.get(raw) if isinstance(raw, str) else raw
    if enum is None or entries is None or entries.broken or len(enum.entries) < len(entries):
        facts.failed.add("enum")  # some of its names are not known
    return enum


def named_enum(scope: Scope, facts: PointFacts, raw: Map | str, span: Span, *, closed: bool) -> Enum | None:
    """Return a shared enum by its name, or an inline one, which is named after the point once for all its sets.

    None, after a finding, if there is no shared enum of that name.
    """
    name, entries, was = facts.enum_name, raw, facts.old_enum_names
    if isinstance(raw, str):
        name, entries, was = raw, scope.named_enums.get(raw, raw), ()
    if isinstance(entries, str):
        scope.unknown("enum", name, span, scope.named_enums)
        return None
    key = (name, id(entries), closed)
    if key not in scope.enums:
        scope.enums[key] = Enum(name, {"en": humanised(name)}, entries_of(scope, entries), closed, was)
    return scope.enums[key]


def entries_of(scope: Scope, node: Map) -> tuple[Entry, ...]:
    """Return the named numbers in the author's order."""
    taken = Taken(scope.report, "number")
    entries = ((key, _entry(scope, node, key, value)) for key, value in node.items())
    return tuple(
        entry
        for key, entry in entries
        if entry is not None and taken.take(entry.raw, entry.raw, entry.name, node.key_span(key), node.span(key))
    )


def _entry(scope: Scope, node: Map, key: str, value: Any) -> Entry | None:
    if suggest_interval(key) is not None:
        hint = "write a row for each number that has a name; the others need none"
        scope.report.error("bad-number", f"`{key[:60]}` is not a single number", node.key_span(key), hint)
        return None
    number = integer(key, node.key_span(key), scope.report)
    if number is None:
        return None
    name = name_of(value)
    return Entry(number, name, entry_titles(value, name), None if isinstance(value, str) else value.get("quantity"))


def name_of(value: Map | str) -> str:
    """Return the name of an entry, which stands alone or among other facts."""
    return value if isinstance(value, str) else str(value["name"])


def entry_titles(value: Map | str, name: str) -> Mapping[str, str]:
    """Return the titles of an entry by language; without an English one, its name in words."""
    if isinstance(value, str):
        return {"en": humanised(name)}
    texts = {key: str(text) for key, text in value.items() if len(key) == 2}
    return {"en": humanised(name), **titles(value.get("title")), **texts}


@dataclass(slots=True)
class Taken:
    """The numbers and names that were given so far, with their places. `what` is the word for a number in messages."""

    report: Report
    what: str
    rule: str = "duplicate-enum-value"
    _numbers: dict[int, Span] = field(default_factory=dict)
    _names: dict[str, Span] = field(default_factory=dict)

    def take(self, low: int, high: int, name: str, key: Span, value: Span) -> bool:
        """Take the numbers low..high and a name; report and return False if one of them was taken before."""
        numbers = range(low, high + 1)
        first = next((self._numbers[number] for number in numbers if number in self._numbers), None)
        if first is not None:
            message = f"the {self.what} {low if low == high else f'{high}..{low}'} is given twice"
            self.report.error(self.rule, message, key, "remove one of them", [(first, "first given here")])
        elif name in self._names:
            related = [(self._names[name], "first given here")]
            message = f"the name `{name}` is given twice"
            self.report.error("duplicate-enum-name", message, value, "rename one of them", related)
        else:
            self._numbers.update(dict.fromkeys(numbers, key))
            self._names[name] = value
            return True
        return False
