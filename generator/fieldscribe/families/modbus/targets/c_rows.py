"""Constant rows of the Modbus header, for calls of the runtime that follow a table.

`IdentifyView` has the rows that say which device answers, and which of its variants: points to read in their order,
each with a function that tests their words. `Selections` has the rows of what selects a point before it is reached.
`c.py` writes both.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby

from fieldscribe.arithmetic.words import group_mask, insert, words_of
from fieldscribe.families.modbus import SPACES, Profile, profile_of
from fieldscribe.model import Device, Identification, Point
from fieldscribe.model.device import WHOLE_WORD
from fieldscribe.targets.c.calls import raw_of_words
from fieldscribe.targets.c.header import identification_defines
from fieldscribe.targets.c.point_views import GeneratedPoint
from fieldscribe.targets.c.scope import HeaderScope, PointView
from fieldscribe.targets.c.syntax import INLINE, function, hexadecimal, unsigned
from fieldscribe.targets.identifiers import Named, Owner
from fieldscribe.text import upper

_MOST = 255
"""A byte numbers the axes of variants, and the values of each."""


@dataclass(frozen=True)
class IdentifyView:
    """The call of a device: `rows` and functions are made when the header is written."""

    device: Device
    scope: HeaderScope
    points: Sequence[GeneratedPoint]

    @cached_property
    def axes(self) -> dict[str, list[str]]:
        """The axes of variants that are told, with all their values."""
        identifying = [row.variant.axis for row in self.device.identifications if row.variant is not None]
        return {axis: list(self.device.variants[axis]) for axis in dict.fromkeys(identifying)}

    @property
    def name(self) -> str:
        """The name of the function."""
        return f"{self.scope.prefix}_identify"

    @property
    def base(self) -> str:
        """The name of the base of the addresses of its points; empty if they count from 0."""
        first = self.device.identifications[0].point
        return next(each.point.base or "" for each in self.points if each.point.name == first)

    @property
    def struct(self) -> str:
        """The name of what it fills in."""
        return f"{self.scope.prefix}_identity"

    @property
    def values(self) -> Iterator[tuple[str, int]]:
        """The macros of the values of all axes, with their numbers."""
        for axis, values in self.axes.items():
            for number, value in enumerate(values, 1):
                yield f"{self.scope.upper}_VARIANT_{upper(axis)}_{upper(value)}", number

    @property
    def named(self) -> Named:
        """All identifiers."""
        holds = [self._holds(number) for number in range(1, len(self.device.identifications) + 1)]
        return Owner("target", "what identifies the device"), [
            self.name,
            self.struct,
            *holds,
            *(macro for macro, _ in self.values),
        ]

    @property
    def functions(self) -> Iterator[str]:
        """The functions that say if words are what is expected."""
        points = {each.point.name: each for each in self.points}
        defines = groupby(identification_defines(self.device, self.scope), lambda one: (one.variant, one.point))
        for number, (row, (_, wanted)) in enumerate(zip(self.device.identifications, defines, strict=True), 1):
            point, view, _ = points[row.point]
            is_utf8 = point.text is not None and point.text.is_unicode
            literals = [one.macro if is_utf8 else _literal(row, place, one.macro) for place, one in enumerate(wanted)]
            body = _text_body(view, literals) if row.texts else _raw_body(view, literals)
            named = [text.replace(view.function, f"{self.scope.prefix}_{point.item}") for text in body]
            yield function(f"{INLINE} fieldscribe_status", self._holds(number), ("const uint16_t *words",), *named).text

    @property
    def rows(self) -> Iterator[str]:
        """The rows of the table."""
        points, axes = {each.point.name: each.point for each in self.points}, [*self.axes]
        for number, row in enumerate(self.device.identifications, 1):
            axis = value = 0
            if row.variant is not None:
                axis = 1 + axes.index(row.variant.axis)
                value = 1 + self.axes[row.variant.axis].index(row.variant.value)
            yield f"{{{axis}U, {value or 1}U, {_read_of(points[row.point])}, &{self._holds(number)}}}"

    def _holds(self, number: int) -> str:
        return f"{self.name}_holds_{number}"


def _read_of(point: Point) -> str:
    """Return the request that reads a point: `{3U, 0x0000U, 1U}`."""
    return f"{{{unsigned(SPACES[point.space].read)}, {hexadecimal(min(point.addresses))}, {point.words}U}}"


def identifies(device: Device) -> bool:
    """Return True if requests alone tell the device: all points that do are read by one each, in their order."""
    identifying = {row.point for row in device.identifications}
    points, most = [point for point in device.points if point.name in identifying], profile_of(device.bus).most
    few = len(device.variants) < _MOST and all(len(values) <= _MOST for values in device.variants.values())
    are_read = all(_is_plain(point) and most.get(SPACES[point.space].read, 0) >= point.words for point in points)
    return bool(identifying) and few and are_read and len({point.base for point in points}) == 1


def _is_plain(point: Point) -> bool:
    ordered = point.text is None or list(point.place.addresses) == sorted(point.place.addresses)
    return point.generated and point.space in SPACES and not point.place.is_scattered and ordered


def _literal(row: Identification, place: int, macro: str) -> str:
    """Return the macro, or of a text beyond ASCII the bytes of Latin-1."""
    if not row.texts or row.texts[place].isascii():
        return macro
    return '"' + "".join(f"\\{byte:03o}" for byte in row.texts[place].encode("latin-1", "replace")) + '"'


def _raw_body(view: PointView, literals: Sequence[str]) -> Iterator[str]:
    if view.point.words == 1:
        yield "const uint16_t word = words[0];"
    yield f"const {view.raw_type} raw = {raw_of_words(view)};"
    cast = f"({view.raw_type})" if view.raw_type.startswith("u") else ""  # the macros have no suffix
    yield _status([f"(raw == {cast}{literal})" for literal in literals])


def _text_body(view: PointView, literals: Sequence[str]) -> Iterator[str]:
    text = view.point.text
    assert text is not None
    yield f"char text[{text.most_bytes + 1}];"
    if text.is_unicode:
        yield "size_t length = 0U;"
        yield f"const fieldscribe_status status = {view.function}_decode(words, text, &length);"
        yield "if (status != FIELDSCRIBE_OK) { return FIELDSCRIBE_UNKNOWN_VALUE; }"
    else:
        yield f"(void){view.function}_decode(words, text);"
    yield _status([f"fieldscribe_is_same_text(text, {literal})" for literal in literals])


def _status(tests: Sequence[str]) -> str:
    tested = f"({' || '.join(tests)})" if len(tests) > 1 else tests[0]
    return f"return {tested} ? FIELDSCRIBE_OK : FIELDSCRIBE_UNKNOWN_VALUE;"


# What selects a point.


@dataclass(slots=True)
class Selections:
    """The rows of all selections of a device by the name of their array, each once."""

    device: Device
    profile: Profile
    scope: HeaderScope
    has_pages: bool
    """True if some points select others."""
    arrays: dict[str, list[str]] = field(default_factory=dict)

    def of(self, point: Point) -> str | None:
        """Return the argument that says what selects a point; empty in a device without pages, None if no row can."""
        held = list(self.device.selections(point))
        if point.selects and (point.base or not all(self._has_row(other) for other, _ in held)):
            return None
        if not held:
            return "NULL" if self.has_pages else ""
        parts = [f"{other.item}_{raw}".replace("-", "minus_") for other, raw in held]
        name = f"{self.scope.prefix}_select_{'_'.join(parts)}"
        if name not in self.arrays:
            self.arrays[name] = list(self._rows(held))
        return name

    def _has_row(self, point: Point) -> bool:
        """Return True if one word at one address holds the raw number of a point."""
        at_one = point.write_place is None or point.bits is None
        has_address = bool(point.written.addresses)
        return has_address and point.words == 1 and point.base is None and at_one and bool(self._write(point))

    def _write(self, point: Point) -> int | None:
        return self.profile.write_function(point.space, 1)

    def _rows(self, held: list[tuple[Point, int]]) -> Iterator[str]:
        for other, raw in held:
            [word], mask, read = words_of(other, raw), WHOLE_WORD, 0
            if other.bits is not None:
                word, mask, read = insert(other, 0, raw), group_mask(other), SPACES[other.space].read
                mask |= other.fixed.mask if other.fixed is not None else 0
            place = hexadecimal(min(other.written.addresses)), hexadecimal(mask), unsigned(word)
            is_last = "true" if other is held[-1][0] else "false"
            yield f"{{{', '.join((*place, unsigned(read), unsigned(self._write(other) or 0), is_last))}}}"
