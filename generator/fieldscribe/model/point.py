"""A point: its identity, and the shape that it shares with others."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Final, Generic, TypeVar

from fieldscribe.conditions import Condition
from fieldscribe.model.numbers import Enum, Special, Titles
from fieldscribe.model.shape import Allowed, Shape

Fact = TypeVar("Fact")


if TYPE_CHECKING:

    class _Shared(Generic[Fact]):
        """A property whose type is that of the fact; `property` alone would be `Any` to type checkers."""

        def __init__(self, of: Callable[[Point], Fact]) -> None: ...

        def __get__(self, point: object, owner: type | None = None, /) -> Fact: ...

else:
    _Shared = property


@dataclass(frozen=True, slots=True)
class Source:
    """Where in the manual a fact stands."""

    document: str
    section: str | None
    page: str | None
    line: int | None


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of measure; the empty symbol is the plain number."""

    symbol: str
    name: str
    quantity: str


@dataclass(frozen=True, slots=True)
class Place:
    """Where a point is read or written: its addresses, high part first, and the numbers that the manual prints.

    `signal` is the first bit of a signal in its message, and True if its low byte comes first; its addresses are words
    of the telegram of the message.
    """

    addresses: tuple[int, ...]
    references: Mapping[str, int | str]
    signal: tuple[int, bool] | None = None

    @property
    def is_scattered(self) -> bool:
        """Return True if words of other points lie between its own: then one request must read those too."""
        return len(self.addresses) > 1 and max(self.addresses) - min(self.addresses) >= len(self.addresses)

    @property
    def bit(self) -> int | None:
        """Return the first bit of a signal in its message; None for other points."""
        return None if self.signal is None else self.signal[0]

    @property
    def low_first(self) -> bool:
        """Return True for a signal whose low byte comes first."""
        return self.signal is not None and self.signal[1]


def message_bits(start: int, width: int, *, low_first: bool) -> tuple[int, ...]:
    """Return the bits of a signal in its message, the least significant one first."""
    if low_first:
        return tuple(range(start, start + width))
    first = start ^ 7  # counted in the order in which the bits travel
    return tuple([place ^ 7 for place in reversed(range(first, first + width))])


def bits_of(point: Point) -> tuple[int, ...]:
    """Return the bits in its message of a point that is a signal."""
    return message_bits(point.place.bit or 0, point.width, low_first=point.place.low_first)


NOWHERE = Place((), {})
"""The place of a point whose address the manual does not print."""


@dataclass(frozen=True, slots=True)
class Variant:
    """One value of one axis, as people write it: `axis=value`."""

    axis: str
    value: str

    def __str__(self) -> str:
        return f"{self.axis}={self.value}"


def item_of(name: str, variant: Variant | None) -> str:
    """Return the name in generated code: the plain name, followed by the value of the variant."""
    return name if variant is None else f"{name}_{variant.value.lower()}"


@dataclass(frozen=True, slots=True)
class Terms:
    """Facts beside the shape that points of a group share, such as space and unit.

    `bits` are the (high, low) bits of the word, None for whole words. `steps` has pairs (from raw, step in raw).
    `generated` is False for points that are only documented; `reason` says why. `untyped` is what the manual prints in
    place of a type: empty if it leaves the type open, None if there is a type. `view_of` names a point that has the
    same words. `certainty` says where the facts come from, None if it is the manual. `base` names what the addresses
    count from, None if that is 0; a point that repeats `to_end` exists where the found block is long enough.
    `takes_effect` says when the device uses a written value, None if at once; `write_with` names the points that are
    written in the same request. `selects` lists points with the raw number that each must hold before the address
    means this point.
    """

    group: str
    space: str
    bits: tuple[int, int] | None
    unit: Unit
    steps: tuple[tuple[int, int], ...]
    changes: str | None
    keeps: str | None
    conditions: tuple[str, ...]
    when: Condition | None
    since: str | None
    until: str | None
    reserved: bool
    generated: bool
    reason: str | None
    telegram: str | None = None
    changes_with: tuple[str, ...] = ()
    untyped: str | None = None
    view_of: str | None = None
    certainty: str | None = None
    base: str | None = None
    to_end: bool = False
    takes_effect: str | None = None
    write_with: tuple[str, ...] = ()
    selects: tuple[tuple[str, int], ...] = ()


@dataclass(slots=True)
class Point:
    """One addressable datum: its identity, and the shape and terms that it shares with others.

    `name` is unique, except that points of the same name may differ in `variant`. `place` has no addresses if the
    manual prints none; `write_place` is where the point is written, if that is elsewhere. `default` is the factory
    setting in the unit, `default_raw` its raw number: each is None if it depends on other points; a floating-point
    number has only the first. `enum_names` are the name and the old names of an enum that only this point has, or its
    sets and elements; empty if its shape has the name. `Final` keeps the fields as they are made; `frozen` would take
    three times as long.
    """

    name: Final[str]
    variant: Final[Variant | None]
    code: Final[str | None]
    title: Final[Titles]
    note: Final[Titles]
    source: Final[Source]
    place: Final[Place]
    write_place: Final[Place | None]
    shape: Final[Shape]
    terms: Final[Terms]
    allowed: Final[Allowed]
    default: Final[Fraction | None]
    default_raw: Final[int | None]
    record: Final[str | None]
    set: Final[int | None]
    index: Final[int | None]
    was: Final[tuple[str, ...]]
    errata: Final[tuple[str, ...]]
    enum_names: Final[tuple[str, ...]] = ()

    # Facts of the shape and the terms are attributes of the point: users need not know which facts are shared.
    type = _Shared(lambda point: point.shape.type)
    width = _Shared(lambda point: point.shape.width)
    access = _Shared(lambda point: point.shape.access)
    scale = _Shared(lambda point: point.shape.scale)
    decimals = _Shared(lambda point: point.shape.decimals)
    display = _Shared(lambda point: point.shape.display)
    encodes_values = _Shared(lambda point: point.shape.encodes_values)
    most_raw = _Shared(lambda point: point.shape.most_raw)
    flags = _Shared(lambda point: point.shape.flags)
    enum = _Shared(lambda point: point.shape.enum)
    specials = _Shared(lambda point: point.shape.specials)
    shared_codes = _Shared(lambda point: point.shape.shared_codes)
    specials_of = _Shared(lambda point: point.shape.specials_of)
    text = _Shared(lambda point: point.shape.text)
    digits = _Shared(lambda point: point.shape.digits)
    patterns = _Shared(lambda point: point.shape.patterns)
    swapped = _Shared(lambda point: point.shape.swapped)
    coding = _Shared(lambda point: point.shape.coding)
    epoch = _Shared(lambda point: point.shape.epoch)
    fixed = _Shared(lambda point: point.shape.fixed)
    info = _Shared(lambda point: point.shape.info)
    form = _Shared(lambda point: point.shape.form)
    least = _Shared(lambda point: point.shape.least)
    greatest = _Shared(lambda point: point.shape.greatest)
    held = _Shared(lambda point: point.shape.held)
    readable = _Shared(lambda point: point.shape.readable)
    writable = _Shared(lambda point: point.shape.writable)
    has_counts = _Shared(lambda point: point.shape.has_counts)
    fixed_scale = _Shared(lambda point: point.shape.fixed_scale)
    scale_arguments = _Shared(lambda point: point.shape.scale_arguments)

    group = _Shared(lambda point: point.terms.group)
    space = _Shared(lambda point: point.terms.space)
    bits = _Shared(lambda point: point.terms.bits)
    unit = _Shared(lambda point: point.terms.unit)
    steps = _Shared(lambda point: point.terms.steps)
    changes = _Shared(lambda point: point.terms.changes)
    keeps = _Shared(lambda point: point.terms.keeps)
    conditions = _Shared(lambda point: point.terms.conditions)
    when = _Shared(lambda point: point.terms.when)
    since = _Shared(lambda point: point.terms.since)
    until = _Shared(lambda point: point.terms.until)
    reserved = _Shared(lambda point: point.terms.reserved)
    generated = _Shared(lambda point: point.terms.generated)
    reason = _Shared(lambda point: point.terms.reason)
    telegram = _Shared(lambda point: point.terms.telegram)
    changes_with = _Shared(lambda point: point.terms.changes_with)
    untyped = _Shared(lambda point: point.terms.untyped)
    view_of = _Shared(lambda point: point.terms.view_of)
    certainty = _Shared(lambda point: point.terms.certainty)
    base = _Shared(lambda point: point.terms.base)
    to_end = _Shared(lambda point: point.terms.to_end)
    takes_effect = _Shared(lambda point: point.terms.takes_effect)
    selects = _Shared(lambda point: point.terms.selects)
    write_with = _Shared(lambda point: point.terms.write_with)
    limit_arguments = _Shared(lambda point: point.allowed.arguments)
    addresses = _Shared(lambda point: point.place.addresses)
    references = _Shared(lambda point: point.place.references)

    @property
    def named_numbers(self) -> Enum | None:
        """Return the names of its numbers, or of each of its digits."""
        enum = self.shape.named_numbers
        if enum is None or not self.enum_names:
            return enum
        name, *was = self.enum_names
        return Enum(name, enum.entries, enum.closed, tuple(was))

    @property
    def raw_only(self) -> bool:
        """Return True if its address is known and the meaning of its words is not: it is read and written raw."""
        return not (self.generated or self.reserved) and self.access != "none" and bool(self.place.addresses)

    @property
    def words(self) -> int:
        """Return how many 16-bit words (or single bits) the point takes; without a type, how many addresses it has."""
        return self.shape.words if self.untyped is None else max(1, len(self.place.addresses))

    @property
    def outer(self) -> tuple[int, int]:
        """Return the least and greatest raw number that may ever be written; without limits, what the bits can hold."""
        least, greatest = self.shape.least, self.shape.greatest
        low, high = self.allowed.outer or (least, greatest)
        return max(low, least), min(high, greatest)

    @property
    def address(self) -> int | None:
        """Return the lowest address, which requests name; None if the manual prints none."""
        return min(self.place.addresses) if self.place.addresses else None

    @property
    def written(self) -> Place:
        """Return the place where the point is written: usually where it is read."""
        return self.write_place or self.place

    @property
    def places(self) -> tuple[Place, ...]:
        """Return where the point is read, then where it is written if that differs; empty without an address."""
        elsewhere = () if self.write_place is None else (self.write_place,)
        return (self.place, *elsewhere) if self.place.addresses else ()

    def special(self, raw: int) -> Special | None:
        """Return the special code with that raw number, if there is one."""
        return next((code for code in self.shape.specials if code.low <= raw <= code.high), None)

    @property
    def item(self) -> str:
        """Return the name in generated code, with the value of its variant."""
        return self.name if self.variant is None else item_of(self.name, self.variant)

    @property
    def rank(self) -> tuple[bool, str, int]:
        """Return the rank of the point: a text that many points share is printed at the point of least rank.

        The rank follows the address, because new points usually have higher addresses than old ones, wherever they
        are in the description. A point without an address comes last.
        """
        addresses = self.place.addresses
        return not addresses, self.space, min(addresses, default=0)

    @property
    def old_items(self) -> tuple[str, ...]:
        """Return the old names in generated code."""
        return tuple([item_of(old, self.variant) for old in self.was])

    @property
    def arguments(self) -> tuple[str, ...]:
        """Return the points whose raw numbers encoding, decoding or checking needs, in a fixed order."""
        return tuple(dict.fromkeys((*self.shape.scale_arguments, *self.allowed.arguments)))
