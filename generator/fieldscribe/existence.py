"""When points exist: conditions as structure, and what follows from them over the values that can occur.

Conditions compare single numbers and names with constants, so a few samples decide everything about them: each constant
with its neighbours, and the ends of what can occur. Between those no comparison changes.
"""

from __future__ import annotations

import operator
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping

_TESTS: Mapping[str, Callable[[int, int], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
_VERSION = re.compile(r"(.*?)([0-9]+(?:\.[0-9]+)*)([a-z]?)")
_LARGEST = 1 << 64


@dataclass(frozen=True, slots=True)
class Comparison:
    """`of` compared with constants by `test`: == != < <= > >= (one constant) or `in` (one or more).

    `of` is a variant axis, compared with names of its values, or a point, compared by its raw number.
    """

    of: str
    test: str
    than: tuple[int, ...] | tuple[str, ...]

    def holds(self, one: int | str) -> bool:
        """Whether it is true of a number, or of a name."""
        if self.test == "!=":
            return one != self.than[0]
        found = _TESTS.get(self.test)
        if found is None:
            return one in self.than
        return isinstance(one, int) and found(one, int(self.than[0]))


Clause = tuple[Comparison, ...]
"""Comparisons that hold together."""


@dataclass(frozen=True, slots=True)
class Condition:
    """True when all comparisons of one of its `clauses` are."""

    clauses: tuple[Clause, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The axes and points that it compares, in a fixed order."""
        return tuple(dict.fromkeys(one.of for clause in self.clauses for one in clause))

    def holds(self, values: Mapping[str, int | str]) -> bool:
        """Whether it is true of these values by name."""
        return any(all(one.holds(values[one.of]) for one in clause) for clause in self.clauses)


Domain = tuple[str, ...] | tuple[tuple[int, int], ...]
"""What can occur: names, or closed intervals of raw numbers."""

ANY: Domain = ((-_LARGEST, _LARGEST),)
"""What is known of a number that nobody bounds."""


def possible(clause: Iterable[Comparison], domain_of: Callable[[str], Domain]) -> bool:
    """Whether all the comparisons can be true at once."""
    together: dict[str, list[Comparison]] = {}
    for one in clause:
        together.setdefault(one.of, []).append(one)
    return all(
        any(all(one.holds(sample) for one in mine) for sample in _samples(mine, domain_of(name)))
        for name, mine in together.items()
    )


def absent(condition: Condition | None, left: Mapping[str, tuple[str, ...]]) -> bool:
    """Whether a condition cannot be true any more with these values `left` of each axis of variants."""
    if condition is None:
        return False
    return not any(possible(clause, lambda name: left.get(name, ANY)) for clause in condition.clauses)


def _samples(comparisons: list[Comparison], domain: Domain) -> Iterator[int | str]:
    """Enough of the domain to decide the comparisons."""
    bounds = [one for one in domain if not isinstance(one, str)]
    if not bounds:
        yield from (one for one in domain if isinstance(one, str))
        return
    numbers = [int(one) for comparison in comparisons for one in comparison.than]
    for low, high in bounds:
        yield low
        yield high
        yield from (near for one in numbers for near in (one - 1, one, one + 1) if low <= near <= high)


def version_of(text: str) -> tuple[str, tuple[int, ...], str] | None:
    """`firmware 2.1.0` as what it counts, its numbers and the letter behind; None for a text without a version."""
    found = _VERSION.fullmatch(" ".join(text.lower().split()))
    if found is None:
        return None
    numbers = [int(part) for part in found[2].split(".")]
    while len(numbers) > 1 and numbers[-1] == 0:
        numbers.pop()
    return found[1].strip(), tuple(numbers), found[3]


def ends_before(until: str | None, since: str | None) -> bool:
    """Whether the last version of one thing comes before the first of another: of versions that count the same."""
    last, first = version_of(until or ""), version_of(since or "")
    return last is not None and first is not None and last[0] == first[0] and last[1:] < first[1:]
