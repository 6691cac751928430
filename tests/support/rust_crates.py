"""Crates that the tests of the Rust target build: real ones, and devices of odd names and rare kinds."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from fieldscribe.families.can import CanBus
from fieldscribe.families.uss import UssBus
from fieldscribe.model import (
    Bus,
    Code,
    Device,
    Digits,
    Entry,
    Enum,
    Fixed,
    Flag,
    Limit,
    Message,
    Place,
    Point,
    Role,
    ScaleCase,
    Special,
    Telegram,
    Text,
)
from fieldscribe.targets import rust, vectors

from support.c_device import rare_points
from support.files import generate
from support.models import (
    SOURCE,
    allowed,
    changed,
    device_of,
    doubts,
    entry,
    linear,
    point,
    scaled,
    titles,
    units,
    value_of,
)

HOSTILE = '*/ "#]\n#![cfg(no)] \u202e `x` [y](http://z) <b> {{ x }} \\'
LONG = "a_point_whose_name_is_as_long_as_a_description_lets_names_be_xyz"
ODD_ENTRIES = ("unknown", "other", "self", "none", "some", "ok", "err", "type", "a_1", "value_1_2", LONG)


def write_crate(device: Device, out: Path) -> Path:
    """Generates the crate, the runtime and the vectors of a device; returns the crate's folder."""
    generate(device, out, rust, vectors)
    return out / "rust" / device.id


def without_registry(crates: Path) -> None:
    """Features of crates that bring nothing: cargo asks a registry even for what no member of a workspace turns on."""
    for manifest in crates.rglob("Cargo.toml"):
        own = re.sub(r"^.*optional = true.*\n", "", manifest.read_text("utf-8"), flags=re.MULTILINE)
        own = re.sub(r'^([\w-]+) = \["(?:std|dep:|fieldscribe_runtime/).*$', r"\1 = []", own, flags=re.MULTILINE)
        manifest.write_text(own, encoding="utf-8")


def rare_device() -> Device:
    """Types, scales, limits and codes that few devices have, with texts that try to leave their comments."""
    texts: Any = {"title": {"en": HOSTILE}, "note": {"en": HOSTILE}, "code": HOSTILE, "errata": ("doubt",)}
    points = tuple(replace(one, **texts) for one in rare_points())
    device = device_of("rare", points, title={"en": HOSTILE}, vendor=HOSTILE, model=HOSTILE)
    return replace(device, errata=doubts(HOSTILE, points[0].name))


def odd_points() -> tuple[Point, ...]:
    """Names that mean something in Rust, names as long as they come, enums that points of several types share."""
    shared = Enum("result", tuple(entry(raw, name) for raw, name in enumerate(ODD_ENTRIES)), False)
    closed = Enum("option", (Entry(-3, "low", titles("Low"), None), entry(200, "high")), True)
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
    highest = Limit(linear(2, 0, value_of("type")), (("type", ((0, 0), (5, 9))), (LONG, ((1, 1),))), 0, 900)
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
        point("elsewhere", 50, write_place=Place((60,), {})),
        point("turned", 52, "u64", order=(54, 55, 52, 53)),
        point("written", 57, access="w", was=("written_before", LONG + "_before")),
    )


def odd_device() -> Device:
    """A device of odd points."""
    return device_of("odd", odd_points())


WORDS = tuple(("word", number) for number in range(6))
SUM = (("xor", 0b0001_0101), ("xor", 0b0010_1010))
NAMED = (("address", 8), ("address", 0))


def message(name: str, direction: str, can_id: int, *roles: tuple[str, int], answers: str | None = None) -> Message:
    """A message of eight bytes; one from a unit adds its number to the identifier."""
    layout = tuple(Role(kind, number) for kind, number in roles)
    return Message(name, titles(name), direction, answers, can_id, direction != "request", layout, SOURCE)


def can_messages() -> tuple[Message, ...]:
    """Messages that read and write, telegrams with and without a multiplexer, an extended identifier, long names."""
    ask = (("constant", 0xFF), ("unit", 0), *NAMED)
    write = (("constant", 0xEE), ("unit", 0), *NAMED, ("raw", 8), ("raw", 0), *SUM)
    told = (("constant", 0xFF), ("unit", 0), *NAMED, ("raw", 8), ("raw", 0), *SUM)
    beat = (("constant", 5), ("unit", 0), ("word", 1), ("word", 0), ("constant", 0), ("constant", 0), *SUM)
    return (
        message("read_request", "request", 0x33F, *ask, ("constant", 0), ("constant", 0), *SUM),
        message("read_answer", "response", 0x320, *told, answers="read_request"),
        message("write_request", "request", 0x33F, *write),
        message("write_answer", "response", 0x320, *write, answers="write_request"),
        message("measured", "cyclic", 0x320, ("constant", 0xDD), ("multiplexer", 0), *WORDS),
        message("message", "cyclic", 0x1ABCDEF0, *beat),
        message(LONG, "request", 0x7FF, *(("constant", 0),) * 8),
    )


def can_points() -> tuple[Point, ...]:
    """Parameters of every form, and points in one frame and in two."""
    digit = Enum("digit", (entry(0, "off"), entry(1, "soon"), entry(5, "late")), True)
    mixed = Enum("mixed", (entry(2, "two"), entry(3, "three")), False)
    parameter: dict[str, Any] = {"space": "parameter", "references": {}}
    heard: dict[str, Any] = {"space": "telegram", "references": {}, "telegram": "measured", "access": "r"}
    exponent = value_of("exponent", -1, ten_to=True)
    start = (Flag(15, 1, "start", titles("Start"), 1, ()),)
    return (
        point("ratio", 507, allowed=allowed((1, 400)), **parameter),
        point("level", 10, scale=scaled("1/400", 0, value_of("ratio")), decimals=1, **parameter),
        point("target", 11, scale=scaled(256), decimals=1, allowed=allowed((10240, 17920)), **parameter),
        point("mode", 19, "u8", bits=(15, 14), fixed=Fixed(0x00F1, 1), allowed=allowed((0, 0), (3, 3)), **parameter),
        point("horn", 19, "u8", bits=(11, 8), flags=(Flag(3, 1, "loud", titles("Loud"), 1, ()),), **parameter),
        point("control", 30, flags=start, fixed=Fixed(0x0406, 0x0406), **parameter),
        point("delays", 404, digits=Digits(4, digit), **parameter),
        point("strange_digits", 405, digits=Digits(2, mixed), **parameter),
        point("strange_word", 406, "s16", enum=mixed, **parameter),
        point("actual", 407, access="r", **parameter),
        point("password", 408, access="w", **parameter),
        changed(point("name", 732, order=range(739, 731, -1), **parameter), type="text", text=Text(16, "ascii")),
        changed(point(LONG, 800, order=range(800, 830), **parameter), type="text", text=Text(60, "latin-1")),
        point("frequency", 0, scale=scaled(100), decimals=2, **heard),
        point("power", 1, "s16", scale=scaled(1, 0, exponent), **heard),
        point("exponent", 2, "s8", bits=(15, 8), allowed=allowed((-4, 4)), **heard),
        point("hours", 5, "u32", **heard),
        point("hours_turned", 5, "s32", order=(6, 5), **heard),
        point("starts", 9, "u32", **heard),
        point("energy", 8, "f32", **heard),
        changed(point("display", 16, order=(17, 16), **heard), type="text", text=Text(4, "ascii")),
        point("beats", 0, **{**heard, "telegram": "telegram"}),
    )  # fmt: skip


def can_device() -> Device:
    """A device with messages of its own."""
    bus = Bus((), (1, 30), None, (), (), {}, {}, {}, {}, CanBus(125000, 29))
    telegrams = (
        Telegram("measured", titles("M"), "cyclic", 20, "measured", SOURCE),
        Telegram("telegram", titles("T"), "cyclic", 1, "message", SOURCE),
    )
    facts: dict[str, Any] = {"family": "can", "bus": bus, "messages": can_messages(), "telegrams": telegrams}
    return device_of("odd_can", can_points(), **facts)


def uss_bus() -> Bus:
    """The bus of a drive that stores no arrays of double words."""
    answers = {0: (0,), 1: (1, 2), 2: (1,), 3: (2,), 6: (4, 5), 7: (4,), 8: (5,), 12: (4,), 13: (2,), 14: (1,)}
    tasks = tuple(Code(number, f"task_{number}", titles("T"), None, None, ends) for number, ends in answers.items())
    responses = tuple(Code(number, f"response_{number}", titles("R"), None) for number in (0, 1, 2, 4, 5, 7, 8))
    errors = (Code(17, "not_now", titles("N"), None), Code(102, LONG, titles("L"), None))
    return Bus((), (0, 31), 32, tasks, errors, {}, {}, {}, {}, UssBus(responses, (0, 3, 4, 127), (0, 8)))


def uss_points() -> tuple[Point, ...]:
    """Parameters, elements of arrays, process data both ways."""
    parameter: dict[str, Any] = {"space": "parameter", "references": {}}
    task: dict[str, Any] = {"space": "telegram", "references": {}, "telegram": "task"}
    answer: dict[str, Any] = {"space": "telegram", "references": {}, "telegram": "answer", "access": "r"}
    by_reference = scaled(16384, 0, value_of("reference", -1))
    limit = Limit(linear(16384 * 60, 0, value_of("reference", -1)), (), 0, 32767)
    return (
        point("source", 700, allowed=allowed((0, 6)), **parameter),
        point("reference", 2000, "f32", order=(2000,), allowed=units(1, 650), **parameter),
        point("baud_index_1", 2010, index=1, **parameter),
        point("wide_index_255", 31999, "u32", order=(31999,), index=255, **parameter),
        point("status", 52, access="r", flags=(Flag(3, 1, "fault", titles("Fault"), 0, ()),), **parameter),
        point("low_bits", 60, "u8", bits=(3, 0), fixed=Fixed(0x8000, 0x8000), **parameter),
        point("control_word", 0, flags=(Flag(0, 1, "on", titles("On"), 1, ()),), fixed=Fixed(0x0400, 0x0400), **task),
        point("main_setpoint", 1, "s16", scale=by_reference, decimals=3, **task),
        point("limited_setpoint", 2, "s16", allowed=allowed((0, limit)), **task),
        point("jog", 3, "u8", bits=(1, 0), fixed=Fixed(0xFF00, 0x8000), **task),
        point("position", 4, "s32", **task),
        point("far_word", 9, fixed=Fixed(0x0001, 0x0001), **task),
        point("status_word", 0, flags=(Flag(0, 1, "ready", titles("Ready"), 1, ()),), **answer),
        point("main_actual", 1, "s16", scale=by_reference, decimals=3, **answer),
        point("energy", 2, "u32", order=(3, 2), **answer),
    )  # fmt: skip


def uss_device() -> Device:
    """A drive on USS."""
    telegrams = tuple(
        Telegram(name, titles(name), direction, 10, None, SOURCE)
        for name, direction in (("task", "request"), ("answer", "response"))
    )
    return device_of("odd_uss", uss_points(), family="uss", bus=uss_bus(), telegrams=telegrams)
