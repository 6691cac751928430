"""The claims of a word's flags: their bits, their titles, and the meaning of each of their values."""

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from fieldscribe.audit.claims import Claim, ClaimMaker, Number, absolute, numbers_in
from fieldscribe.audit.numbers import Notation, joined
from fieldscribe.diagnostics import Span
from fieldscribe.language.nodes import Map
from fieldscribe.model import Flag, Point
from fieldscribe.resolve.bit_numbers import WORD_BITS, bit_numbers
from fieldscribe.resolve.point_facts import PointFacts


def claims_of_flags(
    maker: ClaimMaker, point: Point, facts: PointFacts, enums: Mapping[str, Map], notation: Notation
) -> Iterator[Claim]:
    """Yield the claims of each flag at its bits, with the values that have names; `enums` are shared ones."""
    for flag in point.flags:
        yield from _FlagClaims(maker, point, facts, notation, flag).all(enums.get(flag.enum))


class _FlagClaims:
    """Makes the claims of one flag. `low` and `high` are its bits in the whole word."""

    def __init__(self, maker: ClaimMaker, point: Point, facts: PointFacts, notation: Notation, flag: Flag) -> None:
        self.maker, self.point, self.notation, self.flag = maker, point, notation, flag
        above = point.bits[1] if point.bits else 0
        self.low, self.high = flag.low + above, flag.low + above + flag.width - 1
        self.numbers = bit_numbers(facts, WORD_BITS if point.bits else point.width)
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
            beside = () if self.named or at_values else (self._bits_of_flag(), self._bits_of_flag(), self._masks())
            yield from self.maker.label("flags", label, self.place, beside=beside)
        for name in ("mask", "active"):
            for number in numbers_in(self.printed.get(name)):
                yield from self.maker.number(f"printed {name}", number, self.place, key="flags")
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
            yield from self.maker.label("flag values", words, self.place, key=key, beside=((number,), *others))
            shown = f"{self.flag.name} {entry.raw}"
            evidence = Number(frozenset((number,)))
            is_optional = bool(words) or self.flag.width > 1 or not isinstance(self.node, Map)
            yield from self.maker.claim("flag values", shown, evidence, self.place, key="flags", optional=is_optional)

    def _bits_of_flag(self) -> list[Fraction]:
        """Return the bits that may represent the flag: its ends, or those under `printed`."""
        return numbers_in(self.printed.get("bit")) or [
            Fraction(self.numbers.number(bit)) for bit in (self.high, self.low)
        ]

    def _masks(self) -> list[Fraction]:
        """Return the masks that may represent the flag, in its own bits and in the whole word."""
        always = self.point.fixed.bits if self.point.fixed is not None else 0
        own = [1 << self.flag.low, 1 << self.flag.low + self.flag.width - 1]
        masks = [*own, 1 << self.low, 1 << self.high, *(mask | always for mask in own)]
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
