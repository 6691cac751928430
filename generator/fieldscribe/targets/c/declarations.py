"""What stands before the functions of a point: its comment, the macros of its place and bits, and its special codes.

A set of special codes has macros and three functions, which the functions of points use. `point_views` asks for all.
"""

from collections.abc import Iterable, Iterator

from fieldscribe import wording
from fieldscribe.arithmetic.texts import epoch_in_unix
from fieldscribe.arithmetic.words import INT64, group_mask
from fieldscribe.model import Flag, Point, Special
from fieldscribe.targets.c.limits import bracketed, is_in
from fieldscribe.targets.c.scope import CodesView, Define, HeaderScope, PointFields
from fieldscribe.targets.c.syntax import (
    INLINE,
    WIDTH,
    filled,
    folded,
    function,
    hexadecimal,
    raw_type,
    signed,
    unsigned,
)
from fieldscribe.text import c_comment, c_string, upper


class PointComment:
    """Builds the comment above a point: what users of the code must know, without titles and notes.

    It gives the code, name, range, unit, step, access, space and default of a point, then rare facts, and the errata
    that changed one of these. All but code, name, range, references and default follow from the template key.
    """

    def __init__(self, point: Point, scope: HeaderScope, remark: str = "") -> None:
        self._steps = tuple(map(c_comment, _steps(point))) if point.untyped is None else ()
        self._typed = point.untyped is None
        self._access = point.access if scope.spaces.get(point.group) is not None else f"{point.access}, {point.space}"
        self._display = tuple(filter(None, (wording.display_text(point), wording.epoch_text(point))))
        self._rest = (*map(c_comment, _rare_facts(point, scope)), *((c_comment(remark),) if remark else ()))

    def of(self, point: Point, limits: str) -> str:
        """Return the lines of the comment above a point; `limits` is its range."""
        name = point.item.replace("_", " ")
        head = name if point.code is None else f"{c_comment(point.code)} {name}"
        references = point.place.references
        place = ", ".join([self._access, *[f"{key} {_printed(number)}" for key, number in references.items()]])
        facts = [*((limits,) if limits and self._typed else ()), *self._steps, place, *self._display]
        if point.default is not None or point.default_raw is not None:
            facts.append(f"default {c_comment(wording.default_text(point))}")
        text = f"/* {head}: {'; '.join([*facts, *self._rest])} */"
        if len(text) <= WIDTH:
            return text
        return folded("\n".join(("/*", *filled(text[3:-3].split(" "), " ", " * "), " */")))


def _printed(reference: int | str) -> str:
    return c_comment(reference) if isinstance(reference, str) else str(reference)


def _rare_facts(point: Point, scope: HeaderScope) -> Iterator[str]:
    if point.when is not None:
        yield f"exists only when {wording.condition_text(point.when, scope.points)}"
    yield from (*wording.write_texts(point), *wording.width_texts(point), *wording.overflow_texts(point))
    if point.specials:
        yield wording.codes_text(point)
    if any(flag.width == 1 and flag.active == 0 for flag in point.flags):
        yield "exclusive or with ACTIVE_LOW_MASK makes every bit 1 whose name is true, and back"
    errata, doubts = scope.lowered.errata_of(point)
    if errata:
        yield f"errat{'a' if len(errata) > 1 else 'um'} {', '.join(errata)}"
    if doubts:
        yield f"the {wording.open_text(doubts)}"


def range_words(point: Point) -> str:
    """Return the range in the unit, or in raw numbers where values cannot be given."""
    if point.text is not None:
        return wording.characters_text(point.text)
    if point.digits is not None:
        return f"{point.digits.count} digits, the highest first"
    units = wording.range_text(point)
    raws = "" if units else wording.raw_range_text(point)
    return units or (f"raw {raws}" if raws else "")


def _steps(point: Point) -> Iterator[str]:
    """Yield the unit of a count, and the device's steps if they are coarser; without counts, the unit of values."""
    has_steps = point.form in ("scaled", "float")
    count, step = (wording.count_text(point), wording.resolution_text(point)) if has_steps else ("", "")
    if step and step != count:
        yield f"in steps of {step}"
    if count:
        yield f"{count} a count"
    if point.unit.symbol and not (step or count or wording.range_text(point)):
        yield f"values in {point.unit.symbol}"


def defines(point: Point, fields: PointFields, scope: HeaderScope) -> Iterator[Define]:
    """Yield the macros of a generated point and their literals."""
    macro = f"{scope.upper}_{fields.macro}"
    yield from place_defines(point, fields, scope)
    if point.words > 1 or point.text is not None:
        yield f"{macro}_WORDS", f"{point.words}U"
    yield from _raw_number(point, fields, macro)
    yield from _bits(point, macro)
    if not point.shared_codes:
        yield from code_defines(point, macro)
    active_low = sum(1 << flag.low for flag in point.flags if _active_low(flag))
    if active_low:
        yield f"{macro}_ACTIVE_LOW_MASK", hexadecimal(active_low, point.info.bits // 4)
    for flag in point.flags:
        yield from flag_defines(flag, point, macro)
    if shares_values(point):
        yield from value_defines(next(flag for flag in point.flags if flag.width > 1), macro)


def shares_values(point: Point) -> bool:
    """Return True if several flags have the same named numbers: their macros are then named after the point."""
    wide = [flag for flag in point.flags if flag.width > 1]
    several = {tuple((entry.name, entry.raw) for entry in flag.values) for flag in wide}
    return len(wide) > 1 and len(several) == 1 and not any(flag.enum for flag in wide)


def place_defines(point: Point, fields: PointFields, scope: HeaderScope) -> Iterator[Define]:
    """Yield the macros of the place of a point."""
    macro = f"{scope.upper}_{fields.macro}"
    if not point.place.addresses:
        return
    yield f"{macro}_ADDRESS", fields.address
    if point.index is not None:
        yield f"{macro}_INDEX", unsigned(point.index)
    if point.telegram is not None:
        yield f"{macro}_TELEGRAM", f"{scope.upper}_TELEGRAM_{upper(point.telegram)}"
    if point.write_place is not None:
        yield f"{macro}_WRITE_ADDRESS", hexadecimal(min(point.write_place.addresses))


def _raw_number(point: Point, fields: PointFields, macro: str) -> Iterator[Define]:
    """Yield the macros of the contents: the number of characters or digits, or the limits of the raw number."""
    if point.text is not None and not point.text.parts:
        yield f"{macro}_{'BYTES' if point.text.is_bytes else 'CHARACTERS'}", unsigned(point.text.characters)
    elif point.digits is not None:
        yield f"{macro}_DIGITS", unsigned(point.digits.count)
    elif point.writable and not point.info.floating and point.text is None:
        yield f"{macro}_RAW_MIN", fields.low_signed
        yield f"{macro}_RAW_MAX", fields.high_signed
    if point.epoch:
        yield f"{macro}_EPOCH", signed(epoch_in_unix(point.epoch))
    if point.has_counts:
        yield f"{macro}_DECIMALS", f"{point.decimals}"
    if point.display is not None:
        yield f"{macro}_DISPLAY_DECIMALS", f"{point.display}"


def _bits(point: Point, macro: str) -> Iterator[Define]:
    """Yield the macros of a bit group's place in its word, and of the constant bits of the word."""
    if point.fixed is not None:
        digits = 4 * point.words
        yield f"{macro}_FIXED_MASK", hexadecimal(point.fixed.mask, digits)
        yield f"{macro}_FIXED_BITS", hexadecimal(point.fixed.bits, digits)
    if point.bits is not None:
        yield f"{macro}_SHIFT", f"{point.bits[1]}U"
        yield f"{macro}_MASK", hexadecimal(group_mask(point))


def _active_low(flag: Flag) -> bool:
    """Return True if the bit is 0 while its name is true."""
    return flag.width == 1 and flag.active == 0


def flag_defines(flag: Flag, point: Point, macro: str) -> list[Define]:
    """Return the macros of a flag, and of its named numbers unless they are named after the point or an enum."""
    name, ones = f"{macro}_{upper(flag.name)}", (1 << flag.width) - 1
    remark = " /* true while 0 */" if _active_low(flag) else ""  # setting the bit of OFF2 ends OFF2
    defines = [(f"{name}_MASK", hexadecimal(ones << flag.low, point.info.bits // 4) + remark)]
    if flag.width > 1:
        defines.append((f"{name}_SHIFT", f"{flag.low}U"))
        defines += [] if flag.enum or shares_values(point) else value_defines(flag, name)
    return defines


def value_defines(flag: Flag, macro: str) -> list[Define]:
    """Return the macros of a flag's named numbers; `macro` is what they begin with."""
    return [(f"{macro}_{upper(entry.name)}", f"{entry.raw}U") for entry in flag.values]


# Special codes.


FUNCTIONS = ("_is_special", "_special_name", "_is_no_value")
"""The ends of the names of their functions, after the name of the point or of the shared codes."""


def codes_first(point: Point, test: str, check: str) -> str:
    """Return a check that tests the special codes first: it accepts writable ones and refuses others.

    `test` is the function that recognises them; without codes it is empty.
    """
    if not test:
        return check
    check = f"{test}(raw) ? FIELDSCRIBE_SPECIAL : ({check})"
    writable = [code for code in point.specials if code.writable]
    return f"{bracketed(_code_test(point, writable))} ? FIELDSCRIBE_OK : ({check})" if writable else check


def code_defines(point: Point, macro: str) -> Iterator[Define]:
    """Yield the macros of all codes of a point."""
    for special in point.specials:
        yield from dict.fromkeys(special_defines(special, macro, point))


def special_defines(special: Special, macro: str, point: Point) -> tuple[Define, Define]:
    """Return the macros of the first and the last raw number of a code; for a single number twice the same macro."""
    name = f"{macro}_{upper(special.name)}"
    first, last = (_code_literal(raw, special, point) for raw in (special.low, special.high))
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


def code_set(point: Point, name: str, scope: HeaderScope) -> CodesView:
    """Return the set of codes, for the point that defines it."""
    shared = point.shared_codes
    return CodesView(
        comment=c_comment(f"Special codes of {shared}: raw numbers that are no quantity.") if shared else "",
        defines=tuple(code_defines(point, f"{scope.upper}_{upper(shared)}")) if shared else (),
        functions=tuple(_code_functions(point, name)),
    )


def _code_functions(point: Point, name: str) -> Iterator[str]:
    raw = (f"{raw_type(point)} raw",)
    is_special = _code_test(point, point.specials)
    no_value = _code_test(point, (special for special in point.specials if special.no_value))
    names = "".join(
        f"{bracketed(_code_test(point, (special,)))} ? {c_string(special.name)} : " for special in point.specials
    )
    is_no_value = (f"return {no_value};",) if no_value else ("(void)raw;", "return false;")
    yield function(f"{INLINE} bool", f"{name}_is_special", raw, f"return {is_special};").text
    yield function(f"{INLINE} bool", f"{name}_is_no_value", raw, *is_no_value).text
    yield function(f"{INLINE} const char *", f"{name}_special_name", raw, f"return {names}NULL;").text


def _code_literal(raw: int, special: Special, point: Point) -> str:
    return hexadecimal(raw, point.width + 3 >> 2) if special.hexadecimal and raw >= 0 else signed(raw)


def _code_test(point: Point, codes: Iterable[Special]) -> str:
    return is_in(point, [(code.low, code.high) for code in codes])
