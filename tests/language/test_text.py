"""The encoders: whatever a description holds, the result stays inside its comment, its quotes or its cell."""

from __future__ import annotations

import ast
import csv
import io
import re
from collections.abc import Callable

import pytest
from fieldscribe import text

HOSTILE = [
    "???/",
    "see https://x.y www.z a@b.c $x$",
    *("*/ int x; /*", "/*/", "**/", "a */", "*", "/", "a*", "// x", "??/", "trigraph ??/", "end \\", "\\\\\\", "\\"),
    *('"', '""', '"""', "'''", "'", '\\"', 'say "x"\\', '"; import os; "'),
    *("\\N{BULLET}", "\\x41", "\\u{41}", "\\u0041"),
    *("line\nbreak", "cr\rx", "crlf\r\nx", "\u2028x\u2029y", "\x85x", "\v\f", "nul\0x", "\x1b[31m", "tab\tx"),
    *("\u202eevil\u202c", "\u2066x\u2069", "\u200bx", "\ufeffx", "\ud800x", "\U000e0041x", "\x7f"),
    *("{{ 7 * 7 }}", "{% raw %}", "</script><script>alert(1)</script>", "<b>", "&lt;", "&", "<!-- x -->", "]]>"),
    *("a | b", "\\|", "`code`", "``", "*em*", "_em_", "[x](http://example)", "![x](y)", "~~x~~", "# head", "- item"),
    *("=1+1", "+1+1", "-1+1", "@SUM(A1)", "a,b", 'a"b', "\t=1+1", "-5", "+3.5", "%s %n", "äöü °C µ", "漢字", "𝄞", ""),
]
FORBIDDEN = re.compile("[\x00-\x1f\x7f-\x9f\u200b-\u200f\u2028-\u202e\u2066-\u2069\ufeff\ud800-\udfff]")
ENCODERS = [
    *(text.line, text.c_comment, text.c_string, text.python_string, text.python_doc),
    *(text.rust_code, text.rust_string, text.markdown, text.csv_cell, text.js_string, text.js_comment),
]


def on_each_text(check: Callable[[str], None]) -> Callable[[], None]:
    """One test of what holds for every hostile text."""

    def test() -> None:
        for hostile in HOSTILE:
            check(hostile)

    return test


@pytest.mark.parametrize("encode", ENCODERS)
def test_no_result_holds_control_or_format_characters(encode: Callable[[str], str]) -> None:
    for hostile in HOSTILE:
        result = encode(hostile)
        assert not FORBIDDEN.search(result), ascii(hostile)
        assert result.encode("utf-8").decode("utf-8") == result, ascii(hostile)


def test_a_text_in_ascii_has_umlauts_as_two_letters() -> None:
    assert text.ascii_text("Größe Übung café Ω") == "Groesse Uebung cafe "


def test_a_line_keeps_what_people_can_read() -> None:
    assert text.line("  Größe\r\n in °C\t(µ)  ") == "Größe in °C (µ)"
    assert text.line("a\u202eb\x00c") == "abc"
    assert text.line("\u00a0x\u2003y") == "x y"


@on_each_text
def test_a_c_comment_ends_where_it_should(hostile: str) -> None:
    result = text.c_comment(hostile)
    for comment in (f"/* {result} */", f"/** {result}. */", f" * {result}\n */"):
        assert comment.count("*/") == 1
        assert comment.endswith("*/")
    assert "/*" not in result
    assert "??" not in result
    assert not result.endswith("\\")


@on_each_text
def test_a_c_string_holds_the_bytes_of_its_text(hostile: str) -> None:
    literal = text.c_string(hostile)
    assert re.fullmatch(r'"(?:[ -!#-\[\]-~]|\\[0-7]{3})*"', literal)
    assert "?" not in literal
    octal = re.sub(r"\\([0-7]{3})", lambda found: chr(int(found[1], 8)), literal[1:-1])
    assert octal.encode("latin-1").decode("utf-8") == text.line(hostile)


def test_every_character_of_a_line_is_printable() -> None:
    """So no literal needs an escape for a character."""
    line = text.line("".join(map(chr, range(0x110000))))
    assert line.isprintable()
    assert len(line) > 100_000


@on_each_text
def test_a_python_string_is_its_text(hostile: str) -> None:
    assert ast.literal_eval(text.python_string(hostile)) == text.line(hostile)


@on_each_text
def test_a_docstring_is_one_string(hostile: str) -> None:
    result = text.python_doc(hostile)
    tree = ast.parse(f'def f() -> None:\n    """{result}"""\n    # {result}\n')
    assert len(tree.body) == 1
    function = tree.body[0]
    assert isinstance(function, ast.FunctionDef)
    assert len(function.body) == 1
    shown = ast.get_docstring(function, clean=False)
    assert shown == text.line(hostile).replace('"', "'")


@on_each_text
def test_a_rust_string_has_no_open_escape(hostile: str) -> None:
    literal = text.rust_string(hostile)
    assert re.fullmatch(r'"(?:[^"\\\r\n]|\\["\\]|\\u\{[0-9a-f]+\})*"', literal)
    assert re.sub(r'\\(["\\])', r"\1", literal[1:-1]) == text.line(hostile)


@on_each_text
def test_rust_code_is_one_span(hostile: str) -> None:
    result = text.rust_code(hostile)
    assert re.fullmatch(r"`[^`\r\n]*`", result)
    assert result[1:-1] == text.line(hostile).replace("`", "'")


@on_each_text
def test_a_markdown_cell_shows_its_text(hostile: str) -> None:
    parser = pytest.importorskip("markdown_it").MarkdownIt("commonmark").enable("table")
    html = parser.render(f"| a | b |\n| --- | --- |\n| x{text.markdown(hostile)}y | z |\n")
    assert html.count("<td>") == 2
    cell = re.search(r"<td>x(.*?)y</td>", html)
    assert cell is not None
    assert not re.search("[<>]", cell[1])
    plain = cell[1].replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", '"').replace("&amp;", "&")
    assert plain == text.line(hostile)


@pytest.mark.parametrize(
    ("plain", "shown"),
    [
        ("see http://a.b", "see http&#58;//a.b"),
        ("www.a.b", "www&#46;a.b"),
        ("me@a.b", "me&#64;a.b"),
        ("$x$ and $y$", "&#36;x&#36; and &#36;y&#36;"),
        ("a < b & c > d", "a &lt; b &amp; c &gt; d"),
        ("`a` *b* _c_ #1 | d", r"\`a\` \*b\* \_c\_ \#1 \| d"),
        ("&#36;", r"&amp;\#36;"),
        ("10 kHz", "10 kHz"),
    ],
)
def test_nothing_in_markdown_becomes_a_link_or_a_mark(plain: str, shown: str) -> None:
    assert text.markdown(plain) == shown


PLAIN_CELLS = {
    "": "",
    "speed": "speed",
    "a b": "a b",
    "a  b": "a b",
    "a ": "a",
    "a,b": '"a,b"',
    'say "x"': '"say ""x"""',
    "=1+1": "'=1+1",
    "-5": "-5",
    "+0.5": "+0.5",
    "-a": "'-a",
    "@a,b": '"\'@a,b"',
    "\uff1d1+1": "'\uff1d1+1",
    "\uff20a": "'\uff20a",
    "a\nb": "a b",
}


@pytest.mark.parametrize("plain", PLAIN_CELLS)
def test_a_csv_cell_as_spreadsheets_read_it(plain: str) -> None:
    """Quoted where it must be, a number as it is, and nothing that is run."""
    assert text.csv_cell(plain) == PLAIN_CELLS[plain]


@on_each_text
def test_a_csv_cell_is_one_cell_and_no_formula(hostile: str) -> None:
    row = f"first,{text.csv_cell(hostile)},last"
    (cells,) = csv.reader(io.StringIO(row))
    assert len(cells) == 3
    assert cells[2] == "last"
    assert cells[1].removeprefix("'") == text.line(hostile).removeprefix("'")
    assert not cells[1].startswith(("=", "@"))
    assert cells[1][:1] not in ("+", "-") or re.fullmatch(r"[-+][0-9.]+", cells[1])
