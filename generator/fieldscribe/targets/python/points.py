"""The view of the points module: an attribute for each point."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from fieldscribe.lowered import lower
from fieldscribe.targets.python.commands import commands, variants
from fieldscribe.targets.python.existence import only_for, uncertain
from fieldscribe.targets.python.families import RUNTIME, PythonFamily, in_python
from fieldscribe.targets.python.forms import NUMBERED, allowed, form, number, place
from fieldscribe.targets.python.identifiers import Identifiers, attribute, sorted_imports
from fieldscribe.targets.python.layout import WIDTH, Group, Node, assigned, call, comment, docstring, laid_out
from fieldscribe.targets.python.scope import PackageScope
from fieldscribe.text import python_doc, python_string
from fieldscribe.wording import codes_text, condition_text, range_text

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping

    from fieldscribe.model import Device, Point, Variant

_DOC = WIDTH - 4 - 6  # less the indentation and two triple quotes
_BODY = 8  # the indentation of an attribute's arguments


@dataclass(frozen=True, slots=True)
class PointView:
    """An attribute: its name, the function that makes it, its arguments and docstring by lines, its old names."""

    name: str
    maker: str
    arguments: tuple[str, ...]
    doc: tuple[str, ...]
    old_names: tuple[str, ...]

    @property
    def docstring(self) -> tuple[str, ...]:
        """The lines of the docstring."""
        return docstring(self.doc)


@dataclass(slots=True)
class GroupView:
    """The points of one group."""

    title: str
    points: list[PointView] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class PointsView:
    """The points module.

    `imports` are modules of the runtime with the names imported from each, `open_points` the lines about points whose
    type or scale the manual does not settle, `codes` the special codes that several points share.
    """

    imports: list[tuple[str, list[str]]]
    open_points: tuple[str, ...]
    uses_enums: bool
    profile: str
    blocks: str
    variants: str
    documented: str
    groups: list[GroupView]
    commands: tuple[PointView, ...]
    codes: tuple[str, ...]


def points_view(device: Device, names: Identifiers) -> PointsView:
    """All points, group by group."""
    family = in_python(device)
    scope = PackageScope(names, lower(device), device.variants, {"PointTable"})
    errata = frozenset([erratum.id for erratum in device.errata if erratum.facts])
    groups = {group.name: GroupView(comment(f"{group.name}: {group.title['en']}")) for group in device.groups}
    by_name: dict[str, dict[Variant, Point]] = {}
    for point in device.points:
        group = groups.setdefault(point.group, GroupView(comment(point.group)))
        if not point.generated:
            continue
        group.points.append(_point(point, family, scope, errata))
        if point.variant is not None:
            by_name.setdefault(point.name, {})[point.variant] = point
    for same in by_name.values():
        groups[next(iter(same.values())).group].points.append(_by_variant(same, scope))
    command_views = tuple(PointView(*command, ()) for command in commands(device, scope))
    documented = tuple(_documented(point, scope) for point in device.points if not point.generated)
    profile, blocks = family.profile(device, scope), family.blocks(device, scope)
    return PointsView(
        imports=_imports(scope.used - {"enums"}, family),
        open_points=tuple(_open_points(device)),
        uses_enums="enums" in scope.used,
        profile=laid_out(profile, 4),
        blocks="" if blocks is None else laid_out(blocks, 4),
        variants=laid_out(assigned("VARIANTS: ClassVar", variants(device)), 4) if device.variants else "",
        documented=laid_out(assigned("DOCUMENTED: ClassVar", Group("{", documented, "}")), 4) if documented else "",
        groups=[group for group in groups.values() if group.points],
        commands=command_views,
        codes=tuple(laid_out(special_codes, 0) for special_codes in scope.codes.values()),
    )


def _documented(point: Point, scope: PackageScope) -> Group:
    """Why the point has no attribute, and the addresses of its words, if they can be reached."""
    scope.used.add("Documented")
    where = list(_at(point, scope)) if point.raw_only else []
    why = python_string(point.reason or "no reason given")
    code = [f"code={python_string(point.code)}"] if point.code else []
    return call(f"{python_string(attribute(point.item))}: Documented", (why, *where, *code))


def _at(point: Point, scope: PackageScope) -> Iterator[Node]:
    """Where the point is read, and where else it is written."""
    yield place("at", point, point.addresses, scope)
    if point.write_place is not None:
        yield place("write_at", point, point.write_place.addresses, scope)


def _imports(used: set[str], family: PythonFamily) -> list[tuple[str, list[str]]]:
    """The used names by their modules, sorted for imports."""
    of_family = used & family.exports if family.module != RUNTIME else set()
    imports = [(RUNTIME, sorted_imports(used - of_family)), (family.module, sorted_imports(of_family))]
    return [(module, names) for module, names in imports if names]


def _point(point: Point, family: PythonFamily, scope: PackageScope, errata: Collection[str]) -> PointView:
    maker = family.maker(point)
    scope.used.add(maker)
    old_names = tuple(map(attribute, point.was)) if point.variant is None else ()
    if old_names:
        scope.used.add("renamed")
    arguments = tuple([laid_out(argument, _BODY) for argument in _arguments(point, scope)])
    return PointView(attribute(point.item), maker, arguments, _doc(point, errata, scope.lowered.points), old_names)


def _arguments(point: Point, scope: PackageScope) -> list[Node]:
    arguments = [form(point, scope), *_places(point, scope), *_shown(point)]
    if (limits := allowed(point, scope)) is not None:
        arguments.append(limits)
    if point.default is not None:
        arguments.append(f"default={number(point.default)}")
    if point.fixed is not None:
        arguments.append(f"fixed=(0x{point.fixed.mask:04X}, 0x{point.fixed.bits:04X})")
    if point.changes in ("never", "rarely"):
        arguments.append(f"changes={python_string(point.changes)}")
    if point.changes_with:
        arguments.append(Group("changes_with=(", tuple([python_string(name) for name in point.changes_with])))
    if point.variant is not None:
        axis_and_value = (python_string(point.variant.axis), python_string(point.variant.value))
        arguments.append(Group("variant=(", axis_and_value))
        arguments.append(f"name={python_string(point.name)}")
    if choice := only_for(point, scope.variants):
        values = Group("(", tuple([python_string(value) for value in choice[1]]))
        arguments.append(Group("only_for=(", (python_string(choice[0]), values)))
    if uncertain(point, scope.variants):
        arguments.append("uncertain=True")
    return arguments


def _shown(point: Point) -> Iterator[str]:
    """What stands behind a value, and with how many decimals people see it."""
    if point.unit.symbol:
        yield f"unit={python_string(point.unit.symbol)}"
    if point.display is not None:
        yield f"display={point.display}"


def _places(point: Point, scope: PackageScope) -> list[Node]:
    """The arguments for the places of the point, on the wire and in the manual."""
    arguments: list[Node] = list(_at(point, scope))
    if point.bits is not None:
        arguments.append(f"bits=({point.bits[0]}, {point.bits[1]})")
    arguments.append(f"group={python_string(point.group)}")
    if point.code:
        arguments.append(f"code={python_string(point.code)}")
    if point.references:
        arguments.append(_references(point))
    return arguments


def _references(point: Point) -> Group:
    """The manual's other numberings of the point, as literals by name."""
    pairs = [
        f'"{key}": {python_string(number) if isinstance(number, str) else number}'
        for key, number in point.references.items()
    ]
    return Group("references={", tuple(pairs), "}")


def _by_variant(points: Mapping[Variant, Point], scope: PackageScope) -> PointView:
    scope.used.add("ByVariant")
    variant, first = next(iter(points.items()))
    chosen = [f"{python_string(variant.value)}: {attribute(point.item)}" for variant, point in points.items()]
    old_names = tuple(dict.fromkeys(name for point in points.values() for name in point.was))
    if old_names:
        scope.used.add("renamed")
    arguments = (python_string(variant.axis), laid_out(Group("{", tuple(chosen), "}"), _BODY))
    doc = _wrapped(python_doc(f"{first.title['en']}, as the device's {variant.axis} has it."))
    return PointView(attribute(first.name), "ByVariant", arguments, tuple(doc), old_names)


def _doc(point: Point, errata: Collection[str], by_name: Mapping[str, Point]) -> tuple[str, ...]:
    limits = range_text(point, by_name) if point.writable and point.form in ("scaled", "float", "integer") else ""
    first = f"{point.title['en']}: {limits}" if limits else point.title["en"]
    first = first if first.endswith(".") else f"{first}."
    if point.when is not None:
        first += f" Exists only when {condition_text(point.when, by_name)}."
    if point.conditions and point.writable:
        first += f" To write it takes: {', '.join(condition.replace('_', ' ') for condition in point.conditions)}."
    if point.specials:
        first += f" {codes_text(point)}."
    lines = _wrapped(python_doc(first))
    if changing := [erratum for erratum in point.errata if erratum in errata]:
        lines += ("", *_wrapped(f"Errata: {', '.join(changing)}."))
    return tuple(lines)


def _wrapped(text: str) -> list[str]:
    """The lines of a docstring below an attribute."""
    return [text] if len(text) <= _DOC else textwrap.wrap(text, _DOC, break_long_words=False, break_on_hyphens=False)


def _labelled(point: Point) -> str:
    return f"{point.code} {point.item}" if point.code else point.item


def _open_points(device: Device) -> Iterable[str]:
    """The lines of a list of points whose type or scale is open, with their wire addresses."""
    for point in device.points:
        if not point.raw_only:
            continue
        numbered = point.space in NUMBERED
        where = ", ".join(str(address) if numbered else f"0x{address:04X}" for address in point.addresses)
        index = f", index={point.index}" if numbered and point.index is not None else ""
        text = f"- {_labelled(point)}: {python_string(point.telegram or point.space)}, {where}{index}"
        yield from _indented(python_doc(text))


def _indented(text: str) -> list[str]:
    """The lines of an item of a list; those after the first are indented."""
    return textwrap.wrap(text, _DOC, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)
