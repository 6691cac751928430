"""Patterns: laid out once with blanks, filled for each point."""

import textwrap

import pytest
from fieldscribe.patterns import Pattern, blanks, widths
from fieldscribe.text import c_comment, line

WORDS = [
    ("base_frequency", "BASE_FREQUENCY", "0x0010"),
    ("jump_frequency", "JUMP_FREQUENCY", "0x0A3F"),
]


def _shown(words: tuple[str, ...]) -> str:
    name, macro, address = words
    return f"100 % of {name}\n" + textwrap.fill(f"#define {macro}_ADDRESS {address} /* {name}: {{}} %s */ " * 4, 60)


def test_a_filled_pattern_is_what_would_have_been_written() -> None:
    assert widths(WORDS[0]) == widths(WORDS[1])
    pattern = Pattern(_shown(blanks(WORDS[0])))
    assert [pattern.filled(words) for words in WORDS] == [_shown(words) for words in WORDS]


@pytest.mark.parametrize(("text", "filled"), [("", ""), ("100 %", "100 %"), ("[{}]", "[word]")])
def test_a_pattern_may_hold_one_blank_or_none(text: str, filled: str) -> None:
    assert Pattern(text.format(*blanks(["word"]))).filled(["word"]) == filled


def test_an_empty_word_leaves_no_blank() -> None:
    assert blanks(["", "x"])[0] == ""
    assert Pattern("<{}{}>".format(*blanks(["", "x"]))).filled(["", "y"]) == "<y>"


def test_no_text_of_a_description_can_hold_a_blank() -> None:
    for blank in blanks(["x"] * 66):
        assert line(blank) == c_comment(blank) == ""


def test_rare_signs_of_a_text_are_no_blanks() -> None:
    """Signs above the first blank, one of them twice: what an emoji in a title or a wide digit is made of."""
    name, code = blanks(["name", "A1"])
    text = "\U0001f600\U0001f600{0}\uff11\uff11\uff1a{1}\ufffd"
    assert Pattern(text.format(name, code)).filled(["speed", "B2"]) == text.format("speed", "B2")
