"""Generated C in a temporary folder, how it is compiled, and a device of everything that is rare."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest
from fieldscribe.model import Device, Digits, Entry, Enum, Fixed, Flag, Limit, Point, ScaleCase, Special, Text
from fieldscribe.targets import c, vectors

from support.described import kitchen_sink, made
from support.files import generate
from support.made_once import made_once
from support.models import (
    HERTZ,
    allowed,
    device_of,
    doubts,
    entry,
    linear,
    point,
    sample_device,
    scaled,
    titles,
    units,
    value_of,
)
from support.toolchains import compiled, succeed

PROGRAMS = Path(__file__).resolve().parents[1] / "targets" / "c" / "programs"
WARNINGS = (
    *("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Wdouble-promotion"),
    *("-Wcast-qual", "-Wundef", "-Wfloat-equal", "-Werror"),
)
SANITIZERS = {
    "gcc": ("-fsanitize=address,undefined", "-fno-sanitize-recover=all"),
    "clang": ("-fsanitize=address,undefined,integer,implicit-conversion", "-fno-sanitize-recover=all"),
}
WAYS = {
    "quick": ("gcc", ("-O0",)),
    **{compiler: (compiler, ("-O0", *flags)) for compiler, flags in SANITIZERS.items()},
}
"""How a program is built: the core suite takes the quick way; sanitizers see most where nothing is optimized away."""
SANITIZING = ("quick", pytest.param("clang", marks=pytest.mark.full(seconds=1)))
"""Both compilers, one of them with its sanitizers, which look for all that those of gcc do, and for more."""
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
    """Return the command that compiles and links that standard."""
    return DRIVERS[compiler] if standard.startswith("c++") else compiler


def write_c(device: Device, out: Path) -> Path:
    """Generate headers, conformance program, runtime and vectors of a device; return the folder."""
    return generate(device, out, c, vectors)


def write_headers(device: Device, out: Path) -> Path:
    """Generate the same without the vectors; return the folder."""
    return generate(device, out, c)


def program(name: str) -> str:
    """Return one of the C programs of the tests."""
    return (PROGRAMS / f"{name}.c").read_text("utf-8")


def run_program(text: str, way: str, includes: Path, out: Path, *flags: str, standard: str = "c99") -> None:
    """Build a program in one of WAYS without a warning and run it: the test fails unless it ends with 0."""
    compiler, how = WAYS[way]
    (out / "program.c").write_text(text, encoding="utf-8")
    words = (*STANDARDS[standard], *how, *WARNINGS, f"-I{includes}", *flags)
    succeed([compiled(driver(compiler, standard), words, out / "program.c", out / "program")])


def conformance_source(folder: Path, device: str) -> Path:
    """Return the path of the generated conformance program."""
    return folder / "c" / "conformance" / f"{device}_conformance.c"


WIDE_NUMBERS = Enum("wide_number", (Entry(0xFFFF, "all", titles("All"), None),), False)


def rare_points() -> tuple[Point, ...]:
    """Types, scales, limits and codes that few devices have."""
    several = allowed((0, 7), (9, 9), (11, 65535))
    flags = (Flag(31, 1, "top", titles("Top"), 1, ()), Flag(17, 9, "middle", titles("Middle"), 1, ()))
    lost = Special(0x7F00, 0x7FFF, "lost", titles("Lost"), True)
    nothing = Special(0xFFFF, 0xFFFF, "nothing", titles("Nothing"), True)
    tens = Limit(linear(3, 0, value_of("exponent", ten_to=True)), (), 0, 60000)
    share = Limit(linear("100000", "1/2", value_of("divisor", -1)), (("divisor", ((7, 7), (9, 9))),), 10, 50000)
    signed_share = Limit(linear(1000, 0, value_of("signed_factor", -1)), (), -500, 500)
    lifted = Limit(linear(2, 0, value_of("divisor")), (("exponent", ((1, 1), (3, 3))), ("divisor", ((9, 12),))), 0, 900)
    floor = Limit(linear(5), (("signed_factor", ((-1, 0),)),), -300, 20)
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
        *floating_factors(),
        *words_of_parts(),
        point("input_word", 52, access="r", space="input"),
        point("input_bit", 53, "bit", access="r", space="discrete"),
    )  # fmt: skip


def floating_factors() -> tuple[Point, ...]:
    """Rules with the value of f32 points on either side, with other factors, offsets and limits."""
    gain, over_gain, other = value_of("gain"), value_of("gain", -1), value_of("gain_too", -1)
    times_gain = ScaleCase(None, None, linear("5/3", 0, gain))
    by_exponent = (
        ScaleCase("exponent", 0, linear(16384, 0, over_gain)),
        ScaleCase("exponent", 1, linear(100)),
        ScaleCase("exponent", 2, linear(3, "-7/2", value_of("divisor"), over_gain)),
        ScaleCase("exponent", 3, linear(-4, 9, value_of("exponent", ten_to=True), gain)),
    )
    top = Limit(linear(2500, 0, over_gain), (), 0, 60000)
    bottom = Limit(linear(-1000, "1/2", over_gain), (("divisor", ((3, 3),)),), -20000, 100)
    return (
        point("gain", 60, "f32", allowed=units("-1000", "1000")),
        point("gain_too", 62, "f32"),
        point("times_gain", 64, "s16", scale=(times_gain,), decimals=3, allowed=allowed((-20000, 20000))),
        point("over_gain", 65, "s16", scale=scaled(16384, 0, over_gain), decimals=4),
        point("over_gain_wide", 66, "u32", scale=scaled(7, 0, over_gain), decimals=6),
        point("gains", 68, "s32", scale=scaled("11/7", 0, gain, other), decimals=1),
        point("gain_and_integers", 70, scale=scaled(1, 3, gain, value_of("divisor", -1)), decimals=2),
        point("by_exponent", 71, "s16", scale=by_exponent, decimals=2, allowed=allowed((-300, 300))),
        point("gain_shifted", 72, "s16", scale=scaled("4/3", "5/2", over_gain), decimals=2),
        point("gain_lowered", 73, "s16", scale=scaled(-8, "-3/2", gain), decimals=2),
        point("limited_by_gain", 74, allowed=allowed((0, top))),
        point("limited_over_gain", 75, "s16", allowed=allowed((bottom, 20000)), scale=scaled(10), decimals=1),
        point("checked_gain", 76, "u32", scale=scaled(1, 0, value_of("big"), value_of("big_too"), gain)),
    )


def words_of_parts() -> tuple[Point, ...]:
    """Texts, digits, and words with constant bits."""
    digit = Enum("digit", (entry(0, "off"), entry(1, "a"), entry(2, "b"), entry(7, "c")), True)
    loud = Enum("loud", tuple(entry(number, f"n{number}") for number in range(10)), True)
    return (
        point("name", 100, "text", order=range(107, 99, -1), text=Text(16, "ascii")),
        point("note", 110, "text", order=(110, 112, 111), text=Text(6, "latin-1")),
        point("tag", 114, "text", order=(114, 115), text=Text(4, "ascii"), access="r"),
        point("delays", 120, digits=Digits(4, digit)),
        point("delays_too", 121, digits=Digits(5, loud)),
        point("pairs", 122, digits=Digits(2, digit), access="w"),
        point("single", 123, digits=Digits(1, loud)),
        point("control", 124, flags=(Flag(0, 1, "on", titles("On"), 1, ()),), fixed=Fixed(0x0C00, 0x0400)),
        point("signed_fixed", 125, "s16", fixed=Fixed(0x4001, 0x0001), allowed=allowed((-32767, -5))),
        point("several_fixed", 126, fixed=Fixed(0x000F, 0x0003), allowed=allowed((3, 19), (35, 67))),
        point("wide_fixed", 128, "s32", fixed=Fixed(0x40000000, 0x40000000)),
        point("group_fixed", 130, "u8", bits=(7, 4), fixed=Fixed(0xC00F, 0x8005)),
    )


def rare_device() -> Device:
    """A device of rare points, whose texts try to leave their comments."""
    hostile = '*/ #error "out" ??/ // \\\n#error \u202e {{ x }} \\'
    points = tuple(replace(one, title={"en": hostile}, code='"\\', errata=("doubt",)) for one in rare_points())
    device = device_of("rare", points, enums=(WIDE_NUMBERS,), title={"en": hostile}, vendor=hostile)
    device = replace(device, errata=doubts(hostile, points[0].name))
    return replace(device, groups=tuple(replace(group, title={"en": hostile}) for group in device.groups))


MADE: Mapping[str, Callable[[], Device]] = {
    "sample_drive": sample_device,
    "rare": rare_device,
    "kitchen_sink": kitchen_sink,
    **{name: partial(made, name) for name in ("kitchen_codes", "kitchen_can", "kitchen_uss")},
}


class Folders(dict[str, "Path"]):
    """Maps a made device to the folder of its headers, program and vectors, which is generated at first use."""

    def __init__(self, factory: pytest.TempPathFactory) -> None:
        super().__init__()
        self._factory = factory

    def __missing__(self, device: str) -> Path:
        """Generate the files of a device, or use those that another process of the run has generated."""
        place = made_once(self._factory, f"c-{device}", lambda out: write_c(MADE[device](), out))
        return self.setdefault(device, place)
