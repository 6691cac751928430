"""Names for numbers: shared and inline enums, and flags of a point."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from fieldscribe.language.meant import interval_meant
from fieldscribe.language.numbers import parse_integer
from fieldscribe.model import Entry, Enum, Flag
from fieldscribe.resolve.scope import Scope, humanised, titles
from fieldscribe.resolve.values import bits_named, integer

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.diagnostics import Span
    from fieldscribe.language.nodes import Map
    from fieldscribe.resolve.point_facts import PointFacts


_WIDEST = 63
"""The highest bit of the widest type: a greater number cannot be a bit number."""
_MASKS = 3
"""So many successive powers of two as keys are probably masks, not bit numbers."""


def enum_of(scope: Scope, facts: PointFacts, closed: bool) -> Enum | None:
    """The point's enum; inline ones are named after the point, once for all its sets."""
    raw = facts.get("enum")
    if raw is None:
        return None
    is_shared = isinstance(raw, str)
    name, entries = (raw, scope.named_enums.get(raw)) if is_shared else (facts.enum_name, raw)
    if entries is None:
        scope.unknown("enum", name, facts.span("enum"), scope.named_enums)
        facts.failed.add("enum")
        return None
    key = (name, id(entries), closed)
    if key not in scope.enums:
        was = () if is_shared else facts.old_enum_names
        scope.enums[key] = Enum(name, {"en": humanised(name)}, entries_of(scope, entries), closed, was)
    if entries.broken or len(scope.enums[key].entries) < len(entries):
        facts.failed.add("enum")  # some of its names are not known
    return scope.enums[key]


def entries_of(scope: Scope, node: Map) -> tuple[Entry, ...]:
    """The named numbers in the author's order; a number or a name given twice is a finding."""
    by_number: dict[int, str] = {}
    by_name: dict[str, str] = {}
    result = []
    for key, value in node.items():
        entry = _entry(scope, node, key, value)
        if entry is None:
            continue
        if entry.raw in by_number:
            first = (node.key_span(by_number[entry.raw]), "first given here")
            message = f"the number {entry.raw} is named twice"
            scope.report.error("duplicate-enum-value", message, node.key_span(key), "remove one of them", [first])
        elif entry.name in by_name:
            first = (node.key_span(by_name[entry.name]), "first given here")
            message = f"two numbers have the name `{entry.name}`"
            scope.report.error("duplicate-enum-name", message, node.span(key), "names are unique in an enum", [first])
        else:
            result.append(entry)
        by_number.setdefault(entry.raw, key)
        by_name.setdefault(entry.name, key)
    return tuple(result)


def _entry(scope: Scope, node: Map, key: str, value: Any) -> Entry | None:
    if interval_meant(key) is not None:
        hint = "write a row for each number that has a name; the others need none"
        scope.report.error("bad-number", f"`{key[:60]}` is not a single number", node.key_span(key), hint)
        return None
    number = integer(key, node.key_span(key), scope.report)
    if number is None:
        return None
    name = name_of(value)
    return Entry(number, name, entry_titles(value, name), None if isinstance(value, str) else value.get("quantity"))


def name_of(value: Map | str) -> str:
    """The name that an entry says, alone or among other facts."""
    return value if isinstance(value, str) else str(value["name"])


def entry_titles(value: Map | str, name: str) -> Mapping[str, str]:
    """The titles of an entry: what it says by language, else its name."""
    texts = {} if isinstance(value, str) else {key: str(text) for key, text in value.items() if len(key) == 2}
    return {"en": humanised(name), **texts}


@dataclass(slots=True)
class _Taken:
    """The numbers and names that a word has used so far, with their places in the text."""

    scope: Scope
    what: str
    rule: str
    numbers: list[tuple[int, int, Span]] = field(default_factory=list)
    names: dict[str, Span] = field(default_factory=dict)

    def takes(self, band: tuple[int, int], name: str, key: Span, value: Span) -> bool:
        """Take a name and the numbers from low to high; False, with a finding, if some of that is taken already."""
        low, high = band
        other = next((span for first, last, span in self.numbers if first <= high and low <= last), None)
        if other is not None:
            message = f"the {self.what} {low if low == high else f'{high}..{low}'} is taken twice"
            self.scope.report.error(self.rule, message, key, "remove one of them", [(other, "first taken here")])
            return False
        if name in self.names:
            first = (self.names[name], "first given here")
            message = f"the name `{name}` is given twice"
            self.scope.report.error("duplicate-enum-name", message, value, "names are unique in a point", [first])
            return False
        self.numbers.append((low, high, key))
        self.names[name] = value
        return True


def flags_of(scope: Scope, facts: PointFacts, bits: tuple[int, int] | None, width: int) -> tuple[Flag, ...]:
    """The flags of a point, read by bit numbers of its word; bits outside the point or named twice are findings.

    A flag of a point that takes only some `bits` of its word counts from the lowest of them.
    """
    node: Map | None = facts.get("flags")
    if node is None:
        return ()
    _warn_of_masks(scope, node)
    taken = _Taken(scope, "bit", "bits-overlap")
    result = []
    last, first = bits or (width - 1, 0)
    for key, value in node.items():
        high, low = bits_named(key)
        span, name = node.key_span(key), name_of(value)
        if high < low:
            hint = f"the higher bit stands first: {low}..{high}"
            scope.report.error("range-reversed", f"bits `{key}` run upwards", span, hint)
        elif not first <= low <= high <= last:
            if not facts.failed & {"type", "bits"}:
                outside = high if high > last else low
                message = f"bit {outside} lies outside the {width} bits of the point"
                hint = f"bits are numbered {last}..{first}{', as in the word' if bits else ''}"
                place = outside.bit_length() - 1
                if outside > _WIDEST and outside == 1 << place and first <= place <= last:
                    hint += f"; the mask {key} is bit {place}"
                scope.report.error("bit-outside-word", message, span, hint)
        elif taken.takes((low, high), name, span, node.span(key)):
            result.append(_flag(scope, node, key, low - first, high - low + 1))
    return tuple(result)


def _warn_of_masks(scope: Scope, node: Map) -> None:
    """A warning where the keys look like the masks of the bits, 1, 2, 4, 8, and not like their numbers."""
    keys = list(node)
    if len(keys) >= _MASKS and not any(".." in key for key in keys):
        numbers = [parse_integer(key) for key in keys]
        if numbers == [1 << place for place in range(len(numbers))]:
            hint = "keys are bit numbers from 0: write 0, 1, 2, 3 for the masks 1, 2, 4, 8"
            scope.report.warning("looks-like-masks", "these look like masks of bits", node.key_span(keys[0]), hint)


def _flag_values(scope: Scope, value: Map) -> tuple[Entry, ...]:
    """The names of a flag's numbers: its own, or those of a shared enum."""
    raw: Map | str | None = value.get("values")
    entries = scope.named_enums.get(raw) if isinstance(raw, str) else raw
    if entries is None:
        if raw is not None:
            scope.unknown("enum", str(raw), value.span("values"), scope.named_enums)
        return ()
    return entries_of(scope, entries)


def _flag(scope: Scope, node: Map, key: str, low: int, width: int) -> Flag:
    value: Map | str = node[key]
    name = name_of(value)
    if isinstance(value, str):
        return Flag(low, width, name, {"en": humanised(name)}, 1, ())
    named = _flag_values(scope, value)
    for entry in named:
        if not 0 <= entry.raw < 1 << width:
            message = f"`{entry.name}` is {entry.raw}, which {width} bit{'s' if width > 1 else ''} cannot hold"
            scope.report.error("enum-outside-range", message, value.span("values"), f"0..{(1 << width) - 1} can occur")
    meanings = []
    for number, which in enumerate(("zero", "one")):
        if which not in value:
            continue
        if width > 1 or named:
            message = f"`{which}` says what a single bit means"
            scope.report.error("flag-values", message, value.key_span(which), "name the numbers under `values` only")
        meanings.append(Entry(number, which, titles(value[which], which.capitalize()), None))
    if width > 1 and "active" in value:
        message = "`active` is for a single bit"
        scope.report.error("flag-values", message, value.key_span("active"), "name the numbers under `values`")
    title = titles(value.get("title"), humanised(name))
    return Flag(low, width, name, title, value.get("active", 1), named or tuple(meanings))
