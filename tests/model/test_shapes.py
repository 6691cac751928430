"""Points are identities over shapes that they share, and what follows from a shape is worked out once."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path

import pytest
from fieldscribe.code_view import for_code
from fieldscribe.model import Allowed, Enum, Flag, Interner, Limit, Point, Shape, Special
from support.described import loaded
from support.models import allowed, changed, entry, linear, point, sample_bus, scaled, titles, value_of
from support.places import ROOT

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
    named = Enum("mode", (entry(0, "off"),), closed=True)
    titled = replace(named, entries=(replace(named.entries[0], title=titles("Other")),))
    facts = ({"access": "r"}, {"type": "s16"}, {"bits": (3, 0)}, {"decimals": 2}, {"scale": None}, {"enum": named})
    others = [changed(first, **one) for one in facts] + [changed(first, enum=titled)]
    assert len({id(interner.shape(one.shape)) for one in others}) == len(others)
    assert interner.allowed(allowed((0, 5))) is interner.allowed(first.allowed)


def test_shapes_and_limits_that_differ_in_names_alone_have_other_hashes() -> None:
    """Else a device whose points each have flags, codes or limits of their own compares all of them with each other."""

    def flags(name: str) -> tuple[Flag, ...]:
        return (Flag(0, 1, name, titles(name), 1, ()),)

    def codes(name: str) -> tuple[Special, ...]:
        return (Special(9, 9, name, titles(name), no_value=True),)

    def limits(name: str) -> Allowed:
        return allowed((0, Limit(linear(1, 0, value_of(name)), (), 0, 9)))

    described = point("subject", 0)
    for first, second in (
        (changed(described, flags=flags("a")).shape, changed(described, flags=flags("b")).shape),
        (changed(described, specials=codes("a")).shape, changed(described, specials=codes("b")).shape),
        (limits("a"), limits("b")),
    ):
        assert first != second
        assert hash(first) != hash(second)


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


@pytest.mark.parametrize(("units", "usual"), [((1, 247), 1), ((0, 31), 1), ((3, 9), 3), ((2, 2), 2), ((0, 0), 0)])
def test_examples_go_to_unit_1_or_to_the_lowest_that_there_is(units: tuple[int, int], usual: int) -> None:
    assert replace(sample_bus(), units=units).usual_unit == usual
