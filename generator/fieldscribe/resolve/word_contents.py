"""What words hold beside numbers: texts, decimal digits, and bits that are always written as a constant."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.language.keys import facts_of
from fieldscribe.language.keys.places import POINT
from fieldscribe.model import Allowed, Digits, Enum, Fixed, Interval, Text
from fieldscribe.resolve.enums import entries_of
from fieldscribe.resolve.scope import humanised
from fieldscribe.resolve.values import bits_named, integer
from fieldscribe.schema_types import TEXTS

if TYPE_CHECKING:
    from fieldscribe.language.nodes import Map
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.resolve.scope import Scope

WORD_BITS = 16
_MOST_CHARACTERS = 250
_LARGEST_DIGIT = 9
_DEFAULT_ENCODING = "ascii"
_OF_TEXTS = facts_of(POINT, TEXTS)


def text_of(scope: Scope, facts: PointFacts) -> Text | None:
    """The layout of a text; None for another type, or after a finding."""
    if not facts.text:
        for key in _OF_TEXTS:
            if facts.get(key) is not None and "type" not in facts.failed:
                message = f"`{key}` is for texts"
                scope.report.error("text-fact", message, facts.span(key), "add `type: text`, or leave it out")
        return None
    characters: int | None = facts.get("characters")
    if characters is None:
        if "characters" not in facts.failed:
            message = f"`{facts.name}` does not say how long the text is"
            scope.report.error("missing-key", message, facts.span("type"), "add `characters: …`, two for each word")
            facts.failed.add("characters")
        return None
    if characters % 2:
        hint = f"two characters stand in a word: write {characters + 1}, or {characters - 1}"
        message = f"{characters} characters leave half a word"
        scope.report.error("text-length", message, facts.span("characters"), hint)
        facts.failed.add("characters")
        return None
    if characters > _MOST_CHARACTERS:
        message = f"{characters} characters are more than 125 words hold, the most that travel at once"
        hint = f"make it several texts of at most {_MOST_CHARACTERS} characters"
        scope.report.error("text-length", message, facts.span("characters"), hint)
        facts.failed.add("characters")
        return None
    return Text(characters, str(facts.get("encoding", _DEFAULT_ENCODING)))


def digits_of(scope: Scope, facts: PointFacts) -> Digits | None:
    """The decimal digits of a word and their names; None where there are none, or after a finding."""
    node: Map | None = facts.get("digits")
    if node is None:
        return None
    raw_enum = node["enum"]
    is_shared = isinstance(raw_enum, str)
    name, entries = (raw_enum, scope.named_enums.get(raw_enum)) if is_shared else (facts.enum_name, raw_enum)
    if entries is None:
        scope.unknown("enum", name, node.span("enum"), scope.named_enums)
        facts.failed.add("digits")
        return None
    key = (name, id(entries), True)
    if key not in scope.enums:
        was = () if is_shared else facts.old_enum_names
        scope.enums[key] = Enum(name, {"en": humanised(name)}, entries_of(scope, entries), True, was)
    enum = scope.enums[key]
    misfit = next((entry for entry in enum.entries if not 0 <= entry.raw <= _LARGEST_DIGIT), None)
    if misfit is not None:
        message = f"`{misfit.name}` is {misfit.raw}, and a digit is 0..{_LARGEST_DIGIT}"
        scope.report.error("enum-outside-range", message, node.span("enum"), "name single digits")
        facts.failed.add("digits")
        return None
    return Digits(node["count"], enum) if enum.entries else None


def allowed_digits(scope: Scope, facts: PointFacts, digits: Digits, greatest: int) -> Allowed:
    """The numbers from all lowest to all highest digits; between them each digit is one of the enum's."""
    ones = sum(10**place for place in range(digits.count))
    numbers = [entry.raw for entry in digits.enum.entries]
    low = min(numbers) * ones
    if greatest < max(low, 10 ** (digits.count - 1)) and not facts.failed & {"type", "bits", "space"}:
        message = f"{digits.count} digits do not fit `{facts.name}`, which holds numbers up to {greatest}"
        scope.report.error("range-outside-type", message, facts.span("digits"), "correct `count`, `type` or `bits`")
        low = 0
    return Allowed((Interval(low, min(max(numbers) * ones, greatest)),), False, ())


def fixed_of(scope: Scope, facts: PointFacts, bits: tuple[int, int] | None, width: int) -> Fixed | None:
    """The bits of the word that are written as a constant; None where there are none, or after a finding."""
    node: Map | None = facts.get("fixed")
    if node is None:
        return None
    word = WORD_BITS if bits is not None else width
    own = 0 if bits is None else ((1 << width) - 1) << bits[1]
    mask = value = 0
    for key, content in node.items():
        place_and_greatest = _fixed_bits(scope, facts, node, key, word)
        number = integer(content, node.span(key), scope.report)
        if place_and_greatest is None or number is None:
            continue
        low, greatest = place_and_greatest
        if not 0 <= number <= greatest:
            message = f"{content} does not fit into {_bits_text(key)}"
            scope.report.error("range-outside-type", message, node.span(key), f"write 0..{greatest}")
        elif mask & greatest << low:
            message = f"{_bits_text(key)} cannot be fixed twice"
            scope.report.error("bits-overlap", message, node.key_span(key), "remove one of them")
        elif own & greatest << low:
            message = f"{_bits_text(key)} cannot be fixed, for the point itself takes it"
            scope.report.error("bits-overlap", message, node.key_span(key), "`fixed` names the bits beside it")
        else:
            mask, value = mask | greatest << low, value | number << low
    return Fixed(mask, value) if mask else None


def _bits_text(key: str) -> str:
    return f"bits {key}" if ".." in key else f"bit {key}"


def _fixed_bits(scope: Scope, facts: PointFacts, node: Map, key: str, word: int) -> tuple[int, int] | None:
    """The lowest bit that a key names, and what its bits hold at most; None after a finding."""
    high, low = bits_named(key)
    if high < low:
        hint = f"the higher bit stands first: {low}..{high}"
        scope.report.error("range-reversed", f"bits `{key}` run upwards", node.key_span(key), hint)
        return None
    if high >= word:
        if not facts.failed & {"type", "bits"}:
            message = f"bit {high} lies outside the {word} bits of the word"
            scope.report.error("bit-outside-word", message, node.key_span(key), f"bits are numbered {word - 1}..0")
        return None
    return low, (1 << high - low + 1) - 1
