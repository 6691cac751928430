"""The view of the conformance program: which function answers which kind of vector, point by point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.names import upper
from fieldscribe.targets.c.conversions import value_type
from fieldscribe.targets.c.defines import shares_values
from fieldscribe.targets.c.families import frames_of
from fieldscribe.targets.c.literals import raw_type, signed
from fieldscribe.targets.c.points import named_numbers
from fieldscribe.targets.c.scales import scaled
from fieldscribe.targets.c.special_codes import encoded_limits, owner, special_defines
from fieldscribe.text import c_string

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from fieldscribe.model import Code, Device, Point
    from fieldscribe.targets.c.scales import Scaled
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import DeviceView, PointView


@dataclass(frozen=True, slots=True)
class AdapterView:
    """One point: `cases` are the macros that answer a kind."""

    item: str
    cases: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class StructView:
    """A function that fills the struct of a point with those raw numbers that a vector gives.

    `floating` says that floating point alone needs it.
    """

    type: str
    function: str
    fields: tuple[tuple[str, str, str], ...]
    floating: bool


@dataclass(frozen=True, slots=True)
class SuiteView:
    """The conformance program of a device."""

    structs: tuple[StructView, ...]
    adapters: tuple[AdapterView, ...]
    statuses: tuple[tuple[str, str], ...]
    family: str
    groups: tuple[tuple[str, str, str], ...]
    codes: tuple[tuple[str, str, str], ...]
    names: tuple[str, ...]
    """The kinds of codes that a function names."""
    commands: tuple[tuple[str, str, str], ...]
    documented: tuple[tuple[str, str, str, bool], ...]
    """Points whose words alone are known, their space, what their macros begin with, and whether they have an index."""
    telegrams: tuple[str, ...]


_STATUSES = ("ok", "out_of_range", "not_a_number", "unknown_value", "zero_factor", "no_case", "overflow", "special")


def conformance_view(
    device: Device, view: DeviceView, scope: HeaderScope, more: Iterable[tuple[str, str]]
) -> SuiteView:
    """The view of `<device>_conformance.c`; `more` are further macros that answer for points, with their functions."""
    named = frames_of(device).NAMED_CODES
    extra: dict[str, list[str]] = {}
    for function, case in more:
        extra.setdefault(function, []).append(case)
    views = {entry.item: entry for group in view.groups for entry, _ in group.entries if entry is not None}
    points = [point for point in device.points if point.generated]
    groups = (
        (group, f"{scope.prefix}_{group}_blocks", f"{scope.upper}_{upper(group)}_BLOCKS_COUNT")
        for group, blocks in device.blocks.items()
        if blocks
    )
    return SuiteView(
        structs=tuple(one for point in points for one in _structs(point, scope)),
        adapters=tuple(_adapter(point, views[point.item], scope, extra) for point in points),
        statuses=tuple((f"{scope.upper}_{upper(status)}", status) for status in _STATUSES),
        family=device.family,
        groups=tuple(groups),
        codes=tuple(_codes(device, scope)),
        documented=tuple(
            (one.item, one.space, f"{scope.upper}_{upper(one.item)}", one.index is not None)
            for one in device.points
            if one.raw_only and one.address is not None
        ),
        names=tuple(kind for kind, codes in _code_kinds(device) if codes and kind in named),
        commands=tuple(
            (one.name, f"{scope.prefix}_command_{one.name}", f"{scope.upper}_COMMAND_{upper(one.name)}_VALUE")
            for one in device.commands
        ),
        telegrams=tuple(one.name for one in device.telegrams),
    )


def _code_kinds(device: Device) -> tuple[tuple[str, tuple[Code, ...]], ...]:
    emitted = (codes for codes in family(device.family).codes if codes.emitted)
    return tuple((codes.kind, device.bus.codes(codes.section)) for codes in emitted)


def _codes(device: Device, scope: HeaderScope) -> Iterator[tuple[str, str, str]]:
    """The kind, name and enumerator of each number of the protocol that has one."""
    for kind, codes in _code_kinds(device):
        for code in codes:
            yield kind, code.name, f"{scope.upper}_{upper(kind)}_{upper(code.name)}"


def _adapter(point: Point, view: PointView, scope: HeaderScope, extra: Mapping[str, list[str]]) -> AdapterView:
    cases = _cases(point, view, scope)
    cases += extra.get(view.function, [])
    return AdapterView(
        view.item,
        tuple(f"FIELDSCRIBE_{case}" for case in (*cases, *_parts(point, view), *_specials(point, view, scope))),
    )


def _parts(point: Point, view: PointView) -> Iterator[str]:
    """What goes by the name of a part: flags, the named numbers of wide ones, special codes."""
    for flag in point.flags:
        number = _flag(view, flag.name, flag.width)
        if flag.width == 1:
            yield f'TRUTH("{flag.name}", {number}{_truth(point, view, flag.name)})'
        else:
            yield f'WIDE_FLAG("{flag.name}", {number}, {view.macro}_{upper(flag.name)})'
        for entry in flag.values if flag.width > 1 else ():
            of = view.macro if shares_values(point) else f"{view.macro}_{upper(flag.name)}"
            constant = f"{of}_{upper(entry.name)}"
            yield f'FLAG_NAME("{flag.name}", "{entry.name}", {constant})'


def _specials(point: Point, view: PointView, scope: HeaderScope) -> Iterator[str]:
    """What goes by the special codes of a point."""
    for special in point.specials:
        (first, _), (last, _) = special_defines(special, f"{scope.upper}_{upper(owner(point))}", point)
        yield f'SPECIAL("{special.name}", {first}, {last})'
    if point.specials:
        yield f"SPECIAL_NAME({view.function}, {view.raw_type})"


def _cases(point: Point, view: PointView, scope: HeaderScope) -> list[str]:
    """The macros that answer a kind of vector."""
    function, kind = view.function, view.raw_type
    cases = [f"ADDRESS({view.macro}, {_constants(point, view)})"] if point.address is not None else []
    if view.writable and view.shape != "text":
        cases.append(f"CHECK({function}_check, {kind}, {_with(point, view.limit_arguments, scope)})")
    cases += _conversions(point, view, scope)
    enum = named_numbers(point)
    if enum is not None:
        cases.append(f"NAME({scope.prefix}_{enum.name}_name, {value_type(point)})")
        constant = f"{scope.upper}_{upper(enum.name)}"
        first = {entry.raw: entry.name for entry in reversed(enum.entries)}
        cases += [f'NAMED("{name}", {constant}_{upper(name)})' for name in first.values()]
    cases += _places(point, view)
    if point.text is not None:
        return cases
    if view.bits:
        cases.append(f"BITS({function}, {kind}, {view.macro})")
    elif view.words:
        cases.append(f"WORDS({function}, {kind}, {point.words}U)")
    else:
        cases.append(f"ONE_WORD({kind})")
    return cases


def _places(point: Point, view: PointView) -> list[str]:
    """Where a point is beside its address, and which bits of its word are constant."""
    cases = []
    if point.fixed is not None:
        cases.append(f"FIXED({view.macro})")
    if point.text is not None:
        cases.append(f"PLACE_OF_TEXT({view.macro}, {view.function}, {_beside(point, view)})")
    elif point.addresses and (point.index is not None or point.telegram is not None):
        first = min(point.addresses)
        words = [f"FIELDSCRIBE_PLACED({view.macro}, {address - first}U)" for address in point.addresses]
        cases.append(f"PLACE({' '.join(words)}, {_beside(point, view)})")
    return cases


def _beside(point: Point, view: PointView) -> str:
    """The macros that answer with the index and the telegram, as far as the point has them."""
    calls = [f"FIELDSCRIBE_INDEX({view.macro})"] if point.index is not None else []
    calls += [f"FIELDSCRIBE_TELEGRAM({view.macro})"] if point.telegram is not None else []
    return " ".join(calls)


def _constants(point: Point, view: PointView) -> str:
    """The macros that answer with what stands beside the address."""
    calls = [
        f'SPACE("{point.space}")',
        f"{'SEVERAL' if point.words > 1 or point.text is not None else 'ONE'}({view.macro})",
    ]
    if view.shape not in ("float", "text", "digits"):
        low, high = point.outer
        only_read = f"ONLY_READ({signed(low)}, {signed(high)})"
        calls.append(f"RAWS({view.macro})" if point.writable else only_read)
    if point.form == "scaled" and point.decimals is not None:
        calls.append(f"DECIMALS({view.macro})")
    if point.code is not None:
        calls.append(f"CODE({c_string(point.code)})")
    for key, number in point.references.items():
        text = isinstance(number, str)
        literal = c_string(number) if isinstance(number, str) else signed(number)
        calls.append(f'REFERENCE{"_TEXT" if text else ""}("{key}", {literal})')
    return " ".join(f"FIELDSCRIBE_{call}" for call in calls)


def _conversions(point: Point, view: PointView, scope: HeaderScope) -> list[str]:
    function, kind, form = view.function, view.raw_type, view.shape
    if form in ("text", "digits"):
        return _of_parts(point, view)
    arguments = point.arguments
    everything = _with(point, arguments, scope)
    scale = _with(point, view.scale_arguments, scope)
    attempt = "TRY_" if view.special is not None or form == "ruled" else ""
    counted = "" if form == "plain" else "_count"
    scale_of = scaled(point, *_reach(point)) if form == "scaled" else None
    number = value_type(point) if form == "plain" else "int64_t" if scale_of is None else scale_of.count_type
    if form == "plain" and kind == "bool" and not attempt:
        number = "int32_t"
    cases = []
    if form != "float" and view.counts:
        if view.writable:
            cases.append(f"ENCODE_COUNT({function}_encode{counted}, {number}, {kind}, {everything})")
        if view.readable:
            tried = "TRY_" if scale_of is not None and scale_of.count_fits else attempt
            cases.append(f"{tried}DECODE_COUNT({function}_decode{counted}, {number}, {kind}, {scale})")
    if form != "plain":
        real = "double" if _is_double(point, scale_of) else "fieldscribe_real"
        if view.writable and view.encodes:
            cases.append(f"ENCODE({function}_encode, {real}, {kind}, {everything})")
        if view.readable:
            cases.append(f"{attempt}DECODE({function}_decode, {real}, {kind}, {scale})")
    return cases


def _reach(point: Point) -> tuple[int, int]:
    return encoded_limits(point) if point.specials else point.outer


def _is_double(point: Point, scale: Scaled | None) -> bool:
    if scale is not None:
        return scale.wide
    return point.form != "float" or point.info.bits == 64


def _of_parts(point: Point, view: PointView) -> list[str]:
    """The conversions of a point that is a text, or digits."""
    cases = []
    if point.text is not None:
        if view.readable:
            cases.append(f"TEXT_DECODE({view.function}, {view.macro})")
        if view.writable:
            cases.append(f"TEXT_ENCODE({view.function}, {view.macro})")
        return cases
    kind = "uint16_t"
    if view.readable:
        attempt = "TRY_" if view.special is not None else ""
        cases.append(f"{attempt}DIGITS({view.function}, {kind}, {view.macro})")
    if view.writable:
        cases.append(f"DIGITS_ENCODE({view.function}, {kind}, {view.macro})")
    return cases


def _with(point: Point, names: tuple[str, ...], scope: HeaderScope) -> str:
    if not names:
        return "FIELDSCRIBE_ALONE"
    if len(names) > 1:
        return f"FIELDSCRIBE_TOGETHER({_filler(point, names)})"
    return " ".join(f'FIELDSCRIBE_WITH("{name}", {raw_type(scope.points[name])})' for name in names)


def _filler(point: Point, names: tuple[str, ...]) -> str:
    ways = {point.arguments: "", point.scale_arguments: "_scale", point.limit_arguments: "_limits"}
    tail = "" if names == point.arguments else ways[names]
    return f"with_{point.item}{tail}"


def _structs(point: Point, scope: HeaderScope) -> Iterator[StructView]:
    """One for each set of raw numbers that some function of the point needs."""
    counts = point.decimals is not None
    integer = [point.limit_arguments] if point.writable else []
    integer += [point.arguments] if point.writable and counts else []
    integer += [point.scale_arguments] if point.readable and counts else []
    for names in dict.fromkeys((point.arguments, point.scale_arguments, point.limit_arguments)):
        if len(names) > 1:
            fields = tuple((name, f"{name}_raw", raw_type(scope.points[name])) for name in names)
            yield StructView(scope.struct(point), _filler(point, names), fields, floating=names not in integer)


def _truth(point: Point, view: PointView, name: str) -> str:
    """Whether the bit of a flag says that it is true, by the constants that a user has."""
    low = any(flag.width == 1 and not flag.active for flag in point.flags)
    turned = f" ^ {view.macro}_ACTIVE_LOW_MASK" if low else ""
    raw = f'({view.raw_type})fieldscribe_bits(v, "raw")'
    return f", ((({raw}){turned}) & {view.macro}_{upper(name)}_MASK) != 0U"


def _flag(view: PointView, name: str, width: int) -> str:
    raw = f'(({view.raw_type})fieldscribe_bits(v, "raw"))'
    if width > 1:
        return f"{view.function}_{name}{raw}"
    return f"({raw} & {view.macro}_{upper(name)}_MASK) != 0U"
