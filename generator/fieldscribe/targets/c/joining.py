"""Headers in one file: each after those that it includes, whose `#include` is left out."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from fieldscribe.targets.c.device import head_lines

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Device

_INCLUDE = re.compile(r'^#include "([^"\n]+)".*\n', re.MULTILINE)


def joined(files: Mapping[str, str], device: Device) -> str:
    """One text of a device's headers, by name, below a head of its own."""
    order: dict[str, None] = {}

    def place(name: str) -> None:
        for included in _INCLUDE.findall(files[name]):
            if included in files and included not in order:
                place(included)
        order[name] = None

    for name in files:
        if name not in order:
            place(name)
    head = "".join(f" * {line}\n" for line in (*head_lines(device), "", f"All in one file: {', '.join(order)}."))
    return f"/*\n{head} */\n".replace(" * \n", " *\n") + "".join(f"\n{_alone(files[name], files)}" for name in order)


def _alone(text: str, files: Mapping[str, str]) -> str:
    """A header without the `#include` of what stands above it."""
    return _INCLUDE.sub(lambda match: "" if match[1] in files else match[0], text)
