"""What a description says of a point, in the schema of the second readings (`readings/README.md`)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from fieldscribe.model import Bound, Entry, Factor, Flag, Linear, Point, Special
from fieldscribe.wording import condition_text

Facts = dict[str, Any]

LONG = 12
"""Enums with more entries than this are lists of their own, which points name."""


def place_of(point: Point) -> Facts:
    """What tells a point from the others: where it is; what has no address is told apart by its name."""
    bits = None if point.bits is None else span(*point.bits)
    return {
        "space": point.space,
        "telegram": point.telegram,
        "base": point.base,
        "address": point.address if point.address is not None else point.item,
        "index": point.index,
        "bits": bits,
        "variant": None if point.variant is None else str(point.variant),
    }


def span(high: int, low: int) -> str:
    """Bits as `7..4`, or as `3` when it is one."""
    return str(low) if high == low else f"{high}..{low}"


def of_point(point: Point, codes: Mapping[str, str], language: str) -> Facts:
    return {
        "code": point.code,
        "name": point.name,
        "title": point.title.get(language),
        "type": point.shape.wire_type if point.untyped is None else point.untyped,
        "words": list(point.addresses),
        "write_at": [list(place.addresses) for place in point.places[1:]],
        "access": point.access,
        "unit": point.unit.symbol,
        "scale": _scale(point, codes),
        "epoch": point.epoch,
        "range": _ranges(point, codes),
        "default": None if point.default is None else str(point.default),
        "steps": [list(one) for one in point.steps],
        **_names(point, language),
        "characters": point.text.characters if point.text else None,
        **_around(point),
    }


def _names(point: Point, language: str) -> Facts:
    enum = point.named_numbers
    return {
        "enum": enum and (enum.name if len(enum.entries) > LONG else entries_of(enum.entries, language)),
        "open": enum is not None and not enum.closed,
        "digits": point.digits.count if point.digits else None,
        "flags": {span(one.low + one.width - 1, one.low): _flag(one, language) for one in point.flags},
        "special": {span(one.high, one.low): _special(one, language) for one in point.specials},
        "fixed": _fixed(point),
    }


def _around(point: Point) -> Facts:
    """What is said about a point besides its raw number."""
    return {
        "references": dict(point.references),
        "record": point.record,
        "set": point.set,
        "changes": point.changes,
        "changes_with": list(point.changes_with),
        "keeps": point.keeps,
        "conditions": list(point.conditions),
        "when": condition_text(point.when),
        "since": [one for one in (point.since, point.until) if one is not None],
        "reserved": point.reserved,
        "documented_only": not point.generated,
    }


def entries_of(entries: Iterable[Entry], language: str) -> Facts:
    return {str(one.raw): [*_names_of(one, language), *([one.quantity] if one.quantity else [])] for one in entries}


def _names_of(one: Entry | Flag | Special, language: str) -> list[str | None]:
    return [one.name, one.title.get(language)]


def _flag(flag: Flag, language: str) -> list[Any]:
    meaning = entries_of(flag.values, language) or flag.active
    return [*_names_of(flag, language), meaning, *([] if flag.active else ["active at 0"])]


def _special(special: Special, language: str) -> list[Any]:
    told = {"no value": special.no_value, "writable": special.writable}
    return [*_names_of(special, language), *(word for word, holds in told.items() if holds)]


def _fixed(point: Point) -> Facts:
    if point.fixed is None:
        return {}
    there = [bit for bit in range(point.fixed.mask.bit_length()) if point.fixed.mask >> bit & 1]
    return {str(bit): point.fixed.bits >> bit & 1 for bit in there}


def _scale(point: Point, codes: Mapping[str, str]) -> object:
    """The rule; where another point chooses between rules, each by `code = raw number`."""
    cases = {_when(one.point, one.raw, codes): _rule(one.rule, codes) for one in point.scale or ()}
    return cases.get("") if list(cases) == [""] else cases


def _when(point: str | None, raw: int | None, codes: Mapping[str, str]) -> str:
    return "" if point is None else f"{codes[point]} = {raw}"


def _rule(rule: Linear, codes: Mapping[str, str]) -> list[Any]:
    factors = [_factor(one, codes) for one in rule.factors]
    return [str(rule.ratio.numerator), str(rule.ratio.denominator), str(rule.offset), factors]


def _factor(factor: Factor, codes: Mapping[str, str]) -> list[Any]:
    """[whose number, what is taken of it, the power that it has]."""
    linear = "raw" if (factor.slope, factor.intercept) == (1, 0) else f"raw * {factor.slope} + {factor.intercept}"
    return [codes[factor.point], f"10 ** {linear}" if factor.ten_to else linear, factor.power]


def _ranges(point: Point, codes: Mapping[str, str]) -> list[Any]:
    if point.allowed.units:
        return [[str(low), str(high)] for low, high in point.allowed.units]
    found: list[list[Any]] = []
    for one in point.allowed.intervals:
        pair = [_bound(one.low, codes), _bound(one.high, codes)]
        if found and isinstance(pair[0], int) and found[-1][1] == pair[0] - 1:
            found[-1][1] = pair[1]
        else:
            found.append(pair)
    return [] if found == _quantities(point) or point.info.floating else found


def _quantities(point: Point) -> list[list[int]]:
    """All raw numbers that the type can hold, but the special codes."""
    low, found = point.least, list[list[int]]()
    for one in sorted(point.specials, key=lambda special: special.low):
        found.append([low, one.low - 1])
        low = one.high + 1
    return [pair for pair in (*found, [low, point.greatest]) if pair[0] <= pair[1]]


def _bound(bound: Bound, codes: Mapping[str, str]) -> object:
    """A raw number, or the raw numbers that make it, as `10 * A004`."""
    if isinstance(bound, int):
        return bound
    terms = [] if bound.rule.ratio == 1 else [str(bound.rule.ratio)]
    terms += [str(codes[one.point]) if one.power == 1 else f"1 / {codes[one.point]}" for one in bound.rule.factors]
    return " * ".join(terms) + (f" + {bound.rule.offset}" if bound.rule.offset else "")
