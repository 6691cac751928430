"""Compares two exported models: returns their differences, each with class, thing and fact, old and new."""

import re
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

from fieldscribe.facts.devices import device_table
from fieldscribe.facts.table import COMPATIBLE, Exported, Parts, View, Weight

_RAW = re.compile(r"\b([a-z0-9_]+)(?=\.raw\b)")
"""A point in the expression of a limit."""


class Thing(NamedTuple):
    """A thing or a part of one: its kind, and its name on both sides; None for a side without it."""

    kind: str
    old: str | None
    new: str | None

    @property
    def name(self) -> str:
        """The name, the new one if there are two."""
        return self.new or self.old or ""


class Difference(NamedTuple):
    """A fact that differs: its class, the things that have it (outermost first), and its values.

    The fact is empty if the innermost thing itself was added, removed or renamed.
    """

    weight: str
    things: tuple[Thing, ...]
    fact: str
    old: Any
    new: Any

    @property
    def is_rename(self) -> bool:
        """Return True if the innermost thing was renamed."""
        return not self.fact and None not in self.things[-1][1:]


Entries: TypeAlias = "Mapping[str, View | Parts]"
"""The views of a thing, by label."""


def differences(old: Exported, new: Exported) -> list[Difference]:
    """Return all differences of two exported models, in the order of the table of facts and of the new model."""
    table = device_table(new["family"])
    entries = {view.label: view for fact in table for view in fact.compared()}
    comparison = _Comparison(entries, old, new)
    comparison.compare(entries, old, new, ())
    return comparison.found


class _Comparison:
    """Walks both sides along the table of facts."""

    def __init__(self, entries: Entries, old: Exported, new: Exported) -> None:
        self.found: list[Difference] = []
        matches = {entry.kind: _matched(entry, old, new) for entry in entries.values() if isinstance(entry, Parts)}
        self._new_names = {kind: match.new_names for kind, match in matches.items()}
        self._unmatched = {kind: match.unmatched for kind, match in matches.items()}

    def compare(self, entries: Entries, old: Exported, new: Exported, things: tuple[Thing, ...]) -> None:
        """Add the differences of a thing that both sides have."""
        differing: set[str] = set()
        for label, entry in sorted(entries.items(), key=_follows_others):
            before = len(self.found)
            if isinstance(entry, Parts):
                if self._compare_parts(entry, old, new, things):
                    differing.add(f"{label} as a whole")
            elif differing.isdisjoint(entry.follows):
                self._compare_view(entry, old, new, things)
            if len(self.found) > before:
                differing.add(label)

    def _compare_view(self, view: View, old: Exported, new: Exported, things: tuple[Thing, ...]) -> None:
        before, after = view.value(old), view.value(new)
        if before == after or (view.refers and self._names_the_same(view.refers, before, after)):
            return
        self.found.append(Difference(_class(view.weight, before, after), things, view.label, before, after))

    def _names_the_same(self, kind: str, before: Any, after: Any) -> bool:
        """Return True if only names of renamed things differ, and in lists the names of added or removed things."""
        before, unmatched = renamed(before, self._new_names.get(kind, {})), self._unmatched.get(kind, frozenset())
        if isinstance(before, list) and isinstance(after, list) and unmatched:
            before, after = (
                [item for item in items if not isinstance(item, str) or item not in unmatched]
                for items in (before, after)
            )
        return bool(before == after)

    def _compare_parts(self, parts: Parts, old: Exported, new: Exported, things: tuple[Thing, ...]) -> bool:
        """Add the differences of parts; return True if all of them were added or removed, which is one difference."""
        pairs, removed, added = _matched(parts, old, new)
        if parts.whole and not pairs and bool(removed) != bool(added):
            names = [[part["name"] for part in side] or None for side in (removed, added)]
            self.found.append(Difference(parts.whole, things, parts.label, *names))
            return True
        for before, after in pairs:
            if before != after:
                self._compare_pair(parts, before, after, things)
        for part in added:
            inner = (*things, Thing(parts.kind, None, part["name"]))
            self.found.append(Difference(parts.added, inner, "", None, parts.summary(part)))
        for part in removed:
            inner = (*things, Thing(parts.kind, part["name"], None))
            self.found.append(Difference(parts.removed, inner, "", parts.summary(part), None))
        return False

    def _compare_pair(self, parts: Parts, old: Exported, new: Exported, things: tuple[Thing, ...]) -> None:
        """Add the differences of a part that both sides have, its name first."""
        name = old["name"]
        inner = (*things, Thing(parts.kind, name, new["name"]))
        if name != new["name"]:
            kept = name in new.get("was", ())
            weight = COMPATIBLE if kept else _class(parts.renamed, old, new)
            self.found.append(Difference(weight, inner, "", name, new["name"]))
            new = {**new, **_following(old, new)}
        before = len(self.found)
        self.compare(parts.entries, old, new, inner)
        for number, difference in enumerate(self.found[before:], before):
            fact = difference.fact if difference.things == inner else ""
            self.found[number] = difference._replace(weight=parts.in_code(old, new, fact, difference.weight))


def _follows_others(entry: tuple[str, View | Parts]) -> bool:
    """Return True if differences of an entry depend on those of others, which come first."""
    return isinstance(entry[1], View) and bool(entry[1].follows)


def _following(old: Exported, new: Exported) -> Exported:
    """Return what follows from a new name and is not a difference: old names, the name of its enum, a derived title."""
    following: dict[str, Any] = {}
    enums = old.get("enum_name"), new.get("enum_name")
    if enums[0] in new.get("enum_was", ()) or enums == (old["name"], new["name"]):
        following["enum_name"] = old["enum_name"]
    if old["name"] in new.get("was", ()):
        following["was"] = [other for other in new["was"] if other != old["name"]]
    before, after = (part.get("title", {}).get("en", "") for part in (old, new))
    words = _changed_words(old["name"].split("_"), new["name"].split("_"))
    if before != after == before.replace(*words):
        following["title"] = {**new["title"], "en": before}
    return following


def _changed_words(old: list[str], new: list[str]) -> tuple[str, str]:
    """Return the words in which two names differ, as in titles: Ramp and Slope for `ramp_set_2` and `slope_set_2`."""
    while len(old) > 1 and len(new) > 1 and old[-1] == new[-1]:
        old, new = old[:-1], new[:-1]
    return " ".join(old).capitalize(), " ".join(new).capitalize()


class _Matched(NamedTuple):
    """The parts of both sides: matched pairs, removed and added parts."""

    pairs: list[tuple[Exported, Exported]]
    removed: list[Exported]
    added: list[Exported]

    @property
    def new_names(self) -> dict[str, str]:
        """The new names, by old name."""
        return {old["name"]: new["name"] for old, new in self.pairs if old["name"] != new["name"]}

    @property
    def unmatched(self) -> frozenset[str]:
        """The names of removed and added parts."""
        return frozenset(part["name"] for part in (*self.removed, *self.added))


def _matched(parts: Parts, old: Exported, new: Exported) -> _Matched:
    """Return the parts matched by name, then by the facts that identify them otherwise."""
    before = {part["name"]: part for part in parts.listed(old)}
    after = {part["name"]: part for part in parts.listed(new)}
    gone = [part for name, part in before.items() if name not in after]
    come = [part for name, part in after.items() if name not in before]
    same = {name: before[name] for name in after if name in before}
    if gone and come and parts.same_by:
        views = [parts.entries[entry] if isinstance(entry, str) else entry for entry in parts.same_by]
        old_ones, new_ones = _unique(views, gone), _unique(views, come)
        same |= {new_ones[key]["name"]: old_ones[key] for key in new_ones if key in old_ones}
    paired = {id(part) for part in same.values()}
    return _Matched(
        [(same[name], part) for name, part in after.items() if name in same],
        [part for part in gone if id(part) not in paired],
        [part for part in come if part["name"] not in same],
    )


def _unique(views: Sequence[View | Parts], parts: list[Exported]) -> dict[str, Exported]:
    """Return the parts by their identifying facts, if these are unique; a point without an address has none."""
    known: dict[str, list[Exported]] = {}
    for part in parts:
        if part.get("addresses") != []:
            key = repr([view.value(part) for view in views if isinstance(view, View)])
            known.setdefault(key, []).append(part)
    return {key: found[0] for key, found in known.items() if len(found) == 1}


def renamed(value: Any, names: Mapping[str, str]) -> Any:
    """Return a value of an exported model with new names in place of old ones."""
    if not names:
        return value
    if isinstance(value, str):
        return names.get(value) or _RAW.sub(lambda match: names.get(match[1], match[1]), value)
    if isinstance(value, list):
        return [renamed(item, names) for item in value]
    if isinstance(value, dict):
        return {names.get(key, key): renamed(item, names) for key, item in value.items()}
    return value


def _class(weight: Weight, old: Any, new: Any) -> str:
    return weight if isinstance(weight, str) else weight(old, new)
