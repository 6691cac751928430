"""What differs from family to family: the items of a crate that are no points, and what points can do on their bus."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from fieldscribe.families import family
from fieldscribe.targets.rust.families.spaces import space

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from fieldscribe.model import Device
    from fieldscribe.targets.identifiers import Identifier
    from fieldscribe.targets.rust.subjects import Scope, Subject

__all__ = ["family_context", "family_identifiers", "family_traits", "space"]


class OfFamily(Protocol):
    """What the part `targets.rust` of a family offers."""

    def context(self, device: Device) -> Mapping[str, object]:
        """What the template of the family's items sees, `<family>.rs.j2`."""

    def traits(self, subject: Subject, scope: Scope) -> Iterable[str]:
        """Each trait that a point implements for its bus, in a line."""

    def identifiers(self, device: Device) -> Iterable[Identifier]:
        """Identifiers of the family's own items: namespace, identifier, what it stands for."""


def family_context(device: Device) -> dict[str, object]:
    """The family, and what the template of its items sees."""
    return {"family": device.family, **_offered(device.family).context(device)}


def family_traits(subject: Subject, scope: Scope) -> Iterable[str]:
    """Each trait that a point implements for its bus, in a line."""
    return _offered(scope.family).traits(subject, scope)


def family_identifiers(device: Device) -> Iterable[Identifier]:
    """Identifiers of the family's own items: namespace, identifier, what it stands for."""
    return _offered(device.family).identifiers(device)


def _offered(name: str) -> OfFamily:
    offered: OfFamily = family(name).part("targets.rust")
    return offered
