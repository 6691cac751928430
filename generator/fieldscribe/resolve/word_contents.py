"""What words hold other than plain numbers: enums, texts, decimal digits, flags, and constant bits."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date
from typing import Any

from fieldscribe.diagnostics import Report, Span
from fieldscribe.language.keys import facts_of
from fieldscribe.language.keys.places import POINT
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import parse_integer
from fieldscribe.language.suggestions import suggest_interval
from fieldscribe.model import NOTATIONS, Allowed, Digits, Entry, Enum, Fixed, Flag, Interval, Shape, Text
from fieldscribe.resolve.dates import is_date, layout_of_date
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope, titles
from fieldscribe.resolve.values import WORD_BITS, integer, number, pattern
from fieldscribe.schema_types import TEXTS
from fieldscribe.text import humanised
from fieldscribe.wording.numbers import number_text

_MOST_WORDS = 500
_LARGEST_DIGIT = 9
_DEFAULT_ENCODING = "ascii"
_OF_TEXTS = facts_of(POINT, TEXTS)
_WIDEST = 63
"""The highest bit of the widest type: a greater number cannot be a bit number."""
_MASKS = 3
"""From this many keys on, successive powers of two are probably masks, not bit numbers."""


def enum_of(scope: Scope, facts: PointFacts, closed: bool) -> Enum | None:
    """Return the point's enum; None if it has none, or after a finding."""
    raw = facts.get("enum")
    if raw is None:
        return None
    enum = named_enum(scope, facts, raw, facts.span("enum"), closed=closed)
    entries = scope.named_enums.get(raw) if isinstance(raw, str) else raw
    if enum is None or entries is None or entries.broken or len(enum.entries) < len(entries):
        facts.failed.add("enum")  # some of its names are not known
    return enum


def named_enum(scope: Scope, facts: PointFacts, raw: Map | str, span: Span, *, closed: bool) -> Enum | None:
    """Return a shared enum by its name, or an inline one without a name; None, after a finding, for a wrong name."""
    name, entries = (raw, scope.named_enums.get(raw, raw)) if isinstance(raw, str) else ("", raw)
    if isinstance(entries, str):
        scope.unknown("enum", name, span, scope.named_enums)
        return None
    floating = facts.pattern_bits
    if floating and isinstance(raw, str):
        name = f"{name}_f{floating}"  # whole numbers may share the enum, too
    key = (name, id(entries), closed)
    if key not in scope.enums:
        scope.enums[key] = Enum(name, entries_of(scope, entries, floating), closed)
    return scope.enums[key]


def entries_of(scope: Scope, node: Map, floating: int = 0) -> tuple[Entry, ...]:
    """Return the named numbers in the author's order; for `floating` points, their bit patterns."""
    taken = Taken(scope.report, "number")
    entries = ((key, _entry(scope, node, key, value, floating)) for key, value in node.items())
    return tuple(
        entry
        for key, entry in entries
        if entry is not None and taken.take(entry.raw, entry.raw, entry.name, node.key_span(key), node.span(key))
    )


def _entry(scope: Scope, node: Map, key: str, value: Any, floating: int) -> Entry | None:
    if suggest_interval(key) is not None:
        hint = "write a row for each number that has a name; the others need none"
        scope.report.error("bad-number", f"`{key[:60]}` is not a single number", node.key_span(key), hint)
        return None
    quantity = None if isinstance(value, str) else value.get("quantity")
    if floating:
        exact = number(key, node.key_span(key), scope.report)
        raw = pattern(exact, floating, node.key_span(key), scope.report)
        quantity = quantity or (None if exact is None else number_text(exact))
    else:
        raw = integer(key, node.key_span(key), scope.report)
    if raw is None:
        return None
    name = name_of(value)
    return Entry(raw, name, entry_titles(value, name), quantity)


def name_of(value: Map | str) -> str:
    """Return the name of an entry, which is a text or a mapping with a name."""
    return value if isinstance(value, str) else str(value["name"])


def entry_titles(value: Map | str, name: str) -> Mapping[str, str]:
    """Return the titles of an entry by language; without an English one, its name in words."""
    if isinstance(value, str):
        return {"en": humanised(name)}
    texts = {key: str(text) for key, text in value.items() if len(key) == 2}
    return {"en": humanised(name), **titles(value.get("title")), **texts}


@dataclass(slots=True)
class Taken:
    """The numbers and names given so far, with their places. `what` is the word for a number in messages."""

    report: Report
    what: str
    rule: str = "duplicate-enum-value"
    _numbers: dict[int, Span] = field(default_factory=dict)
    _names: dict[str, Span] = field(default_factory=dict)

    def take(self, low: int, high: int, name: str, key: Span, value: Span) -> bool:
        """Take the numbers low..high and a name; report and return False if one of them was taken before."""
        numbers = range(low, high + 1)
        first = next((self._numbers[number] for number in numbers if number in self._numbers), None)
        if first is not None:
            message = f"the {self.what} {low if low == high else f'{high}..{low}'} is given twice"
            self.report.error(self.rule, message, key, "remove one of them", [(first, "first given here")])
        elif name in self._names:
            related = [(self._names[name], "first given here")]
            message = f"the name `{name}` is given twice"
            self.report.error("duplicate-enum-name", message, value, "rename one of them", related)
        else:
            self._numbers.update(dict.fromkeys(numbers, key))
            self._names[name] = value
            return True
        return False


def text_of(scope: Scope, facts: PointFacts) -> Text | None:
    """Return the layout of a text; None for another type, or after a finding."""
    if facts.bytes:
        layout = checked_bytes(scope, facts, layout_of(scope, facts))
        if layout.parts and not is_date(scope, facts, layout):
            facts.failed.add("parts")
            return None
        return layout
    if not facts.text:
        for key in _OF_TEXTS:
            inherited = facts.layer(key) is facts.group
            if facts.get(key) is not None and not inherited and "type" not in facts.failed:
                hint = "add `type: text`, or leave it out"
                scope.report.error("text-fact", f"`{key}` is for texts", facts.span(key), hint)
        return None
    layout, span = layout_of(scope, facts), facts.span("characters")
    if "characters" in facts.failed:
        return None
    if facts.get("characters") is None:
        counts = "write `characters` in place of `length`, which counts the words of bytes"
        message, hint = f"`{facts.name}` does not say how long the text is", "add `characters: …`"
        scope.report.error("missing-key", message, facts.span("type"), counts if "length" in facts.node else hint)
    elif layout.encoding == "utf-16" and facts.get("per_word", 1) > 1:
        message, hint = "a word holds one 16-bit unit of utf-16", "leave `per_word` out"
        scope.report.error("text-length", message, facts.span("per_word"), hint)
    elif layout.words <= _MOST_WORDS:
        return layout
    else:
        message = f"{layout.characters} characters are more than {_MOST_WORDS} words hold, the most of a text"
        hint = f"make it several texts of at most {_MOST_WORDS * layout.per_word} characters"
        scope.report.error("text-length", message, span, hint)
    facts.failed.add("characters")
    return None


def layout_of(scope: Scope, facts: PointFacts) -> Text:
    """Return how the characters of a text stand in words: by its own facts, its group, `types` of these, or the bus.

    Without `characters` it has none.
    """
    kind = "bytes" if facts.bytes else str(facts.get("type"))
    holders = [holder.get("types", {}).get(kind, {}) for holder in (facts.group, scope.header)]
    found = {key: value for holder in reversed(holders) for key, value in holder.items()}
    found |= {key: facts.get(key) for key in ("bytes", *_OF_TEXTS) if facts.get(key) is not None}
    order = None if scope.bus is None else scope.bus.get("bytes")
    swapped = found.get("bytes") or (order.get(kind) if isinstance(order, Map) else order)
    padding, low_first = int(found.get("padding", "20h")[:2], 16), swapped == "low first"
    if facts.get("parts"):
        return layout_of_date(facts, per_word=int(found.get("per_word", 2)), low_first=low_first)
    if facts.bytes:
        return layout_of_bytes(facts, low_first=low_first)
    encoding = str(found.get("encoding", _DEFAULT_ENCODING))
    per_word = 1 if encoding == "utf-16" else int(found.get("per_word", 2))
    return Text(found.get("characters", 0), encoding, per_word, padding, low_first)


def digits_of(scope: Scope, facts: PointFacts) -> Digits | None:
    """Return the decimal digits of a word and their names; None if there are none, or after a finding."""
    node: Map | None = facts.get("digits")
    if node is None:
        return None
    enum = named_enum(scope, facts, node["enum"], node.span("enum"), closed=True)
    misfit = next((entry for entry in enum.entries if not 0 <= entry.raw <= _LARGEST_DIGIT), None) if enum else None
    if misfit is not None:
        message = f"`{misfit.name}` is {misfit.raw}, and a digit is 0..{_LARGEST_DIGIT}"
        scope.report.error("enum-outside-range", message, node.span("enum"), "name single digits")
    if enum is None or misfit is not None:
        facts.failed.add("digits")
        return None
    return Digits(node["count"], enum) if enum.entries else None


def allowed_digits(scope: Scope, facts: PointFacts, digits: Digits, greatest: int) -> Allowed:
    """Return the interval from all lowest to all highest digits. Each digit between must also be one of the enum."""
    ones = sum(10**place for place in range(digits.count))
    numbers = [entry.raw for entry in digits.enum.entries]
    low = min(numbers) * ones
    if greatest < max(low, 10 ** (digits.count - 1)) and not facts.failed & {"type", "bits", "space"}:
        message = f"{digits.count} digits do not fit `{facts.name}`, which holds numbers up to {greatest}"
        scope.report.error("range-outside-type", message, facts.span("digits"), "correct `count`, `type` or `bits`")
        low = 0
    return Allowed((Interval(low, min(max(numbers) * ones, greatest)),), False, ())


def fixed_of(scope: Scope, facts: PointFacts, bits: tuple[int, int] | None, width: int) -> Fixed | None:
    """Return the bits of the word that are always written as a constant; None if there are none."""
    node: Map | None = facts.get("fixed")
    if node is None:
        return None
    word = WORD_BITS if bits is not None else width
    taken = 0 if bits is None else ((1 << width) - 1) << bits[1]
    mask, value, numbers = 0, 0, facts.bit_numbers(word)
    for key, content in node.items():
        span, text = node.key_span(key), f"bits {key}" if ".." in key else f"bit {key}"
        ends, number = numbers.range_of(key, span, scope.report), integer(content, node.span(key), scope.report)
        if ends is None or number is None:
            continue
        (high, low), greatest = ends, (1 << ends[0] - ends[1] + 1) - 1
        if not 0 <= low <= high < word:
            if not facts.failed & {"type", "bits"}:
                outside = numbers.number(high if high >= word else low)
                message = f"bit {outside} lies outside the {word} bits of the word"
                hint = f"bits are numbered {numbers.written(word - 1, 0)}"
                scope.report.error("bit-outside-word", message, span, hint)
        elif not 0 <= number <= greatest:
            message = f"{content} does not fit into {text}"
            scope.report.error("range-outside-type", message, node.span(key), f"write 0..{greatest}")
        elif mask & greatest << low:
            scope.report.error("bits-overlap", f"{text} cannot be fixed twice", span, "remove one of them")
        elif taken & greatest << low:
            message = f"{text} cannot be fixed, for the point itself takes it"
            scope.report.error("bits-overlap", message, span, "`fixed` names the bits beside it")
        else:
            mask, value = mask | greatest << low, value | number << low
    return Fixed(mask, value) if mask else None


def flags_of(scope: Scope, facts: PointFacts, bits: tuple[int, int] | None, width: int) -> tuple[Flag, ...]:
    """Return the flags of a point, whose keys are bit numbers of the word.

    `Flag.low` counts from the lowest bit of the point, which may take only some `bits` of the word.
    """
    node: Map | None = facts.get("flags")
    if node is None:
        return ()
    _warn_of_masks(scope, node)
    taken = Taken(scope.report, "bit", "bits-overlap")
    result = []
    last, first = bits or (width - 1, 0)
    numbers = facts.bit_numbers(width if bits is None else WORD_BITS)
    for key, value in node.items():
        span, name = node.key_span(key), name_of(value)
        ends = numbers.range_of(key, span, scope.report)
        if ends is None:
            continue
        high, low = ends
        if not first <= low <= high <= last:
            if not facts.failed & {"type", "bits"}:
                outside = high if high > last else low
                message = f"bit {numbers.number(outside)} lies outside the {width} bits of the point"
                hint = f"bits are numbered {numbers.written(last, first)}{', as in the word' if bits else ''}"
                place = outside.bit_length() - 1
                if outside > _WIDEST and outside == 1 << place and first <= place <= last:
                    hint += f"; the mask {key} is bit {place}"
                scope.report.error("bit-outside-word", message, span, hint)
        elif taken.take(low, high, name, span, node.span(key)):
            result.append(_flag(scope, node, key, low - first, high - low + 1))
    return tuple(result)


def _warn_of_masks(scope: Scope, node: Map) -> None:
    """Warn of keys that look like masks (1, 2, 4, 8) and not like bit numbers."""
    keys = list(node)
    if len(keys) >= _MASKS and not any(".." in key for key in keys):
        numbers = [parse_integer(key) for key in keys]
        if numbers == [1 << place for place in range(len(numbers))]:
            hint = "keys are bit numbers from 0: write 0, 1, 2, 3 for the masks 1, 2, 4, 8"
            scope.report.warning("looks-like-masks", "these look like masks of bits", node.key_span(keys[0]), hint)


def _flag_values(scope: Scope, value: Map) -> tuple[Entry, ...]:
    """Return the names of a flag's numbers: its own, or those of a shared enum."""
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
    for state, which in enumerate(("zero", "one")):
        if which not in value:
            continue
        if width > 1 or named:
            message = f"`{which}` says what a single bit means"
            scope.report.error("flag-values", message, value.key_span(which), "name the numbers under `values` only")
        meanings.append(Entry(state, which, titles(value[which], which.capitalize()), None))
    if width > 1 and "active" in value:
        message = "`active` is for a single bit"
        scope.report.error("flag-values", message, value.key_span("active"), "name the numbers under `values`")
    title = titles(value.get("title"), humanised(name))
    shared = value["values"] if isinstance(value.get("values"), str) else ""
    return Flag(low, width, name, title, value.get("active", 1), named or tuple(meanings), shared)


_TIME = "time since "
_USUAL = "hex"
_OF_CHARACTERS = ("characters", "encoding", "padding")


def layout_of_bytes(facts: PointFacts, *, low_first: bool) -> Text:
    """Return how bytes stand in words; where the notation leaves their number open, they take `length` words."""
    notation, per_word = str(facts.get("notation", _USUAL)), int(facts.get("per_word", 2))
    notation = notation if notation in NOTATIONS else _USUAL
    count = NOTATIONS[notation] or per_word * int(facts.get("length", 1))
    return Text(count, notation, per_word, low_first=low_first)


def checked_bytes(scope: Scope, facts: PointFacts, layout: Text) -> Text:
    """Return the layout of bytes; report facts that they cannot have."""
    for key in _OF_CHARACTERS:
        if facts.get(key) is not None and facts.layer(key) is not facts.group:
            what = (
                "a date or time has its `parts`"
                if facts.get("parts")
                else "bytes have a `notation` and a `length` in words"
            )
            hint = f"{what}: leave it out"
            scope.report.error("text-fact", f"`{key}` is for texts", facts.span(key), hint)
    if facts.get("length") not in (None, layout.words):
        message = f"{layout.encoding} is {layout.characters} bytes, which take {layout.words} words"
        scope.report.error("text-length", message, facts.span("length"), "leave `length` out")
    return layout


def epoch_of(scope: Scope, facts: PointFacts, shape: Shape) -> str:
    """Return the date from which the value counts seconds; empty if it does not, or after a finding."""
    notation = facts.get("notation")
    if notation is None or facts.untyped is not None or facts.failed & {"type", "notation", "scale"}:
        return ""
    epoch = notation.removeprefix(_TIME)
    is_time, unit = epoch != notation, facts.get("unit")
    if is_time == facts.bytes or (is_time and (shape.form not in ("integer", "scaled") or shape.scale_arguments)):
        needs = "whole numbers, with a scale that needs no other point" if is_time else "bytes"
        right = "correct `type`" if is_time else "write `type: bytes`"
        message, hint = f"`notation: {notation}` is for {needs}", f"{right}, or leave it out"
        scope.report.error("wrong-choice", message, facts.span("notation"), hint)
    elif is_time and unit not in (None, "s"):
        message, hint = f"a time is in seconds, not in {unit}", "give a `scale` to seconds, and `unit: s`"
        scope.report.error("wrong-choice", message, facts.span("unit"), hint)
    elif is_time:
        try:
            return date.fromisoformat(epoch).isoformat()
        except ValueError:
            scope.report.error("wrong-form", f"`{epoch}` is no date", facts.span("notation"), "write 1970-01-01")
    return ""
