"""What the index has of a device: its row in the list, and what a search sees of each point."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from fieldscribe.families import family
from fieldscribe.model import Device, Point
from fieldscribe.text import html_code, line
from fieldscribe.wording import label, title_text
from fieldscribe.wording.exact import hex_text

Row = tuple[str, str, str, str]
"""What a search sees of a place: its anchor, its title, its further words, and the heading above it."""


@dataclass(frozen=True, slots=True)
class DeviceView:
    """A row of the list of devices, in HTML."""

    href: str
    cells: tuple[str, ...]


def device_view(device: Device) -> DeviceView:
    """Return the row of a device in the list."""
    framings = ", ".join(device.bus.framings)
    generated = sum(point.generated for point in device.points)
    texts = (
        *(device.model, device.vendor, title_text(device.title)),
        *(f"{device.family}: {framings}" if framings else device.family, str(len(device.points))),
        *(str(generated), str(len(device.errata))),
    )
    return DeviceView(html_code(f"{device.id}.html"), tuple(html_code(line(text)) for text in texts))


def device_name(device: Device) -> str:
    """Return maker and model."""
    return line(f"{device.vendor} {device.model}")


def rows_of(device: Device) -> Iterator[Row]:
    """Yield what a search sees of the points of a device: names, codes, titles, addresses in all notations."""
    groups = {group.name: line(title_text(group.title)) for group in device.groups}
    for point in device.points:
        title = f"{label(point)}: {line(title_text(point.title))}"
        yield f"point={point.item}", title, " ".join(dict.fromkeys(_numbers(device, point))), groups[point.group]


def _numbers(device: Device, point: Point) -> Iterable[str]:
    """Yield the numbers under which manuals and tools know a point, and its old names."""
    yield from point.was
    if point.addresses:
        first = min(point.addresses)
        yield from (hex_text(first), str(first), f"0x{first:04X}")
        yield from map(str, family(device.family).numbers(point.space, first).values())
    yield from map(str, point.references.values())
