"""What the documentation in code says of points beside their titles, of named numbers and of flags."""

from __future__ import annotations

from fieldscribe.model import Entry, Flag, Point
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


def sentence(text: str) -> str:
    """Return the text with a full stop at its end."""
    return text if text.endswith(".") else f"{text}."


def entry_text(entry: Entry) -> str:
    """Return a sentence about a named number; empty where its name says it all."""
    if entry.quantity:
        return sentence(f"{entry.title['en']} ({entry.quantity})")
    return "" if _says_the_same(entry.title["en"], entry.name) else sentence(entry.title["en"])


def flag_text(flag: Flag) -> str:
    """Return sentences about a flag, also whether it is true while its bit is 0; empty where its name says it all."""
    meaning = "; ".join(f"{value.raw}: {value.title['en']}" for value in flag.values) if flag.width == 1 else ""
    if not meaning and flag.active and _says_the_same(flag.title["en"], flag.name):
        return ""
    text = sentence(f"{flag.title['en']} ({meaning})" if meaning else flag.title["en"])
    return text if flag.active else f"{text} True while the bit is 0."


def _says_the_same(title: str, name: str) -> bool:
    return title.casefold() == name.replace("_", " ")


def _kept(point: Point, scope: Scope, keep: str) -> str:
    if point.keeps == "choice":
        return f"{keep} keeps it and wears the EEPROM"
    return _KEEPS.get(point.keeps or "") or f"`{keeps(point, scope)}.send()` keeps it"
