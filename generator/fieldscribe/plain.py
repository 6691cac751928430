"""The device as code may know it: names in place of titles, no notes, no places in the manual, no reasons for errata.

What is for people changes often, and must not touch vendored code when it does; it reaches the documentation only.
"""

from __future__ import annotations

import hashlib
from dataclasses import fields, replace
from functools import lru_cache

from fieldscribe.model import Code, Device, Entry, Enum, Flag, Interner, Own, Point, Shape, Source, Special, Titles

_NOWHERE = Source("", None, None, None)


def for_code(device: Device) -> Device:
    """The same device without anything that is only for people."""
    enums = {id(enum): _enum(enum) for enum in device.enums}
    shapes = {id(shape): shape for shape in (point.shape for point in device.points)}
    interner = Interner()  # titles told some of them apart
    shapes = {key: interner.shape(_shape(shape, enums)) for key, shape in shapes.items()}
    return replace(
        device,
        title={},
        note={},
        documents=(),
        bus=replace(
            device.bus,
            note={},
            timing={},
            serial={},
            functions=_codes(device.bus.functions),
            exceptions=_codes(device.bus.exceptions),
            own=device.bus.own and _own(device.bus.own),
        ),
        groups=tuple(replace(group, title=_plain(group.name), note={}, source=_NOWHERE) for group in device.groups),
        points=tuple(_point(point, shapes[id(point.shape)]) for point in device.points),
        enums=tuple(enums.values()),
        commands=tuple(replace(one, title=_plain(one.name), note={}, source=_NOWHERE) for one in device.commands),
        frames=tuple(replace(one, title=_plain(one.name), source=_NOWHERE) for one in device.frames),
        errata=tuple(replace(one, why="", where="", source=_NOWHERE) for one in device.errata),
        messages=tuple(replace(one, title=_plain(one.name), source=_NOWHERE) for one in device.messages),
        telegrams=tuple(replace(one, title=_plain(one.name), source=_NOWHERE) for one in device.telegrams),
    )


def digest(device: Device) -> str:
    """A checksum of what code is made of: every field of all that code may know, but for the digest itself."""
    return with_digest(device)[0].digest


def with_digest(device: Device) -> tuple[Device, Device]:
    """The device with its digest, and the same as code may know it."""
    plain = replace(for_code(device), digest="")
    shown = [(point.item, point.display) for point in plain.points if point.display is not None]
    text = f"{plain!r}{shown or ''}"  # what few devices say leaves the digests of the others alone
    found = hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
    return replace(device, digest=found), replace(plain, digest=found)


def _codes(codes: tuple[Code, ...]) -> tuple[Code, ...]:
    return tuple(replace(code, title=_plain(code.name)) for code in codes)


def _own(own: Own) -> Own:
    """The facts of one family, whose codes have titles, too."""
    held = {one.name: getattr(own, one.name) for one in fields(own)}
    codes = {
        name: value
        for name, value in held.items()
        if isinstance(value, tuple) and value[:1] and isinstance(value[0], Code)
    }
    return replace(own, **{name: _codes(value) for name, value in codes.items()})


def _point(point: Point, shape: Shape) -> Point:
    return replace(
        point,
        shape=shape,
        title=_plain(point.item),
        note={},
        source=_NOWHERE,
        unit=replace(point.unit, name="", quantity=""),
        since=None if point.since is None and point.until is None else "",  # that not every firmware has it
        until=None,
        record=None,
        untyped=None if point.untyped is None else "",
    )


def _shape(shape: Shape, enums: dict[int, Enum]) -> Shape:
    digits = shape.digits
    return replace(
        shape,
        enum=shape.enum and (enums.get(id(shape.enum)) or _enum(shape.enum)),
        digits=digits and replace(digits, enum=enums.get(id(digits.enum)) or _enum(digits.enum)),
        flags=tuple(_flag(flag) for flag in shape.flags),
        specials=tuple(_special(special) for special in shape.specials),
    )


def _enum(enum: Enum) -> Enum:
    return replace(enum, title=_plain(enum.name), entries=tuple(_entry(entry) for entry in enum.entries))


def _entry(entry: Entry) -> Entry:
    return replace(entry, title=_plain(entry.name))


def _flag(flag: Flag) -> Flag:
    return replace(flag, title=_plain(flag.name), values=tuple(_entry(entry) for entry in flag.values))


def _special(special: Special) -> Special:
    return replace(special, title=_plain(special.name))


@lru_cache(maxsize=65536)
def _plain(name: str) -> Titles:
    """`base_frequency` as `Base frequency`."""
    return {"en": name.replace("_", " ").capitalize()}
