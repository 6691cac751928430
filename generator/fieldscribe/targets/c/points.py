"""The view of one point."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

from fieldscribe.names import upper
from fieldscribe.targets.c.defines import defines
from fieldscribe.targets.c.limits import any_of, check_view
from fieldscribe.targets.c.literals import (
    VALUE_BOUNDS,
    bare,
    float_order,
    raw_bounds,
    raw_type,
    signed,
)
from fieldscribe.targets.c.parts import digits_view, text_view
from fieldscribe.targets.c.places import bits_view, fixed_number, fixes, words_view
from fieldscribe.targets.c.rules import ruled_view
from fieldscribe.targets.c.scales import scaled_view
from fieldscribe.targets.c.special_codes import encoded_limits, special_view
from fieldscribe.targets.c.views import (
    CheckView,
    Codec,
    EnumView,
    FlagView,
    FloatView,
    PlainView,
    PointView,
)
from fieldscribe.text import c_comment, c_string
from fieldscribe.wording import (
    access_text,
    codes_text,
    condition_text,
    default_text,
    range_text,
    raw_range_text,
    resolution_text,
    width_texts,
)

if TYPE_CHECKING:
    from fieldscribe.model import Enum, Flag, Point
    from fieldscribe.targets.c.scope import Scope

_COMMENT_WIDTH = 114
_NO_BODY = PlainView("", "", "")


def point_view(point: Point, scope: Scope) -> PointView:
    """The view of a generated point."""
    macro = f"{scope.upper}_{upper(point.item)}"
    low, high = (0, 0) if point.info.floating else point.outer
    scale, limits = point.scale_arguments, point.limit_arguments
    reach = encoded_limits(point) if point.specials and not point.info.floating else (low, high)
    shape = _shape(point, scale)
    codec = _NO_BODY if scope.names_only else _codec(shape, point, macro, scope, reach)
    checked = point.writable and shape in ("plain", "scaled", "ruled") and not scope.names_only
    check = check_view(point, macro, scope, limits) if checked else None
    enum = named_numbers(point)
    kind = raw_type(point)
    declare_scale, declare_limits = scope.declare(scale), scope.declare(limits)
    return PointView(
        function=f"{scope.prefix}_{point.item}",
        macro=macro,
        item=point.item,
        comment=() if scope.names_only else comment_lines(point, scope),
        defines=tuple(defines(point, macro, scope, (low, high))),
        enum=_enum_view(enum, point, scope) if enum is not None else None,
        shape=shape,
        codec=codec,
        raw_type=kind,
        from_whole="whole != 0" if kind == "bool" else f"({kind})whole",
        from_value="value != 0" if kind == "bool" else "value" if kind == "uint64_t" else f"({kind})value",
        counts=point.decimals is not None,
        encodes=point.encodes_values,
        readable=point.readable,
        writable=point.writable,
        check=check,
        recheck=check is not None and _is_rechecked(point, check),
        special=special_view(point, scope),
        encode_min=signed(reach[0]) if reach[0] < low else f"{macro}_RAW_MIN",
        encode_max=signed(reach[1]) if reach[1] > high else f"{macro}_RAW_MAX",
        scale_arguments=scale,
        limit_arguments=limits,
        declare_all=scope.declare(point.arguments) if scale and limits else declare_scale or declare_limits,
        declare_scale=declare_scale,
        declare_limits=declare_limits,
        pass_limits=scope.place(limits),
        words=words_view(point, scope),
        bits=bits_view(point, macro, scope),
        flags=tuple(_flag_view(flag, point, macro, scope) for flag in point.flags if flag.width > 1)
        if point.flags
        else (),
    )


def _is_rechecked(point: Point, check: CheckView) -> bool:
    """Whether a number between the outer limits may still not be written."""
    return len(point.allowed.intervals) > 1 or bool(check.limits) or fixes(point) or bool(point.specials)


def value_type(point: Point) -> str:
    """The C type in which the value of an integer point is passed: wide enough to be out of range."""
    if point.info.bits <= 16:
        return "int32_t"
    return "uint64_t" if point.type == "u64" else "int64_t"


def comment_lines(point: Point, scope: Scope) -> tuple[str, ...]:
    """The comment above a point: code, title, range, access, default, condition, codes, errors of the manual."""
    head = f"{point.code}: {point.title['en']}" if point.code else point.title["en"]
    facts = ["" if point.untyped is not None else _range(point), access_text(point.access)]
    if point.default is not None:
        facts.append(f"default {default_text(point)}")
    lines = [*_wrapped(head), *_wrapped("; ".join(fact for fact in facts if fact) + ".")]
    if point.when is not None:
        lines += _wrapped(f"Exists only when {condition_text(point.when, scope.points)}.")
    lines += [f"{text[0].upper()}{text[1:]}." for text in width_texts(point)]
    if point.specials:
        lines += _wrapped(f"{codes_text(point)}.")
    for flag in point.flags:
        if flag.width == 1 and flag.active == 0:
            lines += _wrapped(f"Bit {flag.low} ({flag.name}) is true when it is 0.")
    if any(flag.width == 1 and flag.active == 0 for flag in point.flags):
        lines += _wrapped("Exclusive or with ACTIVE_LOW_MASK makes every bit 1 whose name is true, and back.")
    for erratum in point.errata:
        lines += _wrapped(scope.errata.get(erratum, f"Erratum {erratum}."))
    return tuple(lines)


def named_numbers(point: Point) -> Enum | None:
    """The enum that names the point's numbers, or each of its digits."""
    return point.digits.enum if point.digits is not None else point.enum


def _range(point: Point) -> str:
    if point.text is not None:
        return f"{point.text.characters} characters, {point.text.encoding}"
    if point.digits is not None:
        return f"{point.digits.count} digits, the highest first"
    units, raws, step = range_text(point), raw_range_text(point), resolution_text(point)
    text = f"{units}, raw {raws}" if units and raws and units != raws else units or f"raw {raws}"
    return f"{text}, in steps of {step}" if step and point.form == "scaled" else text


def _wrapped(text: str) -> list[str]:
    cleaned = c_comment(text)
    return (
        [cleaned] if len(cleaned) <= _COMMENT_WIDTH else textwrap.wrap(cleaned, _COMMENT_WIDTH, break_long_words=False)
    )


def _shape(point: Point, arguments: tuple[str, ...]) -> str:
    """The shape of the point's functions; `arguments` are the points that its scale needs."""
    form = point.form
    if form == "scaled":
        return "ruled" if arguments else form
    return form if form in ("float", "text", "digits") else "plain"


def _codec(shape: str, point: Point, macro: str, scope: Scope, outer: tuple[int, int]) -> Codec:
    """The view of the point's functions."""
    if shape == "scaled":
        return scaled_view(point, scope, *outer)
    if shape == "ruled":
        return ruled_view(point, scope)
    if shape == "float":
        return _float_view(point, scope)
    if shape == "text":
        return text_view(point)
    return digits_view(point) if shape == "digits" else _plain_view(point, macro, scope, outer)


def _plain_view(point: Point, macro: str, scope: Scope, outer: tuple[int, int]) -> PlainView:
    kind = value_type(point)
    least, greatest = VALUE_BOUNDS[kind]
    if fixes(point):  # a value without its constant bits may lie outside: only what the type cannot hold is refused
        low, high = raw_bounds(point)
        tests = [f"value < {bare(low)}"] if low > least else []
        tests += [f"value > {bare(high)}"] if high < greatest else []
        return PlainView(kind, " || ".join(tests), fixed_number(point, macro, scope, "value"))
    low_end, high_end = (bare(outer[0]), bare(outer[1])) if point.specials else (f"{macro}_RAW_MIN", f"{macro}_RAW_MAX")
    tests = [f"value < {low_end}"] if outer[0] > least else []
    tests += [f"value > {high_end}"] if outer[1] < greatest else []
    return PlainView(kind, " || ".join(tests), "")


def _float_view(point: Point, scope: Scope) -> FloatView:
    bits = point.info.bits
    scope.used.update((f"f{bits}", "double") if bits == 64 else (f"f{bits}",))
    if point.writable:
        scope.used.update((f"f{bits}_order", f"bits_of_f{bits}"))
    infinity = 0x7F80_0000 if bits == 32 else 0x7FF0 << 48
    spans = [(float_order(float(low), bits), float_order(float(high), bits)) for low, high in point.allowed.units]
    tests = [f"order >= {bare(low)} && order <= {bare(high)}" for low, high in spans or [(1 - infinity, infinity - 1)]]
    return FloatView(
        real=scope.helper("real") if bits == 32 else "double",
        bits=bits,
        order_type=f"int{bits}_t",
        nan=f"order < {bare(-infinity)} || order > {bare(infinity)}",
        inside=any_of(tests),
    )


def _enum_view(enum: Enum, point: Point, scope: Scope) -> EnumView | None:
    """The enumerators, at the first point that has them."""
    if enum.name in scope.enums:
        return None
    scope.enums.add(enum.name)
    prefix = f"{scope.upper}_{upper(enum.name)}"
    entries: list[tuple[str, str, str]] = []
    cases: dict[int, tuple[str, str]] = {}
    for entry in enum.entries:
        name = f"{prefix}_{upper(entry.name)}"
        comment = f" /* {c_comment(entry.quantity)} */" if entry.quantity else ""
        entries.append((name, signed(entry.raw), comment))
        cases.setdefault(entry.raw, (name, c_string(entry.name)))
    fits = all(-(1 << 15) <= entry.raw < 1 << 15 for entry in enum.entries)
    function = f"{scope.prefix}_{enum.name}_name"
    return EnumView(
        c_comment(enum.title["en"]), tuple(entries), tuple(cases.values()), fits, function, value_type(point)
    )


def _flag_view(flag: Flag, point: Point, macro: str, scope: Scope) -> FlagView:
    kind = f"uint{point.info.bits}_t"
    name = f"{macro}_{upper(flag.name)}"
    number = "(uint64_t)raw" if kind == "uint64_t" else "(uint32_t)raw"
    return FlagView(
        f"{scope.prefix}_{point.item}_{flag.name}", kind, f"({kind})(({number} & {name}_MASK) >> {name}_SHIFT)"
    )
