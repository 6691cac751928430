"""The checks of single values: each reports a wrong value and drops it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from fieldscribe.diagnostics import Report
from fieldscribe.language.hints import form_hint, key_hint, nearest, quoted, shown, type_hint
from fieldscribe.language.keys import forms, keys_of, needs, required
from fieldscribe.language.meant import reversed_hint, value_hint
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import parse_integer

if TYPE_CHECKING:
    from fieldscribe.kinds import Form, Place, Shape, Text, Whole

Check = Callable[[Any, Map | Seq, Any, Report], bool]
"""Value, what holds it, its key or index there (None: it is the file itself), and the report: whether it has the shape.

Broken keys and items are dropped from what holds them. Places are made only for findings.
"""

_YES_NO = {"yes": True, "no": False}
_NAMING = ("name", "code", "id")


@lru_cache(maxsize=256)
def compiled_pattern(pattern: str) -> re.Pattern[str]:
    """A pattern of the table as ECMAScript reads it: `$` is the very end, not the place before a last line break."""
    return re.compile(pattern[:-1] + r"\Z" if pattern.endswith("$") else pattern)


def any_value(_value: Any, _holder: Map | Seq, _at: Any, _report: Report) -> bool:
    """Accepts any value."""
    return True


def by_type(
    checks: Mapping[type, Check], wanted: str, example: Any, form: Form | None, *, yes_no: bool = False
) -> Check:
    """Picks the check for the type of the value, if that is one of the `wanted` types.

    A whole number may be written in every notation of numbers, and true and false as `yes` and `no`; from here on it is
    a number, or true or false.
    """
    notation = compiled_pattern(forms.WHOLE.pattern).search if int in checks and str not in checks else None

    def check(value: Any, holder: Map | Seq, at: Any, report: Report) -> bool:
        if notation is not None and isinstance(value, str) and notation(value):
            value = holder[at] = parse_integer(value)
        elif yes_no and isinstance(value, str) and value in _YES_NO:
            value = holder[at] = _YES_NO[value]
        type_check = checks.get(type(value))
        if type_check is not None:
            return type_check(value, holder, at, report)
        report.error(
            "wrong-type",
            f"{shown(value)} stands where {wanted} belongs",
            holder.span(at),
            value_hint(at, value) or type_hint(value, checks, example, form),
        )
        return False

    return check


def string(kind: Text) -> Check:
    """Checks a text: its choices, length and form."""
    choices, longest, form = kind.choices, kind.longest, kind.form
    fits = None if form is None else compiled_pattern(form.pattern).search

    def check(value: str, holder: Map | Seq, at: Any, report: Report) -> bool:
        if choices and value not in choices:
            near = nearest(value, choices)
            hint = f"did you mean `{near}`?" if near else f"write one of {', '.join(choices)}"
            hint = value_hint(at, value) or hint
            report.error("wrong-choice", f"{quoted(value)} is none of {', '.join(choices)}", holder.span(at), hint)
            return False
        if longest and len(value) > longest:
            message = f"the text has {len(value)} characters, at most {longest} are allowed"
            report.error("text-too-long", message, holder.span(at), "shorten it")
            return False
        if form is not None and fits is not None and not fits(value):
            hint = value_hint(at, value) or form_hint(value, form)
            report.error("wrong-form", f"{quoted(value)} is not {form.words}", holder.span(at), hint)
            return False
        return True

    return check


def number(kind: Whole) -> Check:
    """Checks a number: its choices and bounds."""
    choices, least, greatest = kind.choices, kind.least, kind.greatest

    def check(value: int, holder: Map | Seq, at: Any, report: Report) -> bool:
        if choices and value not in choices:
            known = ", ".join(map(str, choices))
            report.error(
                "wrong-choice",
                f"{value} is none of {known}",
                holder.span(at),
                f"write {' or '.join(map(str, choices))}",
            )
            return False
        if (least is not None and value < least) or (greatest is not None and value > greatest):
            bounds = f"at least {least}" if greatest is None else f"{least} to {greatest}"
            report.error("wrong-choice", f"{value} is out of bounds: {bounds}", holder.span(at), "correct the number")
            return False
        return True

    return check


def array(item: Check, least: int) -> Check:
    """Checks a sequence: each item, and that there are at least `least`."""

    def check(value: Seq, holder: Map | Seq, at: Any, report: Report) -> bool:
        if value.uses is not None:
            return _check_aliased(check, value, holder, at, report)
        if report.full:
            return False
        if len(value) < least:
            report.error("too-few", "the list is empty", holder.span(at), "fill it or leave the key out")
            return False
        broken = [index for index, element in enumerate(value) if not item(element, value, index, report)]
        for index in reversed(broken):
            _remember_names(value[index], value.file.lost)
            del value[index], value.item_at[index]
        return len(value) >= least

    return check


class ObjectCheck:
    """Checks a mapping; the checks of its keys are made when the first such mapping comes."""

    __slots__ = ("additional", "check_of", "least", "needs", "patterns", "place", "properties", "ready", "required")

    def __init__(self, place: Place, check_of: Callable[[Shape], Check]) -> None:
        self.place, self.check_of = place, check_of
        self.ready = False

    def _open(self) -> None:
        place, check_of = self.place, self.check_of
        self.properties = {name: check_of(key.shape) for name, key in keys_of(place).items()}
        self.patterns = [
            (form, compiled_pattern(form.pattern), check_of(shape))
            for form, shape in place.by_form.items()
            if form is not forms.ANY
        ]
        other = place.by_form.get(forms.ANY)
        self.additional = None if other is None else check_of(other)
        self.required, self.needs, self.least = required(place), needs(place), place.least
        self.ready = True

    def __call__(self, value: Map, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Whether the mapping is right; a `Check` like the others."""
        if value.uses is not None:
            return _check_aliased(self, value, holder, at, report)
        if report.full:
            return False
        if not self.ready:
            self._open()
        broken = []
        for key, entry in value.items():
            entry_check = self.properties.get(key) or self._pattern(key)
            if entry_check is None:
                known = [form for form, _, _ in self.patterns]
                named = forms.NUMBER in known or forms.BITS in known
                hint = (reversed_hint(key, entry) if named else None) or key_hint(key, self.properties, known, entry)
                report.error("unknown-key", f"the key {quoted(key)} is not known here", value.key_span(key), hint)
                broken.append(key)
            elif not entry_check(entry, value, key, report):
                broken.append(key)
            if report.full:
                return False
        complete = self._complete(value, holder, at, report, broken)
        for key in broken:
            self._drop(value, key, holder is value)
        return complete and not any(key in broken for key in self.required) and len(value) >= self.least

    def _pattern(self, key: str) -> Check | None:
        for _, pattern, pattern_check in self.patterns:
            if pattern.search(key):
                return pattern_check
        return self.additional

    def _complete(self, value: Map, holder: Map | Seq, at: Any, report: Report, broken: list[str]) -> bool:
        missing = {key: f"the key `{key}` is missing" for key in self.required if key not in value}
        for key, beside in self.needs.items():
            for needed in beside:
                if key in value and needed not in value:
                    missing.setdefault(needed, f"the key `{needed}` is missing: `{key}` needs it")
        deeper = {name for key in broken if isinstance(value[key], Map) for name in value[key]}
        for key, message in missing.items():
            if key not in deeper:  # else it stands a level too deep, and the finding there says so
                report.error("missing-key", message, holder.span(at), f"add `{key}: …`")
        if len(value) < self.least:
            report.error("too-few", "the mapping is empty", holder.span(at), "fill it or leave the key out")
        return not missing and len(value) >= self.least

    def _drop(self, value: Map, key: str, is_file: bool) -> None:
        lost = value.file.lost
        if is_file or key == "points":
            lost.add(f"*{key}")  # a whole section
        if key not in self.properties:
            lost.add(key)
        _remember_names(value[key], lost)
        del value[key]
        value.broken += (key,)


def _check_aliased(check: Check, value: Any, holder: Any, at: Any, report: Report) -> bool:
    """Check a value that aliases repeat: once for each check, on a copy that keeps what is right for this check."""
    if report.full:
        return False
    if check not in value.uses:
        copy, own = value.copied(), Report()
        fine = check(copy, holder, at, own)
        report.extend(own if value.span() == holder.span(at) else own.also(holder.span(at), "used here"))
        value.uses[check] = copy, fine
    holder[at], fine = value.uses[check]
    return bool(fine)


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
