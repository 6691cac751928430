"""The encoding of a point, and the raw numbers and settings with which its vectors are made.

Points with the same encoding share their vectors. The first of all points that are computed in the same way is tried in
depth, the others only with their limits.
"""

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import gcd, inf, nan

from fieldscribe.model import Allowed, Bound, Factor, Interval, Limit, Point, Shape
from fieldscribe.targets.vectors.oracle import Oracle, Ratio, as_raw, bits_of, outer_bounds

MANY = 3
"""The number of intervals of a list that are tried for every point."""


@dataclass(frozen=True, slots=True, eq=False)
class PointEncoding:
    """How raw numbers and words of a point are encoded: everything on which its vectors depend, except its identity.

    `bits` are those of a group in its word. `order` has the words in ascending order of address, 0 for the high one; it
    is None if the address is unknown. `symbol` is that of the unit where texts for people have it.
    """

    shape: Shape
    allowed: Allowed
    bits: tuple[int, int] | None
    order: tuple[int, ...] | None
    symbol: str

    @property
    def arguments(self) -> tuple[str, ...]:
        """The points whose raw numbers encoding, decoding or checking needs, in a fixed order."""
        scale, limits = self.shape.scale_arguments, self.allowed.arguments
        return tuple(dict.fromkeys((*scale, *limits))) if scale or limits else ()

    def with_fixed(self, raw: int) -> int:
        """Return a raw number with the constant bits set; unchanged if the type cannot hold it."""
        shape, fixed = self.shape, self.shape.fixed
        if fixed is None or self.bits is not None or not shape.least <= raw <= shape.greatest:
            return raw
        return as_raw(shape, raw & ~fixed.mask | fixed.bits)


class PointEncodings:
    """The encodings of the points so far, each once."""

    def __init__(self) -> None:
        self._known: dict[Hashable, PointEncoding] = {}
        self._shapes: dict[int, int] = {}
        self._facts: dict[Hashable, int] = {}
        self._computed: set[Hashable] = set()

    def of(self, point: Point) -> PointEncoding:
        """Return the encoding of a point. Its shape and its limits are compared as objects, which is quick."""
        shape, terms, addresses = point.shape, point.terms, point.place.addresses
        order = ascending(shape, addresses) if addresses else None
        symbol = terms.unit.symbol if shape.display is not None else ""
        key = id(shape), id(point.allowed), terms.bits, order, symbol
        encoding = self._known.get(key)
        if encoding is None:
            encoding = self._known[key] = PointEncoding(shape, point.allowed, terms.bits, order, symbol)
        return encoding

    def is_new(self, encoding: PointEncoding) -> bool:
        """Return True for the first encoding that is computed in this way."""
        shape = encoding.shape
        if id(shape) not in self._shapes:
            self._shapes[id(shape)] = self._facts.setdefault(_facts(shape), len(self._facts))
        computed = self._shapes[id(shape)], _limits(encoding.allowed.intervals), len(encoding.allowed.units)
        new = computed not in self._computed
        self._computed.add(computed)
        return new


def ascending(shape: Shape, addresses: tuple[int, ...]) -> tuple[int, ...]:
    """Return the words of a number in ascending order of address; of those at one address, the high one first."""
    if len(addresses) == 1 and (shape.text is not None or shape.words == 1):
        return _ONE
    count = shape.words if shape.text is None else len(addresses)
    if len(addresses) != count:
        return tuple(range(count))
    return tuple(sorted(range(count), key=addresses.__getitem__))


_ONE = (0,)


def _facts(shape: Shape) -> Hashable:
    """Return the facts that decide how a point is computed, except its limits: type, scale, special codes."""
    specials = tuple((special.low, special.high, special.writable, special.no_value) for special in shape.specials)
    kind = shape.type, shape.width, shape.access, shape.fixed, shape.encodes_values, shape.decimals, shape.most_raw
    enum = shape.named_numbers
    entries = enum and tuple([(entry.raw, entry.name) for entry in enum.entries])
    return (*kind, shape.display, shape.scale, specials, entries, bool(shape.flags))


def _limits(intervals: tuple[Interval, ...]) -> Hashable:
    """Return the forms of the limits; for a long list, its numbers too."""
    if len(intervals) > MANY:
        return intervals
    return tuple([(_form(interval.low), _form(interval.high)) for interval in intervals])


def _form(bound: Bound) -> Hashable:
    return bound if isinstance(bound, Limit) else bound < 0


Limits = Sequence[tuple[int, int]]

_FACTORS = (50.0, 60.0, 1.0, 0.1, -100.0, 650.168, 0.0, -0.0, inf, nan)
"""Numbers for a floating-point factor, the typical one first."""


def edges(limits: Limits) -> dict[int, None]:
    """Return each limit and the number beyond it, so that every gap in a list is tried."""
    return dict.fromkeys(raw for low, high in limits for raw in (low, high, low - 1, high + 1))


def limits_to_try(limits: Limits) -> Limits:
    """Return the limits that are tried for each point of a shape: all if there are few, else the ends of the list."""
    return limits if len(limits) <= MANY else (limits[0], limits[-1])


def raws_to_decode(encoding: PointEncoding, limits: Limits, *, deep: bool) -> Iterable[int]:
    """Return raw numbers to decode: limits; if `deep`, also special codes, the ends of the type and around the sign."""
    shape = encoding.shape
    ends = (raw for interval in limits for raw in interval) if deep else (limits[0][0], limits[-1][1])
    more = (*codes(shape), shape.least, shape.greatest, -1, 0) if deep else ()
    return _named(encoding, _held(shape, (*ends, *more)), deep=deep)


def raws_to_check(encoding: PointEncoding, limits: Limits, *, deep: bool) -> Iterable[int]:
    """Return raw numbers to check: limits and one beyond; if `deep`, also special codes and the ends of the type."""
    shape = encoding.shape
    ends = edges(limits) if deep else (*edges(limits_to_try(limits)), *(raw for ends in limits for raw in ends))
    more = (*codes(shape), shape.least, shape.greatest) if deep else ()
    return _named(encoding, _held(shape, (*ends, *more)), deep=deep)


def _named(encoding: PointEncoding, raws: list[int], *, deep: bool) -> list[int]:
    """Return raw numbers, also with the constant bits set, numbers of the enum (if deep, all), and each flag alone."""
    shape = encoding.shape
    fixed = () if shape.fixed is None else map(encoding.with_fixed, raws)
    entries = () if shape.enum is None else shape.enum.entries if deep else shape.enum.entries[-1:]
    flags = (as_raw(shape, (1 << flag.width) - 1 << flag.low) for flag in shape.flags)
    return [*raws, *fixed, *(entry.raw for entry in entries), *flags]


def codes(shape: Shape) -> list[int]:
    """Return the ends of the special codes and one beyond each, as far as the bits hold them."""
    return _held(
        shape,
        [raw for special in shape.specials for raw in (special.low, special.high, special.low - 1, special.high + 1)],
    )


def _held(shape: Shape, numbers: Iterable[int]) -> list[int]:
    least, greatest = shape.least, shape.greatest
    return [raw for raw in numbers if least <= raw <= greatest]


@lru_cache(maxsize=4096)
def _half_step(ratio: Ratio) -> tuple[int, int] | None:
    """Return (residue, modulus) of the raw numbers r whose r + 1/2 has a binary fraction as value; None if none has."""
    # The value is ((2r + 1) * under - 2 * over) * den / (2 * num * under): the odd part of the denominator must vanish.
    odd = abs(ratio.num) * ratio.under
    odd //= odd & -odd
    odd //= gcd(odd, ratio.den)
    slope, start = 2 * ratio.under, ratio.under - 2 * ratio.over
    common = gcd(slope, odd)
    if start % common:
        return None
    modulus = odd // common
    return (-start // common * pow(slope // common, -1, modulus) % modulus if modulus > 1 else 0), modulus


def halves(ratio: Ratio, limits: Limits) -> list[float]:
    """Return binary64 values exactly between two raw numbers: the lowest and highest in the limits, and one below 0."""
    step = _half_step(ratio)
    if step is None:
        return []
    residue, modulus = step
    low, high = limits[0][0], limits[-1][1]
    first = low + (residue - low) % modulus
    last = high - 1 - (high - 1 - residue) % modulus
    values: dict[float, None] = {}
    for raw in (first, last, -1 - (-1 - residue) % modulus):
        if low <= raw < high:
            over = ((2 * raw + 1) * ratio.under - 2 * ratio.over) * (ratio.den if ratio.num > 0 else -ratio.den)
            under = 2 * ratio.denominator
            value = over / under
            above, below = value.as_integer_ratio()
            if above * under == over * below:
                values[value] = None
    return list(values)


def raws_telling_division(shape: Shape, ratio: Ratio) -> list[int]:
    """Return the lowest raw number, if any, that reveals a multiplication by the reciprocal instead of a division."""
    raw = _raw_telling_division(ratio)
    return [] if raw is None else _held(shape, (raw,))


@lru_cache(maxsize=4096)
def _raw_telling_division(ratio: Ratio) -> int | None:
    under = ratio.denominator
    numerators = ((raw, ratio.numerator(raw)) for raw in range(1, 200))
    return next((raw for raw, over in numerators if over * (1 / under) != over / under), None)


def settings(oracle: Oracle, encoding: PointEncoding, *, deep: bool = True) -> list[dict[str, int]]:
    """Return settings of all arguments: a typical one, then each argument in turn at all its interesting raw numbers.

    Without arguments there is one setting, which is empty. Unless `deep`, each argument has only one other number,
    which reveals exchanged arguments, and each case occurs once.
    """
    names = encoding.arguments
    if not names:
        return [{}]
    base = {name: _typical(oracle, encoding, name) for name in names}
    if not deep:
        cases = [(case.point, case.raw) for case in encoding.shape.scale or () if case.point is not None]
        last = [(name, raw) for name in names for raw in _choices(oracle, encoding, name)[-2:] if raw != base[name]]
        others = dict(last).items()
        return [base, *({**base, name: raw} for name, raw in dict.fromkeys((*cases, *others)) if raw is not None)]
    chosen = [base, *({**base, name: raw} for name in names for raw in _choices(oracle, encoding, name))]
    # each case with all choices of its factors, not only those of the first case
    for case in encoding.shape.scale or ():
        if case.point is not None and case.raw is not None:
            for factor in case.rule.factors:
                raws = _choices(oracle, encoding, factor.point)
                chosen += [{**base, case.point: case.raw, factor.point: raw} for raw in raws]
    return list({tuple(setting.items()): setting for setting in chosen}.values())


def _typical(oracle: Oracle, encoding: PointEncoding, name: str) -> int:
    for case in encoding.shape.scale or ():
        if case.point == name and case.raw is not None:
            return case.raw
    if (source := oracle.points.get(name)) is not None and source.shape.info.floating:
        return bits_of(_FACTORS[0], 32)
    low, high = _bounds(oracle, name)
    middle = low + (high - low) // 3
    return middle or min(high, 1)


def _choices(oracle: Oracle, encoding: PointEncoding, name: str) -> list[int]:
    """Return raw numbers to try for an argument: ends, cases, zeros of factors, codes that lift limits."""
    bands = [
        band
        for limit in limits_of(encoding.allowed)
        for other, codes in limit.unless
        if other == name
        for band in codes[:4]
    ]
    lifting = [code for low, high in bands for code in (low, high, high + 1)]
    source = oracle.points.get(name)
    lifting += [] if source is None else [special.low for special in source.shape.specials[:4]]
    if source is not None and source.shape.info.floating:
        patterns = (bits_of(number, 32) for number in _FACTORS)
        return [raw for raw in dict.fromkeys((*patterns, *lifting)) if raw <= source.shape.greatest]
    low, high = _bounds(oracle, name)
    cases = [case.raw for case in encoding.shape.scale or () if case.point == name and case.raw is not None]
    raws = [*cases, max(cases) + 1] if cases else [low, high]
    for factor in _factors(encoding):
        if factor.point != name:
            continue
        if factor.ten_to or factor.within is not None:
            raws += [low - 1, high + 1]
        if not factor.ten_to:
            if factor.within is not None and source is not None:
                raws += [source.shape.least, source.shape.greatest]
            raws += [-factor.intercept // factor.slope] if factor.slope and factor.intercept % factor.slope == 0 else []
    raws += lifting
    if source is not None and any(
        factor.point == name for limit in limits_of(encoding.allowed) for factor in limit.rule.factors
    ):
        raws.append(max(source.shape.least, 0) + 1)  # a computed limit beyond the outermost one
    return [raw for raw in dict.fromkeys(raws) if source is None or source.shape.least <= raw <= source.shape.greatest]


def _factors(encoding: PointEncoding) -> list[Factor]:
    """Return all factors of the scale and the limits."""
    rules = [case.rule for case in encoding.shape.scale or ()] + [limit.rule for limit in limits_of(encoding.allowed)]
    return [factor for rule in rules for factor in rule.factors]


def limits_of(allowed: Allowed) -> list[Limit]:
    """Return the limits that depend on other points."""
    return [
        bound for interval in allowed.intervals for bound in (interval.low, interval.high) if isinstance(bound, Limit)
    ]


def _bounds(oracle: Oracle, name: str) -> tuple[int, int]:
    source = oracle.points.get(name)
    return (1, 1) if source is None else outer_bounds(source.shape, source.allowed)
