"""What differs from family to family: the items of a crate that are no points, and what points can do on their bus."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.families.can import can_context, can_hears, can_identifiers, can_traits
from fieldscribe.targets.rust.families.modbus import modbus_context
from fieldscribe.targets.rust.families.spaces import space, space_variant
from fieldscribe.targets.rust.families.uss import uss_context, uss_identifiers, uss_traits

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.model import Device
    from fieldscribe.targets.identifiers import Names
    from fieldscribe.targets.rust.subjects import Scope, Subject

__all__ = ["family_context", "family_identifiers", "family_traits", "is_heard", "space", "space_variant"]

_CONTEXTS = {"modbus": modbus_context, "can": can_context, "uss": uss_context}
_TRAITS = {"can": can_traits, "uss": uss_traits}
_HEARS = {"can": can_hears}
_IDENTIFIERS = {"can": can_identifiers, "uss": uss_identifiers}


def family_context(device: Device) -> dict[str, object]:
    """The family, and what the template of its items sees."""
    return {"family": device.family, **_CONTEXTS[device.family](device)}


def family_traits(subject: Subject, scope: Scope) -> Iterable[str]:
    """Each trait that a point implements for its bus, in a line."""
    return _TRAITS[scope.family](subject, scope) if scope.family in _TRAITS else ()


def is_heard(subject: Subject, scope: Scope) -> bool:
    """Whether a point is received in frames that a device sends of its own accord."""
    return scope.family in _HEARS and _HEARS[scope.family](subject, scope)


def family_identifiers(device: Device) -> Iterable[Names]:
    """The names of the family's own items."""
    return _IDENTIFIERS[device.family](device) if device.family in _IDENTIFIERS else ()
