"""All identifiers in the headers of a device."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families import FAMILIES
from fieldscribe.targets.c.device import STATUSES, device_view, function_names
from fieldscribe.targets.c.families import frames_of
from fieldscribe.targets.c.special_codes import FUNCTIONS
from fieldscribe.targets.identifiers import Identifier, Owner

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device
    from fieldscribe.targets.c.views import DeviceView

OWN = Owner("target", "what the header needs")

_TYPES = ("status", "real")
_MACROS = (
    "H",
    *(f"{name.upper()}_H" for name in FAMILIES),
    "DESCRIPTION_VERSION",
    "DESCRIPTION_DIGEST",
)


def identifiers(device: Device) -> Iterator[Identifier]:
    """All that the headers of a device define, in the one namespace of C."""
    view, scope = device_view(device, names_only=True)
    for name in _TYPES:
        yield Identifier("C", f"{view.prefix}_{name}", OWN)
    for name in (f"{view.upper}_{name}" for name in (*STATUSES, *_MACROS)):
        yield Identifier("C", name, OWN)
    for one in view.telegrams:
        yield from (Identifier("C", name, OWN) for name in (one.name, one.words_name))
    owners = {}
    for name, owner in _of_points(view):
        owners[name] = owner
        yield Identifier("C", name, owner)
    for alias in view.aliases:
        yield Identifier("C", alias.old, owners[alias.new]._replace(part=f"old name of {alias.new}"))
    frames = frames_of(device)
    bus = frames.bus_view(device, view, scope)
    yield from (Identifier("C", name, owner) for name, owner in frames.identifiers(bus, view))


def _of_points(view: DeviceView) -> Iterator[tuple[str, Owner]]:
    for group in view.groups:
        for point, remark in group.entries:
            yield from ((name, Owner("point", remark.item)) for name, _ in remark.defines)
            if point is None:
                continue
            if point.special is not None and point.special.codes is not None:
                codes = point.special.codes
                holder = Owner("target", f"the special codes `{codes.name}`")
                yield from ((codes.name + tail, holder) for tail in FUNCTIONS if codes.comment)
                yield from ((name, holder) for name, _ in codes.defines)
            if point.enum is not None:
                owner = Owner("enum", point.enum.function.removeprefix(f"{view.prefix}_").removesuffix("_name"))
                yield from ((name, owner) for name in (point.enum.function, point.enum.table))
                yield from ((name, Owner("enum", owner.name, name)) for name, _, _ in point.enum.entries)
            owner = Owner("point", point.item, "function")
            yield from ((name, Owner("point", point.item, f"constant {literal}")) for name, literal in point.defines)
            yield from ((name, owner) for name in function_names(point))
            yield from ((table.name.partition("[")[0], owner) for table in point.tables if "_ranges[" in table.name)
            if point.fields:
                yield f"{point.function}_with", Owner("point", point.item, "struct")
