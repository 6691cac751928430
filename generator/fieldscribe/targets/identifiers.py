"""Names in generated code: each target lists all identifiers of a device, and their owners in the description."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple


class Owner(NamedTuple):
    """A thing in the description that has names in generated code: its kind, its own name, and what it is a part of.

    Kinds are `device`, `variant`, `group`, `command`, `message`, `telegram`, `exception`, `function`, `response`,
    `special codes` that many points share, `enum` with its parts (`entry`), and `point` (by item) with its own: `flag`
    and its `value`, special `code`, `old name`, `numbering`. A `struct` that points share without a name in the
    description is called by what it holds. What a target itself needs has the kind `target`, and its name is a
    description in words.
    """

    kind: str
    name: str
    of: Owner | None = None


Named = tuple[Owner, "Sequence[str]"]
"""A thing with its names, in a namespace that the context says."""


class Names(NamedTuple):
    """The names that a thing gets in one namespace of a target; `namespace` is worded as in messages.

    `significant` is how many characters of a name the language compares at least; None for all.
    """

    namespace: str
    owner: Owner
    names: Sequence[str]
    significant: int | None = None


class Clash(NamedTuple):
    """A name that two things would get."""

    namespace: str
    name: str
    first: Owner
    second: Owner


class Resemblance(NamedTuple):
    """Two names that are equal in their significant characters, with their owners."""

    significant: int
    names: tuple[str, str]
    first: Owner
    second: Owner


def clashes(listed: Iterable[Names]) -> Iterator[Clash]:
    """Yield each name that two things would both get in one namespace."""
    spaces: dict[str, dict[str, Owner]] = {}
    for namespace, owner, names, _ in listed:
        owners = spaces.setdefault(namespace, {})
        for name in names:
            first = owners.setdefault(name, owner)
            if first is not owner and first != owner:
                yield Clash(namespace, name, first, owner)


def resemblances(listed: Iterable[Names]) -> Iterator[Resemblance]:
    """Yield each two different names of a namespace that are equal in their significant characters.

    Old names are left out: a shorter new name is the remedy.
    """
    long: dict[tuple[str, str], tuple[str, Owner]] = {}
    for namespace, owner, names, significant in listed:
        for name in names if owner.kind != "old name" else ():
            if significant is not None and len(name) >= significant:
                first, of = long.setdefault((namespace, name[:significant]), (name, owner))
                if first != name:
                    yield Resemblance(significant, (first, name), of, owner)
