"""What the C target asks of a bus family: the view of a header for the frames."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from fieldscribe.families import family

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from fieldscribe.model import Device
    from fieldscribe.targets.c.frames import Frames
    from fieldscribe.targets.c.kinds import Placed
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.identifiers import Named


class OfFamily(Protocol):
    """The part `targets.c` of a family. Its template and its runtime have the family's name."""

    NAMED_CODES: tuple[str, ...]
    """The kinds of codes for which a function gives the name."""

    def bus_view(self, device: Device, placed: Sequence[Placed], scope: HeaderScope) -> Any:
        """The view of the header of frames, `<family>.h.j2`."""

    def sections(self, bus: Any) -> Mapping[str, Frames]:
        """The frames of points in that header, by the names of their texts in the template."""

    def identifiers(self, device: Device, bus: Any, scope: HeaderScope) -> Iterator[Named]:
        """Every identifier in that header, with its owner."""


def frames_of(device: Device) -> OfFamily:
    """The part `targets.c` of the device's family."""
    offered: OfFamily = family(device.family).part("targets.c")
    return offered
