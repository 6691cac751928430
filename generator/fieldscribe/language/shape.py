"""Checks a file against the table of keys: reports what is wrong, with a hint of what was meant, and drops it.

`files` calls `check_shape` for each document. The checks are built from the table, each when a value first needs it. A
test compares them with `jsonschema` on every description and every bad input.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from decimal import Decimal
from functools import cache, cached_property, lru_cache, partial
from typing import Any, TypeAlias

from fieldscribe.diagnostics import Report
from fieldscribe.language.hints import form_hint, key_hint, nearest, quoted, type_hint, value_text
from fieldscribe.language.keys import forms, keys_of, needs, required
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import parse_integer
from fieldscribe.language.suggestions import reversed_hint, value_hint
from fieldscribe.schema_types import Items, Kind, Place, Text, ValueShape, Whole, says_yes_or_no

_NAMING = ("name", "code", "id")
_YES_NO = {"yes": True, "no": False}
_SHARED = frozenset((Map, Seq))
"""The types of values that aliases can repeat with something inside."""

Check: TypeAlias = Callable[[Any, Any, Any, Report], bool]
"""Checks a value of one Python type.

It is called with the value, the mapping or list that holds it, its key or index there (None for the whole file), and
the report. It returns True if the value is right; else there is a finding. What is broken inside is dropped from it.
"""

_ANY: Mapping[type, Check | None] = dict.fromkeys((Map, Seq, int, Decimal, bool, str, type(None)))


def check_shape(value: Map, place: Place, report: Report) -> bool:
    """Return True if a file has the shape of a place (`DEVICE` or `PART`); findings go to the report."""
    return not report.full and check_of(place.shape)(value, value, None, report)


@cache
def check_of(shape: ValueShape) -> ShapeCheck:
    """Return the check for a shape; it is built once."""
    checks: dict[type, Check | None] = {}
    for kind in shape.kinds:
        for python_type, check in _by_python_type(kind):
            checks.setdefault(python_type, check)
    return ShapeCheck(shape, checks or _ANY)


def _by_python_type(kind: Kind) -> Iterator[tuple[type, Check | None]]:
    """Yield the Python types of a kind of value, each with its check; None if every value is right."""
    if isinstance(kind, Place):
        yield Map, MappingCheck(kind)
    elif isinstance(kind, Items):
        yield Seq, partial(_check_list, kind)
    elif isinstance(kind, Text):
        yield str, partial(_check_text, kind) if kind.choices or kind.longest or kind.form else None
    elif isinstance(kind, Whole):
        bounded = kind.choices or kind.least is not None or kind.greatest is not None
        yield int, partial(_check_number, kind) if bounded else None
    else:
        yield from dict.fromkeys(kind.types).items()


@lru_cache(maxsize=256)
def compiled_pattern(pattern: str) -> re.Pattern[str]:
    """Compile a pattern of the table as ECMAScript reads it: `$` is the very end, not before a last line break."""
    return re.compile(pattern[:-1] + r"\Z" if pattern.endswith("$") else pattern)


class ShapeCheck:
    """Checks a value of one shape, by its Python type; a type with None takes every value.

    A whole number may be written in every notation, and true and false as `yes` and `no`; the check replaces them by
    the number, or by true or false.
    """

    __slots__ = ("checks", "notation", "shape", "yes_no")

    def __init__(self, shape: ValueShape, checks: Mapping[type, Check | None]) -> None:
        self.shape, self.checks, self.yes_no = shape, checks, says_yes_or_no(shape)
        self.notation = int in checks and str not in checks

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
        if check is None:
            return True
        if type(value) in _SHARED and value.uses is not None:
            return _check_aliased(check, value, holder, at, report)
        return check(value, holder, at, report)


def _check_text(kind: Text, value: str, holder: Map | Seq, at: Any, report: Report) -> bool:
    """Check the choices, the length and the form of a text; a `Check`."""
    choices, longest, form = kind.choices, kind.longest, kind.form
    if choices:
        if value in choices:
            return True
        near, known = nearest(value, choices), ", ".join(choices)
        hint = value_hint(at, value) or (f"did you mean `{near}`?" if near else f"write one of {known}")
        report.error("wrong-choice", f"{quoted(value)} is none of {known}", holder.span(at), hint)
    elif longest and len(value) > longest:
        message = f"the text has {len(value)} characters, at most {longest} are allowed"
        report.error("text-too-long", message, holder.span(at), "shorten it")
    elif form is None or compiled_pattern(form.pattern).search(value):
        return True
    else:
        hint = value_hint(at, value) or form_hint(value, form)
        report.error("wrong-form", f"{quoted(value)} is not {form.words}", holder.span(at), hint)
    return False


def _check_number(kind: Whole, value: int, holder: Map | Seq, at: Any, report: Report) -> bool:
    """Check the choices and the bounds of a whole number; a `Check`."""
    choices, least, greatest = kind.choices, kind.least, kind.greatest
    if choices:
        if value in choices:
            return True
        known = ", ".join(map(str, choices))
        message, hint = f"{value} is none of {known}", f"write {' or '.join(map(str, choices))}"
    else:
        if (least is None or value >= least) and (greatest is None or value <= greatest):
            return True
        bounds = f"at least {least}" if greatest is None else f"{least} to {greatest}"
        message, hint = f"{value} is out of bounds: {bounds}", "correct the number"
    report.error("wrong-choice", message, holder.span(at), hint)
    return False


def _check_list(kind: Items, value: Seq, holder: Map | Seq, at: Any, report: Report) -> bool:
    """Check each item of a list, and that there are enough; a `Check`."""
    if len(value) < kind.least:
        report.error("too-few", "the list is empty", holder.span(at), "fill it or leave the key out")
        return False
    check, broken = check_of(kind.item), []
    for index, element in enumerate(value):
        if not check(element, value, index, report):
            broken.append(index)
            if report.full:
                return False
    for index in reversed(broken):
        _remember_names(value[index], value.file.lost)
        value.drop(index)
    return len(value) >= kind.least


class MappingCheck:
    """Checks a mapping. The keys of its place are looked up when the first such mapping comes."""

    def __init__(self, place: Place) -> None:
        self.place = place
        self._checks: dict[str, ShapeCheck] = {}

    @cached_property
    def _needed(self) -> Mapping[str, Mapping[str, str]]:
        """The message for each key that must be there: always (under an empty key), or beside another key."""
        always = {key: f"the key `{key}` is missing" for key in required(self.place)}
        with_others = {
            key: {other: f"the key `{other}` is missing: `{key}` needs it" for other in others}
            for key, others in needs(self.place).items()
        }
        return {"": always, **with_others}

    def __call__(self, value: Map, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Return True if the mapping is right; a `Check`."""
        missing = self._missing(value)
        broken = self._broken(value, report)
        complete = not missing and len(value) >= self.place.least
        if not broken and complete:
            return True
        if report.full:
            return False
        deeper = {name for key in broken if isinstance(value[key], Map) for name in value[key]}
        for key, message in missing.items():
            if key not in deeper:  # else it is nested a level too deep, and the finding there says so
                report.error("missing-key", message, holder.span(at), f"add `{key}: …`")
        if len(value) < self.place.least:
            report.error("too-few", "the mapping is empty", holder.span(at), "fill it or leave the key out")
        for key in broken:
            self._drop(value, key, is_file=holder is value)
        return complete and len(value) >= self.place.least and not set(required(self.place)) & set(broken)

    def _missing(self, value: Map) -> dict[str, str]:
        """Return the message for each key that is missing."""
        missing: dict[str, str] = {}
        for key, messages in self._needed.items():
            if not key or key in value:
                for needed, message in messages.items():
                    if needed not in value:
                        missing.setdefault(needed, message)
        return missing

    def _broken(self, value: Map, report: Report) -> list[str]:
        """Report the keys that are unknown or whose values are wrong, and return them."""
        broken: list[str] = []
        for key, inner in value.items():
            check = self._checks.get(key) or self._check_of(key)
            if check is None:
                self._report_unknown(value, key, report)
            elif check(inner, value, key, report):
                continue
            broken.append(key)
            if report.full:
                break
        return broken

    def _check_of(self, key: str) -> ShapeCheck | None:
        """Return the check for the value of a key; None for an unknown key."""
        known = keys_of(self.place)
        if key in known:
            shape: ValueShape | None = known[key].shape
        else:
            by_form = sorted(self.place.by_form.items(), key=lambda entry: entry[0] is forms.ANY)
            shape = next((shape for form, shape in by_form if compiled_pattern(form.pattern).search(key)), None)
        if shape is None:
            return None
        self._checks[key] = check_of(shape)
        return self._checks[key]

    def _report_unknown(self, value: Map, key: str, report: Report) -> None:
        known = [form for form in self.place.by_form if form is not forms.ANY]
        numbered = forms.NUMBER in known or forms.BITS in known
        hint = reversed_hint(key, value[key]) if numbered else None
        hint = hint or key_hint(key, keys_of(self.place), known, value[key])
        report.error("unknown-key", f"the key {quoted(key)} is not known here", value.key_span(key), hint)

    def _drop(self, value: Map, key: str, *, is_file: bool) -> None:
        lost = value.file.lost
        if is_file or key == "points":
            lost.add(f"*{key}")  # a whole section
        if key not in keys_of(self.place):
            lost.add(key)
        _remember_names(value[key], lost)
        del value[key]
        value.broken += (key,)


def _check_aliased(check: Check, value: Any, holder: Any, at: Any, report: Report) -> bool:
    """Check a value that aliases repeat: each check has its own copy, which keeps what passes that check."""
    if report.full:
        return False
    if check not in value.uses:
        copy, findings = value.copied(), Report()
        is_right = check(copy, holder, at, findings)
        if findings.count:  # only then places in the text are needed
            use = holder.span(at)
            report.extend(findings if value.span() == use else findings.with_place(use, "used here"))
        value.uses[check] = copy, is_right
    holder[at], is_right = value.uses[check]
    return bool(is_right)


def _remember_names(value: Any, lost: set[str]) -> None:
    """Remember the names inside a dropped value, so that they are not reported as unknown too."""
    waiting: list[Iterable[Any]] = [(value,)]
    seen: set[int] = set()
    while waiting:
        for node in waiting.pop():
            if not isinstance(node, Map | Seq) or id(node) in seen:
                continue
            seen.add(id(node))
            waiting.append(node.values() if isinstance(node, Map) else node)
            if isinstance(node, Map):
                lost.update(node, (node[key] for key in _NAMING if isinstance(node.get(key), str)))
