"""Where a point is: its words on the wire in order, and the numbers that the manual prints for people."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.language.meant import interval_meant
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import parse_number
from fieldscribe.model import NOWHERE, TYPES, Place
from fieldscribe.resolve.elements import ALONE
from fieldscribe.resolve.numbering import Numberings
from fieldscribe.resolve.telegrams import SPACE, Telegrams, telegram_of
from fieldscribe.resolve.values import formula_value, integer
from fieldscribe.wording.exact import number_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.diagnostics import Span
    from fieldscribe.resolve.drafts import Draft
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
        self, draft: Draft, space: str, type_name: str, bits: tuple[int, int] | None
    ) -> tuple[Place, Place | None]:
        """Where a point is, and where it is written if that is elsewhere.

        The first has no addresses if the manual prints none, or after a finding.
        """
        place = self._place(draft, space, type_name, bits, "at")
        if not place.addresses or draft.get("write_at") is None:
            return place, None
        write_place = self._place(draft, space, type_name, bits, "write_at")
        return place, write_place if write_place.addresses else None

    def _place(self, draft: Draft, space: str, type_name: str, bits: tuple[int, int] | None, key: str) -> Place:
        """What `key` says: the words, that of the highest bits (in a text: of the first characters) first."""
        last = self._last(draft, space)
        text = type_name == "text"
        words = self._text_words(draft, last, key) if text else self._words(draft, space, type_name, bits, key)
        if words is None or last is None:
            return NOWHERE
        for address in (words[0], words[-1]):
            if not 0 <= address <= last:
                self._outside(draft, key, address, last, single=address == words[0])
                return NOWHERE
        if not text:
            self._refuse_scattered(draft, words)
        printed = words[0] if text else min(words)  # manuals print that of the first characters, else the lowest
        low_first = not text and self.low_first(draft, type_name)
        return Place(words[::-1] if low_first else words, self.references(draft, printed))

    def access(self, draft: Draft, space: str) -> str:
        """What a master may do: as the description says, else all that the direction of the telegram allows."""
        telegram_entry = self.telegrams.get(draft.group.get("telegram", "")) if space == SPACE else None
        usual = "rw" if telegram_entry is None else _ACCESS[telegram_entry[0].direction]
        access = str(draft.get("access", usual))
        if telegram_entry is not None and not set(access) <= set(usual) and access != "none":
            message = f"a word of the telegram `{telegram_entry[0].name}` is {_VERBS[usual]} only"
            self.report.error(
                "wrong-choice", message, draft.span("access"), f"write `access: {usual}`, or leave it out"
            )
            return usual
        return access

    def references(self, draft: Draft, address: int) -> Mapping[str, int]:
        """The numbers that the manual prints for an address, by numbering.

        In a multiplexed telegram these are `mux`, the number of the frame, and `word`, the place in it, too.
        """
        numbering: Map | None = draft.group.get("numbering")
        numbers = {} if numbering is None else dict(self.numberings.numbers(numbering, address))
        carried = self.carried(draft)
        if carried:
            numbers = {"mux": address // carried, "word": address % carried + 1, **numbers}
        return numbers

    def carried(self, draft: Draft) -> int:
        """How many words of the point's telegram one of its frames carries; 0 if it is in no multiplexed telegram."""
        if draft.get("space") != SPACE:
            return 0
        telegram_entry = self.telegrams.get(draft.group.get("telegram", ""))
        return 0 if telegram_entry is None else telegram_entry[1]

    def _last(self, draft: Draft, space: str) -> int | None:
        """The last address of the space, or the last word of the telegram; None after a finding."""
        if space != SPACE:
            return self.scope.family.last_address
        telegram = telegram_of(self.scope, self.telegrams, draft)
        return None if telegram is None else telegram[0].words - 1

    def _words(
        self, draft: Draft, space: str, type_name: str, bits: tuple[int, int] | None, key: str
    ) -> tuple[int, ...] | None:
        first = self._address(draft, key)
        if first is None:
            return None
        return tuple(range(first, first + self.count(draft, space, type_name, bits)))

    def count(self, draft: Draft, space: str, type_name: str, bits: tuple[int, int] | None) -> int:
        """How many addresses a number takes."""
        if bits is not None or space in self.scope.family.indexed:  # there a number names a whole value
            return 1
        return max(1, TYPES[type_name].bits // 16) if draft.untyped is None else int(draft.get("length", 1))

    def low_first(self, draft: Draft, type_name: str) -> bool:
        """Whether the word with the low part of a number comes first."""
        return bool((draft.get("words") or self._order(type_name)) == "low first")

    def _text_words(self, draft: Draft, last: int | None, key: str) -> tuple[int, ...] | None:
        """The words of a text in reading order, which may run down: `739..732`, or the first word alone."""
        raw = self._written_address(draft, key)
        characters: int | None = draft.get("characters")
        if raw is None or characters is None or "characters" in draft.failed:
            return None
        first_text, dots, last_text = str(raw).partition("..") if isinstance(raw, str) else ("", "", "")
        first = self._text_end(draft, first_text, key) if dots else self._address(draft, key)
        final = self._text_end(draft, last_text, key) if dots else None
        if first is None or (dots and final is None):
            return None
        if final is None:
            return tuple(range(first, first + characters // 2))
        step = 1 if first <= final else -1
        if abs(final - first) >= (_MOST_WORDS if last is None else last + 1):
            self._outside(draft, key, max(first, final), last or _MOST_WORDS, single=True)
            return None
        words = tuple(range(first, final + step, step))
        if 2 * len(words) != characters:
            message = f"{len(words)} words hold {2 * len(words)} characters, not {characters}"
            hint = f"two characters stand in a word: correct `{key}` or `characters`"
            self.report.error("text-length", message, draft.span(key), hint)
            return None
        return words

    def _text_end(self, draft: Draft, text: str, key: str) -> int | None:
        """The first or the last word of a text, as its row writes it."""
        number = self._number(draft, text.strip(), key)
        return None if number is None else self._address_of(draft, number)

    def _written_address(self, draft: Draft, key: str) -> object:
        """The value of `key` as it is written; None if the manual prints no address, or after a finding."""
        layer = draft.layer(key)
        if layer is None:
            if "at" not in draft.failed:
                hint = "add `at: …`, or `at: ~` if the manual prints none"
                self.report.error("missing-key", f"`{draft.name}` says no address", draft.span(), hint)
            return None
        return None if draft.use is not None and draft.use.get("at", 0) is None else layer[key]

    def _address(self, draft: Draft, key: str) -> int | None:
        """The first address of the point on the wire; None if the manual prints none, or after a finding."""
        raw = self._written_address(draft, key)
        if raw is None:
            return None
        number = raw if isinstance(raw, int) else self._number(draft, str(raw), key)
        return None if number is None else self._address_of(draft, number)

    def _number(self, draft: Draft, text: str, key: str) -> int | None:
        """The number that a text under `key` means, which may be a formula with `base`; None after a finding."""
        span = draft.span(key)
        several = _first_of_several(text)
        if several is not None:
            hint = f"it stands once, at its first word: write `{key}: {several}`; the `type` says how many words it has"
            self.report.error("bad-number", f"`{text[:60]}` are several addresses", span, hint)
            return None
        if _FORMULA.search(text) is None:
            return integer(text, span, self.report)
        base = self._base(draft)
        if base is None:
            return None
        known = "`base` is where a record is used: it is known in the points of a record only" if not base else ""
        return self._whole(text, base, span, known)

    def _address_of(self, draft: Draft, number: int) -> int | None:
        """The address that the group's `addressing` makes of a number; without such a rule it is the number itself."""
        group, element = draft.group, draft.element
        rule: str | None = group.get("addressing")
        if rule is not None:
            return self._by_rule(draft, rule, (element or ALONE).values(number))
        if element is None or "addressing" in group.broken:
            return None if "addressing" in group.broken else number
        indexed = draft.get("space") in self.scope.family.indexed
        if indexed and element.index is not None and element.index > _LAST_INDEX:
            message = f"the index {element.index} does not fit beside the address"
            span = draft.span("indices" if "indices" in element.counted else "index")
            self.report.error("address-outside-space", message, span, f"indices are 0..{_LAST_INDEX}")
            return None
        if element.set_number is not None or (element.index is not None and not indexed):
            message = "nothing says how the address follows from the number, the set and the index"
            hint = "add `addressing: …` to the group, such as `number * 64 + (index - 1) * sets + (set - 1)`"
            rows = "; sets that follow no rule have rows: `sets: {2: {at: …}}`" if "sets" in element.counted else ""
            self.report.error("missing-key", message, draft.span("at"), hint + rows)
            return None
        return number

    def _by_rule(self, draft: Draft, rule: str, values: Mapping[str, Fraction]) -> int | None:
        """The result of the group's `addressing`; a wrong rule is reported once, not once for each element."""
        span = draft.group.span("addressing")
        if id(draft.group) in self._wrong_rules:
            return None
        exact = formula_value(rule, values, span, self.report, _RULE_KNOWS)
        if exact is None:
            self._wrong_rules.add(id(draft.group))
            return None
        if exact.denominator != 1:
            self._wrong_rules.add(id(draft.group))
            message = f"the address of `{draft.name}` would be {number_text(exact)}, which is no whole number"
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

    def _base(self, draft: Draft) -> Mapping[str, Fraction] | None:
        """The names that a formula under `at` may use: in a record `base`, where it is used. None after a finding."""
        use = draft.use
        if use is None:
            return {}
        if "at" not in use:
            if "at" not in use.broken:
                hint = "add `at: …`, or `at: ~` if the manual prints none"
                self.report.error("missing-key", "the record stands at no address", use.span("name"), hint)
            return None
        base = integer(use["at"], use.span("at"), self.report)
        return None if base is None else {"base": Fraction(base)}

    def _refuse_scattered(self, draft: Draft, words: tuple[int, ...]) -> None:
        """A finding for a number of more than two words in several frames: old and new words could mix unnoticed."""
        carried = self.carried(draft)
        if carried and len(words) > _MOST_PARTED_WORDS and words[0] // carried != words[-1] // carried:
            message = f"the {len(words)} words of `{draft.name}` come in several frames"
            hint = "a number that is parted has two words at most: describe the parts as points of their own"
            self.report.error("parted-number", message, draft.span("at"), hint)

    def _outside(self, draft: Draft, key: str, address: int, last: int, *, single: bool) -> None:
        """A finding for an address that the space, or a word that the telegram, does not have."""
        if draft.get("space") == SPACE:
            message = f"word {address} lies outside the telegram, whose words are 0..{last}"
            hint = "`at` counts the words of the whole telegram from 0; correct it, or `length` of the telegram"
        elif single:
            message = f"the address {address} lies outside 0..{last}"
            hint = f"`{key}` is the number on the wire; the numbers for people (40001) go under `printed`"
        else:
            message = f"the last word of `{draft.name}` lies outside 0..{last}"
            hint = "check the address and the type"
        self.report.error("address-outside-space", message, draft.span(key), hint)

    def _order(self, type_name: str) -> str:
        if isinstance(self.order, Map):
            return str(self.order.get(type_name, "high first"))
        return str(self.order or "high first")


def _first_of_several(text: str) -> str | None:
    """The first address of a text that names several (`1..2`, `1 - 2`); None for a number or a formula (`5 - 2`)."""
    first, _, last = ("" if ":" in text else interval_meant(text) or "").partition("..")
    return first if first and parse_number(first) < parse_number(last) else None
