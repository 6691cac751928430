"""Functions between raw numbers and the words on the wire, and those of texts and of digits in one word."""

from collections.abc import Iterator

from fieldscribe.arithmetic.words import group_mask, mask_of
from fieldscribe.model import Point, Text
from fieldscribe.targets.c.limits import digits_arguments
from fieldscribe.targets.c.scope import HeaderScope
from fieldscribe.targets.c.syntax import INLINE, STATUS, Function, function, hexadecimal, raw_type
from fieldscribe.text import upper


def text_functions(point: Point, name: str) -> Iterator[Function]:
    """Yield the conversions of a text."""
    assert point.text is not None
    layout, words = point.text, f"uint16_t words[{point.words}]"
    if layout.is_unicode:
        yield from _unicode_functions(point, layout, name, words)
        return
    if layout.parts:
        yield from _date_functions(point, layout, name, words)
        return
    if layout.is_bytes:
        yield from _bytes_functions(point, layout, name, words)
        return
    latin = "true" if layout.encoding == "latin-1" else "false"
    start, count = "fieldscribe", f"{point.words}U"
    if not layout.is_plain:
        low_first = "true" if layout.low_first else "false"
        start, count = "fieldscribe_packed", f"{layout.characters}U, {layout.per_word}U, {low_first}, {layout.padding}U"
    if point.writable:
        body = f"return {start}_words_of_text(text, length, {latin}, words, {count});"
        yield function(STATUS, f"{name}_encode", ("const char *text", "size_t length", words), body)
    if point.readable:
        body = f"return {start}_text_of_words(words, {count}, text);"
        parameters = (f"const {words}", f"char text[{point.text.characters + 1}]")
        yield function(f"{INLINE} size_t", f"{name}_decode", parameters, body)


def _bytes_functions(point: Point, layout: Text, name: str, words: str) -> Iterator[Function]:
    """Yield the conversions of bytes, which cannot fail."""
    form = f"{layout.characters}U, {layout.per_word}U, {'true' if layout.low_first else 'false'}"
    held = f"uint8_t bytes[{layout.characters}]"
    if point.writable:
        body = f"fieldscribe_words_of_bytes(bytes, {form}, words);"
        yield function(f"{INLINE} void", f"{name}_encode", (f"const {held}", words), body)
    if point.readable:
        body = f"fieldscribe_bytes_of_words(words, {form}, bytes);"
        yield function(f"{INLINE} void", f"{name}_decode", (f"const {words}", held), body)


def _date_functions(point: Point, layout: Text, name: str, words: str) -> Iterator[Function]:
    """Yield the conversions of a date and time."""
    facts = f"{len(layout.parts)}U, {'true' if layout.bcd else 'false'}, {'true' if layout.low_first else 'false'}"
    form = f"const fieldscribe_date_form form = {{{name}_parts, {facts}}};"
    if point.writable:
        body = f"return fieldscribe_words_of_date(time, &form, words, {point.words}U);"
        yield function(STATUS, f"{name}_encode", ("const fieldscribe_date_time *time", words), form, body)
    if point.readable:
        body = "return fieldscribe_date_of_words(words, &form, time);"
        yield function(STATUS, f"{name}_decode", (f"const {words}", "fieldscribe_date_time *time"), form, body)


def date_rows(layout: Text) -> Iterator[str]:
    """Yield the parts of a date and time as rows of a table."""
    for part in layout.parts:
        mask = hexadecimal(mask_of(part.width))
        yield f"{{FIELDSCRIBE_DATE_{upper(part.name)}, {part.word}U, {part.bits[1]}U, {mask}, {part.base}U}}"


def _unicode_functions(point: Point, layout: Text, name: str, words: str) -> Iterator[Function]:
    """Yield the conversions of a text of UTF-8 or UTF-16, which is UTF-8 in code."""
    wide, low_first = layout.encoding == "utf-16", "true" if layout.low_first else "false"
    form = f"{layout.characters}U, {'' if wide else f'{layout.per_word}U, '}{low_first}, {layout.padding}U"
    core = layout.encoding.replace("-", "")
    if point.writable:
        body = f"return fieldscribe_words_of_{core}(text, length, words, {form});"
        yield function(STATUS, f"{name}_encode", ("const char *text", "size_t length", words), body)
    if point.readable:
        body = f"return fieldscribe_{core}_of_words(words, {form}, text, length);"
        parameters = (f"const {words}", f"char text[{layout.most_bytes + 1}]", "size_t *length")
        yield function(STATUS, f"{name}_decode", parameters, body)


def digits_functions(point: Point, name: str, special: str, scope: HeaderScope) -> Iterator[Function]:
    """Yield the conversions of digits; `special` is the function that recognises special codes, empty without codes."""
    assert point.digits is not None
    count, known = point.digits.count, digits_arguments(point, scope)
    digits = f"uint16_t digits[{count}]"
    if point.writable:
        whole = f"const fieldscribe_whole whole = fieldscribe_number_of_digits(digits, {known});"
        status = "whole.status"
        if special:
            refused = f"{special}((uint16_t)whole.number) ? FIELDSCRIBE_SPECIAL : FIELDSCRIBE_OK"
            status = f"fieldscribe_both(whole.status, {refused})"
        store = f"return fieldscribe_keep_u16({status}, (uint16_t)whole.number, raw);"
        yield function(STATUS, f"{name}_encode", (f"const {digits}", "uint16_t *raw"), whole, store)
    if point.readable and not special:
        body = f"fieldscribe_digits_of(raw, digits, {count}U);"
        yield function(f"{INLINE} void", f"{name}_decode", ("uint16_t raw", digits), body)
    elif point.readable:
        body = f"return fieldscribe_quantity_digits({special}(raw), raw, digits, {count}U);"
        yield function(STATUS, f"{name}_decode", ("uint16_t raw", digits), body)


def has_words(point: Point) -> bool:
    """Return True if the point has word functions: not a text, a bit group or a word that equals the raw number."""
    info = point.info
    plain = info.bits == 1 or (info.bits <= 16 and not info.signed)
    return point.text is None and point.bits is None and (not plain or has_form(point))


def has_form(point: Point) -> bool:
    """Return True if the low byte of each word comes first, or the number has a special coding."""
    return point.swapped or bool(point.coding)


def words_functions(point: Point, name: str) -> Iterator[Function]:
    """Yield the functions that convert between a raw number and its words."""
    kind, info = raw_type(point), point.info
    places = [f"words[{place}]" for place in places_of(point)]
    swaps = [f"{place} = fieldscribe_exchanged({place});" for place in places if point.swapped]
    read = [f"fieldscribe_exchanged({place})" if swaps else place for place in places]
    if point.words == 1:
        sign = "0x8000U" if info.bits == 16 else "0x80U"
        split = f"words[0] = {'raw ? 1U : 0U' if info.bits == 1 else f'(uint16_t){coded_bits(point)}'};"
        joined = read[0] if info.bits == 16 else f"{read[0]} & 0xFFU"
        if point.coding:
            joined = decoded_bits(point, joined)
        elif info.signed:
            joined = f"({kind})fieldscribe_signed({joined}, {sign})"
        elif info.bits < 16:
            joined = f"{read[0]} != 0U" if info.bits == 1 else f"({kind})({joined})"
    else:
        above = info.bits // 16 - point.words  # words of the type that do not travel
        into = ", ".join(["&above"] * above + [f"&{place}" for place in places])
        split = f"fieldscribe_split{info.bits}((uint{info.bits}_t){coded_bits(point)}, {into});"
        split = f"uint16_t above; {split}" if above else split
        joined = f"fieldscribe_join{info.bits}({', '.join(['0U'] * above + read)})"
        if point.width % 16:
            joined = f"{joined} & {hexadecimal(mask_of(point.width))}"
        if point.coding:
            joined = decoded_bits(point, joined)
        elif point.shape.narrow and info.signed:
            sign = hexadecimal(1 << (point.width - 1))
            joined = f"({kind})(({joined}) ^ {sign}) - ({kind}){sign}"
        elif info.signed:
            joined = f"fieldscribe_signed{info.bits}({joined})"
    words = f"uint16_t words[{point.words}]"
    yield function(f"{INLINE} void", f"{name}_to_words", (f"{kind} raw", words), split, *swaps)
    yield function(f"{INLINE} {kind}", f"{name}_from_words", (f"const {words}",), f"return {joined};")


def is_plain_long(point: Point) -> bool:
    """Return True if the raw number is all bits of two words."""
    return point.words == 2 and point.width == 32 and not (point.swapped or point.coding or point.text)


def coded_bits(point: Point) -> str:
    """Return the expression for the bits of the number `raw`."""
    if not point.coding:
        return "raw"
    if point.info.signed:
        return f"fieldscribe_sign_and_magnitude(raw, {hexadecimal(1 << point.width - 1)})"
    return f"fieldscribe_bcd_of{_wide(point)}(raw, {hexadecimal(mask_of(point.width))})"


def decoded_bits(point: Point, bits: str) -> str:
    """Return the expression for the raw number in bits with a special coding."""
    if point.info.signed:
        return f"({raw_type(point)})fieldscribe_of_sign_and_magnitude({bits}, {hexadecimal(1 << point.width - 1)})"
    return f"({raw_type(point)})fieldscribe_of_bcd{_wide(point)}({bits}, {hexadecimal(mask_of(point.width))})"


def _wide(point: Point) -> str:
    return "_wide" if point.width > 32 else ""


def places_of(point: Point) -> list[int]:
    """Return the positions of a point's words among its addresses, the high word first."""
    order = sorted(point.place.addresses)
    whole = len(order) == point.words  # one address of a parameter may hold several words, the high one first
    return [order.index(address) for address in point.place.addresses] if whole else list(range(point.words))


def bits_functions(point: Point, name: str) -> Iterator[Function]:
    """Yield the functions that convert between a raw number and the word that it shares."""
    assert point.bits is not None
    kind, low = raw_type(point), point.bits[1]
    place = f"{hexadecimal(group_mask(point))}, {low}U"
    word = "fieldscribe_exchanged(word)" if point.swapped else "word"
    extract = f"fieldscribe_extract({word}, {place})"
    if point.coding:
        extract = decoded_bits(point, extract)
    elif kind == "bool":
        extract = f"{extract} != 0U"
    elif point.info.signed:
        extract = f"({kind})fieldscribe_signed({extract}, {hexadecimal(1 << (point.width - 1), 1)})"
    elif kind != "uint16_t":
        extract = f"({kind})({extract})"
    number = (
        "raw ? 1U : 0U"
        if kind == "bool"
        else f"(uint16_t){coded_bits(point)}"
        if point.info.signed or point.coding
        else "raw"
    )
    insert = f"fieldscribe_insert({word}, {place}, {number})"
    if point.fixed is not None:
        insert = f"fieldscribe_fix({insert}, {constant_bits(point)})"
    if point.swapped:
        insert = f"fieldscribe_exchanged({insert})"
    yield function(f"{INLINE} {kind}", f"{name}_extract", ("uint16_t word",), f"return {extract};")
    parameters = ("uint16_t word", f"{kind} raw")
    yield function(f"{INLINE} uint16_t", f"{name}_insert", parameters, f"return {insert};")


def constant_bits(point: Point) -> str:
    """Return the mask of the constant bits and their values, both 0 without constant bits."""
    mask, bits = (0, 0) if point.fixed is None else (point.fixed.mask, point.fixed.bits)
    return f"{hexadecimal(mask)}, {hexadecimal(bits)}"


def fixes(point: Point) -> bool:
    """Return True if encoding sets the constant bits of the word; for a bit group, insertion sets them."""
    return point.fixed is not None and point.bits is None


def fixed_number(point: Point, name: str) -> str:
    """Return an expression for the number `name` with the constant bits of the word set, in the point's raw type."""
    info = point.info
    width = max(16, info.bits)
    fixed = f"fieldscribe_fix{width if width > 16 else ''}((uint{width}_t){name}, {constant_bits(point)})"
    if not info.signed:
        return fixed if info.bits > 8 else f"({fixed} != 0U)" if info.bits == 1 else f"({raw_type(point)}){fixed}"
    if info.bits > 16:
        return f"fieldscribe_signed{info.bits}({fixed})"
    sign, mask = hexadecimal(1 << (info.bits - 1)), hexadecimal((1 << info.bits) - 1)
    return f"({raw_type(point)})fieldscribe_signed((uint16_t)({fixed} & {mask}), {sign})"
