"""The view of the points module: an attribute for each point."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from fractions import Fraction

from fieldscribe.lowered import lower
from fieldscribe.model import Command, Device, Point, SteppedCommand, Variant
from fieldscribe.resources import Render
from fieldscribe.targets.python.attributes import BODY, Attributes, AttributeView, places
from fieldscribe.targets.python.device import RUNTIME, PythonFamily, in_python
from fieldscribe.targets.python.identifiers import (
    Identifiers,
    PackageScope,
    attribute,
    command_attributes,
    sorted_imports,
)
from fieldscribe.targets.python.layout import DOC, Group, Node, assigned, call, comment, docstring, laid_out
from fieldscribe.targets.python.point_expressions import NUMBERED, addresses_of, number, place_of_command, step_of
from fieldscribe.text import python_doc, python_string
from fieldscribe.wording import label


def points_context(device: Device, names: Identifiers, render: Render) -> dict[str, object]:
    """Return the context of the points module: all points, group by group.

    `imports` are modules of the runtime with the names imported from each, `open_points` the lines about points whose
    type or scale the manual does not settle, `codes` the special codes that several points share. A group is its title
    and the text of its attributes.
    """
    family = in_python(device)
    named = command_attributes(device)
    scope = PackageScope(names, lower(device), device.variants, named, {"PointTable"})
    attributes = Attributes(device, scope, render)
    titles = {group.name: comment(f"{group.name}: {group.title['en']}") for group in device.groups}
    groups: dict[str, list[str]] = {group: [] for group in titles}
    by_name: dict[str, dict[Variant, Point]] = {}
    for point in device.points:
        texts = groups.setdefault(point.terms.group, [])
        if not point.terms.generated:
            continue
        texts.append(attributes.of_point(point))
        if point.variant is not None:
            by_name.setdefault(point.name, {})[point.variant] = point
    for same in by_name.values():
        groups[next(iter(same.values())).group].append(attributes.by_variant(same))
    commands = "".join([attributes.text(command) for command in _commands(device, scope)])
    documented = tuple(_documented(point, scope) for point in device.points if not point.terms.generated)
    readable = dict.fromkeys(
        [python_string(point.group) for point in device.points if point.generated and point.readable]
    )
    profile, blocks, identifications = (
        family.profile(device, scope),
        family.blocks(device, scope),
        _identifications(device, scope),
    )
    bases = [laid_out(node, 4) for node in family.bases(device, scope)]
    return {
        "imports": _imports(scope.used - {"enums"}, family),
        "open_points": list(_open_points(device)),
        "uses_enums": "enums" in scope.used,
        "profile": laid_out(profile, 4),
        "group_names": "" if not readable else laid_out(assigned("Group", Group("Literal[", tuple(readable), "]")), 0),
        "blocks": "" if blocks is None else laid_out(blocks, 4),
        "bases": bases,
        "variants": laid_out(assigned("VARIANTS: ClassVar", _variants(device)), 4) if device.variants else "",
        "identifications": laid_out(assigned("IDENTIFICATIONS: ClassVar", identifications), 4)
        if device.identifications
        else "",
        "documented": laid_out(assigned("DOCUMENTED: ClassVar", Group("{", documented, "}")), 4) if documented else "",
        "groups": [(titles.get(group, comment(group)), "".join(texts)) for group, texts in groups.items() if texts],
        "commands": commands,
        "codes": [laid_out(special_codes, 0) for special_codes in scope.codes.values()],
    }


def _documented(point: Point, scope: PackageScope) -> Group:
    """Return why the point has no attribute, and the addresses of its words, if they can be reached."""
    index, addresses = "" if point.index is None else str(point.index), addresses_of(point.addresses, point.space)
    where = list(places(point, addresses, index, scope)) if point.raw_only else []
    why = python_string(point.reason or "no reason given")
    code = [f"code={python_string(point.code)}"] if point.code else []
    return call(f"{python_string(attribute(point.item))}: {scope.runtime('Documented')}", (why, *where, *code))


def _imports(used: set[str], family: PythonFamily) -> list[tuple[str, list[str]]]:
    """Return the used names by their modules, sorted for imports."""
    of_family = used & family.exports if family.module != RUNTIME else set()
    imports = [(RUNTIME, sorted_imports(used - of_family)), (family.module, sorted_imports(of_family))]
    return [(module, names) for module, names in imports if names]


def _open_points(device: Device) -> Iterable[str]:
    """Yield the lines of a list of points whose type or scale is open, with their wire addresses."""
    for point in device.points:
        if not point.raw_only:
            continue
        index = f", index={point.index}" if point.space in NUMBERED and point.index is not None else ""
        addresses = ", ".join(addresses_of(point.addresses, point.space))
        text = f"- {label(point)}: {python_string(point.telegram or point.space)}, {addresses}{index}"
        yield from textwrap.wrap(
            python_doc(text), DOC, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
        )


def _identifications(device: Device, scope: PackageScope) -> Group:
    """Return what identifies the device and its variants."""
    entries = []
    for identification in device.identifications:
        values = Group("(", (*map(str, identification.raws), *map(python_string, identification.texts)))
        variant = () if identification.variant is None else (identification.variant.axis, identification.variant.value)
        axis = (Group("(", tuple(map(python_string, variant))),) if variant else ()
        entries.append(call(scope.runtime("Identification"), (python_string(identification.point), values, *axis)))
    return Group("(", tuple(entries))


def _variants(device: Device) -> Group:
    """Return the values of each variant axis."""
    entries = [
        Group(f"{python_string(axis)}: (", tuple(map(python_string, values)))
        for axis, values in device.variants.items()
    ]
    return Group("{", tuple(entries), "}")


def _commands(device: Device, scope: PackageScope) -> Iterable[AttributeView]:
    """Yield the attributes of the commands."""
    for command in device.commands:
        where = laid_out(place_of_command(command, scope), BODY)
        value = () if command.value is None else (f"value={command.value}",)
        yield _attribute(command, "Command", (where, *value), scope)
    for stepped in device.stepped_commands:
        yield _attribute(stepped, "SteppedCommand", [laid_out(node, BODY) for node in _steps(stepped, scope)], scope)


def _steps(command: SteppedCommand, scope: PackageScope) -> Iterable[Node]:
    """Yield the arguments of a command with steps."""
    yield from [step_of(step, scope) for step in command.steps]
    if command.arguments:
        ends = [f"{python_string(argument)}: ({low}, {high})" for argument, (low, high) in command.arguments.items()]
        yield Group("arguments={", tuple(ends), "}")
    if command.run in ("first", "before write"):
        yield f"run={python_string(command.run)}"
    if command.every is not None:
        yield f"every={number(Fraction(command.every, 1000), binary=True)}"


def _attribute(
    command: Command | SteppedCommand, maker: str, arguments: Iterable[str], scope: PackageScope
) -> AttributeView:
    name, doc = scope.commands[command.name], docstring((_command_doc(command),))
    return AttributeView(name, scope.runtime(maker), tuple(arguments), doc)


def _command_doc(command: Command | SteppedCommand) -> str:
    text = command.title["en"].rstrip(".") + "."
    if isinstance(command, Command) and command.wears:
        text += f" The memory stands {command.wears} of them."
    return python_doc(text)
