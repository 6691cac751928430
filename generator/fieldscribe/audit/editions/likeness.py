"""How a description writes what a table prints: learned from rows that are described, for rows that are not yet."""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.audit.citing import OWN_PRINTED
from fieldscribe.importing.yaml_text import printed as written
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.records import replace

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.importing.drafts import DraftPoint
    from fieldscribe.language.nodes import Map as Node
    from fieldscribe.resolve.points import Resolved

_NUMBERS = re.compile(r"[-0-9., ]+")


class Described(NamedTuple):
    """A row that is described: its line in the new edition, its point, where that stands; and as the table reads it."""

    line: int
    resolved: Resolved
    place: str
    read: DraftPoint

    @property
    def group(self) -> Node:
        """The group that has it."""
        return self.resolved.draft.group

    @property
    def printed(self) -> dict[str, list[str]]:
        """What it says under `printed`, every number as a text."""
        said = self.resolved.draft.get("printed")
        if not isinstance(said, Map):
            return {}
        return {
            key: [str(item) for item in (value if isinstance(value, Seq) else [value])] for key, value in said.items()
        }


def like(point: DraftPoint, rows: Iterable[Described]) -> DraftPoint:
    """The point with its address and its printed numbers as the described rows have theirs."""
    rows = list(rows)
    numbers = [text for key, texts in point.printed.items() if key not in OWN_PRINTED for text in texts[:1]]
    point = replace(point, printed=_printed(point, rows), questions=list(point.questions))
    apart = Counter(apart for row in rows if (apart := _apart(row)) is not None).most_common(1)
    by_rule = any("addressing" in row.group for row in rows)
    if point.at is None or by_rule or not apart or apart[0][1] * 2 <= len(rows):
        return replace(point, at=None, shown=f"~  # ? the row prints {', '.join(numbers) or point.shown}")
    at = point.at + apart[0][0]
    return replace(point, at=at, shown=f"{at:04X}h" if point.shown.endswith("h") else str(at))


def _apart(row: Described) -> int | None:
    """How far the address of a described row is from the number that was read."""
    address, read = row.resolved.point.address, row.read.at
    return None if address is None or read is None else address - read


def _printed(point: DraftPoint, rows: list[Described]) -> dict[str, list[str]]:
    """The keys that described rows have, in the order of the one that has most."""
    keys: dict[str, str] = {}
    for row in rows:
        for key, texts in row.printed.items():
            keys.setdefault(key, _read_as(key, texts, row.read))
    fullest = max((row.printed for row in rows), key=len, default={})
    read = {**point.printed, "range": [point.range] if point.range and _NUMBERS.fullmatch(point.range) else []}
    ordered = sorted(keys, key=lambda key: list(fullest).index(key) if key in fullest else len(fullest))
    return {key: read[keys[key]] for key in ordered if read.get(keys[key])}


def _read_as(key: str, texts: list[str], read: DraftPoint) -> str:
    """What a key of a described row is called where the row is read; the halves of a long value have one name."""
    if key in OWN_PRINTED or key in read.printed or key.startswith(("low_", "high_")):
        return key
    return next((other for other, numbers in read.printed.items() if _numbers(numbers) == _numbers(texts)), key)


def _numbers(texts: Iterable[str]) -> list[str]:
    return sorted(written(text).casefold().strip('"') for text in texts)
