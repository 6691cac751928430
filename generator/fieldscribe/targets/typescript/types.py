"""The TypeScript types of points: what decoding gives, what encoding takes, and what both need."""

from __future__ import annotations

from collections.abc import Iterator

from fieldscribe.model import Point
from fieldscribe.targets.runtime_calls.point_call import numbers_of
from fieldscribe.targets.runtime_calls.scope import Scope
from fieldscribe.targets.typescript.identifiers import code_attribute
from fieldscribe.text import camel, js_string

TYPE_NAMES = ("ReadOnly", "ReadWrite", "Stored", "StoredWriteOnly", "WriteOnly")
"""The types of points, which differ in their methods."""

_NUMBER_BITS = 32
"""Raw numbers of more bits are bigint."""


def is_big(point: Point) -> bool:
    """Return True if the raw numbers of a point are bigint."""
    bits = 16 * point.words if point.text is not None else point.width if point.shape.narrow else point.shape.info.bits
    return bits > _NUMBER_BITS


def type_of(point: Point, maker: str, scope: Scope) -> str:
    """Return the type of a point: `ReadWrite<number, { limits: "maximumFrequency" }>`."""
    numbers = numbers_of(point, scope)
    value, taken = _values(point, numbers)
    codes = [js_string(special.name) for special in point.specials]
    if codes:
        value = f"{value} | SpecialCode<{' | '.join(codes)}>"
    written = [js_string(special.name) for special in point.specials if special.writable]
    if written and point.writable:
        taken = f"{taken} | SpecialCode<{' | '.join(written)}>"
    facts = dict(_facts(point, numbers, scope))
    shown = value if point.readable else taken
    if taken != shown and point.writable:
        facts["takes"] = taken
    listed = "; ".join(f"{key}: {fact}" for key, fact in facts.items())
    return f"{maker}<{shown}, {{ {listed} }}>" if listed else f"{maker}<{shown}>"


def _values(point: Point, numbers: str) -> tuple[str, str]:
    """Return the type of what decoding gives, and of what encoding takes, both without special codes."""
    open_numbers, big = f"{numbers} | UnknownNumber", is_big(point)
    closed = point.enum is not None and point.enum.closed
    forms = {
        "bit": ("boolean", "boolean"),
        "digits": (f"readonly ({open_numbers})[]", f"readonly {numbers}[]"),
        "enum": (open_numbers, numbers if closed else open_numbers),
        "flags": (numbers, f"{numbers} | {'bigint' if big else 'number'}"),
        "integer": ("bigint", "bigint | number") if big else ("number", "number"),
        "text": ("string", "string"),
    }
    return ("Date", "Date | number") if point.epoch else forms.get(point.form, ("number", "number"))


def _facts(point: Point, numbers: str, scope: Scope) -> Iterator[tuple[str, str]]:
    if is_big(point):
        yield "raw", "bigint"
    needs = dict.fromkeys(point.shape.scale_arguments)
    if needs:
        yield "scale", _union(needs, scope)
    limits = {name for name in point.arguments if name not in needs} if point.writable else set()
    if limits:
        yield "limits", _union(dict.fromkeys(name for name in point.arguments if name in limits), scope)
    if point.specials:
        single = [special for special in point.specials if special.low == special.high]
        if single:
            named = "; ".join(f"{code_attribute(special)}: {js_string(special.name)}" for special in single)
            yield "special", f"{{ {named} }}"
    if numbers:
        yield "names", f"typeof {numbers}"


def _union(names: dict[str, None], scope: Scope) -> str:
    return " | ".join(js_string(camel(name)) for name in names)
