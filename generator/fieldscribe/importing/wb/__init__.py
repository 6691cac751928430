"""Drafts a description from a device template of Wiren Board's gateway: `import wb`.

`templates` reads the file, `rows` its channels and parameters, `conditions` their conditions, `heads` the facts of the
whole device; repetitions become one row. Whatever is not carried is a question in the draft.
"""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from typing import Any

from fieldscribe.importing import compilable
from fieldscribe.importing.draft_text import (
    Document,
    DraftBlock,
    DraftGroup,
    DraftPoint,
    Head,
    Names,
    WholeDraft,
    snake,
)
from fieldscribe.importing.readers import MOST_ROWS, UnreadableError
from fieldscribe.importing.wb.conditions import Parameters
from fieldscribe.importing.wb.heads import FAMILY, base_of, blocks_of, bus_of, first_firmware, identification
from fieldscribe.importing.wb.rows import Row, components_of
from fieldscribe.importing.wb.templates import MOST_BYTES, Texts, labels_text, objects, read_template
from fieldscribe.safe_files import read_regular

_LEAST = 3
"""The least number of rows for a group with a rule of addresses."""
_DIFFERENT = ("when", "default")
"""The facts that may differ between rows that become one, in addition to their addresses."""


def folded(groups: Sequence[DraftGroup], blocks: Sequence[DraftBlock]) -> list[DraftGroup]:
    """Return the groups, each followed by those of its repetitions; conditions use the new names of points."""
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
        for rows in _foldable((point for point in left.values() if point.name not in single), place):
            run = {_number(point.title, place): point for point in rows}
            places = [point.wire or 0 for point in run.values()]
            steps = {second - first for first, second in pairwise(places)}
            if len(run) == len(rows) and list(run) == list(range(min(run), min(run) + len(run))) and len(steps) == 1:
                step = steps.pop()
                if step > 0:
                    by_step.setdefault((min(run), step), []).append(_array_row(run, place, points, renamed))
                    for point in rows:
                        del left[id(point)]
    group.points = list(left.values())
    if group.points:
        yield group
    for (first, step), rows in by_step.items():
        rule = {"addressing": f"number + {'index' if first == 0 else f'(index - {first})'} * {step}"}
        name = names.give(f"{group.name}_repeated")
        yield replace(group, points=rows, name=name, comments=[], facts=group.facts | rule)


def _foldable(points: Iterable[DraftPoint], place: int) -> list[list[DraftPoint]]:
    """Return the points that differ only in one number of their titles, and in what may differ."""
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


def _array_row(run: dict[int, DraftPoint], place: int, points: Names, renamed: dict[str, str]) -> DraftPoint:
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


def draft(path: Path, device: str) -> WholeDraft:
    """Draft a device from a template. Raises UnreadableError, OSError."""
    template = read_template(path)
    body = template["device"]
    texts = Texts(body.get("translations"))
    rows = list(_rows(body, texts))
    if not 0 < len(rows) <= MOST_ROWS:
        raise UnreadableError(
            f"the template has {len(rows)} channels and parameters", hint=f"1 to {MOST_ROWS} are read"
        )
    for row in rows:
        row.read()
    names, parameters = Names(), Parameters(rows, texts)
    for row in rows:
        title = row.key if row.is_parameter and row.key else row.point.title
        row.point.name = names.give(snake(title, "point"), "" if row.point.wire is None else str(row.point.wire))
    for row in rows:
        if row.labels:
            row.point.facts["enum"] = labels_text(row.labels, texts)
        parameters.set_condition(row)
    groups = _groups(body, [row for row in rows if not row.is_choice], texts)
    groups += identification(template, names)
    for group in groups:
        group.facts |= base_of(body) | first_firmware(template)
    title = texts.english(str(template.get("title") or body.get("name") or template.get("device_type", device)))
    checksum = sha256(read_regular(path, MOST_BYTES).data).hexdigest()
    head = Head(
        device,
        [Document(path.name, checksum, "template", f"{path.name} of wb-mqtt-serial", has_lines=False)],
        FAMILY.name,
        model=title,
        title=title,
        facts=["certainty: imported"],
        kind="a template",
        blocks=[*parameters.blocks, *blocks_of(template, parameters)],
        bus=bus_of(body, groups),
    )
    compilable(groups, head, with_head=True)  # a point that is a view of another is not folded
    return WholeDraft(folded(groups, head.blocks), head)


def _rows(body: Mapping[str, Any], texts: Texts) -> Iterator[Row]:
    """Yield the parameters and the channels of a device."""
    parameters = body.get("parameters")
    if isinstance(parameters, dict):
        parameters = [{"id": key} | item for key, item in parameters.items() if isinstance(item, dict)]
    yield from (Row(item, texts, is_parameter=True) for item in objects(parameters))
    for item in objects(body.get("channels")):
        yield from (Row(part, texts, is_parameter=False) for part in components_of(item))


def _groups(body: Mapping[str, Any], rows: Sequence[Row], texts: Texts) -> list[DraftGroup]:
    """Return the points in the groups of the template, one for each space."""
    listed = objects(body.get("groups"))
    titles = {str(group.get("id")): str(group.get("title") or group.get("id")) for group in listed}
    groups: dict[tuple[str, str], DraftGroup] = {}
    for row in rows:
        key = str(row.item.get("group") or ("Parameters" if row.is_parameter else "Channels"))
        title, space = titles.get(key, key), row.point.space
        english = texts.english(title)
        group = groups.setdefault(
            (key, space), DraftGroup(english, space, "", document="template", titles=texts.others(title))
        )
        group.points.append(row.point)
    names = Names()
    for group in groups.values():
        group.name = names.give(snake(group.title, "points"), group.space)
    return list(groups.values())
