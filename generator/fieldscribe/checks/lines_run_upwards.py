"""Intervals of cited lines run upwards."""

from collections.abc import Iterator
from typing import Any

from fieldscribe.language.keys import lists_with
from fieldscribe.language.keys.places import DEVICE
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import parse_integer
from fieldscribe.resolve.analysis import Analysis

_LISTS = lists_with(DEVICE, "lines")


def check(analysis: Analysis) -> None:
    """Report `lines` such as 9..3."""
    seen: set[int] = set()
    for resolved in analysis.resolved:
        for layer in resolved.facts.layers:
            if id(layer) not in seen:
                seen.add(id(layer))
                _lines(analysis, layer)
    for key in _LISTS:
        for raw in analysis.scope.listed(key):
            _lines(analysis, raw)
    if analysis.scope.bus is not None:
        for codes in analysis.scope.bus.values():
            for code in codes.values() if isinstance(codes, Map) else ():
                if isinstance(code, Map):
                    _lines(analysis, code)


def _lines(analysis: Analysis, node: Map) -> None:
    lines = node.get("lines")
    if lines is None:
        return
    for holder, at, text in _texts_in(node, "lines", lines):
        first, dots, last = text.partition("..")
        if dots and parse_integer(first) > parse_integer(last):
            message = f"lines `{text}` run downwards"
            analysis.report.error("range-reversed", message, holder.span(at), f"write {last}..{first}")


def _texts_in(holder: Map | Seq, at: Any, value: Any) -> Iterator[tuple[Map | Seq, Any, str]]:
    if isinstance(value, Map):
        for key, item in value.items():
            yield from _texts_in(value, key, item)
    elif isinstance(value, Seq):
        for place, item in enumerate(value):
            yield from _texts_in(value, place, item)
    else:
        yield holder, at, str(value)
