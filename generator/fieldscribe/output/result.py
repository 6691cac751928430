"""What a run did to its files."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.safe_files import State


class Result:
    """The relative paths of all outputs, sorted by what happened to them: `wanted` are all that should be there.

    `states` are those of the files that are up to date, with their `digests`.
    """

    def __init__(self, wanted: Iterable[str] = ()) -> None:
        self.wanted = set(wanted)
        self.written: set[str] = set()
        self.removed: set[str] = set()
        self.stale: set[str] = set()
        self.kept: set[str] = set()
        self.states: dict[str, State] = {}
        self.digests: dict[str, str] = {}

    @property
    def left(self) -> int:
        """How many files were up to date. A shared file that one device wrote and another found so does not count."""
        return len(self.wanted - self.written - self.stale)
