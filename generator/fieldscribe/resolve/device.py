"""The whole device: everything that was resolved and checked, put together and given its digest."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.model import Block, Device, Enum, Group, Point
from fieldscribe.plain import for_code
from fieldscribe.resolve.drafts import groups, humanised
from fieldscribe.resolve.exponents import with_exponents
from fieldscribe.resolve.families import reading_of
from fieldscribe.resolve.scope import Scope, source_of, titles

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.resolve.points import Resolved
    from fieldscribe.resolve.subject import Subject

_NO_VERSION = "0.0.0"
"""Of a device whose version has a finding: its names are compared all the same."""


def build_device(subject: Subject) -> tuple[Device, Device]:
    """The model of a device without findings, and the same as code may know it; neither has its digest yet."""
    device = _device(subject, subject.resolved)
    return device, for_code(device)


def sound_device(subject: Subject) -> Device:
    """A device with findings, reduced to the points that have none and depend on no point that has."""
    sound = {resolved.point.item: resolved for resolved in subject.resolved if not resolved.draft.failed}
    known = {resolved.point.name for resolved in sound.values()} | sound.keys()
    while lost := [item for item, resolved in sound.items() if not known.issuperset(resolved.point.arguments)]:
        known -= {name for item in lost for name in (item, sound.pop(item).point.name)}
    return _device(subject, sound.values())


def _device(subject: Subject, resolved: Iterable[Resolved]) -> Device:
    scope, header = subject.scope, subject.scope.header
    points = with_exponents(_with_errata(subject, [entry.point for entry in resolved]))
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
        bus=subject.bus,
        groups=tuple(_groups(scope)),
        points=points,
        enums=_enums(points),
        blocks=_blocks(subject, points),
        commands=subject.commands,
        frames=tuple(subject.frames),
        errata=tuple(open_erratum.erratum for open_erratum in subject.errata),
        digest="",
        messages=subject.messages,
        telegrams=tuple(telegram for telegram, _ in subject.places.telegrams.values()),
    )


def _with_errata(subject: Subject, points: list[Point]) -> tuple[Point, ...]:
    """The points with the errata that name them."""
    ids = {name: tuple(dict.fromkeys(cited.erratum.id for cited in errata)) for name, errata in subject.cited.items()}
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


def _blocks(subject: Subject, points: tuple[Point, ...]) -> dict[str, tuple[Block, ...]]:
    by_group: dict[str, list[Point]] = {}
    for point in points:
        by_group.setdefault(point.group, []).append(point)
    reading = reading_of(subject.scope)
    variants = {axis: tuple(entry["values"]) for axis, entry in subject.scope.header.get("variants", {}).items()}
    planned = {group: reading.blocks(subject.bus, members, variants) for group, members in by_group.items()}
    return {group: blocks for group, blocks in planned.items() if blocks is not None}
