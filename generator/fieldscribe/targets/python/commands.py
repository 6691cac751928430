"""Named constant writes, as attributes of the generated class, and the values of variants."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.model import Command, Device, Place
from fieldscribe.targets.python.forms import place
from fieldscribe.targets.python.identifiers import command_attributes
from fieldscribe.targets.python.layout import Group, laid_out
from fieldscribe.text import python_doc, python_string

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.targets.python.scope import PackageScope


def variants(device: Device) -> Group:
    """The values of each variant axis."""
    made = [
        Group(f"{python_string(axis)}: (", tuple(map(python_string, values)))
        for axis, values in device.variants.items()
    ]
    return Group("{", tuple(made), "}")


def commands(device: Device, scope: PackageScope) -> Iterable[tuple[str, str, tuple[str, ...], tuple[str, ...]]]:
    """Each command: its attribute, what makes it, the arguments and the docstring."""
    for one, name in command_attributes(device):
        scope.used.add("Command")
        where = place("at", Place("write", one.space, (one.address,), one.function), scope)
        value = () if one.value is None else (f"value={one.value}",)
        yield name, "Command", (laid_out(where, 8), *value), (_command_doc(one),)


def _command_doc(command: Command) -> str:
    text = command.title["en"].rstrip(".") + "."
    if command.wears:
        text += f" The memory stands {command.wears} of them."
    return python_doc(text)
