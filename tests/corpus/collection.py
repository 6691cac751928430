"""What a collection offers the driver."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from fieldscribe.importing.draft_text import DraftGroup, Head


class Drafted(NamedTuple):
    """What an importer drafts."""

    groups: Sequence[DraftGroup]
    head: Head


class Collection(NamedTuple):
    """A kind of files: which of a folder, and what drafts one; it returns None for a file that it leaves out."""

    name: str
    files: Callable[[Path], list[Path]]
    draft: Callable[[Path], Drafted | None]
