"""Facts that a manual prints redundantly: compares them with what the description says."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fieldscribe.language.nodes import Seq
from fieldscribe.language.numbers import NumberError, parse_number

if TYPE_CHECKING:
    from fieldscribe.diagnostics import Span
    from fieldscribe.model import About


@dataclass(frozen=True, slots=True)
class PrintedFact:
    """A printed fact that differs from the description: what it is about, its key, its place, and the message.

    `taken` is the value in the description, None if only an erratum can give the right value. `right` decides whether
    the `taken` of an erratum is correct where comparing numbers or texts is not enough. `flag` names the flag that the
    fact is about.
    """

    about: About
    key: str
    printed: Any
    taken: Any
    span: Span
    message: str
    right: Callable[[Any], bool] | None = None
    flag: str | None = None

    def fits(self, stated: Any) -> bool:
        """Return True if the `taken` of an erratum is what the description says."""
        return self.right(stated) if self.right is not None else same(stated, self.taken)


def same(left: Any, right: Any) -> bool:
    """Return True if two facts are equal: as numbers in any notation, or as texts apart from blanks and case."""
    if isinstance(left, Seq | list | tuple) or isinstance(right, Seq | list | tuple):
        lefts, rights = _items(left), _items(right)
        return len(lefts) == len(rights) and all(same(left, other) for left, other in zip(lefts, rights, strict=True))
    numbers = [_number(left), _number(right)]
    if None not in numbers:
        return numbers[0] == numbers[1]
    return "".join(str(left).split()).lower() == "".join(str(right).split()).lower()


def fact_text(value: Any) -> str:
    """Return a fact as a message shows it."""
    if isinstance(value, Seq | list | tuple):
        return "[" + ", ".join(map(str, value)) + "]"
    return "…" if value is None else str(value)


def _items(value: Any) -> list[Any]:
    """Return the items of a list, or the parts of a text between commas."""
    if isinstance(value, Iterable) and not isinstance(value, str):
        return list(value)
    return [part for part in str(value).split(",") if part.strip()]


def _number(value: Any) -> Fraction | None:
    """Return a number in any notation as a fraction; None for other texts."""
    if isinstance(value, str):
        try:
            return parse_number(value)
        except NumberError:
            return None
    return Fraction(value) if value is not None else None
