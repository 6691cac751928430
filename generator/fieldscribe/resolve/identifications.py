"""Resolves `identify`: what points hold in this device, or in one of its variants."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from fieldscribe.arithmetic.texts import fits
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.model import Identification, Point, Variant
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.symbols import SymbolTable
from fieldscribe.resolve.values import integer


def identifications_of(scope: Scope, symbols: SymbolTable, points: Mapping[str, Point]) -> tuple[Identification, ...]:
    """Return what identifies the device, then its variants, in the author's order; report what cannot be read."""
    stated: list[tuple[Variant | None, Map | None]] = [(None, scope.header.get("identify"))]
    stated += [
        (Variant(axis, value), facts.get("identify"))
        for axis, entry in scope.axes.items()
        for value, facts in entry["values"].items()
    ]
    return tuple(
        identification
        for variant, node in stated
        if node is not None
        for identification in _identifications(scope, symbols, points, variant, node)
    )


def _identifications(
    scope: Scope, symbols: SymbolTable, points: Mapping[str, Point], variant: Variant | None, node: Map
) -> Iterator[Identification]:
    for word, held in node.items():
        facts = symbols.find(word)
        if facts is None:
            symbols.unknown(word, node.key_span(word))
            continue
        point = points[facts.item]
        if facts.failed:
            continue
        plain = not point.info.floating and not (point.text is not None and point.text.is_bytes)
        if point.variant is not None or not point.readable or not point.generated or not plain:
            message = f"`{point.name}` cannot identify a device"
            hint = "name a point that every variant has and that can be read: a whole number or a text"
            scope.report.error("identify", message, node.key_span(word), hint)
            continue
        items = list(enumerate(held)) if isinstance(held, Seq) else [(None, held)]
        if point.text is not None:
            if not all(fits(point.text, str(item)) for _, item in items):
                hint = f"a text of it has at most {point.text.characters} characters"
                scope.report.error("identify", f"`{point.name}` cannot hold this text", node.span(word), hint)
            yield Identification(variant, point.name, (), tuple(str(item) for _, item in items))
            continue
        names = {} if point.enum is None else {entry.name: entry.raw for entry in point.enum.entries}
        raws = [
            names[str(item)]
            if str(item) in names
            else integer(item, node.span(word) if place is None else held.span(place), scope.report)
            for place, item in items
        ]
        outside = next((raw for raw in raws if raw is not None and not point.held[0] <= raw <= point.held[1]), None)
        if outside is not None:
            message, hint = f"`{point.name}` cannot hold {outside}", f"write {point.held[0]}..{point.held[1]}"
            scope.report.error("identify", message, node.span(word), hint)
        yield Identification(variant, point.name, tuple(raw for raw in raws if raw is not None), ())
