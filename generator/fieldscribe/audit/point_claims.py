"""The claims of a point: its code, section, address, title, access, numbers, labels, and those under `printed`.

Those of a flag are its bits, its title, and the meaning of each of its values.
"""

import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from fieldscribe.audit.claims import Claim, ClaimMaker, Number, Word, absolute, numbers_in
from fieldscribe.audit.numbers import USUAL_ACCESS, USUAL_TYPES, Notation, joined
from fieldscribe.diagnostics import Span
from fieldscribe.language.keys import keys_of
from fieldscribe.language.keys.places import PRINTED
from fieldscribe.language.nodes import Map
from fieldscribe.model import Flag, Point
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.values import WORD_BITS


class _FlagClaims:
    """Makes the claims of one flag. `low` and `high` are its bits in the whole word."""

    def __init__(self, maker: ClaimMaker, point: Point, facts: PointFacts, notation: Notation, flag: Flag) -> None:
        self.maker, self.point, self.notation, self.flag = maker, point, notation, flag
        above = point.bits[1] if point.bits else 0
        self.low, self.high = flag.low + above, flag.low + above + flag.width - 1
        self.numbers = facts.bit_numbers(WORD_BITS if point.bits else point.width)
        self.place, self.node = _node_of(facts, {self.numbers.number(bit) for bit in (self.low, self.high)})
        self.printed = self.node.get("printed", {}) if isinstance(self.node, Map) else {}
        self.named = notation.bits(self.high - above, flag.low)

    def all(self, enum: Map | None) -> Iterator[Claim]:
        """Yield the claims; `enum` is the shared one that names the flag's values."""
        label = self.notation.label(self.node.get("title")) if isinstance(self.node, Map) else ()
        values = [_label_of_value(self.node, entry.raw, enum, self.notation) for entry in self.flag.values]
        once_for_all = "values" in self.maker.lines_of_fact
        at_values = any(values) and not once_for_all  # the values have the numbers
        yield from self._bits(optional=bool(label or at_values) and not self.named)
        if label and self.flag.width > 1 and not self.named and not at_values:
            ends = (Fraction(self.numbers.number(self.high)), Fraction(self.numbers.number(self.low)))
            yield from self.maker.run("flags", f"bits {self.high} and {self.low}", [ends], self.place, spread=True)
        is_value = any(set(label) <= set(words) or (label and words and label[0] in words[0]) for words in values)
        if not is_value:
            adjacent = () if self.named or at_values else (self._bits_of_flag(), self._bits_of_flag(), self._masks())
            yield from self.maker.label("flags", label, self.place, adjacent=adjacent)
        for name in ("mask", "active"):
            yield from self.maker.numbers(f"printed {name}", self.printed.get(name), self.place, key="flags")
        yield from self._values(values, "values" if once_for_all else "flags")

    def _bits(self, *, optional: bool) -> Iterator[Claim]:
        for bit in dict.fromkeys((self.high, self.low)):
            run = self._ends_of_run(bit)
            ends = frozenset(map(Fraction, run)) if bit not in run else frozenset()
            numbers = numbers_in(self.printed.get("bit")) or [Fraction(self.numbers.number(bit)), *self._masks()]
            words = (*self.named, *joined("bit", bit))
            names = ("Bit", *self.notation.written("bits")) if optional else ()
            evidence = Number(absolute(numbers), words, ends, names=names)
            yield from self.maker.claim("flags", f"bit {bit}", evidence, self.place, optional=optional)

    def _values(self, labels: list[tuple[str, ...]], key: str) -> Iterator[Claim]:
        """Each value with its label, beside its number or the flag's bit; a value without a label is its number."""
        others = () if key == "values" else (self._bits_of_flag(), self._masks())
        for entry, words in zip(self.flag.values, labels, strict=True):
            number = Fraction(entry.raw)
            yield from self.maker.label("flag values", words, self.place, key=key, adjacent=((number,), *others))
            stated = f"{self.flag.name} {entry.raw}"
            evidence = Number(frozenset((number,)))
            is_optional = bool(words) or self.flag.width > 1 or not isinstance(self.node, Map)
            yield from self.maker.claim("flag values", stated, evidence, self.place, key="flags", optional=is_optional)

    def _bits_of_flag(self) -> list[Fraction]:
        """Return the bits that may represent the flag: its ends, or those under `printed`."""
        return numbers_in(self.printed.get("bit")) or [
            Fraction(self.numbers.number(bit)) for bit in (self.high, self.low)
        ]

    def _masks(self) -> list[Fraction]:
        """Return the masks that may represent the flag, in its own bits and in the whole word."""
        always = self.point.fixed.bits if self.point.fixed is not None else 0
        single = [1 << self.flag.low, 1 << self.flag.low + self.flag.width - 1]
        masks = [*single, 1 << self.low, 1 << self.high, *(mask | always for mask in single)]
        return list(map(Fraction, dict.fromkeys(masks)))

    def _ends_of_run(self, bit: int) -> tuple[int, int]:
        """Return the ends of the run of named bits around a bit."""
        above = self.low - self.flag.low
        named = {place + above for flag in self.point.flags for place in range(flag.low, flag.low + flag.width)}
        low = high = bit
        while low - 1 in named:
            low -= 1
        while high + 1 in named:
            high += 1
        return low, high


def _label_of_value(node: Any, raw: int, enum: Map | None, notation: Notation) -> tuple[str, ...]:
    if not isinstance(node, Map):
        return ()
    named = node.get("values", {}) if enum is None else enum
    values = {int(number): entry for key, entry in named.items() for number in numbers_in(key)}
    values |= {number: node[key] for number, key in enumerate(("zero", "one")) if key in node}
    entry = values.get(raw)
    titles = entry.get("title", entry) if isinstance(entry, Map) else None
    return notation.label(titles) if isinstance(titles, Map) else ()


def _node_of(facts: PointFacts, ends: set[int]) -> tuple[Span, Any]:
    """Return the node that names the bits of a flag, and its key."""
    flags = facts.get("flags")
    if not isinstance(flags, Map):
        return facts.span("flags"), None
    key = next((bits for bits in flags if ends == set(numbers_in(bits))), None)
    return (flags.span(), None) if key is None else (flags.key_span(key), flags[key])


_INDEX_AFTER_CODE = re.compile(r"\[.*|\(.*")
_LETTERS_AND_DIGITS = re.compile("([A-Za-z]+)([0-9]+)")
_NUMBERS = re.compile(r"\b0x[0-9A-Fa-f]+\b|\b[0-9][0-9A-Fa-f]*h\b")
_KEY_IN_LINES = {"range_in_units": "range", "pairs": "printed"}
"""The keys of `printed` that have another key under `lines`."""
KEYS_OF_PRINTED = keys_of(PRINTED)
"""The keys of `printed` that every point may have; its other keys are the numberings of the device."""


class PointClaims:
    """Makes the claims of all facts that one point itself states; `enums` are the shared ones."""

    def __init__(self, point: Point, facts: PointFacts, enums: Mapping[str, Map], notation: Notation) -> None:
        self.point, self.facts, self.enums, self.notation = point, facts, enums, notation
        line = None if point.source.line is None else (point.source.line, facts.span("line"))
        self.maker = ClaimMaker(point.item, facts.span(), line, facts.get("lines"), point.name)

    def all(self, shared: frozenset[str]) -> Iterator[Claim]:
        """Yield the claims; `shared` numberings give one number to several addresses."""
        facts = self.facts
        code = None if self.point.code is None else _INDEX_AFTER_CODE.sub("", self.point.code).strip()
        if code:
            yield from self.maker.word("code", (*self._codes(code), str(self.point.code)), facts.span("code"))
        if self._states("section"):
            yield from self.maker.word("section", (str(facts.get("section")),), facts.span("section"))
        yield from self._address(code or "", shared)
        yield from self.maker.label("title", self.notation.label(self._titles()), facts.span("title"))
        yield from self._access()
        yield from self._type_and_unit()
        yield from self._ranges()
        yield from self._bits()
        yield from self._scale_and_default()
        yield from self._enum()
        yield from self._special_codes()
        for flag in self.point.flags:
            claims = _FlagClaims(self.maker, self.point, facts, self.notation, flag)
            yield from claims.all(self.enums.get(flag.enum))
        yield from self._printed()

    def _states(self, key: str) -> bool:
        """Return True if the point (or its format, record, set) states a fact: facts of its group cite no line."""
        layer = self.facts.layer(key)
        return layer is not None and layer is not self.facts.group

    def _titles(self) -> Any:
        """Return the title of the row. A further set has its own row, with a title that was made from the first."""
        made = {language: text for language, text in self.facts.title.items() if language != "en"}
        return self.facts.get("title", made)

    def _codes(self, code: str) -> tuple[str, ...]:
        """Return how a manual may write a code: `P601`, `P 601`, `Parameter 601`."""
        match = _LETTERS_AND_DIGITS.fullmatch(code)
        if match is None:
            return (code,)
        letters, digits = match.groups()
        return (code, f"{letters} {digits}", *(f"{word} {digits}" for word in self.notation.written(letters)))

    def _address(self, code: str, shared: frozenset[str]) -> Iterator[Claim]:
        point, facts, place = self.point, self.facts, self.facts.span("at")
        if point.address is None:
            return
        at = facts.get("at")
        by_rule = (facts.element is not None or "addressing" in facts.group) and str(at).isdigit()
        rule = [Fraction(int(at))] if by_rule else []
        for number in (*rule, *map(Fraction, filter(None, (point.set, point.index)))):
            yield from self.maker.number("number", number, place, key="code", optional=True)
        if code and any(str(number) in code for number in (point.address, *map(int, rule))):
            return  # the code is the number
        if point.text is not None:
            ends = absolute(map(Fraction, (point.addresses[0], point.addresses[-1])))
            for address in map(Fraction, point.addresses):
                evidence = Number(frozenset((address,)), ends=ends if address not in ends else frozenset())
                yield from self.maker.claim("address", str(address), evidence, place)
            return
        for word in point.places:
            references = {name: number for name, number in word.references.items() if name not in shared}
            numbers = [Fraction(number) for number in references.values() if isinstance(number, int)]
            words = tuple(text for name, number in references.items() for text in joined(name, number))
            first = min(word.addresses)
            evidence = Number(absolute((Fraction(first), *numbers, *rule)), words)
            yield from self.maker.claim("address", f"{first:04X}h", evidence, place)

    def _access(self) -> Iterator[Claim]:
        """Yield the claim of access. A row that prints no access agrees, also with `none`."""
        access, declared = str(self.facts.get("access")), self.notation.access
        notations = declared or USUAL_ACCESS
        words = tuple(notations.get(access, ()))
        unit = self.point.unit.symbol if self.point.unit is not None else ""
        rivals = tuple(word for other, there in notations.items() if other != access for word in there if word != unit)
        if words or (declared and access == "none" and rivals):
            evidence = Word(words, rivals, cells=not declared)
            yield from self.maker.claim("access", words[0] if words else access, evidence, self.facts.span("access"))

    def _type_and_unit(self) -> Iterator[Claim]:
        """Yield the claim that no cell of the row prints another type.

        Between editions, type and unit stand if the old edition prints them.
        """
        kind, place = str(self.facts.get("type") or ""), self.facts.span("type")
        words = USUAL_TYPES.get(kind, ())
        if words:
            rivals = tuple(word for other, there in USUAL_TYPES.items() if other != kind for word in there)
            yield from self.maker.claim("type", kind, Word(words, rivals, cells=True), place)
            yield from self.maker.claim("type", kind, Word(words), place, optional=True)
        symbol = self.point.unit.symbol if self.point.unit is not None else ""
        if symbol:
            yield from self.maker.claim("unit", symbol, Word((symbol,)), self.facts.span("unit"), optional=True)

    def _ranges(self) -> Iterator[Claim]:
        for key in ("range", "range_in_units"):
            if self._states(key) and not self.point.flags:  # the flags of a word decide which numbers it holds
                spread = _is_spread(self.facts.get(key))
                for stated, numbers in _runs_of(self.facts.get(key)):
                    ways = self._in_both_units(numbers, in_units=key == "range_in_units")
                    yield from self.maker.run("range", stated, ways, self.facts.span(key), spread=spread)
        if self.point.text is not None and self._states("characters"):
            characters = Fraction(self.point.text.characters)
            yield from self.maker.number("characters", characters, self.facts.span("characters"), key="range")

    def _in_both_units(self, numbers: list[Fraction], *, in_units: bool) -> list[list[Fraction]]:
        """Return limits as written, and also raw or in the unit, unless `printed` or the scale forbids that."""
        printed, cases = self.facts.get("printed"), self.point.scale or ()
        prints_units = isinstance(printed, Map) and "range_in_units" in printed and self._states("range")
        if prints_units or len(cases) != 1 or cases[0].rule.factors:
            return [numbers]
        rule = cases[0].rule
        if in_units:
            return [numbers, [number * rule.ratio + rule.offset for number in numbers]]
        return [numbers, [(number - rule.offset) / rule.ratio for number in numbers]]

    def _bits(self) -> Iterator[Claim]:
        """Yield the claims of the bits of the point in its word, and of constant bits."""
        bits = self.point.bits
        if bits is not None:
            words, numbers = self.notation.bits(*bits), self.facts.bit_numbers()
            for bit in range(bits[1], bits[0] + 1):
                evidence, place = Number(frozenset((Fraction(numbers.number(bit)),)), words), self.facts.span("bits")
                yield from self.maker.claim("bits", str(bit), evidence, place, optional=bit not in bits)
        numbers = self.facts.bit_numbers(self.point.width if bits is None else WORD_BITS)
        fixed: Any = self.facts.get("fixed") if self._states("fixed") else None
        for run, constant in fixed.items() if isinstance(fixed, Map) else ():
            place, ends = fixed.key_span(run), numbers_in(run)
            for end in ends:
                masks = (Fraction(1 << numbers.bit(int(end))),) if len(ends) == 1 else ()
                yield from self.maker.claim("fixed bits", str(end), Number(absolute((end, *masks))), place, key="bits")
            for number in numbers_in(constant):
                evidence = Number(absolute((number,)), self.notation.written(number))
                yield from self.maker.claim("fixed bits", f"= {number}", evidence, place, key="bits")

    def _scale_and_default(self) -> Iterator[Claim]:
        """Yield the claims of the factors of the scale, and of the default."""
        scale: Any = self.facts.get("scale") if self._states("scale") else None
        for rule in [scale] if isinstance(scale, str) else [case["rule"] for case in scale or ()]:
            for number in numbers_in(rule):
                if number not in (0, 1):
                    evidence = Number(absolute((number, 1 / number)))
                    yield from self.maker.claim("scale", str(number), evidence, self.facts.span("scale"))
        if self.point.default_raw is not None:
            numbers = [Fraction(self.point.default_raw), *filter(None, (self.point.default,))]
            place = self.facts.span("default" if self.facts.layer("default") is not None else "default_in_units")
            stated = str(self.facts.get("default", self.facts.get("default_in_units")))
            entries = () if self.point.enum is None else self.point.enum.entries
            labels = [self.notation.label(entry.title) for entry in entries if entry.raw == self.point.default_raw]
            words = (*self.notation.written(stated), *(word for label in labels for word in label))
            evidence = Number(absolute(numbers), words, names=self.notation.written("default"))
            yield from self.maker.claim("default", stated, evidence, place)

    def _enum(self) -> Iterator[Claim]:
        """Yield the claims of the numbers and labels of the enum, except entries of a shared enum that cite a line."""
        key = "digits" if self.point.digits else "enum"
        value: Any = self.facts.get(key)
        if not self._states(key) or value is None:
            return
        value = value["enum"] if self.point.digits else value
        entries: Map = self.enums[value] if isinstance(value, str) else value
        numbers = [numbers_in(number)[0] for number in entries]
        yield from self.maker.run("enum", ", ".join(map(str, numbers)), [numbers], self.facts.span(key), optional=True)
        for number, entry in entries.items():
            if isinstance(entry, Map) and "line" in entry and entries is not value:
                continue
            place, adjacent = entries.key_span(number), numbers_in(number)
            label = self.notation.label(entry) if isinstance(entry, Map) else ()
            quantity = numbers_in(entry.get("quantity")) if isinstance(entry, Map) else []
            yield from self.maker.label("enum", label, place, adjacent=(adjacent,))
            if quantity:
                stated = f"{number} = {entry['quantity']}"
                yield from self.maker.run("enum", stated, [(adjacent[0], quantity[0])], place)
            elif not label:
                yield from self.maker.claim("enum", str(number), Number(absolute(adjacent)), place)

    def _special_codes(self) -> Iterator[Claim]:
        """Yield the claims of special codes, each with its name."""
        codes: Any = self.facts.get("special") if self._states("special") else None
        for number, entry in codes.items() if isinstance(codes, Map) else ():
            label = self.notation.label(entry) if isinstance(entry, Map) else ()
            yield from self.maker.label("special", label, codes.key_span(number), adjacent=(numbers_in(number),))

    def _printed(self) -> Iterator[Claim]:
        """Yield the claims of `printed`: addresses in each numbering, ranges, steps, pairs."""
        printed = self.facts.get("printed")
        for name, value in printed.items() if isinstance(printed, Map) else ():
            is_numbering, place = name not in KEYS_OF_PRINTED, printed.span(name)
            key, fact = "address" if is_numbering else _KEY_IN_LINES.get(name, name), f"printed {name}"
            if name in ("range", "range_in_units"):
                for stated, numbers in _runs_of(value):
                    yield from self.maker.run(fact, stated, [numbers], place, key=key, spread=_is_spread(value))
            elif name == "pairs":
                for raw, number in value.items():
                    pair = [*numbers_in(raw), *numbers_in(number)]
                    yield from self.maker.run(fact, f"{raw} = {number}", [pair, pair[::-1]], place, key=key)
            else:
                numbers = numbers_in(value)
                names = (*joined(name, ""), *self.notation.written(name)) if is_numbering else ()
                for number in dict.fromkeys(numbers):
                    words = joined(name, number) if is_numbering else ()
                    evidence = Number(absolute((number,)), words, times=numbers.count(number), names=names)
                    unprinted = name == "resolution" and number == 1  # "resolution: A" is one ampere
                    yield from self.maker.claim(fact, str(number), evidence, place, key=key, optional=unprinted)


def _is_spread(value: Any) -> bool:
    """Return True if codes, factors or other intervals may come between the numbers of a range."""
    return any(char.isalpha() or char in "*|" for char in _NUMBERS.sub("", str(value)))


def _runs_of(value: Any) -> Iterator[tuple[str, list[Fraction]]]:
    """Yield the runs that are printed in one piece: each interval, or the list of all single numbers."""
    texts = [str(item) for item in value] if isinstance(value, list) else [str(value)]
    parts = [part.strip() for text in texts for part in text.split(",")]
    singles = [part for part in parts if ".." not in part]
    runs = [part for part in parts if ".." in part] + [", ".join(singles)] * bool(singles)
    yield from ((run, numbers_in(run)) for run in runs if numbers_in(run))
