"""What the index has of a device: its row in the list, and what a search sees of each point."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from fieldscribe.families import family
from fieldscribe.model import Device, Point
from fieldscribe.text import html, line
from fieldscribe.wording import address_text, label, title_text

Row = tuple[str, str, str]
"""What a search sees of a place: its anchor, its title, and its further words."""


@dataclass(frozen=True, slots=True)
class DeviceView:
    """A row of the list of devices."""

    href: str
    name: str
    title: str
    bus: str
    points: str
    errata: str


def device_view(device: Device) -> DeviceView:
    """Return the row of a device in the list, for HTML."""
    generated = sum(point.generated for point in device.points)
    framings = ", ".join(device.bus.framings)
    return DeviceView(
        html(f"{device.id}.html"),
        html(device_name(device)),
        html(line(title_text(device.title))),
        html(f"{device.family}: {framings}" if framings else device.family),
        html(f"{len(device.points)}, {generated} of them in code"),
        html(str(len(device.errata))),
    )


def device_name(device: Device) -> str:
    """Return maker and model."""
    return line(f"{device.vendor} {device.model}")


def rows_of(device: Device) -> Iterator[Row]:
    """Yield what a search sees of the points of a device: names, codes, titles, addresses in all notations."""
    for point in device.points:
        title = f"{label(point)}: {line(title_text(point.title))}"
        yield f"point={point.item}", title, " ".join(dict.fromkeys(_numbers(device, point)))


def _numbers(device: Device, point: Point) -> Iterable[str]:
    """Yield the numbers under which manuals and tools know a point, and its old names."""
    yield from point.was
    if point.addresses:
        first = min(point.addresses)
        yield f"{address_text(first)} 0x{first:04X}"
        yield from map(str, family(device.family).numbers(point.space, first).values())
    yield from map(str, point.references.values())
