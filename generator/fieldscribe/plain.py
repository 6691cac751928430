"""The device as code may know it: names in place of titles, no notes, no places in the manual, no reasons for errata.

Titles and notes change often. They reach only the documentation, so that vendored code stays the same when they do.
"""

from __future__ import annotations

import hashlib
from functools import lru_cache

from fieldscribe.model import Code, Device, Entry, Enum, Flag, Interner, Own, Point, Shape, Source, Special, Titles
from fieldscribe.records import replace, values_of

_NOWHERE = Source("", None, None, None)


def for_code(device: Device) -> Device:
    """The same device without anything that is only for people."""
    enums = {id(enum): _enum(enum) for enum in device.enums}
    shapes = {id(shape): shape for shape in (point.shape for point in device.points)}
    interner = Interner()  # shapes that differed in titles only become one
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
        groups=tuple(replace(group, title=_title(group.name), note={}, source=_NOWHERE) for group in device.groups),
        points=tuple(_point(point, shapes[id(point.shape)]) for point in device.points),
        enums=tuple(enums.values()),
        commands=tuple(
            replace(command, title=_title(command.name), note={}, source=_NOWHERE) for command in device.commands
        ),
        frames=tuple(replace(frame, title=_title(frame.name), source=_NOWHERE) for frame in device.frames),
        errata=tuple(replace(erratum, why="", where="", source=_NOWHERE) for erratum in device.errata),
        messages=tuple(replace(message, title=_title(message.name), source=_NOWHERE) for message in device.messages),
        telegrams=tuple(
            replace(telegram, title=_title(telegram.name), source=_NOWHERE) for telegram in device.telegrams
        ),
    )


def digest(device: Device) -> str:
    """A checksum over all that code may know of the device, except the digest itself."""
    return with_digest(device)[0].digest


def with_digest(device: Device) -> tuple[Device, Device]:
    """The device with its digest, and the same as code may know it."""
    plain = replace(for_code(device), digest="")
    shown = [(point.item, point.display) for point in plain.points if point.display is not None]
    text = f"{plain!r}{shown or ''}"  # appended only if there is some, so that other digests stay
    checksum = hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
    return replace(device, digest=checksum), replace(plain, digest=checksum)


def _codes(codes: tuple[Code, ...]) -> tuple[Code, ...]:
    return tuple(replace(code, title=_title(code.name)) for code in codes)


def _own(own: Own) -> Own:
    """The facts of one family, with names as the titles of their codes."""
    held = values_of(own)
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
        title=_title(point.item),
        note={},
        source=_NOWHERE,
        unit=replace(point.unit, name="", quantity=""),
        since=None if point.since is None and point.until is None else "",  # code only learns that there is one
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
    return replace(enum, title=_title(enum.name), entries=tuple(_entry(entry) for entry in enum.entries))


def _entry(entry: Entry) -> Entry:
    return replace(entry, title=_title(entry.name))


def _flag(flag: Flag) -> Flag:
    return replace(flag, title=_title(flag.name), values=tuple(_entry(entry) for entry in flag.values))


def _special(special: Special) -> Special:
    return replace(special, title=_title(special.name))


@lru_cache(maxsize=65536)
def _title(name: str) -> Titles:
    """`base_frequency` as `Base frequency`."""
    return {"en": name.replace("_", " ").capitalize()}
