"""The constants of a point: where it is, what the manual calls it, its limits and masks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.names import upper
from fieldscribe.targets.c.literals import hexadecimal, signed, unsigned
from fieldscribe.text import c_string

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Flag, Point, Special
    from fieldscribe.targets.c.scope import Scope
    from fieldscribe.targets.c.views import Define


def defines(point: Point, macro: str, scope: Scope, outer: tuple[int, int]) -> Iterator[Define]:
    """The macros of a generated point and their literals; `outer` are the outer limits of the raw number."""
    yield from place_defines(point, macro, scope)
    yield f"{macro}_WORDS", f"{point.words}U"
    yield from _raw_number(point, macro, outer)
    yield from _bits(point, macro)
    for special in point.specials:
        yield from dict.fromkeys(special_defines(special, macro))
    active_low = sum(1 << flag.low for flag in point.flags if _active_low(flag))
    if active_low:
        yield f"{macro}_ACTIVE_LOW_MASK", hexadecimal(active_low, point.info.bits // 4)
    for flag in point.flags:
        yield from _flag_defines(flag, f"{macro}_{upper(flag.name)}", point.info.bits // 4)


def place_defines(point: Point, macro: str, scope: Scope) -> Iterator[Define]:
    """The macros that say where a point is and what the manual calls it."""
    yield f"{macro}_SPACE", f"{scope.upper}_SPACE_{upper(point.space)}"
    if point.address is not None:
        yield from _places(point, macro, scope)
    if point.code is not None:
        yield f"{macro}_CODE", c_string(point.code)
    for key, number in point.references.items():
        literal = c_string(number) if isinstance(number, str) else (unsigned if number >= 0 else signed)(number)
        yield f"{macro}_{upper(key)}", literal


def special_defines(special: Special, macro: str) -> tuple[Define, Define]:
    """The macros of the first and the last raw number of a special; the same one twice for a single number."""
    name = f"{macro}_{upper(special.name)}"
    if special.low == special.high:
        return (name, signed(special.low)), (name, signed(special.low))
    return (f"{name}_FIRST", signed(special.low)), (f"{name}_LAST", signed(special.high))


def _places(point: Point, macro: str, scope: Scope) -> Iterator[Define]:
    yield f"{macro}_ADDRESS", hexadecimal(min(point.addresses))
    if point.index is not None:
        yield f"{macro}_INDEX", unsigned(point.index)
    if point.telegram is not None:
        yield f"{macro}_TELEGRAM", f"{scope.upper}_TELEGRAM_{upper(point.telegram)}"
    for place in point.places[1:]:
        if place.addresses:
            yield f"{macro}_{upper(place.purpose)}_ADDRESS", hexadecimal(min(place.addresses))


def _raw_number(point: Point, macro: str, outer: tuple[int, int]) -> Iterator[Define]:
    """What the words hold: characters, digits, or a number between limits."""
    if point.text is not None:
        yield f"{macro}_CHARACTERS", unsigned(point.text.characters)
    elif point.digits is not None:
        yield f"{macro}_DIGITS", unsigned(point.digits.count)
    elif not point.info.floating:
        yield f"{macro}_RAW_MIN", signed(outer[0])
        yield f"{macro}_RAW_MAX", signed(outer[1])
    if point.form == "scaled" and point.decimals is not None:
        yield f"{macro}_DECIMALS", f"{point.decimals}"


def _bits(point: Point, macro: str) -> Iterator[Define]:
    """Where a bit group lies in its word, and which bits of the word are constant."""
    if point.fixed is not None:
        digits = 4 * point.words
        yield f"{macro}_FIXED_MASK", hexadecimal(point.fixed.mask, digits)
        yield f"{macro}_FIXED_BITS", hexadecimal(point.fixed.bits, digits)
    if point.bits is not None:
        yield f"{macro}_SHIFT", f"{point.bits[1]}U"
        yield f"{macro}_MASK", hexadecimal(((1 << point.width) - 1) << point.bits[1])


def _active_low(flag: Flag) -> bool:
    """Whether the bit is 0 while what its name says is true."""
    return flag.width == 1 and flag.active == 0


def _flag_defines(flag: Flag, name: str, digits: int) -> list[Define]:
    remark = " /* true while 0 */" if _active_low(flag) else ""  # who sets the bit of OFF2 takes OFF2 away
    defines = [(f"{name}_MASK", hexadecimal(((1 << flag.width) - 1) << flag.low, digits) + remark)]
    if flag.width > 1:
        defines.append((f"{name}_SHIFT", f"{flag.low}U"))
        defines += [(f"{name}_{upper(entry.name)}", f"{entry.raw}U") for entry in flag.values]
    return defines
