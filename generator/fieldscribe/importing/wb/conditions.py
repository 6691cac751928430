"""Turns conditions of templates into those of descriptions: `isDefined(a)==0||b!=2`, `not exists(a) or b != 2`.

A name in one means a point, or a choice of the user, which becomes a variant: `Parameters` knows which. `import wb`
makes it of all rows, and sets the conditions of points with it.
"""

import ast
import re
from collections.abc import Sequence
from fractions import Fraction
from typing import TypeAlias

from fieldscribe.conditions import TESTS
from fieldscribe.grouping import grouped
from fieldscribe.importing.draft_text import DraftBlock, Names, scalar, snake, titles_text
from fieldscribe.importing.wb.rows import Row
from fieldscribe.importing.wb.templates import Texts
from fieldscribe.wording.numbers import number_text

Condition: TypeAlias = str | bool
"""A condition as a description writes it; or True or False if it is constant."""

_LONGEST, _LONGEST_WRITTEN, _MOST_VALUES = 4000, 500, 200
_SIGNS = {ast.Eq: "==", ast.NotEq: "!=", ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}
_FLIPPED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
"""The signs of comparisons whose sides are exchanged."""


class Parameters:
    """The parameters of a template by id."""

    def __init__(self, rows: Sequence[Row], texts: Texts) -> None:
        self._rows = grouped((row.key, row) for row in rows if row.is_parameter)
        names = Names()
        self._axes = {key: names.give(snake(key, "choice")) for key, rows in self._rows.items() if rows[0].is_choice}
        self._choices = {key: _choices(self._rows[key]) for key in self._axes}
        self._texts = texts
        self.units = list(dict.fromkeys(row.unit for row in rows if row.unit))
        self._asking: Row | None = None

    @property
    def blocks(self) -> list[DraftBlock]:
        """The variants: choices of the user that no register holds."""
        lines = []
        for key, axis in self._axes.items():
            row, names = self._rows[key][0], Names()
            lines += [f"  {axis}:", f"    title: {titles_text(row.point.title, row.point.titles)}", "    values:"]
            for number, label in self._choices[key].items():
                english = self._texts.english(label)
                name = scalar(names.give(snake(english, "number"), str(abs(number))))
                title = titles_text(english, self._texts.others(label))
                lines.append(f"      {name}: {{number: {number}, title: {title}}}")
        return [DraftBlock(["variants:", *lines])] if lines else []

    def compared(self, name: str, sign: str, number: int) -> Condition:
        """Return the condition that compares a parameter with a number; a missing parameter equals no number."""
        if name in self._axes:
            fits = {TESTS[sign](choice, number) for choice in self._choices[name]}
            return f"{self._axes[name]}.number {sign} {number}" if len(fits) > 1 else True in fits
        rows = self._rows.get(name, [])
        if not rows:
            return sign == "!="
        return any_of([_comparison_of(row, sign, number) for row in rows if row.compares(sign, number)])

    def defined(self, name: str) -> Condition:
        """Return the condition that a parameter exists."""
        if name in self._axes:
            return True
        return any_of([self._exists(row) for row in self._rows.get(name, [])])

    def _exists(self, row: Row) -> Condition:
        """Return the condition that a point exists: its own condition if it came later than the point that names it."""
        if "condition" not in row.item:
            return True
        first, asking = row.item.get("fw"), self._asking.item.get("fw") if self._asking else None
        if not first or first == asking:
            return f"exists({row.point.name})"
        if self._asking is not None:
            self._asking.point.questions.append(
                f"not carried: condition: before {row.point.name} came with firmware {first}"
            )
        return condition_of(str(row.item["condition"]), self)

    def set_condition(self, row: Row) -> None:
        """Set the condition of a point."""
        text, point = row.item.get("condition"), row.point
        if not text or row.is_choice:
            return
        self._asking = row
        when = self.condition(str(text), point.questions)
        self._asking = None
        if when is False:
            point.remarks.append(f"the template has the condition {text}, which is never true")
        elif isinstance(when, str):
            point.facts["when"] = scalar(when)

    def condition(self, text: str, questions: list[str]) -> Condition:
        """Return a condition as a description writes it; if that is impossible, True, with a question."""
        try:
            when = condition_of(text, self)
        except (ValueError, RecursionError) as error:
            questions.append(f"not carried: condition: {text}: {error}")
            return True
        if isinstance(when, str) and len(when) > _LONGEST_WRITTEN:
            questions.append(f"not carried: condition: {text}")
            return True
        return when


def _choices(rows: Sequence[Row]) -> dict[int, str]:
    """Return the choices: numbers with their names."""
    choices: dict[int, str] = {}
    for row in rows:
        choices = (row.labels or {number: str(number) for number in row.choices[:_MOST_VALUES]}) | choices
    return dict(sorted(choices.items()))


def _comparison_of(row: Row, sign: str, number: int) -> str:
    """Return the comparison of a point with a value."""
    raw = row.raw(Fraction(number))
    if row.labels or "scale" in row.point.facts:
        return f"{row.point.name}.raw {sign} {number_text(raw)}"
    return f"{row.point.name} {sign} {number}"


# Conditions as texts.


def condition_of(text: str, names: Parameters) -> Condition:
    """Return the condition of a template as a description writes it. Raises ValueError if it cannot be read."""
    if len(text) > _LONGEST:
        raise ValueError(f"it has more than {_LONGEST} characters")
    python = re.sub("!(?!=)", " not ", text.replace("&&", " and ").replace("||", " or "))
    try:
        return _condition(ast.parse(python.strip(), mode="eval").body, names)
    except (SyntaxError, RecursionError, MemoryError) as error:
        raise ValueError("it is not understood") from error


def any_of(parts: Sequence[Condition]) -> Condition:
    """Return the condition that one of these is true."""
    if True in parts:
        return True
    listed: dict[str, list[str]] = {}
    for text in (text for part in parts if isinstance(part, str) for text in _alternatives(part)):
        match = re.fullmatch(r"([\w.]+) (?:== (-?[\d.]+)|in \((.*)\))", text)
        listed.setdefault(match[1] if match else text, []).extend((match[2] or match[3]).split(", ") if match else [])
    return " or ".join(_one_of(name, list(dict.fromkeys(numbers))) for name, numbers in listed.items()) or False


def _alternatives(condition: str) -> list[str]:
    return [condition] if " and " in condition or "not (" in condition else condition.split(" or ")


def _one_of(name: str, numbers: Sequence[str]) -> str:
    if len(numbers) < 2:
        return " == ".join((name, *numbers))
    return f"{name} in ({', '.join(numbers)})"


def _all_of(parts: Sequence[Condition]) -> Condition:
    """Return the condition that all of these are true, without parts that others imply."""
    if False in parts:
        return False
    texts = list(dict.fromkeys(part for part in parts if isinstance(part, str)))
    known = {f"not ({text})" for text in texts}
    texts = [" or ".join(part for part in text.split(" or ") if part not in known) for text in texts]
    return " and ".join(f"({text})" if " or " in text and len(texts) > 1 else text for text in texts) or True


def _condition(node: ast.expr, names: Parameters) -> Condition:
    """Return the condition for a part of a template's condition. Raises ValueError."""
    match node:
        case ast.BoolOp(op=ast.And(), values=values):
            return _all_of([_condition(value, names) for value in values])
        case ast.BoolOp(values=values):
            return any_of([_condition(value, names) for value in values])
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return opposite(_condition(operand, names))
        case ast.Call(func=ast.Name(id="isDefined"), args=[ast.Name(id=name)], keywords=[]):
            return names.defined(name)
        case ast.Compare(left=left, ops=[sign], comparators=[right]) if type(sign) in _SIGNS:
            return _comparison(left, _SIGNS[type(sign)], right, names)
    raise ValueError(f"`{ast.unparse(node)[:40]}` is not understood")


def _comparison(left: ast.expr, sign: str, right: ast.expr, names: Parameters) -> Condition:
    match _number(left), _number(right):
        case int() as first, int() as second:
            return TESTS[sign](first, second)
        case int(), None:
            return _comparison(right, _FLIPPED.get(sign, sign), left, names)
        case None, int() as number if isinstance(left, ast.Name):
            return names.compared(left.id, sign, number)
        case None, int() as number:
            condition = _condition(left, names)
            one, zero = TESTS[sign](1, number), TESTS[sign](0, number)
            return one if one == zero else condition if one else opposite(condition)
    raise ValueError("a name is compared with no number")


def _number(node: ast.expr) -> int | None:
    if (
        isinstance(node, ast.UnaryOp)
        and isinstance(node.op, ast.USub)
        and (number := _number(node.operand)) is not None
    ):
        return -number
    return node.value if isinstance(node, ast.Constant) and type(node.value) is int else None


def opposite(condition: Condition) -> Condition:
    """Return the opposite of a condition."""
    if isinstance(condition, bool):
        return not condition
    return f"not {condition}" if re.fullmatch(r"exists\(\w+\)", condition) else f"not ({condition})"
