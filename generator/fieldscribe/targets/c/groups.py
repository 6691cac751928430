"""Structs with a member for each point of a group or telegram, and the function that fills one from words."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.lowered import plan_of
from fieldscribe.model import Point
from fieldscribe.targets.c.layout import wrapped
from fieldscribe.targets.c.literals import raw_type
from fieldscribe.targets.c.scope import HeaderScope
from fieldscribe.targets.c.views import PointView
from fieldscribe.targets.c.word_functions import has_words
from fieldscribe.text import c_comment

_INDENT = 2 * "    "


class Member(NamedTuple):
    """A member of a struct, and the lines of the statement that fills it.

    The name says whether it is a count or raw: a count where decoding cannot fail and needs no other point.
    """

    declaration: str
    comment: str
    lines: list[str]


class Part(NamedTuple):
    """The members that one request or frame fills; `label` is its number in the function."""

    label: str
    members: tuple[Member, ...]


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

    @cached_property
    def members(self) -> dict[str, str]:
        """The declarations of all members with their comments."""
        return {member.declaration: member.comment for part in self.parts for member in part.members}


def members_of(point: Point, view: PointView, position: int, scope: HeaderScope) -> Iterator[Member]:
    """Yield the member of a point whose words begin at a position, and one for each old name.

    A text that is read backwards has none.
    """
    name, word = f"{scope.prefix}_{point.item}", f"words[{position}]"
    for item in (point.item, *point.old_items):
        if point.text is not None:
            if list(point.place.addresses) != sorted(point.place.addresses):
                return
            target = f"{item}_text"
            declaration = f"char {target}[{point.text.characters + 1}]"
            yield Member(declaration, "", wrapped(f"(void){name}_decode(&{word}, group->{target});", _INDENT))
            continue
        raw, kind, comment = _raw(point, name, word), raw_type(point), ""
        if _is_plainly_counted(point, view):
            target, comment = f"{item}_count", wording.count_text(point)
            kind, raw = "int64_t" if plan_of(point.shape).count_wide else "int32_t", f"{name}_decode_count({raw})"
        else:
            target = f"{item}_raw"
            comment = point.unit.symbol
            comment = f"decodes to {comment}" if comment and view.shape != "plain" else comment
        yield Member(f"{kind} {target}", c_comment(comment), wrapped(f"group->{target} = {raw};", _INDENT))


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
    return view.shape == "scaled" and view.is_counted and view.special is None and plan_of(point.shape).beyond is None
