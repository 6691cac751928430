"""What became of the files of a run."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.reading import State


@dataclass(slots=True)
class Result:
    """What became of all devices: relative paths by what happened to them."""

    wanted: set[str] = field(default_factory=set)
    """All files that now should be there."""
    written: set[str] = field(default_factory=set)
    removed: set[str] = field(default_factory=set)
    stale: set[str] = field(default_factory=set)
    kept: set[str] = field(default_factory=set)
    states: dict[str, State] = field(default_factory=dict)
    """How the files are that are as they should be."""
    digests: dict[str, str] = field(default_factory=dict)

    @property
    def left(self) -> int:
        """How many files were as they should be; of one that several devices share one may have been the writer."""
        return len(self.wanted - self.written - self.stale)
