"""Counts in generated C: without a division where that is proven, and right for every number of 16 bits."""

from __future__ import annotations

import struct
import subprocess
from fractions import Fraction
from pathlib import Path

import pytest
from fieldscribe.model import Device
from fieldscribe.targets.c.scales import Numbers, reciprocal
from support.c_device import SANITIZERS, WARNINGS, program, write_headers
from support.models import device_of, point, scaled
from support.toolchains import compiled

INT32 = (1 << 31) - 1
SCALES = {
    "halves": ("u16", scaled("1/2"), 1, 0, 5 * 65535),
    "fiftieths": ("s16", scaled(50), 2, -65540, 65540),
    "inverter": ("s16", scaled(256), 3, -128005, 128005),
    "fifths": ("u16", scaled(20), 2, -3, 327690),
    "percent": ("s16", scaled("16384/100"), 3, -200005, 200005),
    "sevenths": ("s16", scaled("3/7"), 1, -100000, 100000),
    "falling": ("s16", scaled("-5/2"), 1, -131080, 131080),
    "lifted": ("s16", scaled("5/2", "7/2"), 2, -200000, 200000),
}
"""By name: type, scale, decimals, and the counts to try, from below the least to above the greatest (or far up)."""

PROGRAM = program("counts")


def device() -> Device:
    points = (
        point(name, at, kind, scale=scale, decimals=decimals)
        for at, (name, (kind, scale, decimals, _, _)) in enumerate(SCALES.items())
    )
    return device_of("sample_drive", tuple(points))


def bounds(kind: str) -> tuple[int, int]:
    return (0, 65535) if kind == "u16" else (-32768, 32767)


def nearest(number: Fraction) -> int:
    """Halves away from zero."""
    return rounded(number.numerator, number.denominator)


def rounded(over: int, under: int) -> int:
    """The same of a quotient that is not made a fraction first, which takes long for all numbers of 16 bits."""
    size = (2 * abs(over) + abs(under)) // (2 * abs(under))
    return size if (over > 0) == (under > 0) else -size


@pytest.mark.full(seconds=3)
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_every_count_and_raw_number_of_16_bits(compiler: str, tmp_path: Path) -> None:
    """Against fractions that know nothing of the generator."""
    folder = write_headers(device(), tmp_path)
    tries = [
        f"    TRY({name}, {'u' if kind == 'u16' else ''}int16_t, {first}, {last}, {bounds(kind)[0]}, {bounds(kind)[1]})"
        for name, (kind, _, _, first, last) in SCALES.items()
    ]
    (tmp_path / "counts.c").write_text(PROGRAM.replace("@TRIES@", "\n".join(tries)), encoding="utf-8")
    flags = ("-std=c99", "-O2", *WARNINGS, *SANITIZERS[compiler], "-DFIELDSCRIBE_NO_FLOAT", "-I", str(folder / "c"))
    program = compiled(compiler, flags, tmp_path / "counts.c", tmp_path / "counts")
    done = subprocess.run([program], capture_output=True, check=True)
    found = iter(struct.unpack(f"={len(done.stdout) // 4}i", done.stdout))
    for name, (kind, scale, decimals, first, last) in SCALES.items():
        ratio, offset = scale[0].rule.ratio, scale[0].rule.offset
        (num, den), (more, by) = ratio.as_integer_ratio(), offset.as_integer_ratio()
        low, high = bounds(kind)
        for raw in range(low, high + 1):
            assert next(found) == rounded((raw * by - more) * den * 10**decimals, num * by), (name, raw)
        for count in range(first, last + 1):
            raw = rounded(count * num * by + more * den * 10**decimals, den * 10**decimals * by)
            assert next(found) == (raw if low <= raw <= high else -(1 << 31)), (name, count)
    assert next(found, None) is None


def test_counts_of_16_bits_need_no_division(tmp_path: Path) -> None:
    """Each is multiplied and shifted; only what no proof covers would divide."""
    text = (write_headers(device(), tmp_path) / "c/sample_drive.h").read_text("utf-8")
    assert "fieldscribe_divide(" not in text
    assert text.count("fieldscribe_nearly(") > 4


@pytest.mark.parametrize(("num", "den"), [(32, 125), (1, 5), (1, 2), (2, 5), (3, 7), (7, 12), (1, 10), (512, 3125)])
def test_what_is_taken_for_exact_is_exact(num: int, den: int) -> None:
    """And nothing overflows: each number of a range around zero, by the formula of the core."""
    for numbers in (Numbers(-3000, 3000, num, den), Numbers(0, 9000, num, den), Numbers(-70, 0, num, den)):
        one = reciprocal(numbers, INT32)
        if one is None:
            assert den & (den - 1) == 0  # shifted alone
            continue
        for number in range(numbers.low, numbers.high + 1):
            parts = number * one.much, number * one.little
            total = parts[0] + (parts[1] >> one.fine) + (1 << (one.bits - 1))
            assert max(map(abs, (*parts, total))) <= INT32
            assert total >> one.bits == nearest(Fraction(number * num, den))


def test_what_is_not_exact_is_not_taken() -> None:
    """Careful hand-written code takes v * 12583 / 2^21 + v / 4 for v * 32 / 125, which 522 counts are too many for."""
    assert reciprocal(Numbers(-128001, 127998, 32, 125), INT32) == (131, 4719, 16, 9)
    assert reciprocal(Numbers(0, 1 << 30, 1, 3), INT32) is None
