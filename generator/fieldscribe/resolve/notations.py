"""How people write bytes, and numbers that are a time since a date."""

from __future__ import annotations

from datetime import date

from fieldscribe.model import NOTATIONS, Shape, Text
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope

_TIME = "time since "
_USUAL = "hex"
_OF_CHARACTERS = ("characters", "encoding", "padding")


def layout_of_bytes(facts: PointFacts, *, low_first: bool) -> Text:
    """Return how bytes stand in words; where the notation leaves their number open, they take `length` words."""
    notation, per_word = str(facts.get("notation", _USUAL)), int(facts.get("per_word", 2))
    notation = notation if notation in NOTATIONS else _USUAL
    count = NOTATIONS[notation] or per_word * int(facts.get("length", 1))
    return Text(count, notation, per_word, low_first=low_first)


def checked_bytes(scope: Scope, facts: PointFacts, layout: Text) -> Text:
    """Return the layout of bytes; report facts that they cannot have."""
    for key in _OF_CHARACTERS:
        if facts.get(key) is not None and facts.layer(key) is not facts.group:
            hint = "bytes have a `notation`, and a `length` in words: leave it out"
            scope.report.error("text-fact", f"`{key}` is for texts", facts.span(key), hint)
    if facts.get("length") not in (None, layout.words):
        message = f"{layout.encoding} is {layout.characters} bytes, which take {layout.words} words"
        scope.report.error("text-length", message, facts.span("length"), "leave `length` out")
    return layout


def epoch_of(scope: Scope, facts: PointFacts, shape: Shape) -> str:
    """Return the date from which the value counts seconds; empty if it does not, or after a finding."""
    notation = facts.get("notation")
    if notation is None or facts.untyped is not None or facts.failed & {"type", "notation", "scale"}:
        return ""
    epoch = notation.removeprefix(_TIME)
    is_time, unit = epoch != notation, facts.get("unit")
    if is_time == facts.bytes or (is_time and (shape.form not in ("integer", "scaled") or shape.scale_arguments)):
        needs = "whole numbers, with a scale that needs no other point" if is_time else "bytes"
        right = "correct `type`" if is_time else "write `type: bytes`"
        message, hint = f"`notation: {notation}` is for {needs}", f"{right}, or leave it out"
        scope.report.error("wrong-choice", message, facts.span("notation"), hint)
    elif is_time and unit not in (None, "s"):
        message, hint = f"a time is in seconds, not in {unit}", "give a `scale` to seconds, and `unit: s`"
        scope.report.error("wrong-choice", message, facts.span("unit"), hint)
    elif is_time:
        try:
            return date.fromisoformat(epoch).isoformat()
        except ValueError:
            scope.report.error("wrong-form", f"`{epoch}` is no date", facts.span("notation"), "write 1970-01-01")
    return ""
