"""Generated C in a temporary folder, how it is compiled, and a device of everything that is rare."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.model import Entry, Enum, Flag, Limit, ScaleCase, Special
from fieldscribe.render import render
from fieldscribe.resources import templates_dir
from fieldscribe.targets import c, vectors
from models import HERTZ, allowed, linear, point, sample_device, scaled, titles, units, value_of

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.model import Device, Point

WARNINGS = (
    *("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Wdouble-promotion"),
    *("-Wcast-qual", "-Wundef", "-Wfloat-equal", "-Werror"),
)
SANITIZERS = {
    "gcc": ("-fsanitize=address,undefined", "-fno-sanitize-recover=all"),
    "clang": ("-fsanitize=address,undefined,integer,implicit-conversion", "-fno-sanitize-recover=all"),
}
STANDARDS = {
    "c99": ("-std=c99",),
    "c11": ("-std=c11",),
    "c17": ("-std=c17",),
    "c++11": ("-x", "c++", "-std=c++11"),
    "c++17": ("-x", "c++", "-std=c++17"),
    "c++20": ("-x", "c++", "-std=c++20"),
}
DRIVERS = {"gcc": "g++", "clang": "clang++"}


def driver(compiler: str, standard: str) -> str:
    """The command that compiles and links that standard."""
    return DRIVERS[compiler] if standard.startswith("c++") else compiler


def write_c(device: Device, out: Path) -> Path:
    """Generates headers, conformance program, runtime and vectors of a device; returns the folder."""
    copies = {path: (templates_dir() / source).read_text("utf-8") for path, source in c.runtime(device)}
    texts = {**dict(c.outputs(device, render)), **dict(vectors.outputs(device, render)), **copies}
    for path, text in texts.items():
        (out / path).parent.mkdir(parents=True, exist_ok=True)
        (out / path).write_text(text, encoding="utf-8")
    return out


def conformance_source(folder: Path, device: str) -> Path:
    """The generated conformance program."""
    return folder / "c" / "conformance" / f"{device}_conformance.c"


WIDE_NUMBERS = Enum("wide_number", titles("Wide"), (Entry(0xFFFF, "all", titles("All"), None),), False)


def rare_points() -> tuple[Point, ...]:
    """Types, scales, limits and codes that few devices have."""
    several = allowed((0, 7), (9, 9), (11, 65535))
    flags = (Flag(31, 1, "top", titles("Top"), 1, ()), Flag(17, 9, "middle", titles("Middle"), 1, ()))
    lost = Special(0x7F00, 0x7FFF, "lost", titles("Lost"), True)
    nothing = Special(0xFFFF, 0xFFFF, "nothing", titles("Nothing"), True)
    tens = Limit(linear(3, 0, value_of("exponent", ten_to=True)), (), 0, 60000)
    share = Limit(linear("100000", "1/2", value_of("divisor", -1)), (("divisor", (7, 9)),), 10, 50000)
    signed_share = Limit(linear(1000, 0, value_of("signed_factor", -1)), (), -500, 500)
    lifted = Limit(linear(2, 0, value_of("divisor")), (("exponent", (1, 3)), ("divisor", (9,))), 0, 900)
    floor = Limit(linear(5), (("signed_factor", (-1, 0)),), -300, 20)
    wide = Limit(linear(65536, 3, value_of("divisor")), (), 0, 4_000_000_000)
    product = linear("1/3", "5/2", value_of("divisor", slope=2, intercept=-10), value_of("signed_factor", -1))
    huge = linear(1, 0, value_of("big", 1), value_of("big_too", 1))
    by_sign = (
        ScaleCase("signed_factor", -1, linear(-4, 1)),
        ScaleCase("signed_factor", 2, linear("7/2", 0, value_of("divisor", -1))),
    )
    return (
        point("exponent", 0, "u8", allowed=allowed((0, 4))),
        point("divisor", 1, allowed=allowed((0, 1000))),
        point("signed_factor", 2, "s16", allowed=allowed((-20, 20))),
        point("big", 4, "u32", allowed=allowed((1, 3))),
        point("big_too", 6, "u32", allowed=allowed((1, 5))),
        point("limited_by_tens", 8, allowed=allowed((0, tens))),
        point("limited_by_share", 9, allowed=allowed((share, 60000)), scale=scaled(10), decimals=1),
        point("limited_by_sign", 10, "s16", allowed=allowed((-500, signed_share))),
        point("lifted_by_others", 54, "s16", allowed=allowed((floor, lifted))),
        point("lifted_scaled", 55, allowed=allowed((0, lifted)), scale=scaled(10), decimals=1),
        point("limited_wide", 12, "u32", allowed=allowed((0, wide)), scale=scaled(10), decimals=1),
        point("two_factors", 14, "s16", scale=(ScaleCase(None, None, product),), decimals=2),
        point("checked_factors", 15, scale=(ScaleCase(None, None, huge),)),
        point("by_sign", 16, "s16", scale=by_sign, decimals=1, allowed=allowed((-300, 300))),
        point("by_sign_lost", 17, "s16", scale=by_sign, decimals=1, specials=(lost,), allowed=allowed((-300, 300))),
        point("anything", 20, "u64"),
        point("long_one", 24, "s64", allowed=allowed((-(10**15), 10**15)), scale=scaled(1000), decimals=3),
        point("long_two", 28, "s32", scale=scaled("-7/5", "3/4"), decimals=0, allowed=allowed((-(2**31), 2**31 - 1))),
        point("long_three", 30, "u32", scale=scaled("1/128"), allowed=allowed((3, 2**32 - 1))),
        point("tiny", 32, "s8", allowed=allowed((-9, 9))),
        point("tiny_too", 33, "u8", scale=scaled(2), decimals=1),
        point("one_bit", 34, "bit", bits=(5, 5)),
        point("low_bits", 34, "u8", bits=(4, 0), scale=scaled(10), decimals=1, allowed=allowed((2, 30))),
        point("high_bits", 34, "s16", bits=(15, 6)),
        point("named", 35, enum=WIDE_NUMBERS),
        point("named_too", 36, enum=WIDE_NUMBERS, allowed=allowed((1, 65535))),
        point("lost_number", 37, "s16", specials=(lost,)),
        point("lost_time", 38, specials=(nothing,), scale=scaled(10), decimals=1, allowed=allowed((1, 65534))),
        point("written_only", 39, access="w", scale=scaled(10), decimals=1, allowed=several),
        point("precise", 40, "f32", allowed=units("1/10", "3/10"), unit=HERTZ),
        point("precise_too", 44, "f64", allowed=units("-1/10", "3/10")),
        point("free_float", 48, "f32", specials=(Special(0x7FC00000, 0x7FC00000, "none", titles("None"), True),)),
        point("flagged", 50, "u32", flags=flags),
        point("input_word", 52, access="r", space="input"),
        point("input_bit", 53, "bit", access="r", space="discrete"),
    )  # fmt: skip


def rare_device() -> Device:
    """A device of rare points, whose texts try to leave their comments."""
    hostile = '*/ #error "out" ??/ // \\\n#error \u202e {{ x }} \\'
    points = tuple(replace(one, title={"en": hostile}, code='"\\') for one in rare_points())
    device = replace(sample_device(points), id="rare", enums=(WIDE_NUMBERS,), blocks={}, frames=(), commands=())
    groups = tuple(replace(group, title={"en": hostile}) for group in device.groups)
    return replace(device, title={"en": hostile}, vendor=hostile, groups=groups, errata=())
