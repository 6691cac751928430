"""Checks a file against the table of keys; findings have positions and hints.

The checks are made from the table, each when a value first needs it; a test holds them against `jsonschema` on every
description and every bad input.
"""

from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING

from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.shape_checks import ItemsCheck, KeysCheck
from fieldscribe.language.value_checks import NumberCheck, ShapeCheck, TextCheck
from fieldscribe.schema_types import BOOLEAN, NOTHING, NUMBER, Items, Place, Text, Whole, says_yes_or_no

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.diagnostics import Report
    from fieldscribe.language.value_checks import Check
    from fieldscribe.schema_types import Kind, Shape

_WORDS: dict[type, str] = {Place: "a mapping", Items: "a list", Text: "text", Whole: "a whole number"}
_PLAIN: dict[Kind, tuple[str, tuple[type, ...]]] = {
    NUMBER: ("a number", (int, Decimal)),
    BOOLEAN: ("true or false", (bool,)),
    NOTHING: ("~", (type(None),)),
}
_ANY: dict[type, Check | None] = dict.fromkeys((Map, Seq, int, Decimal, bool, str, type(None)))
_made: dict[Shape, ShapeCheck] = {}


def check_shape(value: Map, place: Place, report: Report) -> bool:
    """Whether the file has the shape of a place (`DEVICE` or `PART`); findings go to the report."""
    return not report.full and check_of(place.shape)(value, value, None, report)


def check_of(shape: Shape) -> ShapeCheck:
    """The check for a shape, made once."""
    if shape not in _made:
        _made[shape] = _check(shape)
    return _made[shape]


def _check(shape: Shape) -> ShapeCheck:
    checks: dict[type, Check | None] = {}
    for kind in shape.kinds:
        for python_type, check in _by_python_type(kind):
            checks.setdefault(python_type, check)
    form = next((kind.form for kind in shape.kinds if isinstance(kind, Text)), None)
    yes_no = says_yes_or_no(shape)
    wanted = "yes or no" if yes_no else " or ".join(map(_word, shape.kinds))
    return ShapeCheck(checks or _ANY, wanted, next(iter(shape.examples), None), form, yes_no=yes_no)


def _word(kind: Kind) -> str:
    return _WORDS.get(type(kind)) or _PLAIN[kind][0]


def _by_python_type(kind: Kind) -> Iterator[tuple[type, Check | None]]:
    """The check for a kind of value, by the Python types of its values; None where each of them is right."""
    if isinstance(kind, Place):
        yield Map, KeysCheck(kind, check_of)
    elif isinstance(kind, Items):
        yield Seq, ItemsCheck(check_of(kind.item), kind.least)
    elif isinstance(kind, Text):
        yield str, TextCheck(kind) if kind.choices or kind.longest or kind.form else None
    elif isinstance(kind, Whole):
        bounded = kind.choices or kind.least is not None or kind.greatest is not None
        yield int, NumberCheck(kind) if bounded else None
    else:
        yield from dict.fromkeys(_PLAIN[kind][1]).items()
