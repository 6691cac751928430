"""All identifiers in the headers of a device."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.device import device_view, function_names
from fieldscribe.targets.c.families import FAMILIES
from fieldscribe.targets.c.special_codes import FUNCTIONS
from fieldscribe.targets.identifiers import Identifier, Owner

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device
    from fieldscribe.targets.c.views import DeviceView

OWN = Owner("target", "what the header needs")

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
    "value_from_wide",
    "modbus_functions",
    "modbus_profile",
    "split_f32",
    "twice_ratio",
    "shifted_ratio",
    "apply_shifted",
    "two_to",
    "quotient",
)
_MACROS = (
    "OK",
    "OUT_OF_RANGE",
    "NOT_A_NUMBER",
    "UNKNOWN_VALUE",
    "ZERO_FACTOR",
    "NO_CASE",
    "OVERFLOW",
    "SPECIAL",
    "H",
    "MODBUS_H",
    "CAN_H",
    "USS_H",
    "DESCRIPTION_VERSION",
    "DESCRIPTION_DIGEST",
    "MAY_FUSE",
)


def identifiers(device: Device) -> Iterator[Identifier]:
    """All that the headers of a device define, in the one namespace of C."""
    view, scope = device_view(device, names_only=True)
    for name in _HELPERS:
        yield Identifier("C", f"{view.prefix}_{name}", OWN)
    for name in (*(f"{view.upper}_{name}" for name in _MACROS), *(name for name, _ in view.spaces)):
        yield Identifier("C", name, OWN)
    for one in view.telegrams:
        yield from (Identifier("C", name, OWN) for name in (one.name, one.words_name))
    owners = {}
    for name, owner in _of_points(view):
        owners[name] = owner
        yield Identifier("C", name, owner)
    for alias in view.aliases:
        yield Identifier("C", alias.old, owners[alias.new]._replace(part=f"old name of {alias.new}"))
    family = FAMILIES[device.family]
    yield from (
        Identifier("C", name, owner) for name, owner in family.identifiers(family.view(device, view, scope), view)
    )


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
                yield point.enum.function, owner
                yield from ((name, Owner("enum", owner.name, name)) for name, _, _ in point.enum.entries)
            owner = Owner("point", point.item, "function")
            yield from ((name, Owner("point", point.item, f"constant {literal}")) for name, literal in point.defines)
            yield from ((name, owner) for name in function_names(point))
