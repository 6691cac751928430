"""The single checks that a schema is made of: each reports what is wrong, in words, and drops it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from fieldscribe.diagnostics import Report
from fieldscribe.language.hints import (
    BITS_KEY,
    NUMBER_KEY,
    form,
    form_hint,
    key_hint,
    nearest,
    quoted,
    shown,
    type_hint,
)
from fieldscribe.language.meant import reversed_hint, value_hint
from fieldscribe.language.nodes import Map, Seq

if TYPE_CHECKING:
    from decimal import Decimal

Check = Callable[[Any, Map | Seq, Any, Report], bool]
"""Value, what holds it, its key or index there (None: it is the file itself), and the report: whether it has the shape.

Broken keys and items are dropped from what holds them. Places are made only for findings.
"""

_NAMING = ("name", "code", "id", "group")


@lru_cache(maxsize=256)
def compiled_pattern(pattern: str) -> re.Pattern[str]:
    """A pattern of the schema as ECMAScript reads it: `$` is the very end, not the place before a last line break."""
    return re.compile(pattern[:-1] + r"\Z" if pattern.endswith("$") else pattern)


def any_value(_value: Any, _holder: Map | Seq, _at: Any, _report: Report) -> bool:
    """Anything is fine."""
    return True


def by_type(checks: Mapping[type, Check], wanted: str, example: Any, pattern: str | None) -> Check:
    """The check of the value's own type, if it is one of the `wanted`."""

    def check(value: Any, holder: Map | Seq, at: Any, report: Report) -> bool:
        found = checks.get(type(value))
        if found is not None:
            return found(value, holder, at, report)
        report.error(
            "wrong-type",
            f"{shown(value)} stands where {wanted} belongs",
            holder.span(at),
            value_hint(at, value) or type_hint(value, checks, example, pattern),
        )
        return False

    return check


def string(choices: list[str] | None, pattern: str | None, longest: int) -> Check:
    """One of the choices, of that length and form."""
    compiled = compiled_pattern(pattern) if pattern else None

    def check(value: str, holder: Map | Seq, at: Any, report: Report) -> bool:
        if choices is not None and value not in choices:
            near = nearest(value, tuple(choices))
            hint = f"did you mean `{near}`?" if near else f"write one of {', '.join(choices)}"
            hint = value_hint(at, value) or hint
            report.error("wrong-choice", f"{quoted(value)} is none of {', '.join(choices)}", holder.span(at), hint)
            return False
        if longest and len(value) > longest:
            message = f"the text has {len(value)} characters, at most {longest} are allowed"
            report.error("text-too-long", message, holder.span(at), "shorten it")
            return False
        if pattern is not None and compiled is not None and not compiled.search(value):
            report.error(
                "wrong-form",
                f"{quoted(value)} is not {form(pattern)}",
                holder.span(at),
                value_hint(at, value) or form_hint(value, pattern),
            )
            return False
        return True

    return check


def number(choices: list[int] | None, least: int | None, greatest: int | None) -> Check:
    """One of the choices, within the bounds."""

    def check(value: int | Decimal, holder: Map | Seq, at: Any, report: Report) -> bool:
        if choices is not None and value not in choices:
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
    """Items that are each fine; `least` of them."""

    def check(value: Seq, holder: Map | Seq, at: Any, report: Report) -> bool:
        if value.verdict is not None and value.verdict[0] is check:
            return value.verdict[1]
        if report.full:
            return False
        if len(value) < least:
            report.error("too-few", "the list is empty", holder.span(at), "fill it or leave the key out")
            return False
        broken = [index for index, one in enumerate(value) if not item(one, value, index, report)]
        for index in reversed(broken):
            _lose(value[index], value.file.lost)
            del value[index], value.item_at[index]
        value.verdict = (check, len(value) >= least)
        return len(value) >= least

    return check


class ObjectCheck:
    """The check of a mapping."""

    __slots__ = ("additional", "dependencies", "known", "least", "patterns", "properties", "required")

    def __init__(
        self,
        properties: Mapping[str, Check],
        patterns: list[tuple[str, re.Pattern[str], Check]],
        additional: Check | None,
        node: Mapping[str, Any],
    ) -> None:
        self.properties = properties
        self.patterns = patterns
        self.additional = additional
        self.required: tuple[str, ...] = tuple(node.get("required", ()))
        self.dependencies: Mapping[str, list[str]] = node.get("dependencies", {})
        self.least: int = node.get("minProperties", 0)

    def __call__(self, value: Map, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Whether the mapping has the shape, as every `Check`."""
        if value.verdict is not None and value.verdict[0] is self:
            return value.verdict[1]
        if report.full:
            return False
        broken = []
        for key, one in value.items():
            found = self.properties.get(key) or self._pattern(key)
            if found is None:
                forms = [text for text, _, _ in self.patterns]
                named = {NUMBER_KEY, BITS_KEY} & {*forms}
                hint = (reversed_hint(key, one) if named else None) or key_hint(key, self.properties, forms, one)
                report.error("unknown-key", f"the key {quoted(key)} is not known here", value.key_span(key), hint)
                broken.append(key)
            elif not found(one, value, key, report):
                broken.append(key)
            if report.full:
                return False
        complete = self._complete(value, holder, at, report)
        for key in broken:
            self._drop(value, key, holder is value)
        fine = complete and not any(key in broken for key in self.required) and len(value) >= self.least
        value.verdict = (self, fine)
        return fine

    def _pattern(self, key: str) -> Check | None:
        for _, pattern, found in self.patterns:
            if pattern.search(key):
                return found
        return self.additional

    def _complete(self, value: Map, holder: Map | Seq, at: Any, report: Report) -> bool:
        missing = {key: f"the key `{key}` is missing" for key in self.required if key not in value}
        for key, needs in self.dependencies.items():
            for needed in needs:
                if key in value and needed not in value:
                    missing.setdefault(needed, f"the key `{needed}` is missing: `{key}` needs it")
        for key, message in missing.items():
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
        _lose(value[key], lost)
        del value[key]
        value.broken += (key,)


def _lose(value: Any, lost: set[str]) -> None:
    """Remember the names in what is dropped."""
    waiting: list[Iterable[Any]] = [(value,)]
    seen: set[int] = set()
    while waiting:
        for one in waiting.pop():
            if not isinstance(one, Map | Seq) or id(one) in seen:
                continue
            seen.add(id(one))
            waiting.append(one.values() if isinstance(one, Map) else one)
            if isinstance(one, Map):
                lost.update(one, (one[key] for key in _NAMING if isinstance(one.get(key), str)))
