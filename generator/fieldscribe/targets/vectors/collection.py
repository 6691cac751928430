"""All vectors of a device: its identity point by point, conversions and exchanges, then those of its family."""

from collections.abc import Hashable, Mapping, Sequence
from operator import attrgetter
from types import MappingProxyType

from fieldscribe.arithmetic.texts import epoch_in_unix
from fieldscribe.conditions import Condition
from fieldscribe.families import family
from fieldscribe.model import Bus, Device, Point, item_of
from fieldscribe.targets.vectors.decimals import digits, displayed
from fieldscribe.targets.vectors.exchanges import Exchanges, Wire
from fieldscribe.targets.vectors.floats import floats
from fieldscribe.targets.vectors.lines import Lines
from fieldscribe.targets.vectors.numbers import Memory, bits, fixed, flags, names, numbers, specials, words
from fieldscribe.targets.vectors.oracle import Oracle, outer_bounds
from fieldscribe.targets.vectors.samples import PointEncoding, PointEncodings
from fieldscribe.targets.vectors.texts import text
from fieldscribe.text import line


class OfFamily:
    """The interface of the part `targets.vectors` of a family, with its defaults."""

    KINDS: Mapping[str, str] = MappingProxyType({})
    """The kinds of vectors that only this family has, with the fields of their lines."""

    def limits(self, lines: Lines, bus: Bus) -> None:
        """Add the vectors of the constants of the bus."""

    def frames(self, lines: Lines, device: Device) -> None:
        """Add the vectors of the frames of a device."""

    def wires(self, lines: Lines, device: Device) -> Sequence[Wire]:
        """Return the ways in which points travel, the usual way first."""
        del lines, device
        return ()


class SharedVectors:
    """The shared vectors of one device, in two parts: those that depend on limits, and the others."""

    def __init__(self, lines: Lines, oracle: Oracle, encodings: PointEncodings) -> None:
        self._lines, self._oracle, self._encodings = lines, oracle, encodings
        self._conversions: Memory = {}
        self._within_limits: dict[PointEncoding, Lines] = {}
        self._near_limits: dict[Hashable, Lines] = {}

    def within_limits(self, encoding: PointEncoding) -> Lines:
        """Return conversions, checks and names; in depth for the first point that is computed in this way."""
        part = self._within_limits.get(encoding)
        if part is None:
            deep = self._encodings.is_new(encoding)
            part = self._lines.part()
            self._convert(part, encoding, deep=deep)
            if not deep:
                self._within_limits[encoding] = part
        return part

    def _convert(self, lines: Lines, encoding: PointEncoding, *, deep: bool) -> None:
        shape, oracle = encoding.shape, self._oracle
        if shape.form == "float":
            floats(lines, encoding, deep=deep)
        elif shape.form == "text":
            text(lines, shape)
        elif shape.form == "digits":
            digits(lines, shape)
        else:
            numbers(lines, oracle, encoding, self._conversions, deep=deep)
        if shape.display is not None:
            displayed(lines, oracle, encoding, deep=deep)
        names(lines, shape, deep=deep)

    def near_limits(self, encoding: PointEncoding) -> Lines:
        """Return what does not depend on limits: special codes, flags, groups of bits, words."""
        key = id(encoding.shape), encoding.bits, encoding.order
        part = self._near_limits.get(key)
        if part is None:
            part = self._near_limits[key] = self._lines.part()
            specials(part, encoding.shape)
            flags(part, encoding.shape)
            fixed(part, encoding.shape)
            bits(part, encoding)
            words(part, encoding)
        return part


def collect(device: Device) -> Lines:
    """Return all vectors of a device: its points by address, then its frames and blocks.

    The first of all points that are computed in the same way is tried in depth and with bad answers.
    """
    part: OfFamily = family(device.family).part("targets.vectors") or OfFamily()
    lines = Lines(part.KINDS)
    oracle = Oracle({point.name: point for point in reversed(device.points)})
    encodings = PointEncodings()
    shared = SharedVectors(lines, oracle, encodings)
    points = {point.item: point for point in sorted(device.points, key=attrgetter("rank")) if point.generated}
    exchanges = [Exchanges(lines, oracle, encodings, points, wire) for wire in part.wires(lines, device)]
    usual, others = exchanges[:1], exchanges[1:]
    for exchange in usual:
        exchange.wire.opens()
    for axis, choices in device.variants.items():
        lines.add("variant", axis, choices)
    _identifications(lines, device)
    lines.add_limits(first_unit=device.bus.units[0], last_unit=device.bus.units[1])
    part.limits(lines, device.bus)
    sizes = [("line", name, number) for name, number in device.bus.line_numbers.items()]
    for size in (*sizes, *(("words", telegram.name, telegram.words) for telegram in device.telegrams)):
        lines.add("size", *size)
    for point in points.values():
        encoding = encodings.of(point)
        identity(lines, point, device.variants)
        lines.include(shared.within_limits(encoding))
        lines.include(shared.near_limits(encoding))
        for exchange in usual:
            exchange.of(point, encoding)
    for exchange in others:
        exchange.wire.opens()
        exchange.of_each_space()
    for point in device.points:
        if point.raw_only and point.address is not None:
            lines.add("documented", point.item, point.space, point.address, point.words, point.index)
    if left_out := [point for point in device.points if not point.generated]:
        codes = tuple(point.code or "none" for point in left_out)
        lines.add("left_out", tuple(point.item for point in left_out), codes)
    part.frames(lines, device)
    return lines


def _identifications(lines: Lines, device: Device) -> None:
    """Add what identifies the device and its variants, each alternative alone."""
    for identification in device.identifications:
        variant = identification.variant
        name = "_".join(("identify", *(() if variant is None else (variant.axis, variant.value)), identification.point))
        axis = None if variant is None else {variant.axis: variant.value}
        held = [*((raw, None) for raw in identification.raws), *((None, line(words)) for words in identification.texts)]
        for number, alternative in enumerate(held, 1):
            lines.add(
                "identification",
                f"{name}_{number}" if len(held) > 1 else name,
                identification.point,
                *alternative,
                axis,
            )


_WITHOUT_LIMITS = ("float", "text", "digits")


def identity(lines: Lines, point: Point, variants: Mapping[str, tuple[str, ...]]) -> None:
    """Set the point for the vectors that follow, and add the vectors of its facts."""
    shape, terms, place = point.shape, point.terms, point.place
    lines.set("point", point.item)
    elsewhere = None if point.write_place is None else point.write_place.addresses
    if place.addresses:
        low, high = outer_bounds(shape, point.allowed) if shape.form not in _WITHOUT_LIMITS else (None, None)
        code = None if point.code is None else line(point.code)
        decimals = shape.decimals if shape.form == "scaled" else None
        references = {key: line(str(number)) for key, number in place.references.items()}
        lines.add(
            "address", terms.space, min(place.addresses), shape.words, code, low, high, decimals, references or None
        )
        if elsewhere is not None:
            lines.add("write_address", min(elsewhere))
        listed = shape.text is not None or place.is_scattered
        if point.index is not None or terms.telegram is not None or listed:
            lines.add("place", place.addresses, point.index, terms.telegram)
        if terms.unit.symbol:
            lines.add("symbol", terms.unit.symbol)
        if shape.display is not None:
            lines.add("display", shape.display)
        if shape.epoch:
            lines.add("epoch", epoch_in_unix(shape.epoch))
    only_for = None if terms.when is None else _only_for(terms.when, variants)
    decided_otherwise = terms.when is not None and {*terms.when.names} - {*(only_for or ())[:1]}
    lines.add(
        "facts",
        terms.group,
        point.name,
        shape.wire_type,
        None if shape.epoch else terms.unit.symbol or None,
        None if point.default is None else float(point.default),
        None if terms.changes == "always" else terms.changes,
        terms.changes_with or None,
        None if point.variant is None else str(point.variant),
        only_for,
        1 if decided_otherwise or point.since or point.until or point.to_end else None,
        terms.keeps,
        terms.conditions or None,
        *(() if elsewhere is None else (terms.space, elsewhere)),
    )
    for old in point.was:
        lines.add("alias", item_of(old, point.variant), point.item)


def _only_for(when: Condition, variants: Mapping[str, tuple[str, ...]]) -> tuple[str, ...] | None:
    """Return the axis that decides whether the point exists, followed by the values for which it can exist."""
    for axis in when.names:
        left = [value for value in variants.get(axis, ()) if _possible_for(when, axis, value)]
        if len(left) < len(variants.get(axis, ())):
            return (axis, *left)
    return None


def _possible_for(condition: Condition, axis: str, value: str) -> bool:
    """Return True if some clause of the condition can hold for this value of the axis."""
    return any(
        all(comparison.of != axis or comparison.holds(value) for comparison in clause) for clause in condition.clauses
    )
