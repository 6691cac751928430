"""The classes of named numbers and of words of flags, made from the model as the generated ones are."""

from __future__ import annotations

import enum
from collections.abc import Iterable, Mapping
from types import new_class
from typing import Any

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.live.evaluation import evaluated
from fieldscribe.model import Entry, Point
from fieldscribe.targets.python.enums import reader
from fieldscribe.targets.python.identifiers import word_attribute
from fieldscribe.targets.runtime_calls.scope import Scope
from fieldscribe.text import upper


def classes_of(scope: Scope, runtime: Mapping[str, Any]) -> dict[str, Any]:
    """Return the classes of a device by name, made of names of the runtime."""
    classes: dict[str, Any] = {}
    for named in scope.device.enums:
        name = scope.names.enum_class(named.name)
        classes[name] = _numbers(name, named.entries, runtime)
    for point in scope.device.points:
        if name := scope.names.word_class(point):
            classes[name] = _word(name, point, _readers(point, scope, classes, runtime), runtime)
    return classes


def _numbers(name: str, entries: Iterable[Entry], runtime: Mapping[str, Any]) -> Any:
    return runtime["NamedNumber"](name, {upper(entry.name): entry.raw for entry in entries})


def _readers(point: Point, scope: Scope, classes: dict[str, Any], runtime: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return what reads each flag of a word by its attribute; classes of its numbers are added to the others."""
    readers = {}
    for flag in point.flags:
        named = scope.names.field_class(point, flag.name) or ""
        if named and named not in classes:
            classes[named] = _numbers(named, flag.values, runtime)
        readers[word_attribute(flag.name)] = evaluated(reader(flag, named), {**runtime, **classes})
    return readers


def _word(name: str, point: Point, readers: Mapping[str, Any], runtime: Mapping[str, Any]) -> Any:
    base = type(f"_{name}Flags", (runtime["Word"],), dict(readers))
    bits = {upper(flag.name): mask_of(flag.width, flag.low) for flag in point.flags}
    members = {**bits, "of": _composer(point, readers)} if point.writable else bits
    return new_class(name, (base, enum.IntFlag), {"boundary": enum.KEEP}, lambda body: body.update(members))


def _composer(point: Point, readers: Mapping[str, Any]) -> Any:
    """Return the method `of`; flags whose bits are always written as a constant are none of its parameters."""
    mask, bits = (point.fixed.mask, point.fixed.bits) if point.fixed else (0, 0)
    free = [word_attribute(flag.name) for flag in point.flags if mask_of(flag.width, flag.low) & ~mask]

    def of(cls: Any, /, **flags: int) -> Any:
        """Return the word in which exactly the passed flags are true, active-low bits included."""
        if unknown := flags.keys() - set(free):
            raise TypeError(f"{cls.__name__}.of() takes {', '.join(free)}, not {', '.join(sorted(unknown))}")
        return cls(cls._joined(*(readers[name].place(flags.get(name, 0)) for name in free), bits))

    return classmethod(of)
