"""Counts of f32 points in C without floating point, held against exact rationals."""

from __future__ import annotations

import random
import struct
import subprocess
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

from fieldscribe.model import Point, Special
from fieldscribe.targets.vectors.oracle import half_away
from support.c_device import SANITIZERS, WARNINGS, program, write_headers
from support.models import device_of, point, titles, units
from support.toolchains import compiled

OK, OUT_OF_RANGE, NOT_A_NUMBER, OVERFLOW, SPECIAL = 0, 1, 2, 6, 7
NONE = Special(0x42C80000, 0x42C80000, "none", titles("None"), True)
POINTS = {
    at.name: at
    for at in (
        point("tenths", 0, "f32", decimals=1),
        point("limited", 2, "f32", decimals=2, allowed=units(0, 650)),
        point("fine", 4, "f32", decimals=12),
        point("coded", 6, "f32", decimals=3, specials=(NONE,)),
    )
}
TIE = (1 << 24) + 1
"""A number halfway between two of binary32."""

CASES = [
    ("tenths", "encode", 215, (OK, 0x41AC0000)),
    ("tenths", "encode", 1, (OK, 0x3DCCCCCD)),
    ("tenths", "encode", 0, (OK, 0)),
    ("tenths", "encode", -15, (OK, 0xBFC00000)),
    ("tenths", "encode", TIE * 10, (OK, 0x4B800000)),  # ties to even
    ("tenths", "encode", TIE * 10 + 1, (OK, 0x4B800001)),
    ("tenths", "encode", (TIE + 2) * 10, (OK, 0x4B800002)),
    ("tenths", "encode", 167772155, (OK, 0x4B800000)),  # rounds up to the next power of two
    ("tenths", "encode", (1 << 63) - 1, (OK, 0x5D4CCCCD)),
    ("tenths", "encode", -(1 << 63), (OK, 0xDD4CCCCD)),
    ("limited", "encode", 65000, (OK, 0x44228000)),
    ("limited", "encode", 65001, (OUT_OF_RANGE, 0)),
    ("limited", "encode", -1, (OUT_OF_RANGE, 0)),
    ("coded", "encode", 100000, (SPECIAL, 0)),
    ("coded", "decode", 0x42C80000, (SPECIAL, 0)),
    ("tenths", "decode", 0x41AC0000, (OK, 215)),
    ("tenths", "decode", 0x3D4CCCCD, (OK, 1)),  # a little more than 0.05
    ("tenths", "decode", 0x3D4CCCCC, (OK, 0)),
    ("coded", "decode", 0xBA800000, (OK, -1)),  # -0.9765625 counts
    ("tenths", "decode", 0xBE800000, (OK, -3)),  # -2.5 counts: halves away from zero
    ("tenths", "decode", 0x80000000, (OK, 0)),
    ("tenths", "decode", 0x00000001, (OK, 0)),
    ("tenths", "decode", 0x5D4CCCCC, (OK, 9223371487098961920)),
    ("tenths", "decode", 0x5D4CCCCD, (OVERFLOW, 0)),
    ("tenths", "decode", 0x7F800000, (OVERFLOW, 0)),
    ("tenths", "decode", 0xFF800000, (OVERFLOW, 0)),
    ("tenths", "decode", 0x7FC00000, (NOT_A_NUMBER, 0)),
    ("tenths", "decode", 0xFF800001, (NOT_A_NUMBER, 0)),
]


def value_of(bits: int) -> Fraction | None:
    """The number of a pattern; None for infinity and NaN."""
    power, fraction = bits >> 23 & 0xFF, bits & 0x7FFFFF
    size = Fraction(fraction | 0x800000 if power else fraction) * Fraction(2) ** (max(power, 1) - 150)
    return None if power == 0xFF else -size if bits >> 31 else size


def nearest(value: Fraction) -> int:
    """The pattern nearest to a value: of its two neighbours the nearer, of two alike the even one."""
    low, high = 0, 0x7F7FFFFF
    while low < high:  # the greatest pattern up to the size
        middle = (low + high + 1) // 2
        low, high = (middle, high) if (value_of(middle) or 0) <= abs(value) else (low, middle - 1)
    below, above = abs(value) - (value_of(low) or 0), (value_of(low + 1) or 0) - abs(value)
    size = low + (above < below or (above == below and low % 2 == 1))
    return size | 0x80000000 if value < 0 else size


def expected(at: Point, kind: str, number: int) -> tuple[int, int]:
    tens = 10 ** (at.decimals or 0)
    if kind == "encode":
        bits = nearest(Fraction(number, tens))
        if bits in [code.low for code in at.specials]:
            return SPECIAL, 0
        inside = all(low <= (value_of(bits) or 0) <= high for low, high in at.allowed.units)
        return (OK, bits) if inside else (OUT_OF_RANGE, 0)
    value = value_of(number)
    if value is None:
        return (NOT_A_NUMBER if number & 0x7FFFFF else OVERFLOW), 0
    count = half_away((value * tens).numerator, (value * tens).denominator)
    coded = number in [code.low for code in at.specials]
    return (SPECIAL, 0) if coded else (OK, count) if abs(count) < 1 << 63 else (OVERFLOW, 0)


def at_random(rng: random.Random) -> Iterator[tuple[str, str, int]]:
    """Counts near a tie of two patterns, or any; patterns of usual numbers, or any."""
    for at in POINTS.values():
        for _ in range(150):
            count = rng.choice((1, -1)) * rng.getrandbits(rng.randint(1, 63))
            tie = (2 * rng.getrandbits(24) + 1) * 10 ** (at.decimals or 0) >> rng.randint(0, 30)
            bits = int(struct.unpack("<I", struct.pack("<f", rng.choice((1, -1)) * 10 ** rng.uniform(-14, 19)))[0])
            for kind, number in (
                ("encode", count),
                ("encode", tie % (1 << 63) + rng.randint(-1, 1)),
                ("decode", bits),
                ("decode", rng.getrandbits(32)),
            ):
                yield at.name, kind, number


def test_counts_of_f32_points(tmp_path: Path) -> None:
    folder = write_headers(device_of("sample_drive", tuple(POINTS.values())), tmp_path)
    text = program("f32_counts").replace("@POINTS@", "\n".join(f"        POINT({name})" for name in POINTS))
    (tmp_path / "f32_counts.c").write_text(text, encoding="utf-8")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS["gcc"], "-DFIELDSCRIBE_NO_FLOAT", "-I", str(folder / "c"))
    binary = compiled("gcc", flags, tmp_path / "f32_counts.c", tmp_path / "f32_counts")
    cases = [*(case[:3] for case in CASES), *at_random(random.Random(24))]
    lines = "".join(f"{name} {kind} {number}\n" for name, kind, number in cases)
    done = subprocess.run([binary], input=lines, capture_output=True, text=True, check=True)
    found = [tuple(map(int, line.split())) for line in done.stdout.splitlines()]
    assert found[: len(CASES)] == [result for *_, result in CASES]
    for (name, kind, number), result in zip(cases, found, strict=True):
        assert result == expected(POINTS[name], kind, number), (name, kind, number)
