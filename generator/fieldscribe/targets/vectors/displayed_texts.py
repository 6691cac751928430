"""Vectors of what people see of values: with the decimals that `display` says, computed from the model alone."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.numbers import bits32, bits64, float_of_bits, half_away
from fieldscribe.targets.vectors.oracle import INT64, Oracle, Ratio, code_of, outer_bounds

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Shape
    from fieldscribe.targets.vectors.computations import Computation
    from fieldscribe.targets.vectors.lines import Lines

_NEAR = range(-400, 401)
"""Where halves of the last decimal are looked for."""

_NO_NUMBERS = {32: (0x7F80_0000, 0xFF80_0000, 0x7FC0_0000), 64: (0x7FF0 << 48, 0xFFF0 << 48, 0x7FF8 << 48)}
"""Patterns of infinities and of what is no number."""


def shown(lines: Lines, oracle: Oracle, computation: Computation, *, deep: bool) -> None:
    """Add vectors of the displayed texts of a point that has `display`."""
    shape = computation.shape
    if shape.display is None:
        return
    for settings in samples.settings(oracle, computation, deep=deep):
        if settings:
            lines.set("with", settings)
        if shape.info.floating:
            _told(lines, computation, ((raw, *_of_float(shape, raw)) for raw in _patterns(shape)))
            continue
        ratio = oracle.ratio(shape, settings) if shape.scale else Ratio(1, 1, 0, 1)
        raws = [0, 1] if isinstance(ratio, str) else _raws(computation, ratio, deep=deep)
        _told(lines, computation, ((raw, *_of_number(shape, ratio, raw)) for raw in raws))


def _told(lines: Lines, computation: Computation, rows: Iterable[tuple[int, str, str]]) -> None:
    """Add a line for each raw number: status and text; a special code shows its name."""
    unit = f" {computation.symbol}" if computation.symbol else ""
    for raw, status, text in rows:
        code = code_of(computation.shape, raw)
        told = f"{text}{unit}" if code is None else code.name
        lines.add("told", raw, "ok" if code is not None else status, told if code is not None or text else None)


def _raws(computation: Computation, ratio: Ratio, *, deep: bool) -> list[int]:
    """The limits of what may be written; in depth the ends of the type, small numbers, halves and special codes too."""
    shape = computation.shape
    found = [*outer_bounds(shape, computation.allowed), 1]
    if deep:
        found += [0, -1, 5, shape.least, shape.greatest, shape.greatest - 1]
        found += [*_halves(shape, ratio), *samples.codes(shape)]
    return [raw for raw in dict.fromkeys(found) if shape.least <= raw <= shape.greatest]


def _halves(shape: Shape, ratio: Ratio) -> Iterator[int]:
    """The raw numbers next to zero whose value lies in the middle of two texts, above and below zero."""
    power, under = 10 ** (shape.display or 0), ratio.denominator
    middle = [raw for raw in _NEAR if 2 * ratio.numerator(raw) * power % (2 * under) == under]
    yield from [raw for raw in middle if ratio.numerator(raw) > 0][:2]
    yield from [raw for raw in middle if ratio.numerator(raw) < 0][-2:]


def _of_number(shape: Shape, ratio: Ratio | str, raw: int) -> tuple[str, str]:
    """The status of a raw number, and its text if there is one."""
    if isinstance(ratio, str):
        return ratio, ""
    count = half_away(ratio.numerator(raw) * 10 ** (shape.display or 0), ratio.denominator)
    beyond = not -INT64 <= count < INT64 or (shape.most_raw is not None and abs(raw) > shape.most_raw)
    return ("overflow", "") if shape.scale_arguments and beyond else ("ok", _decimal(count, shape.display or 0))


def _patterns(shape: Shape) -> Iterator[int]:
    """Patterns of numbers: halves of the last decimal, what rounds to zero, the largest, and what is none."""
    half = 0.5 ** ((shape.display or 0) + 1)
    numbers = (0.0, -0.0, 1.0, 0.1, half, -half, 3 * half, half / 2, -half / 2, 1.5e9, -12345678.0, 3e38)
    for number in numbers:
        pattern = bits64(number) if shape.width == 64 else bits32(number)
        if pattern is not None:
            yield pattern
    yield from _NO_NUMBERS[shape.width]


def _of_float(shape: Shape, raw: int) -> tuple[str, str]:
    number = float_of_bits(raw, shape.width)
    if not isfinite(number):
        return "ok", str(number)
    over, under = number.as_integer_ratio()
    decimals = shape.display or 0
    return "ok", _decimal(half_away(over * 10**decimals, under), decimals)


def _decimal(count: int, decimals: int) -> str:
    """A count of 10^-decimals units, digit by digit; one that is zero has no sign."""
    whole, part = divmod(abs(count), 10**decimals)
    point = f".{part:0{decimals}d}" if decimals else ""
    return f"{'-' if count < 0 else ''}{whole}{point}"
