"""The whole device: everything that was resolved and checked, put together and given its digest."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.model import Block, Device, Enum, Group, Point
from fieldscribe.plain import for_code
from fieldscribe.resolve.exponents import with_exponents
from fieldscribe.resolve.family_reader import reader_of
from fieldscribe.resolve.point_facts import groups, humanised
from fieldscribe.resolve.scope import Scope, source_of, titles

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.points import ResolvedPoint

_NO_VERSION = "0.0.0"
"""Of a device whose version has a finding: its names are compared all the same."""


def build_device(analysis: Analysis) -> tuple[Device, Device]:
    """The model of a device without findings, and the same as code may know it; neither has its digest yet."""
    device = _device(analysis, analysis.resolved)
    return device, for_code(device)


def sound_device(analysis: Analysis) -> Device:
    """A device with findings, reduced to the points that have none and depend on no point that has."""
    sound = {resolved.point.item: resolved for resolved in analysis.resolved if not resolved.facts.failed}
    known = {resolved.point.name for resolved in sound.values()} | sound.keys()
    while lost := [item for item, resolved in sound.items() if not known.issuperset(resolved.point.arguments)]:
        known -= {name for item in lost for name in (item, sound.pop(item).point.name)}
    return _device(analysis, sound.values())


def _device(analysis: Analysis, resolved: Iterable[ResolvedPoint]) -> Device:
    scope, header = analysis.scope, analysis.scope.header
    points = with_exponents(_with_errata(analysis, [entry.point for entry in resolved]))
    return Device(
        id=str(header["device"]),
        version=str(header.get("version", _NO_VERSION)),
        vendor=str(header.get("vendor", "")),
        model=str(header.get("model", "")),
        title=titles(header.get("title")),
        note=titles(header.get("note")),
        family=str(header["family"]),
        documents=tuple(scope.documents.values()),
        variants={axis: tuple(entry["values"]) for axis, entry in header.get("variants", {}).items()},
        bus=analysis.bus,
        groups=tuple(_groups(scope)),
        points=points,
        enums=_enums(points),
        blocks=_blocks(analysis, points),
        commands=analysis.commands,
        frames=tuple(analysis.frames),
        errata=tuple(open_erratum.erratum for open_erratum in analysis.errata),
        digest="",
        messages=analysis.messages,
        telegrams=tuple(telegram for telegram, _ in analysis.places.telegrams.values()),
    )


def _with_errata(analysis: Analysis, points: list[Point]) -> tuple[Point, ...]:
    """The points with the errata that name them."""
    ids = {name: tuple(dict.fromkeys(cited.erratum.id for cited in errata)) for name, errata in analysis.cited.items()}
    return tuple([replace(point, errata=ids[point.name]) if point.name in ids else point for point in points])


def _groups(scope: Scope) -> Iterator[Group]:
    for node in groups(scope):
        name = str(node["group"])
        yield Group(name, titles(node.get("title"), humanised(name)), titles(node.get("note")), source_of(scope, node))


def _enums(points: tuple[Point, ...]) -> tuple[Enum, ...]:
    """The enums that generated points use, once by name."""
    by_name: dict[str, Enum] = {}
    for point in points:
        for enum in (point.enum, None if point.digits is None else point.digits.enum):
            if enum is not None and point.generated:
                by_name.setdefault(enum.name, enum)
    return tuple(by_name.values())


def _blocks(analysis: Analysis, points: tuple[Point, ...]) -> dict[str, tuple[Block, ...]]:
    by_group: dict[str, list[Point]] = {}
    for point in points:
        by_group.setdefault(point.group, []).append(point)
    reading = reader_of(analysis.scope)
    variants = {axis: tuple(entry["values"]) for axis, entry in analysis.scope.header.get("variants", {}).items()}
    planned = {group: reading.blocks(analysis.bus, members, variants) for group, members in by_group.items()}
    return {group: blocks for group, blocks in planned.items() if blocks is not None}
