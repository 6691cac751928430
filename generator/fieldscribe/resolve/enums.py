"""Names for numbers: shared and inline enums, flags and special codes of a point."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fieldscribe.language.nodes import Map
from fieldscribe.model import Entry, Enum, Flag, Special
from fieldscribe.resolve.drafts import Draft, humanised
from fieldscribe.resolve.scope import Scope, titles, unknown_name
from fieldscribe.resolve.values import integer, interval


def enum_of(scope: Scope, draft: Draft, closed: bool) -> Enum | None:
    """The point's enum; inline ones are named after the point, once for all its sets."""
    raw = draft.get("enum")
    if raw is None:
        return None
    if isinstance(raw, str):
        return _shared(scope, draft, raw, closed)
    layer = draft.layer("enum")
    key = f"{draft.enum_name} {id(layer)} {closed}"
    if key not in scope.enums:
        scope.enums[key] = Enum(draft.enum_name, {"en": humanised(draft.enum_name)}, entries_of(scope, raw), closed)
    return scope.enums[key]


def _shared(scope: Scope, draft: Draft, name: str, closed: bool) -> Enum | None:
    key = f"{name} {closed}"
    if key not in scope.enums:
        found = next((value for known, value, _ in scope.declared("enums") if known == name), None)
        if found is None:
            known = [one for one, _, _ in scope.declared("enums")]
            scope.report.error(
                "unknown-enum", f"there is no enum `{name}`", draft.span("enum"), unknown_name(name, known, "enums")
            )
            return None
        scope.enums[key] = Enum(name, {"en": humanised(name)}, entries_of(scope, found), closed)
    return scope.enums[key]


def entries_of(scope: Scope, raw: Map) -> tuple[Entry, ...]:
    """The named numbers in the author's order; a number or a name given twice is a finding."""
    by_number: dict[int, str] = {}
    by_name: dict[str, str] = {}
    result = []
    for key, value in raw.items():
        entry = entry_of(scope, raw, key, value)
        if entry is None:
            continue
        if entry.raw in by_number:
            first = (raw.key_span(by_number[entry.raw]), "first given here")
            scope.report.error(
                "duplicate-enum-value",
                f"the number {entry.raw} is named twice",
                raw.key_span(key),
                "remove one of them",
                [first],
            )
        elif entry.name in by_name:
            first = (raw.key_span(by_name[entry.name]), "first given here")
            scope.report.error(
                "duplicate-enum-name",
                f"two numbers have the name `{entry.name}`",
                raw.span(key),
                "names are unique in an enum",
                [first],
            )
        else:
            result.append(entry)
        by_number.setdefault(entry.raw, key)
        by_name.setdefault(entry.name, key)
    return tuple(result)


def entry_of(scope: Scope, raw: Map, key: str, value: Any) -> Entry | None:
    """One named number."""
    number = integer(key, raw.key_span(key), scope.report)
    if number is None:
        return None
    name = value if isinstance(value, str) else str(value["name"])
    return Entry(number, name, entry_titles(value, name), None if isinstance(value, str) else value.get("quantity"))


def entry_titles(value: Map | str, name: str) -> Mapping[str, str]:
    """The titles of an entry: what it says by language, else its name."""
    texts = {} if isinstance(value, str) else {key: str(text) for key, text in value.items() if len(key) == 2}
    return {"en": humanised(name), **texts}


def specials_of(scope: Scope, draft: Draft) -> tuple[Special, ...]:
    """Raw numbers that are no quantity: `special` by name, then the codes of `no_value`."""
    result = []
    raw = draft.get("special", {})
    for key, value in raw.items():
        found = interval(key, raw.key_span(key), scope.report)
        if found is not None:
            name = value if isinstance(value, str) else str(value["name"])
            result.append(Special(*found, name, entry_titles(value, name), False))
    for index, value in enumerate(draft.get("no_value", ())):
        number = integer(value, draft.get("no_value").span(index), scope.report)
        if number is not None:
            name = "no_value" if index == 0 else f"no_value_{index + 1}"
            result.append(Special(number, number, name, {"en": "No value"}, True))
    return tuple(result)


def flags_of(scope: Scope, draft: Draft, width: int) -> tuple[Flag, ...]:
    """The bits that the word's description names; bits outside the word or taken twice are findings."""
    raw = draft.get("flags", {})
    taken: dict[int, str] = {}
    names: dict[str, str] = {}
    result = []
    for key, value in raw.items():
        high_text, dots, low_text = key.partition("..")
        high, low = int(high_text), int(low_text) if dots else int(high_text)
        name = value if isinstance(value, str) else str(value["name"])
        if high < low:
            scope.report.error("range-reversed", f"bits `{key}` run upwards", raw.key_span(key), f"write {low}..{high}")
        elif high >= width:
            scope.report.error(
                "bit-outside-word",
                f"bit {high} lies outside the {width} bits of the point",
                raw.key_span(key),
                f"bits are numbered {width - 1}..0",
            )
        elif any(bit in taken for bit in range(low, high + 1)):
            other = next(taken[bit] for bit in range(low, high + 1) if bit in taken)
            first = (raw.key_span(other), "taken here")
            scope.report.error(
                "bits-overlap", f"bit {low} is taken twice", raw.key_span(key), "flags cannot overlap", [first]
            )
        elif name in names:
            first = (raw.key_span(names[name]), "first given here")
            scope.report.error(
                "duplicate-enum-name",
                f"two flags have the name `{name}`",
                raw.span(key),
                "names are unique in a word",
                [first],
            )
        else:
            result.append(_flag(scope, low, high - low + 1, name, value))
        taken.update(dict.fromkeys(range(low, high + 1), key))
        names.setdefault(name, key)
    return tuple(result)


def _flag(scope: Scope, low: int, width: int, name: str, value: Map | str) -> Flag:
    if isinstance(value, str):
        return Flag(low, width, name, {"en": humanised(name)}, 1, ())
    values = entries_of(scope, value["values"]) if "values" in value else ()
    meanings = [
        Entry(number, key, titles(value[key]), None) for number, key in enumerate(("zero", "one")) if key in value
    ]
    return Flag(
        low, width, name, titles(value.get("title"), humanised(name)), value.get("active", 1), values or tuple(meanings)
    )
