"""The shipped units: prefixes with exact factors, and hints that never lead to another magnitude or quantity."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction

import pytest
from fieldscribe.cli import main
from fieldscribe.conversation.explanation import explain_other_items
from fieldscribe.language.units import factor_between, shipped, shipped_unit, unit_hint
from fieldscribe.model import Unit
from support.models import point, sample_device


@pytest.mark.parametrize(
    ("symbol", "name", "base", "factor"),
    [
        ("mW", "milliwatt", "W", Fraction(1, 1000)),
        ("kVAh", "kilovolt-ampere-hour", "VAh", Fraction(1000)),
        ("µA", "microampere", "A", Fraction(1, 10**6)),
        ("mH", "millihenry", "H", Fraction(1, 1000)),
        ("hPa", "hectopascal", "Pa", Fraction(100)),
        ("kg", "kilogram", "g", Fraction(1000)),
        ("ppm", "part per million", "ppm", Fraction(1)),
        ("Mvar", "megavolt-ampere reactive", "var", Fraction(10**6)),
    ],
)
def test_prefixes_of_known_units_are_known(symbol: str, name: str, base: str, factor: Fraction) -> None:
    known = shipped()[symbol]
    assert (known.unit.name, known.base, known.factor) == (name, base, factor)


def test_both_characters_for_micro_are_one() -> None:
    assert shipped_unit("\u03bcs") == shipped_unit("\u00b5s") is not None


@pytest.mark.parametrize(
    ("typed", "hint"),
    [
        ("hz", "write `Hz`"),
        ("KW", "write `kW`"),
        ("kva", "write `kVA`"),
        ("us", "write `µs`"),
        ("uA", "write `µA`"),
        ("kΩ", "write `kohm`"),
        ("volts", "write `V`"),
        ("Millivolt", "write `mV`"),
        ("degC", "write `°C`"),
        ("m3/h", "write `m³/h`"),
        ("U/min", "write `rpm`"),
        ("mw", "write `mW` (milliwatt) or `MW` (megawatt)"),
        ("none", "a plain number has no unit: leave `unit` out"),
        ("-", "a plain number has no unit: leave `unit` out"),
    ],
)
def test_what_is_spelled_otherwise_is_named(typed: str, hint: str) -> None:
    assert unit_hint(typed, ()) == hint


@pytest.mark.parametrize(
    "typed", ["PW", "M", "G", "D", "mh", "kmin", "rmp", "furlong", "MM", "kva/h", "ppt", "mbat", "MBAR", "Wj"]
)
def test_nothing_is_suggested_that_only_looks_alike(typed: str) -> None:
    assert unit_hint(typed, ()).startswith("declare it under `units`: ")


def _typed_otherwise() -> Iterator[str]:
    for symbol in shipped():
        yield from {symbol.lower(), symbol.upper(), symbol.swapcase(), symbol.capitalize()} - set(shipped())


def test_no_hint_names_another_magnitude_alone() -> None:
    """Whatever case somebody types: a prefix that was typed is among those suggested, or none is."""
    for typed in _typed_otherwise():
        hint = unit_hint(typed, ())
        if hint.startswith("write `"):
            suggested = [part.split("`")[1] for part in hint.removeprefix("write ").split(" or ")]
            prefixes = [shipped()[one].prefix for one in suggested]
            assert "" in prefixes or typed[0] in prefixes or typed[0] not in "pnµmcdhkMGTP", (typed, hint)


def test_a_unit_of_the_description_is_suggested_too() -> None:
    assert unit_hint("POLES/S", ["poles/s"]) == "write `poles/s`"


def test_factors_lead_from_one_prefix_to_another() -> None:
    kilowatt = shipped()["kW"].unit
    assert factor_between("mW", kilowatt) == Fraction(1, 10**6)
    assert factor_between("VA", kilowatt) is None
    assert factor_between("furlong", kilowatt) is None


def test_a_value_may_have_another_prefix(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["encode", "hitachi_l200", "A020", "50000 mHz"]) == 0
    assert "50 Hz: raw 500" in capsys.readouterr().out


def test_they_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["units"]) == 0
    assert "W        watt (power); also nW, µW, mW, kW" in capsys.readouterr().out
    assert main(["units", "--format", "json"]) == 0
    assert {unit["symbol"] for unit in json.loads(capsys.readouterr().out)["units"]} == set(shipped())


def test_a_unit_in_the_wrong_case_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "hitachi_l200", "unit:hz"]) == 2
    assert "write `Hz`" in capsys.readouterr().err


@pytest.mark.parametrize(("count", "rest"), [(0, ""), (1, ""), (20, ""), (21, " and 1 more"), (30, " and 10 more")])
def test_a_unit_names_its_first_points(count: int, rest: str) -> None:
    hertz = Unit("Hz", "hertz", "frequency")
    points = (*(point(f"p_{at}", at, unit=hertz) for at in range(count)), point("other", 99))
    ((readings, explanation),) = explain_other_items(sample_device(points), "unit:Hz")
    rows = dict(explanation.rows)
    assert (readings, explanation.heading) == (["unit Hz"], "Hz: hertz")
    assert rows["Quantity"] == "frequency"
    assert rows["Points"] == (", ".join(f"p_{at}" for at in range(min(count, 20))) + rest or "none")
