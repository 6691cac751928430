"""The checks of single values: each reports a value that is wrong, with what was probably meant."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Protocol

from fieldscribe.language.hints import form_hint, nearest, quoted, shown, type_hint
from fieldscribe.language.keys import forms
from fieldscribe.language.numbers import parse_integer
from fieldscribe.language.suggestions import value_hint

if TYPE_CHECKING:
    from fieldscribe.diagnostics import Report
    from fieldscribe.language.nodes import Map, Seq
    from fieldscribe.schema_types import Form, Text, Whole

_YES_NO = {"yes": True, "no": False}
_BEYOND = 10**70
"""No number of a file is so large."""
Test = Callable[[Any], Any]
"""Whether a value is right, and nothing else. What it does not take may still be right."""


class Check(Protocol):
    """Says whether a value has the shape, and what is wrong; what is broken is dropped from what holds it.

    It is called with the value, what holds it, its key or index there (None: it is the file itself), and the report.
    Nearly all values are right: `fits` is asked first, and places are made only for findings.
    """

    @property
    def fits(self) -> Test:
        """Whether a value surely is right."""

    def __call__(self, value: Any, holder: Map | Seq, at: Any, report: Report, /) -> bool:
        """Whether the value is right; else there is a finding."""


@lru_cache(maxsize=256)
def compiled_pattern(pattern: str) -> re.Pattern[str]:
    """A pattern of the table as ECMAScript reads it: `$` is the very end, not the place before a last line break."""
    return re.compile(pattern[:-1] + r"\Z" if pattern.endswith("$") else pattern)


class ShapeCheck:
    """Picks the check for the type of the value, if that is one of the `wanted` types; None takes every value.

    A whole number may be written in every notation of numbers, and true and false as `yes` and `no`; from here on it is
    a number, or true or false. Values of the `free` types, and those that pass the test of their type, are right: who
    holds many values asks these first.
    """

    __slots__ = ("checks", "example", "form", "free", "notation", "tests", "wanted", "yes_no")

    def __init__(
        self,
        checks: Mapping[type, Check | None],
        wanted: str,
        example: Any,
        form: Form | None,
        *,
        yes_no: bool,
    ) -> None:
        self.checks, self.wanted, self.example, self.form, self.yes_no = checks, wanted, example, form, yes_no
        self.free = frozenset(kind for kind, check in checks.items() if check is None)
        self.tests: dict[type, Test] = {}
        self.notation = int in checks and str not in checks

    def __call__(self, value: Any, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Whether the value is right; a `Check`."""
        if self.notation and isinstance(value, str) and compiled_pattern(forms.WHOLE.pattern).search(value):
            value = holder[at] = parse_integer(value)
        elif self.yes_no and isinstance(value, str) and value in _YES_NO:
            value = holder[at] = _YES_NO[value]
        kind = type(value)
        if kind not in self.checks:
            self._wrong_type(value, holder, at, report)
            return False
        check = self.checks[kind]
        if check is None:
            return True
        if not (self.yes_no and kind is str):
            self.tests[kind] = check.fits
        return check(value, holder, at, report)

    @property
    def at_hand(self) -> tuple[frozenset[type], dict[type, Test], ShapeCheck]:
        """What to ask first, and the check itself."""
        return self.free, self.tests, self

    def _wrong_type(self, value: Any, holder: Map | Seq, at: Any, report: Report) -> None:
        message = f"{shown(value)} stands where {self.wanted} belongs"
        hint = value_hint(at, value) or type_hint(value, self.checks, self.example, self.form)
        report.error("wrong-type", message, holder.span(at), hint)


class TextCheck:
    """Checks a text: its choices, length and form."""

    __slots__ = ("_fits", "kind")

    def __init__(self, kind: Text) -> None:
        self.kind = kind
        self._fits: Test | None = None

    @property
    def fits(self) -> Test:
        """Made when the first such text comes: patterns take long to compile."""
        if self._fits is None:
            choices, longest, form = self.kind.choices, self.kind.longest, self.kind.form
            if choices:
                self._fits = frozenset(choices).__contains__
            elif form is None:
                self._fits = lambda text: len(text) <= longest
            else:
                search = compiled_pattern(form.pattern).search
                self._fits = (lambda text: len(text) <= longest and search(text)) if longest else search
        return self._fits

    def __call__(self, value: str, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Whether the text is right; a `Check`."""
        if self.fits(value):
            return True
        choices, longest, form = self.kind.choices, self.kind.longest, self.kind.form
        if choices:
            near = nearest(value, choices)
            hint = f"did you mean `{near}`?" if near else f"write one of {', '.join(choices)}"
            hint = value_hint(at, value) or hint
            report.error("wrong-choice", f"{quoted(value)} is none of {', '.join(choices)}", holder.span(at), hint)
        elif longest and len(value) > longest:
            message = f"the text has {len(value)} characters, at most {longest} are allowed"
            report.error("text-too-long", message, holder.span(at), "shorten it")
        elif form is not None:
            hint = value_hint(at, value) or form_hint(value, form)
            report.error("wrong-form", f"{quoted(value)} is not {form.words}", holder.span(at), hint)
        return False


class NumberCheck:
    """Checks a number: its choices and bounds."""

    __slots__ = ("fits", "kind")

    def __init__(self, kind: Whole) -> None:
        self.kind = kind
        least = -_BEYOND if kind.least is None else kind.least
        greatest = _BEYOND if kind.greatest is None else kind.greatest
        self.fits: Test = (kind.choices or range(least, greatest + 1)).__contains__

    def __call__(self, value: int, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Whether the number is right; a `Check`."""
        if self.fits(value):
            return True
        choices, least, greatest = self.kind.choices, self.kind.least, self.kind.greatest
        if choices:
            known = ", ".join(map(str, choices))
            message, hint = f"{value} is none of {known}", f"write {' or '.join(map(str, choices))}"
        else:
            bounds = f"at least {least}" if greatest is None else f"{least} to {greatest}"
            message, hint = f"{value} is out of bounds: {bounds}", "correct the number"
        report.error("wrong-choice", message, holder.span(at), hint)
        return False
