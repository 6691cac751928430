"""Names in generated code: each target lists all that a device gets in it, and what in the description each is of."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator


class Owner(NamedTuple):
    """What a name stands for: a `kind` of thing in the description, its name, and which `part` of it.

    Kinds are `point` (by item), `enum`, `command`, `group`, `code` of the bus, `message`, `telegram`, `variant`,
    `device`, and `target` for what generated code needs for itself.
    """

    kind: str
    name: str = ""
    part: str = ""

    def __str__(self) -> str:
        """As messages say it."""
        if self.kind == "target":
            return self.name or "what generated code needs itself"
        return f"the {self.part} of the {self.kind} `{self.name}`" if self.part else f"the {self.kind} `{self.name}`"


class Identifier(NamedTuple):
    """A name in a namespace of a target, and whose it is."""

    namespace: str
    name: str
    owner: Owner


class Clash(NamedTuple):
    """A name that two owners would get."""

    namespace: str
    name: str
    first: Owner
    second: Owner


def clashes(identifiers: Iterable[Identifier]) -> Iterator[Clash]:
    """Each name that two things would get in one namespace."""
    owners: dict[tuple[str, str], Owner] = {}
    for namespace, name, owner in identifiers:
        first = owners.setdefault((namespace, name), owner)
        if first != owner:
            yield Clash(namespace, name, first, owner)
