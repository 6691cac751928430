"""What a run did to its files."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.reading import State


@dataclass(slots=True)
class Result:
    """The relative paths of all outputs, sorted by what happened to them."""

    wanted: set[str] = field(default_factory=set)
    """All files that should be there."""
    written: set[str] = field(default_factory=set)
    removed: set[str] = field(default_factory=set)
    stale: set[str] = field(default_factory=set)
    kept: set[str] = field(default_factory=set)
    states: dict[str, State] = field(default_factory=dict)
    """The states of the files that are up to date."""
    digests: dict[str, str] = field(default_factory=dict)

    @property
    def left(self) -> int:
        """How many files were up to date. A shared file that one device wrote and another found so does not count."""
        return len(self.wanted - self.written - self.stale)
