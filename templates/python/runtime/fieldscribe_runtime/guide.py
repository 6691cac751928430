# SPDX-License-Identifier: 0BSD
"""The text of `help()` for points and commands: what they are and how to use them."""

from __future__ import annotations

import enum
from typing import TYPE_CHECKING, Any

from .errors import CodecError
from .forms import Integer
from .points import Decoding, Encoding
from .quantities import Floating
from .rules import NO_RAWS, Limit
from .words import Field, Flag

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .facts import Facts
    from .points import Point
    from .rules import Bound

_KEPT = {
    "no": "lost",
    "yes": "kept; each write wears the memory",
    "choice": "lost unless it is written with keep=True, which wears the EEPROM",
}
_LISTED = 12
"""The most names that are listed."""


def described(point: Point) -> str:
    """Return what a point is and how to read, write and convert it."""
    facts = point.facts
    unit = f", in {facts.unit}" if facts.unit else ""
    access = [name for name, kind in (("read", Decoding), ("written", Encoding)) if isinstance(point, kind)]
    lines = [f"{point.label}{unit}; it can be {' and '.join(access)}.", "", f"Place: {facts.where}."]
    if facts.group:
        lines.append(f"Group: {facts.group}.")
    lines += [f"{what}: {text}." for what, text in _meanings(point, facts.item)]
    return "\n".join([*lines, "", *_uses(point, facts.item)])


def _meanings(point: Point, name: str) -> Iterator[tuple[str, str]]:
    """Yield the lines about the meaning of its numbers, and which may be written."""
    facts = point.facts
    yield "Raw numbers", "{}..{}".format(*point.wire.limits(point.width))
    if names := _names(point):
        yield ("Flags" if _is_word(point) else "Names"), names
    if len(point.special):
        yield "Special codes", f"{', '.join(point.special)} (as {name}.special.{next(iter(point.special))})"
    if isinstance(point, Encoding) and (text := _range(point)):
        yield "What may be written", text
    yield from _writing(facts)
    yield from _values(point, name)
    if facts.fixed is not None:
        yield "Bits that are always written", f"{facts.fixed[1]:04X}h in {facts.fixed[0]:04X}h"
    for text, names_of in (("Its scale needs", point.scale_needs), ("Its limits need", point.limit_needs)):
        if names_of:
            yield text, f"{', '.join(names_of)}, which a device reads by itself"
    if facts.only_for is not None:
        yield "Only for", f"{facts.only_for[0]} {' or '.join(facts.only_for[1])}"
    if facts.variant is not None:
        yield "Only for", " ".join(facts.variant)


def _writing(facts: Facts) -> Iterator[tuple[str, str]]:
    """Yield the lines about writing it."""
    if facts.conditions:
        yield "To write it takes", ", ".join([condition.replace("_", " ") for condition in facts.conditions])
    if facts.takes_effect != "at once":
        yield "A written value takes effect", facts.takes_effect
    if facts.write_with:
        yield "Written in one request with", ", ".join(facts.write_with)


def _values(point: Point, name: str) -> Iterator[tuple[str, str]]:
    """Yield the lines about power-off, display and the factory setting."""
    facts = point.facts
    if facts.keeps:
        yield "At power-off a written value is", _KEPT.get(facts.keeps, f"lost unless {facts.keeps}.send() follows")
    if facts.display is not None:
        yield "Shown", f"with {facts.display} decimal{'' if facts.display == 1 else 's'}, by {name}.text(value)"
    if facts.default is not None:
        yield "Default", f"{facts.default:.12g} {facts.unit}".rstrip()


def _is_word(point: Point) -> bool:
    return point.names is not None and issubclass(point.names, enum.IntFlag)


def _names(point: Point) -> str:
    """Return the names of numbers, or of flags as they are attributes of the word."""
    kind: Any = point.names
    if kind is None:
        return ""
    if _is_word(point):
        members = {name: one for base in kind.__mro__ for name, one in vars(base).items()}
        named = [name for name, one in members.items() if isinstance(one, (Flag, Field))]
    else:
        named = [f"{int(member)} {member.name.lower()}" for member in kind]
    rest = len(named) - _LISTED
    return ", ".join(named[:_LISTED]) + (f" and {rest} more in {kind.__name__}" if rest > 0 else "")


def _range(point: Point) -> str:
    """Return what may be written, in the unit unless other points decide it."""
    form = _inner(point)
    unit = f" {point.facts.unit}" if point.facts.unit else ""
    if isinstance(form, Floating):
        return " or ".join([f"{low:.12g}..{high:.12g}" for low, high in form.units]) + unit if form.units else ""
    if point.facts.allowed is None:
        return ""
    try:
        ends = [(_end(point, low), _end(point, high)) for low, high in point.facts.allowed]
    except CodecError:  # the scale needs other points
        low, high = point.raw_limits
        return f"raw {low}..{high}"
    whole = ", whole numbers" if isinstance(form, Integer) else ""
    return " or ".join([low if low == high else f"{low}..{high}" for low, high in ends]) + unit + whole


def _end(point: Point, bound: Bound) -> str:
    if isinstance(bound, Limit):
        bound = bound.least if bound.least == point.raw_limits[0] else bound.greatest
    return point._form.shown(bound, NO_RAWS)


def _uses(point: Point, name: str) -> Iterator[str]:
    """Yield the lines about its use, with an example of a conversion if that needs no other points."""
    raw, value = _example(point) or ("raw", "value")
    own = _raws(point.scale_needs)
    limits = _raws(tuple(dict.fromkeys((*point.scale_needs, *point.limit_needs))))
    yield "Without a device:"
    if isinstance(point, Decoding):
        yield f"    {name}.decode({raw}{own}) -> {value}"
    if isinstance(point, Encoding):
        yield f"    {name}.encode({value}{limits}) -> {raw}"
    yield "On a device (with await on an async one):"
    if isinstance(point, Decoding):
        yield f"    device.{name}.read() -> value, device.{name}.read_raw() -> raw"
    if isinstance(point, Encoding):
        yield f"    device.{name}.write(value), device.{name}.write_raw(raw)"
    yield f"For programs: {name}.facts"


def _raws(needs: tuple[str, ...]) -> str:
    """Return the argument with the raw numbers of other points."""
    held = ", ".join([f'"{one}": ...' for one in needs])
    return f", raws={{{held}}}" if needs else ""


def _example(point: Point) -> tuple[str, str] | None:
    """Return a raw number and its value as a program writes them; None if other points are needed, or none exists."""
    raw = point.raw_limits[1] if point.facts.allowed else 1
    needs = point.scale_needs or point.limit_needs or _is_word(point)
    if not isinstance(point, Decoding) or needs or isinstance(_inner(point), Floating):
        return None
    try:
        value = point.decode(raw)
    except CodecError:
        return None
    if isinstance(value, enum.Enum):
        return str(raw), f"{type(value).__name__}.{value.name}" if value.name.isidentifier() else repr(value)
    return (str(raw), repr(value)) if isinstance(value, (int, float)) else None


def _inner(point: Point) -> Any:
    """Return the form inside the wrappers."""
    form: Any = point._form
    while hasattr(form, "form"):
        form = form.form
    return form
