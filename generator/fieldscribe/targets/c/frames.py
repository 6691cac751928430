"""What the headers of all families share: constant descriptors of points, and layouts, which many points share."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.names import upper
from fieldscribe.records import dataclass
from fieldscribe.targets.c.device import old_items
from fieldscribe.targets.c.literals import hexadecimal, raw_type
from fieldscribe.targets.c.views import AliasView
from fieldscribe.targets.identifiers import Owner
from fieldscribe.text import c_comment

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from fieldscribe.model import Device, Point
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.identifiers import Named

_LINE = 120
_WIDTHS = (8, 16, 32, 64)
_KINDS = {"bool": "bit", **{f"{sign}int{bits}_t": f"{sign or 's'}{bits}" for sign in ("u", "") for bits in _WIDTHS}}


@dataclass(frozen=True, slots=True)
class Descriptor:
    """A constant of one of the runtime's types; `parted` says that it needs two lines."""

    type: str
    name: str
    value: str
    item: str = ""
    """The point that it describes; empty for layouts and commands."""
    tail: str = ""
    """The part of the name behind the name of the point."""

    @property
    def parted(self) -> bool:
        """Whether one line would be too long."""
        return len(f"static const {self.type} {self.name} = {self.value};") > _LINE


def kind_of(point: Point) -> str:
    """The type of a point's raw number, as in the names of the runtime's functions: `u16`."""
    return _KINDS[raw_type(point)]


def lies(point: Point) -> str:
    """Whether a point shares its word, and its constant bits: arguments with which conformance checks the layout."""
    fixed = (point.fixed.mask, point.fixed.bits) if point.fixed is not None else (0, 0)
    return f"{'true' if shares(point) else 'false'}, {hexadecimal(fixed[0])}, {hexadecimal(fixed[1])}"


def shares(point: Point) -> bool:
    """Whether writing the point needs to read its word first, because it has only some of its bits."""
    return point.bits is not None


class Layouts:
    """Collects the layouts of a device, each once, by name."""

    def __init__(self, scope: HeaderScope) -> None:
        self._prefix = scope.prefix
        self._known: dict[str, Descriptor] = {}

    def of(self, point: Point, high_first: Sequence[int]) -> str:
        """A reference to the layout of a point; `high_first` has the places of its words, the high word's first."""
        kind, mask, low = kind_of(point), _mask(point), point.bits[1] if point.bits is not None else 0
        order = f"{sum(place << 4 * at for at, place in enumerate(reversed(high_first))):0{max(2, len(high_first))}X}"
        fixed = (point.fixed.mask, point.fixed.bits) if point.fixed is not None else (0, 0)
        name = f"{self._prefix}_layout_{kind}{_tail(point, order, mask, fixed)}"
        shared = "true" if shares(point) else "false"
        value = (
            f"FIELDSCRIBE_{kind.upper()}, {len(high_first)}U, 0x{order}U, {shared}, {low}U, "
            f"{hexadecimal(mask)}, {hexadecimal(fixed[0])}, {hexadecimal(fixed[1])}"
        )
        self._known[name] = Descriptor("fieldscribe_layout", name, f"{{{value}}}")
        return f"&{name}"

    @property
    def descriptors(self) -> tuple[Descriptor, ...]:
        """All layouts that points asked for."""
        return tuple(self._known.values())


def places_of(point: Point) -> list[int]:
    """The places of a point's words among its addresses, the high word's first."""
    order = sorted(point.addresses)
    whole = len(order) == point.words  # one address of a parameter may hold several words, the high one first
    return [order.index(address) for address in point.addresses] if whole else list(range(point.words))


def names_of(layouts: Iterable[Descriptor], others: Iterable[Descriptor]) -> Iterator[Named]:
    """The identifiers of layouts, and of the descriptors of points."""
    yield Owner("target", "the layouts of points in words"), [layout.name for layout in layouts]
    for described in others:
        yield Owner("point", described.item), (described.name,)


def aliases_of(descriptors: Iterable[Descriptor], device: Device, scope: HeaderScope) -> tuple[AliasView, ...]:
    """The descriptors of renamed points under their old names."""
    renamed = {point.item: tuple(old_items(point)) for point in device.points if point.was}
    return tuple(
        AliasView(old, item, descriptor.item, f"{scope.prefix}_{item}{descriptor.tail}", descriptor.name, "OBJECT")
        for descriptor in descriptors
        for old, item in renamed.get(descriptor.item, ())
    )


def old_names_of(aliases: Iterable[AliasView]) -> Iterator[Named]:
    """The identifiers of old names, with their points."""
    for alias in aliases:
        yield Owner("old name", alias.was, Owner("point", alias.item)), (alias.old,)


def _mask(point: Point) -> int:
    """The mask of the bits of one or several words that hold the raw number."""
    if point.bits is not None:
        high, low = point.bits
        return ((1 << (high - low + 1)) - 1) << low
    if point.info.bits == 1:
        return 1 if point.space in ("coil", "discrete") else 0xFFFF
    return (1 << point.info.bits) - 1


def _tail(point: Point, order: str, mask: int, fixed: tuple[int, int]) -> str:
    """The part of a layout's name that tells it from others of its type."""
    parts = [f"order_{order.lower()}"] if point.words > 1 else []
    if point.bits is not None:
        parts.append(f"bits_{point.bits[0]}_{point.bits[1]}")
    elif point.info.bits == 1 and mask > 1:
        parts.append("word")
    if fixed[0]:
        parts.append(f"fixed_{fixed[0]:04x}_{fixed[1]:04x}")
    return "".join(f"_{part}" for part in parts)


def exceptions_of(device: Device, scope: HeaderScope) -> tuple[tuple[str, str, str], ...]:
    """The codes with which a device refuses: enumerator, number and comment."""
    return tuple(
        (f"{scope.upper}_EXCEPTION_{upper(code.name)}", hexadecimal(code.number, 2), c_comment(code.title["en"]))
        for code in device.bus.exceptions
    )


def names_of_exceptions(device: Device, defines: Iterable[tuple[str, str, str]]) -> Iterator[Named]:
    """The enumerators of the codes with which a device refuses."""
    for code, (name, _, _) in zip(device.bus.exceptions, defines, strict=True):
        yield Owner("exception", code.name), (name,)
