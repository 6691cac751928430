"""Reads models of SunSpec (JSON): groups of points with their types, counts and symbols, as they are in the file."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

from fieldscribe.importing.readers import UnreadableError
from fieldscribe.safe_files import read_regular
from fieldscribe.text import line

_MOST_BYTES, _MOST_PARTS, _DEEPEST = 4 << 20, 5_000, 6
"""Limits of a file: its bytes, its points and groups, groups within groups."""


class Symbol(NamedTuple):
    """The name of a number, or of a bit."""

    number: int
    name: str
    text: str


@dataclass(frozen=True, slots=True)
class Point:
    """A point; `factor` is the name of its scale factor, or the exponent itself."""

    name: str
    type: str
    size: int
    label: str
    text: str
    unit: str
    factor: str | int | None
    access: str
    is_mandatory: bool
    is_static: bool
    symbols: Sequence[Symbol]


@dataclass(frozen=True, slots=True)
class Group:
    """A group: its points, then its groups. It repeats `count` times, or as often as that point says.

    With a count of 0 it repeats to the end of the model.
    """

    name: str
    label: str
    text: str
    count: int | str
    points: Sequence[Point]
    groups: Sequence[Group]


class Model(NamedTuple):
    """A model: its number, its outermost group, and the file that it was read from.

    The group has no points for the number and the length: they are the `header` words that every model starts with.
    """

    id: int
    header: int
    group: Group
    file: str
    sha256: str


def read_models(path: Path, chosen: Sequence[int]) -> list[Model]:
    """Return the models of a file, or of all files `model_*.json` of a folder, in the order of their numbers.

    `chosen` are the numbers of the requested models; empty for all. Raises UnreadableError.
    """
    files = sorted(path.glob("model_*.json")) if path.is_dir() else [path]
    models = sorted((read_model(file) for file in files if _is_chosen(file, chosen)), key=lambda model: model.id)
    models = [model for model in models if not chosen or model.id in chosen]
    missing = [str(number) for number in chosen if number not in {model.id for model in models}]
    if missing or not models:
        hint = "a folder has a file for each model, as model_103.json"
        raise UnreadableError(f"there is no model {', '.join(missing)}" if missing else "there is no model", hint=hint)
    for model, after in pairwise(models):
        if model.id == after.id:
            raise UnreadableError(f"{model.file} and {after.file} both are model {model.id}")
    return models


def _is_chosen(file: Path, chosen: Sequence[int]) -> bool:
    number = file.stem.rpartition("_")[2]
    return not chosen or not number.isdecimal() or int(number[:9]) in chosen


def read_model(path: Path) -> Model:
    """Return the model of a file. Raises UnreadableError."""
    data = read_regular(path, _MOST_BYTES).data
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError) as error:
        raise UnreadableError(f"{path.name} is no JSON: {line(str(error))[:200]}") from error
    reader = _Reader(path.name)
    number = reader.number(tree, "id", None)
    group = reader.group(reader.value(tree, "group", dict, None), 0)
    if not group.points:
        raise UnreadableError(f"{path.name}: the model has no points")
    header = 2 if [point.name for point in group.points[:2]] == ["ID", "L"] else 0
    group = replace(group, points=group.points[header:])
    return Model(number, header, group, path.name, sha256(data).hexdigest())


class _Reader:
    """Reads the parts of a model, and reports what is wrong with them."""

    def __init__(self, file: str) -> None:
        self._file = file
        self._parts = 0

    def _wrong(self, what: str) -> UnreadableError:
        hint = "this reads the models of github.com/sunspec/models, in its folder `json`"
        return UnreadableError(f"{self._file}: {line(what)[:200]}", hint=hint)

    def value(self, tree: Any, key: str, kinds: Any, otherwise: Any) -> Any:
        """Return the value of a key; `otherwise` for a missing key, unless that is None."""
        value = tree.get(key, otherwise) if isinstance(tree, dict) else None
        if not isinstance(value, kinds) or isinstance(value, bool):
            where = f" of `{tree['name']}`" if isinstance(tree, dict) and "name" in tree else ""
            raise self._wrong(f"`{key}`{where} is missing" if value is None else f"`{key}`{where} is `{value}`")
        return value

    def number(self, tree: Any, key: str, otherwise: int | None) -> int:
        """Return a whole number of 16 bits."""
        number: int = self.value(tree, key, int, otherwise)
        if not 0 <= number < 1 << 16:
            raise self._wrong(f"`{key}` is {number}")
        return number

    def _text(self, tree: Any, key: str, otherwise: str | None = "") -> str:
        return line(self.value(tree, key, str, otherwise))

    def _remarks(self, tree: Any) -> str:
        """Return the description and further remarks, each as a sentence."""
        standards = ", ".join(map(str, self.value(tree, "standards", list, [])))
        comments = map(str, self.value(tree, "comments", list, []))
        texts = (*(self._text(tree, key) for key in ("desc", "detail", "notes")), *comments, standards)
        return " ".join(f"{text}{'' if text[-1] in '.!?' else '.'}" for text in map(line, texts) if text)

    def group(self, tree: Any, depth: int) -> Group:
        """Return a group with everything inside."""
        if depth > _DEEPEST:
            raise self._wrong(f"more than {_DEEPEST} groups lie within each other")
        points = [self._point(point) for point in self.value(tree, "points", list, [])]
        self._parts += 1 + len(points)
        if self._parts > _MOST_PARTS:
            raise self._wrong(f"there are more than {_MOST_PARTS} points and groups")
        count = self.value(tree, "count", (int, str), 1)
        return Group(
            self._text(tree, "name", None),
            self._text(tree, "label"),
            self._remarks(tree),
            count if isinstance(count, str) else self.number(tree, "count", 1),
            points,
            [self.group(group, depth + 1) for group in self.value(tree, "groups", list, [])],
        )

    def _point(self, tree: Any) -> Point:
        return Point(
            self._text(tree, "name", None),
            self._text(tree, "type", None),
            self.number(tree, "size", None),
            self._text(tree, "label"),
            self._remarks(tree),
            self._text(tree, "units"),
            tree.get("sf") if tree.get("sf") is None else self.value(tree, "sf", (int, str), None),
            self._text(tree, "access"),
            self._text(tree, "mandatory") == "M",
            self._text(tree, "static") == "S",
            [self._symbol(symbol) for symbol in self.value(tree, "symbols", list, [])],
        )

    def _symbol(self, tree: Any) -> Symbol:
        texts = (self._text(tree, "label"), self._remarks(tree))
        name = self._text(tree, "name", None)
        return Symbol(self.value(tree, "value", int, None), name, ": ".join(filter(None, texts)))
