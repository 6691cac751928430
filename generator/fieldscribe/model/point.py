"""A point: its identity, and the shape that it shares with others."""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, TypeVar

from fieldscribe.records import dataclass

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from fractions import Fraction

    from fieldscribe.existence import Condition
    from fieldscribe.model.numbers import Special, Titles
    from fieldscribe.model.rules import Allowed
    from fieldscribe.model.shape import Shape

Fact = TypeVar("Fact")


class _Shared(Generic[Fact]):
    """A fact of the shape as an attribute of the point: its users need not know which facts are shared."""

    __slots__ = ("_of",)

    def __init__(self, of: Callable[[Shape], Fact]) -> None:
        self._of = of

    def __get__(self, point: Point, _: object) -> Fact:
        return self._of(point.shape)


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
    """Where a point is read or written: its addresses, that of the high part first, and the manual's numbers for it."""

    addresses: tuple[int, ...]
    references: Mapping[str, int | str]


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
    """The name in generated code: the plain name, and behind it the value of the variant."""
    return name if variant is None else f"{name}_{variant.value.lower()}"


@dataclass(frozen=True, slots=True)
class Point:
    """One addressable datum: its identity, its shape and its limits.

    `name` is unique except for variants: points of the same name differ in `variant`. `place` has no
    addresses if the manual prints none; `write_place` is where the point is written, if that is elsewhere. `bits` are
    its (high, low) bits of the word, None for whole words. `default` is the factory setting in the unit, `default_raw`
    its raw number: each is None if it depends on other points; a floating-point number has only the first. `steps` has
    pairs (from raw, step in raw). `generated` is False for a point that is only documented; `reason` says why.
    """

    name: str
    variant: Variant | None
    code: str | None
    group: str
    space: str
    place: Place
    shape: Shape
    bits: tuple[int, int] | None
    title: Titles
    note: Titles
    unit: Unit
    allowed: Allowed
    default: Fraction | None
    default_raw: int | None
    steps: tuple[tuple[int, int], ...]
    record: str | None
    set: int | None
    changes: str | None
    keeps: str | None
    conditions: tuple[str, ...]
    when: Condition | None
    since: str | None
    until: str | None
    was: tuple[str, ...]
    reserved: bool
    source: Source
    errata: tuple[str, ...]
    generated: bool
    reason: str | None
    telegram: str | None = None
    index: int | None = None
    changes_with: tuple[str, ...] = ()
    write_place: Place | None = None
    untyped: str | None = None
    """What the manual says in place of a type; empty if it leaves the type open; None if the point has a type."""

    type = _Shared(lambda shape: shape.type)
    width = _Shared(lambda shape: shape.width)
    access = _Shared(lambda shape: shape.access)
    scale = _Shared(lambda shape: shape.scale)
    decimals = _Shared(lambda shape: shape.decimals)
    display = _Shared(lambda shape: shape.display)
    encodes_values = _Shared(lambda shape: shape.encodes_values)
    most_raw = _Shared(lambda shape: shape.most_raw)
    enum = _Shared(lambda shape: shape.enum)
    flags = _Shared(lambda shape: shape.flags)
    specials = _Shared(lambda shape: shape.specials)
    shared_codes = _Shared(lambda shape: shape.shared_codes)
    specials_of = _Shared(lambda shape: shape.specials_of)
    text = _Shared(lambda shape: shape.text)
    digits = _Shared(lambda shape: shape.digits)
    fixed = _Shared(lambda shape: shape.fixed)
    info = _Shared(lambda shape: shape.info)
    form = _Shared(lambda shape: shape.form)
    least = _Shared(lambda shape: shape.least)
    greatest = _Shared(lambda shape: shape.greatest)
    held = _Shared(lambda shape: shape.held)
    readable = _Shared(lambda shape: shape.readable)
    writable = _Shared(lambda shape: shape.writable)
    fixed_scale = _Shared(lambda shape: shape.fixed_scale)
    scale_arguments = _Shared(lambda shape: shape.scale_arguments)

    @property
    def raw_only(self) -> bool:
        """Whether only its address is known, not the meaning of its words: it is read and written raw."""
        return not (self.generated or self.reserved) and self.access != "none" and bool(self.addresses)

    @property
    def words(self) -> int:
        """How many 16-bit words (or single bits) the point takes; without a type, as many as addresses are printed."""
        return self.shape.words if self.untyped is None else max(1, len(self.addresses))

    @property
    def outer(self) -> tuple[int, int]:
        """The least and greatest raw number that may ever be written; without limits, what the bits can hold."""
        least, greatest = self.shape.least, self.shape.greatest
        low, high = self.allowed.outer or (least, greatest)
        return max(low, least), min(high, greatest)

    @property
    def addresses(self) -> tuple[int, ...]:
        """The addresses where the point is read (or else written), the high part first; may be empty."""
        return self.place.addresses

    @property
    def references(self) -> Mapping[str, int | str]:
        """The numbers that the manual prints for people, by numbering."""
        return self.place.references

    @property
    def address(self) -> int | None:
        """The lowest address, which requests name; None if the manual prints none."""
        return min(self.addresses) if self.addresses else None

    @property
    def written(self) -> Place:
        """The place where the point is written, which mostly is where it is read."""
        return self.write_place or self.place

    @property
    def places(self) -> tuple[Place, ...]:
        """Where the point is read, and where else it is written; empty if the manual prints no address."""
        apart = () if self.write_place is None else (self.write_place,)
        return (self.place, *apart) if self.addresses else ()

    def special(self, raw: int) -> Special | None:
        """The special code with that raw number, if there is one."""
        return next((code for code in self.shape.specials if code.low <= raw <= code.high), None)

    @property
    def item(self) -> str:
        """The name in generated code, with the value of its variant."""
        return item_of(self.name, self.variant)

    @property
    def arguments(self) -> tuple[str, ...]:
        """The points whose raw numbers encoding, decoding or checking needs, in a fixed order."""
        return tuple(dict.fromkeys((*self.shape.scale_arguments, *self.allowed.arguments)))

    @property
    def limit_arguments(self) -> tuple[str, ...]:
        """The points that the limits need at run time: their factors, and those whose codes lift them."""
        return self.allowed.arguments
