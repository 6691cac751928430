"""What the C target asks of a bus family: one header for the frames, beside the runtime of the family."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from fieldscribe.families import family

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import DeviceView
    from fieldscribe.targets.identifiers import Named


class OfFamily(Protocol):
    """What the part `targets.c` of a family offers; its template and runtime go by the family's name."""

    NAMED_CODES: tuple[str, ...]
    """The kinds of codes that a function names."""

    def bus_view(self, device: Device, view: DeviceView, scope: HeaderScope) -> Any:
        """The view of the header of frames, `<family>.h.j2`."""

    def identifiers(self, device: Device, bus: Any, scope: HeaderScope) -> Iterator[Named]:
        """Every identifier in that header by what it belongs to."""

    def adapters(self, bus: Any) -> Iterator[tuple[str, str]]:
        """Macros with which points answer conformance vectors that only this family has, by their function."""


def frames_of(device: Device) -> OfFamily:
    """What is known of the frames of a device."""
    offered: OfFamily = family(device.family).part("targets.c")
    return offered
