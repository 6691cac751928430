"""The facts of one point as texts of a language: a call is laid out once for many points, and filled with these.

And the sentences of docstrings about points, named numbers and flags.
"""

from collections.abc import Callable

from fieldscribe.model import Entry, Flag, Point
from fieldscribe.targets.runtime_calls.point_call import PointFields, keeps
from fieldscribe.targets.runtime_calls.point_expressions import addresses_of, is_limited, number
from fieldscribe.targets.runtime_calls.scope import Leaf, Name, Scope
from fieldscribe.wording import codes_text, condition_text, overflow_texts, range_text, write_texts

_MOST_ENDS = 16
"""The ends of at most this many intervals are fields."""
_SINGLE = 4
"""The fields after these have several texts each."""

Encoders = tuple[Callable[[str], str], Callable[[Leaf], str]]
"""How a language writes a string, and how a string or number."""


def texts_of(point: Point, numbers: str, ends: tuple[str, ...], encoders: Encoders) -> tuple[str, ...]:
    """Return the texts of `PointFields`, one after the other."""
    string, leaf = encoders
    return (
        string(point.terms.group),
        string(point.code) if point.code else "",
        "" if point.default is None else leaf(number(point.default)),
        numbers,
        *map(leaf, addresses_of(point.place.addresses, point.terms.space)),
        *map(leaf, point.place.references.values()),
        *ends,
    )


def end_texts(point: Point, leaf: Callable[[Leaf], str]) -> tuple[str, ...]:
    """Return the ends of the intervals of raw numbers, if they are fields."""
    limits = point.allowed
    if point.form == "float" or limits.moves or len(limits.intervals) * 2 > _MOST_ENDS or not is_limited(point):
        return ()
    return tuple([leaf(end) for interval in limits.fixed for end in interval])


def fields_of_texts(texts: tuple[str, ...], point: Point) -> PointFields:
    """Return the fields of a point that have these texts, or placeholders for them."""
    fields = tuple(map(Name, texts))
    addresses = _SINGLE + len(point.place.addresses)
    references = addresses + len(point.place.references)
    group, code, default, numbers = fields[:_SINGLE]
    several = fields[_SINGLE:addresses], fields[addresses:references], fields[references:]
    return PointFields(group, code or None, default or None, numbers, *several)


_WITH_RANGE = ("scaled", "float", "integer")
"""The forms whose docstring says the range."""

_KEEPS = {"no": "Lost at power-off", "yes": "Each write wears the memory"}
"""What happens to a written value."""


def limits_text(point: Point, scope: Scope) -> str:
    """Return what may be written; empty for a point whose values have no range."""
    return range_text(point, scope.lowered.points) if point.writable and point.form in _WITH_RANGE else ""


def remarks_text(point: Point, scope: Scope, keep: str) -> str:
    """Return sentences about a point; `keep` is the argument with which a program keeps a value over power-off."""
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
    """Return a sentence about a named number; empty if its name says it all."""
    if entry.quantity:
        return sentence(f"{entry.title['en']} ({entry.quantity})")
    return "" if _says_the_same(entry.title["en"], entry.name) else sentence(entry.title["en"])


def flag_text(flag: Flag) -> str:
    """Return sentences about a flag, also whether it is true while its bit is 0; empty if its name says it all."""
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
