"""What all rows of a device share: its points by name, the cells with addresses, and the remarks."""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from operator import attrgetter
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.facts.points import POINT
from fieldscribe.facts.table import Context, Fact
from fieldscribe.model import Device, Point
from fieldscribe.targets.docs.cells import MARKDOWN, Form, cell, number_cell
from fieldscribe.wording.rules import RenamedPoints


class DocsScope(NamedTuple):
    """What all rows of a device share."""

    device: Device
    by_name: Mapping[str, Point]
    by_code: RenamedPoints
    context: Context
    """The context of the facts of points; other points appear by name."""
    several: bool
    """True if facts come from several documents: then each source names its document."""


def scope_of(device: Device) -> DocsScope:
    """Return the scope of a device."""
    by_name = {point.name: point for point in device.points}
    by_code = RenamedPoints(by_name, _codes(device.points))
    return DocsScope(device, by_name, by_code, Context(device, names=by_name), len(device.documents) > 1)


def _codes(points: Iterable[Point]) -> dict[str, str]:
    """Return the codes of points by their names, for codes that belong to one name."""
    names: dict[str, set[str]] = {}
    for point in points:
        if point.code:
            names.setdefault(point.code, set()).add(point.name)
    return {next(iter(known)): code for code, known in names.items() if len(known) == 1}


def place_text(point: Point, form: Form = MARKDOWN) -> str:
    """Return the first address of a point and its number of words: `3100h (12544)`, then `2 words, low word first`."""
    if not point.addresses:
        return ""
    if point.place.bit is not None:
        return wording.bits_in_message(point)
    start, count = wording.address_text(min(point.addresses)), len(point.addresses)
    if count == 1:
        return start
    order = wording.order_text(point)
    return form.lines(start, f"{count} words, {form.cell(order)}" if order else f"{count} addresses")


def reference_heads(points: Iterable[Point]) -> tuple[str, ...]:
    """Return the numberings of the manual that some of the points have, in the order of their first use."""
    heads: dict[str, None] = {}
    for point in points:
        heads |= dict.fromkeys(point.place.references)
    return tuple(heads)


def numbers_head(keys: Sequence[str]) -> str:
    """Return the head of the column with all numberings: `Modicon / Reference`."""
    return cell(" / ".join(key.capitalize() for key in keys))


def numbers_text(numbers: Mapping[str, int | str], keys: Sequence[str]) -> str:
    """Return numbers in the order of these numberings: `4115 / 404115`, with a dash for one that is missing."""
    return " / ".join([number_cell(numbers.get(key, "-")) for key in keys]) if numbers else ""


class Remarks:
    """Builds the remarks of the points of a device; remarks that points share are built once.

    `encode` turns a text into a cell. `further` has remarks that are finished cells, by the key of the fact. Facts in
    `left_out` give no remarks; with `in_columns`, neither do facts that have a column.
    """

    def __init__(
        self,
        context: Context,
        encode: Callable[[str], str],
        further: Mapping[str, Callable[[Point], str]],
        left_out: Collection[str] = (),
        *,
        in_columns: bool = False,
    ) -> None:
        self._context, self._encode, self._further = context, encode, further
        kept = [fact for fact in POINT if fact.remark and fact.key not in left_out and not (in_columns and fact.column)]
        facts = [fact for fact in POINT if fact.key in further or fact in kept]
        places = list(enumerate(facts))
        self._shared = [(place, fact) for place, fact in places if fact.holder]
        self._own = [(place, fact) for place, fact in places if not fact.holder]
        attributes = [fact.attribute or (fact.key if fact.value is None else "name") for _, fact in self._own]
        self._own_values = attrgetter(*attributes)
        self._known: dict[tuple[int, int], tuple[list[tuple[int, str]], str]] = {}

    def of(self, point: Point) -> str:
        """Return the remarks of a point in one line."""
        values = zip(self._own, self._own_values(point), strict=True)
        own = self._remarks([placed for placed, value in values if value or value == 0], point)
        key = id(point.shape), id(point.terms)
        known = self._known.get(key)
        if known is None:
            shared = self._remarks(self._shared, point)
            known = self._known[key] = shared, _joined(shared)
        return _joined(sorted(own + known[0])) if own else known[1]

    def _remarks(self, facts: list[tuple[int, Fact]], point: Point) -> list[tuple[int, str]]:
        remarks = [(place, self._remark(fact, point)) for place, fact in facts]
        return [(place, remark) for place, remark in remarks if remark]

    def _remark(self, fact: Fact, point: Point) -> str:
        further = self._further.get(fact.key)
        return self._encode(fact.remark_of(point, self._context)) if further is None else further(point)


def _joined(remarks: list[tuple[int, str]]) -> str:
    return "; ".join([remark for _, remark in remarks])
