"""The device as code may know it: names in place of titles, no notes, no places in the manual, no reasons for errata.

Titles and notes change often. They reach only the documentation, so that vendored code stays the same when they do.
"""

from __future__ import annotations

from dataclasses import fields, replace
from functools import lru_cache

from fieldscribe.model import (
    Code,
    Device,
    Entry,
    Enum,
    FamilyFacts,
    Flag,
    Interner,
    Point,
    ScaleCase,
    Shape,
    Source,
    Special,
    Terms,
    Titles,
)

_NOWHERE = Source("", None, None, None)


def for_code(device: Device) -> Device:
    """The same device without anything that is only for people."""
    enums = _Enums()
    shapes = {id(shape): shape for shape in (point.shape for point in device.points)}
    interner = Interner()  # shapes that differed in titles only become one
    shapes = {key: interner.shape(_shape(shape, enums)) for key, shape in shapes.items()}
    terms = {id(terms): terms for terms in (point.terms for point in device.points)}
    terms = {key: _terms(terms) for key, terms in terms.items()}
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
            family_facts=device.bus.family_facts and _own(device.bus.family_facts),
        ),
        groups=tuple(replace(group, title=_title(group.name), note={}, source=_NOWHERE) for group in device.groups),
        points=tuple([_point(point, shapes[id(point.shape)], terms[id(point.terms)]) for point in device.points]),
        enums=tuple(map(enums.of, device.enums)),
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


def _codes(codes: tuple[Code, ...]) -> tuple[Code, ...]:
    return tuple(replace(code, title=_title(code.name)) for code in codes)


def _own(own: FamilyFacts) -> FamilyFacts:
    """The facts of one family, with names as the titles of their codes."""
    held = {field.name: getattr(own, field.name) for field in fields(own)}
    codes = {
        name: value
        for name, value in held.items()
        if isinstance(value, tuple) and value[:1] and isinstance(value[0], Code)
    }
    return replace(own, **{name: _codes(value) for name, value in codes.items()})


def _point(point: Point, shape: Shape, terms: Terms) -> Point:
    return Point(
        point.name,
        point.variant,
        point.code,
        _title(point.item),
        {},
        _NOWHERE,
        point.place,
        point.write_place,
        shape,
        terms,
        point.allowed,
        point.default,
        point.default_raw,
        None,
        point.set,
        point.index,
        point.was,
        point.errata,
    )


def _terms(terms: Terms) -> Terms:
    return replace(
        terms,
        unit=replace(terms.unit, name="", quantity=""),
        since=None if terms.since is None and terms.until is None else "",  # code only learns that there is one
        until=None,
        untyped=None if terms.untyped is None else "",
    )


def _shape(shape: Shape, enums: _Enums) -> Shape:
    digits = shape.digits
    return replace(
        shape,
        scale=shape.scale and tuple([ScaleCase(case.point, case.raw, case.rule) for case in shape.scale]),
        enum=shape.enum and enums.of(shape.enum),
        digits=digits and replace(digits, enum=enums.of(digits.enum)),
        flags=tuple(_flag(flag) for flag in shape.flags),
        specials=tuple(_special(special) for special in shape.specials),
    )


class _Enums:
    """The enums of a device for code; those that share their entries still do."""

    def __init__(self) -> None:
        self._enums: dict[int, Enum] = {}
        self._entries: dict[int, tuple[Entry, ...]] = {}

    def of(self, enum: Enum) -> Enum:
        """An enum with names as titles."""
        if id(enum) not in self._enums:
            entries = self._entries.get(id(enum.entries))
            if entries is None:
                entries = self._entries[id(enum.entries)] = tuple(map(_entry, enum.entries))
            self._enums[id(enum)] = Enum(enum.name, _title(enum.name), entries, enum.closed, enum.was)
        return self._enums[id(enum)]


def _entry(entry: Entry) -> Entry:
    return Entry(entry.raw, entry.name, _title(entry.name), entry.quantity)


def _flag(flag: Flag) -> Flag:
    return replace(flag, title=_title(flag.name), values=tuple(_entry(entry) for entry in flag.values))


def _special(special: Special) -> Special:
    return replace(special, title=_title(special.name))


@lru_cache(maxsize=65536)
def _title(name: str) -> Titles:
    """`base_frequency` as `Base frequency`."""
    return {"en": name.replace("_", " ").capitalize()}
