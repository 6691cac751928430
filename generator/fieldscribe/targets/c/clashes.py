"""Whether two things get one identifier in the headers of a device."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.device import device_view, function_names
from fieldscribe.targets.c.modbus import modbus_view

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device
    from fieldscribe.targets.c.modbus import BusView
    from fieldscribe.targets.c.views import DeviceView

_HELPERS = (
    "status",
    "real",
    "rule",
    "signed",
    "signed32",
    "signed64",
    "divide",
    "divide_wide",
    "magnitude",
    "multiply",
    "add",
    "times_ten_to",
    "ratio",
    "apply_rule",
    "raw_from_count",
    "count_from_raw",
    "times",
    "times_wide",
    "round",
    "round_wide",
    "copy",
    "f32_of_bits",
    "bits_of_f32",
    "f64_of_bits",
    "bits_of_f64",
    "is_nan",
    "f32_order",
    "f64_order",
    "raw_from_value",
    "value_from_raw",
    "modbus_functions",
    "modbus_profile",
)
_MACROS = (
    "OK",
    "OUT_OF_RANGE",
    "NOT_A_NUMBER",
    "UNKNOWN_VALUE",
    "ZERO_FACTOR",
    "NO_CASE",
    "OVERFLOW",
    "NO_VALUE",
    "H",
    "MODBUS_H",
    "DESCRIPTION_VERSION",
    "DESCRIPTION_DIGEST",
)


def clashes(device: Device) -> Iterator[tuple[str, str, str]]:
    """Each identifier that two things would get, with what they are: the items of points, `enum x`, `the header`."""
    owners: dict[str, str] = {}
    for identifier, owner in _identifiers(device):
        first = owners.setdefault(identifier, owner)
        if first != owner:
            yield identifier, first, owner


def _identifiers(device: Device) -> Iterator[tuple[str, str]]:
    view, scope = device_view(device)
    names = [f"{view.prefix}_{name}" for name in _HELPERS] + [f"{view.upper}_{name}" for name in _MACROS]
    yield from ((name, "the header") for name in (*names, *(name for name, _ in view.spaces)))
    yield from _of_points(view)
    yield from ((alias, f"the old name of {name}") for alias, name in view.aliases)
    if device.family == "modbus":
        yield from _of_bus(modbus_view(device, view, scope), view.prefix)


def _of_bus(bus: BusView, prefix: str) -> Iterator[tuple[str, str]]:
    for blocks in bus.blocks:
        yield from ((name, f"the blocks of {blocks.name}") for name in (blocks.array, blocks.count_name))
    for command in bus.commands:
        names = (command.function, *(name for name, _ in command.defines))
        yield from ((name, f"command {command.function}") for name in names)
    yield from ((name, f"exception {title}") for name, _, title in bus.exceptions)
    for request in bus.requests:
        item = request.function[len(prefix) + 1 :]
        yield from ((f"{request.function}{tail}", item) for tail in ("_read_request", "_write_request"))


def _of_points(view: DeviceView) -> Iterator[tuple[str, str]]:
    for group in view.groups:
        for point, _ in group.entries:
            if point is None:
                continue
            if point.enum is not None:
                yield point.enum.function, f"enum {point.enum.function}"
                for name, _, _ in point.enum.entries:
                    yield name, f"enum {point.enum.function}"
            for name, _ in point.defines:
                yield name, point.item
            for name in function_names(point):
                yield name, point.item
