"""The facts of a point as texts: ranges, scales, units. All outputs use the same wording.

The texts are plain; targets escape them (text.py). Another point is written as `name.raw` for its raw number, or as
`name` for its value if `points` is given and the rule uses the value. A text is empty if the point has no such fact.
"""

import re
from collections.abc import Callable, Iterable
from typing import Any

from fieldscribe.arithmetic.exact import SAME
from fieldscribe.model import Base, Device, Entry, Erratum, Flag, Point, ScaleCase, Special, Text, Titles
from fieldscribe.text import counted, line
from fieldscribe.wording.numbers import exact, fixed_rule, hex_text, number_text, rounded
from fieldscribe.wording.numbers import parts_text as parts_text
from fieldscribe.wording.rules import Points, RenamedPoints, converted, inverse_text, name_of, ranges_text
from fieldscribe.wording.rules import clause_text as clause_text
from fieldscribe.wording.rules import condition_text as condition_text

LINES_NAMED = re.compile(r"\b[Ll]ine\s+[0-9]+|\b[Ll]ines\s+[0-9]+(?:(?:,|\s+and|\s+to|\.\.)\s*[0-9]+)*")
"""Matches lines of a manual in a sentence: `the replies at lines 246 and 297`."""
_ACCESS = {"r": "read only", "w": "write only", "rw": "read and write", "none": "not reachable over the bus"}


def label(point: Point) -> str:
    """Return the code and name of a point, as messages name it."""
    return f"{line(point.code)} {point.item}" if point.code else point.item


def address_text(address: int) -> str:
    """Return a wire address in both notations: `1028h (4136)`."""
    return f"{hex_text(address)} ({address})"


def base_text(base: Base) -> str:
    """Return the base of addresses: `slot * 1000`, `block 103 of models`, `block 705 of models + points * 2`."""
    if base.block is None:
        return line(base.formula)
    chain, _, after = line(base.formula).partition(f" {base.block}")
    return f"block {base.block} of {chain}{after}"


def words_text(point: Point) -> str:
    """Return all words of a point, and the one with the high part: `1013h (4115) high, 1014h (4116) low`."""
    return _words_of(point, point.addresses)


def bits_in_message(point: Point) -> str:
    """Return the bits of a signal, as CAN databases count: `12 bits from bit 3 on, low byte first`."""
    several = "" if point.width == 1 else f", {'low' if point.place.low_first else 'high'} byte first"
    what = "bit" if point.width == 1 else f"{point.width} bits from bit"
    return f"{what} {point.place.bit}{' on' if several else ''}{several}"


def write_place_text(point: Point) -> str:
    """Return where else the point is written, with the manual's numbers: `2028h (8232), modicon 8233`."""
    if point.write_place is None:
        return ""
    printed = (f"{name} {number}" for name, number in point.write_place.references.items())
    return ", ".join((_words_of(point, point.write_place.addresses), *printed))


def _words_of(point: Point, addresses: tuple[int, ...]) -> str:
    if len(addresses) < 2:
        return address_text(addresses[0]) if addresses else ""
    if point.untyped is not None:
        return f"{address_text(addresses[0])} to {address_text(addresses[-1])}"
    if len(addresses) == 2:
        return f"{address_text(addresses[0])} high, {address_text(addresses[1])} low"
    if point.text is not None:
        return f"{address_text(addresses[0])} to {address_text(addresses[-1])} (first {_parts(point.text)} first)"
    return ", ".join(map(address_text, addresses)) + " (high part first)"


def order_text(point: Point) -> str:
    """Return the order of several words: `low word first`; empty for a single word, or if the order is open."""
    first, *others = point.addresses or (0,)
    if not others or point.untyped is not None:
        return ""
    what = "word" if point.text is None else _parts(point.text)
    rising = all(address == first + number for number, address in enumerate(others, 1))
    falling = all(address == first - number for number, address in enumerate(others, 1))
    if rising or falling:
        names = ("first", "last") if point.text is not None else ("high", "low")
        return f"{names[falling]} {what} first"
    words = " ".join(map(hex_text, point.addresses))
    return f"{words}, {'first' if point.text is not None else 'high'} {what} first"


def _parts(layout: Text) -> str:
    return "words" if layout.parts else "bytes" if layout.is_bytes else "characters"


def with_unit(text: str, point: Point) -> str:
    """Return the text followed by the point's unit."""
    return f"{text} {point.unit.symbol}" if text and point.unit.symbol else text


def title_text(titles: Titles) -> str:
    """Return a title in all its languages, English first: `Base frequency / Basisfrequenz`."""
    if len(titles) == 1:
        return titles["en"]
    return " / ".join(dict.fromkeys([titles["en"], *titles.values()]))


def type_text(point: Point) -> str:
    """Return the wire type, with the bits of a bit group: `u8, bits 15..14`."""
    if point.untyped is not None:
        return point.untyped or "not settled by the manual"
    if point.text is not None:
        return f"{'' if point.text.is_bytes or point.text.parts else 'text, '}{characters_text(point.text)}"
    if point.place.bit is not None:
        return f"{point.shape.wire_type[0]}{point.width}"
    if point.digits is not None:
        return f"{point.type}, {point.digits.count} decimal digits"
    return point.shape.wire_type if point.bits is None else f"{point.type}, {_bits_text(*point.bits)}"


def characters_text(layout: Text) -> str:
    """Return the contents of a text: `16 characters, ascii`, with their layout if it is not the usual one."""
    if layout.parts:
        return f"{layout.encoding}, {counted(layout.words, 'word')}{', low byte first' * layout.low_first}"
    usual_what = "byte" if layout.is_bytes else "character"
    what = {"utf-8": "byte", "utf-16": "word"}.get(layout.encoding, usual_what)
    usual, single = (
        layout.per_word > 1 or what == "word",
        "one in the high byte" if layout.low_first else "one in the low byte",
    )
    order = ("low byte first" if layout.low_first else "") if usual else f"{single} of each word"
    fill = "" if layout.padding else "filled with 00h"
    return ", ".join(filter(None, (counted(layout.characters, what), layout.encoding, order, fill)))


def _bits_text(high: int, low: int) -> str:
    return f"bit {low}" if high == low else f"bits {high}..{low}"


def fixed_text(point: Point) -> str:
    """Return the bits of the word that are always written as a constant: `bit 10 always 1, bits 7..3 always 00000`."""
    if point.fixed is None:
        return ""
    width = point.fixed.mask.bit_length()
    bits = f"{point.fixed.bits:0{width}b}"
    runs = re.finditer("1+", f"{point.fixed.mask:b}")
    return ", ".join(
        f"{_bits_text(width - 1 - run.start(), width - run.end())} always {bits[run.start() : run.end()]}"
        for run in runs
    )


def shares_word(point: Point) -> bool:
    """Return True if writing the point needs the rest of its word; a telegram sends all words anyway."""
    return point.bits is not None and point.writable and point.telegram is None


def shared_text(point: Point) -> str:
    """Return how such a point is written: `shares its word: read it, change bits 11..8, write it back`."""
    if point.bits is None or not shares_word(point):
        return ""
    bits = _bits_text(*point.bits)
    if not point.readable:
        be = "is" if point.width == 1 else "are"
        return f"shares its word, which cannot be read: {bits} {be} written together with all others"
    return f"shares its word: read it, change {bits}, write it back"


def access_text(access: str) -> str:
    """Return what a master may do with a point."""
    return _ACCESS.get(access, access)


def display_text(point: Point) -> str:
    """Return the number of decimals that instruments show: `shown with 2 decimals`."""
    return f"shown with {decimals_text(point)}" if point.display is not None else ""


def decimals_text(point: Point) -> str:
    """Return the number of these decimals: `2 decimals`."""
    if point.display is None:
        return ""
    return f"{point.display or 'no'} decimal{'' if point.display == 1 else 's'}"


def epoch_text(point: Point) -> str:
    """Return the date from which a time counts: `seconds since 1970-01-01`; empty for anything else."""
    return f"seconds since {point.epoch}" if point.epoch else ""


def meaning_text(point: Point, raw: int) -> str:
    """Return the special code, the entry, or the value and unit of a raw number.

    It is empty if the number is the value or a bit pattern, or if its value depends on other points.
    """
    special = point.special(raw)
    if special is not None:
        return special.name
    if point.enum is not None:
        return next((entry.name for entry in point.enum.entries if entry.raw == raw), "")
    itself = point.scale is None and not point.unit.symbol and not point.display
    rule = None if itself or point.info.floating else fixed_rule(point)
    if rule is None:
        return ""
    if point.display is None:
        return with_unit(converted(raw, rule), point)
    return with_unit(rounded(raw * rule.factor + rule.add, rule.divisor, point.display), point)


def resolution_text(point: Point) -> str:
    """Return one raw step in the unit: `0.1 Hz`; with coarser steps: `0.01 s, from 100 s on 0.1 s`."""
    rule = fixed_rule(point)
    stepped = point.form == "scaled" or (point.form == "integer" and (point.unit.symbol or point.steps))
    if rule is None or not stepped:
        return ""
    steps = point.steps or ((0, 1),)
    parts = [with_unit(exact(abs(steps[0][1] * rule.factor), rule.divisor), point)]
    for start, step in steps[1:]:
        coarser = with_unit(exact(abs(step * rule.factor), rule.divisor), point)
        parts.append(f"from {with_unit(converted(start, rule), point)} on {coarser}")
    return ", ".join(parts)


def count_text(point: Point) -> str:
    """Return the unit of one count: `0.01 Hz`; empty if the point has no counts."""
    if not point.has_counts:
        return ""
    return with_unit(exact(1, 10 ** (point.decimals or 0)), point)


def write_texts(point: Point) -> tuple[str, ...]:
    """Return facts about writing a point: sentences without a full stop."""
    effect = () if point.takes_effect is None else (f"a written value takes effect {point.takes_effect}",)
    together = (f"write it in one request with {', '.join(point.write_with)}",) if point.write_with else ()
    return effect + together


def width_texts(point: Point) -> tuple[str, ...]:
    """Return what a scaled point lacks because its numbers are too wide, as sentences without a full stop."""
    if point.form != "scaled" or not point.generated:
        return ()
    counts = ("no integer path: its counts need more than 64 bits",) if point.decimals is None else ()
    values = () if point.encodes_values else ("values are only decoded: its numbers have more than 53 bits",)
    return counts + values


def overflow_texts(point: Point) -> tuple[str, ...]:
    """Return the numbers within its type, or that of a factor, with which a scaled point overflows."""
    texts = [f"overflows beyond raw {point.most_raw} in size"] if point.most_raw is not None else []
    cases = point.scale if point.scale_arguments else None
    factors = [factor for case in cases or () for factor in case.rule.factors]
    ranges = {factor.point: factor.within for factor in factors if factor.within is not None and not factor.ten_to}
    texts += [f"overflows while {name} is outside {low}..{high}" for name, (low, high) in ranges.items()]
    return tuple(texts) if point.generated else ()


def steps_text(point: Point) -> str:
    """Return the raw steps that the device keeps: `raw 1, from raw 10000 on 10`."""
    if not point.steps:
        return ""
    return f"raw {point.steps[0][1]}" + "".join(f", from raw {start} on {step}" for start, step in point.steps[1:])


def scale_text(point: Point, points: Points | None = None) -> str:
    """Return how the value follows from raw: `raw x 0.1 Hz`; empty if it is the raw number or a bit pattern."""
    if point.scale is None:
        plain = point.form == "integer" and point.unit.symbol and point.generated
        return f"raw x 1 {point.unit.symbol}" if plain else ""
    if len(point.scale) == 1 and point.scale[0].point is None:
        return with_unit(inverse_text(point.scale[0].rule, points), point)
    return "; ".join(
        with_unit(inverse_text(case.rule, points), point) + f" when {case.point}.raw is {case.raw}"
        for case in point.scale
    )


def formula_text(point: Point, points: Points | None = None) -> str:
    """Return the scale as the manual writes it: `value = raw * 0.1`; empty if the raw number is the value."""
    return "; ".join(_case_text(case, points) for case in point.scale or ())


def _case_text(case: ScaleCase, points: Points | None) -> str:
    formula = case.written or f"value = {inverse_text(case.rule, points)}"
    return formula if case.point is None else f"{formula} when {name_of(case.point, points)}.raw is {case.raw}"


def range_text(point: Point, points: Points | None = None, *, unit: bool = True) -> str:
    """Return which values may be written, in the unit: `0..400 Hz`; empty if only raw numbers are known."""
    if _is_unbounded(point) or point.patterns:
        return ""
    if point.info.floating or point.allowed.units:
        ends = [f"{number_text(low)}..{number_text(high)}" for low, high in point.allowed.units]
        text = " or ".join(ends) or f"any number{' in' * bool(unit and point.unit.symbol)}"
        return with_unit(text, point) if unit else text
    rule = None if point.form in ("text", "digits") else fixed_rule(point)
    return "" if rule is None else ranges_text(point, rule, points, point.unit.symbol if unit else "")


def raw_range_text(point: Point, points: RenamedPoints | None = None) -> str:
    """Return which raw numbers may be written: `0..4000`; empty if the limits are values, as for f32 and f64."""
    nothing = point.info.floating or point.allowed.units or point.text is not None or point.patterns
    return "" if nothing or _is_unbounded(point) else ranges_text(point, SAME, points, "")


def _is_unbounded(point: Point) -> bool:
    """Return True if the numbers have no limit: the point has no type, and the manual prints no range."""
    return point.untyped is not None and point.allowed.fixed == ((point.least, point.greatest),)


def outer_raw(point: Point) -> tuple[int, int] | None:
    """Return the least and the greatest raw number that can ever be allowed."""
    return None if _is_unbounded(point) else point.allowed.outer


def entry_text(entry: Entry, *, patterns: bool = False) -> str:
    """Return one named number: `0 = keypad (Keypad / Bedienfeld)`."""
    return f"{entry_number(entry, patterns=patterns)} = {entry_meaning(entry)}"


def entry_number(entry: Entry, *, patterns: bool) -> str:
    """Return the raw number of an entry; for a floating-point pattern, also its number: `2.5 (40200000h)`."""
    return f"{entry.quantity} ({entry.raw:X}h)" if patterns else str(entry.raw)


def entry_meaning(entry: Entry) -> str:
    """Return the meaning of a named number: `keypad (Keypad / Bedienfeld)`."""
    title = title_text(entry.title)
    quantity = f", {entry.quantity}" if entry.quantity and entry.quantity not in title else ""
    return f"{entry.name} ({title}{quantity})"


def special_text(special: Special, width: int) -> str:
    """Return a special code of a point of `width` bits: `7FFFh = no_sensor (No sensor), no value`."""
    return f"{special_numbers(special, width)} = {special_meaning(special)}"


def special_meaning(special: Special) -> str:
    """Return the meaning of a special code: `no_sensor (No sensor), no value`."""
    remarks = special_remarks(special)
    return f"{special.name} ({title_text(special.title)})" + (f", {remarks}" if remarks else "")


def codes_text(point: Point, mark: str = "") -> str:
    """Return the codes of a point: `Special codes: 0 inactive (may be written), FFFCh fault`; `mark` quotes both."""
    named = []
    for special in point.specials:
        written = " (may be written)" if special.writable and point.writable else ""
        named.append(f"{mark}{special_numbers(special, point.width)}{mark} {mark}{special.name}{mark}{written}")
    return f"Special code{'s' if len(named) > 1 else ''}: {', '.join(named)}" if named else ""


def special_remarks(special: Special) -> str:
    """Return remarks on a special code: `no value, may be written`."""
    remarks = (("no value", special.no_value), ("may be written", special.writable))
    return ", ".join(text for text, holds in remarks if holds)


def special_numbers(special: Special, width: int) -> str:
    """Return a special code, or a band of them, as the manual writes it: `FFFCh`, `4100..4103`."""
    low, high = (code_text(end, width, hexadecimal=special.hexadecimal) for end in (special.low, special.high))
    return low if special.low == special.high else f"{low}..{high}"


def code_text(raw: int, width: int, *, hexadecimal: bool) -> str:
    """Return a raw number of `width` bits in decimal, or its bit pattern in hexadecimal."""
    return hex_text(raw & (1 << width) - 1, width + 3 >> 2) if hexadecimal else str(raw)


def default_text(point: Point, *, unit: bool = True) -> str:
    """Return the factory setting with its unit, or the name of its special code."""
    raw = point.default_raw
    special = None if raw is None else point.special(raw)
    if special is not None:
        return special.name
    if point.default is None:
        return "" if raw is None else f"raw {raw}"
    number = number_text(point.default)
    return with_unit(number, point) if unit else number


def default_parts(point: Point) -> str:
    """Return the factory setting of a word that consists of numbers: `source 52, bit 0`."""
    raw = point.default_raw
    if raw is None or not point.flags or any(flag.width == 1 for flag in point.flags):
        return ""
    flags = sorted(point.flags, key=lambda flag: -flag.low)
    return ", ".join(f"{flag.name} {raw >> flag.low & (1 << flag.width) - 1}" for flag in flags)


def flag_bits(flag: Flag, point: Point | None = None) -> str:
    """Return the bits of a flag: `3`, or `5..4`; with the point, as numbered in the whole word."""
    low = flag.low + (point.bits[1] if point is not None and point.bits else 0)
    return str(low) if flag.width == 1 else f"{low + flag.width - 1}..{low}"


def flag_meaning(flag: Flag) -> str:
    """Return the meaning of a flag: `fault (Fault), true when 0`, or `mode (Mode): 0 = stop (Stop)`."""
    inverted = ", true when 0" if flag.width == 1 and flag.active == 0 else ""
    values = ": " + ", ".join(map(flag_value_text, flag.values)) if flag.values else ""
    return f"{flag.name} ({title_text(flag.title)}){inverted}{values}"


def flag_value_text(entry: Entry) -> str:
    """Return the meaning of a flag's number: `0 = not ready`, or `0 = stop (Stop)` if it has a name."""
    return f"{entry.raw} = {title_text(entry.title)}" if entry.name in ("zero", "one") else entry_text(entry)


def keeps_text(device: Device, point: Point) -> str:
    """Return whether a written value survives power-off, and how."""
    if point.keeps is None:
        return ""
    if point.keeps == "choice":
        return "by the task that writes it: RAM alone, or EEPROM too"
    if point.keeps in ("no", "yes"):
        return "no, lost when switched off" if point.keeps == "no" else "yes, each write wears the memory"
    command = next((command for command in device.commands if command.name == point.keeps), None)
    if command is None:
        return f"by {point.keeps}"
    value = "any value" if command.value is None else str(command.value)
    where = f"{command.space} {address_text(command.address)} with function {hex_text(command.function, 2)}"
    wears = f"; the memory is rated for {command.wears} writes" if command.wears else ""
    return f"only after the command {command.name} (write {value} to {where}){wears}"


def open_texts(errata: Iterable[Erratum], quoted: Callable[[str], str] = line) -> list[str]:
    """Return what errata leave open, each with the id of its erratum."""
    return [f"{quoted(text)} ({quoted(erratum.id)})" for erratum in errata for _, text in erratum.leaves_open]


def open_text(errata: Iterable[Erratum], quoted: Callable[[str], str] = line) -> str:
    """Return what the errata of a point leave open, as the rest of a sentence after `the` or `The`."""
    return f"manual leaves open {', '.join(open_texts(errata, quoted))}"


def without_lines(text: Any) -> Any:
    """Return a text, or texts by language, without line numbers."""
    if isinstance(text, dict):
        return {language: without_lines(words) for language, words in text.items()}
    return LINES_NAMED.sub("lines", text) if isinstance(text, str) else text
