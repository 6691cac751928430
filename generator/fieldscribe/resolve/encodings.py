"""Resolves how the raw number of a point is encoded: its space, wire type, bits of the word and special codes."""

from typing import NamedTuple

from fieldscribe.arithmetic.words import BCD, MAGNITUDE, coded_ends, ends_of
from fieldscribe.diagnostics import Span
from fieldscribe.language.hints import quoted
from fieldscribe.language.nodes import Map
from fieldscribe.language.suggestions import space_hint, suggest_bits
from fieldscribe.model import Special, carrier_of, type_info
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.special_codes import SpecialCodes
from fieldscribe.resolve.values import BitNumbers


class Encoding(NamedTuple):
    """The encoding of a point, known before any formula is read.

    `width` is the number of bits of the raw number, `holds` the least and the greatest raw number. `specials_of` names
    the special codes if the point shares them with others. `swapped` says that the low byte of each word comes first,
    `coding` how the bits hold the number if not as usual.
    """

    space: str
    type: str
    bits: tuple[int, int] | None
    width: int
    holds: tuple[int, int]
    specials: tuple[Special, ...]
    specials_of: str
    swapped: bool = False
    coding: str = ""


def encoding_of(codes: SpecialCodes, facts: PointFacts) -> Encoding:
    """Return the encoding of a point; report what is wrong with it."""
    scope = codes.scope
    space = _space_of(scope, facts)
    bits = _bits_of(scope, facts, space)
    name = _type_of(scope, facts, space, bits)
    info = type_info(name)
    width = info.bits if bits is None else bits[0] - bits[1] + 1
    if scope.family.spaces[space] == "signal" and width < 16:
        bits = (width - 1, 0)  # of a whole word
    coding = _coding_of(scope, facts, name, width)
    holds = coded_ends(width, coding) if coding else ends_of(width, signed=info.signed)
    carrier = f"u{facts.pattern_bits}" if facts.pattern_bits else carrier_of(name)
    order = None if scope.bus is None else scope.bus.get("bytes")
    words = scope.family.spaces[space] == "word" and name != "text"
    swapped = words and low_first(facts, "bytes", order, carrier if bits is None else "u16")
    return Encoding(space, carrier, bits, width, holds, *codes.of(facts, name, bits, coding), swapped, coding)


def low_first(facts: PointFacts, key: str, order: object, carrier: str) -> bool:
    """Return True if the low part comes first: by the point or its group, else by the order of the bus for its type."""
    name = f"f{facts.pattern_bits}" if facts.pattern_bits else carrier
    usual = order.get(name) if isinstance(order, Map) else order
    return bool((facts.get(key) or usual) == "low first")


def _coding_of(scope: Scope, facts: PointFacts, name: str, width: int) -> str:
    """Return the coding of a number, empty for the usual one; report one that the point cannot have.

    The coding of a group is for those of its points that can have it.
    """
    coding, info = str(facts.get("coding") or ""), type_info(name)
    if not coding or facts.untyped is not None:
        return ""
    other = name in ("text", "bit") or any(facts.get(key) for key in ("flags", "digits", "fixed"))
    plain = other or info.floating or scope.family.spaces.get(str(facts.get("space"))) == "signal"
    if plain or info.signed != (coding == MAGNITUDE) or (coding == BCD and width % 4) or width < 2:
        if facts.layer("coding") is not facts.group and not info.floating and name != "text":  # reported anyway
            needs = "an s type" if coding == MAGNITUDE else "a u type whose bits are a multiple of 4"
            message, hint = f"`coding: {coding}` is for numbers of {needs}", "correct `type` or `bits`, or leave it out"
            scope.report.error("wrong-choice", message, facts.span("coding"), hint)
            facts.failed.add("coding")
        return ""
    return coding


def _space_of(scope: Scope, facts: PointFacts) -> str:
    """Return the point's address space; report an unknown one, and return the family's first space of words for it."""
    space = str(facts.get("space"))
    known = scope.family.spaces
    if space in known:
        return space
    scope.unknown("space", space, facts.span("space"), known, space_hint(space, known))
    facts.failed.add("space")
    return next(name for name, holds in known.items() if holds == "word")


def _bits_of(scope: Scope, facts: PointFacts, space: str) -> tuple[int, int] | None:
    """Return the (highest, lowest) bit that the point takes of its word; None for the whole word."""
    text = facts.get("bits")
    if text is None:
        return None
    span = facts.span("bits")
    holds = scope.family.spaces[space]
    if holds != "word":
        message = f"the space `{space}` holds {'single bits' if holds == 'bit' else 'signals'}, not words"
        scope.report.error("bit-outside-word", message, span, "leave `bits` out")
        return None
    return _parse_bits(scope, str(text), span, facts.bit_numbers())


def _parse_bits(scope: Scope, text: str, span: Span, numbers: BitNumbers) -> tuple[int, int] | None:
    suggestion = suggest_bits(text)
    if suggestion is not None:
        message = f"{quoted(text)} is not a bit or bits"
        scope.report.error("wrong-form", message, span, f"write `bits: {suggestion}`")
        return None
    ends = numbers.range_of(text, span, scope.report)
    outside = next((bit for bit in ends or () if not 0 <= bit <= 15), None)
    if outside is not None:
        message = f"bit {numbers.number(outside)} lies outside the 16-bit word"
        hint = f"bits are numbered {numbers.written(15, 0)}"
        hint += "" if numbers.from_top else f"; bit {numbers.number(16)} is bit {numbers.first} of the next address"
        scope.report.error("bit-outside-word", message, span, hint)
        return None
    return ends


def _type_of(scope: Scope, facts: PointFacts, space: str, bits: tuple[int, int] | None) -> str:
    """Return the point's wire type: the stated one, else that of its space and bits; report one that does not fit."""
    single = scope.family.spaces[space] == "bit"
    if scope.family.spaces[space] == "signal":
        return _type_of_signal(scope, facts)
    width = bits[0] - bits[1] + 1 if bits else None
    default = "bit" if single or width == 1 else "u8" if width is not None and width <= 8 else "u16"
    type_name = "text" if facts.text else str(facts.get("type") or default) if facts.untyped is None else default
    fault = None if "space" in facts.failed else _type_fault(type_name, space, single, width, default)
    fault = fault or (None if bits else _carrier_fault(scope, type_name, space))
    if fault is None:
        return type_name
    facts.failed.add("type")
    span = facts.span("type" if facts.layer("type") is not None else "space")
    scope.report.error(fault[0], fault[1], span, fault[2])
    return default


def _type_of_signal(scope: Scope, facts: PointFacts) -> str:
    """Return the wire type of a signal; report a missing one, and a type that a signal cannot have."""
    stated = facts.get("type")
    if stated is not None and stated not in ("bit", "text", "bytes"):
        return str(stated)
    if facts.untyped is None and not facts.failed & {"type", "space"}:
        facts.failed.add("type")
        message = f"`{facts.name}` says no type" if stated is None else f"`{stated}` is no type of a signal"
        span = facts.span() if stated is None else facts.span("type")
        hint = "a signal has a sign and a width, as in `type: u12`, `s7` or `u1`; or it is f32 or f64"
        scope.report.error("missing-key" if stated is None else "type-outside-space", message, span, hint)
    return "u1" if facts.untyped is None else "u16"


def _carrier_fault(scope: Scope, type_name: str, space: str) -> tuple[str, str, str] | None:
    """Return rule, message and hint for a type that is too wide for the bus; None if it fits."""
    widest = scope.family.widest(space)
    if type_name == "text" and space in scope.family.indexed:
        message = f"a text does not fit an address of `{space}`, which carries {widest} bits"
        return (
            "type-outside-space",
            message,
            'write in place of `type` and `characters`: `untyped: "a text, one character an index"`, in words that fit',
        )
    if type_name == "text" or type_info(type_name).bits <= widest:
        return None
    if space in scope.family.indexed:
        message = f"`{type_name}` does not fit an address of `{space}`, which carries {widest} bits"
        return "type-outside-space", message, "use u32, s32 or f32, or correct `space`"
    message = f"`{type_name}` does not fit into a message, which carries one word"
    return "type-outside-space", message, "give each address a point of its own"


def _type_fault(
    type_name: str, space: str, single: bool, width: int | None, default: str
) -> tuple[str, str, str] | None:
    """Return rule, message and hint for a type that does not fit space and bits; None if it fits."""
    info = type_info(type_name)
    if type_name == "text" and (single or width is not None):
        return (
            "type-outside-space",
            "texts, bytes and dates take whole words",
            "leave `bits` out, and choose a space of words",
        )
    if width is not None:
        if width <= info.bits <= 16 and not info.floating:
            return None
        return "bit-outside-word", f"{width} bits do not fit the type `{type_name}`", f"use `{default}`"
    if single != (type_name == "bit"):
        message = (
            f"`{type_name}` does not fit the space `{space}`, which holds {'single bits' if single else '16-bit words'}"
        )
        return "type-outside-space", message, "use `bit`" if single else "use `bits` to take one bit of a word"
    if not single and info.bits < 16:
        message = f"`{type_name}` is smaller than the words of `{space}`"
        return "type-outside-space", message, "use u16 or s16, or say which `bits` of the word it takes"
    return None
