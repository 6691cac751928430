"""Parses expressions, scales and ranges by recursive descent. Nesting is limited; results are cached by their text."""

import re
from fractions import Fraction
from functools import lru_cache
from typing import Literal, NamedTuple, NoReturn

from fieldscribe.language.formula.syntax import (
    Binary,
    Expression,
    FormulaError,
    Name,
    Negate,
    Number,
    Power10,
    Range,
    Scale,
    names,
)
from fieldscribe.language.numbers import MOST_EXPONENT, NumberError, parse_number
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
            f"write {shortened(f'{before.text}.{digits}')} for the decimal number, a blank after the comma for a list",
        )


MOST_OPERATIONS = 50
"""The most operators and parentheses in one expression; this limits its depth too."""

VARIABLES = ("value", "raw")
"""The names of the two sides of a scale; they never name a point."""


class Parser:
    """The tokens of a text and a position among them, with a method for each rule of the grammar."""

    def __init__(self, text: str) -> None:
        self._tokens = tokens(text)
        self._at = 0
        self._operations = 0

    @property
    def token(self) -> Token:
        """The next token."""
        return self._tokens[self._at]

    def sees(self, *signs: str) -> bool:
        """Return True if the next token is one of these signs."""
        return self.token.kind == "sign" and self.token.text in signs

    def sees_word(self, word: str) -> bool:
        """Return True if the next token is this word, without a part."""
        return self.token[:3] == ("name", word, "")

    def sees_call(self, word: str) -> bool:
        """Return True if the next tokens are this word and an opening parenthesis."""
        return self.sees_word(word) and self._tokens[self._at + 1].text == "("

    def take(self) -> Token:
        """Return the next token and move on, but never past the end."""
        token = self.token
        if token.kind != "end":
            self._at += 1
        return token

    def accept(self, sign: str) -> bool:
        """Take the next token if it is this sign; return True if so."""
        if self.sees(sign):
            self._at += 1
            return True
        return False

    def finish(self, hint: str = "") -> None:
        """Raise FormulaError if any tokens are left."""
        if self.token.kind != "end":
            self.refuse("", hint or self._hint_for_rest())

    def refuse(self, wanted: str, hint: str = "") -> NoReturn:
        """Raise FormulaError for the next token; `wanted` is what should stand there (empty: nothing)."""
        message = f"{wanted} expected, found {self.token}" if wanted else f"unexpected {self.token}"
        raise FormulaError(message, self.token.column, hint)

    def nest(self) -> None:
        """Count an operator or a parenthesis, before the parser recurs. Raises FormulaError for too many."""
        self._operations += 1
        if self._operations > MOST_OPERATIONS:
            column = self.token.column
            raise FormulaError(f"an expression has at most {MOST_OPERATIONS} operations", column, "simplify it")

    def fresh_expression(self) -> Expression:
        """Parse one of several expressions in a text; each has its own limit on nesting."""
        self._operations = 0
        return self.expression()

    def expression(self) -> Expression:
        """Parse terms with + and - between them."""
        left = self._term()
        while self.sees("+", "-"):
            self.nest()
            sign = self.take()
            right = self._term()
            left = Binary("+" if sign.text == "+" else "-", left, right, sign.column)
        return left

    def _term(self) -> Expression:
        left = self._signed()
        while self.sees("*", "/"):
            self.nest()
            sign = self.take()
            right = self._signed()
            left = Binary("*" if sign.text == "*" else "/", left, right, sign.column)
        return left

    def _signed(self) -> Expression:
        if self.sees("+", "-"):
            self.nest()
            sign = self.take()
            operand = self._signed()
            return Negate(operand, sign.column) if sign.text == "-" else operand
        return self._power()

    def _power(self) -> Expression:
        base = self._atom()
        if not self.sees("**"):
            return base
        self.nest()
        sign = self.take()
        if not (isinstance(base, Number) and base.value == 10):
            raise FormulaError("only powers of ten are supported", sign.column, "write 10 ** n, or a product")
        column = self.token.column
        return _exponent(self._signed(), column)

    def _atom(self) -> Expression:
        token = self.token
        if token.kind == "number":
            return Number(number(self.take()), token.column)
        if token.kind == "name":
            return self.name()
        if self.sees("("):
            self.nest()
            self.take()
            inside = self.expression()
            if not self.accept(")"):
                self.refuse("`)`", self._hint_for_rest())
            return inside
        self.refuse("a number or a name", "an interval is written low..high" if self.sees("..") else "")
        return None

    def name(self) -> Name:
        """Parse a name with its part."""
        token = self.token
        if token.kind != "name":
            self.refuse("a name")
        if token.part not in ("", "raw", "value"):
            column = token.column + len(token.text)
            hint = "leave it out; a single bit or flag is a point of its own, with `bits`"
            raise FormulaError(f"{token}: a point has `.raw` and `.value` only", column, hint)
        if token.part and token.text in VARIABLES:
            raise FormulaError(f"{token}: `{token.text}` is a number and has no part", token.column, "leave it out")
        self.take()
        return Name(token.text, "raw" if token.part == "raw" else "value", token.column)

    def _hint_for_rest(self) -> str:
        """Return the hint for text that follows a complete expression."""
        previous = self._tokens[self._at - 1] if self._at else None
        if self.sees(","):
            return "a decimal number has a point, not a comma"
        if self.sees("=", "=="):
            return "a scale has one = and starts with raw or value"
        if self.sees("<", "<=", ">", ">=", "!="):
            return "comparisons stand in conditions"
        if self.sees("(") and previous is not None and previous.kind == "name":
            return "there are no functions; write * to multiply"
        if self.token.kind in ("number", "name") or self.sees("("):
            return "an operator is missing, or this is a unit (units have their own key)"
        return ""


def _exponent(operand: Expression, column: int) -> Power10:
    """Return the power of ten with this exponent: a whole number or a name, with a sign. Raises FormulaError."""
    negative = False
    while isinstance(operand, Negate):
        negative = not negative
        operand = operand.operand
    if isinstance(operand, Number):
        if operand.value.denominator != 1:
            raise FormulaError("the exponent is not a whole number", operand.column, "write 10 ** n with a whole n")
        if abs(operand.value) > MOST_EXPONENT:
            raise FormulaError(f"the exponent is beyond {MOST_EXPONENT}", operand.column, "check the exponent")
        return Power10(operand, negative, column)
    if isinstance(operand, Name):
        return Power10(operand, negative, column)
    raise FormulaError(
        "an exponent is one whole number or one point", column, "write 10 ** a * 10 ** b for 10 ** (a + b)"
    )


_CACHED = 16384


@lru_cache(maxsize=_CACHED)
def parse_expression(text: str) -> Expression:
    """Parse an expression of + - * /, 10 ** n and parentheses. Raises FormulaError."""
    parser = Parser(text)
    expression = parser.expression()
    parser.finish()
    return expression


@lru_cache(maxsize=_CACHED)
def parse_scale(text: str) -> Scale:
    """Parse a scale, `raw = <expression of value>` or `value = <expression of raw>`. Raises FormulaError."""
    parser = Parser(text)
    side = parser.token
    how = "write raw = <expression of value> or value = <expression of raw>"
    if side.kind != "name" or side.text not in VARIABLES or side.part:
        parser.refuse("`raw =` or `value =`", how)
    parser.take()
    if not parser.accept("="):
        parser.refuse("`=`", "a scale has one =" if parser.sees("==") else how)
    expression = parser.expression()
    parser.finish()
    uses = names(expression)
    for name in uses:
        if name.name == side.text:
            raise FormulaError(f"`{side.text}` stands on both sides", name.column, how)
    return Scale(
        "raw" if side.text == "raw" else "value", expression, tuple(name for name in uses if name.name not in VARIABLES)
    )


@lru_cache(maxsize=_CACHED)
def parse_range(text: str) -> Range:
    """Parse a range: alternatives between `|` or `,`, each `low..high` or one expression. Raises FormulaError."""
    parser = Parser(text)
    alternatives = []
    listed = True
    while True:
        low = high = parser.fresh_expression()
        if parser.accept(".."):
            listed = False
            high = parser.fresh_expression()
        elif isinstance(low, Binary) and low.op == "-" and not names(low):
            raise FormulaError("a minus sign between two numbers", low.column, "an interval is written low..high")
        alternatives.append((low, high))
        if not (parser.accept(",") or parser.accept("|")):
            break
    parser.finish(_hint_for_range(parser))
    for low, high in alternatives:
        for name in (*names(low), *names(high)):
            if name.name in VARIABLES:
                raise FormulaError(f"`{name.name}` is not known in a range", name.column, "name a point or a number")
    return Range(tuple(alternatives), listed)


def _hint_for_range(parser: Parser) -> str:
    if parser.sees(".."):
        return "an interval has one low and one high end; write | between two intervals"
    if parser.token.kind == "name" and parser.token.text in ("to", "bis", "a", "or", "and", "und", "oder"):
        return "an interval is written low..high, alternatives with |"
    return ""
