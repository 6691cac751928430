"""Numbers as manuals write them."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from time import process_time
from typing import Any

import pytest
from fieldscribe.language.load import scalar
from fieldscribe.language.numbers import LONGEST, NumberError, parse_integer, parse_number
from hypothesis import example, given
from hypothesis import strategies as st

NUMBERS = {
    Fraction(4136): ["4136", "0x1028", "0X1028", "1028h", "1028H"],
    Fraction(1, 10): ["0.1", "1E-1"],
    Fraction(-5): ["-5"],
    Fraction(3): ["+3"],
    Fraction(-1, 2): ["-0.50"],
    Fraction(10): ["010", " 10\t"],
    Fraction(0): ["0"],
    Fraction(0xDD): ["DDh"],
    Fraction(0x1B): ["1bh"],
    Fraction(-0x1F): ["-1Fh"],
    Fraction(0x33F): ["H'33F"],
    Fraction(5): ["0b0101"],
    Fraction(-3): ["-0b11"],
    Fraction(0xB01): ["0b01h", "0B01h"],
    Fraction(0x4E20): ["4E20h"],
    Fraction(1000): ["1e3", "1E+3"],
    Fraction(3, 2000): ["1.5e-3"],
    Fraction(10**400): ["1e400"],
}

# (part of the message, part of the hint): texts
REFUSED = {
    ("missing", "1028h"): ["", "  "],
    ("decimal comma", "0.5"): ["0,5"],
    ("separator of thousands", "1.234"): ["1,234"],
    ("thousands", "1234567"): ["1,234,567"],
    ("thousands", "1000"): ["1 000", "1'000", "1_000", "1\u00a0000", "1.000.000"],
    ("hexadecimal or a power of ten", "write 4E20h or 0x4E20"): ["4E20"],
    ("hexadecimal or a power of ten", "write -4E20h or -0x4E20"): ["-4E20"],
    ("without a marker", "1FFh"): ["1FF"],
    ("without a marker", "FFh"): ["FF"],
    ("without a marker", "unit"): ["5A"],
    ("0 and 1", "0b0101"): ["0b102", "0b"],
    ("small b", "0b0101"): ["0B01"],
    ("hexadecimal", "0x1028"): ["0x", "0xZZ"],
    ("hexadecimal", "1028h"): ["12Gh"],
    ("hexadecimal", "H'1028"): ["H'", "H'33F'"],
    ("one marker", "1028h"): ["0x10h"],
    ("before the decimal point", "0.5"): [".5"],
    ("after the decimal point", "5.0"): ["5."],
    ("between sign and number", "directly"): ["- 5"],
    ("inside", "without blanks"): ["10 28h", "1 2"],
    ("unit", "alone"): ["50 Hz", "50.0Hz", "100ms", "5%", "20 \u00b0C"],
    ("minus", "-"): ["\u22125"],
    ("beyond 400", "exponent"): ["1e401", "1e-401"],
    ("at most 64", "1e30"): ["1" * (LONGEST + 1)],
    ("not a number", "4136"): ["--5", "\u0661\u0662", "nan", "h", "12\n"],
}


def of_each(table: dict[Any, list[str]]) -> list[tuple[str, Any]]:
    """Return the texts of a table, each with what is expected of it."""
    return [(text, expected) for expected, texts in table.items() for text in texts]


@pytest.mark.parametrize(("text", "number"), of_each(NUMBERS))
def test_numbers_mean_what_the_manual_means(text: str, number: Fraction) -> None:
    assert parse_number(text) == number


@pytest.mark.parametrize(("text", "expected"), of_each(REFUSED))
def test_what_is_no_number_is_refused_with_a_hint(text: str, expected: tuple[str, str]) -> None:
    with pytest.raises(NumberError) as caught:
        parse_number(text)
    assert expected[0] in caught.value.message
    assert expected[1] in caught.value.hint


def test_whole_numbers() -> None:
    assert parse_integer("1028h") == 0x1028
    assert parse_integer("-7") == -7
    assert parse_integer("1e3") == 1000


@pytest.mark.parametrize("text", ["0.5", "12.0", "15e-1", "2036.10"])
def test_a_fraction_is_no_whole_number(text: str) -> None:
    with pytest.raises(NumberError, match="not a whole number"):
        parse_integer(text)


def test_a_message_quotes_hostile_text_clean_and_short() -> None:
    with pytest.raises(NumberError) as caught:
        parse_number("\u202e\x1b[31m" + "x" * 57)
    assert len(caught.value.message) < 80
    assert caught.value.message.isprintable()


@pytest.mark.full(seconds=2)
@given(st.text(max_size=80) | st.text(alphabet="0123456789.,+-eExXbBhH'aFfF _", max_size=80))
@example("1" * 64)
@example("9" * 32 + " " * 31 + "z")
@example("1e" + "0" * 62)
@example("1e" + "9" * 62)
def test_any_text_gives_a_number_or_a_number_error(text: str) -> None:
    begun = process_time()
    for parse in (parse_number, parse_integer):
        try:
            parse(text)
        except NumberError as error:
            assert error.message
            assert (error.message + error.hint).isprintable()
    assert process_time() - begun < 0.1


@given(st.integers(-(2**64), 2**64))
def test_all_notations_of_a_whole_number_agree(number: int) -> None:
    sign, magnitude = ("-" if number < 0 else ""), abs(number)
    for text in (f"{magnitude}", f"0{magnitude:X}h", f"0x{magnitude:x}", f"H'{magnitude:X}", f"{magnitude}e0"):
        assert parse_integer(sign + text) == number
    if magnitude < 2**60:
        assert parse_integer(f"{sign}0b{magnitude:b}") == number


@pytest.mark.parametrize(
    ("texts", "value"),
    [
        (("", "~", "null", "Null", "NULL"), None),
        (("true", "True", "TRUE"), True),
        (("false", "False", "FALSE"), False),
        (("10", "010", "+10", "0xA", "0xa", "0o12"), 10),
        (("-10", "-010"), -10),
        (("1.5", "+1.5", "15e-1", "1.50", "0.15e1", "0.15E+01"), Decimal("1.5")),
        ((".5", "0.5", "5e-1"), Decimal("0.5")),
    ],
)
def test_plain_scalars(texts: tuple[str, ...], value: object) -> None:
    for text in texts:
        found = scalar(text)
        assert (type(found), found) == (type(value), value), text


TEXTS = "on off yes no On NO y tRue nULL nil none 12:30 1_000 0b11 0x 0o8 1e9999 1.2.3 --1 +-1 .inf .nan - + . 1h"


@pytest.mark.parametrize("text", [*TEXTS.split(), "1\u0662", "9" * 65, "0x" + "F" * 63, "1." + "0" * 63])
def test_what_is_text(text: str) -> None:
    assert scalar(text) == text
    assert isinstance(scalar(text), str)
