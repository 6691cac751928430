"""Small models built in code, for tests that need a device but no description."""

from __future__ import annotations

from dataclasses import fields, replace
from fractions import Fraction
from typing import Any

from fieldscribe.families.modbus import ModbusBus
from fieldscribe.model import (
    NOWHERE,
    TYPES,
    Allowed,
    Block,
    Bus,
    Code,
    Command,
    Device,
    Document,
    Entry,
    Enum,
    Erratum,
    Factor,
    Flag,
    Frame,
    Group,
    Interval,
    Limit,
    Linear,
    Named,
    Place,
    Point,
    ScaleCase,
    Shape,
    Source,
    Special,
    Terms,
    Unit,
    Variant,
)

SOURCE = Source("manual", "Gruppe A", None, 780)
NUMBER = Unit("", "number", "number")
HERTZ = Unit("Hz", "hertz", "frequency")
SECOND = Unit("s", "second", "time")
MILLISECOND = Unit("ms", "millisecond", "time")
VOLT = Unit("V", "volt", "voltage")
WATT = Unit("W", "watt", "power")
CELSIUS = Unit("°C", "degree Celsius", "temperature")
VARIANTS = (Variant("voltage_class", "200V"), Variant("voltage_class", "400V"))


def titles(english: str, german: str | None = None) -> dict[str, str]:
    """A title in one or two languages."""
    return {"en": english} if german is None else {"en": english, "de": german}


def linear(ratio: int | str | Fraction, offset: int | str = 0, *factors: Factor) -> Linear:
    """The rule raw = value * ratio * factors + offset."""
    return Linear(Fraction(ratio), Fraction(offset), factors)


def scaled(ratio: int | str, offset: int | str = 0, *factors: Factor) -> tuple[ScaleCase, ...]:
    """A scale of one case that always holds."""
    return (ScaleCase(None, None, linear(ratio, offset, *factors)),)


def allowed(*intervals: tuple[int | Limit, int | Limit], listed: bool = False) -> Allowed:
    """A union of raw intervals."""
    return Allowed(tuple(Interval(low, high) for low, high in intervals), listed, ())


def units(low: int | str, high: int | str) -> Allowed:
    """The range of an f32 or f64 point, in its unit."""
    return Allowed((), False, ((Fraction(low), Fraction(high)),))


def value_of(name: str, power: int = 1, *, slope: int = 1, intercept: int = 0, ten_to: bool = False) -> Factor:
    """A run-time factor that another point gives."""
    return Factor(name, slope, intercept, power, ten_to)


def entry(raw: int, name: str, english: str | None = None, quantity: str | None = None) -> Entry:
    """A named number."""
    return Entry(raw, name, titles(english or name), quantity)


_SHAPED = frozenset(one.name for one in fields(Shape))
_TERMS = frozenset(one.name for one in fields(Terms))


def changed(point: Point, **facts: Any) -> Point:
    """The point with other facts, be they its own, of its place, of its shape or of its terms."""
    if "references" in facts:
        facts["place"] = replace(point.place, references=facts.pop("references"))
    shaped = {key: value for key, value in facts.items() if key in _SHAPED}
    terms = {key: value for key, value in facts.items() if key in _TERMS}
    own = {key: value for key, value in facts.items() if key not in _SHAPED | _TERMS}
    bits = terms.get("bits", point.bits)
    width = TYPES[shaped.get("type", point.type)].bits if bits is None else bits[0] - bits[1] + 1
    shape = replace(point.shape, **{"width": width, **shaped})
    return replace(point, shape=shape, terms=replace(point.terms, **terms), **own)


def point(name: str, address: int | None, type_name: str = "u16", **facts: Any) -> Point:
    """A readable and writable holding register (or pair, ...); any field of the model may be said otherwise.

    `order` gives the addresses of the words, the high part first.
    """
    info, bits = TYPES[type_name], facts.get("bits")
    count = 1 if bits else max(1, info.bits // 16)
    space, order = facts.get("space", "holding"), facts.pop("order", None)
    known = address is not None
    addresses = () if address is None else tuple(order or range(address, address + count))
    shape = Shape(type_name, info.bits, "rw", scale=None, decimals=0, enum=None, flags=(), specials=())
    terms = Terms(
        group="main",
        space=space,
        bits=None,
        unit=NUMBER,
        steps=(),
        changes=None,
        keeps=None,
        conditions=(),
        when=None,
        since=None,
        until=None,
        reserved=False,
        generated=known,
        reason=None if known else "the manual prints no address",
    )
    base = Point(
        name=name,
        variant=None,
        code=None,
        title=titles(name.replace("_", " ").capitalize()),
        note={},
        source=SOURCE,
        place=NOWHERE if address is None else Place(addresses, {"modicon": address + 1}),
        write_place=None,
        shape=shape,
        terms=terms,
        allowed=Allowed((), False, ()),
        default=None,
        default_raw=None,
        record=None,
        set=None,
        index=None,
        was=(),
        errata=(),
    )
    made = changed(base, **facts)
    if info.floating or "allowed" in facts:
        return made
    return replace(made, allowed=allowed((made.least, made.greatest)))


FREQUENCY_SOURCE = Enum(
    "frequency_source",
    (Entry(0, "keypad", titles("Keypad", "Bedienfeld"), None), entry(1, "terminal"), entry(10, "logic")),
    True,
)
FILTER_MODE = Enum("filter_mode", (entry(17, "dead_band", "16 samples, dead band", "500 ms"),), False)
TEMPERATURE_MODE = Enum("temperature_mode", (entry(-1, "cold", "Cold */ \\"), entry(2, "hot")), True)


def plain_points() -> tuple[Point, ...]:
    """Points of every form whose meaning needs no other point."""
    return (
        point("run_command", 0, "bit", space="coil"),
        point("running", 13, "bit", space="coil", access="r"),
        point(
            "base_frequency",
            0x1028,
            code="A020",
            title=titles("Base frequency", "Basisfrequenz"),
            references={"modicon": 4137, "reference": 404137},
            allowed=allowed((0, 4000)),
            unit=HERTZ,
            scale=scaled(10),
            decimals=1,
            set=1,
            default=Fraction(50),
            default_raw=500,
            was=("main_frequency",),
            errata=("a020_wire",),
            keeps="enter",
        ),
        point(
            "frequency_source",
            0x1018,
            code="A001",
            enum=FREQUENCY_SOURCE,
            allowed=allowed((0, 1), (10, 10), listed=True),
        ),
        point("temperature_mode", 0x1030, "s16", enum=TEMPERATURE_MODE, allowed=allowed((-1, -1), (2, 2), listed=True)),
        point("analog_filter", 0x1025, enum=FILTER_MODE, allowed=allowed((1, 17)), conditions=("stopped",)),
        point(
            "acceleration_time",
            0x1013,
            "u32",
            code="F002",
            allowed=allowed((1, 300000)),
            unit=SECOND,
            scale=scaled(100),
            decimals=2,
            steps=((1, 1), (10000, 10)),
        ),
        point("signed_one", 0x2022, "s16", access="r"),
        point("swapped_count", 0x2000, "u32", access="r", order=(0x2001, 0x2000)),
        point("power_factor", 0x2002, "s16", allowed=allowed((-99, -70), (70, 100)), scale=scaled(100), decimals=2),
        point(
            "temperature",
            0x2003,
            "s16",
            allowed=allowed((-400, 1250)),
            unit=CELSIUS,
            scale=scaled(10, "5/2"),
            decimals=1,
            specials=(Special(0x7FFF, 0x7FFF, "no_sensor", titles("No sensor"), True),),
        ),
        point("frequency_fine", 0x2004, unit=HERTZ, scale=scaled(256), decimals=3),
        point("pulse", 0x2005, unit=MILLISECOND, scale=scaled("1/2"), allowed=allowed((5, 125))),
        point("third", 0x2006, scale=scaled("3/7"), decimals=1, allowed=allowed((0, 30000))),
        point("inverse", 0x200F, "s16", scale=scaled(-10), decimals=1, allowed=allowed((-100, 50)), unit=HERTZ),
        point("energy", 0x201C, "s64", access="r", scale=scaled(1000), decimals=3),
        point("delay_class", 0x2012, "u8", bits=(15, 14), allowed=allowed((0, 0), (3, 3), listed=True)),
        point("signed_byte", 0x2012, "s8", bits=(13, 6), allowed=allowed((-9, 9))),
        point("float_setpoint", 0x2014, "f32", unit=HERTZ, allowed=units(0, 650), order=(0x2015, 0x2014)),
        point("double_actual", 0x2018, "f64", access="r"),
        point("status_word", 0x2010, access="r", flags=STATUS_FLAGS),
    )


STATUS_FLAGS = (
    Flag(0, 1, "ready", titles("Ready", "Bereit"), 1, ()),
    Flag(3, 1, "fault", titles("Fault"), 0, ()),
    Flag(4, 2, "mode", titles("Mode"), 1, (entry(0, "stop"), entry(3, "run"))),
)


def dependent_points() -> tuple[Point, ...]:
    """Points whose scale or range needs others, variants, and points that are only documented."""
    frequency: dict[str, Any] = {"unit": HERTZ, "scale": scaled(10), "decimals": 1}
    inactive = (Special(0, 0, "inactive", titles("Inactive"), False, writable=True),)
    lowest = Limit(linear(1, 0, value_of("lower_limit")), (("lower_limit", ((0, 0),)),), 0, 4000)
    start = Limit(linear(1, 0, value_of("start_frequency")), (), 5, 99)
    highest = Limit(linear(1, 0, value_of("upper_limit")), (("upper_limit", ((0, 0),)),), 0, 4000)
    exponent = value_of("power_exponent", -1, ten_to=True)
    by_mode = (
        ScaleCase("unit_mode", 0, linear(16384, 0, value_of("reference_frequency", -1))),
        ScaleCase("unit_mode", 1, linear(100)),
    )
    volts: dict[str, Any] = {"code": "b131", "unit": VOLT}
    return (
        point("voltage_ratio", 0x2007, allowed=allowed((50, 480)), unit=VOLT),
        point("voltage_setpoint", 0x2008, unit=VOLT, scale=scaled("1/400", 0, value_of("voltage_ratio"))),
        point("power_exponent", 0x2009, "s16", access="r", allowed=allowed((-9, 9))),
        point("power", 0x200A, "s16", access="r", unit=WATT, scale=scaled(1, 0, exponent)),
        point("unit_mode", 0x200B, allowed=allowed((0, 1))),
        point("setpoint", 0x200C, "s16", unit=HERTZ, scale=by_mode, decimals=4, allowed=allowed((-20000, 20000))),
        point("reference_frequency", 0x200D, unit=HERTZ, allowed=allowed((1, 650))),
        point("start_frequency", 0x10D0, code="b082", allowed=allowed((5, 99)), **frequency),
        point("upper_limit", 0x1059, specials=inactive, allowed=allowed((lowest, 4000)), **frequency),
        point("lower_limit", 0x105A, specials=inactive, allowed=allowed((start, highest)), **frequency),
        point("dc_level", 0x10F5, variant=VARIANTS[0], allowed=allowed((330, 390)), **volts),
        point("dc_level", 0x10F5, variant=VARIANTS[1], allowed=allowed((660, 780)), **volts),
        point("setpoint_display", None, code="F001", errata=("f001_address",), **frequency),
        point("baud_rate", 0x1137, access="none", generated=False, reason="not reachable over the bus"),
    )


def sample_bus() -> Bus:
    """A bus with the functions of a small drive."""
    functions = (
        Code(1, "read_coils", titles("Read coils"), 32),
        Code(3, "read_holding_registers", titles("Read holding registers"), 4),
        Code(5, "write_coil", titles("Write coil"), 1),
        Code(6, "write_register", titles("Write register"), 1),
        Code(8, "diagnostics", titles("Loop back"), None),
        Code(15, "write_coils", titles("Write coils"), 32, broadcast=False),
        Code(16, "write_registers", titles("Write registers"), 4),
    )
    exceptions = (Code(0x21, "value_out_of_range", titles("Value out of range"), None),)
    gaps = {"holding": ((0x30, 0x8FF),)}
    return Bus(
        *(("rtu", "tcp"), (1, 32), 0, functions, exceptions, gaps),
        *({"silent_characters": "3.5"}, {"baud": {"4": "4800"}}, {}, ModbusBus("even")),
    )


ERRATA = (
    Erratum(
        "a020_wire",
        ("base_frequency",),
        "",
        SOURCE,
        "wire 4137",
        "wire 4136",
        "Hex is right.",
        "certain",
        (("wire", "4137"),),
    ),
    Erratum("f001_address", ("setpoint_display",), "", SOURCE, "No address.", "at: ~", "An empty cell.", "unknown"),
    Erratum(
        "write_crc",
        (),
        Named("frame", "write_base"),
        SOURCE,
        "crc A8 54",
        "crc 0C 91",
        "The CRC of the bytes.",
        "certain",
    ),
)


def doubts(text: str, *points: str) -> tuple[Erratum, Erratum]:
    """Errata that leave something open, of points and of the device."""
    one = Erratum("doubt", points, "", SOURCE, "1", "2", "", "unknown", (), (("type", text),))
    return one, replace(one, id="other_doubt", points=())


def sample_device(points: tuple[Point, ...] | None = None) -> Device:
    """A drive with the given points, or with one of every kind."""
    wrong, right = bytes.fromhex("0506102801F4A854"), bytes.fromhex("0506102801F40C91")
    meaning = {"base_frequency": 500}
    frame = Frame(
        *("write_base", "rtu", "request", None, wrong, right, False, meaning),
        *(titles("Write 50 Hz"), SOURCE, ("write_crc",)),
    )
    command = Command("enter", titles("Store parameters"), {}, "holding", 0x900, 6, None, 100000, "running", SOURCE)
    named = plain_points() + dependent_points() if points is None else points
    has_block = any(point.name == "acceleration_time" for point in named)
    return Device(
        id="sample_drive",
        version="1.2.0",
        vendor="Acme",
        model="S1",
        title=titles("Sample drive", "Beispiel"),
        note={},
        family="modbus",
        documents=(Document("manual", "Sample manual", "de", None, None),),
        variants={"voltage_class": ("200V", "400V")},
        bus=sample_bus(),
        groups=(Group("main", titles("Main", "Haupt"), {}, SOURCE),),
        points=named,
        enums=(FREQUENCY_SOURCE, FILTER_MODE, TEMPERATURE_MODE),
        blocks={"main": (Block("holding", 3, 0x1013, 2, ("acceleration_time",)),)} if has_block else {},
        commands=(command,),
        frames=(frame,),
        errata=ERRATA,
        digest="0123456789abcdef" * 4,
    )


def enums_of(points: tuple[Point, ...]) -> tuple[Enum, ...]:
    """All enums that points use, each once."""
    used = [enum for one in points if (enum := one.named_numbers)]
    return tuple({enum.name: enum for enum in used}.values())


def device_of(name: str, points: tuple[Point, ...], **facts: Any) -> Device:
    """A device of these points and their enums; but for its facts it is the sample."""
    bare: dict[str, Any] = {"enums": enums_of(points), "blocks": {}, "frames": (), "commands": (), "errata": ()}
    return replace(sample_device(points), id=name, **{**bare, **facts})


def trip_device() -> Device:
    """A 16-bit point for each kind of rule, whose every raw number may be written."""
    points = (
        point("tenth", 0, scale=scaled(10), decimals=1),
        point("fine", 1, scale=scaled(256), decimals=3),
        point("sevenths", 2, scale=scaled("3/7"), decimals=1),
        point("falling", 3, "s16", scale=scaled(-10), decimals=1),
        point("shifted", 4, "s16", scale=scaled(10, "5/2"), decimals=2),
    )
    return device_of("trips", points)


def named(device: Device, item: str) -> Point:
    """The point whose generated items have that name."""
    return next(one for one in device.points if one.item == item)
