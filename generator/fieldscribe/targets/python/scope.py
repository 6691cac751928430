"""What the expressions of a device refer to."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from fieldscribe.lowered import Lowered
    from fieldscribe.targets.python.identifiers import Identifiers
    from fieldscribe.targets.python.layout import Node


@dataclass(frozen=True, slots=True)
class PackageScope:
    """Final names, points by name, variants and the errata that change facts.

    It collects the used names of the runtime and the shared codes.
    """

    names: Identifiers
    lowered: Lowered
    variants: Mapping[str, tuple[str, ...]]
    errata: Collection[str]
    used: set[str] = field(default_factory=set)
    codes: dict[str, Node] = field(default_factory=dict)
