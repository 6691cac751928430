"""The conformance program of a device: its context, and the macros by which each point answers vectors."""

from collections.abc import Collection, Iterable, Iterator, Sequence

from fieldscribe.families import family
from fieldscribe.model import Device, Enum, Point
from fieldscribe.resources import Render
from fieldscribe.targets.c.calls import call_cases
from fieldscribe.targets.c.conversions import value_type
from fieldscribe.targets.c.declarations import shares_values, special_defines
from fieldscribe.targets.c.frames import Frames, frames_of, kind_of
from fieldscribe.targets.c.point_views import GeneratedPoint, names_of, texts_of
from fieldscribe.targets.c.scope import HeaderScope, PointView
from fieldscribe.targets.c.syntax import folded, raw_type
from fieldscribe.targets.c.word_functions import has_form, has_words
from fieldscribe.text import upper

_STATUSES = (
    *("OK", "OUT_OF_RANGE", "NOT_A_NUMBER", "UNKNOWN_VALUE", "ZERO_FACTOR", "NO_CASE", "OVERFLOW", "SPECIAL"),
    "MALFORMED",
)
"""The status of conversions."""


def suite_context(device: Device, points: Sequence[GeneratedPoint], scope: HeaderScope) -> dict[str, object]:
    """Return the context of `<device>_conformance.c`.

    `points` are those with code, each with a function that answers vectors. `enums` are those that points share, with
    the macros for their constants. `names` are the kinds of codes for which a function gives the name. `documented` are
    points that are reached raw only: item, space, the prefix of their macros, and whether they have an index.
    """
    prefix, capitals, named = scope.prefix, scope.upper, frames_of(device).named_codes
    enums = {enum.name: enum for point, _, _ in points if (enum := point.named_numbers) and enum.name != point.item}
    emitted = [codes for codes in family(device.family).codes if codes.emitted and device.bus.codes(codes.section)]
    return {
        "family": device.family,
        "structs": [struct for point, _, _ in points if point.arguments for struct in _structs_of(point, scope)],
        "enums": [(name, _named(enum, f"{capitals}_{upper(name)}")) for name, enum in enums.items()],
        "points": [each.point.item for each in points],
        "statuses": [(f"FIELDSCRIBE_{status}", status.lower()) for status in _STATUSES],
        "groups": [(group, f"{prefix}_{group}_blocks") for group, blocks in device.blocks.items() if blocks],
        "names": [codes.kind for codes in emitted if codes.kind in named],
        "codes": [
            (codes.kind, code.name, f"{capitals}_{upper(codes.kind)}_{upper(code.name)}")
            for codes in emitted
            for code in device.bus.codes(codes.section)
        ],
        "documented": [
            (point.item, point.space, f"{capitals}_{upper(point.item)}", point.index is not None)
            for point in device.points
            if point.raw_only
        ],
        "commands": [
            (command.name, f"{prefix}_command_{command.name}", f"{capitals}_COMMAND_{upper(command.name)}_VALUE")
            for command in device.commands
        ],
    }


def adapters(
    points: Iterable[GeneratedPoint], scope: HeaderScope, sections: Collection[Frames], render: Render
) -> Iterator[str]:
    """Yield the functions of points that answer vectors."""
    return texts_of(points, lambda view, _: _adapter(view, scope, sections, render))


def _adapter(view: PointView, scope: HeaderScope, sections: Iterable[Frames], render: Render) -> str:
    of_family = [case for frames in sections for case in _exchanges(view, frames, scope)]
    cases = [*_cases(view, scope), *of_family, *_flag_cases(view, scope), *_special_code_cases(view, scope)]
    form = _form(view) if has_form(view.point) and any(kind_of(view) in case for case in of_family) else ""
    return folded(render("c/adapter.c.j2", {"item": view.fields.item, "form": form, "cases": cases}))


def _form(view: PointView) -> str:
    """Return the macro for the functions that take and put a raw number with a coding or byte order of its own."""
    name = view.function
    ways = f"{name}_from_words(words)", f"{name}_to_words(raw, words)"
    if view.point.bits is not None:
        ways = f"{name}_extract(words[0])", f"words[0] = {name}_insert(words[0], raw)"
    return f"FIELDSCRIBE_FORM({view.fields.item}, {view.raw_type}, {', '.join(ways)})"


def _exchanges(view: PointView, frames: Frames, scope: HeaderScope) -> Iterator[str]:
    """Yield the macros for the exchanges of a point, with its frames and in one call."""
    yield from frames.cases(view)
    yield from call_cases(view, frames.transfer(view), scope, lambda names: _arguments_of(view.point, names, scope))


def _cases(view: PointView, scope: HeaderScope) -> Iterator[str]:
    """Yield the macros for the point as a whole."""
    point, function, kind = view.point, view.function, view.raw_type
    if point.address is not None:
        yield _address_case(view)
    if view.shape == "digits" and point.writable:
        yield _check_case(view, scope)
    yield from _TEXTS[view.shape](view) if view.shape in _TEXTS else _conversion_cases(view, scope)
    enum = point.named_numbers
    if enum is not None:
        name, macro = names_of(enum, point, view.fields)
        yield f"NAME({scope.prefix}_{name}_name, {value_type(point)})"
        yield from [f"NAMES_OF({name})"] if enum.name != point.item else _named(enum, f"{scope.upper}_{macro}")
    yield from _place_cases(view)
    if point.bits is not None:
        order, plain = "fieldscribe_exchanged" if point.swapped else "(uint16_t)", "false" if point.coding else "true"
        usual = (order, plain) == ("(uint16_t)", "true")
        yield f"BITS{'(' if usual else f'_IN({order}, {plain}, '}{function}, {kind}, {view.macro})"
    elif has_words(point):
        yield f"WORDS({function}, {kind}, {point.words}U)"
    elif point.text is None:
        yield f"ONE_WORD({kind})"


def _named(enum: Enum, macro: str) -> Iterator[str]:
    """Yield the macros for the constants of an enum; of several names of a number only the first has one."""
    first = {entry.raw: entry.name for entry in reversed(enum.entries)}
    return (f'NAMED("{name}", {macro}_{upper(name)})' for name in first.values())


def _address_case(view: PointView) -> str:
    """Return the macro with the address and the facts beside it: space, words, code, limits, decimals, references."""
    point, fields, macro = view.point, view.fields, view.macro
    words = f"{macro}_WORDS" if point.words > 1 or point.text is not None else "1U"
    others = []
    if view.shape not in ("float", "text", "digits"):
        only_read = f"ONLY_READ({fields.low_signed}, {fields.high_signed})"
        others.append(f"{'COUNTED' if view.is_counted else 'RAWS'}({macro})" if point.writable else only_read)
    if view.is_counted and not point.writable:
        others.append(f"DECIMALS({macro})")
    for (key, number), literal in zip(point.references.items(), fields.references, strict=True):
        others.append(f'REFERENCE{"_TEXT" if isinstance(number, str) else ""}("{key}", {literal})')
    other_facts = " ".join(f"FIELDSCRIBE_{other}" for other in others)
    return f'ADDRESS({macro}, "{point.space}", {words}, {fields.code or "NULL"}, {other_facts})'


def _conversion_cases(view: PointView, scope: HeaderScope) -> Iterator[str]:
    """Yield the macros for the conversions of a point that is a number: one for the usual ones, else one for each."""
    point, scale = view.point, view.scale
    attempt = "TRY_" if view.special or view.shape == "ruled" else ""
    tried = "TRY_" if scale is not None and scale.count_fits else attempt
    number = "int64_t" if scale is None else scale.count_type
    if view.shape == "plain":
        number = "int32_t" if view.raw_type == "bool" and not attempt else value_type(point)
    real = "double" if view.computes_in_double else "fieldscribe_real"
    usual = point.writable and point.readable and not (tried or point.arguments)
    if usual and view.shape == "plain":
        yield f"PLAIN({view.function}, {number}, {view.raw_type})"
    elif usual and view.is_counted and point.encodes_values:
        yield f"COUNTS({view.function}, {number}, {view.raw_type}, {real})"
    else:
        yield from _encode_cases(view, number, real, scope) if point.writable else ()
        yield from _decode_cases(view, (tried, attempt), number, real, scope) if point.readable else ()
        if point.type == "f32" and point.has_counts:
            yield f"F32_DECIMALS({view.macro})"


def _check_case(view: PointView, scope: HeaderScope) -> str:
    limits = _arguments_of(view.point, view.point.limit_arguments, scope)
    return f"CHECK({view.function}_check, {view.raw_type}, {limits})"


def _encode_cases(view: PointView, number: str, real: str, scope: HeaderScope) -> Iterator[str]:
    """Yield the macros for the check of a number, and its conversions from a count and from a value."""
    point, function, kind = view.point, view.function, view.raw_type
    arguments = _arguments_of(point, point.arguments, scope)
    yield _check_case(view, scope)
    if view.shape == "plain":
        yield f"ENCODE_COUNT({function}_encode, {number}, {kind}, {arguments})"
        return
    if view.is_counted:
        yield f"ENCODE_COUNT({function}_encode_count, {number}, {kind}, {arguments})"
    elif point.type == "f32" and point.has_counts:
        yield f"F32_ENCODE_COUNT({function}_encode_count)"
    if point.encodes_values:
        yield f"ENCODE({function}_encode, {real}, {kind}, {arguments})"


def _decode_cases(
    view: PointView, attempts: tuple[str, str], number: str, real: str, scope: HeaderScope
) -> Iterator[str]:
    """Yield the macros for the conversions to a count and to a value; `attempts` mark those that may fail."""
    point, function, kind = view.point, view.function, view.raw_type
    of_count, of_value = attempts
    factors = _arguments_of(point, point.scale_arguments, scope)
    if view.shape == "plain":
        yield f"{of_count}DECODE_COUNT({function}_decode, {number}, {kind}, {factors})"
        return
    if view.is_counted:
        yield f"{of_count}DECODE_COUNT({function}_decode_count, {number}, {kind}, {factors})"
    elif point.type == "f32" and point.has_counts:
        yield f"F32_DECODE_COUNT({function}_decode_count)"
    yield f"{of_value}DECODE({function}_decode, {real}, {kind}, {factors})"


def _text_cases(view: PointView) -> Iterator[str]:
    text = view.point.text
    assert text is not None
    kind = "DATE" if text.parts else "BYTES" if text.is_bytes else "UNICODE" if text.is_unicode else "TEXT"
    if view.point.readable:
        yield f"{kind}_DECODE({view.function}, {view.macro}{f', {text.most_bytes}U' if text.is_unicode else ''})"
    if view.point.writable:
        yield f"{kind}_ENCODE({view.function}, {view.macro})"


def _digits_cases(view: PointView) -> Iterator[str]:
    if view.point.readable:
        yield f"{'TRY_' if view.special else ''}DIGITS({view.function}, uint16_t, {view.macro})"
    if view.point.writable:
        yield f"DIGITS_ENCODE({view.function}, uint16_t, {view.macro})"


_TEXTS = {"text": _text_cases, "digits": _digits_cases}


def _place_cases(view: PointView) -> Iterator[str]:
    """Yield the macros for the places of a point and the constant bits of its word."""
    point, addresses = view.point, view.point.place.addresses
    facts = {
        "WRITE_ADDRESS": point.write_place,
        "FIXED": point.fixed,
        "DISPLAY": point.display,
        "EPOCH": point.epoch or None,
    }
    yield from (f"{case}({view.macro})" for case, fact in facts.items() if fact is not None)
    calls = [f"FIELDSCRIBE_INDEX({view.macro})"] if point.index is not None else []
    calls += [f"FIELDSCRIBE_TELEGRAM({view.macro})"] if point.telegram is not None else []
    if point.text is not None or point.place.is_scattered:
        yield f"PLACE_OF_TEXT({view.macro}, {view.function}, {' '.join(calls)})"
    elif addresses and calls:
        words = [f"FIELDSCRIBE_PLACED({view.macro}, {address - min(addresses)}U)" for address in addresses]
        yield f"PLACE({' '.join(words)}, {' '.join(calls)})"


def _flag_cases(view: PointView, scope: HeaderScope) -> Iterator[str]:
    """Yield the macros for flags, and for the named numbers of flags of several bits."""
    point, macro, kind = view.point, view.macro, view.raw_type
    has_low = any(flag.width == 1 and not flag.active for flag in point.flags)
    low = f"{macro}_ACTIVE_LOW_MASK" if has_low else "0U"
    for flag in point.flags:
        name = f"{macro}_{upper(flag.name)}"
        if flag.width == 1:
            yield f'TRUTH("{flag.name}", {kind}, {name}_MASK, {low})'
            continue
        yield f'WIDE_FLAG("{flag.name}", {kind}, {view.function}_{flag.name}, {name})'
        for entry in flag.values:
            shared = f"{scope.upper}_{upper(flag.enum)}" if flag.enum else macro if shares_values(point) else name
            constant = f"{shared}_{upper(entry.name)}"
            yield f'FLAG_NAME("{flag.name}", "{entry.name}", {constant})'


def _special_code_cases(view: PointView, scope: HeaderScope) -> Iterator[str]:
    """Yield the macros for special codes."""
    point = view.point
    for special in point.specials:
        macro = f"{scope.upper}_{upper(point.shared_codes) or view.fields.macro}"
        (first, _), (last, _) = special_defines(special, macro, point)
        yield f'SPECIAL("{special.name}", {first}, {last})'
    if point.specials:
        yield f"SPECIAL_NAME({view.function}, {view.raw_type})"


def _structs_of(point: Point, scope: HeaderScope) -> Iterator[dict[str, object]]:
    """Yield a function for each set of several raw numbers that some function of the point needs.

    The function fills a struct with the numbers in a vector; a `floating` one serves functions with floating point
    only.
    """
    counts = point.decimals is not None
    integer = [point.limit_arguments] if point.writable else []
    integer += [point.arguments] if point.writable and counts else []
    integer += [point.scale_arguments] if point.readable and counts else []
    for names in dict.fromkeys((point.arguments, point.scale_arguments, point.limit_arguments)):
        if len(names) > 1:
            fields = [(name, f"{name}_raw", raw_type(scope.points[name])) for name in names]
            struct, function = scope.struct(point.arguments), _fill_function(point, names)
            yield {"type": struct, "function": function, "fields": fields, "floating": names not in integer}


def _arguments_of(point: Point, names: tuple[str, ...], scope: HeaderScope) -> str:
    if not names:
        return "FIELDSCRIBE_ALONE"
    if len(names) > 1:
        return f"FIELDSCRIBE_TOGETHER({_fill_function(point, names)})"
    return f'FIELDSCRIBE_WITH("{names[0]}", {raw_type(scope.points[names[0]])})'


def _fill_function(point: Point, names: tuple[str, ...]) -> str:
    ways = {point.scale_arguments: "_scale", point.limit_arguments: "_limits", point.arguments: ""}
    return f"with_{point.item}{ways[names]}"
