"""The cores of fieldscribe.h by themselves: ends of 64 bits, products of 128, names beyond 32 bits."""

from __future__ import annotations

import random
import subprocess
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import pytest
from fieldscribe.resources import templates_dir
from support.c_device import SANITIZERS, SANITIZING, WARNINGS, program, run_program
from support.toolchains import compiled, run, succeed, tool

RUNTIME = templates_dir() / "c/runtime"
INT64 = (1 << 63) - 1
EDGES = (0, 1, 2, 3, 7, 10, 1 << 31, (1 << 32) - 1, 1 << 53, 1 << 62, INT64 - 1, INT64)

CHECKS = program("core_checks")

RATIOS = program("ratios")

IGNORED = """
#include "fieldscribe.h"
void ignore(uint16_t *raw);
void ignore(uint16_t *raw)
{
    fieldscribe_encode_u16(1, 0, 9, raw);
}
"""


@pytest.mark.parametrize("language", ["c99", "c++17"])
@pytest.mark.parametrize("way", SANITIZING)
def test_the_cores(way: str, language: str, tmp_path: Path) -> None:
    run_program(CHECKS, way, RUNTIME, tmp_path, standard=language)


def rules(rng: random.Random) -> Iterator[tuple[int, int, int, int, int]]:
    """A number and a rule: its numerator, divisor, offset and the parts of that."""
    for _ in range(4000):
        number, num, den, offset = (
            rng.choice((1, -1)) * (rng.choice(EDGES) if rng.random() < 0.4 else rng.getrandbits(rng.randint(1, 62)))
            for _ in range(4)
        )
        yield number, num or 1, abs(den) or 1, rng.choice((0, offset)), rng.choice((1, 2, 3, 10, 625))
    for _ in range(1000):  # next to a half, with a divisor of more than 32 bits
        den, twice = rng.randrange(1 << 33, 1 << 40), rng.getrandbits(22) >> rng.randint(0, 18)
        yield den * (twice | 1) // 2 + rng.randint(-1, 1), 1, den, 0, 1
    yield -(2**32) - 1, 1, 1024, 2**23 + 1, 2  # the lowest bit alone makes it less than a half


def test_rules_are_exact_in_128_bits(tmp_path: Path) -> None:
    """Against fractions; what does not fit is refused and never wrong."""
    (tmp_path / "ratios.c").write_text(RATIOS, encoding="utf-8")
    flags = ("-std=c99", "-O2", *WARNINGS, *SANITIZERS["gcc"], "-I", str(RUNTIME))
    program = compiled("gcc", flags, tmp_path / "ratios.c", tmp_path / "ratios")
    asked = list(rules(random.Random(8)))
    text = "\n".join(" ".join(map(str, one)) for one in asked)
    done = subprocess.run([program], input=text, capture_output=True, text=True, check=True)
    refused = 0
    for (number, num, den, offset, parts), found in zip(asked, done.stdout.split(), strict=True):
        exact = Fraction(number * num, den) + Fraction(offset, parts)
        size = int(abs(exact) + Fraction(1, 2))
        refused += found == "-"
        most = max(abs(number * num * parts), abs(num) * parts, abs(offset) * den * parts)
        fits = size <= INT64 and (offset == 0 or most < 1 << 60)
        assert found == str(size if exact > 0 else -size) or (found == "-" and not fits), (
            number,
            num,
            den,
            offset,
            parts,
        )
    assert 0 < refused < len(asked)


@pytest.mark.parametrize(
    "command", [("gcc", "-std=c99"), ("clang", "-std=c99"), ("clang++", "-std=c++17")], ids=" ".join
)
def test_an_ignored_status_warns(command: tuple[str, str], tmp_path: Path) -> None:
    (tmp_path / "ignored.c").write_text(IGNORED, encoding="utf-8")
    language = ("-x", "c++") if "++" in command[0] else ()
    source = tmp_path / "ignored.c"
    done = run(
        [tool(command[0]), *language, command[1], "-Werror", "-c", "-o", tmp_path / "ignored.o", f"-I{RUNTIME}", source]
    )
    assert done.returncode != 0
    assert "ignoring return value" in done.stderr


def test_they_need_no_warning_to_be_left_out(tmp_path: Path) -> None:
    """Alone, where an int has 16 bits too."""
    source = tmp_path / "alone.c"
    source.write_text('#include "fieldscribe.h"\n', encoding="utf-8")
    for flags in (
        ("gcc",),
        ("clang", "-Wno-unused-function"),
        ("avr-gcc", "-mmcu=atmega2560", "-DFIELDSCRIBE_FLOAT32"),
    ):
        succeed([tool(flags[0]), *flags[1:], "-std=c99", *WARNINGS, "-fsyntax-only", f"-I{RUNTIME}", source])
