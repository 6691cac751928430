"""Digests of the facts of a device in a canonical form.

A digest covers facts that differ from their usual value, under their published keys, with exact numbers. So neither
a change of data structures in the compiler nor an optional key that nobody uses changes it.
"""

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from hashlib import sha256
from operator import attrgetter
from typing import Any

from fieldscribe.facts.devices import device_table
from fieldscribe.facts.points import POINT
from fieldscribe.facts.table import Context, Fact, FactTable, stated
from fieldscribe.model import Device, Point


def with_digest(device: Device, plain: Device) -> tuple[Device, Device]:
    """Return a device and its view for code, both with the digest for code."""
    digest = _digest(plain, Context(plain, for_code=True), ("points",))
    return replace(device, digest=digest), replace(plain, digest=digest)


def facts_digest(device: Device) -> str:
    """Return the digest of all facts of a device, also those for people, but not of its version.

    The device already has its digest for code; of the points this adds only what that leaves out.
    """
    for_people = tuple(fact for fact in POINT if _has_texts(fact))
    return _digest(device, Context(device), ("points", "version"), for_people, device.digest)


def _has_texts(fact: Fact) -> bool:
    """Return True if code does not see all of a fact of a point; it never sees all of the terms."""
    return fact.for_people or fact.holder == "terms" or any(map(_has_texts, fact.table or ()))


def _digest(
    device: Device, context: Context, left_out: tuple[str, ...], of_points: FactTable = POINT, start: str = ""
) -> str:
    table = tuple(fact for fact in device_table(device.family) if fact.key not in left_out)
    checksum = sha256(start.encode() + _canonical(stated(table, device, context)))
    for text in _points(device, context, of_points):
        checksum.update(text)
    return checksum.hexdigest()


def _points(device: Device, context: Context, facts: FactTable) -> Iterator[bytes]:
    """Return the facts of the points: shared facts point by point, the others fact by fact."""
    for shared, holder in _HOLDERS.items():
        table = tuple(fact for fact in facts if fact.holder == shared)
        if not table:
            continue
        keys = [holder(point) for point in device.points]
        points = dict(zip(keys, device.points, strict=True))
        texts = {key: _canonical(stated(table, point, context)) for key, point in points.items()}
        yield b"".join(map(texts.__getitem__, keys))
    for fact in sorted(facts, key=attrgetter("key")):
        if not (fact.holder or fact.derived or (fact.for_people and context.for_code)):
            values = _values(fact, device, context)
            if values.count(None) + (fact.usual is not None and values.count(fact.usual)) < len(values):
                yield _canonical({fact.key: values})


_HOLDERS: Mapping[str, Callable[[Point], object]] = {
    "shape": lambda point: (id(point.shape), point.enum_names),
    "terms": lambda point: id(point.terms),
    "shape and terms": lambda point: (id(point.shape), id(point.terms)),
    "limits": lambda point: (id(point.allowed), id(point.shape)),
}
"""What points share, and what of a point tells that two points have the same."""


def _values(fact: Fact, device: Device, context: Context) -> list[Any]:
    """Return the value of a fact for each point."""
    if fact.value is None:
        return list(map(attrgetter(fact.attribute or fact.key), device.points))
    return [fact.value(point, context) for point in device.points]


_ENCODER = json.JSONEncoder(sort_keys=True, separators=(",", ":"))


def _canonical(value: object) -> bytes:
    return _ENCODER.encode(value).encode()
