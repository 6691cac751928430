"""Where each point is: its words on the wire in order, and the numbers that the manual prints for people."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from fractions import Fraction

from fieldscribe.language.formula.normal import evaluate
from fieldscribe.language.formula.parser import parse_expression
from fieldscribe.language.formula.syntax import FormulaError, names
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import parse_number
from fieldscribe.language.suggestions import suggest_interval
from fieldscribe.model import NOWHERE, Message, Place
from fieldscribe.resolve.bases import last_address
from fieldscribe.resolve.bus import KEY_OF, SIGNAL_SPACE, TELEGRAM_SPACE, Telegrams, telegram_of
from fieldscribe.resolve.encodings import Encoding, low_first
from fieldscribe.resolve.point_facts import ALONE, PointFacts
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.values import FactError, formula_finding, formula_value, whole
from fieldscribe.resolve.word_contents import layout_of
from fieldscribe.text import counted
from fieldscribe.wording.numbers import number_text

WIRE = "wire"
"""The name of the wire address in formulas of `numbering`."""

_FORMULA = re.compile(r"[A-Za-z0-9_)]\s*[-+*/]|\(|\bbase\b")
_ACCESS = {"request": "w", "response": "r", "cyclic": "r"}
_VERBS = {"w": "written", "r": "read"}
_LAST_INDEX = 255
RULE_KNOWS = "a rule knows number, index, set, sets and indices"
_NO_ADDRESS = "add `at: …`, or `at: ~` if the manual prints none"
_MOST_PARTED_WORDS = 2
"""The most words of a number that two frames carry: with more, old and new words could mix unnoticed."""
_PROBES = (0, 1, 2, 0xFFFF)
"""The addresses at which a formula of `numbering` is evaluated to test that it is linear."""

_Line = tuple[int, int]
"""Slope and offset of a printed number as a function of the address."""


class Places:
    """Works out the places of the points of one device."""

    def __init__(self, scope: Scope, telegrams: Telegrams) -> None:
        self.scope = scope
        self.report = scope.report
        self.telegrams = telegrams
        bus = scope.bus
        self._order = None if bus is None else bus.get("words")
        self._lines: dict[int, Mapping[str, _Line]] = {}
        self._wrong_rules: set[int] = set()

    def of(self, facts: PointFacts, encoding: Encoding) -> tuple[Place, Place | None]:
        """Return the place of a point, and the place where it is written if that differs.

        The first has no addresses if the manual prints none, or after a finding.
        """
        place = self._place(facts, encoding, "at")
        if not place.addresses or facts.get("write_at") is None:
            return place, None
        write_place = self._place(facts, encoding, "write_at")
        return place, write_place if write_place.addresses else None

    def carry(self, messages: Iterable[Message]) -> None:
        """Give the telegrams of signals their lengths."""
        words = {each.name: sum(field.words for field in each.fields) for each in messages if not each.roles}
        known = {name: (replace(self.telegrams[name][0], words=count), 0) for name, count in words.items()}
        self.telegrams = {**self.telegrams, **known}

    def access(self, facts: PointFacts, space: str) -> str:
        """Return what a master may do: `access`, else all that the direction of the telegram allows."""
        telegram_entry = self.telegrams.get(facts.group.get(KEY_OF.get(space, ""), ""))
        usual = "rw" if telegram_entry is None else _ACCESS[telegram_entry[0].direction]
        access = str(facts.get("access", usual))
        if telegram_entry is not None and not set(access) <= set(usual) and access != "none":
            what = "signal of the message" if space == SIGNAL_SPACE else "word of the telegram"
            message = f"a {what} `{telegram_entry[0].name}` is {_VERBS[usual]} only"
            hint = f"write `access: {usual}`, or leave it out"
            self.report.error("wrong-choice", message, facts.span("access"), hint)
            return usual
        return access

    def references(self, facts: PointFacts, address: int) -> Mapping[str, int]:
        """Return the numbers that the manual prints for an address, by numbering.

        In a multiplexed telegram these include `mux`, the number of the frame, and `word`, the place in the frame.
        """
        numbers, carried = self._numbers(facts, address), self._words_per_frame(facts)
        return {"mux": address // carried, "word": address % carried + 1, **numbers} if carried else numbers

    def _place(self, facts: PointFacts, encoding: Encoding, key: str) -> Place:
        """Return the place that `key` gives: the word with the highest bits or the first characters comes first."""
        if encoding.space == SIGNAL_SPACE:
            return self._signal(facts, encoding, key)
        last, raw = self._last(facts, encoding.space), self._written_address(facts, key)
        if last is None or raw is None:
            return NOWHERE
        text = encoding.type == "text"
        ordered = text or isinstance(raw, Seq)
        try:
            if isinstance(raw, Seq):
                words = self._listed(facts, encoding, raw, key)
            else:
                words = self._text_words(facts, raw, last, key) if text else self._words(facts, encoding, raw, key)
            for address in (words[0], words[-1]) if text else words:
                if not 0 <= address <= last:
                    raise _outside(facts, key, address, last, single=address == words[0])
        except FactError as error:
            error.report(self.report)
            return NOWHERE
        if not text:
            self._check_parted(facts, words)
        printed = words[0] if text else min(words)  # of a text the word with the first characters, else the lowest
        downwards = not ordered and low_first(facts, "words", self._order, encoding.type)
        return Place(words[::-1] if downwards else words, self.references(facts, printed))

    def _signal(self, facts: PointFacts, encoding: Encoding, key: str) -> Place:
        """Return the place of a signal; its words are numbered when all signals of the message are known."""
        telegram = telegram_of(self.scope, self.telegrams, facts, SIGNAL_SPACE)
        raw = self._written_address(facts, key)
        if telegram is None or raw is None:
            return NOWHERE
        try:
            bit = self._address(facts, raw, key)
        except FactError as error:
            error.report(self.report)
            return NOWHERE
        words = tuple(range(-(-encoding.width // 16)))
        order = None if self.scope.bus is None else self.scope.bus.get("bytes")
        return Place(words, self._numbers(facts, bit), (bit, low_first(facts, "bytes", order, encoding.type)))

    def _words_per_frame(self, facts: PointFacts) -> int:
        """Return how many words of the point's telegram one frame carries; 0 if the telegram is not multiplexed."""
        if facts.get("space") != TELEGRAM_SPACE:
            return 0
        telegram_entry = self.telegrams.get(facts.group.get("telegram", ""))
        return 0 if telegram_entry is None else telegram_entry[1]

    def _last(self, facts: PointFacts, space: str) -> int | None:
        """Return the last address of the space, or the last word of the telegram; None after a finding."""
        if space != TELEGRAM_SPACE:
            return self._last_address(facts)
        telegram = telegram_of(self.scope, self.telegrams, facts, space)
        return None if telegram is None else telegram.words - 1

    def _last_address(self, facts: PointFacts) -> int:
        """Return the last address of a point, counted from the base of its group."""
        base = self.scope.base_of(facts.group)
        return self.scope.family.last_address if base is None else last_address(base, self.scope.given)

    def _words(self, facts: PointFacts, encoding: Encoding, raw: object, key: str) -> tuple[int, ...]:
        """Return the words of a number in ascending order. Raises FactError."""
        first = self._address(facts, raw, key)
        return tuple(range(first, first + self._count(facts, encoding)))

    def _listed(self, facts: PointFacts, encoding: Encoding, raw: Seq, key: str) -> tuple[int, ...]:
        """Return the words of a number by their addresses, the high part first. Raises FactError."""
        words, span = tuple([self._address(facts, item, key) for item in raw]), facts.span(key)
        typed = facts.untyped is None and encoding.type != "text" and encoding.space not in KEY_OF
        count = self._count(facts, encoding) if typed else 0
        if len(set(words)) != count or len(words) != count:
            message = f"these are {counted(len(set(words)), 'word')}, and `{facts.name}` has {count}"
            message = message if count else "a list of words is for numbers that are read by address"
            raise FactError("bad-number", message, span, "name each word of the number once, the high part first")
        if Place(words, {}).is_scattered and "w" in self.access(facts, encoding.space):
            message = f"no request writes the words of `{facts.name}`, which are not neighbours, alone"
            hint = "write `access: r`; to write them, describe each word as a point"
            raise FactError("wrong-choice", message, span, hint)
        return words

    def _check_parted(self, facts: PointFacts, words: tuple[int, ...]) -> None:
        """Report a number of more than two words that arrives in several frames: old and new words could mix."""
        carried = self._words_per_frame(facts)
        if carried and len(words) > _MOST_PARTED_WORDS and words[0] // carried != words[-1] // carried:
            message = f"the {len(words)} words of `{facts.name}` come in several frames"
            hint = "a number that is parted has two words at most: describe the parts as points of their own"
            self.report.error("parted-number", message, facts.span("at"), hint)

    def _count(self, facts: PointFacts, encoding: Encoding) -> int:
        """Return how many addresses a number takes."""
        if encoding.bits is not None or encoding.space in self.scope.family.indexed:  # one index holds a whole value
            return 1
        return -(-encoding.width // 16) if facts.untyped is None else int(facts.get("length", 1))

    def _text_words(self, facts: PointFacts, raw: object, last: int, key: str) -> tuple[int, ...]:
        """Return the words of a text in reading order, from its first word or between its two ends.

        Raises FactError.
        """
        layout = layout_of(self.scope, facts)
        if not layout.characters or "characters" in facts.failed:
            raise FactError
        first_text, dots, last_text = str(raw).partition("..") if isinstance(raw, str) else ("", "", "")
        if dots:
            first, final = (self._address(facts, end.strip(), key) for end in (first_text, last_text))
            step = 1 if first <= final else -1
            if abs(final - first) > last:
                raise _outside(facts, key, max(first, final), last, single=True)
            words = tuple(range(first, final + step, step))
        else:
            first = self._address(facts, raw, key)
            words = tuple(range(first, first + layout.words))
        if len(words) != layout.words:
            what, count = ("byte", "length") if layout.is_bytes or layout.parts else ("character", "characters")
            message = f"{len(words)} words hold {layout.per_word * len(words)} {what}s, not {layout.characters}"
            stand = f"two {what}s stand" if layout.per_word > 1 else f"one {what} stands"
            hint = f"{stand} in a word: correct `{key}` or `{count}`"
            raise FactError("text-length", message, facts.span(key), hint)
        return words

    def _written_address(self, facts: PointFacts, key: str) -> object:
        """Return the YAML value of `key`; None if the manual prints no address, or after a finding."""
        layer = facts.layer(key)
        if layer is None:
            if "at" not in facts.failed:
                self.report.error("missing-key", f"`{facts.name}` says no address", facts.span(), _NO_ADDRESS)
            return None
        return None if facts.use is not None and facts.use.get("at", 0) is None else layer[key]

    def _address(self, facts: PointFacts, raw: object, key: str) -> int:
        """Return the wire address that a YAML value gives. Raises FactError."""
        return self._address_of(facts, raw if isinstance(raw, int) else self._number(facts, str(raw), key))

    def _number(self, facts: PointFacts, text: str, key: str) -> int:
        """Return the number that a text under `key` gives, which may be a formula with `base`. Raises FactError."""
        span = facts.span(key)
        several = _first_of_several(text)
        if several is not None:
            hint = f"it stands once, at its first word: write `{key}: {several}`; the `type` says how many words it has"
            raise FactError("bad-number", f"`{text[:60]}` are several addresses", span, hint)
        if _FORMULA.search(text) is None:
            return whole(text, span)
        base = _base(facts)
        unknown = "" if base else "`base` is where a record is used: it is known in the points of a record only"
        exact = formula_value(text, base, span, unknown)
        if exact.denominator != 1:
            message = f"the address {number_text(exact)} is not a whole number"
            raise FactError("bad-number", message, span, "`at` is the number on the wire")
        return exact.numerator

    def _address_of(self, facts: PointFacts, number: int) -> int:
        """Return the address that the group's `addressing` makes of a number, or the number. Raises FactError."""
        group, element = facts.group, facts.element
        rule: str | None = group.get("addressing")
        if rule is not None:
            return self._by_rule(facts, rule, (element or ALONE).values(number))
        if "addressing" in group.broken:
            raise FactError
        indexed = facts.get("space") in self.scope.family.indexed
        if element is not None and indexed and element.index is not None and element.index > _LAST_INDEX:
            message = f"the index {element.index} does not fit beside the address"
            span = facts.span("indices" if "indices" in element.counted else "index")
            raise FactError("address-outside-space", message, span, f"indices are 0..{_LAST_INDEX}")
        if element is None or (element.set_number is None and (element.index is None or indexed)):
            return number
        message = "nothing says how the address follows from the number, the set and the index"
        example = "number * 64 + (index - 1) * sets + (set - 1)"
        if element.set_number is None:
            example = "number + (index - 1) * 2"
        hint = f"add `addressing: …` to the group, such as `{example}`"
        rows = "; sets that follow no rule have rows: `sets: {2: {at: …}}`" if "sets" in element.counted else ""
        raise FactError("missing-key", message, facts.span("at"), hint + rows)

    def _by_rule(self, facts: PointFacts, rule: str, values: Mapping[str, Fraction]) -> int:
        """Return the result of the group's `addressing`. Raises FactError; a wrong rule is reported only once."""
        span = facts.group.span("addressing")
        if id(facts.group) in self._wrong_rules:
            raise FactError
        self._wrong_rules.add(id(facts.group))
        exact = formula_value(rule, values, span, RULE_KNOWS)
        if exact.denominator != 1:
            message = f"the address of `{facts.name}` would be {number_text(exact)}, which is no whole number"
            hint = "correct the rule, or the number, set or index of the row"
            raise FactError("bad-number", message, span, hint)
        self._wrong_rules.remove(id(facts.group))
        return exact.numerator

    def _numbers(self, facts: PointFacts, address: int) -> Mapping[str, int]:
        """Return the number of an address in each readable numbering of the point's group."""
        numbering: Map | None = facts.group.get("numbering")
        if numbering is None:
            return {}
        key = id(numbering)
        if key not in self._lines:
            self._lines[key] = self._lines_of(numbering)
        return {name: address * slope + offset for name, (slope, offset) in self._lines[key].items()}

    def _lines_of(self, numbering: Map) -> Mapping[str, _Line]:
        """Return each numbering as a line over the address, without those that have a finding."""
        lines: dict[str, _Line | None] = {WIRE: (1, 0)}
        for name, text in numbering.items():
            if name == WIRE:
                hint = "`wire` is the address itself: choose another name"
                message = "a numbering cannot be called `wire`"
                self.report.error("duplicate-name", message, numbering.key_span(name), hint)
            else:
                lines[name] = self._line(numbering, name, text, lines)
        del lines[WIRE]
        return {name: line for name, line in lines.items() if line is not None}

    def _line(self, numbering: Map, name: str, text: str, known: Mapping[str, _Line | None]) -> _Line | None:
        span = numbering.span(name)
        try:
            expression = parse_expression(text)
            if any(known.get(used.name, 0) is None for used in names(expression)):
                return None  # that numbering has a finding already
            lines = {other: line for other, line in known.items() if line is not None}
            at = [
                evaluate(expression, {other: Fraction(line[0] * wire + line[1]) for other, line in lines.items()})
                for wire in _PROBES
            ]
        except FormulaError as error:
            formula_finding(error, span, self.report)
            return None
        slope, offset = at[1] - at[0], at[0]
        straight = all(result == slope * wire + offset for wire, result in zip(_PROBES, at, strict=True))
        if slope.denominator != 1 or offset.denominator != 1 or not straight:
            message = f"`{name}` is not a whole number at every address"
            self.report.error("bad-formula", message, span, "write it as `wire + 1` or `40000 + wire`")
            return None
        return slope.numerator, offset.numerator


def _first_of_several(text: str) -> str | None:
    """Return the first address of a text that gives several (`1..2`, `1 - 2`); None for a number or a formula."""
    first, _, last = ("" if ":" in text else suggest_interval(text) or "").partition("..")
    return first if first and parse_number(first) < parse_number(last) else None


def _base(facts: PointFacts) -> Mapping[str, Fraction]:
    """Return the names that a formula under `at` may use: `base` in a record, else none. Raises FactError."""
    use = facts.use
    if use is None:
        return {}
    if "at" in use:
        return {"base": Fraction(whole(use["at"], use.span("at")))}
    if "at" in use.broken:
        raise FactError
    raise FactError("missing-key", "the record stands at no address", use.span("name"), _NO_ADDRESS)


def _outside(facts: PointFacts, key: str, address: int, last: int, *, single: bool) -> FactError:
    """Return the error for an address that the space does not have, or a word that the telegram does not have."""
    if facts.get("space") == TELEGRAM_SPACE:
        message = f"word {address} lies outside the telegram, whose words are 0..{last}"
        hint = "`at` counts the words of the whole telegram from 0; correct it, or `length` of the telegram"
    elif single and "base" in facts.group and address > last:
        message = f"the address {address} lies outside 0..{last}, counted from `base: {facts.group['base']}`"
        hint = "with the greatest base it would be more than 65535: correct it, or the range under `given`"
    elif single:
        message = f"the address {address} lies outside 0..{last}"
        hint = f"`{key}` is the number on the wire; the numbers for people (40001) go under `printed`"
        hint = f"`{key}` counts from 0; what a reference counts from goes under `numbering`" if address < 0 else hint
    else:
        message = f"the last word of `{facts.name}` lies outside 0..{last}"
        hint = "check the address and the type"
    return FactError("address-outside-space", message, facts.span(key), hint)
