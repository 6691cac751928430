"""The conformance vectors of a device: what every language has to answer, computed from the model alone.

Nothing here is shared with the other targets: a wrong rule in one of them cannot repeat itself in its own test.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.vectors.can import CanWire, can
from fieldscribe.targets.vectors.characters import digits, text
from fieldscribe.targets.vectors.exchanges import Exchanges
from fieldscribe.targets.vectors.floats import floats
from fieldscribe.targets.vectors.limits import limits
from fieldscribe.targets.vectors.lines import Lines
from fieldscribe.targets.vectors.modbus import modbus, modbus_wires
from fieldscribe.targets.vectors.oracle import Oracle
from fieldscribe.targets.vectors.places import address, aliases, facts, words
from fieldscribe.targets.vectors.scaled import scaled
from fieldscribe.targets.vectors.shapes import Shapes
from fieldscribe.targets.vectors.uss import UssWire, uss
from fieldscribe.targets.vectors.whole import bits, fixed, flags, names, specials, whole

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from fieldscribe.model import Device, Point
    from fieldscribe.render import Render
    from fieldscribe.targets.identifiers import Names
    from fieldscribe.targets.vectors.exchanges import Wire

FOR_PEOPLE = False

_FAMILIES: Mapping[str, tuple[Callable[[Lines, Device], None], Callable[[Device], Sequence[Wire]]]] = {
    "modbus": (modbus, modbus_wires),
    "can": (can, lambda device: [CanWire(device)]),
    "uss": (uss, lambda device: [UssWire(device)]),
}
"""What each family adds for its frames, and the ways in which points travel in it."""


def outputs(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """The one file of this target: its path, and one vector per line. `render` is not needed."""
    del render
    yield f"vectors/{device.id}.txt", collect(device).text(device.id, device.version, device.digest)


def runtime(device: Device) -> Iterable[tuple[str, str]]:
    """No files are copied beside the vectors."""
    del device
    return ()


def identifiers(device: Device) -> Iterable[Names]:
    """Vectors have the names of the description, as they are."""
    del device
    return ()


def device_name_taken(name: str) -> str:
    """Every name will do for a file of vectors."""
    del name
    return ""


def collect(device: Device) -> Lines:
    """All vectors of a device: its points in the author's order, then its frames and blocks."""
    lines = Lines()
    shapes = Shapes()
    oracle = Oracle({point.name: point for point in reversed(device.points)})
    frames, wires = _FAMILIES[device.family]
    usual, *others = (Exchanges(lines, oracle, device, wire) for wire in wires(device))
    usual.open()
    for axis, choices in device.variants.items():
        lines.add("variant", axis, choices)
    limits(lines, device)
    for point in device.points:
        if point.generated:
            _point(lines, oracle, point, device.variants, deep=shapes.is_new(point))
            usual.of(point)
            lines.gather()
    for exchanges in others:
        exchanges.open()
        exchanges.of_each_space()
        lines.gather()
    for point in device.points:
        if point.raw_only and point.address is not None:
            lines.add("documented", point.item, point.places[0].space, point.address, point.words, point.index)
    if left_out := [point for point in device.points if not point.generated]:
        lines.add("left_out", tuple(one.item for one in left_out), tuple(one.code or "none" for one in left_out))
    frames(lines, device)
    return lines


def _point(lines: Lines, oracle: Oracle, point: Point, variants: Mapping[str, tuple[str, ...]], *, deep: bool) -> None:
    lines.set("point", point.item)
    address(lines, point)
    facts(lines, point, variants)
    aliases(lines, point)
    if point.form == "scaled":
        scaled(lines, oracle, point, deep=deep)
    elif point.form == "float":
        floats(lines, point, deep=deep)
    elif point.form == "text":
        text(lines, point)
    elif point.form == "digits":
        digits(lines, point)
    else:
        whole(lines, oracle, point, deep=deep)
    names(lines, point, deep=deep)
    specials(lines, point)
    flags(lines, point)
    fixed(lines, point)
    bits(lines, point)
    words(lines, point)
