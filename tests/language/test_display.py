"""`display: {decimals: 2}`: with how many decimals people see a value, wherever texts are made of it."""

from __future__ import annotations

import random
import re
from contextlib import contextmanager
from dataclasses import replace
from decimal import ROUND_HALF_UP, Decimal, localcontext
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.conversation.explanation import explain_point
from fieldscribe.conversation.meanings import Meanings
from fieldscribe.resources import render
from fieldscribe.targets import c, docs, rust
from fieldscribe.wording import meaning_text
from fieldscribe.wording.numbers import rounded
from support.described import kitchen_sink
from support.models import changed, named
from support.places import TESTS
from support.python_package import imported, write_package

DEVICE = kitchen_sink()
KITCHEN = str(TESTS / "devices/kitchen_sink")
SEED = 20261122


@pytest.mark.parametrize(
    ("item", "decimals"),
    [
        ("shown_frequency", 2),  # of the group
        ("shown_current", 0),  # its own
        ("shown_heat", 1),  # of its format, which comes before the group
        ("shown_heat_set_2", 3),  # of the further set
        ("shown_mode", None),  # a group speaks of its quantities
        ("shown_done", None),
        ("speed", None),  # nobody says it
    ],
)
def test_who_says_it(item: str, decimals: int | None) -> None:
    assert named(DEVICE, item).display == decimals


def test_rounding_is_to_nearest_with_halves_away_from_zero() -> None:
    """As the decimal module rounds, and trailing zeros stay; nothing is negative that rounds to zero."""
    chance = random.Random(SEED)
    with localcontext() as context:
        context.prec = 60
        for _ in range(2000):
            number, places, decimals = chance.randint(-(10**9), 10**9), chance.randint(0, 9), chance.randint(0, 9)
            exact = Decimal(number).scaleb(-places)
            nearest = exact.quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_UP)
            assert rounded(number, 10**places, decimals) == f"{abs(nearest) if nearest == 0 else nearest:f}"
    assert [rounded(*one) for one in ((50, 1, 2), (1, 8, 2), (-1, 8, 2), (-1, 1000, 2), (5, 2, 0))] == [
        *("50.00", "0.13", "-0.13", "0.00", "3")
    ]


@pytest.mark.parametrize(
    ("item", "raw", "settings", "text"),
    [
        ("shown_frequency", 5000, {}, "50.00 Hz"),
        ("shown_current", 15, {}, "2 A"),
        ("shown_eighths", -1, {}, "-0.13"),
        ("shown_hours", 7, {}, "7.00 h"),
        ("shown_f32", 0x3E000000, {}, "0.13 kW"),
        ("shown_f32", 0x7FC00000, {}, "nan"),
        ("shown_heat", 0x7FFF, {}, "no_sensor (No sensor), no value"),
        ("shown_load", 8192, {"rated_current": 333}, "3.33 A"),
        ("speed", 500, {}, "50 Hz"),
    ],
)
def test_decode_says_it(item: str, raw: int, settings: dict[str, int], text: str) -> None:
    assert Meanings(DEVICE, named(DEVICE, item)).text(raw, settings) == text


def test_the_exact_value_stays_beside_its_text() -> None:
    """What programs take out of `decode` is not rounded."""
    assert Meanings(DEVICE, named(DEVICE, "shown_eighths")).of(1, {}).value == "0.125"


def test_a_plain_number_has_a_text_of_its_own() -> None:
    point = named(DEVICE, "shown_hours")
    assert meaning_text(changed(point, unit=replace(point.unit, symbol="")), 7) == "7.00"


def test_explain_and_encode_say_it(capsys: pytest.CaptureFixture[str]) -> None:
    rows = dict(explain_point(DEVICE, named(DEVICE, "shown_frequency")).rows)
    assert rows["Shown with"] == "2 decimals"
    assert "for example 50.00 Hz is raw 5000" in rows["Write"]
    assert "Shown with" not in dict(explain_point(DEVICE, named(DEVICE, "speed")).rows)
    assert main(["encode", KITCHEN, "shown_eighths", "0.375"]) == 0
    assert capsys.readouterr().out == "shown_eighths = 0.38: raw 3 = 0003h\n"


def test_targets_say_it() -> None:
    """A constant and a comment in C, the fact and the documentation in Rust, a remark in the table."""
    header = dict(c.outputs(DEVICE, render))["c/kitchen_sink.h"]
    assert "#define KITCHEN_SINK_SHOWN_CURRENT_DISPLAY_DECIMALS 0\n" in header
    assert "shown with no decimals" in header
    points = "".join(dict(rust.outputs(DEVICE, render)).values())
    assert "    display 2;\n" in points
    assert "shown with 2 decimals" in points
    table = dict(docs.outputs(DEVICE, render))["docs/kitchen_sink.md"]
    assert re.search(r"shown_heat`.*shown with 1 decimal\b(?!s)", table)


def test_python_says_it(tmp_path: Path) -> None:
    """In representations, in help, and as the text of a value; messages stay exact."""
    with contextmanager(imported)(write_package(DEVICE, tmp_path), DEVICE.id) as module:
        points = module.points.Points
        assert repr(points.shown_frequency).endswith(": holding 0x5000, shown with 2 decimals>")
        assert repr(points.shown_heat).endswith(", shown with 1 decimal>")
        assert "shown" not in repr(points.speed).partition(":")[2]
        texts = points.shown_frequency.text(50.0), points.shown_frequency.text(0.125), points.speed.text(50.0)
        assert texts == ("50.00 Hz", "0.13 Hz", "50 Hz")
        heat = points.shown_heat
        assert (heat.text(heat.decode(0x7FFF)), heat.text(20.05)) == ("no_sensor", "20.0 °C")
        assert points.shown_load.text(1.0, {"rated_current": 333}) == "1.00 A"
        assert points.mode.text(points.mode.decode(0)) == points.mode.told(0)
        assert (points.shown_eighths.told(1), points.shown_eighths.told_exactly(1)) == ("0.13", "0.125")
