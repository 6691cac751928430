"""Flags of words."""

from __future__ import annotations

import enum
import functools
import operator
from collections.abc import Mapping
from typing import Any

from support.vector_file import Vector

from conformance.package import Check, Package


def _of(word: Any, name: str) -> Any:
    """A flag of a word; a plain name that is a keyword or one of int's own has an underscore behind it."""
    found = getattr(word, name, None)
    return found if hasattr(found, "number") else getattr(word, f"{name}_")


def flag(package: Package, vector: Vector) -> bool:
    """A flag on a word, and a word with that flag alone."""
    word = package.point(vector).names
    one = _of(word, vector["flag"])
    bits = word.__members__.get(vector["flag"].upper())
    held = bits is None or bool(int(bits) & vector["raw"]) == bool(vector["number"])
    if hasattr(word, "of"):
        held = held and _made(package, vector, word, one)
    if vector["truth"] is not None:
        held = held and int(one.__get__(word(vector["raw"]), word)) == vector["truth"] and _told(vector, word)
    _widen(package, vector, one)
    plain = issubclass(word, enum.IntFlag) and one.__get__(None, word) is one
    return bool(held and plain and one.number(vector["raw"]) == vector["number"])


def _told(vector: Vector, word: Any) -> bool:
    """Whether the word is shown with the names that are true, and with its number where one asks for it."""
    shown = word(vector["raw"])
    number = f"0x{int(shown):04X}"
    names = str(shown).removeprefix(number).strip(" ()").split(", ")
    listed = any(name.rstrip("_") == vector["flag"] for name in names) == bool(vector["truth"])
    ways = repr(shown) == f"<{word.__name__} {shown}>" and f"{shown:d}" == str(int(shown)) and f"{shown}" == str(shown)
    return listed and ways and str(shown).startswith(number) and (str(shown) == number) == (names == [""])


def _widen(package: Package, vector: Vector, one: Any) -> None:
    """Remembers the largest number that a vector has for a flag: what holds no larger one is as wide as that."""
    key = vector["point"], vector["flag"]
    seen, _ = package.widest.get(key, (0, one))
    package.widest[key] = max(seen, vector["number"]), one


def check_widths(package: Package) -> None:
    """No flag is wider than the largest number that there is for it."""
    wide = [key for key, (largest, one) in package.widest.items() if one.width != max(1, largest.bit_length())]
    assert not wide, f"wider or narrower than their numbers: {wide}"


def flag_name(package: Package, vector: Vector) -> bool:
    """The name of a number of several bits."""
    word = package.point(vector).names
    one = _of(word, vector["flag"])
    member = one.names(vector["raw"])
    on_word = one.__get__(word(one.place(vector["raw"])), word)
    told = one.told("flag", one.place(vector["raw"])) == f"flag={vector['name']}"
    plain = not issubclass(one.names, enum.Flag)
    return bool(plain and told and member is on_word and member.name.lower() == vector["name"])


def _made(package: Package, vector: Vector, word: Any, flag: Any) -> bool:
    """Whether a word made of this flag alone says so, and one made of nothing has only constant bits beside."""
    mask, constant = package.point(vector).facts.fixed or (0, 0)
    named = functools.reduce(operator.or_, map(int, word.__members__.values()), 0)
    nothing = int(word.of())
    if nothing & ~named != constant & ~named:
        return False
    names = [name for name in word.of.__annotations__ if name in {vector["flag"], f"{vector['flag']}_"}]
    if not names:
        return nothing & mask == constant  # a constant bit is not chosen
    stated = flag.__get__(word(nothing), word)
    if stated and not mask & (1 << flag.width) - 1 << flag.low:
        return False
    if vector["raw"] & mask != constant:
        return nothing & mask == constant
    state = vector["number"] if vector["truth"] is None else bool(vector["truth"])
    made = int(word.of(**{names[0]: state}))
    return bool(flag.number(made) == vector["number"])


CHECKS: Mapping[str, Check] = {"flag": flag, "flag_name": flag_name}
"""The checks of this theme by the kind of vector."""
