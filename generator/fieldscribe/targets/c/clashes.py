"""Whether two things get one identifier in the headers of a device."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.device import device_view, function_names
from fieldscribe.targets.c.families import FAMILIES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device
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
    "quotient",
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
    "split_f32",
    "twice_ratio",
    "shifted_ratio",
    "apply_shifted",
    "two_to",
)
_MACROS = (
    "OK",
    "OUT_OF_RANGE",
    "MAY_FUSE",
    "NOT_A_NUMBER",
    "UNKNOWN_VALUE",
    "ZERO_FACTOR",
    "NO_CASE",
    "OVERFLOW",
    "NO_VALUE",
    "H",
    "MODBUS_H",
    "CAN_H",
    "USS_H",
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
    for one in view.telegrams:
        yield from ((name, "the telegrams") for name in (one.name, one.words_name))
    yield from _of_points(view)
    yield from ((alias, f"the old name of {name}") for alias, name in view.aliases)
    family = FAMILIES[device.family]
    yield from family.identifiers(family.view(device, view, scope), view)


def _of_points(view: DeviceView) -> Iterator[tuple[str, str]]:
    for group in view.groups:
        for point, remark in group.entries:
            yield from ((name, remark.item) for name, _ in remark.defines)
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
