"""The parts of a header that all families have: constant descriptors of points, and layouts that many points share."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any, NamedTuple

from fieldscribe.arithmetic.words import group_mask, mask_of
from fieldscribe.families import family
from fieldscribe.model import Device, Point
from fieldscribe.resources import Render
from fieldscribe.targets.c.calls import Transfer, call_names, calls, left_out
from fieldscribe.targets.c.point_views import GeneratedPoint, texts_of
from fieldscribe.targets.c.scope import AliasView, Define, HeaderScope, PointView
from fieldscribe.targets.c.syntax import WIDTH, folded, hexadecimal, wire_kind
from fieldscribe.targets.c.word_functions import constant_bits, has_form
from fieldscribe.targets.identifiers import Named, Owner
from fieldscribe.text import c_comment, upper


class Descriptor(NamedTuple):
    """A constant of one of the runtime's types; `parted` says that it needs two lines."""

    type: str
    name: str
    value: str
    tail: str = ""
    """The end of the name, after the name of the point; empty for layouts and commands."""

    @property
    def parted(self) -> bool:
        """True if one line would be too long."""
        return len(f"static const {self.type} {self.name} = {self.value};") > WIDTH


class Frame(NamedTuple):
    """The descriptors that read and write a point, the macros of the conformance program for them, and its calls.

    `row` writes the point as a row of a table; None if it has none.
    """

    descriptors: tuple[Descriptor, ...]
    cases: tuple[str, ...]
    transfer: Transfer = Transfer("")
    row: Callable[[], str] | None = None


class Frames:
    """The frames of points in their order, made once for each view."""

    def __init__(self, points: Sequence[GeneratedPoint], make: Callable[[Point, PointView], Frame | None]) -> None:
        self._points = points
        views = dict.fromkeys(each.view for each in points)
        self._made = {view: make(view.point, view) or Frame((), ()) for view in views}

    @property
    def is_empty(self) -> bool:
        """True if no request reads or writes any of the points."""
        return not any(frame.descriptors for frame in self._made.values())

    def cases(self, view: PointView) -> tuple[str, ...]:
        """Return the macros of the conformance program for the frames of a point."""
        return self._made[view].cases if view in self._made else ()

    def transfer(self, view: PointView) -> Transfer:
        """Return the transfers of the functions that read and write a point."""
        return self._made[view].transfer if view in self._made else Transfer("")

    def left_out(self, view: PointView) -> set[str]:
        """Return the names of a point's functions that nobody calls, as only calls read and write it."""
        frame = self._made.get(view)
        called = frame is not None and not frame.descriptors and bool(frame.transfer.read or frame.transfer.write)
        return left_out(view, frame.transfer) if frame is not None and called else set()

    def text(self, render: Render, scope: HeaderScope | None) -> str:
        """Return the descriptors of all points, and with a scope the functions that read and write one."""
        return "".join(texts_of(self._points, lambda view, _: self._constants(view, render, scope)))

    def rows(self, scope: HeaderScope) -> str:
        """Return the macros of rows, those of old names with them."""
        return "".join(texts_of(self._points, lambda view, _: folded(_macros(self._rows(view, scope)))))

    def _rows(self, view: PointView, scope: HeaderScope) -> list[Define]:
        row = self._made[view].row
        if row is None:
            return []
        name = f"{view.macro}_ROW"
        return [(name, row()), *((each, name) for each in self._row_names(view, scope)[1:])]

    def names(self, scope: HeaderScope) -> Iterator[Named]:
        """Yield the identifiers of the descriptors and functions."""
        for point, view, _ in self._points:
            frame = self._made[view]
            names = [descriptor.name for descriptor in frame.descriptors]
            rows = self._row_names(view, scope)
            names += [*rows[:1], *call_names(point.item, view, frame.transfer, scope)]
            yield Owner("point", point.item), names
            for old, name in zip(point.was, rows[1:], strict=False):
                yield Owner("old name", old, Owner("point", point.item)), (name,)

    def aliases(self, scope: HeaderScope) -> Iterator[AliasView]:
        """Yield the descriptors of renamed points under their old names."""
        for point, view, _ in self._points:
            for old, item in zip(point.was, point.old_items, strict=True) if point.was else ():
                for descriptor in self._made[view].descriptors:
                    name = f"{scope.prefix}_{item}{descriptor.tail}"
                    yield AliasView(old, item, point.item, name, descriptor.name, "OBJECT")
                transfer = self._made[view].transfer
                names = (call_names(each, view, transfer, scope) for each in (item, point.item))
                for name, new in zip(*names, strict=True):
                    yield AliasView(old, item, point.item, name, new, "FUNCTION")

    def _row_names(self, view: PointView, scope: HeaderScope) -> list[str]:
        old = [f"{scope.upper}_{upper(item)}_ROW" for item in view.point.old_items]
        return [f"{view.macro}_ROW", *old] if self._made[view].row else []

    def _constants(self, view: PointView, render: Render, scope: HeaderScope | None) -> str:
        frame = self._made[view]
        texts = [render("c/constant.h.j2", {"one": descriptor}) for descriptor in frame.descriptors]
        texts += [f"{function.text}\n" for function in calls(view, frame.transfer, scope)] if scope else []
        return folded("".join(texts))


def _macros(defines: Iterable[Define]) -> str:
    return "".join(f"#define {name} {literal}\n" for name, literal in defines)


class FramesHeader(NamedTuple):
    """The header of frames of a device: what its template calls `bus`, the frames of points, and all identifiers.

    `sections` has the frames of points by the names of their texts in the template. Identifiers are made when read.
    """

    context: Mapping[str, object]
    sections: Mapping[str, Frames]
    identifiers: Iterator[Named]


def frames_header(
    device: Device, layouts: Layouts, sections: Mapping[str, Frames], identifiers: Iterable[Named], **context: Any
) -> FramesHeader:
    """Return the header of a family's frames: `identifiers` and `context` are what only this family has in it."""
    exceptions = zip(device.bus.exceptions, context.get("exceptions", ()), strict=False)
    guard = f"{layouts.scope.upper}_{device.family.upper()}_H"
    aliases = tuple(alias for frames in sections.values() for alias in frames.aliases(layouts.scope))
    shared = {"guard": guard, "units": device.bus.units, "layouts": layouts.descriptors, "aliases": aliases, **sections}
    names = chain(
        [(Owner("target", "what the header of frames needs"), (guard,))],
        identifiers,
        ((Owner("exception", code.name), (name,)) for code, (name, _, _) in exceptions),
        [(Owner("target", "the layouts of points in words"), [layout.name for layout in layouts.descriptors])],
        (named for frames in sections.values() for named in frames.names(layouts.scope)),
        old_names_of(aliases),
    )
    return FramesHeader({**shared, **context}, sections, names)


@dataclass(frozen=True, slots=True)
class CFamily:
    """The object `IN_C` of the part `targets.c` of a family. Its template and its runtime have the family's name.

    `header` returns the header of frames, `<family>.h.j2`. `named_codes` are the kinds of codes that have a function
    for their names. `has_facts` is True if the runtime's types are in a header of their own, which constants need
    without its functions. `identifies` returns True if a call tells the device and its variants, for which the runtime
    has a header of its own; else the program reads what tells the device.
    """

    header: Callable[[Device, Sequence[GeneratedPoint], HeaderScope], FramesHeader]
    named_codes: tuple[str, ...] = ()
    has_facts: bool = False
    identifies: Callable[[Device], bool] = lambda _: False


def frames_of(device: Device) -> CFamily:
    """Return the part `targets.c` of the device's family."""
    offered: CFamily = family(device.family).part("targets.c").IN_C
    return offered


def lies(point: Point, frame: str) -> str:
    """Return the macro that checks a frame's layout: whether the word is shared, and its constant bits."""
    if point.bits is None and point.fixed is None:
        return f"LIES_ALONE({frame})"
    return f"LIES({frame}, {'false' if point.bits is None else 'true'}, {constant_bits(point)})"


def exchanges(view: PointView, frame: str, ways: Sequence[str]) -> tuple[str, ...]:
    """Return the macros for the layout of a number and the ways in which its frame exchanges it."""
    where, what = lies(view.point, frame), f"{frame}, {kind_of(view)}"
    if where.startswith("LIES_ALONE") and list(ways) == ["READ", "WRITE"]:
        return (f"READ_WRITE({what})",)
    return where, *(f"{way}({what})" for way in ways)


def kind_of(view: PointView) -> str:
    """Return the end of the names of the functions by which conformance takes and puts raw numbers."""
    return f"of_{view.fields.item}" if has_form(view.point) else wire_kind(view.point)


class Layouts:
    """Collects the layouts of a device, each once, by name."""

    def __init__(self, scope: HeaderScope) -> None:
        self.scope = scope
        self._known: dict[str, Descriptor] = {}

    def of(self, point: Point, high_first: Sequence[int]) -> str:
        """Return a reference to the layout of a point; `high_first` has the positions of its words, high word first."""
        kind, mask, low = wire_kind(point), _mask(point), point.bits[1] if point.bits is not None else 0
        order = "".join(map(str, high_first)).rjust(2, "0")
        form = "coded" if point.coding else "low_first" if point.swapped else ""
        name = f"{self.scope.prefix}_layout_{form and f'{form}_'}{kind}{_tail(point, order, mask)}"
        kind = f"{form}_signed" if form == "low_first" and point.info.signed else form or kind
        shared = "false" if point.bits is None else "true"
        shape = f"{len(high_first)}U, 0x{order}U, {shared}, {low}U"
        value = f"FIELDSCRIBE_{kind.upper()}, {shape}, {hexadecimal(mask)}, {constant_bits(point)}"
        self._known[name] = Descriptor("fieldscribe_layout", name, f"{{{value}}}")
        return f"&{name}"

    @property
    def descriptors(self) -> tuple[Descriptor, ...]:
        """All layouts that points use."""
        return tuple(self._known.values())


def old_names_of(aliases: Iterable[AliasView]) -> Iterator[Named]:
    """Yield the identifiers of old names, with their points."""
    for alias in aliases:
        yield Owner("old name", alias.was, Owner("point", alias.item)), (alias.old,)


def _mask(point: Point) -> int:
    """Return the mask of the bits of one or several words that hold the raw number."""
    if point.bits is not None:
        return group_mask(point)
    if point.info.bits == 1:
        return 1 if point.space in ("coil", "discrete") else 0xFFFF
    return mask_of(point.width)


def _tail(point: Point, order: str, mask: int) -> str:
    """Return the end of a layout's name, which distinguishes it among those of its type."""
    parts = [f"{point.width}_bits"] if point.shape.narrow else []
    parts += [f"order_{order}"] if point.words > 1 else []
    if point.bits is not None:
        parts.append(f"bits_{point.bits[0]}_{point.bits[1]}")
    elif point.info.bits == 1 and mask > 1:
        parts.append("word")
    if point.fixed is not None:
        parts.append(f"fixed_{point.fixed.mask:04x}_{point.fixed.bits:04x}")
    return "".join(f"_{part}" for part in parts)


def exceptions_of(device: Device, scope: HeaderScope) -> tuple[tuple[str, str, str], ...]:
    """Return the codes of refusals: enumerator, number and comment."""
    return tuple(
        (f"{scope.upper}_EXCEPTION_{upper(code.name)}", hexadecimal(code.number, 2), c_comment(code.title["en"]))
        for code in device.bus.exceptions
    )
