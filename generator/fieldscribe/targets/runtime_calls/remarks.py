"""What the documentation of a point in code says beside its title."""

from __future__ import annotations

from fieldscribe.model import Point
from fieldscribe.targets.runtime_calls.point_call import keeps
from fieldscribe.targets.runtime_calls.scope import Scope
from fieldscribe.wording import codes_text, condition_text, overflow_texts, range_text, write_texts

_WITH_RANGE = ("scaled", "float", "integer")
"""The forms whose docstring says the range."""

_KEEPS = {"no": "Lost at power-off", "yes": "Each write wears the memory"}
"""What becomes of a written value."""


def limits_text(point: Point, scope: Scope) -> str:
    """Return what may be written; empty for a point whose values have no range."""
    return range_text(point, scope.lowered.points) if point.writable and point.form in _WITH_RANGE else ""


def remarks_text(point: Point, scope: Scope, keep: str) -> str:
    """Return sentences about a point; `keep` is what a program says so that a value outlives power-off."""
    text = ""
    if point.when is not None:
        text += f" Exists only when {condition_text(point.when, scope.lowered.points)}."
    if point.conditions and point.writable:
        text += f" To write it takes: {', '.join(condition.replace('_', ' ') for condition in point.conditions)}."
    if point.keeps and point.writable:
        text += f" {_kept(point, scope, keep)}."
    text += "".join(f" {each[0].upper()}{each[1:]}." for each in write_texts(point))
    if point.specials:
        text += f" {codes_text(point)}."
    text += "".join(f" O{each[1:]}." for each in overflow_texts(point))
    return text


def _kept(point: Point, scope: Scope, keep: str) -> str:
    if point.keeps == "choice":
        return f"{keep} keeps it and wears the EEPROM"
    return _KEEPS.get(point.keeps or "") or f"`{keeps(point, scope)}.send()` keeps it"
