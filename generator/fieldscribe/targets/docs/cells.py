"""Cells of a table: the Markdown form and the interface of other forms, addresses and remarks of points.

`DocsScope` holds what all rows of a device share.
"""

import re
from collections.abc import Callable, Collection, Container, Iterable, Mapping, Sequence
from operator import attrgetter
from typing import NamedTuple, TypeAlias, TypeVar

from fieldscribe import wording
from fieldscribe.facts.points import POINT
from fieldscribe.facts.table import Context, Fact
from fieldscribe.families import family
from fieldscribe.model import Device, Point, Source
from fieldscribe.text import markdown
from fieldscribe.wording.rules import RenamedPoints

Thing = TypeVar("Thing")
Columns: TypeAlias = Mapping[str, Callable[[Thing], str]]
"""The columns of a table: for each head, a function that returns the cell of a thing."""

LINE_BREAK = "<br>"
"""Begins a new line inside a cell."""
MAY_BREAK = "_<wbr>"
"""An underscore after which a line may break."""
_BARE = re.compile(r"[0-9A-Za-z°%.,;:/?'()=+ -]*")
"""Characters of most cells; Markdown escapes none of them."""
_PLAIN = re.compile(r"(?:[^\W_]|[°%.,;:/?'()=+ -]|(?<=[A-Za-z0-9])_(?=[A-Za-z0-9])|(?<= )\*{1,2}(?= ))*")
_CODE = re.compile(r"[A-Za-z0-9_.+/=-]+(?: [A-Za-z0-9_.+/=-]+)*")
_LONG_NAME = re.compile(r"\b(?=\w{14})[A-Za-z0-9]+(?:_[A-Za-z0-9]+)+\b")
"""Matches a name that would make its column wide."""
_LONG_NUMBER = re.compile(r"\b(\d{9,10})(\d{9,10})\b")
_NARROW = 12
"""A shorter text needs no break."""
_LONG = 17
"""The name of a point may be broken from this length on: breaking it takes extra characters in code."""
_LONG_SPAN = re.compile(r"(?:(?<=[a-z)])|(?<=[0-9.]{5}))\.\.|\.\.(?=[A-Za-z]|-?[0-9]{6})")
"""Matches the dots of a range that has a name or a long number at an end."""
_NUMBERED = re.compile(r"^([0-9]+)([.)])")
_ANCHOR = re.compile(r"[a-z0-9_-]+")
_NO_ANCHOR = re.compile(r"[^a-z0-9_-]")


class Form(NamedTuple):
    """The form of a page: how it writes texts, code, links, targets of links, and tables.

    `lay_out` takes finished rows, the heads first.
    """

    cell: Callable[[str], str]
    paragraph: Callable[[str], str]
    code: Callable[[str], str]
    link: Callable[[str, str], str]
    narrow_link: Callable[[str, str], str]
    target: Callable[[str, str], str]
    narrow_target: Callable[[str, str], str]
    line_break: str
    lay_out: Callable[[Sequence[Sequence[str]]], str]

    def source(self, source: Source, with_document: bool) -> str:
        """Return the place of a fact in the manual as a cell."""
        return self.cell(source_text(source, with_document))

    def lines(self, *texts: str) -> str:
        """Return the non-empty texts as a cell, each on its own line."""
        return self.line_break.join(filter(None, texts))

    def by_rows(self, heads: Sequence[str], rows: Sequence[Sequence[str]], always: Container[str] = ()) -> str:
        """Return a table of finished cells; empty without rows.

        Empty columns are left out, except those in `always`: the first row that fills one would otherwise change the
        lines of all others.
        """
        columns = zip(heads, *rows, strict=True) if rows else ()
        kept = [column for column in columns if column[0] in always or any(column[1:])]
        return self.lay_out(list(zip(*kept, strict=True))) if kept else ""

    def table(self, things: Iterable[Thing], columns: Columns[Thing], always: Container[str] = ()) -> str:
        """Return the table with a row for each thing, as `by_rows` does."""
        rows = [[cell_of(thing) for cell_of in columns.values()] for thing in things]
        return self.by_rows(tuple(columns), rows, always)


def _lay_out(rows: Sequence[Sequence[str]]) -> str:
    """Return the lines of a table; nothing is padded, because one longer cell would change all lines."""
    heads, *others = rows
    lines = [" | ".join(row) for row in (heads, ("---",) * len(heads), *others)]
    return "| " + " |\n| ".join(lines) + " |\n"


def cell(text: str) -> str:
    """Return plain text as a table cell; only possible markup is escaped, so that the source stays readable."""
    if not text or text.isalnum():
        return text
    plain = (_BARE.fullmatch(text) or _PLAIN.fullmatch(text)) and "://" not in text and "www." not in text
    return text.strip() if plain else markdown(text)


def number_cell(number: int | str) -> str:
    """Return a number as the manual prints it, perhaps with letters, as a table cell."""
    return cell(number) if isinstance(number, str) else str(number)


def paragraph(text: str) -> str:
    """Return plain text as the beginning of a line: a number that would start a list is escaped too."""
    return _NUMBERED.sub(r"\1\\\2", markdown(text))


def code(text: str) -> str:
    """Return a name or bytes as a code span; as escaped text if it has unusual characters."""
    return f"`{text}`" if _CODE.fullmatch(text) else markdown(text)


def narrow(text: str) -> str:
    """Return a finished cell whose long names and numbers may be broken; searching still finds them."""
    if len(text) < _NARROW:
        return text
    return _LONG_NAME.sub(_breaking, _LONG_SPAN.sub("..<wbr>", _LONG_NUMBER.sub(r"\1<wbr>\2", text)))


def _breaking(name: re.Match[str]) -> str:
    return name[0].replace("_", MAY_BREAK)


def narrow_link(kind: str, name: str) -> str:
    """Return a link for a narrow column."""
    return f"[{narrow(cell(name))}](#{anchor(kind, name)})"


def anchor(kind: str, name: str) -> str:
    """Return the anchor that a link and its target share."""
    return f"{kind}-{name if _ANCHOR.fullmatch(name) else _NO_ANCHOR.sub('-', name.lower())}"


def target(kind: str, name: str) -> str:
    """Return a name as the target of links."""
    return f'<a id="{anchor(kind, name)}"></a>{code(name)}'


def narrow_target(kind: str, name: str) -> str:
    """Return a name as the target of links in a narrow column; a long one may be broken."""
    long = _LONG_NAME.fullmatch(name) if len(name) >= _LONG else None
    return f'<a id="{anchor(kind, name)}"></a>{f"<code>{_breaking(long)}</code>" if long else code(name)}'


def link(kind: str, name: str) -> str:
    """Return a name as a link to its target."""
    return f"[{code(name)}](#{anchor(kind, name)})"


def source_text(source: Source, with_document: bool) -> str:
    """Return the place of a fact in the manual as plain text."""
    parts = [source.document] if with_document else []
    parts += [source.section] if source.section else []
    parts += [f"page {source.page}"] if source.page else []
    parts += [f"line {source.line}"] if source.line is not None else []
    return ", ".join(parts)


MARKDOWN = Form(cell, paragraph, code, link, narrow_link, target, narrow_target, LINE_BREAK, _lay_out)
by_rows, table = MARKDOWN.by_rows, MARKDOWN.table


# What the rows of a device share.


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


def computed_numberings(device: Device) -> Collection[str]:
    """Return the numberings that the family computes from addresses."""
    return family(device.family).numbers(device.points[0].space, 0) if device.points else ()


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
        from_point = self._remarks([placed for placed, value in values if value or value == 0], point)
        key = id(point.shape), id(point.terms)
        known = self._known.get(key)
        if known is None:
            shared = self._remarks(self._shared, point)
            known = self._known[key] = shared, _joined(shared)
        return _joined(sorted(from_point + known[0])) if from_point else known[1]

    def _remarks(self, facts: list[tuple[int, Fact]], point: Point) -> list[tuple[int, str]]:
        remarks = [(place, self._remark(fact, point)) for place, fact in facts]
        return [(place, remark) for place, remark in remarks if remark]

    def _remark(self, fact: Fact, point: Point) -> str:
        further = self._further.get(fact.key)
        return self._encode(fact.remark_of(point, self._context)) if further is None else further(point)


def _joined(remarks: list[tuple[int, str]]) -> str:
    return "; ".join([remark for _, remark in remarks])
