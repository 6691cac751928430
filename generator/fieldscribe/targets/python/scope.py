"""What expressions of one device refer to."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Point
    from fieldscribe.targets.python.identifiers import Identifiers


@dataclass(frozen=True, slots=True)
class Scope:
    """Final names, points by name, variants, and (filled on the way) the names of the runtime that expressions use."""

    names: Identifiers
    points: Mapping[str, Point]
    variants: Mapping[str, tuple[str, ...]]
    used: set[str] = field(default_factory=set)
