"""What a collection offers the driver."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from random import Random
from typing import Any, NamedTuple, TypeAlias

from fieldscribe.importing.draft_text import DraftGroup, Head


class Drafted(NamedTuple):
    """What an importer drafts."""

    groups: Sequence[DraftGroup]
    head: Head


Points: TypeAlias = Sequence[Mapping[str, Any]]
"""The points of a device as `export json` has them."""


class Counts(NamedTuple):
    """For how many random contents of a point there are vectors: that are read, and that are written."""

    read: int
    written: int


class Collection(NamedTuple):
    """A kind of files: which of a folder, and what drafts one; it returns None for a file that it leaves out.

    `expected` is the oracle: it yields names of points with vectors for so many random contents of each.
    """

    name: str
    files: Callable[[Path], list[Path]]
    draft: Callable[[Path], Drafted | None]
    expected: Callable[[Path, Points, Random, Counts], Iterator[tuple[str, Iterator[str]]]]
