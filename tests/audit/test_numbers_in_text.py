"""Numbers in a line of a manual: each spelling with all that it can mean."""

from __future__ import annotations

from fractions import Fraction

import pytest
from fieldscribe.audit.numbers import tokens_of


@pytest.mark.parametrize(
    ("text", "readings"),
    [
        ("dies entspricht 10A", [{Fraction(10), Fraction(0x10A)}]),
        (r"$t \cdot \frac{1}{s} \cdot \frac{50}{s}$", [{Fraction(50), Fraction(0x50)}]),
        ("von den Wandlern abhängig", []),
        ("1 ....0,37 kW", [{Fraction(1)}, {Fraction(37, 100)}]),
        (r"$1000011111\_00001_{\text{bin}}$", [{Fraction(0b100001111100001)}]),
        ("4..20mA", [{Fraction(4)}, {Fraction(20), Fraction(0x20)}]),
        ("Kapitel 4.2.10", [{Fraction(4), Fraction(2), Fraction(10)}]),
        ("Bits 101", [{Fraction(101), Fraction(0b101)}]),
        ("Bits 11", [{Fraction(11), Fraction(0x11), Fraction(0b11)}]),
        ("Bits 102", [{Fraction(102)}]),
        ("von 1 bis 0", [{Fraction(1)}, {Fraction(0)}]),
        ("0,3,4 oder 127", [{Fraction(0)}, {Fraction(3)}, {Fraction(4)}, {Fraction(127)}]),
        ("1,200,500", [{Fraction(1), Fraction(200), Fraction(500), Fraction(1200500)}]),
        (r"00110010\_000009", [{Fraction(110010000009)}]),
        ("1.200,500", [{Fraction(1), Fraction(200), Fraction(500), Fraction(1200500)}]),
    ],
)
def test_numbers_of_a_line(text: str, readings: list[set[Fraction]]) -> None:
    assert [set(token.readings) for token in tokens_of(text, 1)] == readings


@pytest.mark.parametrize(("text", "number", "plainly"), [("11", 3, False), ("11", 11, True), ("1100", 12, True)])
def test_two_digits_are_no_binary_number_of_a_code(text: str, number: int, plainly: bool) -> None:
    [token] = tokens_of(text, 1)
    assert token.is_plainly(frozenset((Fraction(number),))) is plainly
