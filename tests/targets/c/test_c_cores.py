"""The cores of fieldscribe.h by themselves: ends of 64 bits, products of 128, names beyond 32 bits."""

from __future__ import annotations

import random
import subprocess
from fractions import Fraction
from typing import TYPE_CHECKING

import pytest
from fieldscribe.resources import templates_dir
from support.c_device import SANITIZERS, SANITIZING, WARNINGS
from support.toolchains import compiled, run, succeed, tool

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

RUNTIME = templates_dir() / "c/runtime"
INT64 = (1 << 63) - 1
EDGES = (0, 1, 2, 3, 7, 10, 1 << 31, (1 << 32) - 1, 1 << 53, 1 << 62, INT64 - 1, INT64)

CHECKS = """
#include "fieldscribe.h"
#define MUST(what) if (!(what)) { return __LINE__ % 200 + 1; }
static const fieldscribe_wide_name names[] = {{UINT64_C(18446744073709551615), "all"}, {UINT64_C(4294967296), "high"}};
static const fieldscribe_name small[] = {{-5, "below"}, {70000, "above"}};
static const fieldscribe_range ranges[] = {{-3, -1}, {4, 4}};
int main(void)
{
    int64_t sum = 0;
    uint16_t raw = 7U;
    uint16_t words[4];
    MUST(fieldscribe_wide_name_of(names, FIELDSCRIBE_COUNT(names), UINT64_C(18446744073709551615))[0] == 'a')
    MUST(fieldscribe_wide_name_of(names, FIELDSCRIBE_COUNT(names), UINT64_C(4294967296))[0] == 'h')
    MUST(fieldscribe_wide_name_of(names, FIELDSCRIBE_COUNT(names), 0U) == NULL)
    MUST(fieldscribe_name_of(small, FIELDSCRIBE_COUNT(small), -5)[0] == 'b')
    MUST(fieldscribe_name_of(small, FIELDSCRIBE_COUNT(small), 70000)[0] == 'a')
    MUST(fieldscribe_name_of(small, FIELDSCRIBE_COUNT(small), INT64_C(4294967291)) == NULL)
    MUST(fieldscribe_check_ranges(-4, ranges, FIELDSCRIBE_COUNT(ranges)) == FIELDSCRIBE_OUT_OF_RANGE)
    MUST(fieldscribe_check_ranges(-3, ranges, FIELDSCRIBE_COUNT(ranges)) == FIELDSCRIBE_OK)
    MUST(fieldscribe_check_ranges(-1, ranges, FIELDSCRIBE_COUNT(ranges)) == FIELDSCRIBE_OK)
    MUST(fieldscribe_check_ranges(4, ranges, FIELDSCRIBE_COUNT(ranges)) == FIELDSCRIBE_OK)
    MUST(fieldscribe_check_ranges(5, ranges, FIELDSCRIBE_COUNT(ranges)) == FIELDSCRIBE_OUT_OF_RANGE)
    MUST(fieldscribe_add(INT64_MAX, 0, &sum) && sum == INT64_MAX && !fieldscribe_add(INT64_MAX, 1, &sum))
    MUST(fieldscribe_add(INT64_MIN, 0, &sum) && sum == INT64_MIN && !fieldscribe_add(INT64_MIN, -1, &sum))
    MUST(fieldscribe_add(-INT64_MAX, -1, &sum) && sum == INT64_MIN && fieldscribe_add(-1, 1, &sum) && sum == 0)
    MUST(fieldscribe_multiply(-INT64_MAX, 1, &sum) && sum == -INT64_MAX && !fieldscribe_multiply(INT64_MIN, 1, &sum))
    MUST(!fieldscribe_multiply(INT64_C(4294967296), INT64_C(2147483648), &sum))
    MUST(fieldscribe_multiply(INT64_C(4294967296), INT64_C(2147483647), &sum) && sum == INT64_C(9223372032559808512))
    MUST(fieldscribe_encode_u16(-1, 0, 9, &raw) == FIELDSCRIBE_OUT_OF_RANGE && raw == 7U)
    MUST(fieldscribe_encode_u16(10, 0, 9, &raw) == FIELDSCRIBE_OUT_OF_RANGE && raw == 7U)
    MUST(fieldscribe_encode_u16(9, 0, 9, &raw) == FIELDSCRIBE_OK && raw == 9U)
    MUST(fieldscribe_shift(-1, 3U) == -1 && fieldscribe_shift(-8, 3U) == -1 && fieldscribe_shift(15, 3U) == 1)
    MUST(fieldscribe_shift_wide(INT64_MIN, 62U) == -2)
    MUST(fieldscribe_halves(-1, 1U) == -1 && fieldscribe_halves(1, 1U) == 1 && fieldscribe_halves(-5, 2U) == -1)
    MUST(fieldscribe_divide(-3, 2) == -2 && fieldscribe_divide(3, 2) == 2 && fieldscribe_divide(-4, 3) == -1)
    MUST(fieldscribe_either(FIELDSCRIBE_OK, FIELDSCRIBE_ZERO_FACTOR) == FIELDSCRIBE_ZERO_FACTOR)
    MUST(fieldscribe_either(FIELDSCRIBE_OVERFLOW, FIELDSCRIBE_ZERO_FACTOR) == FIELDSCRIBE_OVERFLOW)
    MUST(fieldscribe_either(FIELDSCRIBE_OUT_OF_RANGE, FIELDSCRIBE_OK) == FIELDSCRIBE_OK)
    MUST(fieldscribe_either(FIELDSCRIBE_OUT_OF_RANGE, FIELDSCRIBE_OUT_OF_RANGE) == FIELDSCRIBE_OUT_OF_RANGE)
    fieldscribe_split64(UINT64_C(0x0123456789ABCDEF), &words[3], &words[1], &words[2], &words[0]);
    MUST(words[3] == 0x0123U && words[1] == 0x4567U && words[2] == 0x89ABU && words[0] == 0xCDEFU)
    MUST(fieldscribe_join64(words[3], words[1], words[2], words[0]) == UINT64_C(0x0123456789ABCDEF))
    MUST(fieldscribe_extract_wide(UINT64_C(0xF0F0000000000000), UINT64_C(0xFF00000000000000), 56U) == 0xF0U)
    return 0;
}
"""

RATIOS = """
#include <stdio.h>
#include "fieldscribe.h"
int main(void)
{
    long long number, num, den, offset, parts;
    while (scanf("%lld %lld %lld %lld %lld", &number, &num, &den, &offset, &parts) == 5) {
        const fieldscribe_rule rule = fieldscribe_rule_of(num, den, offset, parts);
        int64_t raw = 0;
        if (fieldscribe_apply_rule(&rule, number, 1, &raw)) {
            printf("%lld\\n", (long long)raw);
        } else {
            printf("-\\n");
        }
    }
    return 0;
}
"""

IGNORED = """
#include "fieldscribe.h"
void ignore(uint16_t *raw);
void ignore(uint16_t *raw)
{
    fieldscribe_encode_u16(1, 0, 9, raw);
}
"""


@pytest.mark.parametrize("language", ["c99", "c++17"])
@pytest.mark.parametrize("compiler", SANITIZING)
def test_the_cores(compiler: str, language: str, tmp_path: Path) -> None:
    (tmp_path / "cores.c").write_text(CHECKS, encoding="utf-8")
    standard = ("-std=c99",) if language == "c99" else ("-x", "c++", "-std=c++17")
    driver = compiler if language == "c99" else {"gcc": "g++", "clang": "clang++"}[compiler]
    flags = (*standard, "-O1", *WARNINGS, *SANITIZERS[compiler], "-I", str(RUNTIME))
    succeed([compiled(driver, flags, tmp_path / "cores.c", tmp_path / "cores")])


def rules(rng: random.Random) -> Iterator[tuple[int, int, int, int, int]]:
    """A number and a rule: its numerator, divisor, offset and the parts of that."""
    for _ in range(4000):
        number, num, den, offset = (
            rng.choice((1, -1)) * (rng.choice(EDGES) if rng.random() < 0.4 else rng.getrandbits(rng.randint(1, 62)))
            for _ in range(4)
        )
        yield number, num or 1, abs(den) or 1, rng.choice((0, offset)), rng.choice((1, 2, 3, 10, 625))


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
