"""The facts of reading and writing a point: access, limits, places."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.model import Limit
from fieldscribe.targets.rust.forms import count_type
from fieldscribe.targets.rust.layout import filled
from fieldscribe.targets.rust.literals import FLOAT_GREATEST, float_literal, integer, nearest_float
from fieldscribe.targets.rust.rules import interval, limit_lines

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Bound, Point
    from fieldscribe.targets.rust.layout import Lines
    from fieldscribe.targets.rust.subjects import CratePoint, CrateScope

_WRITES = {"coil": (5, 15), "holding": (6, 16)}
_WIDTH = 112


def read_lines(subject: CratePoint) -> tuple[str, ...]:
    """The facts of reading."""
    count, factors = count_type(subject), subject.factors_type
    facts = [f"count {count};"] if count else []
    facts += [f"with {factors};"] if factors != "()" else []
    return _block("read", [(fact,) for fact in facts])


def write_lines(subject: CratePoint, scope: CrateScope) -> tuple[str, ...]:
    """The facts of writing."""
    count = count_type(subject)
    facts = [f"count {count};"] if count else []
    facts += [f"with {subject.with_type};"] if subject.arguments else []
    facts += ["closed true;"] if subject.shape.closed else []
    tail = () if subject.point.encodes_values else ("values none;",)
    allowed = _allowed(subject, scope)
    others = (*_place(subject.point, scope), *tail)
    return _block("write", [*((fact,) for fact in facts), *allowed, *((fact,) for fact in others)])


def _block(name: str, facts: list[Lines]) -> Lines:
    """Facts in one line if they fit, else each in lines of its own."""
    lines = [line for fact in facts for line in fact]
    whole = f"{name} {{ {' '.join(lines)} }}" if facts else f"{name} {{}}"
    if len(whole) <= _WIDTH and len(lines) == len(facts):
        return (whole,)
    return (f"{name} {{", *(f"    {line}" for line in lines), "}")


def _allowed(subject: CratePoint, scope: CrateScope) -> Iterator[Lines]:
    """The facts about allowed numbers, unless the outer limits say it all."""
    point = subject.point
    if point.limit_arguments:
        yield tuple(_limits(point, scope))
    elif subject.form == "float":
        yield from ((ranges,) for ranges in _float_ranges(point))
    elif subject.form == "text" and point.text is not None and point.text.encoding == "ascii":
        yield ("check runtime::form::text::ascii::<Self>;",)
    elif subject.form == "digits" and point.digits is not None:
        yield (f"check runtime::form::digits::check::<Self, {point.digits.count}>;",)
    elif subject.form != "text" and len(ranges := point.allowed.fixed) > 1:
        yield filled("in [", " | ", [interval(*limits) for limits in ranges], "];")


def _limits(point: Point, scope: CrateScope) -> Iterator[str]:
    """The fact with a pair of ends for each range; some ends depend on other points."""
    yield "limits |with| ["
    for allowed in point.allowed.intervals:
        low, high = _end(allowed.low, scope, lower=True), _end(allowed.high, scope, lower=False)
        line = f"    ({low[0]}, {high[0]}),"
        if len(low) + len(high) == 2 and len(line) <= _WIDTH:
            yield line
        else:
            yield "    ("
            for end in (low, high):
                yield from (f"        {line}" for line in (*end[:-1], f"{end[-1]},"))
            yield "    ),"
    yield "];"


def _end(bound: Bound, scope: CrateScope, *, lower: bool) -> tuple[str, ...]:
    return limit_lines(bound, scope.lowered, lower=lower) if isinstance(bound, Limit) else (integer(bound),)


def _float_ranges(point: Point) -> Iterator[str]:
    """The limits as numbers of the type; empty if they are the type's own limits."""
    greatest = FLOAT_GREATEST[point.width]
    ends = [[nearest_float(float(end), point.width) for end in pair] for pair in point.allowed.units]
    if ends and ends != [[-greatest, greatest]]:
        pairs = ", ".join(f"({float_literal(low)}, {float_literal(high)})" for low, high in ends)
        yield f"ranges [{pairs}];"


def _place(point: Point, scope: CrateScope) -> Iterator[str]:
    """The function and the address for writing, unless they are the usual ones."""
    single, many = _WRITES.get(point.space, (0, 0))
    usual = single if point.words == 1 else many
    if usual not in scope.functions and many in scope.functions:
        yield f"function {many};"
