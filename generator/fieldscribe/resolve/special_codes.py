"""Resolves special codes: a point's own, those of its format, group and device, and those of its type."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from fieldscribe.arithmetic.words import BCD, coded_ends, coded_number, ends_of, mask_of, number_of
from fieldscribe.diagnostics import Span
from fieldscribe.language.nodes import Map
from fieldscribe.language.suggestions import suggest_interval
from fieldscribe.model import Allowed, Interval, Special, type_info
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.values import integer
from fieldscribe.resolve.word_contents import entry_titles, name_of

_PATTERN = re.compile(r"[+]?(?:0[xXb]|[hH]'|.*[hH]$)")
"""Matches a number that is not decimal: manuals print such codes as bit patterns."""


class _Code(NamedTuple):
    """An entry of `special`; an entry without a name removes an inherited code."""

    low: int
    high: int
    hexadecimal: bool
    name: str | None
    holder: Map
    key: str

    @property
    def span(self) -> Span:
        """Return the place of the number."""
        return self.holder.key_span(self.key)


_Level = tuple[str, Map]
"""The codes that one place declares, after its label, which is empty for the point itself."""


@dataclass(slots=True)
class SpecialCodes:
    """Finds the special codes of points; codes that many points share are read once."""

    scope: Scope
    _reported: set[tuple[Span, str]] = field(default_factory=set)
    _held: dict[tuple[int, str, int], tuple[_Code, ...]] = field(default_factory=dict)

    def check_types(self) -> None:
        """Check all codes under `types`, also those of types that no point has."""
        for holder in (self.scope.header, *self.scope.groups):
            for kind, facts in holder.get("types", {}).items():
                if "special" in facts:
                    self.held(facts["special"], kind, type_info(kind).bits)

    def of(
        self, facts: PointFacts, kind: str, bits: tuple[int, int] | None, coding: str
    ) -> tuple[tuple[Special, ...], str]:
        """Return the codes of a point of this type, nearest first, and a name for those that it shares with others."""
        levels = tuple(_levels(self.scope, facts, kind, bits))
        width = type_info(kind).bits if bits is None else bits[0] - bits[1] + 1
        found, shared = self._specials_of(levels, kind, width) if levels else ((), "")
        if not coding:
            return found, shared
        of_point = tuple(
            replace(
                code,
                low=coded_number(code.low & mask_of(width), width, coding) if code.hexadecimal else code.low,
                high=coded_number(code.high & mask_of(width), width, coding) if code.hexadecimal else code.high,
                shared=False,
            )
            for code in found
        )
        return of_point + (_not_decimal(of_point, width) if coding == BCD else ()), ""

    def _specials_of(self, levels: tuple[_Level, ...], kind: str, width: int) -> tuple[tuple[Special, ...], str]:
        codes = self._merged([self.held(node, kind, width) for _, node in levels])
        inherited = self._merged([self.held(node, kind, width) for label, node in levels if label])
        all_kept = bool(inherited) and set(map(id, codes)).issuperset(map(id, inherited))
        labels = dict.fromkeys(label for label, _ in reversed(levels) if label not in ("", kind))
        private = {id(node) for label, node in levels if not label or not all_kept}
        specials = tuple(_special(code, shared=id(code.holder) not in private) for code in codes)
        return specials, "_".join((*labels, kind)) if all_kept else ""

    def held(self, node: Map, kind: str, width: int) -> tuple[_Code, ...]:
        """Return the codes of one `special` as raw numbers of the type; report those that do not fit or clash."""
        key = (id(node), kind, width)
        if key not in self._held:
            kept: list[_Code] = []
            for code in self._numbers(node, kind, width):
                if not any(self._clash(code, other) for other in kept):
                    kept.append(code)
            self._held[key] = tuple(kept)
        return self._held[key]

    def _numbers(self, node: Map, kind: str, width: int) -> Iterator[_Code]:
        """Yield the entries of one `special` that the type can hold; report the others."""
        info = type_info(kind)
        least, greatest = ends_of(width, signed=info.signed)
        for key, value in node.items():
            span = node.key_span(key)
            suggestion = None if ".." in key else suggest_interval(key)
            if suggestion is not None:
                self._report("bad-number", f"`{key[:60]}` is no band", span, f"write {suggestion}")
                continue
            first, dots, last = key.partition("..")
            texts = [first.strip(), last.strip()] if dots else [first.strip()]
            ends = [integer(text, span, self.scope.report) for text in texts]
            numbers = [end for end in ends if end is not None]
            if len(numbers) < len(ends):
                continue
            patterns = [bool(_PATTERN.match(text)) for text in texts]
            if info.signed:  # manuals print the pattern of a negative code
                numbers = [
                    number_of(number, width, signed=True) if pattern and 0 <= number < 1 << width else number
                    for number, pattern in zip(numbers, patterns, strict=True)
                ]
            low, high = numbers[0], numbers[-1]
            if low > high and all(patterns) and info.signed:
                hint = f"split it at the sign: one code up to {greatest:X}h, one from {greatest + 1:X}h on"
                self._report("range-reversed", f"`{key}` goes from positive numbers to negative ones", span, hint)
            elif low > high:
                self._report("range-reversed", f"`{key}` runs downwards", span, "the smaller number stands first")
            elif info.floating and not all(patterns):
                message = f"a special code of an {kind} is its pattern of bits, and {key} is decimal"
                self._report("float-fact", message, span, "write the pattern in hexadecimal, as in 7FC00000h")
            elif not least <= low <= high <= greatest:
                message = f"the code {key} lies outside the type, which holds {least}..{greatest}"
                hint = "correct the code or the `type`; codes of the points of one type go under `types`"
                self._report("range-outside-type", message, span, hint)
            else:
                yield _Code(low, high, all(patterns), None if value is None else name_of(value), node, key)

    def _merged(self, levels: list[tuple[_Code, ...]]) -> list[_Code]:
        """Return the codes of all levels, nearest first, without those that a nearer level removes or replaces."""
        kept: list[_Code] = []
        away: list[_Code] = []
        used: set[int] = set()  # by identity: comparing places would look them up in the file
        for codes in levels:
            nearer, takers = list(kept), list(away)
            for code in codes:
                taken = [id(taker) for taker in takers if taker[:2] == code[:2]]
                used.update(taken)
                if code.name is None:
                    away.append(code)
                elif not taken and not any(self._beats(nearer_code, code) for nearer_code in nearer):
                    kept.append(code)
        for taker in away:
            if id(taker) not in used:
                message = f"there is no inherited special code {taker.key} to remove"
                hint = "give it a name, or leave it out; a band is removed as a whole, as it was declared"
                self._report("unknown-code", message, taker.span, hint)
        return kept

    def _beats(self, nearer: _Code, code: _Code) -> bool:
        """Return True if a nearer code with the same name or numbers replaces this one; report a partial overlap."""
        if nearer.name == code.name or nearer[:2] == code[:2]:
            return True
        if not _overlap(code, nearer):
            return False
        message = f"the special code {nearer.key}, `{nearer.name}`, shares numbers with the inherited {code.key}, "
        hint = f"remove that (`{code.key}: ~`) and name the rest of it"
        related = code.span, "inherited from here"
        self._report("special-twice", f"{message}`{code.name}`", nearer.span, hint, related)
        return True

    def _clash(self, code: _Code, other: _Code) -> bool:
        """Return True if two codes of one place share a number or a name, after reporting both places.

        An entry that removes an inherited code goes with entries that name its numbers anew.
        """
        if (code.name is None) != (other.name is None):
            return False
        first = other.span, "first given here"
        if _overlap(code, other):
            differ = code.name != other.name
            message = f"the special code {code.key} is given twice"
            message += f", as `{other.name}` and as `{code.name}`" if differ else ""
            self._report("special-twice", message, code.span, "remove one of them", first)
            return True
        if code.name is not None and code.name == other.name:
            message = f"two special codes have the name `{code.name}`"
            place = code.holder.span(code.key), "names are unique in a point"
            self._report("special-twice", message, *place, (other.holder.span(other.key), first[1]))
            return True
        return False

    def _report(self, rule: str, message: str, span: Span, hint: str, related: tuple[Span, str] | None = None) -> None:
        if (span, message) not in self._reported:
            self._reported.add((span, message))
            self.scope.report.error(rule, message, span, hint, [] if related is None else [related])


def _not_decimal(codes: tuple[Special, ...], width: int) -> tuple[Special, ...]:
    """Return the special codes of bits that are no decimal number: numbers out of digits that no code names."""
    first = coded_ends(width, BCD)[1] + 1
    parts = [part.fixed for part in _without(first, mask_of(width), codes) if part.fixed is not None]
    title = {"en": "Not a decimal number"}
    return tuple(
        Special(low, high, f"not_decimal{f'_{number}' if number > 1 else ''}", title, no_value=True)
        for number, (low, high) in enumerate(parts, 1)
    )


def _overlap(code: _Code, other: _Code) -> bool:
    """Return True if two codes share a number."""
    return code.low <= other.high and other.low <= code.high


def _levels(scope: Scope, facts: PointFacts, kind: str, bits: tuple[int, int] | None) -> Iterator[_Level]:
    """Yield the places that declare codes for a point, nearest first.

    Codes of a group and of the device are for whole words: for all whole numbers, or for the points of one type. Bit
    groups, single bits, texts and points of an unsettled type have only their own codes.
    """
    if kind == "text":
        return
    shared = scope.formats.get(str(facts.get("format"))) if facts.layer("format") is not None else None
    for layer in facts.layers:
        if layer.get("special"):
            yield (str(facts.get("format")) if layer is shared else ""), layer["special"]
    unsettled = (facts.layer("type") is not None and facts.get("type") is None) or facts.get("untyped") is not None
    if bits is not None or kind == "bit" or unsettled or facts.failed & {"type", "bits"}:
        return
    for holder, label in ((facts.group, str(facts.group["group"])), (scope.header, kind)):
        of_type = holder.get("types", {}).get(kind, {}).get("special")
        if of_type:
            yield label, of_type
        if holder.get("special") and not type_info(kind).floating:
            yield label, holder["special"]


def quantities(scope: Scope, facts: PointFacts, allowed: Allowed, specials: tuple[Special, ...]) -> Allowed:
    """Return what a range allows without the special codes; report a range that has nothing else."""
    remaining = without_codes(allowed, specials)
    if remaining.intervals or not allowed.intervals:
        return remaining
    message = f"`{facts.name}` has no number that is a quantity: all that it allows are special codes"
    key = next((key for key in ("range", "range_in_units", "enum") if facts.layer(key) is not None), None)
    scope.report.error("enum-outside-range", message, facts.span(key), "correct the range or the codes")
    return allowed


def without_codes(allowed: Allowed, specials: tuple[Special, ...]) -> Allowed:
    """Return the intervals without the codes; ends that other points set stay as they are."""
    intervals: list[Interval] = []
    for interval in allowed.intervals:
        if interval.fixed is not None:
            intervals += _without(*interval.fixed, specials)
        else:
            intervals.append(interval)
    return replace(allowed, intervals=tuple(intervals))


def _without(low: int, high: int, specials: tuple[Special, ...]) -> list[Interval]:
    """Return the parts of low..high between the codes."""
    parts = []
    for special in sorted(specials, key=lambda special: special.low):
        if low <= special.high and special.low <= high:
            if low < special.low:
                parts.append(Interval(low, special.low - 1))
            low = special.high + 1
    return [*parts, Interval(low, high)] if low <= high else parts


def _special(code: _Code, *, shared: bool) -> Special:
    value = code.holder[code.key]
    facts = {} if isinstance(value, str) else value
    name = str(code.name)
    return Special(
        code.low,
        code.high,
        name,
        entry_titles(value, name),
        facts.get("no_value", False),
        facts.get("writable", False),
        code.hexadecimal,
        shared,
    )
