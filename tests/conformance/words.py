"""Bit groups, the words of a number, texts and digits."""

from __future__ import annotations

import datetime
from collections.abc import Mapping
from typing import Any

from support.vector_file import Vector

from conformance.package import Check, Package


def bits(package: Package, vector: Vector) -> bool:
    """A bit group out of its word and into it."""
    point, word = package.point(vector), vector["word"]
    replaced = point.insert(word, vector["replaced"])
    return bool(point.extract(word) == vector["raw"] and replaced == vector["result"])


def words(package: Package, vector: Vector) -> bool:
    """The words of a number."""
    point = package.point(vector)
    words = tuple(vector["words"])
    return bool(point.from_words(words) == vector["raw"] and point.to_words(vector["raw"]) == words)


def text_decode(package: Package, vector: Vector) -> bool:
    """Words to a text."""
    point = package.point(vector)
    return bool(point.decode(_raw(point, vector)).encode("latin-1") == vector["text"])


def _raw(point: Any, vector: Vector) -> Any:
    """The raw number of words that are in the order of their characters."""
    by_address = dict(zip(point.facts.at.addresses, vector["words"], strict=True))
    return point.from_words([by_address[address] for address in sorted(by_address)])


def text_encode(package: Package, vector: Vector) -> bool:
    """A text to words."""
    point = package.point(vector)
    status, raw = package.outcome(point.encode, vector["text"].decode("latin-1"))
    if status != "ok":
        return bool(status == vector["status"] and vector["words"] == [])
    at = point.facts.write_at or point.facts.at
    by_address = dict(zip(sorted(at.addresses), point.to_words(raw), strict=True))
    words = [by_address[address] for address in at.addresses]
    return bool(status == vector["status"] and words == vector["words"])


def unicode_decode(package: Package, vector: Vector) -> bool:
    """Words to a text of Unicode."""
    point = package.point(vector)
    status, text = package.outcome(point.decode, point.from_words(list(vector["words"])))
    return bool(status == vector["status"] and (status != "ok" or text.encode() == vector["text"]))


def unicode_encode(package: Package, vector: Vector) -> bool:
    """A text of Unicode to words."""
    point = package.point(vector)
    status, raw = package.outcome(point.encode, vector["text"].decode())
    return bool(status == vector["status"] and (status != "ok" or point.to_words(raw) == tuple(vector["words"])))


def notation(package: Package, vector: Vector) -> bool:
    """Bytes as people write them, and back."""
    point = package.point(vector)
    status, raw = package.outcome(point.encode, vector["text"]) if hasattr(point, "encode") else ("ok", None)
    decoded = not hasattr(point, "decode") or point.decode(_raw(point, vector)) == vector["text"]
    return bool(decoded and status == "ok" and raw in (None, _raw(point, vector)))


_FIELDS = ("year", "month", "day", "hour", "minute", "second", "microsecond")


def date_decode(package: Package, vector: Vector) -> bool:
    """Words to a date and time."""
    point = package.point(vector)
    status, value = package.outcome(point.decode, _raw(point, vector))
    if status != "ok":
        return bool(status == vector["status"])
    numbers = [getattr(value, name, 0) for name in _FIELDS]
    return bool(status == vector["status"] and [*numbers[:6], numbers[6] // 1000] == vector["numbers"])


def date_encode(package: Package, vector: Vector) -> bool:
    """A date and time to words; one that Python has no object of is out of range anyway."""
    point, (*numbers, millisecond) = package.point(vector), vector["numbers"]
    facts = dict(zip(_FIELDS, (*numbers, 1000 * millisecond), strict=True))
    names = _form(point)._names
    kept = {"second", "microsecond"} if "millisecond" in names else set()
    try:
        value = getattr(datetime, _form(point).made)(**{name: facts[name] for name in facts if name in names | kept})
    except ValueError:
        return bool(vector["status"] == "out_of_range")
    status, raw = package.outcome(point.encode, value)
    return bool(status == vector["status"] and (status != "ok" or raw == _raw(point, vector)))


def _form(point: Any) -> Any:
    return point._form


def digits(package: Package, vector: Vector) -> bool:
    """A word to its digits."""
    status, found = package.outcome(package.point(vector).decode, vector["raw"])
    if status == "special":
        return bool(vector["status"] == status and str(found) == vector["special"])
    return bool(status == vector["status"] and list(found) == vector["digits"])


def digits_encode(package: Package, vector: Vector) -> bool:
    """Digits to their word."""
    status, raw = package.outcome(package.point(vector).encode, tuple(vector["digits"]))
    return bool(status == vector["status"] and (status != "ok" or raw == vector["raw"]))


CHECKS: Mapping[str, Check] = {
    "bits": bits,
    "words": words,
    "text_decode": text_decode,
    "text_encode": text_encode,
    "unicode_decode": unicode_decode,
    "unicode_encode": unicode_encode,
    "date_decode": date_decode,
    "date_encode": date_encode,
    "notation": notation,
    "digits": digits,
    "digits_encode": digits_encode,
}
"""The checks of this theme by the kind of vector."""
