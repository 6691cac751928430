"""Points wider than a double or than every count: what they have, and that it is exact; what they lack says so."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest
from c_device import WARNINGS, write_headers
from fieldscribe.render import render
from fieldscribe.targets import docs
from models import kitchen_sink, named
from python_package import error, imported, write_package
from toolchains import compiled, run, succeed, tool

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from fieldscribe.model import Point

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

WIDE = tuple(PATHS)
SEED = 20261122


@pytest.mark.parametrize("item", WIDE)
def test_what_a_point_has(item: str) -> None:
    """An honest fact never fails to compile for its width: the model says which ways to compute there are."""
    point = named(DEVICE, item)
    assert (point.decimals, point.encodes_values) == PATHS[item]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_headers(DEVICE, tmp_path_factory.mktemp("wide")) / "c"


def test_c_has_only_what_is_exact(folder: Path) -> None:
    text = (folder / "kitchen_sink.h").read_text("utf-8")
    for item, (decimals, encodes) in PATHS.items():
        point = named(DEVICE, item)
        assert (f"{item}_decode_count(" in text) == (decimals is not None), item
        assert (f"{item}_encode(" in text) == (encodes and point.writable), item
        assert f"kitchen_sink_{item}_decode(" in text
    assert "No integer path: its counts need more than 64 bits." in text
    assert "Values are only decoded: raw numbers have more than 53 bits." in text


DECODES = """
#include <stdio.h>
#include "kitchen_sink.h"
int main(void)
{
    unsigned long long raw;
    unsigned which;
    while (scanf("%u %llu", &which, &raw) == 2) {
        double value = 0;
        switch (which) {
@CASES@
        default:
            return 1;
        }
        printf("%.17g\\n", value);
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


def test_every_raw_number_decodes_to_the_nearest_double(folder: Path, tmp_path: Path) -> None:
    """Also those beyond 53 bits, and those that no range allows."""
    rng = random.Random(SEED)
    asked = [(which, raw) for which, item in enumerate(WIDE) for raw in raw_numbers(named(DEVICE, item), rng)]
    kinds = {"u64": "uint64_t", "s64": "int64_t", "u32": "uint32_t", "u16": "uint16_t"}
    calls = [f"kitchen_sink_{item}_decode(({kinds[named(DEVICE, item).type]})raw)" for item in WIDE]
    lines = [f"        case {which}U: value = {call}; break;" for which, call in enumerate(calls)]
    (tmp_path / "decodes.c").write_text(DECODES.replace("@CASES@", "\n".join(lines)).replace("\\\\", "\\"), "utf-8")
    sanitized = ("-fsanitize=undefined", "-fno-sanitize-recover=all")
    program = compiled(
        "gcc", ("-std=c99", "-O2", *sanitized, "-I", str(folder)), tmp_path / "decodes.c", tmp_path / "run"
    )
    (tmp_path / "asked").write_text("".join(f"{which} {raw & (1 << 64) - 1}\n" for which, raw in asked), "utf-8")
    found = succeed(["sh", "-c", f'"{program}" <"{tmp_path / "asked"}"']).split()
    for (which, raw), text in zip(asked, found, strict=True):
        point = named(DEVICE, WIDE[which])
        assert point.scale is not None
        rule = point.scale[0].rule
        assert float(text) == float((raw - rule.offset) / rule.ratio), (point.item, raw)


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
