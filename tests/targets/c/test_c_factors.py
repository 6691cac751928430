"""Scales with the number of an f32 point in generated C, held against exact rationals for numbers at random."""

from __future__ import annotations

import random
import struct
from collections.abc import Iterator
from itertools import islice
from math import isfinite
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.model import Point
from fieldscribe.targets.vectors.lines import Lines
from fieldscribe.targets.vectors.oracle import Oracle, Ratio, quotient
from support.c_device import SANITIZERS, WARNINGS, conformance_source, floating_factors, rare_device, write_c
from support.toolchains import compiled, run

COUNT = 8000
INT64 = 1 << 63
DEVICE = rare_device()
POINTS = {point.name: point for point in DEVICE.points}
NAMES = [point.name for point in floating_factors() if point.scale_arguments and point.name != "checked_gain"]


def pattern(rng: random.Random) -> int:
    """A binary32 number: usual ones, but also tiny, huge and no numbers at all."""
    if rng.random() < 0.3:
        return rng.getrandbits(32)
    if rng.random() < 0.1:
        return rng.getrandbits(32) & 0x807F_FFFF
    value = rng.choice((1, -1)) * 10 ** rng.uniform(-6, 6)
    return int(struct.unpack("<I", struct.pack("<f", value))[0])


def setting(rng: random.Random, point: Point) -> int:
    if point.info.floating:
        return pattern(rng)
    if point.name == "exponent":
        return rng.randint(0, 4)
    return rng.randint(point.least, point.greatest) if rng.random() < 0.3 else rng.randint(1, 9)


def draws(rng: random.Random) -> Iterator[tuple[Any, ...]]:
    """Vectors without end."""
    oracle = Oracle(POINTS)
    while True:
        point = POINTS[rng.choice(NAMES)]
        settings = {name: setting(rng, POINTS[name]) for name in point.arguments}
        ratio, limits = oracle.ratio(point.shape, settings), oracle.limits(point.shape, point.allowed, settings)
        raw = rng.choice((rng.randint(point.least, point.greatest), rng.randint(max(point.least, -99), 99)))
        head = point.name, settings
        if isinstance(ratio, str) or isinstance(limits, str):
            yield *head, "decode_count", raw, ratio
            yield *head, "encode_count", raw, ratio
            continue
        decimals = point.decimals or 0
        count = near_count(rng, ratio, raw, decimals)
        for kind, number, found in (
            ("encode_count", count, ratio.raw_of_count(count, decimals)),
            *encoded_value(rng, ratio, raw),
        ):
            inside = found is not None and any(low <= found <= high for low, high in limits)
            yield *head, kind, number, *(("ok", found) if inside else ("out_of_range",))
        decoded = ratio.count_of_raw(raw, decimals)
        yield *head, "decode_count", raw, *(("ok", decoded) if -INT64 <= decoded < INT64 else ("overflow",))
        if ratio.divides_exactly(raw):
            yield *head, "decode", raw, "ok", quotient(ratio.numerator(raw), ratio.denominator)


def near_count(rng: random.Random, ratio: Ratio, raw: int, decimals: int) -> int:
    """A count of the raw number or of the half above it, or next to these; or any at all."""
    lower = ratio.count_of_raw(raw, decimals)
    upper = ratio.count_of_raw(raw + rng.randint(0, 1), decimals)
    count = (lower + upper) // 2 + rng.randint(-1, 1)
    return count if -INT64 <= count < INT64 and rng.random() < 0.8 else rng.getrandbits(64) - INT64


def encoded_value(rng: random.Random, ratio: Ratio, raw: int) -> Iterator[tuple[str, float, int | None]]:
    value = quotient(ratio.numerator(raw), ratio.denominator) * rng.choice((1.0, 1.0 + 2**-52, 1.001))
    if rng.random() < 0.2:
        value = struct.unpack("<d", struct.pack("<Q", rng.getrandbits(64)))[0]
    if isfinite(value):
        yield "encode", value, ratio.raw_of_float(value)


@pytest.mark.full(seconds=5)
@pytest.mark.parametrize(
    ("compiler", "how"), [("gcc", ("-O2",)), ("clang", ("-O0", *SANITIZERS["clang"]))], ids=["gcc", "clang"]
)
def test_factors_are_exact(compiler: str, how: tuple[str, ...], tmp_path: Path) -> None:
    write_c(DEVICE, tmp_path)
    lines = Lines()
    for point, settings, kind, *fields in islice(draws(random.Random(compiler)), COUNT):
        lines.set("point", point)
        lines.set("with", settings)
        lines.add(kind, *fields)
    text = lines.text(DEVICE.id, DEVICE.version, DEVICE.digest)
    (tmp_path / "random.txt").write_text(text, encoding="utf-8")
    flags = ("-std=c99", *how, *WARNINGS)
    program = compiled(compiler, flags, conformance_source(tmp_path, DEVICE.id), tmp_path / "conformance")
    done = run([program, tmp_path / "random.txt"])
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"total {COUNT} passed" in done.stdout
