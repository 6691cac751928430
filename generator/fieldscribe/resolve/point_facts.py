"""The facts that a description states about one point, each with its layer and its place in the text.

Also sets and arrays: the points of a row that has `sets`, `indices` or both.
"""

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from fieldscribe.diagnostics import Span
from fieldscribe.language.formula.normal import evaluate
from fieldscribe.language.formula.parser import parse_expression
from fieldscribe.language.formula.syntax import FormulaError
from fieldscribe.language.keys import inherited
from fieldscribe.language.keys.places import GROUP
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import integer_in
from fieldscribe.model import Titles, Variant, item_of, type_info
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.values import NUMBERINGS, WORD_BITS, BitNumbers, integer, interval
from fieldscribe.text import shortened
from fieldscribe.wording.numbers import number_text

MOST_ELEMENTS = 4096
"""The most points of one row."""

_INHERITED = inherited(GROUP)
"""Keys that a group may set for its points."""

_RIVALS = {
    stated: rival
    for pair in (("range", "range_in_units"), ("default", "default_in_units"), ("keeps", "keep_with"))
    for stated, rival in (pair, pair[::-1])
}
"""Pairs of keys for the same fact: the one in a nearer layer hides the other one in farther layers."""


TO_END = "to end"
"""The value of `indices` for points that repeat to the end of a found block."""

_COUNTED = re.compile(rf"{TO_END}|(?P<low>[0-9]{{1,5}})\.\.(?P<point>[A-Za-z_]\w*(?<![hH])|[g-zG-Z_]\w*)")
"""`to end`, or an interval whose last number is in a point."""
_SET_WORDS = {"en": "set {}", "de": "{}. Parametersatz"}
_INDEX_WORDS = {"en": "index {}", "de": "Index {}"}


@dataclass(frozen=True, slots=True)
class Element:
    """One of the points of a row.

    `set_number` and `index` are None if the row has no sets or indices; `sets` and `indices` say how many there are.
    `counted` names which of `sets` and `indices` the row has.
    """

    set_number: int | None
    sets: int
    index: int | None
    indices: int
    suffix: str
    counted: tuple[str, ...]
    exists: tuple[tuple[str, str], ...] = ()
    """Conditions for the element to exist, each with its key: `1..phases` gives `phases >= 2`."""

    def values(self, number: int) -> Mapping[str, Fraction]:
        """Return the names that an addressing rule may use; outside sets and arrays the set and the index are 1."""
        return {
            "number": Fraction(number),
            "index": Fraction(1 if self.index is None else self.index),
            "set": Fraction(1 if self.set_number is None else self.set_number),
            "sets": Fraction(self.sets),
            "indices": Fraction(self.indices),
        }

    @property
    def keys(self) -> tuple[str, ...]:
        """Return the keys under `each` for this element, the most exact first: `set/index`, `index`; or `set` alone."""
        if self.index is None:
            return () if self.set_number is None else (f"{self.set_number}",)
        by_index = (f"{self.index}",)
        return by_index if self.set_number is None else (f"{self.set_number}/{self.index}", *by_index)

    def titled(self, title: Titles) -> Titles:
        """Return the title of the row with the set and index of this element."""
        words = [
            (words, number)
            for key, words, number in (("sets", _SET_WORDS, self.set_number), ("indices", _INDEX_WORDS, self.index))
            if key in self.counted and number is not None and self.suffix
        ]
        if not words:
            return title
        return {language: f"{text} ({_words_in(words, language)})" for language, text in title.items()}


def set_title(title: Titles, number: int) -> Titles:
    """Return the title of a point in a further set."""
    return {language: f"{text} ({_words_in([(_SET_WORDS, number)], language)})" for language, text in title.items()}


ALONE = Element(None, 1, None, 1, "", ())
"""The element of a row without sets and indices."""


def _words_in(words: list[tuple[dict[str, str], int]], language: str) -> str:
    return ", ".join(texts.get(language, texts["en"]).format(number) for texts, number in words)


@dataclass(slots=True, eq=False)
class PointFacts:
    """The facts of one expanded point, in layers: the point's own row first, then formats and records, the group last.

    `use` is the row that uses the point's record. `failed` collects the keys that have findings, so that no later step
    reports the values assumed instead.
    """

    name: str
    layers: tuple[Map, ...]
    group: Map
    node: Map
    title: Titles
    variant: Variant | None = None
    record: str | None = None
    set_number: int | None = None
    use: Map | None = None
    element: Element | None = None
    enum_name: str = ""
    hidden: frozenset[str] = frozenset()
    failed: set[str] = field(default_factory=set, init=False)
    _where: dict[str, Map] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        group, where = self.group, self._where
        where.update(dict.fromkeys(filter(_INHERITED.__contains__, group), group))
        for layer in reversed(self.layers):
            keys = layer if layer is self.node or not self.hidden else layer.keys() - self.hidden
            where.update(dict.fromkeys(keys, layer))
            for stated, rival in _RIVALS.items():
                if stated in keys and rival not in keys:
                    where.pop(rival, None)
            if self.failed:
                self.failed.difference_update(keys)
            self.failed.update(layer.broken)
        if where.get("scale") is group and (where.keys() & {"enum", "flags", "digits"} or self.floating or self.text):
            del where["scale"]  # a group's scale is for its numbers, not for names, floats and texts
        if where.get("range") is group and (self.text or "digits" in where):
            del where["range"]

    @property
    def floating(self) -> bool:
        """Return True if the type is a floating-point type, and no enum names its patterns."""
        return type_info(self.get("type") or "u16").floating and self.get("enum") is None

    @property
    def pattern_bits(self) -> int:
        """Return how many bits the floating-point numbers have that an enum names; 0 if it names none of these."""
        info = type_info(self.get("type") or "u16")
        return info.bits if info.floating and self.get("enum") is not None else 0

    @property
    def text(self) -> bool:
        """Return True if the type is `text` or `bytes`, which share a representation."""
        return self.bytes or self.get("type") == "text"

    @property
    def no_number(self) -> str:
        """Return what the point is instead of a number: `a text`, `made of bytes`, `a date or time`; else empty."""
        if self.get("parts"):
            return "a date or time"
        return "made of bytes" if self.bytes else "a text" if self.text else ""

    @property
    def bytes(self) -> bool:
        """Return True if the type is `bytes`, or the point has parts of a date and time, which are held as these."""
        return bool(self.get("type") == "bytes" or self.get("parts"))

    @property
    def untyped(self) -> str | None:
        """Return the text given instead of a type, "" if the manual leaves the type open; None if there is a type."""
        words, typed = self.layer("untyped"), self.layer("type")
        if words is not None and (typed is None or self._rank(words) <= self._rank(typed)):
            return str(words["untyped"])
        return "" if typed is not None and typed["type"] is None else None

    @property
    def keeps(self) -> str | None:
        """Return how a written value is kept: the nearer of `keep_with` (a command) and `keeps`."""
        keeps: str | bool | None = self.get("keep_with", self.get("keeps"))
        return {True: "yes", False: "no"}[keeps] if isinstance(keeps, bool) else keeps

    def _rank(self, layer: Map) -> int:
        """Return how far a layer is from the point: 0 for its own facts, the greatest number for the group."""
        return next((place for place, other in enumerate(self.layers) if other is layer), len(self.layers))

    @property
    def keys(self) -> Collection[str]:
        """Return the keys that some layer states."""
        return self._where.keys()

    def layer(self, key: str) -> Map | None:
        """Return the layer that states this fact; None if none does."""
        return self._where.get(key)

    def get(self, key: str, otherwise: Any = None) -> Any:
        """Return the fact; `otherwise` if no layer states it."""
        layer = self._where.get(key)
        return otherwise if layer is None else layer[key]

    def bit_numbers(self, width: int = WORD_BITS) -> BitNumbers:
        """Return how the manual numbers the bits of the point's word."""
        return BitNumbers(width, *NUMBERINGS.get(str(self.get("bit_numbers")), ()))

    def span(self, key: str | None = None) -> Span:
        """Return the place of the fact, or of the point's name if no layer states it."""
        layer = self._where.get(key) if key is not None else None
        if layer is not None and key is not None:
            return layer.span(key)
        return self.node.span("name" if "name" in self.node else None)

    @property
    def conditions(self) -> tuple[tuple[str, str], ...]:
        """Return the conditions for the point to exist, each with its key."""
        when = self.get("when")
        stated = () if when is None else ((str(when), "when"),)
        counted = () if self.element is None else self.element.exists
        return (*stated, *counted, *self._selecting()) if self.layer("select") else stated + counted

    def _selecting(self) -> Iterator[tuple[str, str]]:
        """Yield a condition for each selecting point: it holds a name, or the result of a formula of an element."""
        numbers = (self.element or ALONE).values(integer_in(self.get("at")) or 0)
        for name, text in self.get("select").items():
            try:
                yield f"{name}.raw == {number_text(evaluate(parse_expression(str(text)), numbers))}", "select"
            except FormulaError:
                yield f"{name} == {text}", "select"

    @property
    def suffix(self) -> str:
        """Return what this element adds to the name of its row, such as `_set_2`."""
        return "" if self.element is None else self.element.suffix

    def called(self, row: str) -> str:
        """Return the name of this point if its row, or the member of its record, had this name."""
        if self.use is not None:
            return f"{self.use['name']}_{row}"
        first = self.row["name"]
        return f"{row}{self.name.removeprefix(first)}"

    @property
    def old_enum_names(self) -> tuple[str, ...]:
        """Return the names that an enum in this row had under the old names of the row, or of the record's member."""
        head = ""
        if self.use is not None:
            head = f"{self.use['name' if self.enum_name.startswith(self.name) else 'record']}_"
        rest = self.enum_name.removeprefix(f"{head}{self.row['name']}")
        return tuple(f"{head}{old}{rest}" for old in self.get("was", ()))

    @property
    def row(self) -> Map:
        """Return the row that the point comes from, even if a further set adds facts."""
        return next((layer for layer in self.layers if "name" in layer), self.node)

    @property
    def code(self) -> str | None:
        """Return the manual's short name."""
        code = self.get("code")
        return None if code is None else str(code)

    @property
    def item(self) -> str:
        """Return the name with the value of the variant."""
        return self.name if self.variant is None else item_of(self.name, self.variant)


def is_counted(row: PointFacts) -> bool:
    """Return True if the device decides how many sets or indices there are."""
    return any(_COUNTED.fullmatch(str(row.get(plural))) for plural in ("sets", "indices"))


def elements_of(scope: Scope, row: PointFacts) -> list[Element]:
    """Return the elements of a row, set by set and in each set index by index; none after a finding."""
    rows = isinstance(row.get("sets"), Map)  # each further set has a row of its own
    sets = _Axis(1, (None,), "") if rows else _axis(scope, row, "sets", "set")
    indices = _axis(scope, row, "indices", "index")
    if sets is None or indices is None:
        return []
    if len(sets.used) * len(indices.used) > MOST_ELEMENTS:
        message = f"these are {len(sets.used) * len(indices.used)} points"
        key = "sets" if sets.word else "indices"
        scope.report.error("too-many-items", message, row.span(key), f"one row has at most {MOST_ELEMENTS}")
        return []
    counted = tuple(key for key in ("sets", "indices") if row.layer(key) is not None and not (rows and key == "sets"))
    return [
        Element(
            set_number,
            sets.count,
            index,
            indices.count,
            sets.suffix(set_number) + indices.suffix(index),
            counted,
            tuple(
                (f"{axis.counter} >= {number}", key)
                for key, axis, number in (("sets", sets, set_number), ("indices", indices, index))
                if axis.counter
            ),
        )
        for set_number in sets.used
        for index in indices.used
    ]


@dataclass(frozen=True, slots=True)
class _Axis:
    """The sets or the indices of a row: how many exist, which ones the row describes, and their word in names."""

    count: int
    used: tuple[int | None, ...]
    word: str
    counter: str = ""
    """The point that holds the last number, if one does."""

    def suffix(self, number: int | None) -> str:
        return f"_{self.word}_{number}" if self.word else ""


def _axis(scope: Scope, row: PointFacts, plural: str, singular: str) -> _Axis | None:
    """Read `sets: 4`, `indices: 0..1`, or a lone `set: 2`; None after a finding."""
    own_number: int | None = row.get(singular)
    raw = row.get(plural)
    if raw is None:
        return _Axis(1, (own_number,), "")
    span, text, counter = row.span(plural), str(raw), ""
    if (counted := _COUNTED.fullmatch(text)) is not None:
        most = _most(scope, row, plural, text)
        counter, ends = counted["point"] or "", None if most is None else (int(counted["low"] or 1), most)
    elif ".." in text:
        ends = interval(text, span, scope.report)
    elif isinstance(raw, str) and integer_in(raw) is None:
        hint = f"write a count, an interval such as `{plural}: 0..1`, a point that counts (`1..phases`), or `to end`"
        scope.report.error("bad-number", f"`{shortened(text)}` is no count of elements", span, hint)
        ends = None
    else:
        count = integer(raw, span, scope.report)
        ends = None if count is None else (1, count)
    if ends is None:
        return None
    low, high = ends
    if low < 0 or high < low or high - low >= 65536:
        message = f"`{plural}: {text}` is no count of elements, or too many"
        scope.report.error("wrong-choice", message, span, f"write a count, or an interval such as `{plural}: 0..1`")
        return None
    if own_number is None:
        used = range(low, min(high, low + MOST_ELEMENTS) + 1)
        return _Axis(high - low + 1, tuple(used), singular, counter)
    if not low <= own_number <= high:
        message = f"there is no {singular} {own_number} in {low}..{high}"
        scope.report.error("wrong-choice", message, row.span(singular), f"correct `{singular}` or `{plural}`")
        return None
    return _Axis(high - low + 1, (own_number,), "", counter)


def _most(scope: Scope, row: PointFacts, plural: str, text: str) -> int | None:
    """Return the greatest described index if the device decides the number of elements; None after a finding."""
    most: int | None = row.get("most")
    if text == TO_END and (plural != "indices" or "block" not in row.group):
        message, hint = "nothing ends here: the group counts from no found block", "write `block: …` at the group"
        scope.report.error("missing-key", message, row.span(plural), hint)
        return None
    if most is None and "most" not in row.node.broken:
        hint = f"add `most: 20`, the greatest {'index' if plural == 'indices' else 'set'} to describe"
        scope.report.error("missing-key", f"`{plural}: {text}` has no end", row.span(plural), hint)
    return most
