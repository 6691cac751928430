"""Limits that are computed from other points, in compiled C, held against numbers that were worked out by hand."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

import pytest
from fieldscribe.model import Bound, Device, Limit, Linear
from fieldscribe.targets.c.limits import limit
from fieldscribe.targets.c.scope import scope_of
from support.c_device import write_headers
from support.models import allowed, device_of, linear, point, value_of
from support.toolchains import compiled, run

OTHERS = (
    point("exponent", 0, "s8", allowed=allowed((-2, 4))),
    point("divisor", 1, "s16", allowed=allowed((-20, 20))),
    point("factor", 2),
    point("small", 3, "u8"),
    point("gain", 4, "f32"),
    point("coded", 6),
    point("big", 8, "u32"),
    point("big_too", 10, "u32"),
)
F32_2, F32_0_4, F32_0 = 0x40000000, 0x3ECCCCCD, 0


class Limited(NamedTuple):
    """A point whose upper limit (or lower one, if `low`) a rule gives, within `outermost`.

    `ends` are the last numbers that may be written, by the raw numbers of the points that the rule needs; None where a
    divisor is zero.
    """

    type: str
    rule: Linear
    outermost: tuple[int, int]
    ends: dict[tuple[int, ...], int | None]
    unless: tuple[tuple[str, tuple[tuple[int, int], ...]], ...] = ()
    low: bool = False


CODES = (("coded", ((0, 3), (9, 12), (20, 20), (65530, 65535))),)
POINTS = {
    "tens": Limited(
        "u16", linear(3, 0, value_of("exponent", ten_to=True)), (0, 60000), {(2,): 300, (0,): 3, (4,): 30000, (-1,): 0}
    ),
    "shares": Limited(
        "s16",
        linear(1000, 0, value_of("divisor", -1)),
        (-500, 500),
        {(-4,): -250, (3,): 333, (6,): 167, (16,): 63, (1,): 500, (0,): None},
    ),
    "gained": Limited(
        "u16", linear(2500, 0, value_of("gain", -1)), (0, 60000), {(F32_2,): 1250, (F32_0_4,): 6250, (F32_0,): None}
    ),
    "thirds": Limited(
        "u16",
        linear("1/3", "1/2", value_of("factor")),
        (0, 20000),
        {(10,): 4, (12,): 5, (0,): 1, (58498,): 19500, (65535,): 20000},  # 12 / 3 + 1/2 is a half, which goes up
    ),
    "just_inside": Limited("u16", linear("1/3", 0, value_of("small")), (0, 85), {(255,): 85, (254,): 85, (253,): 84}),
    "falling": Limited(
        "s16",
        linear(-2, 5, value_of("small")),
        (-300, 30000),
        {(0,): 5, (10,): -15, (152,): -299, (153,): -300, (255,): -300},
        low=True,
    ),
    "sheared": Limited(
        "s16",
        linear(1, -3, value_of("divisor", slope=2, intercept=1)),
        (-30, 30),
        {(0,): -2, (-14,): -30, (-13,): -28, (5,): 8, (10,): 18},
        low=True,
    ),
    "lifted": Limited(
        "u16",
        linear(2, 0, value_of("coded")),
        (0, 900),
        {
            (4,): 8,
            (8,): 16,
            (13,): 26,
            (19,): 38,
            (21,): 42,
            (449,): 898,
            (65529,): 900,
            (0,): 900,
            (3,): 900,
            (9,): 900,
            (12,): 900,
            (20,): 900,
            (65530,): 900,
            (65535,): 900,
        },
        CODES,
    ),
    "product": Limited(
        "u32",
        linear(1, 0, value_of("big"), value_of("big_too")),
        (0, 4_000_000_000),
        {(7, 3): 21, (70_000, 70_000): 4_000_000_000, (0, 4_294_967_295): 0, (65536, 61035): 3_999_989_760},
    ),
    "quotient": Limited(
        "u32",
        linear("1000000007/3", 1, value_of("big"), value_of("big_too", -1)),
        (0, 4_000_000_000),
        {(7, 3): 777_777_784, (4_294_967_295, 1): 4_000_000_000, (1, 4_294_967_295): 1, (1, 0): None},
    ),
}

PROGRAM = """
#include <stdio.h>
#include "limits.h"
#define HOLDS(call, status) \\
    if ((call) != (status)) { printf("%s is no %s\\n", #call, #status); }
int main(void)
{
@TRIES@
    return 0;
}
"""


def device() -> Device:
    """The points that give limits, and those that have them."""
    limited = []
    for at, (name, one) in enumerate(POINTS.items()):
        low, high = one.outermost
        bound = Limit(one.rule, one.unless, low, high)
        ends: tuple[Bound, Bound] = (bound, high) if one.low else (low, bound)
        limited.append(point(name, 100 + 2 * at, one.type, allowed=allowed(ends)))
    return device_of("limits", (*OTHERS, *limited))


def tries(made: Device) -> Iterator[str]:
    """The last number inside may be written, the next one not; none at all where a divisor is zero."""
    known = {each.name: each for each in made.points}
    for name, one in POINTS.items():
        given = known[name].limit_arguments
        struct = f"limits_with_{'_and_'.join(given)}"
        for raws, end in one.ends.items():
            values = ", ".join(f"{raw}U" if raw > 0x7FFF else str(raw) for raw in raws)
            others = values if len(given) == 1 else f"(&(const {struct}){{{values}}})"
            if end is None:
                yield f"HOLDS(limits_{name}_check({max(one.outermost)}, {others}), FIELDSCRIBE_ZERO_FACTOR)"
                continue
            for raw, status in ((end, "OK"), (end - 1 if one.low else end + 1, "OUT_OF_RANGE")):
                number = f"{raw}U" if raw > 0x7FFF else str(raw)
                yield f"HOLDS(limits_{name}_check({number}, {others}), FIELDSCRIBE_{status})"


def test_limits_are_those_worked_out_by_hand(tmp_path: Path) -> None:
    folder = write_headers(device(), tmp_path)
    (tmp_path / "limits.c").write_text(PROGRAM.replace("@TRIES@", "\n".join(tries(device()))), "utf-8")
    flags = ("-std=c99", "-ftrapv", f"-I{folder / 'c'}")
    program = compiled("gcc", flags, tmp_path / "limits.c", tmp_path / "limits")
    assert run([program]).stdout == ""


@pytest.mark.parametrize(
    ("rule", "fits"),
    [
        (linear(Fraction(2**31, 2**31 - 1), 0, value_of("big")), True),  # 2^31 * (2^32 - 1) + 2^31 - 1 = 2^63 - 1
        (linear(Fraction(2**31, 2**31 + 1), 0, value_of("big")), False),
        (linear(Fraction(2**31 - 1, 2**31), 0, value_of("big")), True),
        (linear(Fraction(1, 2**63 - 2**32), 0, value_of("big")), True),
        (linear(Fraction(1, 2**63 - 2**32 + 1), 0, value_of("big")), False),
        (linear(1, 2**31 - 1, value_of("big", -1)), True),  # 1 + (2^32 - 1) * 2^31
        (linear(1, 2**31, value_of("big", -1)), False),
        (linear(1, "1/2", value_of("big")), True),
        (linear(3, 0, value_of("big"), value_of("factor")), True),
        (linear(3, 0, value_of("big"), value_of("big_too")), False),
        (linear(3, 0, value_of("divisor", -1)), False),
        (linear(3, 0, value_of("exponent", ten_to=True)), False),
        (linear(3, 0, value_of("gain")), False),
    ],
)
def test_a_limit_is_one_quotient_where_64_bits_suffice(rule: Linear, fits: bool) -> None:
    """Counted by hand: numerator and divisor at their largest, with the half that rounding adds; else step by step."""
    text = limit(Limit(rule, (), 0, 2**32 - 1), scope_of(device_of("limits", OTHERS)), is_low=False)
    assert ("fieldscribe_rule_of" not in text) is fits
