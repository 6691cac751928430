"""Two exported models in, their differences out: each with its class, the thing and the fact, old and new."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from fieldscribe.differences.classes import COMPATIBLE
from fieldscribe.differences.devices import table_of
from fieldscribe.differences.table import Exported, Fact, Parts

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from fieldscribe.differences.table import Table, Weight

_RAW = re.compile(r"\b([a-z0-9_]+)(?=\.raw\b)")
"""A point in the expression of a limit."""


class Thing(NamedTuple):
    """A thing, or a part of one: its kind, and its name on both sides; None where it is not there."""

    kind: str
    old: str | None
    new: str | None

    @property
    def name(self) -> str:
        """The name, the new one where there are two."""
        return self.new or self.old or ""


class Difference(NamedTuple):
    """A fact that differs: its class, the things that it is a fact of (outermost first), and its values.

    The fact is empty where the innermost thing itself came, went or got another name.
    """

    weight: str
    things: tuple[Thing, ...]
    fact: str
    old: Any
    new: Any

    @property
    def is_rename(self) -> bool:
        """Whether the innermost thing has another name now."""
        return not self.fact and None not in self.things[-1][1:]


Renames: TypeAlias = "Mapping[str, Mapping[str, str]]"
"""The new names by kind of thing and old name."""


def differences(old: Exported, new: Exported) -> list[Difference]:
    """All differences of two exported models, in the order of the table and of the new model."""
    comparison = _Comparison()
    comparison.table(table_of(new["family"]), old, new, ())
    return comparison.told


class _Comparison:
    """Walks both sides along the table."""

    def __init__(self) -> None:
        self.told: list[Difference] = []
        self._renames: dict[str, dict[str, str]] = {}
        self._alone: dict[str, frozenset[str]] = {}
        """The names of things that came or went, by kind."""

    def table(self, table: Table, old: Exported, new: Exported, things: tuple[Thing, ...]) -> None:
        """Tell what differs in a thing that both sides have."""
        matches = {key: _matched(entry, old, new) for key, entry in table.items() if isinstance(entry, Parts)}
        if not things:
            kinds = {key: entry.kind for key, entry in table.items() if isinstance(entry, Parts)}
            self._renames = {kind: matches[key].renames for key, kind in kinds.items()}
            self._alone = {kind: matches[key].alone for key, kind in kinds.items()}
        differing: set[str] = set()
        for key, entry in table.items():
            before = len(self.told)
            if isinstance(entry, Parts):
                whole = self._parts(key, entry, matches[key], things)
                differing |= {f"{key} as a whole"} if whole else set()
            elif differing.isdisjoint(entry.follows):
                self._fact(key, entry, old, new, things)
            if len(self.told) > before:
                differing.add(key)

    def _fact(self, key: str, fact: Fact, old: Exported, new: Exported, things: tuple[Thing, ...]) -> None:
        before, after = fact.value(old), fact.value(new)
        if before == after or (fact.refers and self._names_the_same(fact.refers, before, after)):
            return
        self.told.append(Difference(_weighed(fact.weight, before, after), things, key, before, after))

    def _names_the_same(self, kind: str, before: Any, after: Any) -> bool:
        """Whether two values differ in nothing but the names of things, and in lists in those that came or went."""
        before, alone = renamed(before, self._renames.get(kind, {})), self._alone.get(kind, frozenset())
        if isinstance(before, list) and isinstance(after, list) and alone:
            before, after = (
                [item for item in items if not isinstance(item, str) or item not in alone] for items in (before, after)
            )
        return bool(before == after)

    def _parts(self, key: str, parts: Parts, matched: _Matched, things: tuple[Thing, ...]) -> bool:
        """Tell what differs in parts; whether all of them came or went, told as one difference."""
        removed, added = matched.removed, matched.added
        if parts.whole and not matched.pairs and bool(removed) != bool(added):
            names = [[part["name"] for part in side] or None for side in (removed, added)]
            self.told.append(Difference(parts.whole, things, key, *names))
            return True
        for old, new in matched.pairs:
            if old != new:
                self._pair(parts, old, new, things)
        for part in added:
            inner = (*things, Thing(parts.kind, None, part["name"]))
            self.told.append(Difference(_weighed(parts.added, None, part), inner, "", None, parts.shown(part)))
        for part in removed:
            inner = (*things, Thing(parts.kind, part["name"], None))
            self.told.append(Difference(_weighed(parts.removed, part, None), inner, "", parts.shown(part), None))
        return False

    def _pair(self, parts: Parts, old: Exported, new: Exported, things: tuple[Thing, ...]) -> None:
        """Tell what differs in a part that both sides have, its name first."""
        name = old["name"]
        inner = (*things, Thing(parts.kind, name, new["name"]))
        if name != new["name"]:
            kept = name in new.get("was", ())
            weight = COMPATIBLE if kept else _weighed(parts.renamed, old, new)
            self.told.append(Difference(weight, inner, "", name, new["name"]))
            new = {**new, **_following(old, new)}
        before = len(self.told)
        self.table(parts.facts, old, new, inner)
        for number, difference in enumerate(self.told[before:], before):
            fact = difference.fact if difference.things == inner else ""
            self.told[number] = difference._replace(weight=parts.in_code(old, new, fact, difference.weight))


def _following(old: Exported, new: Exported) -> Exported:
    """What only follows from another name: its old names, that of its enum, and a title that is the name in words."""
    following: dict[str, Any] = {}
    enums = old.get("enum_name"), new.get("enum_name")
    if enums[0] in new.get("enum_was", ()) or enums == (old["name"], new["name"]):
        following["enum_name"] = old["enum_name"]
    if old["name"] in new.get("was", ()):
        following["was"] = [other for other in new["was"] if other != old["name"]]
    before, after = (part.get("title", {}).get("en", "") for part in (old, new))
    words = _own_words(old["name"].split("_"), new["name"].split("_"))
    if before != after == before.replace(*words):
        following["title"] = {**new["title"], "en": before}
    return following


def _own_words(old: list[str], new: list[str]) -> tuple[str, str]:
    """What is different in two names, as titles say it: of `ramp_set_2` and `slope_set_2` Ramp and Slope."""
    while len(old) > 1 and len(new) > 1 and old[-1] == new[-1]:
        old, new = old[:-1], new[:-1]
    while len(old) > 1 and len(new) > 1 and old[0] == new[0]:
        old, new = old[1:], new[1:]
    return " ".join(old).capitalize(), " ".join(new).capitalize()


class _Matched(NamedTuple):
    """The parts of both sides: those that are the same, those that went, and those that came."""

    pairs: list[tuple[Exported, Exported]]
    removed: list[Exported]
    added: list[Exported]

    @property
    def renames(self) -> dict[str, str]:
        """The new names by old name."""
        return {old["name"]: new["name"] for old, new in self.pairs if old["name"] != new["name"]}

    @property
    def alone(self) -> frozenset[str]:
        """The names of those that went or came."""
        return frozenset(part["name"] for part in (*self.removed, *self.added))


def _matched(parts: Parts, old: Exported, new: Exported) -> _Matched:
    """Which parts are the same: those of one name, then those alike in what tells them without it."""
    before = {part["name"]: part for part in parts.listed(old)}
    after = {part["name"]: part for part in parts.listed(new)}
    gone = [part for name, part in before.items() if name not in after]
    come = [part for name, part in after.items() if name not in before]
    same = {part["name"]: before[name] for name, part in after.items() if name in before}
    if gone and come and parts.alike:
        same |= _renamed(parts, gone, come)
    paired = {id(part) for part in same.values()}
    return _Matched(
        [(same[name], part) for name, part in after.items() if name in same],
        [part for part in gone if id(part) not in paired],
        [part for part in come if part["name"] not in same],
    )


def _renamed(parts: Parts, gone: list[Exported], come: list[Exported]) -> dict[str, Exported]:
    """The old part of each new one that alone is alike."""
    facts = [parts.facts[key] if isinstance(key, str) else key for key in parts.alike]
    values = [fact.value for fact in facts if isinstance(fact, Fact)]
    old, new = _alone(values, gone), _alone(values, come)
    return {new[key]["name"]: old[key] for key in new if key in old}


def _alone(values: list[Callable[[Exported], Any]], parts: list[Exported]) -> dict[str, Exported]:
    """The parts by the facts that tell them, where no other part has the same; what has no place tells nothing."""
    known: dict[str, list[Exported]] = {}
    for part in parts:
        if part.get("addresses") != []:
            known.setdefault(repr([value(part) for value in values]), []).append(part)
    return {key: alike[0] for key, alike in known.items() if len(alike) == 1}


def renamed(value: Any, names: Mapping[str, str]) -> Any:
    """A value of an exported model with new names in place of old ones."""
    if not names:
        return value
    if isinstance(value, str):
        return names.get(value) or _RAW.sub(lambda match: names.get(match[1], match[1]), value)
    if isinstance(value, list):
        return [renamed(item, names) for item in value]
    if isinstance(value, dict):
        return {names.get(key, key): renamed(item, names) for key, item in value.items()}
    return value


def _weighed(weight: Weight, old: Any, new: Any) -> str:
    return weight if isinstance(weight, str) else weight(old, new)
