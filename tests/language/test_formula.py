"""The formula language: what is read, what is refused, and where the finger points."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from time import process_time

import pytest
from fieldscribe.language.formula.conditions import Comparison, Constant, parse_case, parse_condition
from fieldscribe.language.formula.normal import evaluate
from fieldscribe.language.formula.parser import parse_expression, parse_range, parse_scale
from fieldscribe.language.formula.suggestions import cut_off, exact_scale
from fieldscribe.language.formula.syntax import Binary, FormulaError, Name, Number, names
from hypothesis import example, given
from hypothesis import strategies as st

VALUES = {"wire": Fraction(100), "base": Fraction(7), "b082": Fraction(3), "b082.raw": Fraction(30), "ffh": Fraction(1)}

EVALUATED = {
    "wire + 1": 101,
    "400000 + wire": 400100,
    "base + 6": 13,
    "1028h": 0x1028,
    "A0h": 0xA0,
    "0ffh": 0xFF,
    "ffh": 1,
    "H'33F - 33Fh": 0,
    "1Eh-3": 27,
    "1e-3 * 1000": 1,
    "2 - 3 - 4": -5,
    "12 / 2 / 3": 2,
    "2 + 3 * 4": 14,
    "(2 + 3) * 4": 20,
    "-2 * -3": 6,
    "- (2 + 3)": -5,
    "+5": 5,
    "b082 * 10": 30,
    "b082.value": 3,
    "b082.raw": 30,
    "10 ** 3": 1000,
    "10 ** -2": Fraction(1, 100),
    "-10 ** 2": -100,
    "10 ** b082": 1000,
    "10 ** -b082 * 1000": 1,
    "Ah ** 2": 100,
    "4000h/10**2": Fraction(16384, 100),
}

READ_AS_NAMES = ["b082", "F004", "A020", "d081", "ffh", "each", "FFH", "h", "E20", "P2009", "A", "Ahh", "x1028h"]

Parse = Callable[[str], object]
PARSERS: tuple[Parse, ...] = (parse_expression, parse_scale, parse_range, parse_condition, parse_case)

UNKNOWN_SIGNS = {
    "10 ** n": "^",
    "write *": "\u00d7\u00b7\u22c5",
    "write /": "\u00f7:",
    "keyboard": "\u2212",
    ".. for an interval": "\u2013",
    "a unit is not part of a formula": "%\u00b0",
    "a list stands in parentheses": "[",
    "names stand without quotes": '"',
    "write <=": "\u2264",
    "write >=": "\u2265",
    "write !=": "\u2260",
    "write and": "&",
    "write not": "!",
}
"""Signs that formulas do not know, by the hint."""

# (parser, text, column, part of message, part of hint)
REFUSED: list[tuple[Parse, str, int, str, str]] = [
    (parse_expression, "", 0, "found the end", ""),
    (parse_expression, "1 +", 3, "found the end", ""),
    (parse_expression, "1 + 1FF", 4, "without a marker", "1FFh"),
    (parse_expression, "4E20 * 2", 0, "power of ten", "4E20h"),
    (parse_expression, "2 * 0b102", 4, "0 and 1", "0b0101"),
    (parse_expression, "wire 1", 5, "unexpected", "operator"),
    (parse_expression, "50 Hz", 3, "unexpected", "unit"),
    (parse_expression, "50Hz", 0, "unit", "alone"),
    (parse_expression, "2 * (1 + 2", 10, "`)`", ""),
    (parse_expression, "2)", 1, "unexpected", ""),
    (parse_expression, "wire * 0,1", 7, "decimal number or a list", "0.1"),
    (parse_expression, "wire, 1", 4, "unexpected", "point, not a comma"),
    (parse_expression, "wire == 1", 5, "unexpected", "one ="),
    (parse_expression, "wire < 1", 5, "unexpected", "conditions"),
    (parse_expression, "sqrt(2)", 4, "unexpected", "no functions"),
    (parse_expression, "2 ** 3", 2, "powers of ten", "10 ** n"),
    (parse_expression, "wire ** 2", 5, "powers of ten", "10 ** n"),
    (parse_expression, "10 ** 2 ** 2", 8, "powers of ten", "10 ** n"),
    (parse_expression, "10 ** 0.5", 6, "whole number", ""),
    (parse_expression, "10 ** (a + 1)", 6, "one whole number or one point", "10 ** a * 10 ** b"),
    (parse_expression, "10 ** 401", 6, "beyond", ""),
    (parse_expression, "a.error", 1, "`.raw` and `.value` only", ""),
    (parse_expression, "value.raw", 0, "has no part", ""),
    (parse_expression, "a . raw", 2, "`.`", "digits on both sides"),
    *(
        (parse_expression, f"2 {sign} 3", 2, f"`{sign}`", hint)
        for hint, signs in UNKNOWN_SIGNS.items()
        for sign in signs
    ),
    (parse_range, "0~5", 1, "`~`", "low..high"),
    (parse_expression, "1.", 1, "`.`", "digits on both sides"),
    (parse_expression, "1\n+2", 1, "U+000A", "one line"),
    (parse_expression, "a\u202eb", 1, "U+202E", ""),
    (parse_expression, "(" * 51 + "1" + ")" * 51, 50, "at most 50 operations", ""),
    (parse_expression, "-" * 51 + "1", 50, "at most 50 operations", ""),
    (parse_expression, "1" + "+1" * 51, 101, "at most 50 operations", ""),
    (parse_expression, "1 + 1" + " " * 2000, 2000, "at most 2000 characters", ""),
    (parse_scale, "speed = raw * 0.1", 0, "`raw =` or `value =`", ""),
    (parse_scale, "value.raw = raw", 0, "`raw =` or `value =`", ""),
    (parse_scale, "value == raw * 0.1", 6, "`=`", "one ="),
    (parse_scale, "value = raw = 2", 12, "unexpected", "one ="),
    (parse_scale, "value = raw x 0.1", 12, "unexpected", "operator"),
    (parse_scale, "raw = raw * 2", 6, "both sides", "raw = <expression"),
    (parse_scale, "raw = 10 ** raw", 12, "both sides", ""),
    (parse_scale, "raw =", 5, "found the end", ""),
    (parse_range, "", 0, "found the end", ""),
    (parse_range, "0..", 3, "found the end", ""),
    (parse_range, "..5", 0, "a number or a name", "low..high"),
    (parse_range, "0..1..2", 4, "unexpected", "one low and one high"),
    (parse_range, "0...5", 3, "`.`", "low..high"),
    (parse_range, "0-4000", 1, "minus sign between two numbers", "low..high"),
    (parse_range, "0 - 4000 | 5", 2, "minus sign between two numbers", "low..high"),
    (parse_range, "0 to 4000", 2, "unexpected", "low..high"),
    (parse_range, "0\u20264000", 1, "`\u2026`", ".."),
    (parse_range, "0,5..9,9", 0, "decimal number or a list", "0.5"),
    (parse_range, "0,1,2", 0, "decimal number or a list", "blank after the comma"),
    (parse_range, "0, 1,", 5, "found the end", ""),
    (parse_range, "0..raw", 3, "not known in a range", ""),
    (parse_condition, "", 0, "a name", ""),
    (parse_condition, "a", 1, "a comparison", "compares a name"),
    (parse_condition, "a = 1", 2, "a comparison", "=="),
    (parse_condition, "a + 1 == 2", 2, "a comparison", "compares a name"),
    (parse_condition, "a == 1 + 2", 7, "unexpected", "compares a name"),
    (parse_condition, "a == (1)", 5, "a constant", ""),
    (parse_condition, "a == b.raw", 5, "a constant", "not with other points"),
    (parse_condition, "a < none", 4, "no order", "=="),
    (parse_condition, "a in 1", 5, "`(`", "in (1, 2, 3)"),
    (parse_condition, "a in (1, 2", 10, "`)`", "in (1, 2, 3)"),
    (parse_condition, "a in ()", 6, "a constant", ""),
    (parse_condition, "(a == 1", 7, "`)`", ""),
    (parse_condition, "a == 1 and", 10, "a name", ""),
    (parse_condition, "a == 1 && b == 2", 7, "`&`", "and"),
    (parse_condition, "a < 1 < 2", 6, "unexpected", ""),
    (parse_condition, "value == 1", 0, "not known in a condition", ""),
    (parse_condition, "not " * 51 + "a == 1", 200, "at most 50 operations", ""),
    (parse_case, "P2009 != 0", 6, "a case knows ==", "NAME == constant"),
    (parse_case, "P2009 in (1, 2)", 6, "a case knows ==", "NAME == constant"),
    (parse_case, "P2009 == none", 9, "whole number", "NAME == constant"),
    (parse_case, "P2009 == 0.5", 9, "whole number", "NAME == constant"),
    (parse_case, "P2009.value == 1", 0, "raw number", "NAME == constant"),
    (parse_case, "P2009 == 1 and P1 == 2", 11, "unexpected", "NAME == constant"),
]


@pytest.mark.parametrize("text", EVALUATED)
def test_an_expression_gives_its_number(text: str) -> None:
    assert evaluate(parse_expression(text), VALUES) == EVALUATED[text]


@pytest.mark.parametrize("text", READ_AS_NAMES)
def test_a_code_that_looks_hexadecimal_is_a_name(text: str) -> None:
    assert parse_expression(text) == Name(text, "value", 0)


@pytest.mark.parametrize(("parse", "text", "column", "message", "hint"), REFUSED)
def test_what_is_wrong_is_refused_where_it_stands(
    parse: Parse, text: str, column: int, message: str, hint: str
) -> None:
    with pytest.raises(FormulaError) as caught:
        parse(text)
    assert message in caught.value.message
    assert hint in caught.value.hint
    assert caught.value.column == column


@pytest.mark.parametrize(
    ("text", "values", "column", "message"),
    [
        ("1 + wrie", {"wire": 1}, 4, "`wrie` is not known"),
        ("a.raw", {"a": 1}, 0, "`a.raw` is not known"),
        ("1 / (2 - 2)", {}, 2, "division by zero"),
        ("10 ** a", {"a": Fraction(1, 2)}, 6, "whole number"),
        ("10 ** a", {"a": 401}, 6, "too large"),
        ("*".join(["1e400"] * 20), {}, 0, "too large"),
    ],
)
def test_evaluation_is_refused(text: str, values: dict[str, Fraction], column: int, message: str) -> None:
    with pytest.raises(FormulaError) as caught:
        evaluate(parse_expression(text), {name: Fraction(number) for name, number in values.items()})
    assert message in caught.value.message
    assert caught.value.column == column


def test_columns_count_in_the_text() -> None:
    assert [(one.name, one.column) for one in names(parse_expression("a * (b + a) * 10 ** c"))] == [
        ("a", 0),
        ("b", 5),
        ("a", 9),
        ("c", 20),
    ]
    for text, column in (("1 + ", 3), ("1 ? 2", 2)):
        with pytest.raises(FormulaError) as caught:
            parse_expression(text)
        assert caught.value.column == column


def test_columns_take_no_part_in_equality() -> None:
    assert parse_expression("wire+1") == parse_expression(" wire + 1")


def test_a_scale_knows_its_sides_and_what_it_uses() -> None:
    scale = parse_scale("raw = value * 4000h / P2000.raw")
    assert (scale.side, scale.variable) == ("raw", "value")
    assert [(use.name, use.part, use.column) for use in scale.uses] == [("P2000", "raw", 22)]
    assert parse_scale("value=raw/10").uses == ()


@pytest.mark.parametrize(
    ("text", "alternatives", "listed"),
    [
        ("0..4000", [(0, 4000)], False),
        ("0 .. 4000", [(0, 4000)], False),
        ("0.5..9.9", [(Fraction(1, 2), Fraction(99, 10))], False),
        ("0.0..400.0", [(0, 400)], False),
        ("-99..-70 | 70..100", [(-99, -70), (70, 100)], False),
        ("0, 1, 2, 3, 10", [(0, 0), (1, 1), (2, 2), (3, 3), (10, 10)], True),
        ("0 | 10h, 20h", [(0, 0), (16, 16), (32, 32)], True),
        ("10h,20h", [(16, 16), (32, 32)], True),
        ("5", [(5, 5)], True),
        ("0..FFFFh", [(0, 65535)], False),
        ("FFh..FFFFh", [(255, 65535)], False),
        ("1e3..2e3", [(1000, 2000)], False),
        ("0..2 * 8", [(0, 16)], False),
    ],
)
def test_ranges(text: str, alternatives: list[tuple[Fraction, Fraction]], listed: bool) -> None:
    found = parse_range(text)
    assert [(evaluate(low, {}), evaluate(high, {})) for low, high in found.alternatives] == alternatives
    assert found.listed is listed


def test_limits_that_other_points_set() -> None:
    found = parse_range("0 | A062 * 10 .. A004.raw")
    (zero, same), (low, high) = found.alternatives
    assert zero is same
    assert zero == Number(Fraction(0), 0)
    assert low == Binary("*", Name("A062", "value", 0), Number(Fraction(10), 0), 0)
    assert high == Name("A004", "raw", 0)
    assert parse_range("30..A004").alternatives[0][1] == Name("A004", "value", 0)
    assert parse_range("A062..A004").alternatives == ((Name("A062", "value", 0), Name("A004", "value", 0)),)
    assert parse_range("a-1").alternatives[0][0] == Binary("-", Name("a", "value", 0), Number(Fraction(1), 0), 0)


def _is(name: str, op: str, *constants: int | str) -> Comparison:
    given = tuple(Constant(one if isinstance(one, str) else Fraction(one), 0) for one in constants)
    return Comparison(Name(name, "value", 0), op, given, 0)


@pytest.mark.parametrize(
    ("text", "condition"),
    [
        ("phases >= 2 and meter != none", [[_is("phases", ">=", 2), _is("meter", "!=", "none")]]),
        ("a == 1 or b == 2 and c == 3", [[_is("a", "==", 1)], [_is("b", "==", 2), _is("c", "==", 3)]]),
        (
            "(a == 1 or b == x) and c < 3",
            [[_is("a", "==", 1), _is("c", "<", 3)], [_is("b", "==", "x"), _is("c", "<", 3)]],
        ),
        ("a in (1, -2, x)", [[_is("a", "in", 1, -2, "x")]]),
        ("not a in (1, -2, x)", [[_is("a", "!=", 1), _is("a", "!=", -2), _is("a", "!=", "x")]]),
        ("not a <= 10h and b > 0", [[_is("a", ">", 16), _is("b", ">", 0)]]),
        ("not (a == 1 or not b >= 2)", [[_is("a", "!=", 1), _is("b", ">=", 2)]]),
        ("not (a < 1 and b != 2)", [[_is("a", ">=", 1)], [_is("b", "==", 2)]]),
        ("a == +1", [[_is("a", "==", 1)]]),
    ],
)
def test_conditions(text: str, condition: list[list[Comparison]]) -> None:
    assert parse_condition(text) == tuple(map(tuple, condition))


def test_the_names_of_a_condition() -> None:
    clauses = parse_condition("a == 1 or not (b.raw in (1, 2) and a != x)")
    found = [comparison.name for clause in clauses for comparison in clause]
    assert [(name.name, name.part, name.column) for name in found] == [
        ("a", "value", 0),
        ("b", "raw", 15),
        ("b", "raw", 15),
        ("a", "value", 35),
    ]


def test_cases_compare_the_raw_number() -> None:
    assert parse_case("P2009 == 0") == (Name("P2009", "raw", 0), 0)
    assert parse_case("P2009.raw == -1h") == (Name("P2009", "raw", 0), -1)


CUT_OFF = {
    "100 / 16384": ["0.00610352", "value = raw * 0.00610352", "value = raw * 0.1 + 0.0061035"],
    "100 / 32768": ["0.00305176"],
    "10000 / 1024": ["9.76563"],
    None: ["0.000390625", "0.00390625", "0.0061", "0.12345", "0.10000", "163.84", "3.14159", "1234567", "", "..."],
}


@pytest.mark.parametrize("suggestion", CUT_OFF)
def test_a_cut_binary_fraction_is_noticed(suggestion: str | None) -> None:
    for text in CUT_OFF[suggestion]:
        found = cut_off(text)
        assert (found.exact if found else None) == suggestion, text


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("value = raw * 0.0000152588", "value = raw / 65536"),
        ("value = raw * 0.00610352", "value = raw * 100 / 16384"),
        ("value = 0.00610352 * raw - 40", "value = 100 / 16384 * raw - 40"),
        ("raw = value / 0.00610352", "raw = value * 16384 / 100"),
        ("raw = value / 0.0000152588", "raw = value * 65536"),
        ("value = raw * 0.33333", "value = raw / 3"),
        ("value = raw * 0.66667 + 0.016667", "value = raw * 2 / 3 + 1 / 60"),
        ("value = raw * 0.1", "value = raw * 0.1"),
        ("value = raw * 0.12345", "value = raw * 0.12345"),
        ("value = raw * 0.22225", "value = raw * 0.22225"),
    ],
)
def test_the_exact_line_of_a_cut_decimal_is_given(text: str, line: str) -> None:
    assert exact_scale(text) == line
    assert (cut_off(text) is None) == (text == line)
    parse_scale(line)


WORDS = ["raw", "value", "a", "b082.raw", "10", "0", "1e400", "1028h", "0.1", "1FF", "H'", "and ", "or ", "not ", "in "]
SIGNS = ["**", "..", "|", ", ", ",", "(", ")", "+", "-", "*", "/", "=", "==", "<", " ", ".", "\u2212"]
PIECES = st.lists(st.sampled_from([*WORDS, *SIGNS]), max_size=60).map("".join)


@given(st.text(max_size=60) | PIECES)
@example("(" * 2000)
@example("-" * 2000)
@example("not " * 500)
@example("a == 1 or " * 190 + "a == 1")
@example("1" + "+1" * 999)
@example("0, " * 600 + "1")
@example("10 ** " * 300)
@example("0" * 1999)
@example("=" * 5000)
def test_any_text_is_read_or_refused_quickly(text: str) -> None:
    begun = process_time()
    for parse in PARSERS:
        try:
            parse(text)
        except FormulaError as error:
            assert error.message
            assert 0 <= error.column <= len(text)
            assert (error.message + error.hint).isprintable()
    cut_off(text)
    assert process_time() - begun < 0.5
