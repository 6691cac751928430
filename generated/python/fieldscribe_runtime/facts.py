# SPDX-License-Identifier: 0BSD
"""Where points are, and what else a description says of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .records import Record

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import NotRequired, TypedDict, Unpack

    from .conditions import Clauses
    from .forms import Allowed

    class FactArguments(TypedDict):
        """What generated code says of a point beside its form."""

        at: Place
        write_at: NotRequired[Place]
        bits: NotRequired[tuple[int, int]]
        group: NotRequired[str]
        code: NotRequired[str]
        references: NotRequired[Mapping[str, int | str]]
        unit: NotRequired[str]
        display: NotRequired[int]
        allowed: NotRequired[Allowed]
        default: NotRequired[float]
        fixed: NotRequired[tuple[int, int]]
        changes: NotRequired[str]
        changes_with: NotRequired[tuple[str, ...]]
        takes_effect: NotRequired[str]
        write_with: NotRequired[tuple[str, ...]]
        selects: NotRequired[tuple[tuple[str, int], ...]]
        variant: NotRequired[tuple[str, str]]
        only_for: NotRequired[tuple[str, tuple[str, ...]]]
        uncertain: NotRequired[bool]
        when: NotRequired[Clauses]
        conditions: NotRequired[tuple[str, ...]]
        keeps: NotRequired[str]
        name: NotRequired[str]


class Place(Record):
    """Where a point is: its space, its addresses (the high part first), and a function if it is not the usual one.

    An element of an array has its `index`, words of a telegram the name of that `telegram`; signals are words of the
    telegram of their message. With a `base`, by its name, the addresses count from that.
    """

    space: str
    addresses: tuple[int, ...]
    function: int | None = None
    index: int | None = None
    telegram: str | None = None
    base: str | None = None

    def __str__(self) -> str:
        """Return the place as manuals print it: numbers of parameters and words in decimal, other addresses not."""
        if self.telegram is not None:
            return f"{self.telegram} word {', '.join(map(str, self.addresses))}"
        notation = str if self.space == "parameter" else "0x{:04X}".format
        index = "" if self.index is None else f" index {self.index}"
        counted = "" if self.base is None else f" from {self.base}"
        return f"{self.space} {', '.join(map(notation, self.addresses))}{index}{counted}"

    @property
    def area(self) -> str:
        """The space and its base: equal addresses in one area are the same words."""
        return self.space if self.base is None else f"{self.space} from {self.base}"

    @property
    def label(self) -> str:
        """The place for messages: the first of several words."""
        return str(self.replaced(addresses=(self.address,)))

    @property
    def address(self) -> int:
        """The lowest address, which a request names."""
        return min(self.addresses)

    @property
    def span(self) -> int:
        """How many words or bits a request for it covers."""
        return max(self.addresses) - min(self.addresses) + 1

    @property
    def is_scattered(self) -> bool:
        """True if there are words of other points between its own."""
        return self.span > len(self.addresses) > 1

    @property
    def runs(self) -> list[Place]:
        """Its words as places without gaps, from the lowest address on."""
        addresses = sorted(self.addresses)
        starts = [at for at, address in enumerate(addresses) if not at or address - 1 != addresses[at - 1]]
        ends = (*starts[1:], len(addresses))
        return [self.replaced(addresses=tuple(addresses[at:end])) for at, end in zip(starts, ends, strict=True)]

    def overlaps(self, other: Place) -> bool:
        """Return True if both have a word or bit in common."""
        same = (self.area, self.telegram) == (other.area, other.telegram)
        same_element = self.index == other.index or None in (self.index, other.index)
        return same and same_element and not set(self.addresses).isdisjoint(other.addresses)


class Documented(Record):
    """A point that is only documented: the reason, its words if a master can reach them, and the manual's code."""

    reason: str
    at: Place | None = None
    code: str | None = None
    write_at: Place | None = None

    def __str__(self) -> str:
        """Return the reason, and how to reach its words."""
        if self.at is None:
            return self.reason
        where = f"{self.at.telegram or self.at.space} {', '.join(map(str, self.at.addresses))}"
        index = "" if self.at.index is None else f", index {self.at.index}"
        if self.write_at is None:
            return f"{self.reason}; `read_at` and `write_at` reach its words at {where}{index}"
        written = ", ".join(map(str, self.write_at.addresses))
        return f"{self.reason}; `read_at` reaches its words at {where}{index}, `write_at` at {written}"


class Identification(Record):
    """What a point holds in a device, or in one of its variants: one of `values`, raw numbers or texts."""

    point: str
    values: tuple[int | str, ...]
    variant: tuple[str, str] | None = None


class Telegram(Record):
    """A layout of words in one telegram: a `request` to the device, or a `response` or `cyclic` telegram from it.

    `message` names the CAN message whose frames carry it, if there is one.
    """

    name: str
    direction: str
    words: int
    message: str | None = None


def coil(*addresses: int, function: int | None = None, index: int | None = None, base: str | None = None) -> Place:
    """Return a bit that can be read and written."""
    return Place("coil", addresses, function, index, base=base)


def discrete(*addresses: int, function: int | None = None, index: int | None = None, base: str | None = None) -> Place:
    """Return a bit that can be read."""
    return Place("discrete", addresses, function, index, base=base)


def holding(*addresses: int, function: int | None = None, index: int | None = None, base: str | None = None) -> Place:
    """Registers that can be read and written."""
    return Place("holding", addresses, function, index, base=base)


def input_register(
    *addresses: int, function: int | None = None, index: int | None = None, base: str | None = None
) -> Place:
    """Registers that can be read."""
    return Place("input", addresses, function, index, base=base)


def parameter(*addresses: int, function: int | None = None, index: int | None = None) -> Place:
    """Return a parameter by its number, or an element of one; a text lies in several."""
    return Place("parameter", addresses, function, index)


def telegram(name: str, *addresses: int, index: int | None = None) -> Place:
    """Return words of a telegram, counted from 0; an element of an array has its index."""
    return Place("telegram", addresses, None, index, name)


class Facts:
    """The facts of a point. `item` is the name of the attribute, `name` leaves out the variant.

    `references` are the manual's other numberings of the point, `allowed` the raw numbers that may be written.
    `display` is the number of decimals to show, if the description has it. `fixed` is a mask and the constant bits that
    every write of the word sets. `changes_with` names points that change it. `only_for` is a variant axis and the
    values for which the point exists; `uncertain` means that something else decides it too, such as another point or a
    firmware. `when` is the condition on raw numbers of other points: one of several groups of tests. `conditions` must
    be true before it is written. `takes_effect` says when the device uses a written value, `write_with` names what is
    written in the same request. `selects` has points with the raw numbers that they must hold before the address means
    this point. `keeps` says whether a written value survives power-off: `no`, `yes` (each write wears the memory),
    `choice` (if written with `keep=True`, which wears it) or the command that has to follow; empty if the manual does
    not say.
    """

    at: Place
    write_at: Place | None = None
    bits: tuple[int, int] | None = None
    group: str = ""
    code: str | None = None
    references: Mapping[str, int | str] = {}
    unit: str = ""
    display: int | None = None
    allowed: Allowed | None = None
    default: float | None = None
    fixed: tuple[int, int] | None = None
    changes: str | None = None
    changes_with: tuple[str, ...] = ()
    variant: tuple[str, str] | None = None
    only_for: tuple[str, tuple[str, ...]] | None = None
    uncertain: bool = False
    when: Clauses = ()
    conditions: tuple[str, ...] = ()
    takes_effect: str = "at once"
    write_with: tuple[str, ...] = ()
    selects: tuple[tuple[str, int], ...] = ()
    keeps: str = ""
    name: str = ""
    item: str = ""

    def __init__(self, **facts: Unpack[FactArguments]) -> None:
        self.__dict__.update(facts)

    def __repr__(self) -> str:
        return f"Facts({', '.join([f'{name}={value!r}' for name, value in self.__dict__.items()])})"

    @property
    def where(self) -> str:
        """The place in words: address, bits, the manual's other numberings, and the address to write."""
        bits = "" if self.bits is None else f" bits {self.bits[0]}..{self.bits[1]}"
        printed = ", ".join(f"{key} {number}" for key, number in self.references.items())
        written = "" if self.write_at is None else f", written at {self.write_at}"
        return f"{self.at}{bits}" + (f" ({printed})" if printed else "") + written
