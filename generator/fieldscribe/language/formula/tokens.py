"""Splits the text of a formula into tokens, each with its column.

A word that starts with a digit is a number (`12h` is 18) or an error. A word that starts with a letter is a name
(`b082`, `F004`), unless it is hexadecimal in capitals with a small h (`FFFFh`). `ffh` is a name; the number is written
`0ffh`.
"""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Literal, NamedTuple, NoReturn

from fieldscribe.language.formula.syntax import FormulaError
from fieldscribe.language.numbers import NumberError, parse_number
from fieldscribe.text import shortened

LONGEST = 2000
"""The most characters that a formula may have."""

_TOKEN = re.compile(
    r"""[ \t]*(?:
      (?P<number>[0-9]+(?:\.[0-9]+)?[eE][+-]?[0-9]+(?![0-9A-Za-z_]) | [Hh]'[0-9A-Za-z_]*
        | [0-9][0-9A-Za-z_]*(?:\.[0-9][0-9A-Za-z_]*)* | [A-F][0-9A-F]*h(?![0-9A-Za-z_]|\.[A-Za-z]))
    | (?P<name>[A-Za-z][0-9A-Za-z_]*)(?:\.(?P<part>[A-Za-z][0-9A-Za-z_]*))?
    | (?P<sign>\*\*|\.\.|<=|>=|==|!=|[-+*/()=<>|,])
    | (?P<end>\Z)
    )""",
    re.VERBOSE,
)
_COMMA = re.compile(r"[0-9],[0-9]")
_STRANGE = {
    ".": "a decimal number has digits on both sides of the point; an interval is written low..high",
    "^": "a power of ten is written 10 ** n",
    "%": "a unit is not part of a formula",
    "\u00b0": "a unit is not part of a formula",
    "\u2212": "write - with the key of the keyboard",
    "\u2013": "write - with the key of the keyboard, or .. for an interval",
    "\u00d7": "write *",
    "\u00b7": "write *",
    "\u22c5": "write *",
    "\u00f7": "write /",
    ":": "write / to divide, .. for an interval",
    "\u2026": "write two points: ..",
    "~": "an interval is written low..high",
    "\u2264": "write <=",
    "\u2265": "write >=",
    "\u2260": "write !=",
    "&": "write and",
    "'": "names stand without quotes; a hexadecimal number is written H'33F, 33Fh or 0x33F",
    '"': "names stand without quotes",
    "[": "a list stands in parentheses",
    "]": "a list stands in parentheses",
    "!": "write not, or != between two things",
    "\n": "write the formula on one line",
}


class Token(NamedTuple):
    """A token; `part` is the word after the point in `NAME.part`, else empty."""

    kind: Literal["number", "name", "sign", "end"]
    text: str
    part: str
    column: int

    def __str__(self) -> str:
        """Return the token as messages name it."""
        return "the end" if self.kind == "end" else f"`{shortened(self.text + ('.' + self.part if self.part else ''))}`"


def tokens(text: str) -> list[Token]:
    """Return all tokens, the last one of kind `end`. Raises FormulaError."""
    if len(text) > LONGEST:
        raise FormulaError(f"a formula has at most {LONGEST} characters", LONGEST, "split it")
    tokens: list[Token] = []
    offset = 0
    while True:
        match = _TOKEN.match(text, offset)
        if match is None:
            _refuse(text, offset)
        kind = match.lastgroup
        if kind == "end":
            tokens.append(Token("end", "", "", len(text.rstrip(" \t"))))
            return tokens
        tokens.append(_token(match))
        if tokens[-1].text == "," and _COMMA.match(text, max(0, match.end() - 2)):
            _refuse_comma(tokens, text, match.end())
        offset = match.end()


def number(token: Token) -> Fraction:
    """Return the number of a number token. Raises FormulaError."""
    try:
        return parse_number(token.text)
    except NumberError as error:
        raise FormulaError(error.message, token.column, error.hint) from None


def _token(match: re.Match[str]) -> Token:
    if (text := match["number"]) is not None:
        return Token("number", text, "", match.start("number"))
    if (text := match["name"]) is not None:
        return Token("name", text, match["part"] or "", match.start("name"))
    return Token("sign", match["sign"], "", match.start("sign"))


def _refuse(text: str, offset: int) -> NoReturn:
    column = offset + len(text[offset:]) - len(text[offset:].lstrip(" \t"))
    char = text[column]
    what = f"`{char}`" if char.isprintable() and not char.isspace() else f"character U+{ord(char):04X}"
    raise FormulaError(f"{what} is not part of a formula", column, _STRANGE.get(char, ""))


def _refuse_comma(tokens: list[Token], text: str, end: int) -> None:
    """Refuse `0,5`, which could be a decimal or a list; after a code or a hexadecimal number it is a list."""
    before = tokens[-2]
    if before.kind == "number" and before.text.isdigit():
        after = re.match(r"[0-9]+", text[end:])
        digits = after[0] if after else ""
        raise FormulaError(
            f"`{shortened(f'{before.text},{digits}')}` could be a decimal number or a list",
            before.column,
            f"write {shortened(f'{before.text}.{digits}')} for the decimal number, a blank behind the comma for a list",
        )
