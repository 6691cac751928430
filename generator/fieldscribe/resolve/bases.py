"""Resolves what addresses count from: `given` and `found` at the head, `base` and `block` at groups."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import prod

from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import integer_in
from fieldscribe.model import Base, Found, Given
from fieldscribe.resolve.scope import Scope, titles
from fieldscribe.resolve.values import FactError, formula_multiples, integer, interval
from fieldscribe.text import humanised, shortened

_MOST_BASES = 65536
"""The most bases of a group: each of them is checked."""
_LAST = 65535
_WORD = re.compile(r"\w+")
_NO_COUNTS = frozenset(("bits", "format", "indices", "record", "scale", "sets", "space", "variants", "cases"))
"""Keys that a row of a plain word does not have."""
_USUAL_SPACE, _USUAL_END = "holding", 0xFFFF


def read_bases(scope: Scope) -> None:
    """Add to the scope the given numbers, the chain of blocks, and the base of each group that has one."""
    header, report = scope.header, scope.report
    for key in ("given", "found"):
        if key in header and not scope.family.has_bases:
            message = f"a device of the family {scope.family.name} has no bases of addresses"
            report.error("wrong-choice", message, header.key_span(key), f"leave `{key}` out")
            return
    scope.given = {given.name: given for given in _given(scope, header.get("given", {}))}
    scope.found = _found(scope, header.get("found", {}))
    names: dict[str, str] = {}
    for group in scope.groups:
        try:
            base = _base_of(scope, group)
        except FactError as error:
            error.report(report)
            scope.bases[id(group)] = Base(str(group["group"]), "", 0, (), None)  # its points meet no other points
            continue
        if base is not None:
            name = next((known for known, formula in names.items() if formula == base.formula), base.name)
            number = 2
            while names.setdefault(name, base.formula) != base.formula:
                name, number = f"{base.name}_{number}", number + 1
            scope.bases[id(group)] = replace(base, name=name)
    used = {name for base in scope.bases.values() for name, _ in base.terms}
    for name in [] if report.has_errors else [name for name in scope.given if name not in used]:
        hint = "count with it in a `base`, or leave it out"
        report.error("two-meanings", f"no group counts with `{name}`", header["given"].key_span(name), hint)


def _given(scope: Scope, nodes: Map) -> Iterator[Given]:
    for name, node in nodes.items():
        ends = interval(str(node["range"]), node.span("range"), scope.report)
        if name in scope.axes:
            message = f"`{name}` is given, and an axis of variants"
            scope.report.error("duplicate-name", message, nodes.key_span(name), "rename one of them")
        if ends is not None and not 0 <= ends[0] <= ends[1] <= _LAST:
            message = f"`{name}` lies outside 0..{_LAST}"
            scope.report.error("wrong-choice", message, node.span("range"), "correct the range")
        elif ends is not None:
            yield Given(name, titles(node.get("title"), humanised(name)), *ends)


def _found(scope: Scope, nodes: Map) -> Found | None:
    """Return the chain of blocks; report a marker or a place that cannot be searched for."""
    report = scope.report
    for name in list(nodes)[1:]:
        message, hint = f"`{name}` is a second chain of blocks", "a device has one chain: describe it once"
        report.error("two-meanings", message, nodes.key_span(name), hint)
    for name, node in nodes.items():
        text, places, space = str(node["text"]), node["at"], str(node.get("space", _USUAL_SPACE))
        if not text or len(text) % 2 or not text.isascii() or not text.isprintable():
            hint = "write an even number of ASCII characters: two stand in a word"
            report.error("text-length", f"`{text}` fills no whole words", node.span("text"), hint)
            return None
        if space not in scope.family.spaces or scope.family.spaces[space] != "word":
            known = [word for word, holds in scope.family.spaces.items() if holds == "word"]
            scope.unknown("space", space, node.span("space"), known)
            return None
        if list(node["then"]) != ["id", "length"]:
            hint = "write `then: [id, length]`"
            report.error("wrong-choice", "a block starts with its id and its length", node.span("then"), hint)
        numbers = [integer(place, places.span(at), report) for at, place in enumerate(places)]
        end = integer(node.get("end", _USUAL_END), node.span("end"), report)
        for at, number in enumerate(numbers):
            if number is not None and not 0 <= number <= _LAST - len(text) // 2 - 1:
                hint = "the text and the first block after it end at 65535 or before"
                report.error("address-outside-space", f"the address {number} is too high", places.span(at), hint)
        known_places = tuple(dict.fromkeys(number for number in numbers if number is not None))
        title = titles(node.get("title"), humanised(name))
        return Found(name, title, space, text, known_places, _USUAL_END if end is None else end)
    return None


def _base_of(scope: Scope, group: Map) -> Base | None:
    """Return the base of a group; None if its addresses count from 0. Raises FactError."""
    formula, block = group.get("base"), group.get("block")
    if formula is None and block is None:
        return None
    if not scope.family.has_bases:
        key = "base" if block is None else "block"
        message = f"addresses of the family {scope.family.name} count from 0"
        raise FactError("wrong-choice", message, group.key_span(key), f"leave `{key}` out")
    if formula is not None and block is None:
        return _by_formula(scope, group, str(formula))
    number, found = integer(block, group.span("block"), scope.report), scope.found
    if number is None or (found is None and is_stated(scope, "found")):
        raise FactError  # it has a finding
    if found is None:
        hint = "declare how the blocks are found: `found` at the head of device.yaml"
        raise FactError("missing-key", "nothing says where blocks are", group.key_span("block"), hint)
    if group["space"] != found.space:
        hint = f"the blocks of `{found.name}` are in the space `{found.space}`"
        raise FactError("two-meanings", f"no block is in `{group['space']}`", group.span("block"), hint)
    if number == found.end:
        hint = "a block has another id"
        raise FactError("wrong-choice", f"{number} ends the chain `{found.name}`", group.span("block"), hint)
    start = Base(f"{found.name}_{number}", f"{found.name} {number}", 0, (), number)
    return start if formula is None else _in_block(scope, group, str(formula), start)


def is_stated(scope: Scope, key: str) -> bool:
    """Return True if the head has the key, also with a value that was dropped as wrong."""
    return key in scope.header or key in scope.header.broken


def _in_block(scope: Scope, group: Map, formula: str, start: Base) -> Base:
    """Return a base that is counted from the start of a block, which points of the block may move. Raises FactError."""
    span, places = group.span("base"), dict(_counting_points(scope, group))
    counting = "a point that counts is a whole word (u16) at a fixed place of the block"
    unknown = f"{counting}; there {'are' if places else 'is'} {', '.join(places) or 'none'}"
    offset, factors = formula_multiples(formula, places, span, unknown)
    if min(offset, *factors.values(), 0) < 0:
        raise FactError("bad-formula", f"`{formula}` can lie before the block", span, "points of a block count words")
    counts = tuple((name, places[name], factor) for name, factor in factors.items())
    return Base(f"{start.name}_behind", f"{start.formula} + {formula}", offset, (), start.block, counts)


def _counting_points(scope: Scope, group: Map) -> Iterator[tuple[str, int]]:
    """Yield the points of the same block that can count words, with their addresses: whole words at fixed places."""
    for other in scope.groups:
        is_of_block = integer_in(other.get("block")) == integer_in(group["block"])
        if is_of_block and other.keys().isdisjoint(("base", "addressing")):
            for row in other.get("points", ()):
                at = integer_in(row.get("at"))
                if at is not None and row.get("type", "u16") == "u16" and row.keys().isdisjoint(_NO_COUNTS):
                    yield str(row["name"]), at


def _by_formula(scope: Scope, group: Map, formula: str) -> Base:
    """Return the base that a formula gives; it is within 0..65535 for all given numbers. Raises FactError."""
    span, given = group.span("base"), scope.given
    stated: Map | None = scope.header.get("given")
    lost = () if stated is None else {*stated, *stated.broken}.difference(given)
    if "given" in scope.header.broken or not set(_WORD.findall(formula)).isdisjoint(lost):
        raise FactError  # a number has a finding
    unknown = f"given are: {', '.join(given)}" if given else "declare the number under `given`, at the head"
    offset, factors = formula_multiples(formula, given, span, unknown)
    terms = tuple((name, factors[name]) for name in given if name in factors)
    if prod(given[name].high + 1 - given[name].low for name in factors) > _MOST_BASES:
        hint = f"a group has at most {_MOST_BASES} bases: narrow the ranges under `given`"
        raise FactError("too-many-items", f"`{formula}` gives too many bases", span, hint)
    base = Base("_".join(name for name, _ in terms) or "base", formula, offset, terms, None)
    for rising in (True, False):
        chosen = {name: given[name].high if (factor > 0) == rising else given[name].low for name, factor in terms}
        if not 0 <= base.at(chosen) <= _LAST:
            where = ", ".join(f"{name} {number}" for name, number in chosen.items())
            message = f"the base is {shortened(str(base.at(chosen)))} for {where or 'all devices'}"
            raise FactError("address-outside-space", message, span, "correct the formula, or the range under `given`")
    return base


def last_address(base: Base, given: Mapping[str, Given]) -> int:
    """Return the last address that fits after a base for all given numbers."""
    ends = [(factor * (given[name].high if factor > 0 else given[name].low)) for name, factor in base.terms]
    return _LAST - base.offset - sum(ends)
