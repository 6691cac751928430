"""The shape of the table of facts: what a thing says, how grave a difference in it is, and what its parts are."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from operator import itemgetter
from typing import Any, NamedTuple, TypeAlias

from fieldscribe.differences.classes import API, COMPATIBLE

Exported: TypeAlias = Mapping[str, Any]
"""A device, or a thing of it, as the exported model says it."""

Weight: TypeAlias = "str | Callable[[Any, Any], str]"
"""A class, or what tells it from the old and the new value."""


class UnfitError(Exception):
    """An argument means nothing that can be compared: what is wrong, and what to do about it."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message, self.hint = message, hint


class Fact(NamedTuple):
    """A fact: its class, its value in the exported thing, and the keys of the contract that say it.

    A difference in it is not told where one of the facts that it `follows` differs, too. `refers` is the kind of things
    that its value names: things that have another name now are no difference, and in lists those that came or went.
    """

    weight: Weight
    value: Callable[[Exported], Any]
    keys: tuple[str, ...]
    follows: tuple[str, ...] = ()
    refers: str = ""


class Parts(NamedTuple):
    """Named parts of a thing. Two are the same by name, or where they alone have equal facts of `alike`.

    `whole` is the class where all parts come or go at once; empty where each of them is told then, too. `shown` is what
    is told of a part that came or went, if not its name; `in_code` is the class of a fact of a part that both sides
    have, given the part on both sides, the fact (empty for parts of it) and its usual class.
    """

    kind: str
    listed: Callable[[Exported], Iterable[Exported]]
    facts: Mapping[str, Fact | Parts]
    keys: tuple[str, ...]
    alike: tuple[str | Fact, ...] = ()
    added: Weight = COMPATIBLE
    removed: Weight = API
    renamed: Weight = API
    whole: str = ""
    shown: Callable[[Exported], Any] = itemgetter("name")
    in_code: Callable[[Exported, Exported, str, str], str] = lambda _old, _new, _fact, weight: weight


Table: TypeAlias = Mapping[str, Fact | Parts]


def said(key: str, weight: Weight, *follows: str, refers: str = "") -> Fact:
    """A fact that is one key of the contract."""
    return Fact(weight, itemgetter(key), (key,), follows, refers)
