"""The meaning of parameter names in conditions: a point, or a choice of the user, which becomes a variant."""

from collections.abc import Sequence
from fractions import Fraction

from fieldscribe.conditions import TESTS
from fieldscribe.grouping import grouped
from fieldscribe.importing.draft_text import DraftBlock, Names, scalar, snake, titles_text
from fieldscribe.importing.wb.conditions import Condition, any_of, condition_of
from fieldscribe.importing.wb.rows import Row
from fieldscribe.importing.wb.templates import Texts
from fieldscribe.wording.exact import number_text

_MOST_VALUES, _LONGEST = 200, 500


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
        return any_of([_comparison(row, sign, number) for row in rows if row.compares(sign, number)])

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
        if isinstance(when, str) and len(when) > _LONGEST:
            questions.append(f"not carried: condition: {text}")
            return True
        return when


def _choices(rows: Sequence[Row]) -> dict[int, str]:
    """Return the choices: numbers with their names."""
    choices: dict[int, str] = {}
    for row in rows:
        choices = (row.labels or {number: str(number) for number in row.choices[:_MOST_VALUES]}) | choices
    return dict(sorted(choices.items()))


def _comparison(row: Row, sign: str, number: int) -> str:
    """Return the comparison of a point with a value."""
    raw = row.raw(Fraction(number))
    if row.labels or "scale" in row.point.facts:
        return f"{row.point.name}.raw {sign} {number_text(raw)}"
    return f"{row.point.name} {sign} {number}"
