"""The functions that read or write a point in one call: the runtime's macros are their bodies."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

from fieldscribe.targets.c.conversions import is_rechecked, value_type
from fieldscribe.targets.c.scope import HeaderScope, PointView
from fieldscribe.targets.c.syntax import Function, called, function, raw_kind
from fieldscribe.targets.c.word_functions import coded_bits, has_words
from fieldscribe.text import upper


class Transfer(NamedTuple):
    """The family, and the arguments of its macros for reading and writing a point; empty for what is not possible."""

    family: str
    read: str = ""
    write: str = ""
    store: str = ""
    base: str = ""
    """The name of the base of the addresses; empty if they count from 0."""
    texts: bool = False
    """Whether the requests carry the words of a text, too, for which the family has macros."""
    selects: str = ""
    """The arguments that say what is written before; empty if nothing is."""
    is_long: bool = False
    """Whether the macros are those of 32-bit numbers, which join two words."""


def call_names(item: str, view: PointView, transfer: Transfer, scope: HeaderScope) -> list[str]:
    """Return the names of the functions that read and write a point under that name."""
    ways = [way for way in ("read", "write", "store") if getattr(transfer, way)]
    return [f"{scope.prefix}_{way}_{item}" for way in ways if view.shape != "text" or _has_text_calls(view, transfer)]


def left_out(view: PointView, transfer: Transfer) -> set[str]:
    """Return the names of functions that no call needs, for a point that a program reads and writes by calls alone."""
    unneeded: set[str] = set()
    if transfer.write and not is_rechecked(view.point) and _value(view)[2] is not None:
        unneeded.add(f"{view.function}_check")
    if transfer.is_long or not view.point.writable:
        unneeded.add(f"{view.function}_to_words")
    return unneeded


def calls(view: PointView, transfer: Transfer, scope: HeaderScope) -> Iterator[Function]:
    """Yield the functions that read and write a point."""
    if view.shape == "text":
        yield from _text_calls(view, transfer, scope) if _has_text_calls(view, transfer) else ()
        return
    start, point = f"FIELDSCRIBE_{upper(transfer.family)}_", view.point
    handle, (value, kind, tail) = [f"{scope.prefix}_device *device"], _value(view)
    if transfer.base:
        handle.append(f"fieldscribe_{transfer.family}_base base")
    based = f"{start}BASED_" if transfer.base else f"{start}SELECTED_" if transfer.selects else start
    selects = [transfer.selects] if transfer.selects else []
    if transfer.read:
        names = point.scale_arguments if view.shape == "ruled" and tail else ()
        parameters = [*handle, *scope.parameters(point, names), f"{kind} *{value}"]
        way, *arguments = _decoding(view, value, tail, scope.passed(names), is_long=transfer.is_long)
        body = called(f"{based}{way}_{_size(view, transfer)}", *selects, transfer.read, *arguments)
        yield function(f"{start}CALL", f"{scope.prefix}_read_{view.fields.item}", parameters, body)
    for verb, to in (("write", transfer.write), ("store", transfer.store)):
        if to:
            names = point.arguments if tail is not None else point.limit_arguments
            parameters = [*handle, *scope.parameters(point, names), f"{kind} {value}"]
            where = to if point.bits is None else f"{transfer.read}, {to}"
            way = "WRITE" if point.bits is None else "UPDATE"
            encoded = _encoding(view, kind, value, tail, scope.passed(names))
            raw = [view.raw_type, encoded, *[_bits_of_raw(view)] * (not transfer.is_long)]
            body = called(f"{based}{way}_{_size(view, transfer)}", *selects, where, *raw)
            yield function(f"{start}CALL", f"{scope.prefix}_{verb}_{view.fields.item}", parameters, body)


def call_cases(
    view: PointView, transfer: Transfer, scope: HeaderScope, arguments: Callable[[tuple[str, ...]], str]
) -> Iterator[str]:
    """Yield the macros of the conformance program that call these functions; `arguments` passes other points' numbers.

    The value to write is the decoded raw number, if encoding it gives the raw number back. Points that are only written
    and not raw have no such test, nor do counts of floating-point numbers, which not every pattern has.
    """
    if view.shape == "text":
        yield from _text_cases(view, transfer, scope) if _has_text_calls(view, transfer) else ()
        return
    point, item, (value, kind, tail) = view.point, view.fields.item, _value(view)
    fails = tail is not None and _decoding(view, value, tail, ())[0] == "DECODE"
    means = f"{'TRY_' if fails else ''}{'RAW' if tail is None else 'COUNT_OF' if tail else 'PLAIN'}"
    scale = point.scale_arguments if view.shape == "ruled" and tail else ()
    names = point.arguments if tail is not None else point.limit_arguments
    writes = [verb for verb in ("write", "store") if getattr(transfer, verb)]
    writes = writes if tail is None or (point.readable and not point.info.floating) else []
    if not (scale or names or transfer.base):
        what = f"{scope.prefix}, {item}, {kind}, {view.raw_type}, {means}"
        if transfer.read and writes == ["write"]:
            yield f"CALLS({what})"
            return
        yield from ([f"CALL_READ({what})"] if transfer.read else [])
        yield from (f"CALL_WRITE({verb}, {what})" for verb in writes)
        return
    decode = f"FIELDSCRIBE_DECODE_{means}({view.function}, {kind})"
    encode = f"FIELDSCRIBE_ENCODE_RAW({view.function}, {view.raw_type})"
    if fails:
        decode = f"(int){view.function}_decode{tail}(raw {arguments(scale)}, &number)"
    if fails or tail == "_count":
        encode = f"(int){view.function}_encode{tail}(number {arguments(names)}, &again)"
    base = f'FIELDSCRIBE_BASE("{transfer.base}") ' if transfer.base else ""
    handle, types = f"{scope.prefix}_device", f"{kind}, {view.raw_type}"
    if transfer.read:
        call = f"{scope.prefix}_read_{item}"
        yield f"CALL_READ_BY({handle}, {call}, {types}, {base}{arguments(scale)}, {decode})"
    for verb in writes:
        call = f"{scope.prefix}_{verb}_{item}"
        yield f'CALL_WRITE_BY("{verb}", {handle}, {call}, {types}, {base}{arguments(names)}, {decode}, {encode})'


class _Held(NamedTuple):
    """What a program has for a text: its type and size, its length when it is written, and the conversions."""

    kind: str
    size: int
    length: str
    decoded: str
    encoded: str


def _has_text_calls(view: PointView, transfer: Transfer) -> bool:
    """Return True if requests carry the words of a text in their order."""
    return transfer.texts and list(view.point.addresses) == sorted(view.point.addresses)


def _held(view: PointView, value: str) -> _Held:
    """Return what a program has; the conversions take `words` and `value`, and give a status if they may fail."""
    text, name = view.point.text, view.function
    assert text is not None
    decoded, encoded = f"{name}_decode(words, {value})", f"{name}_encode({value}, words)"
    if text.is_bytes:
        return _Held("uint8_t", text.characters, "", decoded, encoded)
    if text.parts:
        return _Held("fieldscribe_date_time", 0, "", decoded, encoded)
    more = ", &length" if text.is_unicode else ""
    encoded = f"{name}_encode({value}, length, words)"
    return _Held("char", text.most_bytes + 1, "size_t length", f"{name}_decode(words, {value}{more})", encoded)


def _text_calls(view: PointView, transfer: Transfer, scope: HeaderScope) -> Iterator[Function]:
    """Yield the functions that read and write a text, bytes or a date."""
    text = view.point.text
    assert text is not None
    name = "bytes" if text.is_bytes else "time" if text.parts else "text"
    held, fails = _held(view, name), text.is_unicode or bool(text.parts)
    family = transfer.family
    call, start = (f"FIELDSCRIBE_{upper(family)}_{what}" for what in ("CALL", "BASED_" if transfer.base else ""))
    handle = [f"{scope.prefix}_device *device", *[f"fieldscribe_{family}_base base"] * bool(transfer.base)]
    count = ", 1U" if view.point.words == 1 else ""
    if transfer.read:
        taken = f"status = fieldscribe_{family}_converted({held.decoded})" if fails else held.decoded
        taken = {"size_t": "(void)", "unicode": "size_t length = 0U; "}.get(_returned(view), "") + taken
        body = called(f"{start}TAKE_WORDS", transfer.read + count, taken)
        parameters = [*handle, f"{held.kind} {name}[{held.size}]" if held.size else f"{held.kind} *{name}"]
        yield function(call, f"{scope.prefix}_read_{view.fields.item}", parameters, body)
    if transfer.write:
        put = held.encoded if text.is_bytes else f"status = fieldscribe_{family}_converted({held.encoded})"
        body = called(f"{start}PUT_WORDS", transfer.write + count, put)
        given = f"const {held.kind} {name}[{held.size}]" if text.is_bytes else f"const {held.kind} *{name}"
        parameters = [*handle, given, *[held.length] * bool(held.length)]
        yield function(call, f"{scope.prefix}_write_{view.fields.item}", parameters, body)


def _returned(view: PointView) -> str:
    """Return what decoding a text gives beside it: `size_t`, or of `unicode` its length and a status."""
    text = view.point.text
    assert text is not None
    return "unicode" if text.is_unicode else "" if text.is_bytes or text.parts else "size_t"


def _text_cases(view: PointView, transfer: Transfer, scope: HeaderScope) -> Iterator[str]:
    """Yield the macros of the conformance program that call them."""
    held, item, text = _held(view, "held"), view.fields.item, view.point.text
    assert text is not None
    decoded = f"({'' if text.is_bytes else 'length = '}{held.decoded}, 0)"
    decoded = f"(int){held.decoded}" if text.is_unicode or text.parts else decoded
    base = f'FIELDSCRIBE_BASE("{transfer.base}") ' if transfer.base else ""
    length = "FIELDSCRIBE_LENGTH" if held.length else ""
    for way in ("read", "write"):
        if getattr(transfer, way):
            call = f"{scope.prefix}_device, {scope.prefix}_{way}_{item}, {held.kind}, {held.size or 1}"
            argument = f"{length}, " if way == "write" else ""
            yield f"CALL_{way.upper()}_TEXT({call}, {base}, {argument}{decoded})"


def _size(view: PointView, transfer: Transfer) -> str:
    return "LONG" if transfer.is_long else "WORDS" if view.point.words > 1 else "WORD"


def _value(view: PointView) -> tuple[str, str, str | None]:
    """Return the name and the type of what is read and written, and the end of its conversions; None for raw."""
    if view.point.has_counts:
        return "count", view.scale.count_type if view.scale is not None else "int64_t", "_count"
    if view.shape == "plain":
        return "value", "bool" if view.raw_type == "bool" and not view.special else value_type(view.point), ""
    return "value", view.raw_type, None


def _decoding(
    view: PointView, value: str, tail: str | None, passed: tuple[str, ...], *, is_long: bool = False
) -> tuple[str, ...]:
    """Return the macro that turns the words into the value, and its arguments."""
    raw = ("fieldscribe_signed32(raw)" if view.point.info.signed else "raw") if is_long else raw_of_words(view)
    if tail is None:
        return "READ", value, raw
    if view.special or view.shape in ("ruled", "float") or (view.scale and view.scale.count_fits):
        return "DECODE", called(f"{view.function}_decode{tail}", raw, *passed, value)
    return "READ", value, called(f"{view.function}_decode{tail}", raw)


def _encoding(view: PointView, kind: str, value: str, tail: str | None, passed: tuple[str, ...]) -> str:
    """Return the status of storing the raw number of a value in `raw`."""
    if tail is None:
        status = called(f"{view.function}_check", value, *passed)
        return called(f"fieldscribe_keep_{raw_kind(view.point)}", status, value, "&raw")
    return called(f"{view.function}_encode{tail}", f"{value} ? 1 : 0" if kind == "bool" else value, *passed, "&raw")


def raw_of_words(view: PointView) -> str:
    """Return the raw number of a point in `word`, or in several `words`."""
    if view.point.bits is not None:
        return f"{view.function}_extract(word)"
    if has_words(view.point):
        return f"{view.function}_from_words({'words' if view.point.words > 1 else '&word'})"
    return {"bool": "word != 0U", "uint16_t": "word"}.get(view.raw_type, f"({view.raw_type})word")


def _bits_of_raw(view: PointView) -> str:
    if view.point.bits is not None:
        return f"{view.function}_insert(word, raw)"
    if view.point.words > 1:
        return f"{view.function}_to_words(raw, words)"
    usual = f"(uint16_t){coded_bits(view.point)}"
    word = usual if view.point.coding else {"bool": "raw ? 1U : 0U", "uint16_t": "raw"}.get(view.raw_type, usual)
    return f"fieldscribe_exchanged({word})" if view.point.swapped else word
