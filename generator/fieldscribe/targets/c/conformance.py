"""The conformance program of a device: its view, and the macros by which each point answers vectors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.names import upper
from fieldscribe.targets.c.conversions import value_type
from fieldscribe.targets.c.declarations import shares_values
from fieldscribe.targets.c.frames import frames_of
from fieldscribe.targets.c.header import STATUSES
from fieldscribe.targets.c.layout import folded
from fieldscribe.targets.c.literals import raw_type
from fieldscribe.targets.c.point_templates import TemplateTexts
from fieldscribe.targets.c.point_views import named_numbers, names_of
from fieldscribe.targets.c.special_codes import special_defines

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence

    from fieldscribe.model import Code, Device, Point
    from fieldscribe.render import Render
    from fieldscribe.targets.c.frames import Frames
    from fieldscribe.targets.c.point_templates import GeneratedPoint, PointTemplate
    from fieldscribe.targets.c.scales import Scaled
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import PointView


@dataclass(frozen=True, slots=True)
class StructView:
    """A function that fills the struct of a point with the raw numbers given in a vector.

    `floating` says that only functions with floating point need it.
    """

    type: str
    function: str
    fields: tuple[tuple[str, str, str], ...]
    floating: bool


@dataclass(frozen=True, slots=True)
class SuiteView:
    """The conformance program of a device."""

    structs: tuple[StructView, ...]
    items: tuple[str, ...]
    """The points, each of which has a function that answers vectors."""
    statuses: tuple[tuple[str, str], ...]
    family: str
    groups: tuple[tuple[str, str], ...]
    codes: tuple[tuple[str, str, str], ...]
    names: tuple[str, ...]
    """The kinds of codes for which a function gives the name."""
    commands: tuple[tuple[str, str, str], ...]
    documented: tuple[tuple[str, str, str, bool], ...]
    """Points that are reached raw only: item, space, the prefix of their macros, and whether they have an index."""
    telegrams: tuple[str, ...]


def conformance_view(device: Device, points: Sequence[GeneratedPoint], scope: HeaderScope) -> SuiteView:
    """Return the view of `<device>_conformance.c`."""
    named = frames_of(device).NAMED_CODES
    groups = ((group, f"{scope.prefix}_{group}_blocks") for group, blocks in device.blocks.items() if blocks)
    dependent = (point for point, template, _ in points if template.view.takes_others)
    return SuiteView(
        structs=tuple(struct for point in dependent for struct in structs_of(point, scope)),
        items=tuple([each.point.item for each in points]),
        statuses=tuple((f"{scope.upper}_{status}", status.lower()) for status in STATUSES),
        family=device.family,
        groups=tuple(groups),
        codes=tuple(_codes(device, scope)),
        documented=tuple(
            (point.item, point.space, f"{scope.upper}_{upper(point.item)}", point.index is not None)
            for point in device.points
            if not point.generated and point.raw_only
        ),
        names=tuple(kind for kind, codes in _code_kinds(device) if codes and kind in named),
        commands=tuple(
            (
                command.name,
                f"{scope.prefix}_command_{command.name}",
                f"{scope.upper}_COMMAND_{upper(command.name)}_VALUE",
            )
            for command in device.commands
        ),
        telegrams=tuple(telegram.name for telegram in device.telegrams),
    )


def adapters_text(
    points: Iterable[GeneratedPoint], scope: HeaderScope, sections: Collection[Frames], render: Render
) -> str:
    """Return the functions of points that answer vectors."""
    adapters = TemplateTexts(lambda template: _adapter(template, scope, sections, render))
    return "".join(map(adapters.of, points))


def _adapter(template: PointTemplate, scope: HeaderScope, sections: Iterable[Frames], render: Render) -> str:
    of_family = [case for frames in sections for case in frames.cases(template)]
    view = template.view
    cases = [*_all_cases(template.point, view, scope), *of_family, *_flag_cases(template.point, view)]
    cases += _special_code_cases(template.point, view, scope)
    return folded(render("c/adapter.c.j2", {"item": view.fields.item, "cases": cases}))


def _code_kinds(device: Device) -> tuple[tuple[str, tuple[Code, ...]], ...]:
    emitted = (codes for codes in family(device.family).codes if codes.emitted)
    return tuple((codes.kind, device.bus.codes(codes.section)) for codes in emitted)


def _codes(device: Device, scope: HeaderScope) -> Iterator[tuple[str, str, str]]:
    """Yield the kind, name and enumerator of each number of the protocol that has one."""
    for kind, codes in _code_kinds(device):
        for code in codes:
            yield kind, code.name, f"{scope.upper}_{upper(kind)}_{upper(code.name)}"


def _all_cases(point: Point, view: PointView, scope: HeaderScope) -> list[str]:
    """Return the macros for the point as a whole."""
    function, kind = view.function, view.raw_type
    cases = [f"ADDRESS({view.macro}, {_address_answers(point, view)})"] if point.address is not None else []
    if view.writable and view.shape != "text":
        cases.append(f"CHECK({function}_check, {kind}, {_arguments_of(point, view.limit_arguments, scope)})")
    cases += _conversion_cases(point, view, scope)
    enum = named_numbers(point)
    if enum is not None:
        name, macro = names_of(point, view.fields)
        cases.append(f"NAME({scope.prefix}_{name}_name, {value_type(point)})")
        constant = f"{scope.upper}_{macro}"
        first = {entry.raw: entry.name for entry in reversed(enum.entries)}
        cases += [f'NAMED("{name}", {constant}_{upper(name)})' for name in first.values()]
    cases += _place_cases(point, view)
    if point.text is not None:
        return cases
    if view.bits:
        cases.append(f"BITS({function}, {kind}, {view.macro})")
    elif view.splits:
        cases.append(f"WORDS({function}, {kind}, {point.words}U)")
    else:
        cases.append(f"ONE_WORD({kind})")
    return cases


def _address_answers(point: Point, view: PointView) -> str:
    """Return the answers with the facts beside the address: space, limits, decimals, code, references."""
    calls = [
        f'SPACE("{point.space}")',
        f"{'SEVERAL' if point.words > 1 or point.text is not None else 'ONE'}({view.macro})",
    ]
    if view.shape not in ("float", "text", "digits"):
        only_read = f"ONLY_READ({view.fields.low_signed}, {view.fields.high_signed})"
        calls.append(f"RAWS({view.macro})" if point.writable else only_read)
    if point.form == "scaled" and point.decimals is not None:
        calls.append(f"DECIMALS({view.macro})")
    if point.code is not None:
        calls.append(f"CODE({view.fields.code})")
    for (key, number), literal in zip(point.references.items(), view.fields.references, strict=True):
        calls.append(f'REFERENCE{"_TEXT" if isinstance(number, str) else ""}("{key}", {literal})')
    return " ".join(f"FIELDSCRIBE_{call}" for call in calls)


def _conversion_cases(point: Point, view: PointView, scope: HeaderScope) -> list[str]:
    function, kind, form = view.function, view.raw_type, view.shape
    if form in ("text", "digits"):
        return _text_or_digits_cases(point, view)
    arguments = point.arguments
    everything = _arguments_of(point, arguments, scope)
    scale = _arguments_of(point, view.scale_arguments, scope)
    attempt = "TRY_" if view.special is not None or form == "ruled" else ""
    counted = "" if form == "plain" else "_count"
    scale_of = view.scale
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


def _is_double(point: Point, scale: Scaled | None) -> bool:
    if scale is not None:
        return scale.wide
    return point.form != "float" or point.info.bits == 64


def _text_or_digits_cases(point: Point, view: PointView) -> list[str]:
    """Return the macros for the conversions of a text, or of digits."""
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


def _place_cases(point: Point, view: PointView) -> list[str]:
    """Return the macros for its places and the constant bits of its word."""
    cases = []
    if point.write_place is not None:
        cases.append(f"WRITE_ADDRESS({view.macro})")
    if point.fixed is not None:
        cases.append(f"FIXED({view.macro})")
    if point.display is not None:
        cases.append(f"DISPLAY({view.macro})")
    if point.text is not None:
        cases.append(f"PLACE_OF_TEXT({view.macro}, {view.function}, {_index_and_telegram(point, view)})")
    elif point.place.addresses and (point.index is not None or point.telegram is not None):
        first = min(point.place.addresses)
        words = [f"FIELDSCRIBE_PLACED({view.macro}, {address - first}U)" for address in point.place.addresses]
        cases.append(f"PLACE({' '.join(words)}, {_index_and_telegram(point, view)})")
    return cases


def _index_and_telegram(point: Point, view: PointView) -> str:
    """Return the answers with the index and the telegram, as far as the point has them."""
    calls = [f"FIELDSCRIBE_INDEX({view.macro})"] if point.index is not None else []
    calls += [f"FIELDSCRIBE_TELEGRAM({view.macro})"] if point.telegram is not None else []
    return " ".join(calls)


def _flag_cases(point: Point, view: PointView) -> Iterator[str]:
    """Yield the macros for flags, and for the named numbers of flags of several bits."""
    for flag in point.flags:
        number = _flag_number(view, flag.name, flag.width)
        if flag.width == 1:
            yield f'TRUTH("{flag.name}", {number}{_truth_test(point, view, flag.name)})'
        else:
            yield f'WIDE_FLAG("{flag.name}", {number}, {view.macro}_{upper(flag.name)})'
        for entry in flag.values if flag.width > 1 else ():
            of = view.macro if shares_values(point) else f"{view.macro}_{upper(flag.name)}"
            constant = f"{of}_{upper(entry.name)}"
            yield f'FLAG_NAME("{flag.name}", "{entry.name}", {constant})'


def _truth_test(point: Point, view: PointView, name: str) -> str:
    """Return a test whether a flag is true, made of the macros that users of the header have."""
    low = any(flag.width == 1 and not flag.active for flag in point.flags)
    turned = f" ^ {view.macro}_ACTIVE_LOW_MASK" if low else ""
    raw = f'({view.raw_type})fieldscribe_bits(v, "raw")'
    return f", ((({raw}){turned}) & {view.macro}_{upper(name)}_MASK) != 0U"


def _flag_number(view: PointView, name: str, width: int) -> str:
    raw = f'(({view.raw_type})fieldscribe_bits(v, "raw"))'
    if width > 1:
        return f"{view.function}_{name}{raw}"
    return f"({raw} & {view.macro}_{upper(name)}_MASK) != 0U"


def _special_code_cases(point: Point, view: PointView, scope: HeaderScope) -> Iterator[str]:
    """Yield the macros for special codes."""
    for special in point.specials:
        (first, _), (last, _) = special_defines(
            special, f"{scope.upper}_{upper(point.shared_codes) or view.fields.macro}", point
        )
        yield f'SPECIAL("{special.name}", {first}, {last})'
    if point.specials:
        yield f"SPECIAL_NAME({view.function}, {view.raw_type})"


def structs_of(point: Point, scope: HeaderScope) -> Iterator[StructView]:
    """Yield a function for each set of several raw numbers that some function of the point needs."""
    counts = point.decimals is not None
    integer = [point.limit_arguments] if point.writable else []
    integer += [point.arguments] if point.writable and counts else []
    integer += [point.scale_arguments] if point.readable and counts else []
    for names in dict.fromkeys((point.arguments, point.scale_arguments, point.limit_arguments)):
        if len(names) > 1:
            fields = tuple((name, f"{name}_raw", raw_type(scope.points[name])) for name in names)
            yield StructView(
                scope.struct(point.arguments), _fill_function(point, names), fields, floating=names not in integer
            )


def _arguments_of(point: Point, names: tuple[str, ...], scope: HeaderScope) -> str:
    if not names:
        return "FIELDSCRIBE_ALONE"
    if len(names) > 1:
        return f"FIELDSCRIBE_TOGETHER({_fill_function(point, names)})"
    return " ".join(f'FIELDSCRIBE_WITH("{name}", {raw_type(scope.points[name])})' for name in names)


def _fill_function(point: Point, names: tuple[str, ...]) -> str:
    ways = {point.arguments: "", point.scale_arguments: "_scale", point.limit_arguments: "_limits"}
    tail = "" if names == point.arguments else ways[names]
    return f"with_{point.item}{tail}"
