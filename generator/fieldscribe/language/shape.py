"""Checks a file against the table of keys; findings have positions and hints.

The checks are made from the table, each when a value first needs it; a test holds them against `jsonschema` on every
description and every bad input.
"""

from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING

from fieldscribe.kinds import BOOLEAN, NOTHING, NUMBER, Items, Place, Text, Whole, says_yes_or_no
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.shape_checks import Check, ObjectCheck, any_value, array, by_type, number, string

if TYPE_CHECKING:
    from fieldscribe.diagnostics import Report
    from fieldscribe.kinds import Kind, Shape

_WORDS: dict[type, str] = {Place: "a mapping", Items: "a list", Text: "text", Whole: "a whole number"}
_PLAIN: dict[Kind, tuple[str, tuple[type, ...]]] = {
    NUMBER: ("a number", (int, Decimal)),
    BOOLEAN: ("true or false", (bool,)),
    NOTHING: ("~", (type(None),)),
}
_made: dict[Shape, Check] = {}


def check_shape(value: Map, place: Place, report: Report) -> bool:
    """Whether the file has the shape of a place (`DEVICE` or `PART`); findings go to the report."""
    return check_of(place.shape)(value, value, None, report)


def check_of(shape: Shape) -> Check:
    """The check for a shape, made once."""
    if shape not in _made:
        _made[shape] = _check(shape)
    return _made[shape]


def _check(shape: Shape) -> Check:
    if not shape.kinds:
        return any_value
    checks: dict[type, Check] = {}
    for kind in shape.kinds:
        for python_type, check in _by_python_type(kind):
            checks.setdefault(python_type, check)
    form = next((kind.form for kind in shape.kinds if isinstance(kind, Text)), None)
    yes_no = says_yes_or_no(shape)
    wanted = "yes or no" if yes_no else " or ".join(map(_word, shape.kinds))
    return by_type(checks, wanted, next(iter(shape.examples), None), form, yes_no=yes_no)


def _word(kind: Kind) -> str:
    return _WORDS.get(type(kind)) or _PLAIN[kind][0]


def _by_python_type(kind: Kind) -> tuple[tuple[type, Check], ...]:
    """The check for a kind of value, by the Python types of its values."""
    if isinstance(kind, Place):
        return ((Map, ObjectCheck(kind, check_of)),)
    if isinstance(kind, Items):
        return ((Seq, array(check_of(kind.item), kind.least)),)
    if isinstance(kind, Text):
        return ((str, string(kind)),)
    if isinstance(kind, Whole):
        return ((int, number(kind)),)
    return tuple((python_type, any_value) for python_type in _PLAIN[kind][1])
