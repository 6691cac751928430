"""Turns models of SunSpec into the draft of a device: `import sunspec`.

A group of a model is a group of the draft, and its places are counted from the model's start. What a description
cannot say stays as a question at the point (`points`) or as a comment at the group.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from fieldscribe.families import families
from fieldscribe.importing.draft_text import Document, DraftGroup, DraftPoint, Head, Names, snake
from fieldscribe.importing.sunspec.models import Group, Model
from fieldscribe.importing.sunspec.points import Facts, note_of

_FOUND = "found: {models: {text: SunS, at: [40000, 0, 50000], then: [id, length]}}"
_LONGEST_TITLE, _LONGEST_CODE = 120, 40


class Imported(NamedTuple):
    """The drafted groups, and the head."""

    groups: list[DraftGroup]
    head: Head

    @property
    def points(self) -> list[DraftPoint]:
        """The drafted points."""
        return [point for group in self.groups for point in group.points]

    def lost(self) -> Counter[str]:
        """Return what is not carried, each with how often."""
        questions = [question for point in self.points for question in point.questions]
        comments = [comment for group in self.groups for comment in group.comments]
        return Counter(text.partition(":")[0] for text in (*questions, *comments))


def draft_models(models: Sequence[Model], device: str, most: int, counts: Mapping[str, int]) -> Imported:
    """Return the draft of a device with these models, with the first `most` elements of what repeats.

    `counts` are the numbers that points of the device hold, by their names: what lies behind so many elements has a
    place then.
    """
    drafter = _Drafter(Counter(name for model in models for name in _names(model.group)), most, counts)
    for model in models:
        drafter.add_model(model)
    documents = [
        Document(
            model.file,
            model.sha256,
            f"model_{model.id}",
            f"SunSpec model {model.id}, {_title(model.group)} ({model.file})",
            has_lines=False,
        )
        for model in models
    ]
    title = f"SunSpec model{'s' if len(models) > 1 else ''} {', '.join(str(model.id) for model in models)}"
    family = next(family for family in families() if "holding" in family.spaces)
    shared = drafter.facts.shared(point for group in drafter.groups for point in group.points)
    facts = ["certainty: imported", _FOUND, *shared]
    head = Head(device, documents, family.name, title=title[:_LONGEST_TITLE], facts=facts, kind="models of SunSpec")
    return Imported(drafter.groups, head)


def _names(group: Group) -> list[str]:
    """Return the names of all points of a group and those within."""
    return [point.name for point in group.points] + [name for inner in group.groups for name in _names(inner)]


def _within(group: Group) -> Iterator[Group]:
    for inner in group.groups:
        yield inner
        yield from _within(inner)


def _title(group: Group) -> str:
    return (group.label or group.name)[:_LONGEST_TITLE]


def _snake(title: str, otherwise: str) -> str:
    """Return a name with all words of a title; `MaxChaRte` has three."""
    return snake(re.sub("(?<=[a-z]{2})(?=[A-Z])", " ", title), otherwise, articles=True)


def _repeats(group: Group) -> bool:
    return group.count != 1 or any(map(_repeats, group.groups))


@dataclass(frozen=True, slots=True)
class _Place:
    """Where a group begins, counted from the start of the model; None if that is known only at the device.

    `path` has the groups around it, `scope` all points that it sees. `repeats` are the facts that repeat its points,
    `shared` what all points of the group have; `text` is said of a group around it that has no points of its own.
    """

    model: Model
    start: int | None
    path: tuple[str, ...] = ()
    scope: Mapping[str, DraftPoint] = field(default_factory=dict)
    repeats: Mapping[str, str] = field(default_factory=dict)
    shared: Mapping[str, str] = field(default_factory=dict)
    text: str = ""

    def behind(self, words: int | None) -> int | None:
        """Return where the words behind these begin."""
        return None if self.start is None or words is None else self.start + words


class _Drafter:
    """Drafts models one after another."""

    def __init__(self, names: Counter[str], most: int, counts: Mapping[str, int]) -> None:
        self.groups: list[DraftGroup] = []
        self.facts = Facts()
        self._doubles = {name for name, times in names.items() if times > 1}
        self._group_names, self._names = Names(), Names()
        self._most, self._counts = most, counts
        self._counted: Mapping[str, int] = {}

    def add_model(self, model: Model) -> None:
        """Draft a model; what repeats in it exists only while the counting points hold what the user says."""
        counting = {inner.count for inner in _within(model.group)}
        own = [point.name for point in model.group.points if point.name in counting]
        self._counted = {name: number for name, number in self._counts.items() if name in own}
        self._add(model.group, _Place(model, model.header))

    def _add(self, group: Group, place: _Place) -> None:
        """Draft a group and those within."""
        path, number = (*place.path, group.name), str(place.model.id)
        draft = DraftGroup(_title(group), "holding", "" if not place.path else ".".join(path)[:_LONGEST_TITLE])
        draft.name = self._group_names.give(_snake("_".join(path), "model"), number)
        draft.document = f"model_{number}"
        place = self._repeated(group, place, draft)
        text = " ".join(filter(None, (place.text, group.text)))
        draft.facts |= {"block": number, **({"note": note_of(text)} if text else {}), **place.shared}
        words, scope = 0, dict(place.scope)
        for point in group.points:
            drafted = DraftPoint(0, "holding", (point.label or point.name)[:_LONGEST_TITLE], point.name)
            if point.name in self._doubles:
                code = ".".join((number, *path[1:], point.name))
                drafted.code = code if len(code) <= _LONGEST_CODE else f"{number}.{point.name}"
            of_group = _snake(group.name, "group") if place.path else ""
            drafted.name = self._names.give(_snake(drafted.title, "point"), of_group, number)
            if place.start is None:
                drafted.questions.append("place: it lies behind elements whose number a point holds; `--count` says it")
            else:
                drafted.facts |= {"at": str(place.start + words), **place.repeats}
            words += point.size
            scope[point.name] = drafted
            draft.points.append(drafted)
        for point, drafted in zip(group.points, draft.points, strict=True):
            self.facts.state(point, drafted, scope)
        self.groups += [draft] if group.points else []
        within = replace(place, path=path, scope=scope, start=place.behind(words), text="" if group.points else text)
        if not place.path and self._counted:
            holds = [f"{scope[name].name} == {number}" for name, number in self._counted.items()]
            within = replace(within, shared={"when": " and ".join(holds)})
        for inner in group.groups:
            self._add(inner, within)
            within = replace(within, start=within.behind(self._all_words(inner)))

    def _repeated(self, group: Group, place: _Place, draft: DraftGroup) -> _Place:
        """Return the place of a group with what repeats it; where that cannot be said, the draft has a comment."""
        count, words = group.count, self._words(group)
        if count == 1:
            return place
        times = "to the end of the model" if count == 0 else f"{count} times"
        plural, singular = ("sets", "set") if any(map(_repeats, group.groups)) else ("indices", "index")
        counter = place.scope.get(str(count))
        if (
            place.start is None
            or words is None
            or plural in place.repeats
            or (counter is None and count not in range(1 << 16))
        ):
            draft.comments.append(f"repeats: {times}; here is the first")
            return place
        shared = dict(place.shared)
        shared["addressing"] = f"{shared.get('addressing', 'number')} + ({singular} - 1) * {words}"
        number = self._number(group)
        if number is None:
            repeats = {plural: "to end" if counter is None else f"1..{counter.name}", "most": str(self._most)}
        else:
            repeats = {plural: str(number)}
        return replace(place, repeats={**place.repeats, **repeats}, shared=shared)

    def _number(self, group: Group) -> int | None:
        """Return how many elements a group has; None if the device says it."""
        return self._counted.get(group.count) if isinstance(group.count, str) else group.count or None

    def _words(self, group: Group) -> int | None:
        """Return how many words an element of a group has; None if the device says it."""
        words = [self._all_words(inner) for inner in group.groups]
        known = [each for each in words if each is not None]
        return sum(point.size for point in group.points) + sum(known) if len(known) == len(words) else None

    def _all_words(self, group: Group) -> int | None:
        """Return how many words all elements of a group have; None if the device says it."""
        number, words = self._number(group), self._words(group)
        return None if number is None or words is None else number * words
