"""The names in generated code that a difference touches: what the targets list as identifiers of its thing."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from fieldscribe.code_view import for_code
from fieldscribe.targets import TARGETS, knows, target

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from fieldscribe.model import Device
    from fieldscribe.targets.identifiers import Owner


class Symbols:
    """The identifiers of a device by language and owner; they are listed when something first asks."""

    def __init__(self, device: Device) -> None:
        self._device = device

    def of(self, owners: Iterable[Owner]) -> dict[str, list[str]]:
        """The names of things in each language."""
        owners = tuple(owners)
        return {
            language: [name for owner in owners for name in names.get(owner, ())]
            for language, names in self._listed.items()
        }

    @cached_property
    def _listed(self) -> Mapping[str, Mapping[Owner, Mapping[str, None]]]:
        plain = for_code(self._device)
        listed = {name: _names(name, plain) for name in TARGETS if knows(name, plain)}
        return {name: names for name, names in listed.items() if names}


def _names(name: str, plain: Device) -> Mapping[Owner, Mapping[str, None]]:
    """All names of a language by owner, each once, in the order of the listing."""
    by_owner: dict[Owner, dict[str, None]] = {}
    for _, owner, names in target(name).identifiers(plain):
        if owner.kind != "target":
            by_owner.setdefault(owner, {}).update(dict.fromkeys(names))
    return by_owner
