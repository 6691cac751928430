"""When points exist: conditions as structure, and whether values that can occur make them true.

A condition compares single numbers and names with constants. A few samples decide whether one can be true: each
constant, its neighbours, and the ends of what can occur. Between two samples no comparison changes its result.
"""

import operator
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from fieldscribe.grouping import grouped

TESTS: Mapping[str, Callable[[Any, Any], bool]] = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
"""The comparison of each sign."""
_VERSION = re.compile(r"(.*?)([0-9]+(?:\.[0-9]+)*)([a-z]?)")
_LARGEST = 1 << 64


@dataclass(frozen=True, slots=True)
class Comparison:
    """Compares `of` with constants by `test`: == != < <= > >= (one constant) or `in` (one or more).

    `of` is a variant axis, compared with names of its values, or a point, compared by its raw number.
    """

    of: str
    test: str
    than: tuple[int, ...] | tuple[str, ...]

    def holds(self, value: int | str) -> bool:
        """Return True if the comparison is true for a number or a name."""
        if self.test in ("==", "in"):
            return value in self.than
        return (self.test == "!=" or isinstance(value, int)) and TESTS[self.test](value, self.than[0])


Clause = tuple[Comparison, ...]
"""Comparisons that must all be true."""

Clauses = tuple[Clause, ...]
"""Clauses of which one must be true."""

OPPOSITES: Mapping[str, str] = {"==": "!=", "!=": "==", "<": ">=", ">=": "<", ">": "<=", "<=": ">"}
"""The opposite of each test."""

MOST_CLAUSES = 64
"""The most clauses of a condition in normal form."""

Part = TypeVar("Part")


class TooManyClausesError(ValueError):
    """A condition has more than MOST_CLAUSES clauses in normal form."""


def any_of(parts: Iterable[tuple[Part, ...]]) -> tuple[Part, ...]:
    """Return the clauses of the disjunction of the parts."""
    return tuple(clause for clauses in parts for clause in clauses)


def all_of(parts: Iterable[tuple[tuple[Part, ...], ...]]) -> tuple[tuple[Part, ...], ...]:
    """Return the clauses of the conjunction of the parts. Raises TooManyClausesError."""
    clauses: tuple[tuple[Part, ...], ...] = ((),)
    for part in parts:
        if len(clauses) * len(part) > MOST_CLAUSES:
            raise TooManyClausesError(f"written out, this is more than {MOST_CLAUSES} cases")
        clauses = tuple(first + second for first in clauses for second in part)
    return clauses


def opposite(clauses: Clauses) -> Clauses:
    """Return the clauses of the opposite. Raises TooManyClausesError."""
    return all_of(any_of(map(_opposite, clause)) for clause in clauses)


def _opposite(comparison: Comparison) -> Clauses:
    if comparison.test == "in":
        unequal = (replace(comparison, test="!=", than=(each,)) for each in comparison.than)  # type: ignore[arg-type]  # of one type
        return (tuple(unequal),)
    return ((replace(comparison, test=OPPOSITES[comparison.test]),),)


@dataclass(frozen=True, slots=True)
class Condition:
    """True if all comparisons of one of its `clauses` are true."""

    clauses: Clauses

    @property
    def names(self) -> tuple[str, ...]:
        """Return the axes and points that it compares, in a fixed order."""
        return tuple(dict.fromkeys(comparison.of for clause in self.clauses for comparison in clause))

    def holds(self, values: Mapping[str, int | str]) -> bool:
        """Return True if the condition is true for these values by name."""
        return any(all(comparison.holds(values[comparison.of]) for comparison in clause) for clause in self.clauses)


Domain = tuple[str, ...] | tuple[tuple[int, int], ...]
"""The values that can occur: names, or closed intervals of raw numbers."""

ANY: Domain = ((-_LARGEST, _LARGEST),)
"""The domain of a number about which nothing is known."""


def possible(clause: Iterable[Comparison], domain_of: Callable[[str], Domain]) -> bool:
    """Return True if all comparisons of a clause can be true at once."""
    together = grouped((comparison.of, comparison) for comparison in clause)
    return all(
        any(all(comparison.holds(sample) for comparison in group) for sample in _samples(group, domain_of(name)))
        for name, group in together.items()
    )


def absent(condition: Condition | None, left: Mapping[str, tuple[str, ...]]) -> bool:
    """Return True if a condition cannot be true with only the values `left` of each variant axis."""
    if condition is None:
        return False
    return not any(possible(clause, lambda name: left.get(name, ANY)) for clause in condition.clauses)


def _samples(comparisons: list[Comparison], domain: Domain) -> Iterator[int | str]:
    """Yield samples of the domain that are enough to decide the comparisons."""
    bounds = [part for part in domain if not isinstance(part, str)]
    if not bounds:
        yield from (part for part in domain if isinstance(part, str))
        return
    numbers = [int(constant) for comparison in comparisons for constant in comparison.than]
    for low, high in bounds:
        yield low
        yield high
        yield from (near for number in numbers for near in (number - 1, number, number + 1) if low <= near <= high)


def version_of(text: str) -> tuple[str, tuple[int, ...], str] | None:
    """Return words, numbers and last letter of a version such as `firmware 2.1b`; None if it has no number."""
    match = _VERSION.fullmatch(" ".join(text.lower().split()))
    if match is None:
        return None
    numbers = [int(part) for part in match[2].split(".")]
    while len(numbers) > 1 and numbers[-1] == 0:
        numbers.pop()
    return match[1].strip(), tuple(numbers), match[3]


def ends_before(until: str | None, since: str | None) -> bool:
    """Return True if a last version precedes a first version; only versions with the same words are compared."""
    if until is None or since is None:
        return False
    last, first = version_of(until), version_of(since)
    return last is not None and first is not None and last[0] == first[0] and last[1:] < first[1:]
