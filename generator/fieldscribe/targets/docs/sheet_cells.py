"""The cells of the sheet: a function for each group of neighbouring columns returns those of a point.

`sheet` lists the columns, and says which function fills which. `command_cells` returns the row of a command.
"""

from collections.abc import Iterator, Mapping
from functools import cache

from fieldscribe import wording
from fieldscribe.arithmetic.exact import SAME, Line
from fieldscribe.families import family
from fieldscribe.model import Command, Point
from fieldscribe.targets.docs.cells import DocsScope, Remarks
from fieldscribe.targets.docs.tables import Encode, decimal, original, source_cells
from fieldscribe.wording.numbers import exact, fixed_rule, hex_text, number_text

_KEEPS = {None: "", "no": "no", "yes": "yes", "choice": "by the task"}
_NO_REMARKS = ("special_of", "note", "reserved")
"""Facts in other columns: `special_of` in `codes`, `reserved` as part of the reason."""


class Sheet:
    """The state that the cells of all points of a device need."""

    def __init__(self, scope: DocsScope, encode: Encode) -> None:
        self.scope, self.encode, self.numbers_at = scope, encode, family(scope.device.family).numbers
        further = {
            "type": lambda point: wording.type_text(point) if point.form in ("text", "digits") else "",
            "untyped": lambda point: f"type: {point.untyped}" if point.untyped else "",
            "default": _default_numbers,
            "default_value": _default_fraction,
        }
        self._remarks = Remarks(scope.context, str, further, _NO_REMARKS, in_columns=True)
        self._encode_remarks = cache(encode)

    def remarks(self, point: Point) -> str:
        """Return the remarks of a point; many points have the same."""
        return self._encode_remarks(self._remarks.of(point))


def address_cells(point: Point, sheet: Sheet) -> tuple[str, str, str, str]:
    """Return the lowest address in both notations, the number of words, and their order."""
    addresses, words = point.place.addresses, str(point.words)
    if not addresses:
        return "", "", words, ""
    if point.place.bit is not None:
        return "", "", words, ""
    lowest = min(addresses)
    order = sheet.encode(wording.order_text(point)) if len(addresses) > 1 else ""
    return str(lowest), hex_text(lowest), words, order


def bit_cells(point: Point, _: Sheet) -> tuple[str, ...]:
    """Return the bits of a bit group, `yes` if it shares the word, its mask, and the fixed bits."""
    fixed = ("", "") if point.fixed is None else (str(point.fixed.mask), str(point.fixed.bits))
    if point.bits is None:
        return "", "", "", "", *fixed
    high, low = point.bits
    return str(low), str(high), "yes" if wording.shares_word(point) else "", str((2 << high) - (1 << low)), *fixed


def reference_cells(point: Point, sheet: Sheet) -> tuple[str, str, str, str]:
    """Return the two numberings of Modicon, which of them are computed, and all other numberings as one text."""
    place = point.place
    others, known = [], {"modicon": "", "reference": ""}
    for name, number in place.references.items():
        if name in known and isinstance(number, int):
            known[name] = str(number)
        else:
            others.append(f"{name} {number}")
    counts = bool(place.addresses) and point.base is None  # from a base, the number is in no frame
    numbers = sheet.numbers_at(point.space, min(place.addresses)) if counts else {}
    computed = {name: str(number) for name, number in numbers.items() if name not in place.references}
    known |= computed
    return known["modicon"], known["reference"], " ".join(computed), sheet.encode(", ".join(others))


def scale_cells(point: Point, sheet: Sheet) -> tuple[str, str, str]:
    """Return factor and offset, or the rule as text if it is not linear with decimal numbers."""
    line = _line_of(point)
    if line is not None:
        factor, offset = exact(line.factor, line.divisor), exact(line.add, line.divisor)
        if "/" not in factor + offset:
            return factor, offset, ""
    return "", "", sheet.encode(wording.scale_text(point, sheet.scope.by_name) if point.scale is not None else "")


def _line_of(point: Point) -> Line | None:
    """Return the rule from raw numbers to values; None if they are not quantities or need other points."""
    if point.form not in ("scaled", "integer", "float"):
        return None
    if point.scale is not None:
        return fixed_rule(point)
    return SAME if point.generated or point.reserved else None


def limit_cells(point: Point, sheet: Sheet) -> tuple[str, ...]:
    """Return the least and the greatest raw number and value, and the rest of the rule as text."""
    ends = _ends_of(point)
    return *ends, sheet.encode(_range_of(point, ends[2:], sheet.scope.by_name))


def _ends_of(point: Point) -> tuple[str, str, str, str]:
    """Return the least and the greatest raw number and value; empty texts if there is none."""
    units = point.allowed.units
    if point.info.floating or units:
        return "", "", *((decimal(number_text(units[0][0])), decimal(number_text(units[-1][1]))) if units else ("", ""))
    outer, line = _without_codes(point, wording.outer_raw(point)), _line_of(point)
    if outer is None or point.text is not None:
        return "", "", "", ""
    if line is None:
        return str(outer[0]), str(outer[1]), "", ""
    low, high = (exact(raw * line.factor + line.add, line.divisor) for raw in (outer[:: -1 if line.factor < 0 else 1]))
    return str(outer[0]), str(outer[1]), decimal(low), decimal(high)


def _without_codes(point: Point, ends: tuple[int, int] | None) -> tuple[int, int] | None:
    """Return the ends without special codes; None if nothing is left."""
    if ends is None or not point.specials:
        return ends
    low, high = ends
    while low <= high and (code := point.special(low)) is not None:
        low = code.high + 1
    while low <= high and (code := point.special(high)) is not None:
        high = code.low - 1
    return (low, high) if low <= high else None


def _range_of(point: Point, ends: tuple[str, str], points: Mapping[str, Point]) -> str:
    """Return the limits as text if least and greatest value do not say everything: other points, gaps, fractions."""
    allowed, line = point.allowed, _line_of(point)
    parts = allowed.units or allowed.intervals
    unsaid = line is not None and bool(parts) and "" in ends
    if len(parts) <= 1 and not allowed.moves and not unsaid:
        return ""
    text = wording.range_text(point, points) if line is not None or allowed.units else ""
    raw = "" if text else wording.raw_range_text(point)
    return f"only {text}" if text else f"only raw {raw}" if raw else ""


def default_cells(point: Point, _: Sheet) -> tuple[str]:
    """Return the factory setting as a value; empty if it is a special code."""
    raw = point.default_raw
    if point.default is None or (raw is not None and point.special(raw) is not None):
        return ("",)
    return (decimal(number_text(point.default)),)


def _default_numbers(point: Point) -> str:
    """Return the default of a word that is made of numbers."""
    parts = wording.default_parts(point)
    return parts and f"default: {parts}"


def _default_fraction(point: Point) -> str:
    """Return a default that is not a decimal and so has no column."""
    is_fraction = point.default is not None and point.default_raw is None and not decimal(number_text(point.default))
    return f"default {wording.default_text(point)}" if is_fraction else ""


def enum_cells(point: Point, sheet: Sheet) -> tuple[str]:
    """Return the name of the enum."""
    enum = point.named_numbers
    return ("" if enum is None else sheet.encode(enum.name),)


def keeps_cells(point: Point, sheet: Sheet) -> tuple[str]:
    """Return whether a written value survives switching off."""
    return (_KEEPS[point.keeps] if point.keeps in _KEEPS else sheet.encode(f"after {point.keeps}"),)


def command_cells(command: Command, sheet: Sheet) -> Mapping[str, str]:
    """Return the cells of a command's row by column."""
    encode, numbers = sheet.encode, sheet.numbers_at(command.space, command.address)
    value = "" if command.value is None else str(command.value)
    is_bit = family(sheet.scope.device.family).spaces[command.space] == "bit"
    return {
        "name": encode(command.name),
        "kind": "command",
        "title": encode(command.title["en"]),
        "title_original": encode(original(command.title)),
        "space": encode(command.space),
        "address": str(command.address),
        "address_hex": hex_text(command.address),
        "words": "1",
        **{name: str(number) for name, number in numbers.items()},
        "computed": " ".join(numbers),
        "type": "bit" if is_bit else "u16",
        "encoding": "bit" if is_bit else "integer",
        "access": "w",
        "raw_min": value,
        "raw_max": value,
        "remarks": encode("; ".join(_command_remarks(command))),
        "note": encode(wording.title_text(command.note)) if command.note else "",
        **dict(zip(("document", "section", "page", "line"), source_cells(command.source, encode), strict=True)),
        "generated": "yes",
    }


def _command_remarks(command: Command) -> Iterator[str]:
    yield f"{wanted_text(command)} with function {hex_text(command.function, 2)}"
    if command.wears is not None:
        yield f"the memory is rated for {command.wears} writes"
    if command.busy:
        yield f"busy while {command.busy}"


def wanted_text(command: Command) -> str:
    """Return the number that the command writes: `write 1150`."""
    return f"write {'any number' if command.value is None else command.value}"
