"""Finds the variants of a device and the one point that a user names. Raises UnclearError with a hint."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches

from fieldscribe import wording
from fieldscribe.conditions import absent
from fieldscribe.conversation.lookup import Match, advice, find
from fieldscribe.model import Device, Point
from fieldscribe.text import line, shortened
from fieldscribe.user_errors import UnclearError, did_you_mean
from fieldscribe.wording import label


def choose_variants(device: Device, chosen: Iterable[str]) -> Device:
    """Return the device with only the points of the chosen variants, each given as `axis=value`, and only their values.

    Points that a condition then excludes are kept, so that a question about them can name the condition (`absence`).
    """
    wanted: dict[str, str] = {}
    for axis, value in (_variant(device, choice) for choice in chosen):
        if wanted.setdefault(axis, value) != value:
            raise UnclearError(
                f"`{axis}` is given as `{wanted[axis]}` and as `{value}`", "choose one value of each axis"
            )
    if not wanted:
        return device
    points = tuple(point for point in device.points if _is_in(point, wanted))
    left = {axis: (wanted[axis],) if axis in wanted else values for axis, values in device.variants.items()}
    return replace(device, points=points, variants=left)


def absence(device: Device, point: Point) -> str:
    """Return why the chosen variants do not have a point; empty if they do, or may."""
    if not absent(point.when, device.variants):
        return ""
    return line(f"it exists only when {wording.condition_text(point.when, points_by_name(device))}")


def present(device: Device, points: Iterable[Point]) -> list[Point]:
    """Return the points that the chosen variants have or may have; all points if there is none."""
    candidates = list(points)
    return [point for point in candidates if not absent(point.when, device.variants)] or candidates


def choose_point(device: Device, text: str, *, index: int | None = None, any_variant: bool = False) -> Point:
    """Return the one point with this code, name or address. Raises UnclearError if there is none, or several.

    `index` chooses one element of an array. With `any_variant`, variants with the same meaning count as one point.
    """
    matches = find(device, text if index is None else f"{text}[{index}]")
    if index is not None and not matches:
        elements = dict.fromkeys(
            str(match.point.index) for match in find(device, text) if match.point.index is not None
        )
        raise UnclearError(
            f"`{shortened(text)}` has no element {index}", f"it has {', '.join(elements)}" if elements else ""
        )
    points = present(device, {match.point.item: match.point for match in matches}.values())
    if not points:
        raise UnclearError(f"{device.id} has no point `{shortened(text)}`", advice(device, text))
    if len(points) == 1 or (any_variant and all(same_meaning(point, points[0]) for point in points)):
        return points[0]
    raise _several(text, points, matches)


def _several(text: str, points: list[Point], matches: list[Match]) -> UnclearError:
    """Return the error for a text that names several points: variants, elements of an array, or different points."""
    if len({point.name for point in points}) == 1:
        variants = [f"--variant {point.variant}" for point in points if point.variant]
        return UnclearError(f"`{shortened(text)}` differs between variants", f"give {' or '.join(variants)}")
    if len({point.code for point in points}) == 1 and all(point.index is not None for point in points):
        in_one_set = len({point.index for point in points}) == len(points)
        names = (f"{line(point.code or text)}[{point.index}]" if in_one_set else point.item for point in points[:8])
        choices = " or ".join(f"`{name}`" for name in names)
        return UnclearError(f"`{shortened(text)}` has {len(points)} elements", f"write {choices}")
    if len({match.reading for match in matches}) == 1:
        choices = " or ".join(f"`{point.item}`" for point in points[:8])
        return UnclearError(f"`{shortened(text)}` means {len(points)} points", f"write {choices}")
    readings = ", ".join(f"{match.reading}: {label(match.point)}" for match in matches[:8])
    hint = "name one, or force one reading: wire:, modicon:, code:"
    return UnclearError(f"`{shortened(text)}` means several points: {readings}", hint)


def points_by_name(device: Device) -> Mapping[str, Point]:
    """Return the points by the names that rules and limits use; those of the last device are kept."""
    points, by_name = _named[0]
    if points is not device.points:
        by_name = {point.name: point for point in device.points}
        _named[0] = device.points, by_name  # both at once, for other threads
    return by_name


_named: list[tuple[Sequence[Point], Mapping[str, Point]]] = [((), {})]
"""The points of the last device, and the same by name."""


def same_meaning(first: Point, second: Point) -> bool:
    """Return True if two points differ only in their place or limits."""
    facts = [
        (point.name, point.shape.wire_type, point.bits, point.unit, point.scale, point.enum)
        for point in (first, second)
    ]
    return facts[0] == facts[1]


def _variant(device: Device, text: str) -> tuple[str, str]:
    axis, equals, value = text.partition("=")
    if not equals:
        raise UnclearError(f"`{shortened(text)}` is no variant", f"write --variant axis=value; {_axes(device)}")
    if axis not in device.variants:
        raise UnclearError(f"{device.id} has no variant axis `{shortened(axis)}`", _axes(device))
    values = device.variants[axis]
    if value not in values:
        near_values = get_close_matches(value, values, 1, 0.4) or list(values)
        raise UnclearError(f"`{axis}` has no value `{shortened(value)}`", did_you_mean(near_values))
    return axis, value


def _axes(device: Device) -> str:
    known = [f"{axis}={'|'.join(values)}" for axis, values in device.variants.items()]
    return f"{device.id} has {', '.join(map(line, known)) or 'no variants'}"


def _is_in(point: Point, wanted: Mapping[str, str]) -> bool:
    variant = point.variant
    return variant is None or wanted.get(variant.axis, variant.value) == variant.value
