"""Finds the variants of a device, the bases of its addresses, and the one point that a user names.

Raises UnclearError with a hint.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches

from fieldscribe import wording
from fieldscribe.conditions import absent
from fieldscribe.conversation.lookup import Match, advice, find
from fieldscribe.diagnostics import UnclearError, did_you_mean, either
from fieldscribe.language.numbers import NumberError, parse_integer
from fieldscribe.model import Base, Device, Place, Point, SteppedCommand, Terms
from fieldscribe.text import line, shortened
from fieldscribe.wording import label


def choose_variants(device: Device, chosen: Iterable[str]) -> Device:
    """Return the device with only the points and values of the chosen variants, each given as `axis=value`.

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
    left_out = tuple(point for point in device.points if not _is_in(point, wanted))
    left = {axis: (wanted[axis],) if axis in wanted else values for axis, values in device.variants.items()}
    return replace(device, points=points, variants=left, left_out=(*device.left_out, *left_out))


def absence(device: Device, point: Point) -> str:
    """Return why the chosen variants do not have a point; empty if they do, or may."""
    if not absent(point.when, device.variants):
        return ""
    return line(f"it exists only when {wording.condition_text(point.when, points_by_name(device))}")


def present(device: Device, points: Iterable[Point]) -> list[Point]:
    """Return the points that the chosen variants have or may have; all points if there are none."""
    candidates = list(points)
    return [point for point in candidates if not absent(point.when, device.variants)] or candidates


def choose_point(
    device: Device, text: str, *, index: int | None = None, any_variant: bool = False, groups: Collection[str] = ()
) -> Point:
    """Return the one point with this code, name or address. Raises UnclearError if there is none, or several.

    `index` chooses one element of an array. With `any_variant`, variants with the same meaning count as one point.
    The error also mentions `groups` that could be named instead.
    """
    if not text.strip():
        raise UnclearError("no point is named", "give its code, name or address")
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
        names = [(point.variant, (point.item, point.name, point.code)) for point in device.left_out]
        others = [variant for variant, named in names if text in named]
        if others:
            hint = f"it is there with {either([f'--variant {variant}' for variant in others])}"
            raise UnclearError(f"{device.id} has `{shortened(text)}` only in another variant", hint)
        what, near = "point or group" if groups else "point", get_close_matches(text, groups, 1)
        raise UnclearError(f"{device.id} has no {what} `{shortened(text)}`", did_you_mean(near) or advice(device, text))
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
    """Return the points by their names in rules and limits; the result for the last device is kept."""
    points, by_name = _named[0]
    if points is not device.points:
        by_name = {point.name: point for point in device.points}
        _named[0] = device.points, by_name  # both at once, because of other threads
    return by_name


_named: list[tuple[Sequence[Point], Mapping[str, Point]]] = [((), {})]
"""The points of the last device, and its points by name."""


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


_LAST = 65535


def at_bases(device: Device, pairs: Sequence[str]) -> tuple[Device, list[str]]:
    """Return the device with the points of known bases at their addresses, and the pairs about other things.

    A pair is `slot=3`, a given number, or `models_103=40070`, the address of a block. Raises UnclearError.
    """
    ranges = {each.name: (each.low, each.high) for each in device.given}
    ranges |= {base.name: (0, _LAST) for base in device.bases if base.block is not None}
    numbers: dict[str, int] = {}
    others = []
    for pair in pairs:
        name, equals, text = (part.strip() for part in pair.partition("="))
        if name not in ranges or not equals:
            others.append(pair)
            continue
        try:
            numbers[name] = parse_integer(text)
        except NumberError as error:
            raise UnclearError(f"{name}: {error.message}", error.hint) from error
        low, high = ranges[name]
        if not low <= numbers[name] <= high:
            raise UnclearError(f"{name} is {low}..{high}, not {shortened(text)}", "")
    starts = {base.name: base.at(numbers) for base in device.bases if numbers.keys() >= set(base.wanted)}
    return moved(device, starts, {}) if starts else device, others


def moved(device: Device, starts: Mapping[str, int], lasts: Mapping[str, int]) -> Device:
    """Return the device with the points of these bases at their addresses; without those after the last of a block."""
    terms: dict[int, Terms] = {}
    points = []
    for point in device.points:
        base = point.base or ""
        here = _moved(point, starts[base], terms) if base in starts else point
        if base not in lasts or max(here.addresses, default=0) <= lasts[base]:
            points.append(here)
    stepped = tuple([_of_steps(command, starts) for command in device.stepped_commands])
    left = tuple(base for base in device.bases if base.name not in starts)
    return replace(device, points=tuple(points), stepped_commands=stepped, bases=left)


def base_options(bases: Iterable[Base]) -> str:
    """Return the options that give these bases."""
    names = dict.fromkeys(name for base in bases for name in base.wanted)
    return " ".join(f"--with {name}=NUMBER" for name in names)


def _of_steps(command: SteppedCommand, starts: Mapping[str, int]) -> SteppedCommand:
    """Return the command with the steps of known bases at their addresses."""
    moved = [
        replace(step, address=starts[step.base] + step.address, base=None)
        if step.base and step.base in starts
        else step
        for step in command.steps
    ]
    return replace(command, steps=tuple(moved))


def _moved(point: Point, start: int, known: dict[int, Terms]) -> Point:
    terms = known.get(id(point.terms)) or known.setdefault(id(point.terms), replace(point.terms, base=None))
    place = Place(tuple([start + address for address in point.addresses]), point.place.references)
    written = point.write_place
    if written is not None:
        written = Place(tuple([start + address for address in written.addresses]), written.references)
    return replace(point, place=place, write_place=written, terms=terms)
