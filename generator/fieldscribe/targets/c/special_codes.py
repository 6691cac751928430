"""Special codes in C: macros and three functions for each set of codes, and their use in the functions of points."""

from collections.abc import Iterable, Iterator

from fieldscribe.arithmetic.words import INT64
from fieldscribe.model import Point, Special
from fieldscribe.targets.c.layout import INLINE, function
from fieldscribe.targets.c.limits import bracketed, is_in
from fieldscribe.targets.c.scope import HeaderScope, hexadecimal, raw_type, signed
from fieldscribe.targets.c.views import CodesView, Define, PointFields, SpecialView
from fieldscribe.text import c_comment, c_string, upper

FUNCTIONS = ("_is_special", "_special_name", "_is_no_value")
"""The ends of the functions' names, after the name of the point or of the shared codes."""


def special_view(point: Point, fields: PointFields, scope: HeaderScope, *, brings: bool) -> SpecialView | None:
    """Return the view of a point's special codes; None if it has none.

    `brings` says that this point defines the shared codes.
    """
    if not point.specials:
        return None
    own_prefix, name = f"{scope.prefix}_{fields.item}", f"{scope.prefix}_{point.shared_codes or fields.item}"
    return SpecialView(
        codes=_codes(point, name, scope) if brings or not point.shared_codes else None,
        test=f"{name}_is_special",
        written=any(special.writable for special in point.specials),
        aliases=tuple((own_prefix + tail, name + tail) for tail in FUNCTIONS) if own_prefix != name else (),
    )


def codes_first(point: Point, special: SpecialView | None, check: str) -> str:
    """Return a check that tests the special codes first: it accepts writable ones and refuses others."""
    if special is None:
        return check
    check = f"{special.test}(raw) ? FIELDSCRIBE_SPECIAL : ({check})"
    if not special.written:
        return check
    writable = bracketed(_test(point, (code for code in point.specials if code.writable)))
    return f"{writable} ? FIELDSCRIBE_OK : ({check})"


def code_defines(point: Point, macro: str) -> Iterator[Define]:
    """Yield the macros of all codes of a point."""
    for special in point.specials:
        yield from dict.fromkeys(special_defines(special, macro, point))


def special_defines(special: Special, macro: str, point: Point) -> tuple[Define, Define]:
    """Return the macros of the first and the last raw number of a code; for a single number twice the same macro."""
    name = f"{macro}_{upper(special.name)}"
    first, last = (_literal(raw, special, point) for raw in (special.low, special.high))
    if special.low == special.high:
        return (name, first), (name, last)
    return (f"{name}_FIRST", first), (f"{name}_LAST", last)


def encoded_limits(point: Point) -> tuple[int, int]:
    """Return the bounds of the raw numbers that need further checks: the outer limits and the special codes.

    Values are computed in signed 64 bits, so that larger codes need no check.
    """
    if not point.specials:
        return point.outer
    low, high = point.outer
    high = max(high, *(special.high for special in point.specials))
    return min(low, *(special.low for special in point.specials)), high if point.scale is None else min(high, INT64[1])


def _codes(point: Point, name: str, scope: HeaderScope) -> CodesView:
    """Return the set of codes, for the point that defines it."""
    shared = point.shared_codes
    return CodesView(
        comment=c_comment(f"Special codes of {shared}: raw numbers that are no quantity.") if shared else "",
        defines=tuple(code_defines(point, f"{scope.upper}_{upper(shared)}")) if shared else (),
        name=name,
        functions=tuple(_functions(point, name)),
    )


def _functions(point: Point, name: str) -> Iterator[str]:
    raw = (f"{raw_type(point)} raw",)
    is_special = _test(point, point.specials)
    no_value = _test(point, (special for special in point.specials if special.no_value))
    names = "".join(
        f"{bracketed(_test(point, (special,)))} ? {c_string(special.name)} : " for special in point.specials
    )
    is_no_value = (f"return {no_value};",) if no_value else ("(void)raw;", "return false;")
    yield function(f"{INLINE} bool", f"{name}_is_special", raw, f"return {is_special};").text
    yield function(f"{INLINE} bool", f"{name}_is_no_value", raw, *is_no_value).text
    yield function(f"{INLINE} const char *", f"{name}_special_name", raw, f"return {names}NULL;").text


def _literal(raw: int, special: Special, point: Point) -> str:
    return hexadecimal(raw, point.width + 3 >> 2) if special.hexadecimal and raw >= 0 else signed(raw)


def _test(point: Point, codes: Iterable[Special]) -> str:
    return is_in(point, [(code.low, code.high) for code in codes])
