"""Where a point is: its words on the wire in order, and the numbers that the manual prints for people."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.language.meant import interval_meant
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import parse_number
from fieldscribe.model import NOWHERE, TYPES, Place
from fieldscribe.resolve.numbering import Numberings
from fieldscribe.resolve.point_facts import ALONE
from fieldscribe.resolve.telegrams import SPACE, Telegrams, telegram_of
from fieldscribe.resolve.values import formula_value, integer
from fieldscribe.wording.exact import number_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.diagnostics import Span
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.resolve.scope import Scope

_FORMULA = re.compile(r"[A-Za-z0-9_)]\s*[-+*/]|\(|\bbase\b")
_MOST_WORDS = 125
_ACCESS = {"request": "w", "response": "r", "cyclic": "r"}
_VERBS = {"w": "written", "r": "read"}


_LAST_INDEX = 255
_RULE_KNOWS = "a rule knows number, index, set, sets and indices"

_MOST_PARTED_WORDS = 2
"""The most words of a number that comes in two frames: more of them could be old and new ones mixed, unnoticed."""


class Places:
    """Works out the address of every point of one device."""

    def __init__(self, scope: Scope, telegrams: Telegrams) -> None:
        self.scope = scope
        self.report = scope.report
        self.telegrams = telegrams
        bus = scope.bus
        self.order = None if bus is None else bus.get("words")
        self.numberings = Numberings(scope.report)
        self._wrong_rules: set[int] = set()

    def places(
        self, facts: PointFacts, space: str, type_name: str, bits: tuple[int, int] | None
    ) -> tuple[Place, Place | None]:
        """Where a point is, and where it is written if that is elsewhere.

        The first has no addresses if the manual prints none, or after a finding.
        """
        place = self._place(facts, space, type_name, bits, "at")
        if not place.addresses or facts.get("write_at") is None:
            return place, None
        write_place = self._place(facts, space, type_name, bits, "write_at")
        return place, write_place if write_place.addresses else None

    def _place(self, facts: PointFacts, space: str, type_name: str, bits: tuple[int, int] | None, key: str) -> Place:
        """What `key` says: the words, that of the highest bits (in a text: of the first characters) first."""
        last = self._last(facts, space)
        text = type_name == "text"
        words = self._text_words(facts, last, key) if text else self._words(facts, space, type_name, bits, key)
        if words is None or last is None:
            return NOWHERE
        for address in (words[0], words[-1]):
            if not 0 <= address <= last:
                self._outside(facts, key, address, last, single=address == words[0])
                return NOWHERE
        if not text:
            self._refuse_scattered(facts, words)
        printed = words[0] if text else min(words)  # manuals print that of the first characters, else the lowest
        low_first = not text and self.low_first(facts, type_name)
        return Place(words[::-1] if low_first else words, self.references(facts, printed))

    def access(self, facts: PointFacts, space: str) -> str:
        """What a master may do: as the description says, else all that the direction of the telegram allows."""
        telegram_entry = self.telegrams.get(facts.group.get("telegram", "")) if space == SPACE else None
        usual = "rw" if telegram_entry is None else _ACCESS[telegram_entry[0].direction]
        access = str(facts.get("access", usual))
        if telegram_entry is not None and not set(access) <= set(usual) and access != "none":
            message = f"a word of the telegram `{telegram_entry[0].name}` is {_VERBS[usual]} only"
            self.report.error(
                "wrong-choice", message, facts.span("access"), f"write `access: {usual}`, or leave it out"
            )
            return usual
        return access

    def references(self, facts: PointFacts, address: int) -> Mapping[str, int]:
        """The numbers that the manual prints for an address, by numbering.

        In a multiplexed telegram these are `mux`, the number of the frame, and `word`, the place in it, too.
        """
        numbering: Map | None = facts.group.get("numbering")
        numbers = {} if numbering is None else dict(self.numberings.numbers(numbering, address))
        carried = self.carried(facts)
        if carried:
            numbers = {"mux": address // carried, "word": address % carried + 1, **numbers}
        return numbers

    def carried(self, facts: PointFacts) -> int:
        """How many words of the point's telegram one of its frames carries; 0 if it is in no multiplexed telegram."""
        if facts.get("space") != SPACE:
            return 0
        telegram_entry = self.telegrams.get(facts.group.get("telegram", ""))
        return 0 if telegram_entry is None else telegram_entry[1]

    def _last(self, facts: PointFacts, space: str) -> int | None:
        """The last address of the space, or the last word of the telegram; None after a finding."""
        if space != SPACE:
            return self.scope.family.last_address
        telegram = telegram_of(self.scope, self.telegrams, facts)
        return None if telegram is None else telegram[0].words - 1

    def _words(
        self, facts: PointFacts, space: str, type_name: str, bits: tuple[int, int] | None, key: str
    ) -> tuple[int, ...] | None:
        first = self._address(facts, key)
        if first is None:
            return None
        return tuple(range(first, first + self.count(facts, space, type_name, bits)))

    def count(self, facts: PointFacts, space: str, type_name: str, bits: tuple[int, int] | None) -> int:
        """How many addresses a number takes."""
        if bits is not None or space in self.scope.family.indexed:  # there a number names a whole value
            return 1
        return max(1, TYPES[type_name].bits // 16) if facts.untyped is None else int(facts.get("length", 1))

    def low_first(self, facts: PointFacts, type_name: str) -> bool:
        """Whether the word with the low part of a number comes first."""
        return bool((facts.get("words") or self._order(type_name)) == "low first")

    def _text_words(self, facts: PointFacts, last: int | None, key: str) -> tuple[int, ...] | None:
        """The words of a text in reading order, which may run down: `739..732`, or the first word alone."""
        raw = self._written_address(facts, key)
        characters: int | None = facts.get("characters")
        if raw is None or characters is None or "characters" in facts.failed:
            return None
        first_text, dots, last_text = str(raw).partition("..") if isinstance(raw, str) else ("", "", "")
        first = self._text_end(facts, first_text, key) if dots else self._address(facts, key)
        final = self._text_end(facts, last_text, key) if dots else None
        if first is None or (dots and final is None):
            return None
        if final is None:
            return tuple(range(first, first + characters // 2))
        step = 1 if first <= final else -1
        if abs(final - first) >= (_MOST_WORDS if last is None else last + 1):
            self._outside(facts, key, max(first, final), last or _MOST_WORDS, single=True)
            return None
        words = tuple(range(first, final + step, step))
        if 2 * len(words) != characters:
            message = f"{len(words)} words hold {2 * len(words)} characters, not {characters}"
            hint = f"two characters stand in a word: correct `{key}` or `characters`"
            self.report.error("text-length", message, facts.span(key), hint)
            return None
        return words

    def _text_end(self, facts: PointFacts, text: str, key: str) -> int | None:
        """The first or the last word of a text, as its row writes it."""
        number = self._number(facts, text.strip(), key)
        return None if number is None else self._address_of(facts, number)

    def _written_address(self, facts: PointFacts, key: str) -> object:
        """The value of `key` as it is written; None if the manual prints no address, or after a finding."""
        layer = facts.layer(key)
        if layer is None:
            if "at" not in facts.failed:
                hint = "add `at: …`, or `at: ~` if the manual prints none"
                self.report.error("missing-key", f"`{facts.name}` says no address", facts.span(), hint)
            return None
        return None if facts.use is not None and facts.use.get("at", 0) is None else layer[key]

    def _address(self, facts: PointFacts, key: str) -> int | None:
        """The first address of the point on the wire; None if the manual prints none, or after a finding."""
        raw = self._written_address(facts, key)
        if raw is None:
            return None
        number = raw if isinstance(raw, int) else self._number(facts, str(raw), key)
        return None if number is None else self._address_of(facts, number)

    def _number(self, facts: PointFacts, text: str, key: str) -> int | None:
        """The number that a text under `key` means, which may be a formula with `base`; None after a finding."""
        span = facts.span(key)
        several = _first_of_several(text)
        if several is not None:
            hint = f"it stands once, at its first word: write `{key}: {several}`; the `type` says how many words it has"
            self.report.error("bad-number", f"`{text[:60]}` are several addresses", span, hint)
            return None
        if _FORMULA.search(text) is None:
            return integer(text, span, self.report)
        base = self._base(facts)
        if base is None:
            return None
        known = "`base` is where a record is used: it is known in the points of a record only" if not base else ""
        return self._whole(text, base, span, known)

    def _address_of(self, facts: PointFacts, number: int) -> int | None:
        """The address that the group's `addressing` makes of a number; without such a rule it is the number itself."""
        group, element = facts.group, facts.element
        rule: str | None = group.get("addressing")
        if rule is not None:
            return self._by_rule(facts, rule, (element or ALONE).values(number))
        if element is None or "addressing" in group.broken:
            return None if "addressing" in group.broken else number
        indexed = facts.get("space") in self.scope.family.indexed
        if indexed and element.index is not None and element.index > _LAST_INDEX:
            message = f"the index {element.index} does not fit beside the address"
            span = facts.span("indices" if "indices" in element.counted else "index")
            self.report.error("address-outside-space", message, span, f"indices are 0..{_LAST_INDEX}")
            return None
        if element.set_number is not None or (element.index is not None and not indexed):
            message = "nothing says how the address follows from the number, the set and the index"
            hint = "add `addressing: …` to the group, such as `number * 64 + (index - 1) * sets + (set - 1)`"
            rows = "; sets that follow no rule have rows: `sets: {2: {at: …}}`" if "sets" in element.counted else ""
            self.report.error("missing-key", message, facts.span("at"), hint + rows)
            return None
        return number

    def _by_rule(self, facts: PointFacts, rule: str, values: Mapping[str, Fraction]) -> int | None:
        """The result of the group's `addressing`; a wrong rule is reported once, not once for each element."""
        span = facts.group.span("addressing")
        if id(facts.group) in self._wrong_rules:
            return None
        exact = formula_value(rule, values, span, self.report, _RULE_KNOWS)
        if exact is None:
            self._wrong_rules.add(id(facts.group))
            return None
        if exact.denominator != 1:
            self._wrong_rules.add(id(facts.group))
            message = f"the address of `{facts.name}` would be {number_text(exact)}, which is no whole number"
            self.report.error("bad-number", message, span, "correct the rule, or the number, set or index of the row")
            return None
        return exact.numerator

    def _whole(self, text: str, known: Mapping[str, Fraction], span: Span, unknown: str) -> int | None:
        """The whole number that a formula gives; None after a finding, with `unknown` as hint for other names."""
        exact = formula_value(text, known, span, self.report, unknown)
        if exact is None:
            return None
        if exact.denominator != 1:
            message = f"the address {number_text(exact)} is not a whole number"
            self.report.error("bad-number", message, span, "`at` is the number on the wire")
            return None
        return exact.numerator

    def _base(self, facts: PointFacts) -> Mapping[str, Fraction] | None:
        """The names that a formula under `at` may use: in a record `base`, where it is used. None after a finding."""
        use = facts.use
        if use is None:
            return {}
        if "at" not in use:
            if "at" not in use.broken:
                hint = "add `at: …`, or `at: ~` if the manual prints none"
                self.report.error("missing-key", "the record stands at no address", use.span("name"), hint)
            return None
        base = integer(use["at"], use.span("at"), self.report)
        return None if base is None else {"base": Fraction(base)}

    def _refuse_scattered(self, facts: PointFacts, words: tuple[int, ...]) -> None:
        """A finding for a number of more than two words in several frames: old and new words could mix unnoticed."""
        carried = self.carried(facts)
        if carried and len(words) > _MOST_PARTED_WORDS and words[0] // carried != words[-1] // carried:
            message = f"the {len(words)} words of `{facts.name}` come in several frames"
            hint = "a number that is parted has two words at most: describe the parts as points of their own"
            self.report.error("parted-number", message, facts.span("at"), hint)

    def _outside(self, facts: PointFacts, key: str, address: int, last: int, *, single: bool) -> None:
        """A finding for an address that the space, or a word that the telegram, does not have."""
        if facts.get("space") == SPACE:
            message = f"word {address} lies outside the telegram, whose words are 0..{last}"
            hint = "`at` counts the words of the whole telegram from 0; correct it, or `length` of the telegram"
        elif single:
            message = f"the address {address} lies outside 0..{last}"
            hint = f"`{key}` is the number on the wire; the numbers for people (40001) go under `printed`"
        else:
            message = f"the last word of `{facts.name}` lies outside 0..{last}"
            hint = "check the address and the type"
        self.report.error("address-outside-space", message, facts.span(key), hint)

    def _order(self, type_name: str) -> str:
        if isinstance(self.order, Map):
            return str(self.order.get(type_name, "high first"))
        return str(self.order or "high first")


def _first_of_several(text: str) -> str | None:
    """The first address of a text that names several (`1..2`, `1 - 2`); None for a number or a formula (`5 - 2`)."""
    first, _, last = ("" if ":" in text else interval_meant(text) or "").partition("..")
    return first if first and parse_number(first) < parse_number(last) else None
