"""A target for tests: the tags of a made-up panel, which has eight capitals for a name. See test_a_new_target.py."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from fieldscribe.model import Device, Point
from fieldscribe.resources import Render
from fieldscribe.targets.identifiers import Names, Owner

SEES_TITLES = False
FAMILY_PART = ""
WEIGHT = 0.1
BEFORE_POINTS = ()

_LONGEST = 8


@dataclass(frozen=True, slots=True)
class TagView:
    """A point as the panel knows it."""

    name: str
    space: str
    address: int
    words: int


def outputs(device: Device, render: Render, *, tests: bool = True) -> Iterable[tuple[str, str]]:
    """One table a device."""
    del tests  # there are none
    tags = [
        TagView(_tag(point), point.space, point.address, point.words)
        for point in device.points
        if point.generated and point.address is not None
    ]
    yield f"toy/{device.id}.csv", render("toy/tags.csv.j2", {"device": device.id, "tags": tags})


def runtime(device: Device, *, tests: bool = True) -> Iterable[tuple[str, str]]:
    """What all tables share."""
    del device, tests
    yield "toy/spaces.csv", "toy/runtime/spaces.csv"


def identifiers(device: Device) -> Iterator[Names]:
    """The tags; `ALARM` is the panel's own."""
    yield Names("the panel", Owner("target", "the list of alarms"), ("ALARM",))
    for point in device.points:
        yield Names("the panel", Owner("point", point.item), (_tag(point),))


def device_name_taken(name: str) -> str:
    """The panel keeps its own settings in a table."""
    return "is the table of the panel's settings" if name == "settings" else ""


def _tag(point: Point) -> str:
    return point.item.upper()[:_LONGEST]
