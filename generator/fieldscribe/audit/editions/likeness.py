"""How a description writes what a table prints: learned from rows that are described, for rows that are not yet."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.audit.citing import OWN_PRINTED
from fieldscribe.audit.editions.tables.yaml_text import printed as written
from fieldscribe.language.nodes import Map, Seq

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.audit.editions.tables.drafts import DraftPoint
    from fieldscribe.language.nodes import Map as Node
    from fieldscribe.resolve.points import ResolvedPoint

_AT = "at"
"""The number that a row was read to have as its address, where it prints no other."""
_INDEX = re.compile(r"\[[0-9]+\]$")
"""The index behind a code."""
_NUMBERS = re.compile(r"[-0-9., ]+")


class Described(NamedTuple):
    """A row that is described: its line in the new edition, its point, where that stands; and as the table reads it."""

    line: int
    resolved: ResolvedPoint
    place: str
    read: DraftPoint

    @property
    def group(self) -> Node:
        """The group that has it."""
        return self.resolved.facts.group

    @property
    def printed(self) -> dict[str, list[str]]:
        """What it says under `printed`, every number as a text."""
        said = self.resolved.facts.get("printed")
        if not isinstance(said, Map):
            return {}
        return {
            key: [str(item) for item in (value if isinstance(value, Seq) else [value])] for key, value in said.items()
        }


def like(point: DraftPoint, rows: Iterable[Described]) -> DraftPoint:
    """The point with its address and its printed numbers as the described rows have theirs."""
    rows = list(rows)
    by_rule = any("addressing" in row.group for row in rows)
    if by_rule:  # rows that name several parameters print the address of one of them
        rows = [row for row in rows if row.printed] or rows
    numbers = [text for key, texts in point.printed.items() if key not in OWN_PRINTED for text in texts[:1]]
    point = replace(point, printed=_printed(point, rows), questions=list(point.questions))
    apart = Counter(apart for row in rows if (apart := _apart(row)) is not None).most_common(1)
    if point.at is None or not apart or apart[0][1] * 2 <= len(rows):
        return _asking(point, numbers)
    at = point.at + apart[0][0]
    if by_rule:
        ruled = _by_rule(at, rows)
        if not ruled:
            return _asking(point, numbers)
        return replace(point, code=_code_beside(*ruled, rows) or point.code, shown=str(ruled[0]), index=ruled[1])
    return replace(point, at=at, shown=f"{at:04X}h" if point.shown.endswith("h") else str(at))


def _asking(point: DraftPoint, numbers: list[str]) -> DraftPoint:
    return replace(point, at=None, shown=f"~  # ? the row prints {', '.join(numbers) or point.shown}")


def _by_rule(address: int, rows: list[Described]) -> tuple[int, int] | None:
    """Number and index of an address in a run of indices of one number, by those of the nearest rows of that run."""
    runs: dict[int, dict[int, int]] = {}
    for row in rows:
        number, index, there = row.resolved.facts.get("at"), row.resolved.facts.get("index"), row.resolved.point.address
        if isinstance(number, int) and isinstance(index, int) and there is not None:
            runs.setdefault(number, {})[index] = there
    below = [(max(run.values()), number) for number, run in runs.items() if min(run.values()) < address]
    for _, number in sorted(below, reverse=True)[:1]:
        (first, start), *others = sorted(runs[number].items())
        steps = {Fraction(there - start, index - first) for index, there in others}
        if len(steps) == 1 and (index := first + (address - start) / steps.pop()).denominator == 1:
            return number, int(index)
    return None


def _code_beside(number: int, index: int, rows: list[Described]) -> str:
    """The code as the other indices of a number have theirs, such as `P050[7]`; "" if they have none."""
    drafts = (row.resolved.facts for row in rows)
    codes = [str(draft.code) for draft in drafts if draft.get("at") == number and draft.code]
    return next((_INDEX.sub(f"[{index}]", code) for code in codes if _INDEX.search(code)), "")


def _apart(row: Described) -> int | None:
    """How far the address of a described row is from the number that was read."""
    address, read = row.resolved.point.address, row.read.at
    return None if address is None or read is None else address - read


def _printed(point: DraftPoint, rows: list[Described]) -> dict[str, list[str]]:
    """The keys that described rows have, in the order of the one that has most."""
    keys: dict[str, str] = {}
    for row in rows:
        for key, texts in row.printed.items():
            read_as = _read_as(key, texts, row.read)
            if read_as != key or key not in keys:
                keys[key] = read_as
    fullest = max((row.printed for row in rows), key=len, default={})
    read = {
        **point.printed,
        _AT: [point.shown],
        "range": [point.range] if point.range and _NUMBERS.fullmatch(point.range) else [],
    }
    ordered = sorted(keys, key=lambda key: list(fullest).index(key) if key in fullest else len(fullest))
    usual = [key for key in ordered if keys[key] != _AT or sum(key in row.printed for row in rows) * 2 > len(rows)]
    return {key: read[keys[key]] for key in usual if read.get(keys[key])}


def _read_as(key: str, texts: list[str], read: DraftPoint) -> str:
    """What a key of a described row is called where the row is read; the halves of a long value have one name."""
    if key in OWN_PRINTED or key in read.printed or key.startswith(("low_", "high_")):
        return key
    known = {**read.printed, _AT: [read.shown]}
    return next((other for other, numbers in known.items() if _numbers(numbers) == _numbers(texts)), key)


def _numbers(texts: Iterable[str]) -> list[str]:
    return sorted(written(text).casefold().strip('"') for text in texts)
