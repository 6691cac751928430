"""Structs with a member for each point of a group or telegram, the code that fills them, and rows of a user's table."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.arithmetic.exact import Line
from fieldscribe.arithmetic.words import INT32
from fieldscribe.lowered import plan_of
from fieldscribe.model import Point
from fieldscribe.targets.c.conversions import is_rechecked
from fieldscribe.targets.c.point_views import GeneratedPoint
from fieldscribe.targets.c.scope import HeaderScope, PointView
from fieldscribe.targets.c.syntax import raw_type, wrapped
from fieldscribe.targets.c.word_functions import has_words
from fieldscribe.targets.placeholders import TextTemplates
from fieldscribe.text import c_comment, c_string

_ITSELF = Line(1, 0, 1)
"""The identity."""


def has_row(view: PointView) -> bool:
    """Return True if 32 bits hold the raw number, as it is."""
    return view.point.text is None and view.point.info.bits <= 32 and not view.point.coding


def is_written_by_row(view: PointView) -> bool:
    """Return True if what may be written is an interval with fixed limits."""
    return view.shape != "digits" and not is_rechecked(view.point)


def facts_of(view: PointView, raw_decimals: str) -> list[str]:
    """Return the limits, the factor, addend and divisor to raw, the decimals, the name and the unit as literals.

    `raw_decimals` marks a raw number, whose meaning one row cannot hold.
    """
    point, fields = view.point, view.fields
    low, high, line, decimals = fields.low, fields.high, _ITSELF, raw_decimals
    if not view.special and view.shape == "plain":
        decimals = "0"
    elif not view.special and view.shape == "scaled" and point.has_counts:
        plan = plan_of(point.shape)
        if plan.beyond is None and plan.to_raw.factor > 0 and max(map(abs, plan.to_raw)) <= INT32[1]:
            low, high, line, decimals = fields.first, fields.last, plan.to_raw, f"{point.decimals}"
    ends = (low, high) if point.writable and is_written_by_row(view) else ("0", "0")
    return [*ends, *map(str, line), decimals, f'"{fields.item}"', c_string(point.unit.symbol)]


_INDENT = 2 * "    "


class Part(NamedTuple):
    """The members that one request or frame fills: their declarations, with the statements that fill them.

    `label` is the number of the request or frame in the function, `cases` are the macros of the conformance program.
    """

    label: str
    members: dict[str, str]
    cases: Sequence[str]

    @classmethod
    def of(cls, label: str, texts: Iterable[tuple[str, str, str]]) -> Part:
        """Return the part that has these texts of points, from `Members`."""
        present = [text for text in texts if text[0]]
        members = {declaration: statements for declaration, statements, _ in present}
        return cls(label, members, [case for _, _, cases in present for case in cases.split("\n") if case])


@dataclass(frozen=True)
class StructView:
    """A struct, and the function that fills a part of it. Members are made when a header is written."""

    struct: str
    make: Callable[[], Iterator[Part]]

    @property
    def names(self) -> tuple[str, str]:
        """The identifiers: the struct and the function."""
        return self.struct, f"{self.struct}_decode"

    @cached_property
    def parts(self) -> tuple[Part, ...]:
        """The parts that have members."""
        return tuple(part for part in self.make() if part.members)

    @property
    def members(self) -> dict[str, None]:
        """The declarations of all members."""
        return dict.fromkeys(member for part in self.parts for member in part.members)

    @property
    def cases(self) -> Iterator[str]:
        """The macros of the conformance program that compare members with the raw numbers of their points."""
        return (case for part in self.parts for case in part.cases)


class Members:
    """Builds the members of points; the text is laid out once for each view and length of the position."""

    def __init__(self, scope: HeaderScope) -> None:
        self.scope, self._texts = scope, TextTemplates()

    def of(self, each: GeneratedPoint, position: int) -> tuple[str, str, str]:
        """Return the members of a point whose words begin at a position, the statements that fill them, and the cases.

        The position takes the place of the comment among the fields. A text that is read backwards has no members.
        """
        at, (point, view, fields) = str(position), each
        lay_out = partial(self._lay_out, point, view)
        declarations, statements, cases = self._texts.fill((view, len(at)), (at, *fields[1:]), lay_out).split("\0")
        return declarations, statements, cases

    def _lay_out(self, point: Point, view: PointView, fields: Sequence[str]) -> str:
        members = list(_members(point, view, f"words[{fields[0]}]"))
        texts = [declaration for declaration, _ in members], [statement for _, statement in members]
        return "\0".join(map("\n".join, (*texts, _cases(point, view, self.scope))))


def _members(point: Point, view: PointView, word: str) -> Iterator[tuple[str, str]]:
    """Yield the declaration of a point's member with its statement, and those for each old name.

    Its name says whether it is a count or raw: it is a count if decoding cannot fail and needs no other point.
    """
    name, ending = view.function, ""
    if point.text is not None and (
        point.text.is_unicode or point.text.parts or list(point.place.addresses) != sorted(point.place.addresses)
    ):
        return
    for item in (view.fields.item, *point.old_items):
        if point.text is not None:
            target, kind = (f"{item}_bytes", "uint8_t") if point.text.is_bytes else (f"{item}_text", "char")
            ending = f"[{point.text.characters + (kind == 'char')}]"
            comment, ignored = (point.text.encoding, "") if point.text.is_bytes else ("", "(void)")
            statement = f"{ignored}{name}_decode(&{word}, group->{target});"
        elif _is_plainly_counted(point, view):
            target, comment = f"{item}_count", wording.count_text(point)
            kind = "int64_t" if plan_of(point.shape).count_wide else "int32_t"
            statement = f"group->{target} = {name}_decode_count({_raw(point, name, word)});"
        else:
            target, kind, comment = f"{item}_raw", raw_type(point), point.unit.symbol
            comment = f"decodes to {comment}" if comment and view.shape != "plain" else comment
            statement = f"group->{target} = {_raw(point, name, word)};"
        remark = f" /* {c_comment(comment)} */" if comment else ""
        yield f"    {kind} {target}{ending};{remark}", "\n".join(wrapped(statement, _INDENT))


def _cases(point: Point, view: PointView, scope: HeaderScope) -> Iterator[str]:
    """Yield the macros of the conformance program that compare the members of a point with its raw number."""
    item, kind, old_items = view.fields.item, raw_type(point), point.old_items
    if point.text is not None:
        member, end = ("BYTES", "bytes") if point.text.is_bytes else ("PACKED", "text")
        is_plain = point.text.is_plain and not point.text.is_bytes
        yield f"MEMBER_TEXT({item})" if is_plain else f"MEMBER_{member}({scope.prefix}, {item})"
        size = f"sizeof group.{item}_{end}"
        yield from (
            f'MEMBER("{item}", memcmp(group.{old}_{end}, group.{item}_{end}, {size}) == 0)' for old in old_items
        )
        return
    is_counted = _is_plainly_counted(point, view)
    yield f"MEMBER_COUNT({scope.prefix}, {item}, {kind})" if is_counted else f"MEMBER_RAW({item}, {kind})"
    end = "count" if is_counted else "raw"
    yield from (f'MEMBER("{item}", group.{old}_{end} == group.{item}_{end})' for old in old_items)


def _raw(point: Point, name: str, word: str) -> str:
    """Return the expression for a point's raw number in words."""
    if point.bits is not None:
        return f"{name}_extract({word})"
    if has_words(point):
        return f"{name}_from_words(&{word})"
    if point.info.bits == 1:
        return f"{word} != 0U"
    return word if point.info.bits == 16 else f"({raw_type(point)})({word} & 0xFFU)"


def _is_plainly_counted(point: Point, view: PointView) -> bool:
    """Return True if `decode_count` takes a raw number alone and always succeeds."""
    return view.shape == "scaled" and view.is_counted and not view.special and plan_of(point.shape).beyond is None
