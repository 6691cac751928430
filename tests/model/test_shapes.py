"""Points are identities over shapes that they share, and what follows from a shape is worked out once."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING

import pytest
from fieldscribe.model import Enum, Interner, Point, Shape
from fieldscribe.plain import for_code
from support.described import loaded
from support.models import allowed, changed, entry, point, scaled, titles
from support.places import ROOT

if TYPE_CHECKING:
    from pathlib import Path

DESCRIPTIONS = sorted((ROOT / "descriptions").glob("*/device.yaml"))


@pytest.mark.parametrize("file", DESCRIPTIONS, ids=lambda file: file.parent.name)
def test_equal_shapes_and_limits_are_one_object(file: Path) -> None:
    device = loaded(file)
    for seen in (device, for_code(device)):
        for kept in (
            {id(one.shape): one.shape for one in seen.points},
            {id(one.allowed): one.allowed for one in seen.points},
        ):
            assert len(kept) == len(set(kept.values()))
    assert len({one.shape for one in device.points}) < len(device.points)


def test_what_belongs_to_a_shape_is_shared_and_the_rest_is_not() -> None:
    interner = Interner()
    first = point("first", 0, scale=scaled(10), decimals=1, allowed=allowed((0, 5)))
    same = [
        point("second", 9, scale=scaled(10), decimals=1, allowed=allowed((1, 7)), code="P1"),
        replace(first, title=titles("Another"), default=None, errata=("one",)),
    ]
    assert {id(interner.shape(one.shape)) for one in (first, *same)} == {id(first.shape)}
    named = Enum("mode", titles("Mode"), (entry(0, "off"),), closed=True)
    titled = replace(named, title=titles("Other mode"))
    facts = ({"access": "r"}, {"type": "s16"}, {"bits": (3, 0)}, {"decimals": 2}, {"scale": None}, {"enum": named})
    others = [changed(first, **one) for one in facts] + [changed(first, enum=titled)]
    assert len({id(interner.shape(one.shape)) for one in others}) == len(others)
    assert interner.allowed(allowed((0, 5))) is interner.allowed(first.allowed)


def test_a_point_offers_every_fact_of_its_shape() -> None:
    subject = point("subject", 0, "s8", bits=(11, 8), scale=scaled(2), decimals=0)
    for one in fields(Shape):
        assert getattr(subject, one.name) == getattr(subject.shape, one.name)
    assert not {one.name for one in fields(Shape)} & {one.name for one in fields(Point)}
    assert (subject.least, subject.greatest, subject.held, subject.words) == (-8, 7, (-128, 127), 1)


def test_what_follows_is_kept_with_the_shape() -> None:
    subject, other = point("subject", 0, scale=scaled(2)), point("other", 1)
    shared = replace(other, shape=subject.shape)
    assert shared.form == subject.form == "scaled"
    assert vars(subject.shape)["form"] == "scaled"
