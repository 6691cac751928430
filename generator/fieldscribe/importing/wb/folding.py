"""Writes rows that repeat at equal distances as one row with `indices`."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from fieldscribe.importing.draft_text import DraftBlock, DraftGroup, DraftPoint, Names, snake

_LEAST = 3
"""So many rows are worth a group with a rule of addresses."""
_DIFFERENT = ("when", "default")
"""What may differ between the rows that one row replaces, besides their addresses."""


def folded(groups: Sequence[DraftGroup], blocks: Sequence[DraftBlock]) -> list[DraftGroup]:
    """Return the groups, each followed by those of its repeats; conditions have the new names of points."""
    points, names, renamed = Names(), Names(), dict[str, str]()
    for group in groups:
        names.give(group.name)
        for point in group.points:
            points.give(point.name)
    single = {word for group in groups for point in group.points if (word := point.facts.get("view_of"))}
    result = [part for group in groups for part in _parts(group, single, points, names, renamed)]

    def new(text: str) -> str:
        return re.sub(r"\w+", lambda match: renamed.get(match[0], match[0]), text)

    for point in (point for group in result for point in group.points):
        point.facts |= {key: new(point.facts[key]) for key in ("when", "each") if key in point.facts}
    for block in blocks:
        block.lines = [new(text) if " when: " in text else text for text in block.lines]
    return result


def _parts(
    group: DraftGroup, single: Collection[str], points: Names, names: Names, renamed: dict[str, str]
) -> Iterator[DraftGroup]:
    """Yield the group without its repeats, and a group for the repeats of each distance."""
    by_step: dict[tuple[int, int], list[DraftPoint]] = {}
    left = {id(point): point for point in group.points}
    for place in (0, -1):
        for rows in _alike((point for point in left.values() if point.name not in single), place):
            run = {_number(point.title, place): point for point in rows}
            places = [point.wire or 0 for point in run.values()]
            steps = {second - first for first, second in pairwise(places)}
            if len(run) == len(rows) and list(run) == list(range(min(run), min(run) + len(run))) and len(steps) == 1:
                step = steps.pop()
                if step > 0:
                    by_step.setdefault((min(run), step), []).append(_one(run, place, points, renamed))
                    for point in rows:
                        del left[id(point)]
    group.points = list(left.values())
    if group.points:
        yield group
    for (first, step), rows in by_step.items():
        rule = {"addressing": f"number + {'index' if first == 0 else f'(index - {first})'} * {step}"}
        name = names.give(f"{group.name}_repeated")
        yield replace(group, points=rows, name=name, comments=[], facts=group.facts | rule)


def _alike(points: Iterable[DraftPoint], place: int) -> list[list[DraftPoint]]:
    """Return the points that have all in common but one number of their titles, and what may differ."""
    alike: dict[object, list[DraftPoint]] = {}
    for point in points:
        if (
            point.facts["at"] == str(point.wire)
            and _number(point.title, place) >= 0
            and not {"write_at", "view_of"} & point.facts.keys()
        ):
            facts = {key: text for key, text in point.facts.items() if key not in ("at", *_DIFFERENT)}
            titles = [_without(title, place) for title in (point.title, *point.titles.values())]
            present = [key in point.facts for key in _DIFFERENT]
            key = (*titles, *point.titles, *facts.items(), *present, *point.questions, *point.remarks)
            alike.setdefault(key, []).append(point)
    return [rows for rows in alike.values() if len(rows) >= _LEAST]


def _number(title: str, place: int) -> int:
    numbers = re.findall("[0-9]{1,3}", title)
    return int(numbers[place]) if numbers else -1


def _without(title: str, place: int) -> str:
    """Return a title without its first (0) or last (-1) number."""
    matches = list(re.finditer(" ?[0-9]{1,3}", title))
    rest = title[: matches[place].start()] + title[matches[place].end() :] if matches else title
    return rest.strip(" -–:.,#") or title


def _one(run: dict[int, DraftPoint], place: int, points: Names, renamed: dict[str, str]) -> DraftPoint:
    """Return the row of an array for the points by index."""
    first = next(iter(run.values()))
    title = _without(first.title, place)
    titles = {language: _without(text, place) for language, text in first.titles.items()}
    point = replace(
        first, title=title, titles=titles, name=points.give(snake(title, "element")), facts=dict(first.facts)
    )
    point.facts["indices"] = f"{min(run)}..{max(run)}"
    renamed |= {each.name: f"{point.name}_index_{index}" for index, each in run.items()}
    lines = []
    for index, row in run.items():
        facts = [f"{key}: {row.facts[key]}" for key in _DIFFERENT if row.facts.get(key) != first.facts.get(key)]
        lines += [f"\n  {index}: {{{', '.join(facts)}}}"] if facts else []
    if lines:
        point.facts["each"] = "".join(lines)
    return point
