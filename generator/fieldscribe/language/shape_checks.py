"""The checks of single values: each reports a wrong value and drops it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from fieldscribe.diagnostics import Report
from fieldscribe.language.hints import form_hint, key_hint, nearest, quoted, shown, type_hint
from fieldscribe.language.keys import forms, keys_of, needs, required
from fieldscribe.language.meant import reversed_hint, value_hint
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import parse_integer

if TYPE_CHECKING:
    from fieldscribe.kinds import Form, Place, Shape, Text, Whole

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


_YES_NO = {"yes": True, "no": False}
_NAMING = ("name", "code", "id")
_MOST_PLANS = 1000
_BEYOND = 10**70
"""No number of a file is so large."""


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


class ItemsCheck:
    """Checks a list: each item, and that there are at least `least`."""

    __slots__ = ("item", "least")

    def __init__(self, item: ShapeCheck, least: int) -> None:
        self.item, self.least = item, least

    def fits(self, value: Seq) -> bool:
        """Whether all items surely are right."""
        free, tests, _ = self.item.at_hand
        if value.uses is not None or len(value) < self.least:
            return False
        for element in value:
            kind = type(element)
            if kind not in free and not (kind in tests and tests[kind](element)):
                return False
        return True

    def __call__(self, value: Seq, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Whether the list is right; a `Check`."""
        if value.uses is not None:
            return _check_aliased(self, value, holder, at, report)
        if len(value) < self.least:
            report.error("too-few", "the list is empty", holder.span(at), "fill it or leave the key out")
            return False
        free, tests, item = self.item.at_hand
        broken = []
        for index, element in enumerate(value):
            kind = type(element)
            if kind in free or (kind in tests and tests[kind](element)):
                continue
            if not item(element, value, index, report):
                broken.append(index)
                if report.full:
                    return False
        for index in reversed(broken):
            _remember_names(value[index], value.file.lost)
            del value[index], value.item_at[index]
        return len(value) >= self.least


class Plan(NamedTuple):
    """What is to check in mappings with these keys."""

    entries: tuple[tuple[str, frozenset[type], dict[type, Test], ShapeCheck | None], ...]
    """For each key the free types and tests of what stands there, and its check: None for an unknown key."""
    missing: tuple[tuple[str, str], ...]
    """Each missing key with a message."""
    complete: bool


_NOTHING: tuple[frozenset[type], dict[type, Test], None] = (frozenset(), {}, None)


class KeysCheck:
    """Checks a mapping; the checks of its keys are made when the first such mapping comes."""

    __slots__ = ("additional", "check_of", "patterns", "place", "plans", "properties", "required")

    def __init__(self, place: Place, check_of: Callable[[Shape], ShapeCheck]) -> None:
        self.place, self.check_of = place, check_of
        self.plans: dict[tuple[str, ...], Plan] = {}
        self.properties: dict[str, ShapeCheck] | None = None

    def _open(self) -> dict[str, ShapeCheck]:
        place, check_of = self.place, self.check_of
        self.properties = {name: check_of(key.shape) for name, key in keys_of(place).items()}
        self.patterns = [
            (form, compiled_pattern(form.pattern), check_of(shape))
            for form, shape in place.by_form.items()
            if form is not forms.ANY
        ]
        other = place.by_form.get(forms.ANY)
        self.additional = None if other is None else check_of(other)
        self.required = frozenset(required(place))
        return self.properties

    def fits(self, value: Map) -> bool:
        """Whether such keys were met before, and all values surely are right."""
        plan = self.plans.get(tuple(value))
        if plan is None or not plan.complete or value.uses is not None:
            return False
        for key, free, tests, _ in plan.entries:
            entry = value[key]
            kind = type(entry)
            if kind not in free and not (kind in tests and tests[kind](entry)):
                return False
        return True

    def __call__(self, value: Map, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Whether the mapping is right; a `Check`."""
        if value.uses is not None:
            return _check_aliased(self, value, holder, at, report)
        keys = tuple(value)
        plan = self.plans.get(keys) or self._plan(keys)
        broken = self._broken(plan, value, report)
        if not broken and plan.complete:
            return True
        if report.full:
            return False
        deeper = {name for key in broken if isinstance(value[key], Map) for name in value[key]}
        for key, message in plan.missing:
            if key not in deeper:  # else it stands a level too deep, and the finding there says so
                report.error("missing-key", message, holder.span(at), f"add `{key}: …`")
        if len(value) < self.place.least:
            report.error("too-few", "the mapping is empty", holder.span(at), "fill it or leave the key out")
        for key in broken:
            self._drop(value, key, is_file=holder is value)
        return plan.complete and len(value) >= self.place.least and self.required.isdisjoint(broken)

    def _broken(self, plan: Plan, value: Map, report: Report) -> list[str]:
        """The keys that are unknown or whose values are wrong, as far as findings are kept."""
        broken: list[str] = []
        for key, free, tests, check in plan.entries:
            entry = value[key]
            kind = type(entry)
            if kind in free or (kind in tests and tests[kind](entry)):
                continue
            if check is None:
                self._unknown(value, key, report)
            elif check(entry, value, key, report):
                continue
            broken.append(key)
            if report.full:
                break
        return broken

    def _plan(self, keys: tuple[str, ...]) -> Plan:
        """What follows from a list of keys; kept for the next mapping that has the same, if there are not too many."""
        properties = self.properties or self._open()
        checks = {key: properties.get(key) or self._pattern(key) for key in keys}
        entries = ((key, *(_NOTHING if check is None else check.at_hand)) for key, check in checks.items())
        missing = self._missing(keys)
        plan = Plan(tuple(entries), tuple(missing.items()), not missing and len(keys) >= self.place.least)
        if len(self.plans) < _MOST_PLANS:
            self.plans[keys] = plan
        return plan

    def _pattern(self, key: str) -> ShapeCheck | None:
        for _, pattern, pattern_check in self.patterns:
            if pattern.search(key):
                return pattern_check
        return self.additional

    def _missing(self, keys: tuple[str, ...]) -> dict[str, str]:
        missing = {key: f"the key `{key}` is missing" for key in required(self.place) if key not in keys}
        for key, beside in needs(self.place).items():
            for needed in beside:
                if key in keys and needed not in keys:
                    missing.setdefault(needed, f"the key `{needed}` is missing: `{key}` needs it")
        return missing

    def _unknown(self, value: Map, key: str, report: Report) -> None:
        entry, known = value[key], [form for form, _, _ in self.patterns]
        named = forms.NUMBER in known or forms.BITS in known
        properties = self.properties or {}
        hint = (reversed_hint(key, entry) if named else None) or key_hint(key, properties, known, entry)
        report.error("unknown-key", f"the key {quoted(key)} is not known here", value.key_span(key), hint)

    def _drop(self, value: Map, key: str, *, is_file: bool) -> None:
        lost = value.file.lost
        if is_file or key == "points":
            lost.add(f"*{key}")  # a whole section
        if key not in (self.properties or ()):
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
