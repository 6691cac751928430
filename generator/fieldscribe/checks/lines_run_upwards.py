"""Places in the manual's text that are intervals run upwards."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.language.keys import lists_with
from fieldscribe.language.keys.places import DEVICE
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import parse_integer

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.checks.subject import Subject

_LISTS = lists_with(DEVICE, "lines")


def check(subject: Subject) -> None:
    """Findings for `lines` such as 9..3."""
    seen: set[int] = set()
    for one in subject.resolved:
        for layer in one.draft.layers:
            if id(layer) not in seen:
                seen.add(id(layer))
                _lines(subject, layer)
    for key in _LISTS:
        for raw in subject.scope.listed(key):
            _lines(subject, raw)
    if subject.scope.bus is not None:
        for codes in subject.scope.bus.values():
            for code in codes.values() if isinstance(codes, Map) else ():
                if isinstance(code, Map):
                    _lines(subject, code)


def _lines(subject: Subject, raw: Map) -> None:
    said = raw.get("lines")
    if said is None:
        return
    for holder, at, text in _said(raw, "lines", said):
        first, dots, last = text.partition("..")
        if dots and parse_integer(first) > parse_integer(last):
            subject.report.error(
                "range-reversed", f"lines `{text}` run downwards", holder.span(at), f"write {last}..{first}"
            )


def _said(holder: Map | Seq, at: Any, value: Any) -> Iterator[tuple[Map | Seq, Any, str]]:
    if isinstance(value, Map):
        for key, one in value.items():
            yield from _said(value, key, one)
    elif isinstance(value, Seq):
        for place, one in enumerate(value):
            yield from _said(value, place, one)
    else:
        yield holder, at, str(value)
