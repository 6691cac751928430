"""The whole device: everything that was resolved and checked, put together and given its digest."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.families import modbus
from fieldscribe.model import Block, Device, Enum, Group, Point
from fieldscribe.resolve.drafts import groups, humanised
from fieldscribe.resolve.exponents import with_exponents
from fieldscribe.resolve.scope import Scope, source_of, titles

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.checks.subject import Subject


def build_device(subject: Subject) -> Device:
    """The model of a device without findings."""
    scope, header = subject.scope, subject.scope.header
    points = with_exponents(tuple([_with_errata(subject, resolved.point) for resolved in subject.resolved]))
    device = Device(
        id=str(header["device"]),
        version=str(header["version"]),
        vendor=str(header["vendor"]),
        model=str(header["model"]),
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
        errata=tuple(one.erratum for one in subject.errata),
        digest="",
        messages=subject.messages,
        telegrams=tuple(telegram for telegram, _ in subject.places.telegrams.values()),
    )
    return replace(device, digest=digest(device))


def _with_errata(subject: Subject, point: Point) -> Point:
    found = subject.cited.get(point.name)
    return point if found is None else replace(point, errata=tuple(dict.fromkeys(one.erratum.id for one in found)))


def _groups(scope: Scope) -> Iterator[Group]:
    for raw in groups(scope):
        name = str(raw["group"])
        yield Group(name, titles(raw.get("title"), humanised(name)), titles(raw.get("note")), source_of(scope, raw))


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
    if subject.scope.header["family"] != "modbus":
        return {}
    return {group: modbus.plan_blocks(subject.bus, members) for group, members in by_group.items()}


def digest(device: Device) -> str:
    """A checksum of what matters to code: no titles, notes, sources or reasons, which never touch vendored code."""
    summed = hashlib.sha256()
    bus = device.bus
    codes = [(code.number, code.name, code.most, code.broadcast) for code in (*bus.functions, *bus.exceptions)]
    head = (
        device.id,
        device.version,
        device.family,
        sorted(device.variants.items()),
        bus.framings,
        bus.units,
        bus.broadcast,
    )
    summed.update(repr((head, codes, sorted(bus.gaps.items()), bus.pad_coil_bytes)).encode())
    for point in device.points:
        summed.update(repr(_code_facts(point)).encode())
    for fact in _facts_of_families(device):
        summed.update(repr(fact).encode())
    for command in device.commands:
        summed.update(repr((command.name, command.space, command.address, command.function, command.value)).encode())
    return summed.hexdigest()


def _facts_of_families(device: Device) -> Iterator[object]:
    """What only some families have; nothing for the others, so that these facts leave their checksums alone."""
    bus = device.bus
    codes = [(code.number, code.answers, code.refusals) for code in (*bus.functions, *bus.exceptions)]
    if bus.pkw or bus.responses:
        responses = [(code.number, code.name, code.answers) for code in bus.responses]
        yield bus.pkw, bus.pzd, bus.variant_pzd, codes, responses
    if bus.identifier_bits is not None:
        yield bus.identifier_bits
    for message in device.messages:
        yield message.name, message.direction, message.answers, message.can_id, message.adds_unit, message.roles
    for telegram in device.telegrams:
        yield telegram.name, telegram.direction, telegram.words, telegram.message


def _code_facts(point: Point) -> tuple[object, ...]:
    return _common_facts(point) + _facts_of_words(point)


def _facts_of_words(point: Point) -> tuple[object, ...]:
    """What only some points have; nothing for the others."""
    digits = point.digits and (point.digits.count, _named(point.digits.enum))
    facts = (point.telegram, point.index, point.text, digits, point.fixed, point.changes_with or None)
    return () if all(fact is None for fact in facts) else facts


def _named(enum: Enum) -> tuple[object, ...]:
    return enum.name, enum.closed, [(one.raw, one.name) for one in enum.entries]


def _common_facts(point: Point) -> tuple[object, ...]:
    enum = point.enum and _named(point.enum)
    flags = [
        (one.low, one.width, one.name, one.active, [(entry.raw, entry.name) for entry in one.values])
        for one in point.flags
    ]
    specials = [(one.low, one.high, one.name, one.no_value) for one in point.specials]
    return (
        point.item,
        point.code,
        point.group,
        point.space,
        point.places,
        sorted(point.references.items()),
        point.type,
        point.bits,
        point.access,
        point.unit.symbol,
        point.scale,
        (point.decimals, point.encodes_values),
        point.allowed,
        point.default,
        point.steps,
        enum,
        flags,
        specials,
        point.changes,
        point.keeps,
        point.conditions,
        point.was,
        point.errata,
        point.generated,
    )
