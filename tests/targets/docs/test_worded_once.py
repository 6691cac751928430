"""Rows of points do not depend on what points share in memory."""

from __future__ import annotations

from dataclasses import replace

import pytest
from fieldscribe.model import Device, Place
from fieldscribe.resources import render
from fieldscribe.targets.docs import outputs
from support.described import KITCHENS, SHIPPED, made, shipped
from support.models import point, sample_device
from support.quick import full_but


def _nearly_alike() -> Device:
    """Points that share all but a single fact."""
    first, bare = point("first", 1), point("bare", 5, untyped="", generated=False)
    read_only = replace(first, name="read_only", shape=replace(first.shape, access="r"))
    lost = replace(first, name="lost", terms=replace(first.terms, keeps="no"))
    return sample_device((first, read_only, lost, bare, replace(bare, name="longer", place=Place((6, 7, 8), {}))))


@pytest.mark.parametrize("name", full_but(("", "kitchen_codes", "kitchen_uss"), ("", *KITCHENS, *SHIPPED), seconds=0.5))
def test_a_point_that_shares_nothing_reads_the_same(name: str) -> None:
    """Texts of what points share are worked out once: with objects of their own, points have the same rows."""
    device = shipped(name) if name in SHIPPED else made(name) if name else _nearly_alike()
    apart = [
        replace(point, shape=replace(point.shape), terms=replace(point.terms), allowed=replace(point.allowed))
        for point in device.points
    ]
    assert list(outputs(replace(device, points=tuple(apart)), render)) == list(outputs(device, render))
