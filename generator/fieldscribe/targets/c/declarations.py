"""The part before the functions of a point: its comment, and the macros of its place, its limits and its masks."""

from collections.abc import Iterator

from fieldscribe import wording
from fieldscribe.arithmetic.texts import epoch_in_unix
from fieldscribe.arithmetic.words import group_mask
from fieldscribe.model import Flag, Point
from fieldscribe.targets.c.layout import WIDTH, filled, folded
from fieldscribe.targets.c.scope import HeaderScope, hexadecimal, signed, unsigned
from fieldscribe.targets.c.special_codes import code_defines
from fieldscribe.targets.c.views import Define, PointFields
from fieldscribe.text import c_comment, upper


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
