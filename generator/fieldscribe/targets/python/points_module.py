"""The view of the points module: an attribute for each point."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable

from fieldscribe.model import Command, Device, SteppedCommand
from fieldscribe.resources import Render
from fieldscribe.targets.python.attributes import Attributes, AttributeView, attribute_view
from fieldscribe.targets.python.device import RUNTIME, PythonFamily, in_python
from fieldscribe.targets.python.identifiers import Identifiers, scope_of, sorted_imports
from fieldscribe.targets.python.layout import DOC, WIDTH, comment, docstring, laid_out, leaf
from fieldscribe.targets.runtime_calls.class_facts import class_facts, commands_of, members, readable_groups
from fieldscribe.targets.runtime_calls.expressions import Call
from fieldscribe.targets.runtime_calls.point_expressions import NUMBERED, addresses_of
from fieldscribe.targets.runtime_calls.scope import Scope
from fieldscribe.text import python_doc, python_string
from fieldscribe.wording import label


def points_context(device: Device, names: Identifiers, render: Render) -> dict[str, object]:
    """Return the context of the points module: all points, group by group.

    `imports` are modules of the runtime with the names imported from each, `open_points` the lines about points whose
    type or scale the manual does not settle, `codes` the special codes that several points share. A group is its title
    and the text of its attributes.
    """
    family, scope = in_python(device), scope_of(device, names)
    scope.runtime("PointTable")
    attributes = Attributes(scope, render)
    titles = {group.name: comment(f"{group.name}: {group.title['en']}") for group in device.groups}
    groups = {group: list(map(attributes.of, found)) for group, found in members(device).items()}
    commands = "".join([attributes.text(_command(*command, scope)) for command in commands_of(scope)])
    profile, *facts = [laid_out(node, 4, f"{name}: ClassVar = ") for name, node in class_facts(scope).items()]
    return {
        "imports": _imports(scope.used - {"enums"}, family),
        "open_points": list(_open_points(device)),
        "uses_enums": "enums" in scope.used,
        "group_names": _group_names(readable_groups(device)),
        "profile": profile,
        "facts": facts,
        "groups": [(titles.get(group, comment(group)), "".join(texts)) for group, texts in groups.items() if texts],
        "commands": commands,
        "codes": [laid_out(codes, 0, f"{name} = ") for name, codes in scope.codes.items()],
    }


def _group_names(groups: tuple[str, ...]) -> str:
    """Return the type of the groups that can be read."""
    if not groups:
        return ""
    names = list(map(leaf, groups))
    line = f"Group = Literal[{', '.join(names)}]"
    return line if len(line) < WIDTH else "\n".join(["Group = Literal[", *(f"    {name}," for name in names), "]"])


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
        addresses = ", ".join(map(leaf, addresses_of(point.addresses, point.space)))
        text = f"- {label(point)}: {python_string(point.telegram or point.space)}, {addresses}{index}"
        yield from textwrap.wrap(
            python_doc(text), DOC, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
        )


def _command(command: Command | SteppedCommand, made: Call, scope: Scope) -> AttributeView:
    return attribute_view(scope.commands[command.name], made, docstring((_command_doc(command),)))


def _command_doc(command: Command | SteppedCommand) -> str:
    text = command.title["en"].rstrip(".") + "."
    if isinstance(command, Command) and command.wears:
        text += f" The memory stands {command.wears} of them."
    return python_doc(text)
