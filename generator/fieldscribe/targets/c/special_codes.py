"""Special codes in C: constants and three functions for each set of codes, and what the points that have it ask."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import INT64
from fieldscribe.names import upper
from fieldscribe.targets.c.layout import function
from fieldscribe.targets.c.limits import any_of, bracketed, interval_test
from fieldscribe.targets.c.literals import bare, hexadecimal, raw_type, signed, unsigned
from fieldscribe.targets.c.views import CodesView, Function, SpecialView
from fieldscribe.text import c_comment, c_string

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Point, Special
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import Define

FUNCTIONS = ("_is_special", "_special_name", "_is_no_value")
"""What stands behind the name of a point, or of what its codes are shared by."""


def special_view(point: Point, scope: HeaderScope) -> SpecialView | None:
    """What the functions of a point ask about its special codes; None where it has none."""
    if not point.specials:
        return None
    own, name = f"{scope.prefix}_{point.item}", f"{scope.prefix}_{owner(point)}"
    return SpecialView(
        codes=_codes(point, name, scope),
        test=f"{name}_is_special",
        written=any(one.writable for one in point.specials),
        aliases=tuple((own + tail, name + tail) for tail in FUNCTIONS) if own != name else (),
    )


def codes_first(point: Point, special: SpecialView | None, check: str) -> str:
    """A check, with special codes in front: those that may be written pass, no other does."""
    if special is None:
        return check
    check = f"{special.test}(raw) ? FIELDSCRIBE_SPECIAL : ({check})"
    if not special.written:
        return check
    return f"{bracketed(_test(point, (one for one in point.specials if one.writable)))} ? FIELDSCRIBE_OK : ({check})"


def no_code(special: SpecialView | None) -> str:
    """The status of decoding: special codes are no quantities."""
    return "FIELDSCRIBE_OK" if special is None else f"{special.test}(raw) ? FIELDSCRIBE_SPECIAL : FIELDSCRIBE_OK"


def owner(point: Point) -> str:
    """What the codes of a point are called after: the point, or what gives them to many."""
    return point.shared_codes or point.item


def code_defines(point: Point, macro: str) -> Iterator[Define]:
    """The macros of all codes of a point."""
    for special in point.specials:
        yield from dict.fromkeys(special_defines(special, macro, point))


def special_defines(special: Special, macro: str, point: Point) -> tuple[Define, Define]:
    """The macros of the first and the last raw number of a code; the same one twice for a single number."""
    name = f"{macro}_{upper(special.name)}"
    first, last = (_literal(raw, special, point) for raw in (special.low, special.high))
    if special.low == special.high:
        return (name, first), (name, last)
    return (f"{name}_FIRST", first), (f"{name}_LAST", last)


def encoded_limits(point: Point) -> tuple[int, int]:
    """Between which raw numbers values are looked at: what may be written, and the codes, which values never are.

    No value becomes a code beyond 64 bits with a sign, in which they are computed.
    """
    low, high = point.outer
    high = max(high, *(one.high for one in point.specials))
    return min(low, *(one.low for one in point.specials)), high if point.scale is None else min(high, INT64[1])


def _codes(point: Point, name: str, scope: HeaderScope) -> CodesView | None:
    """The set of codes, at the first point that has it."""
    if name in scope.codes:
        return None
    scope.codes.add(name)
    shared = point.shared_codes
    return CodesView(
        comment=c_comment(f"Special codes of {shared}: raw numbers that are no quantity.") if shared else "",
        defines=tuple(code_defines(point, f"{scope.upper}_{upper(shared)}")) if shared else (),
        name=name,
        functions=() if scope.names_only else tuple(_functions(point, name)),
    )


def _functions(point: Point, name: str) -> Iterator[Function]:
    raw = (f"{raw_type(point)} raw",)
    is_special = _test(point, point.specials)
    no_value = _test(point, (one for one in point.specials if one.no_value))
    names = "".join(f"{bracketed(_test(point, (one,)))} ? {c_string(one.name)} : " for one in point.specials)
    is_no_value = (f"return {no_value};",) if no_value else ("(void)raw;", "return false;")
    yield Function(function("static inline bool", f"{name}_is_special", raw, f"return {is_special};"))
    yield Function(function("static inline bool", f"{name}_is_no_value", raw, *is_no_value))
    yield Function(function("static inline const char *", f"{name}_special_name", raw, f"return {names}NULL;"))


def _literal(raw: int, special: Special, point: Point) -> str:
    return hexadecimal(raw, point.width + 3 >> 2) if special.hexadecimal and raw >= 0 else signed(raw)


def _test(point: Point, codes: Iterable[Special]) -> str:
    literal = bare if point.info.signed else unsigned
    return any_of([interval_test("raw", code.low, code.high, point.held, literal) for code in codes])
