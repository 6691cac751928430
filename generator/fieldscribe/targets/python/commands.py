"""The named constant writes, as attributes of the device class, and the values of variants."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.python.attributes import BODY, AttributeView
from fieldscribe.targets.python.forms import place_of_command
from fieldscribe.targets.python.identifiers import command_attributes
from fieldscribe.targets.python.layout import Group, docstring, laid_out
from fieldscribe.text import python_doc, python_string

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.model import Command, Device
    from fieldscribe.targets.python.scope import PackageScope


def variants(device: Device) -> Group:
    """The values of each variant axis."""
    entries = [
        Group(f"{python_string(axis)}: (", tuple(map(python_string, values)))
        for axis, values in device.variants.items()
    ]
    return Group("{", tuple(entries), "}")


def commands(device: Device, scope: PackageScope) -> Iterable[AttributeView]:
    """The attributes of the commands."""
    for command, name in command_attributes(device):
        scope.used.add("Command")
        where = place_of_command(command, scope)
        value = () if command.value is None else (f"value={command.value}",)
        doc = "\n".join(docstring((_command_doc(command),)))
        yield AttributeView(name, "Command", (laid_out(where, BODY), *value), doc)


def _command_doc(command: Command) -> str:
    text = command.title["en"].rstrip(".") + "."
    if command.wears:
        text += f" The memory stands {command.wears} of them."
    return python_doc(text)
