"""Lines and literals of generated Rust, broken and written as rustfmt and clippy want them."""

from __future__ import annotations

from pathlib import Path

import pytest
from fieldscribe.targets.rust.layout import (
    Item,
    assignment,
    binding,
    called,
    calls,
    chain,
    chained,
    comparison,
    filled,
    wrapped,
)
from fieldscribe.targets.rust.literals import nearest_float
from support.described import described, loaded_in
from support.rust_crates import write_crate


@pytest.mark.parametrize(
    ("number", "bits", "nearest"),
    [
        (0.1, 64, 0.1),
        (0.1, 32, 0.10000000149011612),
        (1e300, 64, 1e300),
        (1e39, 32, 3.4028234663852886e38),
        (-1e39, 32, -3.4028234663852886e38),
    ],
)
def test_a_limit_is_the_nearest_number_of_its_type(number: float, bits: int, nearest: float) -> None:
    assert nearest_float(number, bits) == nearest


def test_long_lines_break_as_rustfmt_breaks_them() -> None:
    """The crates' own lines are held against rustfmt itself; these say which break is meant."""
    name = "x" * 60
    assert assignment(4, Item(f"const {name}", "A"), ("A::new(", "    1,", ")"))[0].endswith("A::new(")
    assert binding(4, Item(f"const {name}", "&'static str"), '"abc"') == (f'const {name}: &\'static str = "abc";',)
    assert assignment(4, Item(f"const {name}", f"{name}"), ("A::new(", "    1,", ")"))[0].endswith("=")
    assert calls(4, Item("const A", "B"), [("C", ("1",))]) == ("const A: B = &[C(1)];",)
    assert calls(4, Item("const A", "B"), [("C", (name, name))])[1] == f"    {name},"
    assert calls(4, Item("const A", "B"), [("C", (name, name)), ("D", ("1",))])[2] == f"        {name},"
    assert binding(0, Item(f"pub type {name}{name}"), "A") == (f"pub type {name}{name} =", "    A;")
    assert chain(Item("static A", "B"), "C::new(1)", [".d()"]) == ("static A: B = C::new(1).d();",)
    assert chain(Item("static A", "B"), "C::new(1)", [".d()", ".e()"]) == (
        "static A: B = C::new(1)",
        "    .d()",
        "    .e();",
    )
    assert comparison(8, name, "== 0") == (f"{name} == 0",)
    assert comparison(36, name, "== 0") == (name, "    == 0")


@pytest.mark.parametrize(
    ("indent", "items", "lines"),
    [
        (4, [("A", ("1",)), ("B", ("2", "3"))], ("&[A(1), B(2, 3)]",)),
        (4, [("A", ("x" * 29, "y" * 29)), ("B", ("1",))], ("&[", f"    A({'x' * 29}, {'y' * 29}),", "    B(1),", "]")),
        (
            4,
            [("A", ("x" * 29, "y" * 30)), ("B", ("1",))],
            ("&[", "    A(", f"        {'x' * 29},", f"        {'y' * 30},", "    ),", "    B(1),", "]"),
        ),
        (4, [("A" * 39, ("x" * 50,)), ("B", ("1",))], ("&[", f"    {'A' * 39}({'x' * 50}),", "    B(1),", "]")),
        (
            4,
            [("A" * 40, ("x" * 50,)), ("B", ("1",))],
            ("&[", f"    {'A' * 40}(", f"        {'x' * 50},", "    ),", "    B(1),", "]"),
        ),
        (4, [("A", ("x" * 30, "y" * 30))], ("&[A(", f"    {'x' * 30},", f"    {'y' * 30},", ")]")),
    ],
    ids=["short", "60 of arguments", "61 of arguments", "100 of a line", "101 of a line", "alone"],
)
def test_a_list_of_calls_breaks_as_rustfmt_breaks_it(
    indent: int, items: list[tuple[str, tuple[str, ...]]], lines: tuple[str, ...]
) -> None:
    """Of its defaults: lines of 100 characters, and 60 for the arguments of a call."""
    assert called(indent, items) == lines


def test_lines_that_rustfmt_leaves_alone_are_broken_too() -> None:
    assert filled("a [", ", ", ["1", "2"], "];") == ("a [1, 2];",)
    many = filled("a [", ", ", [f"0x{number:04X}" for number in range(40)], "];")
    assert max(map(len, many)) <= 104
    assert "".join(line.strip() for line in many).count("0x") == 40
    steps = [f".times(with.factor_{number})" for number in range(9)]
    assert chained(("Rule::new(1, 1).times(with.a)", ".over(with.b)")) == (
        "Rule::new(1, 1).times(with.a)?.over(with.b)",
    )
    assert chained((f"Rule::new(1, 1){steps[0]}", *steps[1:]))[1] == "    ?.times(with.factor_1)"
    assert list(wrapped("a " * 60 + "- b `c`")) == [("a " * 52).strip(), ("a " * 8) + "- b `c`"]


@pytest.mark.parametrize(("number", "literal"), [("4711", "4711"), ("305419896", "305_419_896")])
def test_numbers_that_identify_are_grouped(tmp_path: Path, number: str, literal: str) -> None:
    """Clippy wants the digits of a long literal in groups."""
    text = described("- {name: serial, at: 0, type: u32}\n", identify=f"{{serial: {number}}}")
    crate = write_crate(loaded_in(tmp_path, text), tmp_path)
    assert f"Serial holds Raw {literal};" in (crate / "src/lib.rs").read_text("utf-8")
