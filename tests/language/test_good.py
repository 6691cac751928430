"""The kitchen sink: what becomes of every mechanism of the language, against expectations written by hand."""

from __future__ import annotations

from fractions import Fraction

import pytest
from fieldscribe.model import Factor, Limit, Linear, Named, Point
from support.described import kitchen_sink


def point(item: str) -> Point:
    """A point by its item name."""
    return next(one for one in kitchen_sink().points if one.item == item)


def rule(item: str) -> Linear:
    """The rule of a point with one scale."""
    cases = point(item).scale
    assert cases is not None
    assert len(cases) == 1
    return cases[0].rule


def ranges(item: str) -> list[tuple[object, object]]:
    """The intervals of a point."""
    return [(one.low, one.high) for one in point(item).allowed.intervals]


def limit(bound: object) -> Limit:
    """A bound that other points set."""
    assert isinstance(bound, Limit)
    return bound


@pytest.mark.parametrize(
    ("item", "addresses"),
    [
        ("plain_u32", (2, 3)),
        ("plain_s64", (13, 12, 11, 10)),  # `words: {s64: low first}` under bus
        ("plain_f32", (15, 14)),
        ("open_f32", (20, 21)),  # says otherwise
        ("low_first_u32", (23, 22)),
        ("plain_u64", (6, 7, 8, 9)),
        ("event_1_uptime", (0x402, 0x403)),  # base + 2 * 1
        ("event_2_heat", (0x414,)),
        ("event_3_heat", ()),
        ("acceleration_set_2", (0x520,)),
        ("undocumented_place", ()),
    ],
)
def test_addresses(item: str, addresses: tuple[int, ...]) -> None:
    """The word with the high part comes first."""
    assert point(item).addresses == addresses


def test_references() -> None:
    """Numberings build on each other."""
    assert point("plain_u32").references == {"modicon": 3, "reference": 400003}
    assert point("speed").references == {}


@pytest.mark.parametrize(
    ("item", "ratio", "offset"),
    [
        ("speed", "10", "0"),
        ("from_value", "256", "0"),
        ("offset", "10", "400"),
        ("falling", "-10", "1000"),
        ("third", "3", "0"),
        ("hex_factor", "16384/100", "0"),
        ("ratio", "2", "0"),
    ],
)
def test_scales(item: str, ratio: str, offset: str) -> None:
    """raw = value * ratio + offset, however it was written."""
    assert rule(item) == Linear(Fraction(ratio), Fraction(offset), ())


def test_run_time_factors() -> None:
    """Values and raw numbers of other points, powers of ten, and sums over one point."""
    value = Factor("rated_current", 1, 0, -1, False)
    assert rule("current") == Linear(Fraction(0x2000 * 100), Fraction(0), (value,))
    exponent = Factor("power_exponent", 1, 0, -1, True, (-3, 3))
    assert rule("power") == Linear(Fraction(1), Fraction(0), (exponent,))
    assert rule("energy") == Linear(Fraction(28), Fraction(0), (value, exponent))
    assert rule("shifted") == Linear(Fraction(1, 10), Fraction(0), (Factor("rated_current", 1, 5, 1, False),))


def test_scale_cases() -> None:
    """Another point chooses the rule, by its raw number."""
    cases = point("reference_value").scale
    assert cases is not None
    assert [(case.point, case.raw, case.rule.ratio) for case in cases] == [
        ("mode", 0, Fraction("163.84")),
        ("mode", 3, Fraction(100)),
    ]


@pytest.mark.parametrize(
    ("item", "decimals"),
    [("speed", 1), ("from_value", 3), ("third", 4), ("power", 3), ("coarse", 2), ("plain_u16", 0), ("current", 6)],
)
def test_decimals(item: str, decimals: int) -> None:
    """The smallest number of decimals at which no raw number is lost, or the author's."""
    assert point(item).decimals == decimals


@pytest.mark.parametrize(
    ("item", "expected"),
    [
        ("one_interval", [(5, 10)]),
        ("two_intervals", [(-99, -70), (70, 100)]),
        ("listed", [(0, 3), (10, 10)]),
        ("single", [(7, 7)]),
        ("in_units", [(15, 25)]),
        ("offset", [(0, 1400)]),
        ("falling", [(0, 1000)]),  # 100 % is raw 0
        ("by_variant_230v", [(200, 240)]),
        ("by_variant_400v", [(380, 480)]),
        ("mode", [(0, 1), (3, 3)]),
        ("command_source", [(0, 0x20)]),
        ("second_source", [(0, 0xFFFF)]),
        ("third_source", [(0, 1), (0x10, 0x10)]),
        ("with_codes", [(0, 1000)]),
        ("trim", [(-4, 3)]),
        ("switch_a", [(0, 0), (3, 3)]),
        ("lock", [(0, 1)]),
        ("event_1_heat", [(-32768, 32766)]),
        ("plain_f32", []),
        ("acceleration_set_3", [(1, 6000)]),
    ],
)
def test_ranges(item: str, expected: list[tuple[int, int]]) -> None:
    """Raw numbers that may be written."""
    assert ranges(item) == expected


def test_limits_that_limit_each_other() -> None:
    """Their outer bounds are the fixed ends of the circle."""
    [(low, high)] = ranges("base_frequency")
    assert low == 30
    assert (limit(high).least, limit(high).greatest) == (30, 400)
    [(low, high)] = ranges("lower_limit")  # 0 is a special code
    assert low == 5
    assert limit(high).rule == Linear(Fraction(1), Fraction(0), (Factor("upper_limit", 1, 0, 1, False),))
    assert limit(high).unless == (("upper_limit", ((0, 0),)),)  # no limit while it is inactive
    assert limit(high).greatest == 4000


def test_limit_below_the_line() -> None:
    """A limit that divides by a point."""
    [(_, high)] = ranges("inverse_limit")
    assert limit(high).rule.factors == (Factor("base_frequency", 1, 0, -1, False),)
    assert (limit(high).least, limit(high).greatest) == (100, 1333)


def test_units_of_floats() -> None:
    """Floating-point points have limits in their unit."""
    assert point("plain_f32").allowed.units == ((Fraction("-100.5"), Fraction("100.5")),)
    assert point("plain_f64").allowed.units == ()


def test_enums() -> None:
    """Closed and open ones of one name, sets that share one, and one that has its own."""
    names = {one.name: one for one in kitchen_sink().enums}
    assert {"mode", "source", "on_off", "event_code", "set_choice", "set_choice_set_3"} <= names.keys()
    mode = point("mode").enum
    assert mode is not None
    assert mode.closed
    assert [(one.raw, one.name, one.quantity) for one in mode.entries] == [
        (0, "manual", None),
        (1, "stepwise", None),
        (3, "automatic", "0.37 kW"),
    ]
    assert mode.entries[0].title == {"en": "By hand", "de": "Hand"}
    assert point("mode").default == 3
    shared = [point(one).enum for one in ("command_source", "second_source", "third_source")]
    assert [one is not None and one.closed for one in shared] == [False, False, True]


def test_flags() -> None:
    """Bits of a word with names."""
    flags = {one.name: one for one in point("status_word").flags}
    assert [(one.low, one.width, one.active) for one in flags.values()] == [(0, 1, 1), (3, 1, 0), (4, 2, 1), (15, 1, 1)]
    assert [(one.raw, one.name, one.title) for one in flags["ready"].values] == [
        (0, "zero", {"en": "not ready"}),
        (1, "one", {"en": "ready"}),
    ]
    assert [one.name for one in flags["gear"].values] == ["neutral", "forward", "backward"]


def test_specials() -> None:
    """Codes and bands of codes beside the numbers, then those that mean that there is no value."""
    assert [(one.low, one.high, one.name, one.no_value) for one in point("with_codes").specials] == [
        (0x7FFE, 0x7FFE, "overload", False),
        (65000, 65535, "band", False),
        (0x7FFF, 0x7FFF, "no_value", True),
        (0xFDE7, 0xFDE7, "not_fitted", True),
    ]


def test_what_repeats() -> None:
    """Records and sets are points of their own, with titles that say so."""
    assert point("event_1_code").title == {"en": "Last event: Code", "de": "Letztes Ereignis: Kennung"}
    assert point("event_1_code").source.line == 12
    assert [one.code for one in kitchen_sink().points if one.record == "event_1"] == ["d081"] * 3
    assert point("acceleration_set_2").title == {"en": "Acceleration (set 2)"}
    assert point("acceleration_set_3").title == {"en": "Third acceleration"}
    assert [point(item).set for item in ("acceleration", "acceleration_set_2", "acceleration_set_3")] == [1, 2, 3]
    assert point("acceleration").was == ("ramp_up",)
    assert point("acceleration_set_2").was == ("ramp_up_set_2",)


def test_inheritance() -> None:
    """What the group says holds unless the point says otherwise."""
    assert [point(one).keeps for one in ("one_interval", "single", "in_units")] == ["store", "yes", "no"]
    assert point("one_interval").conditions == ("stopped", "unlocked")
    assert point("event_1_heat").keeps is None
    assert point("door_open").space == "discrete"
    assert point("storing").type == "bit"
    assert point("trim").info.signed
    assert point("speed").access == "rw"


@pytest.mark.parametrize(
    ("item", "reason"),
    [
        ("undocumented_place", "the manual prints no address"),
        ("unreachable", "not reachable over the bus"),
        ("kept_back", "reserved by the maker"),
        ("unsettled", "the manual does not settle its scale"),
        ("event_3_code", "the manual prints no address"),
    ],
)
def test_documented_only(item: str, reason: str) -> None:
    """What cannot be generated says why."""
    assert (point(item).generated, point(item).reason) == (False, reason)


def test_sources() -> None:
    """From the group, or the point's own."""
    assert (point("run").source.document, point("run").source.section, point("run").source.page) == ("manual", "1", "5")
    assert point("event_2_heat").source.document == "addendum"


def test_errata() -> None:
    """They reach the points and frames that they are about."""
    assert point("address_misprinted").errata == ("address_misprinted_decimal", "address_misprinted_choices")
    assert [one.where for one in kitchen_sink().errata if not one.points] == [
        Named("frame", "start_misprinted"),
        "table 3: modes",
        Named("function", 8),
    ]
    frame = next(one for one in kitchen_sink().frames if one.name == "start_misprinted")
    assert (frame.valid, frame.errata) == (False, ("start_crc",))
    assert frame.corrected.hex() == "01050000ff008c3a"


def test_frames() -> None:
    """Their meaning is in raw numbers, in either framing."""
    frames = {one.name: one for one in kitchen_sink().frames}
    assert frames["read_speed_reply"].meaning == {"speed": 500}
    assert frames["write_mode"].meaning == {"mode": 3}
    assert frames["start"].meaning == {"run": 1}
    assert frames["tcp_read_reply"].framing == "tcp"
    assert frames["tcp_read_reply"].meaning == {"speed": 10}
    assert all(one.valid for one in frames.values() if one.name != "start_misprinted")


def test_bus() -> None:
    """Limits, gaps and quirks of the device."""
    bus = kitchen_sink().bus
    assert [(one.number, one.most) for one in bus.functions][:4] == [(1, 64), (2, 64), (3, 16), (4, None)]
    assert bus.gaps == {"holding": ((2000, 2000), (0x800, 0xFFF)), "input": ((100, 199),)}
    assert bus.units == (1, 247)
    assert [(one.name, one.address, one.value) for one in kitchen_sink().commands] == [
        ("store", 0x700, None),
        ("restart", 0x40, 1),
        ("switch_on", 0x1C11, 0x401),
    ]
