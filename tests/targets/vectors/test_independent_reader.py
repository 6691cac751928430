"""The vectors say what a small reader, which shares nothing with the compiler, works out of the same YAML."""

from __future__ import annotations

import struct
from collections import Counter
from math import isnan
from typing import TYPE_CHECKING

import pytest
from fieldscribe.targets.vectors import outputs
from independent.answers import Point, UnknownError, float_of
from independent.arithmetic import nearest, number
from independent.reader import read
from support.described import loaded
from support.places import ROOT
from support.vector_file import File, Vector

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from pathlib import Path

    Points = Mapping[str, Point]
    Answer = Callable[[Point, Vector, Points], object]

FOLDERS = [*sorted((ROOT / "descriptions").glob("*/")), *sorted((ROOT / "tests/devices").glob("*/"))]
FOLDERS = [folder for folder in FOLDERS if (folder / "device.yaml").is_file()]


_JUDGED = ("ok", "out_of_range", "unknown_value")
_REFUSED = ("overflow", "zero_factor", "no_case")


def address(point: Point, vector: Vector, _: Points) -> object:
    mine = {key: str(number) for key, number in point.references.items()}
    theirs = {key: number for key, number in (vector["references"] or {}).items() if key in mine}
    said = (vector["space"], vector["address"], vector["code"], theirs)
    return said == (point.row["space"], min(point.addresses), point.row.get("code"), mine)


def decode(point: Point, vector: Vector, points: Points) -> object:
    if vector["status"] != "ok":
        return vector["status"] in _REFUSED or vector["raw"] in point.special
    if point.type in ("f32", "f64"):
        value = float_of(vector["raw"], point.width)
        return (isnan(value) and isnan(vector["value"])) or _pattern(value) == _pattern(vector["value"])
    slope, start = point.line(_with(vector), points)
    return float((vector["raw"] - start) / slope) == vector["value"]


def decode_count(point: Point, vector: Vector, points: Points) -> object:
    if vector["status"] != "ok":
        return vector["status"] in _REFUSED or vector["raw"] in point.special
    slope, start = point.line(_with(vector), points)
    return nearest((vector["raw"] - start) / slope * 10 ** vector["decimals"]) == vector["count"]


def check(point: Point, vector: Vector, points: Points) -> object:
    if "digits" in point.row or point.type in ("f32", "f64") or vector["status"] not in _JUDGED:
        raise UnknownError(vector["status"])
    raw, (mask, constant) = vector["raw"], point.fixed
    if raw in point.special:  # a code is a whole word: constant bits do not change it
        return (raw in point.writable_codes) == (vector["status"] == "ok")
    inside = any(low <= raw <= high for low, high in point.intervals(_with(vector), points))
    fits = bool(point.bits) or raw & mask == constant
    return (inside and fits) == (vector["status"] == "ok")


def name(point: Point, vector: Vector, _: Points) -> object:
    return point.entries.get(vector["raw"]) == vector["name"]


def flag(point: Point, vector: Vector, _: Points) -> object:
    low, width = point.flags[vector["flag"]][:2]
    return vector["raw"] >> low & (1 << width) - 1 == vector["number"]


def words(point: Point, vector: Vector, _: Points) -> object:
    count = len(vector["words"])
    order = sorted(range(count), key=point.addresses.__getitem__) if len(point.addresses) == count else range(count)
    whole = point.on_the_wire(vector["raw"], count)
    return [whole[place] for place in order] == vector["words"]


def place(point: Point, vector: Vector, _: Points) -> object:
    return point.addresses == vector["addresses"]


def write_address(point: Point, vector: Vector, _: Points) -> object:
    elsewhere = point.row.get("write_at", "~")
    ends = [] if elsewhere == "~" else [number(end) for end in elsewhere.split("..")]
    return min(ends, default=None) == vector["address"]


def fixed(point: Point, vector: Vector, _: Points) -> object:
    return point.fixed == (vector["mask"], vector["bits"])


ANSWERS: dict[str, Answer] = {
    one.__name__: one for one in (address, decode, decode_count, check, name, flag, words, place, write_address, fixed)
}
"""What this reader can say of a vector of each kind."""


@pytest.mark.full(seconds=0.3)
@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_the_vectors_say_what_the_yaml_says(folder: Path) -> None:
    description = read(folder)
    points = {item: Point(description, row) for item, row in description.points.items()}
    outcomes = [(vector, outcome) for vector in _vectors(folder) if (outcome := _outcome(vector, points)) is not None]
    assert [vector for vector, good in outcomes if not good] == []
    answered = Counter(vector["kind"] for vector, _ in outcomes)
    assert answered["address"] == sum(point.settled and not point.is_beyond("address") for point in points.values())
    assert min(answered["check"], answered["decode_count"]) > 0


@pytest.mark.full(seconds=2)
def test_this_reader_can_disagree() -> None:
    """A description that says something else than the vectors is noticed, for each kind of answer."""
    folder = ROOT / "tests/devices/kitchen_sink"
    description = read(folder)
    row = description.points["speed"]
    for key, other in (("at", "0110h"), ("scale", "value = raw * 0.2"), ("range", "0..4001"), ("code", "S99")):
        points = {item: Point(description, one) for item, one in description.points.items()}
        points["speed"] = Point(description, row | {key: other})
        vectors = [vector for vector in _vectors(folder) if vector.get("point") == "speed"]
        assert not all(_outcome(vector, points) in (True, None) for vector in vectors), key


def _outcome(vector: Vector, points: Points) -> bool | None:
    """Whether the vector says what this reader says; None where it says nothing."""
    answer = ANSWERS.get(vector["kind"])
    if answer and points[vector["point"]].is_beyond(vector["kind"]):
        return None
    try:
        return None if answer is None else bool(answer(points[vector["point"]], vector, points))
    except UnknownError:
        return None


def _vectors(folder: Path) -> Iterator[Vector]:
    """The vectors of a device; each knows the unit of the counts of its point, which the compiler chooses."""
    device = loaded(folder / "device.yaml")
    ((_, text),) = outputs(device, lambda *_: "")
    decimals = {point.item: point.decimals for point in device.points}
    for vector in File(text):
        yield vector | {"decimals": decimals.get(vector.get("point", ""), 0)}


def _with(vector: Vector) -> dict[str, int]:
    return {item: int(raw) for item, raw in vector["with"].items()} if vector.get("with") else {}


def _pattern(value: float) -> bytes:
    return struct.pack(">d", value)
