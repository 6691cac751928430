"""Crates that the tests of the Rust target build: real ones, and devices of odd names and rare kinds."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from c_device import rare_points
from fieldscribe.model import Entry, Enum, Flag, Limit, Place, ScaleCase, Special
from fieldscribe.render import render
from fieldscribe.resources import templates_dir
from fieldscribe.targets import rust, vectors
from models import allowed, entry, linear, point, sample_device, scaled, titles, value_of

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.model import Device, Point

HOSTILE = '*/ "#]\n#![cfg(no)] \u202e `x` [y](http://z) <b> {{ x }} \\'
LONG = "a_point_whose_name_is_as_long_as_a_description_lets_names_be_xyz"
ODD_ENTRIES = ("unknown", "other", "self", "none", "some", "ok", "err", "type", "a_1", "value_1_2", LONG)
ODD_FLAGS = ("move", "loop", "self", "from_x", "as_y")
ODD_NAMES = ("option", "ok", "err", "some", "none", "error", "point")


def write_crate(device: Device, out: Path) -> Path:
    """Generates the crate, the runtime and the vectors of a device; returns the crate's folder."""
    copies = {path: (templates_dir() / source).read_text("utf-8") for path, source in rust.runtime(device)}
    texts = {**dict(rust.outputs(device, render)), **dict(vectors.outputs(device, render)), **copies}
    for path, text in texts.items():
        (out / path).parent.mkdir(parents=True, exist_ok=True)
        (out / path).write_text(text, encoding="utf-8")
    return out / "rust" / device.id


def enums_of(points: tuple[Point, ...]) -> tuple[Enum, ...]:
    """All enums that points use, each once."""
    used = [enum for one in points for enum in (one.enum, one.digits and one.digits.enum) if enum]
    return tuple({enum.name: enum for enum in used}.values())


def rare_device() -> Device:
    """Types, scales, limits and codes that few devices have, with texts that try to leave their comments."""
    points = tuple(replace(one, title={"en": HOSTILE}, note={"en": HOSTILE}, code=HOSTILE) for one in rare_points())
    enums = enums_of(points)
    return replace(
        sample_device(points),
        id="rare",
        enums=enums,
        blocks={},
        frames=(),
        commands=(),
        errata=(),
        title={"en": HOSTILE},
        vendor=HOSTILE,
        model=HOSTILE,
    )


def odd_points() -> tuple[Point, ...]:
    """Names that mean something in Rust, names as long as they come, enums that points of several types share."""
    shared = Enum("result", titles("Shared"), tuple(entry(raw, name) for raw, name in enumerate(ODD_ENTRIES)), False)
    closed = Enum("option", titles("Closed"), (Entry(-3, "low", titles("Low"), None), entry(200, "high")), True)
    many = allowed(*((raw, raw) for raw in range(1000, 60000, 1733)), listed=True)
    flags = (
        *(
            Flag(bit, 1, name, titles(name), bit % 2, ())
            for bit, name in enumerate(("move", "loop", "self", "from_x", "as_y"))
        ),
        Flag(6, 4, "type", titles("T"), 1, (entry(3, "match"),)),
        Flag(10, 1, LONG, titles("L"), 0, ()),
        Flag(11, 2, f"{LONG}_too", titles("L"), 1, (entry(3, LONG),)),
    )
    highest = Limit(linear(2, 0, value_of("type")), (("type", (0, 5)), (LONG, (1,))), 0, 900)
    by_long = (
        ScaleCase(LONG, 1, linear(3, "1/2", value_of("self"))),
        ScaleCase(None, None, linear("-1/7", 0, value_of("self", -1, slope=3, intercept=-6))),
    )
    by_thirds = scaled("100/3", "-7/3")
    off = Special(60000, 60009, LONG, titles("Off"), False)
    gone = Special(65000, 65535, "gone", titles("Gone"), True)
    return (
        point("type", 0, allowed=allowed((0, 400))),
        point("self", 1, "s16", allowed=allowed((-5, 50))),
        point(LONG, 2, allowed=allowed((0, 1))),
        *(
            point(name, 10 + place)
            for place, name in enumerate(("option", "ok", "err", "some", "none", "error", "point"))
        ),
        *(point(name, 20 + place, enum=shared) for place, name in enumerate(("result", "runtime"))),
        point("shared_byte", 22, "u8", bits=(3, 0), enum=shared, allowed=allowed((0, 10))),
        point("shared_long", 24, "s32", enum=shared),
        point("closed_word", 26, "s16", enum=closed, allowed=allowed((-3, -3), (200, 200), listed=True)),
        point("closed_long", 28, "s32", enum=closed, allowed=allowed((-3, -3), (200, 200), listed=True)),
        point("many", 30, allowed=many),
        point("many_small", 31, allowed=allowed(*((raw, raw) for raw in range(0, 90, 2)), listed=True)),
        point("only_on", 5, "bit", space="coil", allowed=allowed((1, 1))),
        point("flagged", 32, "s16", flags=flags),
        point("whole_flag", 33, flags=(Flag(0, 16, "all", titles("All"), 1, ()),)),
        point("tiny_bits", 34, "s8", bits=(7, 4), allowed=allowed((-8, 7))),
        point("ranges", 35, specials=(off, gone), scale=by_thirds, decimals=2, allowed=allowed((0, 60009))),
        point("negative", 36, "u32", scale=scaled("-1000", 4_000_000_000), decimals=3),
        point("wide", 40, "u64", scale=scaled(1000), decimals=3, allowed=allowed((0, 10**15))),
        point("steep", 44, "s64", scale=scaled("1/1000"), decimals=0, allowed=allowed((-(10**12), 10**12))),
        point("both", 48, scale=by_long, decimals=2, allowed=allowed((0, highest))),
        point("limited", 49, allowed=allowed((3, 4), (10, highest))),
        point("elsewhere", 50, places=(Place("read", "holding", (50,), 4), Place("write", "holding", (60,), 16))),
        point("turned", 52, "u64", order=(54, 55, 52, 53)),
        point("written", 57, access="w", was=("written_before", LONG + "_before")),
    )


def odd_device() -> Device:
    """A device of odd points."""
    points = odd_points()
    enums = enums_of(points)
    return replace(sample_device(points), id="odd", enums=enums, blocks={}, frames=(), commands=(), errata=())
