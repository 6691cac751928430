"""What the C target asks of a bus family: the view of a header for the frames."""

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
    """The part `targets.c` of a family. Its template and its runtime have the family's name."""

    NAMED_CODES: tuple[str, ...]
    """The kinds of codes for which a function gives the name."""

    def bus_view(self, device: Device, view: DeviceView, scope: HeaderScope) -> Any:
        """The view of the header of frames, `<family>.h.j2`."""

    def identifiers(self, device: Device, bus: Any, scope: HeaderScope) -> Iterator[Named]:
        """Every identifier in that header, with its owner."""

    def adapters(self, bus: Any) -> Iterator[tuple[str, str]]:
        """Macros for the conformance vectors that only this family has, each with the function of its point."""


def frames_of(device: Device) -> OfFamily:
    """The part `targets.c` of the device's family."""
    offered: OfFamily = family(device.family).part("targets.c")
    return offered
