"""Points wider than a double or than every count: what they have, and that it is exact; what they lack says so."""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction
from math import isnan
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.arithmetic.codec import decode, setting_of
from fieldscribe.arithmetic.exact import half_away
from fieldscribe.model import Point
from fieldscribe.resources import render
from fieldscribe.targets import docs
from support.c_device import WARNINGS, write_headers
from support.described import compile_in, described, kitchen_sink, loaded_in
from support.models import named
from support.python_package import error, imported, write_package
from support.toolchains import compiled, run, succeed, tool

DEVICE = kitchen_sink()
PATHS = {
    "energy_total": (None, False),
    "energy_balance": (None, False),
    "long_distance": (None, False),
    "thirds": (None, False),
    "uneven_voltage": (None, True),
    "fine_steps": (None, True),
    "odd_ratio": (None, True),
    "limited_total": (3, True),
    "steep_balance": (1, True),
    "sixteenths": (None, False),
}
"""Decimals of the counts, and whether values are encoded."""

RUN_TIME = {
    "metered_energy": (None, False),
    "metered_total": (None, False),
    "metered_balance": (None, False),
    "limited_meter": (1, False),
    "pulse_total": (None, False),
    "gained_total": (None, False),
}
"""The same of scales that other points decide at run time."""

WIDE = tuple(PATHS)
SEED = 20261122


@pytest.mark.parametrize("item", [*PATHS, *RUN_TIME])
def test_what_a_point_has(item: str) -> None:
    """An honest fact never fails to compile for its width: the model says which ways to compute there are."""
    point = named(DEVICE, item)
    assert (point.decimals, point.encodes_values) == {**PATHS, **RUN_TIME}[item]


BEYOND = """\
- {name: a, at: 0, scale: value = raw / 123456789012345678901234567}
- {name: first, at: 1, type: u32}
- {name: second, at: 3, type: u32}
- {name: b, at: 5, type: u64, scale: value = raw * first * second}
- {name: exponent, at: 9, type: s16, range: -9..9}
- {name: c, at: 10, type: u64, access: r, scale: value = raw * first * 10 ** exponent}
- {name: d, at: 14, type: s64, scale: value = raw / first}
- {name: e, at: 18, type: u64, access: w, scale: value = raw * 10 ** exponent}
"""


def test_a_scale_beyond_every_integer_leaves_raw_numbers(tmp_path: Path) -> None:
    """No error either: the words are reached by their address, the reason is told, and so is what would give values."""
    device, findings = compile_in(tmp_path, described(BEYOND, device="meter"))
    assert device is not None
    assert [(one.rule, one.hint) for one in findings if one.rule == "wide-scale"] == [
        ("wide-scale", "for values take the unit with another prefix (kW, mm), which brings the factor nearer to 1"),
        ("wide-scale", "for values give `first` and `second` a narrower `range` that ends at 2147483647 at most"),
    ]
    assert all(named(device, item).raw_only for item in ("a", "b"))
    text = (write_headers(device, tmp_path) / "c" / "meter.h").read_text("utf-8")
    assert "not generated: its scale needs integers of more than 63 bits" in text
    assert "#define METER_A_ADDRESS" in text
    program = tmp_path / "program.c"
    program.write_text(
        '#include "meter.h"\n'
        "int main(void) { const meter_with_exponent_and_first with = {0, 1}; double value; "
        "return (int)meter_c_decode(1, &with, &value); }"
    )
    for switch in ("-O2", "-DFIELDSCRIBE_FLOAT32"):
        succeed(
            [compiled("gcc", ("-std=c99", switch, *WARNINGS, "-I", str(tmp_path / "c")), program, tmp_path / "run")]
        )


SURVIVORS = """
  - {{name: subject, at: 0, type: u64, range: 0..{most}, scale: {scale}}}
"""


@pytest.mark.parametrize(
    ("scale", "top", "bottom", "offset"),
    [
        ("value = raw / 3", 3, 1, 0),
        ("value = raw * 0.1 * 3", 10, 3, 0),
        ("value = raw / 7 + 1234", 7, 1, -8638),
        ("value = raw * 1234567 / 9", 9, 1234567, 0),
    ],
)
def test_every_raw_number_survives_its_value(scale: str, top: int, bottom: int, offset: int, tmp_path: Path) -> None:
    """What encodes values finds each raw number again, in the steps of all languages; without, it might not."""
    for exponent, encodes in ((50, True), (53, False)):
        most = (1 << exponent) - 20000
        device = loaded_in(tmp_path, described(SURVIVORS.format(most=most, scale=scale)))
        assert device.points[0].encodes_values == encodes
        draw = random.Random(SEED)
        raws = [draw.randrange(most // 2, most) for _ in range(4000)]
        values = [float(Fraction((raw - offset) * bottom, top)) for raw in raws]
        found = [half_away(Fraction(value * top / bottom + offset)) for value in values]
        assert (found == raws) == encodes


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_headers(DEVICE, tmp_path_factory.mktemp("wide")) / "c"


def test_c_has_only_what_is_exact(folder: Path) -> None:
    text = (folder / "kitchen_sink.h").read_text("utf-8")
    for item, (decimals, encodes) in {**PATHS, **RUN_TIME}.items():
        point = named(DEVICE, item)
        assert (f"{item}_decode_count(" in text) == (decimals is not None), item
        assert (f"{item}_encode(" in text) == (encodes and point.writable), item
        assert f"kitchen_sink_{item}_decode(" in text
    assert "no integer path: its counts need more than 64 bits" in text
    assert "values are only decoded: its numbers have more than 53 bits" in text


DECODES = """
#include <stdio.h>
#include "kitchen_sink.h"
int main(void)
{
    unsigned long long raw;
    unsigned which, first, second;
    while (scanf("%u %llu %u %u", &which, &raw, &first, &second) == 4) {
        double value = 0;
        int status = 0;
        switch (which) {
@CASES@
        default:
            return 1;
        }
        printf("%.17g\\n", status == 0 ? value : 0.0 / 0.0);
    }
    return 0;
}
"""


def raw_numbers(point: Point, rng: random.Random) -> Iterator[int]:
    """Ends, powers of two and what is beside them, and any numbers of any length."""
    for number in (point.least, point.greatest, 0, 1, (1 << 53) + 1, (1 << 54) + 2, (1 << 63) - 1):
        yield min(max(number, point.least), point.greatest)
    for _ in range(400):
        number = rng.getrandbits(rng.randint(1, point.width)) - (1 << 62 if point.info.signed else 0)
        yield min(max(number, point.least), point.greatest)


KINDS = {"u64": "uint64_t", "s64": "int64_t", "u32": "uint32_t", "u16": "uint16_t"}
Asked = list[tuple[int, int, int, int]]
"""Which point, its raw number, and those of what decides its scale."""


def decoded(asked: Asked, calls: list[str], folder: Path, into: Path) -> list[float]:
    """What C makes of raw numbers; NaN where it gives a status."""
    lines = [f"        case {which}U: {call}; break;" for which, call in enumerate(calls)]
    (into / "decodes.c").write_text(DECODES.replace("@CASES@", "\n".join(lines)), "utf-8")
    sanitized = ("-fsanitize=undefined", "-fno-sanitize-recover=all")
    program = compiled("gcc", ("-std=c99", "-O2", *sanitized, "-I", str(folder)), into / "decodes.c", into / "run")
    rows = [f"{which} {raw & (1 << 64) - 1} {first} {second}\n" for which, raw, first, second in asked]
    (into / "asked").write_text("".join(rows), "utf-8")
    return [float(text) for text in succeed(["sh", "-c", f'"{program}" <"{into / "asked"}"']).split()]


def test_every_raw_number_decodes_to_the_nearest_double(folder: Path, tmp_path: Path) -> None:
    """Also those beyond 53 bits, and those that no range allows."""
    rng = random.Random(SEED)
    asked = [(which, raw, 0, 0) for which, item in enumerate(WIDE) for raw in raw_numbers(named(DEVICE, item), rng)]
    calls = [f"value = kitchen_sink_{item}_decode(({KINDS[named(DEVICE, item).type]})raw)" for item in WIDE]
    for (which, raw, _, _), value in zip(asked, decoded(asked, calls, folder, tmp_path), strict=True):
        point = named(DEVICE, WIDE[which])
        assert point.scale is not None
        rule = point.scale[0].rule
        assert value == float((raw - rule.offset) / rule.ratio), (point.item, raw)


def decided(point: Point, rng: random.Random) -> dict[str, int]:
    """Raw numbers of the points that decide a scale: small ones, the largest, any; of the gain patterns near 1."""
    found = {}
    for name in point.scale_arguments:
        largest = named(DEVICE, name).greatest
        found[name] = rng.choice((1, 2, largest, rng.randint(1, largest)))
    if "pulse_mode" in found:
        found["pulse_mode"] = rng.randint(0, 1)
    if "meter_gain" in found:
        found["meter_gain"] = rng.randint(0x3F000000, 0x40FFFFFF) | rng.randint(0, 1) << 31
    return found


def test_scales_decided_at_run_time_decode_to_the_nearest_double(folder: Path, tmp_path: Path) -> None:
    """With every factor that the points can hold; beyond the largest raw number there is an overflow instead."""
    rng, names = random.Random(SEED), tuple(RUN_TIME)
    asked: Asked = []
    settings: list[dict[str, int]] = []
    for which, item in enumerate(names):
        for raw in raw_numbers(named(DEVICE, item), rng):
            settings.append(decided(named(DEVICE, item), rng))
            first, second = [*settings[-1].values(), 0][:2]
            asked.append((which, raw, first, second))
    calls = [_call(item) for item in names]
    for (which, raw, _, _), held, value in zip(asked, settings, decoded(asked, calls, folder, tmp_path), strict=True):
        point = named(DEVICE, names[which])
        if point.most_raw is not None and abs(raw) > point.most_raw:
            assert isnan(value), (point.item, raw, held)
        else:
            assert value == float(_exact(point, raw, held)), (point.item, raw, held)


def _call(item: str) -> str:
    point = named(DEVICE, item)
    places = [
        f"({KINDS.get(named(DEVICE, name).type, 'uint32_t')}){number}"
        for name, number in zip(point.scale_arguments, ("first", "second"), strict=False)
    ]
    if len(places) > 1:
        fields = "".join(
            f"with.{name}_raw = {place}; " for name, place in zip(point.scale_arguments, places, strict=True)
        )
        call = f"kitchen_sink_{item}_decode(({KINDS[point.type]})raw, &with, &value)"
        struct = f"kitchen_sink_with_{'_and_'.join(sorted(point.scale_arguments))}"
        return f"{{ {struct} with; {fields}status = (int){call}; }}"
    return f"status = (int)kitchen_sink_{item}_decode(({KINDS[point.type]})raw, {', '.join(places)}, &value)"


def _exact(point: Point, raw: int, held: dict[str, int]) -> Fraction:
    numbers = {name: setting_of(named(DEVICE, name), number) for name, number in held.items()}
    return decode(point, raw, numbers)


def test_misuse_does_not_compile_in_c(folder: Path, tmp_path: Path) -> None:
    for call in ("encode(1.0, &raw)", "encode_count(1, &raw)", "decode_count(1)"):
        body = f"uint64_t raw = 0; return (int)kitchen_sink_energy_total_{call};"
        text = f'#include "kitchen_sink.h"\nint main(void) {{ {body} }}\n'
        (tmp_path / "misuse.c").write_text(text, "utf-8")
        done = run([tool("gcc"), "-std=c99", *WARNINGS, "-I", folder, "-fsyntax-only", tmp_path / "misuse.c"])
        assert "implicit declaration" in done.stderr, call


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    yield from imported(write_package(DEVICE, tmp_path_factory.mktemp("wide_python")), "kitchen_sink")


def test_python_says_what_there_is_not(package: Any) -> None:
    total = package.KitchenSink.energy_total
    assert total.decode(3) == float(Fraction(3, 1000))
    assert total.decimals is None
    assert "energy_total" in str(error(total.encode, 1.0))
    for call, number, words in (
        (total.encode, 1.0, "values are only decoded: use raw numbers"),
        (total.encode_count, 1, "no 64-bit integer holds the counts"),
        (total.decode_count, 1, "no 64-bit integer holds the counts"),
        (package.KitchenSink.uneven_voltage.encode_count, 1, "no 64-bit integer holds the counts"),
    ):
        failure = error(call, number)
        assert (failure.status, isinstance(failure, TypeError)) == ("wrong_type", True)
        assert words in str(failure)
    assert package.KitchenSink.uneven_voltage.encode(1.0) == 31831


def test_documentation_says_what_there_is_not() -> None:
    pages = dict(docs.outputs(DEVICE, render))
    page = next(text for path, text in pages.items() if path.endswith(".md"))
    row = next(line for line in page.splitlines() if "energy\\_total" in line or "energy_total" in line)
    assert "no integer path" in row
    assert "values are only decoded" in row
