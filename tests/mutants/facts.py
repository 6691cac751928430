"""The facts of each point of a description, as places in its YAML.

A point's facts are its own scalars, those of its group that hold for it, and those of the enums and formats that it
names. What is for people (titles, notes), where a fact stands (lines, sections) and what is printed a second time are
no facts here: the first cannot be wrong in code, the others are held against each other by every `check`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import yaml

NOT_FACTS = {
    *("title", "note", "en", "de", "printed", "line", "lines", "page", "section", "source", "each"),
    *("was", "errata", "group", "parts", "documents", "looked_through", "certainty", "where"),
}


@dataclass(frozen=True, slots=True)
class Fact:
    """One scalar: its text as written, and the keys that lead to it from the point. `is_key` tells a key of a map."""

    path: str
    start: int
    end: int
    text: str
    keys: tuple[str, ...]
    is_key: bool


@dataclass(frozen=True, slots=True)
class Point:
    """The facts of a point by the key that they stand below; `own` are the keys that its group does not have for it."""

    name: str
    facts: dict[str, tuple[Fact, ...]]
    own: frozenset[str]


@dataclass(frozen=True, slots=True)
class Description:
    """One device: the text of each file by its path in `descriptions/`, and its points."""

    device: str
    texts: dict[str, str]
    points: tuple[Point, ...]


Node = yaml.Node
Shared = dict[tuple[str, str], tuple[Fact, ...]]
"""The facts of the enums, formats and records that points name, by key and name."""


def read(folder: Path) -> Description:
    """All points of a device's folder."""
    texts = {f"{folder.name}/{path.name}": path.read_text("utf-8") for path in sorted(folder.glob("*.yaml"))}
    roots = [(path, root) for path, text in texts.items() for root in yaml.compose_all(text, Loader=yaml.SafeLoader)]
    shared: Shared = {}
    for path, root in roots:
        shared |= _shared(path, root)
    points = tuple(point for path, root in roots for point in _points(path, root, {}, shared))
    return Description(folder.name, texts, points)


def _entries(node: Node | None) -> Iterator[tuple[str, yaml.ScalarNode, Node]]:
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            if isinstance(key, yaml.ScalarNode):
                yield key.value, key, value


def _shared(path: str, node: Node | None) -> Shared:
    found: Shared = {}
    for name, _, value in _entries(node):
        if name in ("enums", "formats"):
            for of, _, body in _entries(value):
                found[name[:-1], of] = tuple(_facts(path, body, (name[:-1],)))
        elif name not in NOT_FACTS:
            found |= _shared(path, value)
    return found


def _points(path: str, node: Node | None, around: dict[str, tuple[Fact, ...]], shared: Shared) -> Iterator[Point]:
    own = {
        name: facts
        for name, _, value in _entries(node)
        if isinstance(value, yaml.ScalarNode) or name == "numbering"
        if (facts := tuple(_facts(path, value, (name,)))) and name not in NOT_FACTS
    }
    for name, _, value in _entries(node):
        if name == "points" and isinstance(value, yaml.SequenceNode):
            for item in value.value:
                if isinstance(item, yaml.MappingNode):
                    yield _point(path, item, around | own, shared)
        elif name not in NOT_FACTS:
            yield from _points(path, value, around | own if name == "records" else {}, shared)


def _point(path: str, node: yaml.MappingNode, around: dict[str, tuple[Fact, ...]], shared: Shared) -> Point:
    facts = dict(around)
    own, named = set(), ""
    for name, _, value in _entries(node):
        if name in NOT_FACTS:
            continue
        own.add(name)
        facts[name] = tuple(_facts(path, value, (name,)))
        if isinstance(value, yaml.ScalarNode):
            facts[name] += shared.get((name, value.value), ())
            named = value.value if name == "name" else named
    return Point(named, {name: found for name, found in facts.items() if found}, frozenset(own))


def _facts(path: str, node: Node, keys: tuple[str, ...]) -> Iterator[Fact]:
    if isinstance(node, yaml.ScalarNode):
        yield from _scalar(path, node, keys, is_key=False)
    elif isinstance(node, yaml.SequenceNode):
        for item in node.value:
            yield from _facts(path, item, keys)
    for name, key, value in _entries(node):
        if name in NOT_FACTS:
            continue
        if re.match(r"[\d-]", name):
            yield from _scalar(path, key, (*keys, name), is_key=True)
        yield from _facts(path, value, (*keys, name))


def _scalar(path: str, node: yaml.ScalarNode, keys: tuple[str, ...], *, is_key: bool) -> Iterator[Fact]:
    start, end = node.start_mark.index, node.end_mark.index
    text = node.start_mark.buffer[start:end] if node.start_mark.buffer else node.value
    if end > start and "\n" not in text and node.style in (None, '"', "'"):
        yield Fact(path, start, end, text.rstrip("\0"), keys, is_key)
