"""How many decimals people see in the values of a point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.resolve.integer_path import shows

if TYPE_CHECKING:
    from fieldscribe.model import Shape
    from fieldscribe.resolve.bounds import Bounds
    from fieldscribe.resolve.point_facts import PointFacts

_WITHOUT_VALUE = {
    "enum": "a number with names",
    "flags": "a word of flags",
    "digits": "a word of digits",
    "text": "a text",
    "bit": "a single bit",
}
"""The forms of points that are no quantity, in words."""


def display_of(facts: PointFacts, shape: Shape, bounds: Bounds) -> int | None:
    """The decimals that `display` says; a finding where there is no value to show with them."""
    display = facts.get("display")
    if display is None:
        return None
    decimals: int = display["decimals"]
    kind, report = _WITHOUT_VALUE.get(shape.form), bounds.scales.scope.report
    if kind is not None:
        if facts.layer("display") is not facts.group:  # what a group says is for its quantities
            message = f"`{facts.name}` is {kind}, which has no value to show with decimals"
            report.error("display-fact", message, facts.span("display"), "leave `display` out")
        return None
    fits = [count for count in range(decimals + 1) if _is_shown(facts, shape, bounds, count)]
    if decimals not in fits:
        message = f"`decimals: {decimals}` needs integers that are wider than code computes with"
        hint = f"write `decimals: {fits[-1]}`" if fits else "leave `display` out: no decimals of this scale are exact"
        report.error("display-fact", message, display.span("decimals"), hint)
        return None
    return decimals


def _is_shown(facts: PointFacts, shape: Shape, bounds: Bounds, decimals: int) -> bool:
    """Whether code can compute each value with this many decimals."""
    return shape.scale is None or shows(facts, shape.scale, bounds, decimals, counted=shape.decimals is not None)
