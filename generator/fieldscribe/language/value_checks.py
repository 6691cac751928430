"""The checks of single values: each reports a value that is wrong, with what was probably meant."""

import re
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any, Protocol

from fieldscribe.diagnostics import Report
from fieldscribe.language.hints import form_hint, nearest, quoted, type_hint, value_text
from fieldscribe.language.keys import forms
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import parse_integer
from fieldscribe.language.suggestions import value_hint
from fieldscribe.schema_types import Text, ValueShape, Whole, says_yes_or_no

_YES_NO = {"yes": True, "no": False}


class Check(Protocol):
    """Checks values of one Python type.

    Nearly all values are right, so `fits` is asked first: it may be wrong only by saying no. Then the check itself is
    called with the value, the mapping or list that holds it, its key or index there (None for the whole file), and the
    report.
    """

    @property
    def fits(self) -> Callable[[Any], Any]:
        """The quick test."""

    def __call__(self, value: Any, holder: Map | Seq, at: Any, report: Report, /) -> bool:
        """Return True if the value is right; else there is a finding. What is broken inside it is dropped from it."""


@lru_cache(maxsize=256)
def compiled_pattern(pattern: str) -> re.Pattern[str]:
    """Compile a pattern of the table as ECMAScript reads it: `$` is the very end, not before a last line break."""
    return re.compile(pattern[:-1] + r"\Z" if pattern.endswith("$") else pattern)


class ShapeCheck:
    """Checks a value of one shape, by its Python type; a type with None takes every value.

    A whole number may be written in every notation, and true and false as `yes` and `no`; the check replaces them by
    the number, or by true or false.
    """

    __slots__ = ("checks", "notation", "quick", "shape", "yes_no")

    def __init__(self, shape: ValueShape, checks: Mapping[type, Check | None]) -> None:
        self.shape, self.checks, self.yes_no = shape, checks, says_yes_or_no(shape)
        self.notation = int in checks and str not in checks
        self.quick = {kind: check for kind, check in checks.items() if not (self.yes_no and kind is str)}

    def fits(self, value: Any) -> Any:
        """Return a true value if the value is right as it is."""
        kind = type(value)
        if kind not in self.quick:
            return False
        check = self.quick[kind]
        return check is None or check.fits(value)

    def __call__(self, value: Any, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Return True if the value is right; a `Check`."""
        if isinstance(value, str):
            if self.notation and compiled_pattern(forms.WHOLE.pattern).search(value):
                value = holder[at] = parse_integer(value)
            elif self.yes_no and value in _YES_NO:
                value = holder[at] = _YES_NO[value]
        if type(value) not in self.checks:
            wanted = "yes or no" if self.yes_no else " or ".join(kind.words for kind in self.shape.kinds)
            message = f"expected {wanted}, found {value_text(value)}"
            only_brackets = isinstance(value, int) and list(self.checks) == [Seq]
            hint = None if only_brackets else value_hint(at, value)
            hint = hint or type_hint(value, self.checks, self.shape)
            report.error("wrong-type", message, holder.span(at), hint)
            return False
        check = self.checks[type(value)]
        return check is None or check(value, holder, at, report)


class TextCheck:
    """Checks a text: its choices, length and form."""

    def __init__(self, kind: Text) -> None:
        self.kind = kind
        self.fits: Callable[[str], Any] = self._fits_first

    def _fits_first(self, text: str) -> Any:
        """Build the test when the first such text comes: patterns take long to compile."""
        choices, longest, form = self.kind.choices, self.kind.longest, self.kind.form
        if choices:
            self.fits = frozenset(choices).__contains__
        elif form is None:
            self.fits = lambda text: len(text) <= longest
        else:
            search = compiled_pattern(form.pattern).search
            self.fits = (lambda text: len(text) <= longest and search(text)) if longest else search
        return self.fits(text)

    def __call__(self, value: str, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Return True if the text is right; a `Check`."""
        if self.fits(value):
            return True
        choices, longest, form = self.kind.choices, self.kind.longest, self.kind.form
        if choices:
            near, known = nearest(value, choices), ", ".join(choices)
            hint = value_hint(at, value) or (f"did you mean `{near}`?" if near else f"write one of {known}")
            report.error("wrong-choice", f"{quoted(value)} is none of {known}", holder.span(at), hint)
        elif longest and len(value) > longest:
            message = f"the text has {len(value)} characters, at most {longest} are allowed"
            report.error("text-too-long", message, holder.span(at), "shorten it")
        elif form is not None:
            hint = value_hint(at, value) or form_hint(value, form)
            report.error("wrong-form", f"{quoted(value)} is not {form.words}", holder.span(at), hint)
        return False


class NumberCheck:
    """Checks a whole number: its choices and bounds."""

    def __init__(self, kind: Whole) -> None:
        self.kind = kind

    def fits(self, number: int) -> bool:
        """Return True if the number is right."""
        kind = self.kind
        if kind.choices:
            return number in kind.choices
        return (kind.least is None or number >= kind.least) and (kind.greatest is None or number <= kind.greatest)

    def __call__(self, value: int, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Return True if the number is right; a `Check`."""
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
