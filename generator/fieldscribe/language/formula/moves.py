"""Parses moves, the rules of a behaviour: `set 1 when x == 1 after 2 s`, `ramp to y at 10 Hz/s while x == 1`.

Between the words of a move stand expressions, a condition and a time.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeVar

from fieldscribe.language.formula.conditions import Clauses, parse_condition
from fieldscribe.language.formula.parser import LONGEST, parse_expression
from fieldscribe.language.formula.syntax import Expression, FormulaError

_WORD = re.compile(r"(?:^|(?<=\s))(set|ramp to|down at|at|while|when|after)(?=\s|$)")
_ORDER = re.compile(r"(set|ramp to at( down at)?)( while| when)?( after)?")
_HOW = "write `set …` or `ramp to … at …`; after it `, down at …`, `while …` or `when …`, `after …` as needed"
_WITH_UNIT = re.compile(r"(.*[\w)])\s+([^\W\d][^\s/]*(?:/[a-z]+)?|[%°‰][^\s/]*(?:/[a-z]+)?)")

Parsed = TypeVar("Parsed")


@dataclass(frozen=True, slots=True)
class Amount:
    """An expression with the unit after it (an empty text if there is none); it starts at this column of the move."""

    expression: Expression
    unit: str
    column: int


@dataclass(frozen=True, slots=True)
class Move:
    """What a point does while a condition holds, or `once` when it becomes true, after the time of the `delay`.

    It is set to the target, or moves there at a rate: upwards at the first of `rates`, downwards at the last.
    """

    target: Amount
    rates: tuple[Amount, ...]
    condition: Clauses
    condition_column: int
    once: bool
    delay: Amount | None


@lru_cache(maxsize=4096)
def parse_move(text: str) -> Move:
    """Return the move of a text. Raises FormulaError."""
    parts = _parts(text)
    condition_column, condition = parts.get("when") or parts.get("while") or (0, "")
    return Move(
        _amount(parts.get("set") or parts["ramp to"]),
        tuple([_amount(parts[word], has_unit=True) for word in ("at", "down at") if word in parts]),
        _at_column(parse_condition, condition, condition_column) if condition else (),
        condition_column,
        "when" in parts,
        _amount(parts["after"], has_unit=True) if "after" in parts else None,
    )


def _parts(text: str) -> dict[str, tuple[int, str]]:
    """Return the text after each word, with its column, in the order of the words."""
    if len(text) > LONGEST:
        raise FormulaError(f"a move has at most {LONGEST} characters", LONGEST, "split it")
    words = list(_WORD.finditer(text))
    if not _ORDER.fullmatch(" ".join(word[1] for word in words)) or text[: words[0].start()].strip():
        raise FormulaError("this is no move", 0, _HOW)
    parts = {}
    for word, following in zip(words, [*words[1:], None], strict=True):
        part = text[word.end() : following.start() if following else None].rstrip()
        if following is not None and following[1] == "down at":
            part = part.removesuffix(",").rstrip()
        if not part.strip():
            raise FormulaError(f"nothing follows `{word[1]}`", word.start(), _HOW)
        parts[word[1]] = word.end() + len(part) - len(part.lstrip()), part.strip()
    return parts


def _amount(part: tuple[int, str], *, has_unit: bool = False) -> Amount:
    column, text = part
    match = _WITH_UNIT.fullmatch(text) if has_unit else None
    text, unit = (text, "") if match is None else match.groups()
    return Amount(_at_column(parse_expression, text, column), unit, column)


def _at_column(parse: Callable[[str], Parsed], text: str, column: int) -> Parsed:
    """Parse a part of a move that starts at this column; an error has its column in the whole move."""
    try:
        return parse(text)
    except FormulaError as error:
        raise FormulaError(error.message, error.column + column, error.hint) from None
