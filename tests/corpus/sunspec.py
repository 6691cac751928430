"""Models of sunspec/models, each as a device with two elements of what repeats."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

from fieldscribe.importing.sunspec import draft_models
from fieldscribe.importing.sunspec.models import read_models

from corpus.collection import Collection, Counts, Drafted, Points
from corpus.registers import Register


def _files(folder: Path) -> list[Path]:
    return sorted(folder.rglob("model_*.json"))


def _draft(file: Path) -> Drafted:
    return Drafted(*draft_models(read_models(file, ()), "device", 2, {}, _most_exponent(file)))


def _most_exponent(file: Path) -> int:
    """Return how large scale factors are: of some files so that numbers have counts of 64 bits too."""
    return Random(file.name).choice((10, 6, 4))


_KINDS = {"int": "s", "uint": "u", "enum": "u", "bitfield": "u", "raw": "u", "acc": "u", "float": "f", "count": "u",
          "sunssf": "s", "string": "t"}  # fmt: skip


def expected(file: Path, points: Points, chance: Random, counts: Counts) -> Iterator[tuple[str, Iterator[str]]]:
    """Yield points with vectors for random contents of their registers, which the model is read for once more."""
    model = json.loads(file.read_text("utf-8"))
    by_code: dict[str, list[Mapping[str, Any]]] = {}
    for point in points:
        by_code.setdefault(re.sub(r"\.\d+", "", point["code"] or ""), []).append(point)
    for path, at, item in _items(model["group"], (), 0):
        number = str(model["id"])
        codes = (".".join((number, *path, item["name"])), f"{number}.{item['name']}", item["name"])
        for point in next((by_code[code] for code in codes if code in by_code), []):
            kind = _KINDS.get(item["type"].rstrip("0123456789"))
            if kind is None or point["untyped"]:
                continue
            one = _register(kind, at, item, point, _most_exponent(file))
            yield point["name"], one.vectors(point, chance, counts)


def _items(
    group: Mapping[str, Any], path: tuple[str, ...], start: int | None
) -> Iterator[tuple[tuple[str, ...], int | None, Mapping[str, Any]]]:
    """Yield the points of a group and those within, with their places as far as nothing that repeats is before them."""
    at = start
    for item in group.get("points", []):
        yield path, at, item
        at = None if at is None else at + item["size"]
    for inner in group.get("groups", []):
        repeats = inner.get("count", 1) != 1
        yield from _items(inner, (*path, inner["name"]), None if repeats else at)
        at = None if repeats or at is None or inner.get("groups") else at + sum(one["size"] for one in inner["points"])


def _register(kind: str, at: int | None, item: Mapping[str, Any], point: Mapping[str, Any], most: int) -> Register:
    width, sf = 16 * item["size"], item.get("sf")
    one = Register(kind, width, address=at, most_exponent=most)
    if item["type"].startswith("acc"):
        one.codes = {0: "not_accumulated"}
    elif kind == "f":
        one.codes = {0x7FC00000 if width == 32 else 0x7FF8000000000000: "not_implemented"}
    elif kind != "t":
        one.codes = {1 << width - 1 if kind == "s" else (1 << width) - 1: "not_implemented"}
    if item["type"] == "sunssf":
        one.ends = Fraction(-most), Fraction(most)
    if isinstance(sf, int):
        one.ratio = Fraction(10) ** sf
    elif sf:
        one.factor = point["scale"][0]["uses"][0]["point"]
    if item["type"].startswith(("enum", "bitfield")):
        one.names = {symbol["value"]: symbol["name"] for symbol in item.get("symbols", [])}
        one.has_flags = item["type"].startswith("bitfield") and bool(one.names)
        one.closed = bool(one.names) and not one.has_flags
    one.access = item.get("access", "R").lower()
    return one


SUNSPEC = Collection("sunspec", _files, _draft, expected)
