"""The macros of a point: its place, its limits and its masks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask
from fieldscribe.names import upper
from fieldscribe.targets.c.literals import hexadecimal, unsigned
from fieldscribe.targets.c.special_codes import code_defines

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Flag, Point
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import Define
    from fieldscribe.targets.c.words import Words


def defines(point: Point, words: Words, scope: HeaderScope) -> Iterator[Define]:
    """The macros of a generated point and their literals."""
    macro = f"{scope.upper}_{words.macro}"
    yield from place_defines(point, words, scope)
    if point.words > 1 or point.text is not None:
        yield f"{macro}_WORDS", f"{point.words}U"
    yield from _raw_number(point, words, macro)
    yield from _bits(point, macro)
    if not point.shared_codes:
        yield from code_defines(point, macro)
    active_low = sum(1 << flag.low for flag in point.flags if _active_low(flag))
    if active_low:
        yield f"{macro}_ACTIVE_LOW_MASK", hexadecimal(active_low, point.info.bits // 4)
    for flag in point.flags:
        yield from flag_defines(flag, point, macro)
    if shares_values(point):
        wide = next(flag for flag in point.flags if flag.width > 1)
        yield from ((f"{macro}_{upper(entry.name)}", f"{entry.raw}U") for entry in wide.values)


def shares_values(point: Point) -> bool:
    """Whether several flags have the same named numbers: their macros are then named after the point."""
    wide = [tuple((entry.name, entry.raw) for entry in flag.values) for flag in point.flags if flag.width > 1]
    return len(wide) > 1 and len(set(wide)) == 1


def place_defines(point: Point, words: Words, scope: HeaderScope) -> Iterator[Define]:
    """The macros that say where a point is."""
    macro = f"{scope.upper}_{words.macro}"
    if not point.addresses:
        return
    yield f"{macro}_ADDRESS", words.address
    if point.index is not None:
        yield f"{macro}_INDEX", unsigned(point.index)
    if point.telegram is not None:
        yield f"{macro}_TELEGRAM", f"{scope.upper}_TELEGRAM_{upper(point.telegram)}"
    if point.write_place is not None:
        yield f"{macro}_WRITE_ADDRESS", hexadecimal(min(point.write_place.addresses))


def _raw_number(point: Point, words: Words, macro: str) -> Iterator[Define]:
    """The macros of the contents: the number of characters or digits, or the limits of the raw number."""
    if point.text is not None:
        yield f"{macro}_CHARACTERS", unsigned(point.text.characters)
    elif point.digits is not None:
        yield f"{macro}_DIGITS", unsigned(point.digits.count)
    elif point.writable and not point.info.floating:
        yield f"{macro}_RAW_MIN", words.low_signed
        yield f"{macro}_RAW_MAX", words.high_signed
    if point.form == "scaled" and point.decimals is not None:
        yield f"{macro}_DECIMALS", f"{point.decimals}"
    if point.display is not None:
        yield f"{macro}_DISPLAY_DECIMALS", f"{point.display}"


def _bits(point: Point, macro: str) -> Iterator[Define]:
    """The macros of a bit group's place in its word, and of the constant bits of the word."""
    if point.fixed is not None:
        digits = 4 * point.words
        yield f"{macro}_FIXED_MASK", hexadecimal(point.fixed.mask, digits)
        yield f"{macro}_FIXED_BITS", hexadecimal(point.fixed.bits, digits)
    if point.bits is not None:
        yield f"{macro}_SHIFT", f"{point.bits[1]}U"
        yield f"{macro}_MASK", hexadecimal(group_mask(point))


def _active_low(flag: Flag) -> bool:
    """Whether the bit is 0 while its name is true."""
    return flag.width == 1 and flag.active == 0


def flag_defines(flag: Flag, point: Point, macro: str) -> list[Define]:
    """The macros of a flag, and of its named numbers unless they are named after the point."""
    name, ones = f"{macro}_{upper(flag.name)}", (1 << flag.width) - 1
    remark = " /* true while 0 */" if _active_low(flag) else ""  # setting the bit of OFF2 ends OFF2
    defines = [(f"{name}_MASK", hexadecimal(ones << flag.low, point.info.bits // 4) + remark)]
    if flag.width > 1:
        defines.append((f"{name}_SHIFT", f"{flag.low}U"))
        values = () if shares_values(point) else flag.values
        defines += [(f"{name}_{upper(entry.name)}", f"{entry.raw}U") for entry in values]
    return defines
