"""Names in generated code: each target lists all that a device gets in it, and what in the description each is of."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence


class Owner(NamedTuple):
    """A thing in the description that names stand for: its kind, its name there, and the thing that it is a part of.

    Kinds are `device`, `variant`, `group`, `command`, `message`, `telegram`, `exception`, `function`, `response`,
    `special codes` that many points share, `enum` with its parts (`entry`), and `point` (by item) with its own: `flag`
    and its `value`, special `code`, `old name`, `numbering`. What a target needs for itself is of the kind `target`,
    and its name says in words what it is.
    """

    kind: str
    name: str
    of: Owner | None = None


Named = tuple[Owner, "Sequence[str]"]
"""A thing with names in a namespace that is told before."""


class Names(NamedTuple):
    """The names that a thing gets in one namespace of a target, which is told as messages say it."""

    namespace: str
    owner: Owner
    names: Sequence[str]


class Clash(NamedTuple):
    """A name that two things would get."""

    namespace: str
    name: str
    first: Owner
    second: Owner


def clashes(listed: Iterable[Names]) -> Iterator[Clash]:
    """Each name that two things would get in one namespace."""
    spaces: dict[str, dict[str, Owner]] = {}
    for namespace, owner, names in listed:
        owners = spaces.setdefault(namespace, {})
        for name in names:
            first = owners.setdefault(name, owner)
            if first is not owner and first != owner:
                yield Clash(namespace, name, first, owner)
